//! Shape of the elements: Jacobians, volumes, areas and sizes.
//!
//! With the map `X(xi) = sum_a N_a(xi) X_a` of an element the Jacobian determinant is
//! `J = dX/dxi . (dX/deta x dX/dzeta)`; its sum over the quadrature points of the kind is
//! the exact volume. The scaled Jacobian of a corner is the triple product of the unit
//! vectors along three edges that meet there, over that of the regular cell: 1 at a
//! right angle of a hexahedron, 0 or less where the element is degenerate or inside out
//! (Knupp, SIAM J. Sci. Comput. 23 (2001) 193, doi:10.1137/S1064827500371499).

mod composite;

use crate::{CellKind, ElementId, Face, Mesh, MeshError, NodeId, Vec3};
use composite::composite_volumes;

/// Scaled Jacobians below this are listed in [`Quality::slivers`].
pub const SMALL_SCALED_JACOBIAN: f64 = 0.05;

/// Number of elements that [`Quality::poorest`] lists.
pub const POOREST: usize = 5;

/// Height of an element over its largest coordinate from which on its strain has digits.
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;

/// Shape of all elements of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// Smallest scaled Jacobian over all corners, 1 for a mesh of regular cells.
    pub smallest_scaled_jacobian: f64,
    /// The element that has it.
    pub worst: ElementId,
    /// The elements with the smallest scaled Jacobians, at most [`POOREST`], smallest first.
    pub poorest: Vec<(ElementId, f64)>,
    /// Smallest Jacobian determinant over corners and Gauss points.
    pub smallest_determinant: f64,
    /// Elements with a determinant that is not positive at a corner or Gauss point, or is round-off.
    pub inverted: Vec<ElementId>,
    /// Elements not inverted, but with a scaled Jacobian below [`SMALL_SCALED_JACOBIAN`].
    pub slivers: Vec<ElementId>,
    /// Volume of the mesh.
    pub volume: f64,
    /// Cube root of the mean volume of an element.
    pub characteristic_size: f64,
    /// Shortest edge.
    pub shortest_edge: f64,
    /// Longest edge.
    pub longest_edge: f64,
}

/// Jacobian determinant of a cell at natural coordinates `xi`.
pub fn jacobian_determinant(kind: CellKind, corners: &[Vec3], xi: [f64; 3]) -> f64 {
    let mut columns = [Vec3::zeros(); 3];
    let gradients = (kind.shape().gradients)(&Vec3::from(xi));
    for (x, gradient) in corners.iter().zip(gradients) {
        for axis in 0..3 {
            columns[axis] += x * gradient[axis];
        }
    }
    columns[0].dot(&columns[1].cross(&columns[2]))
}

/// Smallest scaled Jacobian over the corners of a cell.
pub fn scaled_jacobian(kind: CellKind, corners: &[Vec3]) -> f64 {
    let shape = kind.shape();
    edges(kind, corners)
        .map(|edges| triple_product(edges.map(|edge| edge.normalize())) / shape.regular)
        .fold(f64::INFINITY, minimum)
}

impl Mesh {
    /// Shape of all elements.
    ///
    /// An empty mesh has infinite smallest values and no volume.
    pub fn quality(&self) -> Quality {
        let mut quality = Quality {
            smallest_scaled_jacobian: f64::INFINITY,
            worst: ElementId(0),
            poorest: Vec::new(),
            smallest_determinant: f64::INFINITY,
            inverted: Vec::new(),
            slivers: Vec::new(),
            volume: self.volume(),
            characteristic_size: self.characteristic_size(),
            shortest_edge: f64::INFINITY,
            longest_edge: 0.0,
        };
        for (element, kind, nodes) in self.numbered() {
            quality.include(element, kind, &self.at(nodes));
        }
        quality
    }

