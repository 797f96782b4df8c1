//! Implicit dynamics by the generalised-alpha method, contact fully at the end.
//!
//! ```text
//! M a_alpha + (1 - a_f) (f_int - f_ext)_1 + a_f (f_int - f_ext)_0 = f_con,1
//! a_alpha = (1 - a_m) a_1 + a_m a_0
//! a_1 = (x_1 - xp)/(beta dt^2),   xp = x_0 + dt v_0 + dt^2 (1/2 - beta) a_0
//! v_1 = v_0 + dt ((1 - gamma) a_0 + gamma a_1)
//! a_m = (2 r - 1)/(r + 1),  a_f = r/(r + 1),
//! beta = (1 - a_m + a_f)^2/4,  gamma = 1/2 - a_m + a_f
//! ```
//!
//! with the spectral radius `r` at infinite frequency, `0 < r <= 1`. Source:
//! Chung & Hulbert (1993), "A time integration algorithm for structural dynamics
//! with improved numerical dissipation", J. Appl. Mech. 60,
//! doi:10.1115/1.2900803. Contact and friction are not averaged: averaging them
//! lets an impact gain energy. Subscript 0 is the last converged state, 1 the
//! end of the increment. The method's `a_1` is the acceleration at a time shifted by
//! `(a_m - a_f) dt`; components that are prescribed have the velocity and
//! acceleration of their curve, unshifted, so their weights are those of forces.

pub use crate::mass::{kinetic_energy, mass_times, momentum};

use striae_mesh::Vec3;

use crate::{
    problem::Problem,
    rigid::{Pose, Wrench},
    state::State,
};
use striae_model::{Procedure, node::GlobalNode};

/// Parameters of the method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheme {
    /// Weight of the start in the inertia forces.
    pub alpha_m: f64,
    /// Weight of the start in internal forces and loads.
    pub alpha_f: f64,
    /// Newmark's `beta`.
    pub beta: f64,
    /// Newmark's `gamma`.
    pub gamma: f64,
}

impl Scheme {
    /// The parameters for the spectral radius at infinite frequency.
    pub fn new(spectral_radius: f64) -> Self {
        let r = spectral_radius;
        let (alpha_m, alpha_f) = ((2.0 * r - 1.0) / (r + 1.0), r / (r + 1.0));
        Self {
            alpha_m,
            alpha_f,
            beta: 0.25 * (1.0 - alpha_m + alpha_f).powi(2),
            gamma: 0.5 - alpha_m + alpha_f,
        }
    }
}

/// Velocity and acceleration of a prescribed component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImposedRate {
    /// Node.
    pub node: GlobalNode,
    /// Component.
    pub axis: usize,
    /// Unit vector along it, where it is not along a coordinate axis.
    pub direction: Option<Vec3>,
    /// Velocity.
    pub velocity: f64,
    /// Acceleration.
    pub acceleration: f64,
}

impl ImposedRate {
    /// The component of the vector of its node.
    fn component(&self, vectors: &[Vec3]) -> f64 {
        match self.direction {
            Some(direction) => direction.dot(&vectors[self.node]),
            None => vectors[self.node][self.axis],
        }
    }

    /// Puts the component of the vector of its node to a value.
    pub(crate) fn put(&self, vectors: &mut [Vec3], value: f64) {
        match self.direction {
            Some(direction) => {
                let change = value - direction.dot(&vectors[self.node]);
                vectors[self.node] += direction * change;
            }
            None => vectors[self.node][self.axis] = value,
        }
    }
}

/// Inertial quantities of the current increment.
#[derive(Clone, Debug)]
pub struct Motion {
    scheme: Scheme,
    elapsed: f64,
    /// `xp` of every node.
    predicted: Vec<Vec3>,
    velocities: Vec<Vec3>,
    accelerations: Vec<Vec3>,
    /// `a_f (f_int - f_ext)_0` of every node.
    carried: Vec<Vec3>,
    /// `a_f` times the forces that hold tied nodes at the start.
    held: Vec<Vec3>,
    /// `a_f` times the forces of contact on the rigid bodies at the start.
    pushed: Vec<Wrench>,
}

impl Motion {
    /// The motion over the time `elapsed` from `state` in a step; `None` where that has no
    /// inertia.
    pub fn new(problem: &Problem, step: usize, state: &State, elapsed: f64) -> Option<Self> {
        let scheme = scheme(problem, step)?;
        let nodes = 0..state.positions.len();
        let predicted = nodes.clone().map(|node| {
            let share = elapsed * elapsed * (0.5 - scheme.beta);
            state.positions[node]
                + state.velocities[node] * elapsed
                + state.accelerations[node] * share
        });
        let forces = &state.forces;
        let carried =
            nodes.map(|node| (forces.internal[node] - forces.applied[node]) * scheme.alpha_f);
        Some(Self {
            scheme,
            elapsed,
            predicted: predicted.collect(),
            carried: carried.collect(),
            pushed: pushed(problem, state, scheme.alpha_f),
            held: forces.reaction.iter().map(|f| f * scheme.alpha_f).collect(),
            velocities: state.velocities.clone(),
            accelerations: state.accelerations.clone(),
        })
    }

