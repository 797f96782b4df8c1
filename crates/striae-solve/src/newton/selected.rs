//! The traction fields of an increment: which nodes are kept, and what their unknowns start
//! from.

use striae_contact::{
    common_pivots::independent,
    configuration::Configuration,
    directions::{Party, directions},
    evaluation::Evaluation,
    moved_pair::{MovedPair, Mover},
    pair_state::{PairState, Predicted, fit},
    placement::Placement,
    selection::{Selection, deepest},
    side::Side,
    unknowns::{NodeResult, Status, Tractions},
};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    assembly::{Imposed, Setting, StepContext, Trial},
    state::State,
};
use striae_model::Strategy;

/// Change of the weights of kept nodes, over the largest, below which fields are the same.
const SAME: f64 = 1e-6;

/// Traction fields of all pairs and unknowns that fit them.
pub(super) struct Selected {
    pub(super) selections: Vec<Selection>,
    pub(super) tractions: Vec<Tractions>,
}

impl Selected {
    /// Returns whether these fields have the kept nodes of others, with the same weights.
    fn are(&self, others: &[Selection]) -> bool {
        self.selections.iter().zip(others).all(|(one, other)| {
            let weights = one.basis.weights.iter().zip(&other.basis.weights);
            let largest = one.basis.weights.iter().copied().fold(0.0, f64::max);
            one.basis.kept == other.basis.kept
                && weights
                    .into_iter()
                    .all(|(a, b)| (a - b).abs() <= SAME * largest)
        })
    }

    /// Returns whether these fields carry something in a trial state that those before do not.
    fn gains(&self, setting: &Setting, before: &[Selection], trial: &Trial) -> bool {
        let (context, state) = (setting.context, setting.state);
        let fields = before.iter().zip(&self.selections).enumerate();
        fields.into_iter().any(|(pair, (had, has))| {
            let start = context.configuration(pair, &state.positions, &state.rigid);
            let latest = context.configuration(pair, &trial.positions, &trial.rigid);
            has.gains_on(had, &start, &latest)
        })
    }
}

/// Traction fields of an increment that may be chosen again.
#[derive(Default)]
pub(super) struct Origin {
    /// Fields that follow from the start alone, once others have been taken.
    of_start: Option<Vec<Selection>>,
    /// `true` where the present fields are those again.
    has_returned: bool,
    /// Pairs whose fields follow from the start and a converged state.
    of_ends: Vec<bool>,
}

impl Origin {
    /// Returns whether the fields depend on more than the start.
    pub(super) fn has_reselected(&self) -> bool {
        self.of_start.is_some() && !self.has_returned
    }

    /// Notes fields that were replaced.
    pub(super) fn replaced(&mut self, before: Vec<Selection>) {
        self.of_start.get_or_insert(before);
    }

    /// Returns the fields that a trial state asks for, unless they are those it has: fields of the
    /// start, chosen again in pairs whose facets touch where these leave out nodes. They depend on
    /// both ends of an increment and on no iteration between. A pair that a *converged* state has asked
    /// for others does not return to those of the start: nodes at the limit of touching would
    /// alternate.
    pub(super) fn others(
        &mut self,
        setting: &Setting,
        trial: &Trial,
        contacts: &[Evaluation],
        is_converged: bool,
    ) -> Option<Selected> {
        let context = setting.context;
        let of_start = self.of_start.as_deref().unwrap_or(setting.selections);
        let serves = |(pair, field): (usize, &Selection)| {
            let state = setting.state;
            // The search adds what has worn by itself.
            let start = context.configuration(pair, &state.positions, &state.rigid);
            let latest = context.configuration(pair, &trial.positions, &trial.rigid);
            let is_of_ends = self.of_ends.get(pair).is_some_and(|of_ends| *of_ends);
            !is_of_ends && field.left_out(&start, &latest).is_empty()
        };
        let serve: Vec<bool> = of_start.iter().enumerate().map(serves).collect();
        let all_serve = serve.iter().all(|serves| *serves);
        if all_serve && self.of_start.is_none() {
            return None;
        }
        let again = (!all_serve).then(|| reselected(setting, of_start, &serve, trial, contacts));
        // What other pairs hold asks for no other fields.
        let again = again
            .filter(|again| self.of_ends.contains(&true) || again.gains(setting, of_start, trial));
        self.has_returned = again.is_none();
        let found = again.unwrap_or_else(|| fitting(of_start.to_vec(), setting, trial, contacts));
        if is_converged {
            self.of_ends.resize(serve.len(), false);
            for (of_ends, serves) in self.of_ends.iter_mut().zip(&serve) {
                *of_ends |= !serves;
            }
        }
        (!found.are(setting.selections)).then_some(found)
    }
}

/// The fields in the converged state. A node that was not kept starts with the old field.
pub(super) fn selected(
    context: &StepContext,
    state: &State,
    s: f64,
    imposed: &Imposed,
) -> Selected {
    selected_in(context, state, (s, imposed), None)
}