    /// Checks that every element has positive Jacobian determinants.
    ///
    /// # Errors
    /// [`MeshError::Inverted`] names the first element that has not.
    pub fn check_shape(&self) -> Result<(), MeshError> {
        let mut inverted = self.numbered().filter_map(|(element, kind, nodes)| {
            let corners = self.at(nodes);
            let determinant = smallest_determinant(kind, &corners);
            (!has_volume(kind, determinant, &corners)).then_some((element, determinant))
        });
        match inverted.next() {
            None => Ok(()),
            Some((element, determinant)) => Err(MeshError::Inverted {
                count: 1 + inverted.count(),
                element,
                determinant,
            }),
        }
    }

    /// Volume of the mesh.
    pub fn volume(&self) -> f64 {
        self.numbered()
            .map(|(_, kind, nodes)| volume(kind, &self.at(nodes)))
            .sum()
    }

    /// Volume of an element, negative when it is inside out.
    pub fn element_volume(&self, element: ElementId) -> f64 {
        volume(self.kind(element), &self.element_positions(element))
    }

    /// Cube root of the mean volume of an element, 0 for an empty mesh.
    pub fn characteristic_size(&self) -> f64 {
        (self.volume() / self.element_count().max(1) as f64).cbrt()
    }

    /// Area of faces by 2 x 2 Gauss points, exact for plane faces: a triangle is a
    /// quadrilateral with one side of no length.
    pub fn area(&self, faces: &[Face]) -> f64 {
        faces
            .iter()
            .map(|&face| face_area(&self.face_positions(face)))
            .sum()
    }

    /// Integral of the outward unit normal over a face, exactly.
    pub fn area_vector(&self, face: Face) -> Vec3 {
        let [a, b, c, d] = self.face_positions(face);
        0.5 * (c - a).cross(&(d - b))
    }

    /// Elements with their ids and kinds.
    fn numbered(&self) -> impl Iterator<Item = (ElementId, CellKind, &[NodeId])> {
        let cells = self.blocks.iter();
        let cells = cells.flat_map(|block| block.cells().map(|corners| (block.kind, corners)));
        let cells = cells.enumerate();
        cells.map(|(index, (kind, corners))| (ElementId::new(index), kind, corners))
    }

    fn at(&self, nodes: &[NodeId]) -> Vec<Vec3> {
        let nodes = nodes.iter();
        nodes.map(|node| self.positions[node.index()]).collect()
    }
}

impl Quality {
    fn include(&mut self, element: ElementId, kind: CellKind, corners: &[Vec3]) {
        let determinant = smallest_determinant(kind, corners);
        let scaled = scaled_jacobian(kind, corners);
        if !has_volume(kind, determinant, corners) {
            self.inverted.push(element);
        } else if scaled < SMALL_SCALED_JACOBIAN {
            self.slivers.push(element);
        }
        if scaled.is_nan() || scaled < self.smallest_scaled_jacobian {
            self.smallest_scaled_jacobian = scaled;
            self.worst = element;
        }
        self.rank(element, scaled);
        self.smallest_determinant = minimum(self.smallest_determinant, determinant);
        for edge in edges(kind, corners).flatten() {
            let length = edge.norm();
            self.shortest_edge = self.shortest_edge.min(length);
            self.longest_edge = self.longest_edge.max(length);
        }
    }
}

impl Quality {
    /// Lists an element if it is among the poorest; of equals those with the lowest numbers.
    fn rank(&mut self, element: ElementId, scaled: f64) {
        let is_full = self.poorest.len() == POOREST;
        if is_full && self.poorest.last().is_some_and(|last| last.1 <= scaled) {
            return;
        }
        let at = self.poorest.partition_point(|known| known.1 <= scaled);
        self.poorest.insert(at, (element, scaled));
        self.poorest.truncate(POOREST);
    }
}

/// Three edges at every corner, right-handed.
fn edges(kind: CellKind, corners: &[Vec3]) -> impl Iterator<Item = [Vec3; 3]> {
    let trihedra = kind.shape().trihedra.iter();
    trihedra.map(|&[corner, a, b, c]| [a, b, c].map(|end| corners[end] - corners[corner]))
}

fn triple_product([a, b, c]: [Vec3; 3]) -> f64 {
    a.dot(&b.cross(&c))
}

