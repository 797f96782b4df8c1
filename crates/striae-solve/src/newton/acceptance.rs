//! From a converged trial to the next state: tractions, friction work, energies.

use striae_contact::{
    evaluation::Evaluation,
    selection::{Role, Selection},
};
use striae_mesh::Vec3;

use crate::{
    assembly::{Assembled, Imposed, StepContext, Trial},
    problem::Problem,
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
    let energies = energies(context.problem, state, &trial, &imposed, &assembled);
    let pairs = trial
        .tractions
        .into_iter()
        .zip(selections)
        .zip(assembled.contacts)
        .zip(&state.pairs)
        .map(|(((tractions, selection), evaluation), before)| PairState {
            dissipated: before.dissipated + dissipation(&selection, &evaluation),
            kinematic: selection.kinematic(),
            selection: Some(selection),
            tractions,
            nodes: evaluation.nodes,
            facets: evaluation.facets,
        })
        .collect();
    State {
        time,
        positions: trial.positions,
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

/// Energies by the trapezoidal rule over the increment.
fn energies(
    problem: &Problem,
    state: &State,
    trial: &Trial,
    imposed: &Imposed,
    assembled: &Assembled,
) -> Energies {
    let (before, after) = (&state.forces, &assembled.forces);
    let mut external = 0.0;
    let mut contact = 0.0;
    for node in 0..problem.reference.len() {
        let motion = trial.positions[node] - state.positions[node];
        let mean = |a: &[Vec3], b: &[Vec3]| (a[node] + b[node]) * 0.5;
        external += motion.dot(&mean(&before.applied, &after.applied));
        external += motion.dot(&mean(&before.reaction, &after.reaction));
        contact -= motion.dot(&mean(&before.contact, &after.contact));
    }
    for (pair, geometry) in problem.pairs.iter().enumerate() {
        if let Some(rigid) = geometry.rigid {
            let motion = imposed.rigid[rigid] - state.rigid_displacements[rigid];
            let sum = |facets: &[(striae_mesh::FacetId, striae_contact::field::FacetForces)]| {
                facets.iter().flat_map(|(_, f)| f.force).sum::<Vec3>()
            };
            let force = (sum(&state.pairs[pair].facets[0])
                + sum(&assembled.contacts[pair].facets[0]))
                * 0.5;
            external += motion.dot(&force);
            contact += motion.dot(&force);
        }
    }
    Energies {
        strain: assembled.strain,
        external: state.energies.external + external,
        contact: state.energies.contact + contact,
    }
}
