//! Kinds of cells: one file each and one line in the table of [`CellKind::shape`].
//!
//! A [`CellShape`] lists what a mesh needs of a kind: natural coordinates of the
//! corners, faces outward by the right-hand rule, the edges at each corner, the
//! linear interpolation `N_a(xi)` and a quadrature rule, with what continues values at its
//! points to the corners. The rule integrates
//! `dN_a/dX det(dX/dxi)` exactly in any cell with straight edges: volumes are exact, and
//! elements that use it pass the patch test.
//!
//! Corners and faces are numbered as Abaqus and Gmsh number them (`S1` is side 0);
//! VTK numbers all but the wedge alike. A side of a composite tetrahedron is four faces.

mod composite;
mod hexahedron;
mod pyramid;
mod tetrahedron;
mod wedge;

use crate::{NodeId, Vec3};
pub use composite::{COMPOSITE_PARTS, composite_linear};
use serde::Serialize;
use std::{fmt, ops::Range};

/// Most corners of a cell of any kind.
pub const MAX_CORNERS: usize = 10;

/// Most quadrature points from which values are continued to the corners of a cell.
pub const MAX_POINTS: usize = 8;

/// A kind of cell with linear interpolation. What the nodes of a cell are, in all of them, is
/// its corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum CellKind {
    /// Four corners, four triangular faces.
    Tetrahedron,
    /// Five corners: a quadrilateral base and four triangles.
    Pyramid,
    /// Six corners: two triangles and three quadrilaterals.
    Wedge,
    /// Eight corners, six quadrilateral faces.
    Hexahedron,
    /// Four corners and the middles of six edges, four triangular faces on each of four sides;
    /// linear in each of [twelve parts](COMPOSITE_PARTS).
    CompositeTetrahedron,
}

/// Geometry of a kind of cell.
#[derive(Debug)]
pub struct CellShape {
    /// Name of one such cell, singular.
    pub name: &'static str,
    /// Plural of the name.
    pub plural: &'static str,
    /// Natural coordinates of the corners.
    pub corners: &'static [[f64; 3]],
    /// Local corners of every face, outward by the right-hand rule.
    pub faces: &'static [&'static [usize]],
    /// Number of faces that form one side in mesh files.
    pub faces_a_side: usize,
    /// A corner and the ends of three edges that meet there, right-handed.
    pub trihedra: &'static [[usize; 4]],
    /// Triple product of the unit edges at a corner of the regular cell.
    pub regular: f64,
    /// Jacobian determinant at a corner over the triple product of its edges.
    pub corner_jacobian: f64,
    /// Natural coordinates and weights of the quadrature points.
    pub points: &'static [([f64; 3], f64)],
    /// Shares of the values at the quadrature points in a value at natural coordinates, zero
    /// beyond the last point; `None` where elements have points of their own.
    pub recovery: Option<fn(&Vec3) -> [f64; MAX_POINTS]>,
    /// VTK's number of the kind.
    pub vtk: u8,
    /// `N_a` at natural coordinates; zero beyond the last corner.
    pub interpolation: fn(&Vec3) -> [f64; MAX_CORNERS],
    /// `dN_a/dxi` at natural coordinates; zero beyond the last corner.
    pub gradients: fn(&Vec3) -> [Vec3; MAX_CORNERS],
}

impl CellKind {
    /// All kinds.
    pub const ALL: [Self; 5] = [
        Self::Tetrahedron,
        Self::Pyramid,
        Self::Wedge,
        Self::Hexahedron,
        Self::CompositeTetrahedron,
    ];

    /// Geometry of the kind.
    pub const fn shape(self) -> &'static CellShape {
        match self {
            Self::Tetrahedron => &tetrahedron::SHAPE,
            Self::Pyramid => &pyramid::SHAPE,
            Self::Wedge => &wedge::SHAPE,
            Self::Hexahedron => &hexahedron::SHAPE,
            Self::CompositeTetrahedron => &composite::SHAPE,
        }
    }

    /// Number of corners of a cell.
    pub const fn corner_count(self) -> usize {
        self.shape().corners.len()
    }

    /// Faces that a side as mesh files count them is made of, none for what is no side.
    pub fn faces_of_side(self, side: u8) -> Range<u8> {
        let (each, all) = (self.shape().faces_a_side, self.shape().faces.len());
        let first = (each * usize::from(side)).min(all);
        first as u8..(first + each).min(all) as u8
    }

    /// Fewest edges of faces from one corner to another.
    pub fn edges_between(self, from: usize, to: usize) -> usize {
        let faces = self.shape().faces;
        let mut reached = [false; MAX_CORNERS];
        reached[from] = true;
        let mut count = 0;
        while !reached[to] {
            let before = reached;
            for face in faces {
                for (at, &end) in face.iter().enumerate() {
                    let other = face[(at + 1) % face.len()];
                    reached[end] |= before[other];
                    reached[other] |= before[end];
                }
            }
            count += 1;
        }
        count
    }
}

impl fmt::Display for CellKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.shape().name)
    }
}

/// Cells of one kind, consecutive in the numbering of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CellBlock {
    /// Kind of all cells.
    pub kind: CellKind,
    /// Corners of one cell after the other.
    pub nodes: Vec<NodeId>,
}

impl CellBlock {
    /// Hexahedra.
    pub fn hexahedra(cells: impl IntoIterator<Item = [NodeId; 8]>) -> Self {
        Self {
            kind: CellKind::Hexahedron,
            nodes: cells.into_iter().flatten().collect(),
        }
    }

