//! Nodes whose mass is moved to others.

use striae_model::{ContactMass, ContactSurface, Model};

/// Nodes of contact surfaces of bodies whose mass is redistributed, but for elements
/// that have no other nodes.
pub(crate) fn massless(model: &Model, first_node: &[usize]) -> Vec<bool> {
    let mut massless = vec![false; first_node[model.bodies.len()]];
    let sides = model.pairs.iter().flat_map(|pair| [&pair.a, &pair.b]);
    for side in sides {
        if let ContactSurface::Deformable { body, faces } = side
            && model.bodies[body.0].contact_mass == ContactMass::Redistributed
        {
            for node in model.bodies[body.0].mesh.nodes_of_faces(faces) {
                massless[first_node[body.0] + node.index()] = true;
            }
        }
    }
    for (body, first) in model.bodies.iter().zip(first_node) {
        for corners in body.mesh.elements() {
            let nodes = || corners.iter().map(|node| first + node.index());
            if nodes().all(|node| massless[node]) {
                nodes().for_each(|node| massless[node] = false);
            }
        }
    }
    massless
}
