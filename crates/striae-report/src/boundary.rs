//! The skin of a mesh: faces that belong to one cell only, and all flat cells.

use std::collections::{BTreeSet, HashMap};

use striae_output::vtk::StoredCells;

use crate::cell::{Face, faces, is_flat};

/// A surface in triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// Nodes of the mesh that lie on it, in the order of the mesh.
    pub nodes: Vec<usize>,
    /// Corners of the triangles, counter-clockwise seen from outside, as places in `nodes`.
    pub triangles: Vec<[u32; 3]>,
    /// Edges of the faces, each once.
    pub edges: Vec<[u32; 2]>,
}

impl Skin {
    /// The skin of cells.
    ///
    /// # Errors
    /// The shape of a cell that cannot be shown.
    pub fn of(cells: &StoredCells) -> Result<Self, u8> {
        let (mut flat, mut solid) = (Vec::new(), Vec::new());
        for (shape, corners) in cells.iter() {
            let faces = faces(shape, corners).ok_or(shape)?;
            let to = if is_flat(shape) {
                &mut flat
            } else {
                &mut solid
            };
            to.extend(faces);
        }
        let mut count: HashMap<Vec<usize>, u32> = HashMap::with_capacity(solid.len());
        for face in &solid {
            *count.entry(face.key()).or_default() += 1;
        }
        solid.retain(|face| count[&face.key()] == 1);
        solid.extend(flat);
        Ok(Self::from(solid))
    }
}

impl From<Vec<Face>> for Skin {
    fn from(faces: Vec<Face>) -> Self {
        let on = faces
            .iter()
            .flat_map(|face| face.outline.iter().chain(&face.inside));
        let nodes: BTreeSet<usize> = on.copied().collect();
        let nodes: Vec<usize> = nodes.into_iter().collect();
        let places = nodes
            .iter()
            .enumerate()
            .map(|(at, node)| (*node, at as u32));
        let place: HashMap<usize, u32> = places.collect();
        // A triangle may come as a quadrilateral that repeats a corner.
        let triangles = faces.iter().flat_map(Face::triangles);
        let triangles = triangles.filter(|[a, b, c]| a != b && b != c && c != a);
        let edges = faces.iter().flat_map(Face::edges).filter(|[a, b]| a != b);
        let edges: BTreeSet<[usize; 2]> = edges.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        Self {
            triangles: triangles
                .map(|corners| corners.map(|node| place[&node]))
                .collect(),
            edges: edges
                .into_iter()
                .map(|ends| ends.map(|node| place[&node]))
                .collect(),
            nodes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_hexahedra_share_a_face_that_is_not_skin() {
        let cells = StoredCells {
            corners: vec![0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11],
            ends: vec![8, 16],
            shapes: vec![12, 12],
        };
        let skin = Skin::of(&cells).unwrap();
        assert_eq!(skin.nodes.len(), 12);
        assert_eq!(skin.triangles.len(), 20);
        assert_eq!(skin.edges.len(), 20);
    }

    #[test]
    fn triangles_as_quadrilaterals_have_no_empty_half() {
        let cells = StoredCells {
            corners: vec![5, 2, 9, 9],
            ends: vec![4],
            shapes: vec![9],
        };
        let skin = Skin::of(&cells).unwrap();
        assert_eq!(skin.nodes, [2, 5, 9]);
        assert_eq!(skin.triangles, [[1, 0, 2]]);
        assert_eq!(skin.edges, [[0, 1], [0, 2], [1, 2]]);
    }

    #[test]
    fn unknown_shapes_are_named() {
        let cells = StoredCells {
            corners: vec![0, 1],
            ends: vec![2],
            shapes: vec![3],
        };
        assert_eq!(Skin::of(&cells), Err(3));
    }
}
