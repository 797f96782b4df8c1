//! Kept nodes where pairs hold the same positions, and directions in which their friction is determined.

use striae_mesh::{NodeId, Vec3};

use super::{contact::Contact, imposed::Imposed, numbers::nodes_of, state::State};
use crate::{
    common_pivots::independent,
    configuration::Configuration,
    directions::{Party, directions},
    moved_pair::{MovedPair, Mover},
    selection::{Kept, Selection},
    side::Side,
    traction_basis::KeptNode,
    unknown::Prescribed,
    unknowns::{NodeResult, Status},
};

/// The pairs in these configurations, and the positions that they move.
struct Moved<'a> {
    contact: &'a Contact,
    start: &'a State,
    imposed: &'a Imposed,
    configurations: Vec<Configuration<'a>>,
}

impl<'a> Moved<'a> {
    fn new(
        contact: &'a Contact,
        (start, imposed): (&'a State, &'a Imposed),
        configuration: impl Fn(usize) -> Configuration<'a>,
    ) -> Self {
        Self {
            configurations: (0..contact.pair_count()).map(configuration).collect(),
            contact,
            start,
            imposed,
        }
    }

    fn pair<'b>(&'b self, pair: usize, selection: &'b Selection) -> MovedPair<'b> {
        let of = &self.contact.members()[pair].pair;
        let movers = |side| nodes_of(of, side).into_iter().map(|node| self.mover(node));
        MovedPair {
            configuration: &self.configurations[pair],
            selection,
            movers: Side::BOTH.map(|side| movers(side).collect()),
        }
    }

    fn mover(&self, node: NodeId) -> Mover {
        let (at, imposed) = (node.index(), self.imposed);
        let prescribed = [0, 1, 2].map(|c| imposed.prescribed[3 * at + c]);
        let moves = imposed.end[at] - self.start.positions[at];
        Mover {
            number: node.0,
            prescribed,
            axes: None,
            motion: Some(Vec3::from_fn(
                |c, _| if prescribed[c] { moves[c] } else { 0.0 },
            )),
        }
    }
}

/// Configuration of a pair.
type At<'b, T> = &'b dyn Fn(usize) -> T;

/// Traction fields from the configurations that an increment starts from and, where they are known,
/// those that it is predicted to lead to; nodes of `before` were kept in the last increment.
pub(super) fn chosen<'a>(
    contact: &'a Contact,
    ends: (&'a State, &'a Imposed),
    (start, predicted): (At<Configuration<'a>>, At<Option<Configuration<'a>>>),
    before: &[&Kept],
    prescribed: &[Prescribed],
) -> Vec<Selection> {
    let pairs = 0..contact.pair_count();
    let alone = |pair: usize| {
        let predicted = predicted(pair);
        Selection::new(
            &start(pair),
            predicted.as_ref(),
            before[pair],
            &prescribed[pair],
        )
    };
    let mut selections: Vec<Selection> = pairs.clone().map(alone).collect();
    let latest = |pair| predicted(pair).unwrap_or_else(|| start(pair));
    let moved = Moved::new(contact, ends, latest);
    let of_pair = |pair: usize| moved.pair(pair, &selections[pair]);
    let remaining = independent(&pairs.map(of_pair).collect::<Vec<_>>());
    for (pair, kept) in remaining.iter().enumerate() {
        if let Some(kept) = kept {
            let predicted = predicted(pair);
            selections[pair] =
                selections[pair].keeping(&start(pair), predicted.as_ref(), kept, &prescribed[pair]);
        }
    }
    selections
}

/// Restricts friction of the kept nodes to the directions in which it is determined, in these
/// configurations, where contact is as in `nodes`.
pub(super) fn restrict<'a>(
    contact: &'a Contact,
    (start, imposed): (&'a State, &'a Imposed),
    selections: &mut [Selection],
    configuration: impl Fn(usize) -> Configuration<'a>,
    nodes: &[&[Vec<NodeResult>; 2]],
) {
    let moved = Moved::new(contact, (start, imposed), configuration);
    let party = |pair: usize| {
        let kept = selections[pair].kept().iter();
        let is_closed = |kept: &KeptNode| nodes[pair][kept.side][kept.node].status != Status::Open;
        Party {
            moved: moved.pair(pair, &selections[pair]),
            closed: kept.map(is_closed).collect(),
            has_friction: !contact.members()[pair].friction.is_frictionless(),
            placements: Some([start.placements[pair], imposed.placements[pair]]),
        }
    };
    let parties: Vec<Party> = (0..selections.len()).map(party).collect();
    let Some(directions) = directions(&parties) else {
        return;
    };
    for (selection, directions) in selections.iter_mut().zip(directions) {
        selection.slip_freedoms = directions.slip_freedoms;
        selection.following = directions.following;
    }
}
