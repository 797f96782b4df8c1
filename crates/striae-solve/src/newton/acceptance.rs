//! From a converged trial to the next state: tractions, velocities, energies.
//!
//! With the displacements `d` of an increment, the forces at its ends 0 and 1
//! and the weight `a` of the start (`a_f` of the time integration, 1/2 in
//! quasi-static steps),
//!
//! ```text
//! external  += d . (a f_ext,0 + (1 - a) f_ext,1) + work of reactions and of moving surfaces
//! friction  += sum A (-tau_1 . du) over the nodes at which friction is collocated
//! numerical += d . (a f_int,0 + (1 - a) f_int,1) - change of strain energy
//!            + d . M a_alpha - change of kinetic energy
//!            - d . f_con - friction
//! ```
//!
//! so that external work equals kinetic, strain, friction and numerical energy up
//! to the residual that Newton's method leaves. `f_con` are the contact forces
//! that balance the others: those at the end with inertia, else the mean. No
//! node can dissipate less than nothing, as the law holds there at the end.

use striae_contact::{
    evaluation::Evaluation,
    field::FacetForces,
    selection::{Role, Selection},
};
use striae_mesh::{FacetId, Vec3};

use crate::{
    assembly::{Assembled, Imposed, StepContext, Trial},
    dynamics::kinetic_energy,
    state::{Energies, PairState, State},
};

/// The state that a converged increment leads to.
pub(super) fn accepted(
    context: &StepContext,
    state: &State,
    time: f64,
    trial: Trial,
    imposed: Imposed,
    selections: Vec<Selection>,
    assembled: Assembled,
) -> State {
    let (velocities, accelerations) = match &imposed.motion {
        Some(motion) => motion.at_end(&trial.positions, &imposed),
        None => (state.velocities.clone(), state.accelerations.clone()),
    };
    let dissipated: Vec<f64> = selections
        .iter()
        .zip(&assembled.contacts)
        .map(|(selection, evaluation)| dissipation(selection, evaluation))
        .collect();
    let kinetic = kinetic_energy(context.problem, &velocities);
    let work = Work::new(context, state, &trial, &imposed, &assembled);
    let energies = work.energies(state, assembled.strain, kinetic, dissipated.iter().sum());
    let pairs = trial
        .tractions
        .into_iter()
        .zip(selections)
        .zip(assembled.contacts)
        .zip(&state.pairs)
        .zip(dissipated)
        .map(
            |((((tractions, selection), evaluation), before), friction)| PairState {
                dissipated: before.dissipated + friction,
                kinematic: selection.kinematic(),
                selection: Some(selection),
                tractions,
                nodes: evaluation.nodes,
                facets: evaluation.facets,
            },
        )
        .collect();
    State {
        time,
        positions: trial.positions,
        velocities,
        accelerations,
        rigid_displacements: imposed.rigid,
        pairs,
        forces: assembled.forces,
        energies,
    }
}

/// Frictional work of an increment from the kinematic nodes, each of whose
/// contributions `-tau . du` is not negative, scaled from the pressure they
/// carry to the whole normal force.
fn dissipation(selection: &Selection, evaluation: &Evaluation) -> f64 {
    let mut work = 0.0;
    let mut carried = 0.0;
    let mut whole = 0.0;
    let sides = evaluation
        .facets
        .iter()
        .filter(|side| !side.is_empty())
        .count();
    for side in 0..2 {
        let areas = &evaluation.nodal_areas[side];
        whole += evaluation.facets[side]
            .iter()
            .map(|(_, f)| f.pressure)
            .sum::<f64>();
        for (node, role) in selection.roles[side].iter().enumerate() {
            if matches!(role, Role::Kinematic(_)) {
                let result = &evaluation.nodes[side][node];
                work -= areas[node] * result.tau.dot(&result.slip);
                carried += areas[node] * result.pressure;
            }
        }
    }
    if carried > 0.0 {
        work * whole / (carried * sides as f64)
    } else {
        0.0
    }
}

/// Work of the forces of an increment on its displacements.
#[derive(Default)]
struct Work {
    external: f64,
    /// Of internal and inertia forces.
    taken_up: f64,
    /// Minus that of contact forces on all sides.
    contact: f64,
}

impl Work {
    fn new(
        context: &StepContext,
        state: &State,
        trial: &Trial,
        imposed: &Imposed,
        assembled: &Assembled,
    ) -> Self {
        let problem = context.problem;
        let scheme = imposed.motion.as_ref().map(|motion| *motion.scheme());
        // Weights of the start in loads and internal forces, and in reactions and contact.
        let [start, holding] = scheme.map_or([0.5, 0.5], |scheme| [scheme.alpha_f, 0.0]);
        let mean = |weight: f64, a: Vec3, b: Vec3| a * weight + b * (1.0 - weight);
        let (before, after) = (&state.forces, &assembled.forces);
        let mut work = Self::default();
        for node in 0..problem.reference.len() {
            let d = trial.positions[node] - state.positions[node];
            let found = before.internal[node] - before.applied[node] - before.contact[node];
            let held = Vec3::from_fn(|axis, _| {
                let fixed = context.fixed[3 * node + axis];
                if fixed {
                    after.reaction[node][axis]
                } else {
                    0.0
                }
            });
            work.external += d.dot(&mean(start, before.applied[node], after.applied[node]));
            work.external += d.dot(&mean(holding, found, held));
            work.taken_up += d.dot(&mean(start, before.internal[node], after.internal[node]));
            work.taken_up += d.dot(&after.inertia[node]);
            work.contact -= d.dot(&mean(holding, before.contact[node], after.contact[node]));
        }
        for (pair, geometry) in problem.pairs.iter().enumerate() {
            if let Some(rigid) = geometry.rigid {
                let way = imposed.rigid[rigid] - state.rigid_displacements[rigid];
                let of_start = resultant(&state.pairs[pair].facets[0]);
                let of_end = resultant(&assembled.contacts[pair].facets[0]);
                let moved = way.dot(&mean(holding, of_start, of_end));
                work.external += moved;
                work.contact += moved;
            }
        }
        work
    }

    fn energies(&self, state: &State, strain: f64, kinetic: f64, friction: f64) -> Energies {
        let before = &state.energies;
        let stored = strain - before.strain + kinetic - before.kinetic;
        Energies {
            kinetic,
            strain,
            external: before.external + self.external,
            friction: before.friction + friction,
            numerical: before.numerical + self.taken_up - stored + self.contact - friction,
        }
    }
}

fn resultant(facets: &[(FacetId, FacetForces)]) -> Vec3 {
    facets.iter().flat_map(|(_, forces)| forces.force).sum()
}
