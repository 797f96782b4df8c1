//! Mass matrices of elements, with the mass of contact nodes moved where that is asked for.

use crate::{
    element::redistributed,
    model::{ContactMass, Model, Side},
    problem::Problem,
};

impl Problem {
    /// Mass matrix of an element of a body.
    pub fn mass(&self, body: usize, element: usize) -> [[f64; 8]; 8] {
        let model = &self.model.bodies[body];
        let mass = self.elements[body][element].mass(model.density);
        let nodes = model.mesh.elements[element].map(|node| self.node(body, node));
        let massless = nodes.map(|node| self.massless[node]);
        if massless.contains(&true) {
            redistributed(&mass, &massless)
        } else {
            mass
        }
    }
}

/// Nodes of contact surfaces of bodies whose mass is redistributed, but for elements
/// that have no other nodes.
pub(crate) fn massless(model: &Model, first_node: &[usize], nodes: usize) -> Vec<bool> {
    let mut massless = vec![false; nodes];
    let sides = model.pairs.iter().flat_map(|pair| [&pair.a, &pair.b]);
    for side in sides {
        if let Side::Deformable { body, faces } = side
            && model.bodies[body.0].contact_mass == ContactMass::Redistributed
        {
            for node in model.bodies[body.0].mesh.nodes_of_faces(faces) {
                massless[first_node[body.0] + node.index()] = true;
            }
        }
    }
    for (body, first) in model.bodies.iter().zip(first_node) {
        for corners in &body.mesh.elements {
            let nodes = corners.map(|node| first + node.index());
            if nodes.iter().all(|&node| massless[node]) {
                nodes.iter().for_each(|&node| massless[node] = false);
            }
        }
    }
    massless
}