    /// The parameters.
    pub fn scheme(&self) -> &Scheme {
        &self.scheme
    }

    /// `a_f (f_int - f_ext)_0` of a node.
    pub fn carried(&self, node: GlobalNode) -> Vec3 {
        self.carried[node]
    }

    /// `a_f h_0` of a tied node.
    pub fn held(&self, node: GlobalNode) -> Vec3 {
        self.held[node]
    }

    /// `a_f c_0` of a rigid body, the part of `F_0` and `M_0` that its tied nodes leave.
    pub fn pushed(&self, rigid: usize) -> Wrench {
        self.pushed[rigid]
    }

    /// `d a_alpha / d x_1` of a free component.
    pub fn stiffness(&self) -> f64 {
        (1.0 - self.scheme.alpha_m) / (self.scheme.beta * self.elapsed * self.elapsed)
    }

    /// `d v_1 / d x_1` of a free component.
    pub fn slope(&self) -> f64 {
        self.scheme.gamma / (self.scheme.beta * self.elapsed)
    }

    /// `a_alpha` of all nodes.
    pub(crate) fn weighted_accelerations(
        &self,
        positions: &[Vec3],
        rates: &[ImposedRate],
    ) -> Vec<Vec3> {
        let mean = |weight: f64, a_0: f64, a_1: f64| a_1 * (1.0 - weight) + a_0 * weight;
        let ends = self.accelerations_at_end(positions, rates);
        let ends_of =
            |node: GlobalNode, axis: usize| (self.accelerations[node][axis], ends[node][axis]);
        let mut weighted: Vec<Vec3> = (0..positions.len())
            .map(GlobalNode)
            .map(|node| {
                Vec3::from_fn(|axis, _| {
                    let (a_0, a_1) = ends_of(node, axis);
                    mean(self.scheme.alpha_m, a_0, a_1)
                })
            })
            .collect();
        for rate in rates {
            let (a_0, a_1) = (rate.component(&self.accelerations), rate.component(&ends));
            rate.put(&mut weighted, mean(self.scheme.alpha_f, a_0, a_1));
        }
        weighted
    }

    /// Velocities and accelerations at the end, with the nodes at `positions`.
    pub fn at_end(&self, positions: &[Vec3], rates: &[ImposedRate]) -> (Vec<Vec3>, Vec<Vec3>) {
        let accelerations = self.accelerations_at_end(positions, rates);
        let gamma = self.scheme.gamma;
        let mut velocities: Vec<Vec3> = (0..positions.len())
            .map(|node| {
                let mean = self.accelerations[node] * (1.0 - gamma) + accelerations[node] * gamma;
                self.velocities[node] + mean * self.elapsed
            })
            .collect();
        for rate in rates {
            rate.put(&mut velocities, rate.velocity);
        }
        (velocities, accelerations)
    }

    fn accelerations_at_end(&self, positions: &[Vec3], rates: &[ImposedRate]) -> Vec<Vec3> {
        let factor = 1.0 / (self.scheme.beta * self.elapsed * self.elapsed);
        let mut accelerations: Vec<Vec3> = positions
            .iter()
            .zip(&self.predicted)
            .map(|(x, predicted)| (x - predicted) * factor)
            .collect();
        for rate in rates {
            rate.put(&mut accelerations, rate.acceleration);
        }
        accelerations
    }
}

/// The method of a step; `None` without inertia.
pub fn scheme(problem: &Problem, step: usize) -> Option<Scheme> {
    match problem.model.steps[step].procedure {
        Procedure::QuasiStatic => None,
        Procedure::Dynamic { spectral_radius } => Some(Scheme::new(spectral_radius)),
    }
}

/// Force and torque on every rigid body from the forces that hold its tied nodes.
pub(crate) fn wrenches(
    problem: &Problem,
    positions: &[Vec3],
    poses: &[Pose],
    holding: &[Vec3],
) -> Vec<Wrench> {
    let bodies = problem.tied.iter().zip(&problem.model.rigid_surfaces);
    bodies
        .zip(poses)
        .map(|((nodes, rigid), pose)| {
            let point = rigid.reference + pose.displacement;
            let mut wrench = Wrench::default();
            for &node in nodes {
                wrench.force += holding[node];
                wrench.torque += (positions[node] - point).cross(&holding[node]);
            }
            wrench
        })
        .collect()
}

/// Forces and torques on rigid bodies minus those that hold tied nodes, times `weight`.
fn pushed(problem: &Problem, state: &State, weight: f64) -> Vec<Wrench> {
    let held = wrenches(
        problem,
        &state.positions,
        &state.rigid,
        &state.forces.reaction,
    );
    let whole = state.forces.rigid.iter().zip(held);
    whole
        .map(|(whole, held)| Wrench {
            force: (whole.force - held.force) * weight,
            torque: (whole.torque - held.torque) * weight,
        })
        .collect()
}
