//! From derivatives in the plane of a pair to derivatives in space.
//!
//! Vertices pass theirs on to the corners they are made of; for the crossing `X` of
//! the edges `u` of `a` and `w` of `b`
//!
//! ```text
//! u x w dX = w (u x ((1 - s) dY_0 + s dY_1)) - u (w x ((1 - t) dY_2 + t dY_3))
//! ```
//!
//! The axes `e_i` of the plane turn with `n` without spin, `de_i = -n (e_i . dn)`, and
//! `r` counts from any common origin:
//!
//! ```text
//! dy_i = e_i . dx - (n . r)(e_i . dn)
//! ```
//!
//! and the height `h = n . r` over it moves by `dh = n . dx + sum_i y_i (e_i . dn)`.

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use super::{
    fan::Fan,
    plane_facet::Vec2,
    polygon::{CutEdge, Label, Vertex},
    sums::add,
};

/// The plane of a pair.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    /// Its normal.
    pub normal: Vec3,
    /// Axes in it.
    pub axes: [Vec3; 2],
    origin: Vec3,
}

impl Plane {
    /// The plane through `origin` with this unit normal.
    pub fn new(normal: Vec3, origin: Vec3) -> Self {
        let mut least = Vec3::zeros();
        least[normal.iamin()] = 1.0;
        let first = (least - normal * normal.dot(&least)).normalize();
        Self {
            axes: [first, normal.cross(&first)],
            normal,
            origin,
        }
    }

    /// Coordinates in the plane.
    pub fn place(&self, x: &Vec3) -> Vec2 {
        let r = x - self.origin;
        Vec2::new(self.axes[0].dot(&r), self.axes[1].dot(&r))
    }

    /// Height over the plane.
    pub fn height(&self, x: &Vec3) -> f64 {
        self.normal.dot(&(x - self.origin))
    }
}

/// Derivatives of `M` integrals by the coordinates of each corner in the plane.
pub(super) struct CornerSlopes<const M: usize>(Box<[[[f64; M]; 2]; 8]>);

impl<const M: usize> CornerSlopes<M> {
    /// From derivatives by the corners while the polygon rests, and by its vertices and the
    /// centre of its fan, which are passed on to the corners.
    pub fn new(
        corners: Box<[[[f64; M]; 2]; 8]>,
        mut vertices: Vec<[[f64; M]; 2]>,
        polygon: &[Vertex],
        fan: &Fan,
        places: &[Vec2; 8],
    ) -> Self {
        let mut corners = Self(corners);
        if let Some(centre) = vertices.get(polygon.len()).copied() {
            let share = 1.0 / fan.around.len() as f64;
            for at in &fan.around {
                (0..2).for_each(|axis| add(&mut vertices[*at][axis], share, &centre[axis]));
            }
        }
        for (vertex, by_place) in polygon.iter().zip(&vertices) {
            match &vertex.label {
                Label::Corner(corner) => corners.pass(*corner, 1.0, by_place),
                Label::Both(both) => both.iter().for_each(|at| corners.pass(*at, 0.5, by_place)),
                Label::Crossing(edges) => corners.pass_crossing(edges, places, by_place),
            }
        }
        corners
    }

    fn pass(&mut self, corner: usize, share: f64, by_place: &[[f64; M]; 2]) {
        for axis in 0..2 {
            add(&mut self.0[corner][axis], share, &by_place[axis]);
        }
    }

    fn pass_crossing(
        &mut self,
        edges: &[CutEdge; 2],
        places: &[Vec2; 8],
        by_place: &[[f64; M]; 2],
    ) {
        let [u, w] = edges.map(|edge| places[edge.ends[1]] - places[edge.ends[0]]);
        let cross = u.perp(&w);
        for (edge, own, along) in [(&edges[0], u, w / cross), (&edges[1], w, -u / cross)] {
            let mut moved = [0.0; M];
            add(&mut moved, along.x, &by_place[0]);
            add(&mut moved, along.y, &by_place[1]);
            for (end, share) in edge.ends.into_iter().zip([1.0 - edge.share, edge.share]) {
                add(&mut self.0[end][0], -share * own.y, &moved);
                add(&mut self.0[end][1], share * own.x, &moved);
            }
        }
    }

    /// Derivatives by the corners in space, column `3 k + i` for `x_k . e_i`, from those of the
    /// normal and, where integrals depend on heights over the plane, those by the heights.
    pub fn in_space(
        &self,
        plane: &Plane,
        corners: &[Vec3; 8],
        normal: &[Matrix3<f64>; 8],
        by_height: Option<&[[f64; M]; 8]>,
    ) -> [[f64; 24]; M] {
        let mut turn = [[0.0; M]; 2];
        let mut by_turn = [[0.0; 24]; 2];
        for axis in 0..2 {
            for corner in 0..8 {
                let height = plane.height(&corners[corner]);
                add(&mut turn[axis], -height, &self.0[corner][axis]);
                if let Some(by_height) = by_height {
                    let place = plane.place(&corners[corner])[axis];
                    add(&mut turn[axis], place, &by_height[corner]);
                }
                let slope = normal[corner].tr_mul(&plane.axes[axis]);
                by_turn[axis][3 * corner..3 * corner + 3].copy_from_slice(slope.as_slice());
            }
        }
        let mut rows = [[0.0; 24]; M];
        for (at, row) in rows.iter_mut().enumerate() {
            for corner in 0..8 {
                let [first, second] = self.0[corner].each_ref().map(|by| by[at]);
                let mut by_x = plane.axes[0] * first + plane.axes[1] * second;
                if let Some(by_height) = by_height {
                    by_x += plane.normal * by_height[corner][at];
                }
                row[3 * corner..3 * corner + 3].copy_from_slice(by_x.as_slice());
            }
            add(row, turn[0][at], &by_turn[0]);
            add(row, turn[1][at], &by_turn[1]);
        }
        rows
    }
}
