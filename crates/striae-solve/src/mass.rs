//! Quantities derived from the mass of all bodies.

use striae_mesh::{ElementId, Vec3};

use crate::{problem::Problem, state::State};
use striae_model::node::GlobalNode;

/// `M v`, node by node; collective.
pub fn mass_times(problem: &Problem, vectors: &[Vec3]) -> Vec<Vec3> {
    let mut product = vec![Vec3::zeros(); vectors.len()];
    for (body, model) in problem.model.bodies.iter().enumerate() {
        if !model.has_mass() {
            continue;
        }
        for (at, corners) in model.mesh.elements().enumerate() {
            let nodes = problem.nodes(body, corners);
            let mass = problem.masses[body].of_element(ElementId::new(at));
            for (&row, mass) in nodes.iter().zip(mass.chunks_exact(nodes.len())) {
                for (&column, mass) in nodes.iter().zip(mass) {
                    product[row] += vectors[column] * *mass;
                }
            }
        }
    }
    problem.share.sum_at_nodes(&mut [&mut product]);
    for &(node, mass) in &problem.mass_points {
        product[node] += vectors[node] * mass;
    }
    product
}

/// `v . M v / 2`; collective.
pub fn kinetic_energy(problem: &Problem, velocities: &[Vec3]) -> f64 {
    let momentum = mass_times(problem, velocities);
    0.5 * product(problem, &momentum, velocities)
}

/// `a . b` over all nodes; collective.
pub(crate) fn product(problem: &Problem, a: &[Vec3], b: &[Vec3]) -> f64 {
    let own = problem.own_nodes().map(|node| a[node].dot(&b[node]));
    problem.share.sum(own.sum())
}

/// Linear momentum and angular momentum about the origin; collective.
pub fn momentum(problem: &Problem, state: &State) -> (Vec3, Vec3) {
    let nodal = mass_times(problem, &state.velocities);
    let turning = |node: GlobalNode| state.positions[node].cross(&nodal[node]);
    let mut sums = [
        problem.own_nodes().map(|node| nodal[node]).sum(),
        problem.own_nodes().map(turning).sum(),
    ];
    problem.share.sum_vectors(&mut sums);
    let [linear, angular] = sums;
    (linear, angular)
}
