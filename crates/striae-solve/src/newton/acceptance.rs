//! From a converged trial to the next state: tractions, velocities, energies.

use striae_contact::{
    evaluation::Evaluation,
    selection::{Role, Selection},
};

use super::energy::Ends;
use crate::{
    assembly::{Assembled, Imposed, StepContext, Trial},
    state::{PairState, State},
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
    let ends = Ends {
        context,
        state,
        trial: &trial,
        imposed: &imposed,
        assembled: &assembled,
        velocities: &velocities,
        accelerations: &accelerations,
    };
    let energies = ends.energies(dissipated.iter().sum());
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
        rigid: trial.rigid,
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
