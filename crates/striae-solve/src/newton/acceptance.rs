//! From a converged trial to the next state: tractions, velocities, energies.

use striae_contact::{pair_state::PairState, selection::Selection};

use super::energy::Ends;
use crate::{
    assembly::{Assembled, Imposed, StepContext, Trial},
    state::State,
    surface_history,
};

/// The state that a converged increment leads to.
pub(super) fn accepted(
    context: &StepContext,
    state: &State,
    time: f64,
    trial: Trial,
    imposed: Imposed,
    selections: &[Selection],
    assembled: Assembled,
) -> State {
    let (velocities, accelerations) = match &imposed.motion {
        Some(motion) => {
            let (mut velocities, mut accelerations) =
                motion.at_end(&trial.positions, &imposed.rates);
            context.problem.ties.follow(&mut velocities);
            context.problem.ties.follow(&mut accelerations);
            (velocities, accelerations)
        }
        None => (state.velocities.clone(), state.accelerations.clone()),
    };
    let ends = Ends {
        context,
        state,
        trial: &trial,
        imposed: &imposed,
        assembled: &assembled,
        velocities: &velocities,
        accelerations: &accelerations,
    };
    let friction = assembled
        .contacts
        .iter()
        .map(|of_pair| of_pair.dissipated)
        .sum();
    let energies = ends.energies(friction);
    let gained = ends.gained(friction);
    let mut pairs: Vec<PairState> = trial
        .tractions
        .into_iter()
        .zip(selections)
        .zip(assembled.contacts)
        .zip(state.pairs.iter().zip(&context.plan.frictions))
        .map(
            |(((tractions, selection), evaluation), (before, friction))| {
                before.after(tractions, selection, evaluation, friction, imposed.elapsed)
            },
        )
        .collect();
    surface_history::join(context.problem, &context.plan.frictions, &mut pairs);
    State {
        time,
        positions: trial.positions,
        velocities,
        accelerations,
        rigid: trial.rigid,
        histories: assembled.bodies.histories,
        actuations: imposed.actuations,
        pressures: trial.pressures,
        pairs,
        forces: assembled.forces,
        energies,
        gained,
    }
}