/// Smallest Jacobian determinant over corners and quadrature points.
fn smallest_determinant(kind: CellKind, corners: &[Vec3]) -> f64 {
    let shape = kind.shape();
    let points = shape.points.iter();
    let is_composite = kind == CellKind::CompositeTetrahedron;
    let volumes = is_composite.then(|| composite_volumes(corners));
    edges(kind, corners)
        .map(|edges| triple_product(edges) * shape.corner_jacobian)
        .chain(points.map(|&(xi, _)| jacobian_determinant(kind, corners, xi)))
        .chain(volumes.into_iter().flatten().map(|volume| 24.0 * volume))
        .fold(f64::INFINITY, minimum)
}

fn volume(kind: CellKind, corners: &[Vec3]) -> f64 {
    let points = kind.shape().points.iter();
    points
        .map(|&(xi, weight)| jacobian_determinant(kind, corners, xi) * weight)
        .sum()
}

fn face_area(corners: &[Vec3; 4]) -> f64 {
    let [a, b, c, d] = corners;
    let g = 1.0 / 3f64.sqrt();
    [(-g, -g), (g, -g), (g, g), (-g, g)]
        .into_iter()
        .map(|(xi, eta)| {
            let along_xi = ((b - a) * (1.0 - eta) + (c - d) * (1.0 + eta)) * 0.25;
            let along_eta = ((d - a) * (1.0 - xi) + (c - b) * (1.0 + xi)) * 0.25;
            along_xi.cross(&along_eta).norm()
        })
        .sum()
}

/// The smaller of two numbers, NaN if one of them is.
fn minimum(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b { a } else { b }
}

