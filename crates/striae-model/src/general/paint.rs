//! Textures of parts of the surface that they are painted on.

use std::collections::BTreeSet;

use striae_mesh::{Face, Mesh, NodeId};
use striae_surface::{node::SurfaceNode, texture::Paint};

/// The paint of a surface on some of its faces.
pub(super) fn restricted(paint: &Paint, mesh: &Mesh, whole: &[Face], faces: &[Face]) -> Paint {
    let known = nodes(mesh, whole);
    let kept: Vec<usize> = nodes(mesh, faces)
        .iter()
        .filter_map(|node| known.binary_search(node).ok())
        .collect();
    match paint {
        // A list of another length is a fault that its painting finds.
        Paint::Nodal(directions) if directions.len() == known.len() => {
            Paint::Nodal(kept.iter().map(|&at| directions[at]).collect())
        }
        Paint::Nodes { directions, width } => {
            let position = |node: SurfaceNode| kept.binary_search(&node.index()).ok();
            let directions = directions.iter().filter_map(|(node, direction)| {
                Some((SurfaceNode::new(position(*node)?), *direction))
            });
            Paint::Nodes {
                directions: directions.collect(),
                width: *width,
            }
        }
        paint => paint.clone(),
    }
}

/// Nodes of a surface, ascending.
fn nodes(mesh: &Mesh, faces: &[Face]) -> Vec<NodeId> {
    let nodes = faces.iter().flat_map(|face| mesh.face_nodes(*face));
    nodes.collect::<BTreeSet<NodeId>>().into_iter().collect()
}
