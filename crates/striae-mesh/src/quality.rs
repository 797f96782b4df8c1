//! Shape of the elements: Jacobians, volumes, areas and sizes.
//!
//! With the trilinear map `X(xi)` of an element the Jacobian determinant is
//! `J = dX/dxi . (dX/deta x dX/dzeta)`, `8 J = volume` for a parallelepiped.
//! It is of degree two in each coordinate, so that the sum over the 2 x 2 x 2
//! Gauss points is the exact volume. The scaled Jacobian of a corner is the
//! triple product of the unit vectors along its three edges: 1 at a right
//! angle, 0 or less where the element is degenerate or inside out
//! (Knupp, SIAM J. Sci. Comput. 23 (2001) 193, doi:10.1137/S1064827500371499).

use crate::{ElementId, Face, Mesh, MeshError, Vec3};

/// Signs of the natural coordinates of the eight corners.
pub const CORNERS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// Scaled Jacobians below this are listed in [`Quality::slivers`].
pub const SMALL_SCALED_JACOBIAN: f64 = 0.05;

/// Shape of all elements of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// Smallest scaled Jacobian over all corners, 1 for a mesh of bricks.
    pub smallest_scaled_jacobian: f64,
    /// The element that has it.
    pub worst: ElementId,
    /// Smallest Jacobian determinant over corners and Gauss points.
    pub smallest_determinant: f64,
    /// Elements with a determinant that is not positive at a corner or Gauss point.
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

/// Jacobian determinant of a hexahedron at natural coordinates `xi`.
pub fn jacobian_determinant(corners: &[Vec3; 8], xi: [f64; 3]) -> f64 {
    let mut columns = [Vec3::zeros(); 3];
    for (x, s) in corners.iter().zip(&CORNERS) {
        let f = [0, 1, 2].map(|axis| 1.0 + s[axis] * xi[axis]);
        columns[0] += x * (0.125 * s[0] * f[1] * f[2]);
        columns[1] += x * (0.125 * f[0] * s[1] * f[2]);
        columns[2] += x * (0.125 * f[0] * f[1] * s[2]);
    }
    columns[0].dot(&columns[1].cross(&columns[2]))
}

/// Smallest triple product of unit edge vectors over the eight corners.
pub fn scaled_jacobian(corners: &[Vec3; 8]) -> f64 {
    (0..8)
        .map(|corner| {
            let [a, b, c] = EDGES[corner].map(|end| (corners[end] - corners[corner]).normalize());
            a.dot(&b.cross(&c))
        })
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
            smallest_determinant: f64::INFINITY,
            inverted: Vec::new(),
            slivers: Vec::new(),
            volume: self.volume(),
            characteristic_size: self.characteristic_size(),
            shortest_edge: f64::INFINITY,
            longest_edge: 0.0,
        };
        for index in 0..self.elements.len() {
            let element = ElementId::new(index);
            quality.include(element, &self.element_positions(element));
        }
        quality
    }

    /// Checks that every element has positive Jacobian determinants.
    ///
    /// # Errors
    /// [`MeshError::Inverted`] names the first element that has not.
    pub fn check_shape(&self) -> Result<(), MeshError> {
        let determinant = |element| smallest_determinant(&self.element_positions(element));
        let mut inverted = (0..self.elements.len())
            .map(ElementId::new)
            .filter(|&element| !is_positive(determinant(element)));
        match inverted.next() {
            None => Ok(()),
            Some(element) => Err(MeshError::Inverted {
                count: 1 + inverted.count(),
                element,
                determinant: determinant(element),
            }),
        }
    }

    /// Volume of the mesh.
    pub fn volume(&self) -> f64 {
        (0..self.elements.len())
            .map(|index| self.element_volume(ElementId::new(index)))
            .sum()
    }

    /// Volume of an element, negative when it is inside out.
    pub fn element_volume(&self, element: ElementId) -> f64 {
        let corners = self.element_positions(element);
        gauss_points()
            .map(|xi| jacobian_determinant(&corners, xi))
            .sum()
    }

    /// Cube root of the mean volume of an element, 0 for an empty mesh.
    pub fn characteristic_size(&self) -> f64 {
        (self.volume() / self.elements.len().max(1) as f64).cbrt()
    }

    /// Area of faces by 2 x 2 Gauss points, exact for plane faces.
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
}

impl Quality {
    fn include(&mut self, element: ElementId, corners: &[Vec3; 8]) {
        let determinant = smallest_determinant(corners);
        let scaled = scaled_jacobian(corners);
        if !is_positive(determinant) {
            self.inverted.push(element);
        } else if scaled < SMALL_SCALED_JACOBIAN {
            self.slivers.push(element);
        }
        if scaled.is_nan() || scaled < self.smallest_scaled_jacobian {
            self.smallest_scaled_jacobian = scaled;
            self.worst = element;
        }
        self.smallest_determinant = minimum(self.smallest_determinant, determinant);
        for corner in 0..8 {
            for end in EDGES[corner] {
                let length = (corners[end] - corners[corner]).norm();
                self.shortest_edge = self.shortest_edge.min(length);
                self.longest_edge = self.longest_edge.max(length);
            }
        }
    }
}

/// The ends of the three edges of every corner, right-handed.
const EDGES: [[usize; 3]; 8] = [
    [1, 3, 4],
    [2, 0, 5],
    [3, 1, 6],
    [0, 2, 7],
    [7, 5, 0],
    [4, 6, 1],
    [5, 7, 2],
    [6, 4, 3],
];

fn smallest_determinant(corners: &[Vec3; 8]) -> f64 {
    CORNERS
        .into_iter()
        .chain(gauss_points())
        .map(|xi| jacobian_determinant(corners, xi))
        .fold(f64::INFINITY, minimum)
}

fn gauss_points() -> impl Iterator<Item = [f64; 3]> {
    let g = 1.0 / 3f64.sqrt();
    CORNERS.into_iter().map(move |corner| corner.map(|s| s * g))
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

fn is_positive(value: f64) -> bool {
    value > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NodeId;
    use crate::generate::Block;

    fn hexahedron(corners: [Vec3; 8]) -> Mesh {
        Mesh::new(corners.to_vec(), vec![[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)]).unwrap()
    }

    fn cube() -> [Vec3; 8] {
        CORNERS.map(|c| Vec3::from(c) * 0.5)
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
        mesh.elements[1].swap(0, 4);
        mesh.elements[1].swap(1, 5);
        mesh.elements[1].swap(2, 6);
        mesh.elements[1].swap(3, 7);
        assert_eq!(mesh.quality().inverted, [ElementId(1)]);
        assert!(matches!(
            mesh.check_shape(),
            Err(MeshError::Inverted { count: 1, element: ElementId(1), determinant }) if determinant < 0.0
        ));
        let corners = cube().map(|x| x + Vec3::x() * (30.0 * x.z));
        assert_eq!(hexahedron(corners).quality().slivers, [ElementId(0)]);
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
