//! The traction fields of an increment: which nodes are kept, and what their unknowns start
//! from.

use striae_contact::{
    configuration::Configuration,
    evaluation::Evaluation,
    pointed::{self, Bend, Pierced, Progress, choice::points, staying},
    selection::{Before, Kept, Selection},
    side::Side,
    tip::RigidPoints,
    unknowns::{Label, NodeResult, Status, Tractions},
};
use striae_surface::node::SurfaceNode;

use crate::{
    assembly::{Setting, StepContext, Trial},
    model::{ContactSurface, Strategy},
    state::State,
};

/// Traction fields of all pairs and unknowns that fit them.
pub(super) struct Selected {
    pub(super) selections: Vec<Selection>,
    pub(super) tractions: Vec<Tractions>,
}

/// The fields in the converged state. A node that was not kept starts with the old field.
pub(super) fn selected(context: &StepContext, state: &State, s: f64) -> Selected {
    let semismooth = context.problem.model.solver.strategy == Strategy::Semismooth;
    let (selections, tractions) = state
        .pairs
        .iter()
        .enumerate()
        .map(|(pair, of_pair)| {
            let start = context.configuration(pair, &state.positions, &state.rigid);
            let stays = points::staying(&start, &of_pair.points, &of_pair.nodes, &of_pair.carried);
            let mut points: RigidPoints = vec![None; of_pair.points.len()];
            let mut tractions = of_pair.tractions.clone();
            for stay in &stays {
                let (from, to) = (stay.from.index(), stay.to.index());
                points[to] = Some(stay.point);
                tractions.nodes[1][to] = of_pair.tractions.nodes[1][from];
            }
            let before = Before {
                kept: &of_pair.kept,
                required: &pressed(&of_pair.required, &of_pair.nodes),
                pointed: &staying(&start, &of_pair.pointed, &of_pair.nodes),
                points: &points,
            };
            let selection = Selection {
                offsets: context.offsets_left(pair, s),
                ..Selection::new(&start, None, before, &context.fixed_on_pair[pair])
            };
            tractions.tau_n = of_pair
                .carried
                .each_ref()
                .map(|side| side.iter().map(|[_, t1, t2]| [-t1, -t2]).collect());
            let with = |status: Status| {
                let of_side = |side: &Vec<NodeResult>| -> Vec<bool> {
                    side.iter().map(|node| node.status == status).collect()
                };
                of_pair.nodes.each_ref().map(of_side)
            };
            tractions.stuck = with(Status::Stick);
            tractions.slipped = match semismooth {
                true => with(Status::Slip),
                false => of_pair.nodes.each_ref().map(|side| vec![false; side.len()]),
            };
            tractions.labels = Side::BOTH.map(|side| {
                let slipped = tractions.slipped[side].iter();
                let before = slipped.zip(&of_pair.tractions.labels[side]);
                before
                    .map(|(slipped, before)| label(*slipped, before))
                    .collect()
            });
            let mut pointed = of_pair.pointed.clone();
            for stay in &stays {
                pointed[1][stay.to] = true;
            }
            let had = Before {
                pointed: &pointed,
                ..before
            };
            fit(&selection, had, &of_pair.carried, &mut tractions);
            (selection, tractions)
        })
        .unzip();
    Selected {
        selections,
        tractions,
    }
}

/// The label that a node starts with which has slipped in the converged state, or not.
fn label(slipped: bool, before: &Label) -> Label {
    let status = match slipped {
        true => Status::Slip,
        false => Status::Open,
    };
    Label {
        status,
        bedded: before.bedded,
        ..Label::default()
    }
}

/// Those of some nodes that are pressed.
fn pressed(nodes: &Kept, results: &[Vec<NodeResult>; 2]) -> Kept {
    Side::BOTH.map(|side| {
        let nodes = nodes[side].iter().zip(&results[side]);
        nodes
            .map(|(is_one, result)| *is_one && result.pressure > 0.0)
            .collect()
    })
}

/// What pierces the other side in a trial state, by pair.
pub(super) fn pierced(
    context: &StepContext,
    selections: &[Selection],
    trial: &Trial,
    contacts: &[Evaluation],
    progress: Progress,
) -> Vec<Pierced> {
    if true {
        return vec![Pierced::default(); selections.len()];
    }
    let pairs = selections.iter().zip(contacts).enumerate();
    pairs
        .map(|(pair, (selection, contact))| {
            let latest = context.configuration(pair, &trial.positions, &trial.rigid);
            let least = least_bend(context, pair);
            pointed::pierced(&latest, selection, &contact.carried, least, progress)
        })
        .collect()
}

/// The bend from which edges of a pair's rigid side count. A body that contact alone holds
/// would rock from one vertex of its round face to the next.
fn least_bend(context: &StepContext, pair: usize) -> Bend {
    match context.problem.model.pairs[pair].b {
        ContactSurface::Rigid(rigid) if context.fixed_rigid[rigid.0] != [true; 6] => Bend::Sharp,
        _ => Bend::Blunt,
    }
}

/// The fields chosen anew with what a trial state shows, what pierces the other side among
/// that.
pub(super) fn reselected(
    setting: &Setting,
    trial: &Trial,
    contacts: &[Evaluation],
    pierced: &[Pierced],
) -> Selected {
    let (selections, tractions) = with_configurations(setting, trial)
        .enumerate()
        .map(|(pair, (start, latest))| {
            let offsets = setting.selections[pair].offsets.clone();
            let had = &setting.selections[pair];
            let (kept, had) = (had.kept_nodes(), had.pointed_nodes());
            let mut pointed = had.clone();
            for &(side, node) in &pierced[pair].nodes {
                pointed[side][node] = true;
            }
            let mut required = setting.selections[pair].required.clone();
            for &(side, node) in &pierced[pair].unfelt {
                required[side][node] = true;
            }
            let mut points = setting.selections[pair].points.clone();
            for &(node, point) in &pierced[pair].points {
                points[node] = Some(point);
            }
            let before = |pointed| Before {
                kept: &kept,
                required: &required,
                pointed,
                points: &points,
            };
            let prescribed = &setting.context.fixed_on_pair[pair];
            let selection = Selection {
                offsets,
                ..Selection::new(&start, Some(&latest), before(&pointed), prescribed)
            };
            let mut tractions = trial.tractions[pair].clone();
            fit(
                &selection,
                before(&had),
                &contacts[pair].carried,
                &mut tractions,
            );
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
    before: Before,
    carried: &[Vec<[f64; 3]>; 2],
    tractions: &mut Tractions,
) {
    for side in Side::BOTH {
        for (node, unknowns) in tractions.nodes[side].iter_mut().enumerate() {
            let node = SurfaceNode::new(node);
            let is_pointed = selection.is_pointed(side, node);
            let is_kept = selection.is_kept(side, node) && !is_pointed;
            if is_kept && !before.kept[side][node] {
                *unknowns = carried[side][node];
            } else if !(is_kept || is_pointed && before.pointed[side][node]) {
                *unknowns = [0.0; 3];
            }
        }
    }
}
