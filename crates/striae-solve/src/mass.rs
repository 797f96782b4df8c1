//! Consistent mass of all bodies, and what follows from it.

use striae_element::{Mass, redistributed};
use striae_mesh::{ElementId, Vec3};

use crate::{problem::Problem, state::State};

impl Problem {
    /// Mass matrix of an element of a body, with the mass of contact nodes moved where
    /// that is asked for.
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

/// `M v`, node by node.
pub fn mass_times(problem: &Problem, vectors: &[Vec3]) -> Vec<Vec3> {
    let mut product = vec![Vec3::zeros(); vectors.len()];
    for (body, model) in problem.model.bodies.iter().enumerate() {
        if !model.has_mass() {
            continue;
        }
        for (at, corners) in model.mesh.elements().enumerate() {
            let nodes = problem.nodes(body, corners);
            let mass = problem.mass(body, ElementId::new(at));
            for a in 0..nodes.len() {
                for b in 0..nodes.len() {
                    product[nodes[a]] += vectors[nodes[b]] * mass[a][b];
                }
            }
        }
    }
    for &(node, mass) in &problem.mass_points {
        product[node] += vectors[node] * mass;
    }
    product
}

/// `v . M v / 2`.
pub fn kinetic_energy(problem: &Problem, velocities: &[Vec3]) -> f64 {
    let momentum = mass_times(problem, velocities);
    let products = momentum.iter().zip(velocities);
    0.5 * products.map(|(p, v)| p.dot(v)).sum::<f64>()
}

/// Linear momentum and angular momentum about the origin.
pub fn momentum(problem: &Problem, state: &State) -> (Vec3, Vec3) {
    let nodal = mass_times(problem, &state.velocities);
    let turning = nodal.iter().zip(&state.positions);
    (nodal.iter().sum(), turning.map(|(p, x)| x.cross(p)).sum())
}