/// The fields of given kept nodes in the converged state, chosen where there are none.
pub(super) fn selected_in(
    context: &StepContext,
    state: &State,
    (s, imposed): (f64, &Imposed),
    given: Option<&[PairState]>,
) -> Selected {
    let mut selected = without_freedoms(context, state, s, given);
    let start = |pair| context.configuration(pair, &state.positions, &state.rigid);
    let nodes: Vec<_> = state.pairs.iter().map(|pair| &pair.nodes).collect();
    restrict(
        context,
        (state, imposed),
        &mut selected.selections,
        start,
        &nodes,
    );
    selected
}

/// Selection in which friction of all kept nodes is determined in all directions.
fn without_freedoms(
    context: &StepContext,
    state: &State,
    s: f64,
    given: Option<&[PairState]>,
) -> Selected {
    let predicted = match context.problem.model.solver.strategy {
        Strategy::Semismooth => Predicted::AsBefore,
        // The strategy of Table 1 predicts stick in every increment.
        Strategy::Table1 { .. } => Predicted::Stick,
    };
    let worn: Vec<_> = state
        .pairs
        .iter()
        // Other pairs may have worn its surfaces.
        .map(|pair| match deepest(&pair.tractions.worn) > 0.0 {
            true => pair.tractions.worn.clone(),
            false => [Vec::new(), Vec::new()],
        })
        .collect();
    let start = |pair: usize| {
        let start = context.configuration(pair, &state.positions, &state.rigid);
        start.worn(deepest(&worn[pair]))
    };
    let of_pair = |(pair, before): (usize, &PairState)| {
        let prescribed = &context.fixed_on_pair[pair];
        let chosen = match given {
            None => Selection::new(&start(pair), None, &before.kept, prescribed),
            Some(given) => Selection::with_kept(&start(pair), None, &given[pair].kept, prescribed),
        };
        Selection {
            offsets: context.offsets_left(pair, s),
            fitted: context.fitted(pair, s),
            worn: worn[pair].clone(),
            ..chosen
        }
    };
    let mut selections: Vec<Selection> = state.pairs.iter().enumerate().map(of_pair).collect();
    if given.is_none() {
        compete(context, &mut selections, start, |_| None);
    }
    let fields = selections.iter().zip(&state.pairs).enumerate();
    let tractions = fields.map(|(pair, (selection, of_pair))| {
        let mut tractions = of_pair.started(selection, predicted);
        if context.pairs[pair].wears() {
            press(selection, &of_pair.carried, &mut tractions);
        }
        tractions
    });
    Selected {
        tractions: tractions.collect(),
        selections,
    }
}

/// Takes nodes out of the fields where several pairs hold the same positions.
fn compete<'a>(
    context: &'a StepContext,
    selections: &mut [Selection],
    start: impl Fn(usize) -> Configuration<'a>,
    predicted: impl Fn(usize) -> Option<Configuration<'a>>,
) {
    let pairs = 0..selections.len();
    if pairs.len() == 1 {
        return;
    }
    let latest = |pair| predicted(pair).unwrap_or_else(|| start(pair));
    let configurations: Vec<_> = pairs.clone().map(latest).collect();
    let moved = |pair: usize| MovedPair {
        configuration: &configurations[pair],
        selection: &selections[pair],
        movers: Side::BOTH.map(|side| movers(context, None, pair, side)),
    };
    let remaining = independent(&pairs.map(moved).collect::<Vec<_>>());
    for (pair, kept) in remaining.iter().enumerate() {
        if let Some(kept) = kept {
            let prescribed = &context.fixed_on_pair[pair];
            let predicted = predicted(pair);
            selections[pair] =
                selections[pair].keeping(&start(pair), predicted.as_ref(), kept, prescribed);
        }
    }
}

/// The fields of the start in pairs that these serve, and in the others those chosen with the contacts
/// of a trial state. A pair that is served loses nodes that another pair needs at the same positions,
/// and no more: nothing else that happens in one bears on the discretisation of another.
fn reselected(
    setting: &Setting,
    of_start: &[Selection],
    serve: &[bool],
    trial: &Trial,
    contacts: &[Evaluation],
) -> Selected {
    let context = setting.context;
    let worn = |pair: usize| deepest(&of_start[pair].worn);
    let start = |pair: usize| {
        let state = setting.state;
        let start = context.configuration(pair, &state.positions, &state.rigid);
        start.worn(worn(pair))
    };
    let latest = |pair| context.configuration(pair, &trial.positions, &trial.rigid);
    let latest_worn = |pair: usize| latest(pair).worn(worn(pair));
    let again = |(pair, of): (usize, &Selection)| match serve[pair] {
        // Directions of friction depend on the fields of all pairs.
        true => Selection {
            slip_freedoms: Vec::new(),
            following: Vec::new(),
            ..of.clone()
        },
        false => Selection {
            offsets: of.offsets.clone(),
            fitted: of.fitted.clone(),
            worn: of.worn.clone(),
            ..Selection::new(
                &start(pair),
                Some(&latest_worn(pair)),
                &setting.selections[pair].kept_nodes(),
                &context.fixed_on_pair[pair],
            )
        },
    };
    let mut selections: Vec<Selection> = of_start.iter().enumerate().map(again).collect();
    compete(context, &mut selections, start, |pair| {
        Some(latest_worn(pair))
    });
    let nodes: Vec<_> = contacts.iter().map(|contact| &contact.nodes).collect();
    let ends = (setting.state, setting.imposed);
    restrict(context, ends, &mut selections, latest, &nodes);
    fitting(selections, setting, trial, contacts)
}

