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

use nalgebra::Matrix3;
use striae_element::ElementResponse;
use striae_mesh::{MAX_CORNERS, Vec3};

use super::{Imposed, StepContext, System, Trial};
use striae_model::{node::GlobalNode, tie::Ties};

/// Data of the increment that elements need.
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
    pub(super) fn new(ties: &Ties, trial: &Trial, imposed: &Imposed) -> Self {
        let motion = imposed.motion.as_ref();
        Self {
            share_of_end: 1.0 - motion.map_or(0.0, |motion| motion.scheme().alpha_f),
            gravity: imposed.gravity,
            accelerations: motion.map(|motion| {
                let mut all = motion.weighted_accelerations(&trial.positions, &imposed.rates);
                ties.follow(&mut all);
                all
            }),
            stiffness: motion.map_or(0.0, |motion| motion.stiffness()),
        }
    }
}

/// Contribution of an element to the system.
#[derive(Clone)]
pub(super) struct Share {
    /// Response, weighed, with inertia and weight.
    pub(super) response: ElementResponse,
    /// Internal force on each corner, without inertia.
    pub(super) internal: [Vec3; MAX_CORNERS],
    /// Weight of each corner.
    pub(super) weight: [Vec3; MAX_CORNERS],
    /// Inertia of each corner.
    pub(super) inertia: [Vec3; MAX_CORNERS],
    /// Sum of the squares of the forces of the response.
    pub(super) square_of_forces: f64,
}

impl Share {
    /// A share with room for a response like the one given.
    pub(super) fn new(response: ElementResponse) -> Self {
        let zeros = [Vec3::zeros(); MAX_CORNERS];
        Self {
            response,
            internal: zeros,
            weight: zeros,
            inertia: zeros,
            square_of_forces: 0.0,
        }
    }
}

impl Inertia {
    /// Weighs the response of an element at some nodes, and adds its mass and weight; `mass` is
    /// empty where it has none.
    pub(super) fn weigh(
        &self,
        nodes: &[GlobalNode],
        mass: &[f64],
        context: &StepContext,
        own: &mut Share,
    ) {
        let share = self.share_of_end;
        for (internal, force) in own.internal.iter_mut().zip(&own.response.force) {
            *internal = Vec3::from(*force);
        }
        if share != 1.0 {
            let forces = own.response.force.as_flattened_mut().iter_mut();
            forces.for_each(|f| *f *= share);
            own.response.stiffness.scale(share);
        }
        if !mass.is_empty() {
            self.add_forces(nodes, mass, own);
            if self.stiffness > 0.0 {
                self.add_mass(nodes, mass, context, &mut own.response);
            }
        } else if self.acts() {
            own.weight.fill(Vec3::zeros());
            own.inertia.fill(Vec3::zeros());
        }
        let forces = own.response.force.as_flattened().iter();
        own.square_of_forces = forces.map(|f| f * f).sum();
    }

    /// Returns whether there is gravity or inertia.
    pub(super) fn acts(&self) -> bool {
        self.accelerations.is_some() || self.gravity != Vec3::zeros()
    }

    fn add_forces(&self, nodes: &[GlobalNode], mass: &[f64], own: &mut Share) {
        for (a, mass) in mass.chunks_exact(nodes.len()).enumerate() {
            let weight = self.gravity * mass.iter().sum::<f64>();
            own.weight[a] = weight;
            let mut force = -weight * self.share_of_end;
            if let Some(accelerations) = &self.accelerations {
                let shares = nodes.iter().zip(mass);
                own.inertia[a] = shares.map(|(&node, m)| accelerations[node] * *m).sum();
                force += own.inertia[a];
            }
            for axis in 0..3 {
                own.response.force[a][axis] += force[axis];
            }
        }
    }

    fn add_mass(
        &self,
        nodes: &[GlobalNode],
        mass: &[f64],
        context: &StepContext,
        response: &mut ElementResponse,
    ) {
        if nodes
            .iter()
            .any(|&node| context.turned.frame(node).is_some())
        {
            return self.add_turned_mass(nodes, mass, context, response);
        }
        for b in 0..nodes.len() {
            for axis in 0..3 {
                if context.fixed[nodes[b].component(axis)] {
                    continue;
                }
                for a in 0..nodes.len() {
                    let value = mass[a * nodes.len() + b] * self.stiffness;
                    response.stiffness.add_along(axis, a, b, value);
                }
            }
        }
    }

    /// Adds `P_a P_b m_ab` with the projections to what is free at the nodes: prescribed components
    /// of `b` have imposed accelerations, and rows of those of `a` are left out anyway. So the
    /// blocks are those of a symmetric matrix, as the stiffness has them.
    fn add_turned_mass(
        &self,
        nodes: &[GlobalNode],
        mass: &[f64],
        context: &StepContext,
        response: &mut ElementResponse,
    ) {
        let free: Vec<Matrix3<f64>> = nodes.iter().map(|&node| context.free(node)).collect();
        for b in 0..nodes.len() {
            for a in 0..nodes.len() {
                let block = free[a] * free[b] * (mass[a * nodes.len() + b] * self.stiffness);
                // Rows of nalgebra's arrays are columns.
                let block = block.transpose().into();
                response.stiffness.add_between(a, b, &block);
            }
        }
    }
}

impl System<'_> {
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

    /// Adds a force and a stiffness at a node that all ranks know.
    pub(super) fn add_point(&mut self, node: GlobalNode, force: &Vec3, stiffness: f64) {
        let first = self.layout.position(node);
        let unknowns = [first, first + 1, first + 2];
        let mut tangent = [0.0; 9];
        if self.owns(first) {
            for at in [0, 4, 8] {
                tangent[at] = stiffness;
            }
        }
        self.add_dense(&[node], &unknowns, force.as_slice(), &tangent);
    }

    /// Forces carried over from the last converged state.
    pub(super) fn carried(&mut self, imposed: &Imposed) {
        let Some(motion) = &imposed.motion else {
            return;
        };
        for node in self.context.problem.global_nodes() {
            let first = self.layout.position(node);
            let force = motion.carried(node);
            for axis in 0..3 {
                self.residual[first + axis] += force[axis];
            }
        }
    }
}
