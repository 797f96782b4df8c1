//! Mass matrices of elements, with the mass of contact nodes moved where that is asked for.

use striae_element::{Mass, redistributed};
use striae_mesh::ElementId;

use crate::{
    model::{ContactMass, Model, Side},
    problem::Problem,
};

impl Problem {
    /// Mass matrix of an element of a body.
    pub fn mass(&self, body: usize, element: ElementId) -> Mass {
        let model = &self.model.bodies[body];
        let element_of_body = self.elements[body].get(element);
        let mass = element_of_body.mass(self.density(body, element));
        let corners = model.mesh.corners(element).iter();
        let massless = corners.map(|&node| self.massless[self.node(body, node)]);
        if massless.clone().any(|massless| massless) {
            let massless: Vec<bool> = massless.collect();
            redistributed(element_of_body.kind(), &mass, &massless)
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
        for corners in body.mesh.elements() {
            let nodes = || corners.iter().map(|node| first + node.index());
            if nodes().all(|node| massless[node]) {
                nodes().for_each(|node| massless[node] = false);
            }
        }
    }
    massless
}