    /// Cells with these corners in blocks: one for each run of equal kinds.
    pub fn runs<'a>(cells: impl IntoIterator<Item = (CellKind, &'a [NodeId])>) -> Vec<Self> {
        let mut blocks: Vec<Self> = Vec::new();
        for (kind, corners) in cells {
            match blocks.last_mut() {
                Some(last) if last.kind == kind => last.nodes.extend_from_slice(corners),
                _ => blocks.push(Self {
                    kind,
                    nodes: corners.to_vec(),
                }),
            }
        }
        blocks
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.nodes.len() / self.kind.corner_count()
    }

    /// Returns whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Corners of every cell in turn.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = &[NodeId]> {
        self.nodes.chunks_exact(self.kind.corner_count())
    }

    /// Corners of a cell, counted within the block.
    pub fn corners(&self, at: usize) -> &[NodeId] {
        let count = self.kind.corner_count();
        &self.nodes[count * at..count * (at + 1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    fn corners(kind: CellKind) -> impl Iterator<Item = Vec3> {
        kind.shape()
            .corners
            .iter()
            .map(|&corner| Vec3::from(corner))
    }

    #[test]
    fn functions_are_one_at_their_corner_and_zero_at_others() {
        for kind in CellKind::ALL {
            for (a, corner) in corners(kind).enumerate() {
                let values = (kind.shape().interpolation)(&corner);
                for (b, value) in values.into_iter().enumerate() {
                    let exact = if a == b { 1.0 } else { 0.0 };
                    assert!((value - exact).abs() < 1e-15, "{kind} {a} {b}");
                }
            }
        }
    }

    #[test]
    fn linear_fields_are_interpolated_and_gradients_are_derivatives() {
        let field = |x: &Vec3| 0.3 + 1.7 * x.x - 0.4 * x.y + 0.9 * x.z;
        let slope = Vec3::new(1.7, -0.4, 0.9);
        for kind in CellKind::ALL {
            let shape = kind.shape();
            for &(at, _) in shape.points {
                let at = Vec3::from(at);
                let (values, gradients) = ((shape.interpolation)(&at), (shape.gradients)(&at));
                let pairs = || corners(kind).map(|corner| field(&corner));
                let value: f64 = pairs().zip(values).map(|(f, n)| f * n).sum();
                let found: Vec3 = pairs().zip(gradients).map(|(f, n)| n * f).sum();
                assert!((value - field(&at)).abs() < 1e-14 && (found - slope).norm() < 1e-14);
                for axis in 0..3 {
                    let mut step = Vec3::zeros();
                    step[axis] = 1e-5;
                    let [up, down] = [at + step, at - step].map(|x| (shape.interpolation)(&x));
                    for a in 0..MAX_CORNERS {
                        let difference = (up[a] - down[a]) / 2e-5;
                        assert!((difference - gradients[a][axis]).abs() < 1e-9, "{kind}");
                    }
                }
            }
        }
    }

    #[test]
    fn faces_close_the_cell_outward() {
        for kind in CellKind::ALL {
            let shape = kind.shape();
            let x: Vec<Vec3> = corners(kind).collect();
            let (mut closed, mut volume) = (Vec3::zeros(), 0.0);
            for face in shape.faces {
                let area = (1..face.len() - 1)
                    .map(|at| {
                        let [a, b, c] = [face[0], face[at], face[at + 1]].map(|at| x[at]);
                        0.5 * (b - a).cross(&(c - a))
                    })
                    .sum::<Vec3>();
                closed += area;
                volume += area.dot(&x[face[0]]) / 3.0;
            }
            let weights: f64 = shape.points.iter().map(|point| point.1).sum();
            assert!(closed.norm() < 1e-15, "{kind}");
            assert!(
                (volume - weights).abs() < 1e-14,
                "{kind}: {volume} {weights}"
            );
        }
    }

    #[test]
    fn trihedra_are_right_handed_edges_with_the_jacobian_of_their_corner() {
        for kind in CellKind::ALL {
            let shape = kind.shape();
            let x: Vec<Vec3> = corners(kind).collect();
            for &[corner, a, b, c] in shape.trihedra {
                let [a, b, c] = [a, b, c].map(|end| {
                    assert_eq!(kind.edges_between(corner, end), 1, "{kind}");
                    x[end] - x[corner]
                });
                assert!(a.dot(&b.cross(&c)) > 0.0, "{kind} at {corner}");
                let gradients = (shape.gradients)(&x[corner]);
                let jacobian: Matrix3<f64> = (x.iter().zip(gradients))
                    .map(|(x, gradient)| x * gradient.transpose())
                    .sum();
                if jacobian.iter().all(|entry| entry.is_finite()) {
                    let found = jacobian.determinant() / a.dot(&b.cross(&c));
                    assert!(
                        (found - shape.corner_jacobian).abs() < 1e-14,
                        "{kind}: {found}"
                    );
                }
            }
        }
    }

    #[test]
    fn edges_lead_from_corner_to_corner() {
        let hexahedron = |a, b| CellKind::Hexahedron.edges_between(a, b);
        assert_eq!([0, 1, 2, 6].map(|to| hexahedron(0, to)), [0, 1, 2, 3]);
        let composite = |a, b| CellKind::CompositeTetrahedron.edges_between(a, b);
        assert_eq!([0, 4, 1, 5].map(|to| composite(0, to)), [0, 1, 2, 2]);
        assert_eq!(composite(4, 9), 2);
    }

    #[test]
    fn sides_share_out_the_faces() {
        for kind in CellKind::ALL {
            let faces = (0..6).flat_map(|side| kind.faces_of_side(side));
            assert!(faces.eq(0..kind.shape().faces.len() as u8), "{kind}");
        }
    }
}
