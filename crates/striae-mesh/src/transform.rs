//! Renumbered and moved copies of a mesh.
//!
//! No result may depend on the numbering or on the frame; tests use these maps to check that.

use crate::{CellBlock, ElementId, Face, Mesh, MeshError, NodeId, Sets, Vec3, random::Random};
use nalgebra::Rotation3;

/// New numbers of nodes and elements, by old number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renumbering {
    /// New number of every node.
    pub nodes: Vec<NodeId>,
    /// New number of every element.
    pub elements: Vec<ElementId>,
}

impl Renumbering {
    /// A random renumbering, the same for the same seed.
    pub fn shuffled(mesh: &Mesh, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let nodes = random.permutation(mesh.positions.len());
        let elements = random.permutation(mesh.element_count());
        Self {
            nodes: nodes.into_iter().map(NodeId::new).collect(),
            elements: elements.into_iter().map(ElementId::new).collect(),
        }
    }

    /// The renumbering that takes the new numbers back to the old ones.
    ///
    /// # Errors
    /// [`MeshError::NotPermutation`] when a number is repeated or out of range.
    pub fn inverse(&self) -> Result<Self, MeshError> {
        let nodes: Vec<usize> = self.nodes.iter().map(|id| id.index()).collect();
        let elements: Vec<usize> = self.elements.iter().map(|id| id.index()).collect();
        let nodes = inverse(&nodes, nodes.len(), "node")?;
        let elements = inverse(&elements, elements.len(), "element")?;
        Ok(Self {
            nodes: nodes.into_iter().map(NodeId::new).collect(),
            elements: elements.into_iter().map(ElementId::new).collect(),
        })
    }
}

impl Mesh {
    /// Copy of the mesh with renumbered nodes and elements.
    ///
    /// # Errors
    /// Returns [`MeshError::NotPermutation`] if the new numbers do not fit the mesh.
    pub fn renumbered(&self, renumbering: &Renumbering) -> Result<Self, MeshError> {
        let Renumbering { nodes, elements } = renumbering;
        let counts = (self.positions.len(), self.element_count());
        check_count(nodes.len(), counts.0, "node")?;
        check_count(elements.len(), counts.1, "element")?;
        let old = renumbering.inverse()?;
        let node = |id: NodeId| nodes[id.index()];
        let element = |id: ElementId| elements[id.index()];
        let face = |face: Face| Face {
            element: element(face.element),
            ..face
        };
        let cells = old.elements.iter();
        let mut blocks = CellBlock::runs(cells.map(|&id| (self.kind(id), self.corners(id))));
        for corner in blocks.iter_mut().flat_map(|block| &mut block.nodes) {
            *corner = node(*corner);
        }
        Ok(Self {
            positions: old
                .nodes
                .iter()
                .map(|id| self.positions[id.index()])
                .collect(),
            blocks,
            node_sets: mapped(&self.node_sets, node),
            facet_sets: mapped(&self.facet_sets, face),
            element_sets: mapped(&self.element_sets, element),
        })
    }

    /// The mesh turned about the origin and then shifted, `X' = R X + t`.
    pub fn moved(&self, rotation: &Rotation3<f64>, translation: &Vec3) -> Self {
        Self {
            positions: self
                .positions
                .iter()
                .map(|x| rotation * x + translation)
                .collect(),
            ..self.clone()
        }
    }
}

fn mapped<T: Ord + Copy>(sets: &Sets<T>, map: impl Fn(T) -> T) -> Sets<T> {
    let mut result = Sets::default();
    for (name, members) in sets.iter() {
        result.insert(name, members.iter().map(|&member| map(member)));
    }
    result
}

fn check_count(found: usize, count: usize, what: &'static str) -> Result<(), MeshError> {
    if found == count {
        return Ok(());
    }
    Err(MeshError::NotPermutation {
        what,
        count,
        position: found.min(count),
    })
}

fn inverse(numbers: &[usize], count: usize, what: &'static str) -> Result<Vec<usize>, MeshError> {
    let mut old = vec![usize::MAX; count];
    for (position, &number) in numbers.iter().enumerate() {
        if number >= count || old[number] != usize::MAX {
            return Err(MeshError::NotPermutation {
                what,
                count,
                position,
            });
        }
        old[number] = position;
    }
    Ok(old)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Block;

    fn block() -> Mesh {
        Block {
            divisions: [3, 2, 4],
            irregularity: 0.15,
            ..Block::default()
        }
        .mesh()
        .unwrap()
    }

    #[test]
    fn renumbering_goes_there_and_back() {
        let mesh = block();
        let renumbering = Renumbering::shuffled(&mesh, 3);
        let other = mesh.renumbered(&renumbering).unwrap();
        assert_ne!(other, mesh);
        other.check().unwrap();
        assert_eq!(
            other.renumbered(&renumbering.inverse().unwrap()).unwrap(),
            mesh
        );
    }

    #[test]
    fn renumbering_keeps_the_geometry_of_sets() {
        let mesh = block();
        let other = mesh.renumbered(&Renumbering::shuffled(&mesh, 11)).unwrap();
        assert!((mesh.volume() - other.volume()).abs() < 1e-14);
        for (name, faces) in mesh.facet_sets.iter() {
            let others = other.facet_sets.get(name).unwrap();
            assert_eq!(faces.len(), others.len());
            assert!((mesh.area(faces) - other.area(others)).abs() < 1e-14);
            assert_eq!(
                other.node_sets.get(name).unwrap(),
                other.nodes_of_faces(others)
            );
        }
    }

    #[test]
    fn wrong_numbers_are_refused() {
        let mesh = block();
        let mut renumbering = Renumbering::shuffled(&mesh, 1);
        renumbering.nodes[5] = renumbering.nodes[2];
        assert!(matches!(
            mesh.renumbered(&renumbering),
            Err(MeshError::NotPermutation {
                what: "node",
                position: 5,
                ..
            })
        ));
        let mut renumbering = Renumbering::shuffled(&mesh, 1);
        renumbering.elements.pop();
        assert!(matches!(
            mesh.renumbered(&renumbering),
            Err(MeshError::NotPermutation {
                what: "element",
                count: 24,
                position: 23
            })
        ));
    }

    #[test]
    fn rigid_motion_keeps_the_shape() {
        let mesh = block();
        let rotation = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
        let shift = Vec3::new(4.0, -2.0, 0.5);
        let there = mesh.moved(&rotation, &shift);
        let (a, b) = (mesh.quality(), there.quality());
        assert!((a.volume - b.volume).abs() < 1e-13);
        assert!((a.smallest_scaled_jacobian - b.smallest_scaled_jacobian).abs() < 1e-13);
        let back = rotation.inverse();
        let home = there.moved(&back, &-(back * shift));
        for (x, y) in mesh.positions.iter().zip(&home.positions) {
            assert!((x - y).norm() < 1e-14);
        }
    }
}