/// Fields with unknowns that continue those of a trial state.
fn fitting(
    selections: Vec<Selection>,
    setting: &Setting,
    trial: &Trial,
    contacts: &[Evaluation],
) -> Selected {
    let mut tractions = trial.tractions.clone();
    let had = setting.selections.iter().map(Selection::kept_nodes);
    let fields = selections.iter().zip(had).zip(contacts);
    for (((field, had), contact), tractions) in fields.zip(&mut tractions) {
        fit(field, &had, &contact.carried, tractions);
    }
    Selected {
        selections,
        tractions,
    }
}

/// Restricts friction of the kept nodes to the directions in which it is determined, in these
/// configurations, where contact is as in `nodes`, in an increment from a state to what is imposed.
fn restrict<'a>(
    context: &'a StepContext,
    ends: (&State, &Imposed),
    selections: &mut [Selection],
    configuration: impl Fn(usize) -> Configuration<'a>,
    nodes: &[&[Vec<NodeResult>; 2]],
) {
    let has_friction = |pair: usize| !context.plan.frictions[pair].is_frictionless();
    let pairs = 0..selections.len();
    let prescribed = || {
        let pairs = context.fixed_on_pair.iter();
        pairs.flat_map(|of| of.components.iter().flatten())
    };
    if !pairs.clone().any(has_friction)
        // A single pair of free surfaces has as many positions as unknowns; nothing is contested.
        || selections.len() == 1 && !prescribed().any(|prescribed| *prescribed)
    {
        return;
    }
    let configurations: Vec<_> = pairs.clone().map(configuration).collect();
    let motions = context.imposed_motions(ends.0, ends.1);
    let party = |pair: usize| Party {
        moved: MovedPair {
            configuration: &configurations[pair],
            selection: &selections[pair],
            movers: Side::BOTH.map(|side| movers(context, Some(&motions), pair, side)),
        },
        placements: placements(context, ends, pair),
        closed: {
            let kept = selections[pair].kept().iter();
            kept.map(|kept| nodes[pair][kept.side][kept.node].status != Status::Open)
                .collect()
        },
        has_friction: has_friction(pair),
    };
    let parties: Vec<Party> = pairs.map(party).collect();
    let Some(directions) = directions(&parties) else {
        return;
    };
    for (selection, directions) in selections.iter_mut().zip(directions) {
        selection.slip_freedoms = directions.slip_freedoms;
        selection.following = directions.following;
    }
}

/// The nodes of a side; none of a rigid one. Without motions they are unknown.
fn movers(context: &StepContext, motions: Option<&[Vec3]>, pair: usize, side: Side) -> Vec<Mover> {
    let of_pair = &context.fixed_on_pair[pair];
    let prescribed = of_pair.components[side].chunks(3).enumerate();
    let mover = |(node, prescribed): (usize, &[bool])| {
        let node = SurfaceNode::new(node);
        let global = context.problem.surface_node(pair, side, node)?;
        let prescribed = [prescribed[0], prescribed[1], prescribed[2]];
        // Nodes whose gap others determine count as prescribed without a motion of their own.
        let own = [0, 1, 2].map(|axis| context.known[global.component(axis)]);
        Some(Mover {
            number: global.0 as u32,
            prescribed,
            axes: of_pair.axes[side].get(&node.index()).copied(),
            motion: motions.filter(|_| own == prescribed).map(|of| of[global.0]),
        })
    };
    prescribed.filter_map(mover).collect()
}

/// Placements of the rigid side of a pair at both ends of an increment, if both are known before.
fn placements(
    context: &StepContext,
    (state, imposed): (&State, &Imposed),
    pair: usize,
) -> Option<[Placement; 2]> {
    let problem = context.problem;
    let rigid = problem.pairs[pair].rigid?;
    let known: Option<Vec<f64>> = imposed.rigid[rigid].iter().copied().collect();
    let end = imposed.before[rigid].moved_to(&known?.try_into().ok()?);
    let reference = &problem.model.rigid_surfaces[rigid].reference;
    Some([&state.rigid[rigid], &end].map(|pose| pose.placement(reference)))
}

/// Gives kept nodes the pressure that acts on them: what wore in the increment before had a part in
/// it beside their unknowns, and is part of the gap from now on.
fn press(selection: &Selection, carried: &[Vec<[f64; 3]>; 2], tractions: &mut Tractions) {
    for kept in selection.kept() {
        let (side, node) = kept.place();
        tractions.nodes[side][node][0] = carried[side][node][0];
    }
}
