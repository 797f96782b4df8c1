//! Mass, gravity and the weights of time integration.
//!
//! An element contributes
//!
//! ```text
//! (1 - a_f) (f_int - m g) + m a_alpha,    tangent (1 - a_f) K + m da_alpha/dx,
//! ```
//!
//! and every node the part `a_f (f_int - f_ext)_0` of the last converged state.
//! Without inertia `a_f = 0` and `a_alpha = 0`.

use striae_element::{ElementResponse, Mass};
use striae_mesh::Vec3;

use super::{Imposed, System, Trial};

/// What elements need of the increment.
pub(super) struct Inertia {
    /// `1 - a_f`.
    pub(super) share_of_end: f64,
    gravity: Vec3,
    /// `a_alpha` of every node; none without inertia.
    accelerations: Option<Vec<Vec3>>,
    /// `d a_alpha / d x`.
    pub(super) stiffness: f64,
}

impl Inertia {
    pub(super) fn new(trial: &Trial, imposed: &Imposed) -> Self {
        let motion = imposed.motion.as_ref();
        Self {
            share_of_end: 1.0 - motion.map_or(0.0, |motion| motion.scheme().alpha_f),
            gravity: imposed.gravity,
            accelerations: motion
                .map(|motion| motion.weighted_accelerations(&trial.positions, &imposed.rates)),
            stiffness: motion.map_or(0.0, |motion| motion.stiffness()),
        }
    }
}

impl System<'_> {
    /// Weighs the response of an element and adds its mass and weight.
    pub(super) fn weigh(
        &mut self,
        nodes: &[usize],
        mass: Option<&Mass>,
        response: &mut ElementResponse,
    ) {
        let share = self.inertia.share_of_end;
        for (force, &node) in response.force.iter().zip(nodes) {
            self.forces.internal[node] += Vec3::from(*force);
        }
        if share != 1.0 {
            let forces = response.force.as_flattened_mut().iter_mut();
            forces.for_each(|f| *f *= share);
            response.stiffness.scale(share);
        }
        let Some(mass) = mass else { return };
        for a in 0..nodes.len() {
            let total: f64 = mass[a].iter().sum();
            let weight = self.inertia.gravity * total;
            self.forces.applied[nodes[a]] += weight;
            let mut force = -weight * share;
            if let Some(accelerations) = &self.inertia.accelerations {
                let shares = nodes.iter().zip(&mass[a]);
                let inertia: Vec3 = shares.map(|(&node, m)| accelerations[node] * *m).sum();
                self.forces.inertia[nodes[a]] += inertia;
                force += inertia;
            }
            for axis in 0..3 {
                response.force[a][axis] += force[axis];
            }
        }
        if self.inertia.stiffness > 0.0 {
            self.add_mass(nodes, mass, response);
        }
    }

    fn add_mass(&self, nodes: &[usize], mass: &Mass, response: &mut ElementResponse) {
        for b in 0..nodes.len() {
            for axis in 0..3 {
                if self.context.fixed[3 * nodes[b] + axis] {
                    continue;
                }
                for a in 0..nodes.len() {
                    let value = mass[a][b] * self.inertia.stiffness;
                    response.stiffness.add_along(axis, a, b, value);
                }
            }
        }
    }

    /// Inertia and weight of the point masses of rigid bodies.
    pub(super) fn point_masses(&mut self) {
        let share = self.inertia.share_of_end;
        for &(node, mass) in &self.context.problem.mass_points {
            let weight = self.inertia.gravity * mass;
            self.forces.applied[node] += weight;
            let mut force = -weight * share;
            if let Some(accelerations) = &self.inertia.accelerations {
                self.forces.inertia[node] = accelerations[node] * mass;
                force += self.forces.inertia[node];
            }
            self.add_point(node, &force, mass * self.inertia.stiffness);
        }
    }

    /// Adds a force and a stiffness at a node.
    pub(super) fn add_point(&mut self, node: usize, force: &Vec3, stiffness: f64) {
        let first = self.layout.position(node);
        let unknowns = [first, first + 1, first + 2];
        let mut tangent = [0.0; 9];
        for at in [0, 4, 8] {
            tangent[at] = stiffness;
        }
        self.add_dense(&[node], &unknowns, force.as_slice(), &tangent)
            .expect("the unknowns of a body are in the pattern");
    }

    /// Forces carried over from the last converged state.
    pub(super) fn carried(&mut self, imposed: &Imposed) {
        let Some(motion) = &imposed.motion else {
            return;
        };
        for node in 0..self.context.problem.reference.len() {
            let first = self.layout.position(node);
            let force = motion.carried(node);
            for axis in 0..3 {
                self.residual[first + axis] += force[axis];
            }
        }
    }
}
