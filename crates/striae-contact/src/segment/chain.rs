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

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use super::{
    fan::Fan,
    plane_facet::Vec2,
    polygon::{Label, Vertex},
    sums::{ByPair, PAIRS, PlaneSlopes, add, functions},
};

/// The plane of a pair.
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

    fn height(&self, x: &Vec3) -> f64 {
        self.normal.dot(&(x - self.origin))
    }
}

impl PlaneSlopes {
    /// Passes the slopes by vertices, and by a centre, on to the corners.
    pub fn pass_on(&mut self, polygon: &[Vertex], fan: &Fan, places: &[Vec2; 8]) {
        let mut vertices = std::mem::take(&mut self.vertices);
        if let Some(centre) = vertices.get(polygon.len()).copied() {
            let share = 1.0 / fan.around.len() as f64;
            for at in &fan.around {
                (0..2).for_each(|axis| add(&mut vertices[*at][axis], share, &centre[axis]));
            }
        }
        for (vertex, by_place) in polygon.iter().zip(&vertices) {
            match vertex.label {
                Label::Corner(corner) => self.pass(corner, 1.0, by_place),
                Label::Both(corners) => {
                    corners
                        .iter()
                        .for_each(|corner| self.pass(*corner, 0.5, by_place));
                }
                Label::Crossing(edges) => {
                    let [u, w] = edges.map(|edge| places[edge.ends[1]] - places[edge.ends[0]]);
                    let cross = u.perp(&w);
                    for (edge, own, other, sign) in [(edges[0], u, w, 1.0), (edges[1], w, u, -1.0)]
                    {
                        let [along_x, along_y] = [other.x, other.y].map(|c| sign * c / cross);
                        let mut moved = [0.0; PAIRS];
                        add(&mut moved, along_x, &by_place[0]);
                        add(&mut moved, along_y, &by_place[1]);
                        for (end, share) in
                            edge.ends.into_iter().zip([1.0 - edge.share, edge.share])
                        {
                            add(&mut self.corners[2 * end], -share * own.y, &moved);
                            add(&mut self.corners[2 * end + 1], share * own.x, &moved);
                        }
                    }
                }
            }
        }
    }

    fn pass(&mut self, corner: usize, share: f64, by_place: &[ByPair; 2]) {
        for axis in 0..2 {
            add(&mut self.corners[2 * corner + axis], share, &by_place[axis]);
        }
    }

    /// Derivatives by the corners in space: of pair `(c, d)` in the row of its index.
    pub fn in_space(
        &self,
        plane: &Plane,
        corners: &[Vec3; 8],
        normal: &[Matrix3<f64>; 8],
    ) -> [[f64; 24]; PAIRS] {
        let mut turn = [[0.0; PAIRS]; 2];
        for (corner, x) in corners.iter().enumerate() {
            let height = -plane.height(x);
            for axis in 0..2 {
                add(&mut turn[axis], height, &self.corners[2 * corner + axis]);
            }
        }
        let mut by_turn = [[0.0; 24]; 2];
        for axis in 0..2 {
            for corner in 0..8 {
                let slope = normal[corner].tr_mul(&plane.axes[axis]);
                by_turn[axis][3 * corner..3 * corner + 3].copy_from_slice(slope.as_slice());
            }
        }
        let mut slopes = [[0.0; 24]; PAIRS];
        for pair in 0..PAIRS {
            let (c, d) = functions(pair);
            let row = &mut slopes[super::pair_index(c, d)];
            for corner in 0..8 {
                let [first, second] = [0, 1].map(|axis| self.corners[2 * corner + axis][pair]);
                let by_x = plane.axes[0] * first + plane.axes[1] * second;
                row[3 * corner..3 * corner + 3].copy_from_slice(by_x.as_slice());
            }
            add(row, turn[0][pair], &by_turn[0]);
            add(row, turn[1][pair], &by_turn[1]);
        }
        slopes
    }
}
