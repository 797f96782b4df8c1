//! The traction fields of an increment: which nodes are kept, and what their unknowns start
//! from.

use striae_contact::{
    configuration::Configuration,
    evaluation::Evaluation,
    selection::Selection,
    unknowns::{Status, Tractions},
};

use crate::{
    assembly::{Setting, StepContext, Trial},
    model::Strategy,
    state::State,
};

/// Traction fields of all pairs and unknowns that fit them.
pub(super) struct Selected {
    pub(super) selections: Vec<Selection>,
    pub(super) tractions: Vec<Tractions>,
}

/// The fields in the converged state. A node that was not kept starts with the old field.
pub(super) fn selected(context: &StepContext, state: &State) -> Selected {
    let semismooth = context.problem.model.solver.strategy == Strategy::Semismooth;
    let (selections, tractions) = state
        .pairs
        .iter()
        .enumerate()
        .map(|(pair, of_pair)| {
            let start = context.configuration(pair, &state.positions, &state.rigid);
            let selection =
                Selection::new(&start, None, &of_pair.kept, &context.fixed_on_pair[pair]);
            let mut tractions = of_pair.tractions.clone();
            tractions.tau_n = of_pair
                .carried
                .each_ref()
                .map(|side| side.iter().map(|[_, t1, t2]| [-t1, -t2]).collect());
            tractions.slipped = of_pair.nodes.each_ref().map(|side| {
                let slipped = |status| semismooth && status == Status::Slip;
                side.iter().map(|node| slipped(node.status)).collect()
            });
            fit(&selection, &of_pair.kept, &of_pair.carried, &mut tractions);
            (selection, tractions)
        })
        .unzip();
    Selected {
        selections,
        tractions,
    }
}

/// The fields chosen anew with what a trial state shows.
pub(super) fn reselected(setting: &Setting, trial: &Trial, contacts: &[Evaluation]) -> Selected {
    let (selections, tractions) = with_configurations(setting, trial)
        .enumerate()
        .map(|(pair, (start, latest))| {
            let kept = setting.selections[pair].kept_nodes();
            let selection = Selection::new(
                &start,
                Some(&latest),
                &kept,
                &setting.context.fixed_on_pair[pair],
            );
            let mut tractions = trial.tractions[pair].clone();
            fit(&selection, &kept, &contacts[pair].carried, &mut tractions);
            (selection, tractions)
        })
        .unzip();
    Selected {
        selections,
        tractions,
    }
}

/// Configurations of all pairs at the start and in a trial state.
fn with_configurations<'a>(
    setting: &'a Setting,
    trial: &'a Trial,
) -> impl Iterator<Item = (Configuration<'a>, Configuration<'a>)> {
    let (context, state) = (setting.context, setting.state);
    (0..context.pairs.len()).map(move |pair| {
        let start = context.configuration(pair, &state.positions, &state.rigid);
        let latest = context.configuration(pair, &trial.positions, &trial.rigid);
        (start, latest)
    })
}

/// Gives nodes that are newly kept what the field carried there, and others nothing.
fn fit(
    selection: &Selection,
    kept: &[Vec<bool>; 2],
    carried: &[Vec<[f64; 3]>; 2],
    tractions: &mut Tractions,
) {
    for side in 0..2 {
        for (node, unknowns) in tractions.nodes[side].iter_mut().enumerate() {
            if !selection.is_kept(side, node as u32) {
                *unknowns = [0.0; 3];
            } else if !kept[side][node] {
                *unknowns = carried[side][node];
            }
        }
    }
}
