//! Cuts across the borders of what ranks hold of a body.

use striae_mesh::{Mesh, NodeId, sorted_face};

use crate::{problem::Problem, share::Share};

/// Exchange of a cut with other ranks; nothing is exchanged if this rank has the whole body. All
/// functions are collective.
pub(super) struct Borders<'a> {
    shared: Option<(&'a Problem, usize)>,
}

impl<'a> Borders<'a> {
    /// Borders of a mesh that no other rank has a part of.
    pub(super) fn of_whole() -> Self {
        Self { shared: None }
    }

    /// Borders of a body.
    pub(super) fn new(problem: &'a Problem, body: usize) -> Self {
        let is_shared = problem.share.holding().is_some();
        Self {
            shared: is_shared.then_some((problem, body)),
        }
    }

    /// Flags that are set on any rank.
    pub(super) fn any_of<const N: usize>(&self, own: [bool; N]) -> Vec<bool> {
        match self.shared {
            None => own.to_vec(),
            Some((problem, _)) => problem.share.any_of(own.into_iter()),
        }
    }

    /// Nodes of the mesh at which something is so on a rank that holds them.
    pub(super) fn any_at_nodes(&self, own: Vec<bool>) -> Vec<bool> {
        let Some((problem, body)) = self.shared else {
            return own;
        };
        let mut all = vec![false; problem.reference.len()];
        let range = problem.first_node[body]..problem.first_node[body + 1];
        all[range.clone()].copy_from_slice(&own);
        problem.share.any_at_nodes(&all)[range].to_vec()
    }

    /// Faces of elements in front on other ranks with nodes that this one holds, sorted.
    pub(super) fn in_front(&self, mesh: &Mesh, is_behind: &[bool]) -> Vec<[NodeId; 4]> {
        let Some((Problem { share, .. }, body)) = self.shared else {
            return Vec::new();
        };
        let faces = mesh.boundary_faces().into_iter();
        let in_front = faces.filter(|face| !is_behind[face.element.index()]);
        let nodes = in_front.flat_map(|face| mesh.face_nodes(face));
        let numbers = nodes.map(|node| share.whole_mesh_node(body, node).0);
        let told: Vec<u8> = numbers.flat_map(u32::to_le_bytes).collect();
        let all = share.team().gather(&told);
        all.iter()
            .flat_map(|told| local_faces(share, body, told))
            .collect()
    }
}

/// Faces that a rank reports, as far as this one holds their nodes.
fn local_faces(share: &Share, body: usize, told: &[u8]) -> Vec<[NodeId; 4]> {
    let numbers: Vec<NodeId> = (told.as_chunks().0.iter())
        .map(|bytes| NodeId(u32::from_le_bytes(*bytes)))
        .collect();
    let faces = numbers
        .as_chunks()
        .0
        .iter()
        .filter_map(|face: &[NodeId; 4]| {
            let mut local = *face;
            for node in &mut local {
                *node = share.local_mesh_node(body, *node)?;
            }
            Some(sorted_face(local))
        });
    faces.collect()
}
