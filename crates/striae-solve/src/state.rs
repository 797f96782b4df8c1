//! The state of a simulation at the end of an increment.

use serde::{Deserialize, Serialize};
use striae_contact::pair_state::PairState;
use striae_mesh::Vec3;

use crate::{
    problem::Problem,
    rigid::{Pose, Wrench},
};
use striae_model::actuation::Actuations;

use crate::composition::Composition;

/// A converged state. It is never changed: an increment makes a new one.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct State {
    /// (Pseudo) time.
    pub time: f64,
    /// Position of every global node.
    pub positions: Vec<Vec3>,
    /// Velocity of every global node, zero without inertia.
    pub velocities: Vec<Vec3>,
    /// Acceleration of every global node.
    pub accelerations: Vec<Vec3>,
    /// Pose of every rigid body.
    pub rigid: Vec<Pose>,
    /// Internal variables of the quadrature points of every body, by block, element and point.
    /// Empty for materials without internal variables.
    pub histories: Vec<Vec<f64>>,
    /// Actuation of the bodies.
    pub actuations: Actuations,
    /// Pressure in every cavity, over that of the surroundings.
    pub pressures: Vec<f64>,
    /// State of every pair.
    pub pairs: Vec<PairState>,
    /// Nodal forces.
    pub forces: NodalForces,
    /// Energies since the start.
    pub energies: Energies,
    /// Energy that contact has made beyond what friction takes, at least.
    pub gained: f64,
}

/// Forces on all global nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NodalForces {
    /// Internal forces, those of springs included.
    pub internal: Vec<Vec3>,
    /// Inertia forces `M a_alpha`.
    pub inertia: Vec<Vec3>,
    /// Reactions: what internal, inertia, applied and contact forces leave; at
    /// tied nodes the force of the rigid body.
    pub reaction: Vec<Vec3>,
    /// Applied loads.
    pub applied: Vec<Vec3>,
    /// Contact forces.
    pub contact: Vec<Vec3>,
    /// Forces of ties between bodies, see [`striae_model::tie`](mod@striae_model::tie).
    pub ties: Vec<Vec3>,
    /// Forces of stabilisation, see [`crate::stabilisation`].
    pub stabilisation: Vec<Vec3>,
    /// Stabilising forces and torques on every rigid body.
    pub stabilised: Vec<Wrench>,
    /// Force and torque that drive or hold every rigid body whose coordinates are
    /// unknowns, against the nodes tied to it and against contact.
    pub rigid: Vec<Wrench>,
    /// Force and torque that contact exerts on every rigid body.
    pub pushed: Vec<Wrench>,
    /// Tension of every link of springs, see [`crate::spring`]; its forces are internal ones.
    pub tensions: Vec<f64>,
}

/// Energies since the start of the simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energies {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Stored elastic energy, that of springs since the start included.
    pub strain: f64,
    /// Work of reactions, loads and moving rigid surfaces, and of what changes
    /// velocities at once at the start of a step.
    pub external: f64,
    /// Work of actuation: what changes of stress-free strains and tensions of the bodies add to
    /// their stored energy.
    pub actuation: f64,
    /// Work dissipated by viscous and plastic flow in all bodies, and by the dashpots of springs.
    pub inelastic: f64,
    /// Work dissipated by friction in all pairs.
    pub friction: f64,
    /// Work of contact forces beyond friction at nodes: that of impacts, of pressure on
    /// changing gaps, and the difference between the forces of traction fields and
    /// tractions at nodes. It vanishes with increments and mesh.
    pub contact: f64,
    /// Work lost to stabilisation, see [`crate::stabilisation`].
    pub stabilisation: f64,
    /// Work lost to time integration and its quadrature. It vanishes with the increments.
    pub numerical: f64,
}

impl Energies {
    /// Work of what is outside and of actuation that is found nowhere: the work of the residual forces that
    /// Newton's method leaves, if all forces are right.
    pub fn imbalance(&self) -> f64 {
        let dissipated = self.inelastic + self.friction;
        let lost = dissipated + self.contact + self.stabilisation + self.numerical;
        self.external + self.actuation - (self.kinetic + self.strain + lost)
    }
}

impl NodalForces {
    /// No forces on so many nodes and rigid bodies.
    pub fn zero(nodes: usize, rigid: usize) -> Self {
        Self {
            internal: vec![Vec3::zeros(); nodes],
            inertia: vec![Vec3::zeros(); nodes],
            reaction: vec![Vec3::zeros(); nodes],
            applied: vec![Vec3::zeros(); nodes],
            contact: vec![Vec3::zeros(); nodes],
            ties: vec![Vec3::zeros(); nodes],
            stabilisation: vec![Vec3::zeros(); nodes],
            stabilised: vec![Wrench::default(); rigid],
            rigid: vec![Wrench::default(); rigid],
            pushed: vec![Wrench::default(); rigid],
            tensions: Vec::new(),
        }
    }
}

/// Number of internal variables of the quadrature points of every body.
fn variables(problem: &Problem) -> impl Iterator<Item = usize> {
    let bodies = problem.compositions.iter();
    bodies.map(Composition::variable_count)
}

impl State {
    /// Returns whether its bodies have as many internal variables as those of a problem.
    pub fn remembers_as(&self, problem: &Problem) -> bool {
        self.histories.iter().map(Vec::len).eq(variables(problem))
    }

    /// The undeformed state at time zero.
    pub fn undeformed(problem: &Problem) -> Self {
        Self {
            time: 0.0,
            positions: problem.reference.clone(),
            velocities: vec![Vec3::zeros(); problem.reference.len()],
            accelerations: vec![Vec3::zeros(); problem.reference.len()],
            rigid: vec![Pose::at_rest(); problem.model.rigid_surfaces.len()],
            histories: (0..problem.elements.len())
                .map(|body| problem.rest(body))
                .collect(),
            actuations: Actuations::default(),
            pressures: vec![0.0; problem.cavities.len()],
            pairs: problem
                .pairs
                .iter()
                .map(|pair| PairState::untouched(&pair.contact))
                .collect(),
            forces: NodalForces {
                tensions: problem.links.iter().map(|link| link.preload).collect(),
                ..NodalForces::zero(problem.reference.len(), problem.model.rigid_surfaces.len())
            },
            energies: Energies::default(),
            gained: 0.0,
        }
    }
}