/// True if a determinant can be divided by, and is positive beyond round-off: the height over the
/// largest parallelogram of edges beyond that of the positions.
fn has_volume(kind: CellKind, determinant: f64, corners: &[Vec3]) -> bool {
    let reach = corners.iter().map(Vec3::amax).fold(0.0, f64::max);
    let areas = edges(kind, corners).flat_map(|[a, b, c]| [a.cross(&b), b.cross(&c), c.cross(&a)]);
    let area = areas.map(|area| area.amax()).fold(0.0, f64::max);
    determinant.is_normal() && determinant > ROUND_OFF * reach * area
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CellBlock, generate::Block};

    fn hexahedron(corners: [Vec3; 8]) -> Mesh {
        let cell = CellBlock::hexahedra([[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)]);
        Mesh::new(corners.to_vec(), vec![cell]).unwrap()
    }

    fn cube() -> [Vec3; 8] {
        let corners = CellKind::Hexahedron.shape().corners;
        std::array::from_fn(|a| Vec3::from(corners[a]) * 0.5)
    }

    #[test]
    fn a_cube_is_perfect() {
        let quality = hexahedron(cube()).quality();
        assert!((quality.smallest_scaled_jacobian - 1.0).abs() < 1e-15);
        assert!((quality.smallest_determinant - 0.125).abs() < 1e-15);
        assert!((quality.volume - 1.0).abs() < 1e-15);
        assert!((quality.characteristic_size - 1.0).abs() < 1e-15);
        assert_eq!((quality.shortest_edge, quality.longest_edge), (1.0, 1.0));
        assert!(quality.inverted.is_empty() && quality.slivers.is_empty());
    }

    #[test]
    fn the_poorest_elements_are_listed_in_order() {
        let mut mesh = Block {
            divisions: [8, 1, 1],
            ..Block::default()
        }
        .mesh()
        .unwrap();
        let moved = mesh.corners(ElementId(6))[6];
        mesh.positions[moved.index()].z += 0.5;
        let poorest = mesh.quality().poorest;
        let ids: Vec<usize> = poorest.iter().map(|(element, _)| element.index()).collect();
        assert_eq!(poorest.len(), POOREST);
        assert_eq!(poorest[0].0, mesh.quality().worst);
        assert!(ids[..2].iter().all(|id| [6, 7].contains(id)), "{ids:?}");
        assert_eq!(ids[2..], [0, 1, 2]);
        assert!(poorest.windows(2).all(|pair| pair[0].1 <= pair[1].1));
    }

    #[test]
    fn a_sheared_cube_has_the_cosine() {
        let shear = 1.3;
        let corners = cube().map(|x| x + Vec3::x() * (shear * x.z));
        let quality = hexahedron(corners).quality();
        let cosine = 1.0 / (1.0 + shear * shear).sqrt();
        assert!((quality.smallest_scaled_jacobian - cosine).abs() < 1e-14);
        assert!((quality.volume - 1.0).abs() < 1e-14);
    }

    #[test]
    fn inverted_and_thin_elements_are_named() {
        let mut mesh = Block {
            divisions: [3, 1, 1],
            ..Block::default()
        }
        .mesh()
        .unwrap();
        for corner in 8..12 {
            mesh.blocks[0].nodes.swap(corner, corner + 4);
        }
        assert_eq!(mesh.quality().inverted, [ElementId(1)]);
        assert!(matches!(
            mesh.check_shape(),
            Err(MeshError::Inverted { count: 1, element: ElementId(1), determinant }) if determinant < 0.0
        ));
        let corners = cube().map(|x| x + Vec3::x() * (30.0 * x.z));
        assert_eq!(hexahedron(corners).quality().slivers, [ElementId(0)]);
    }

    #[test]
    fn elements_flat_to_round_off_are_degenerate_and_thin_ones_are_not() {
        let of = |size: [f64; 3]| {
            let mesh = hexahedron(cube().map(|x| x.component_mul(&Vec3::from(size))));
            mesh.check_shape()
        };
        for thin in [
            [1.0, 1.0, 1e-12],
            [1.0, 1e-12, 1e-12],
            [1e-90; 3],
            [1e90; 3],
        ] {
            assert_eq!(of(thin), Ok(()), "{thin:?}");
        }
        for flat in [
            [1.0, 1.0, 1e-309],
            [1.0, 1.0, 1e-15],
            [1e-105; 3],
            [1e105; 3],
        ] {
            assert!(
                matches!(of(flat), Err(MeshError::Inverted { .. })),
                "{flat:?}"
            );
        }
        let far = hexahedron(cube().map(|x| x * 1e-9 + Vec3::repeat(1e6)));
        assert!(far.check_shape().is_err());
    }

    #[test]
    fn volume_agrees_with_the_divergence_theorem() {
        // V = 1/3 sum over faces of the integral of x . n; on a bilinear face
        // x . (dx/dxi x dx/deta) is quadratic in each coordinate: 2 x 2 Gauss is exact.
        let mut corners = cube();
        corners[6] += Vec3::new(0.2, 0.15, 0.3);
        corners[0] += Vec3::new(-0.1, 0.05, 0.2);
        let mesh = hexahedron(corners);
        let g = 1.0 / 3f64.sqrt();
        let mut volume = 0.0;
        let mut closed = Vec3::zeros();
        for face in mesh.boundary_faces() {
            closed += mesh.area_vector(face);
            let [a, b, c, d] = mesh.face_positions(face);
            for (xi, eta) in [(-g, -g), (g, -g), (g, g), (-g, g)] {
                let n = [
                    (1.0 - xi) * (1.0 - eta),
                    (1.0 + xi) * (1.0 - eta),
                    (1.0 + xi) * (1.0 + eta),
                    (1.0 - xi) * (1.0 + eta),
                ]
                .map(|v| v / 4.0);
                let x = a * n[0] + b * n[1] + c * n[2] + d * n[3];
                let along_xi = ((b - a) * (1.0 - eta) + (c - d) * (1.0 + eta)) * 0.25;
                let along_eta = ((d - a) * (1.0 - xi) + (c - b) * (1.0 + xi)) * 0.25;
                volume += x.dot(&along_xi.cross(&along_eta)) / 3.0;
            }
        }
        assert!(closed.norm() < 1e-15);
        assert!((volume - mesh.volume()).abs() < 1e-14);
    }
}
