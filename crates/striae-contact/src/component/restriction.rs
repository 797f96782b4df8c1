//! Directions in which friction of the kept nodes is determined.

use striae_mesh::{NodeId, Vec3};

use super::{contact::Contact, imposed::Imposed, numbers::nodes_of, state::State};
use crate::{
    configuration::Configuration,
    directions::{Mover, Party, slip_freedoms},
    selection::Selection,
    side::Side,
    traction_basis::KeptNode,
    unknowns::{NodeResult, Status},
};

/// Restricts friction of the kept nodes to the directions in which it is determined, in these
/// configurations, where contact is as in `nodes`.
pub(super) fn restrict<'a>(
    contact: &'a Contact,
    (start, imposed): (&State, &Imposed),
    selections: &mut [Selection],
    configuration: impl Fn(usize) -> Configuration<'a>,
    nodes: &[&[Vec<NodeResult>; 2]],
) {
    let configurations: Vec<_> = (0..selections.len()).map(configuration).collect();
    let mover = |node: NodeId| {
        let at = node.index();
        let prescribed = [0, 1, 2].map(|c| imposed.prescribed[3 * at + c]);
        let moves = imposed.end[at] - start.positions[at];
        Mover {
            number: node.0,
            prescribed,
            axes: None,
            motion: Some(Vec3::from_fn(
                |c, _| if prescribed[c] { moves[c] } else { 0.0 },
            )),
        }
    };
    let party = |pair: usize| {
        let of = &contact.members()[pair];
        let nodes_of = |side| nodes_of(&of.pair, side).into_iter().map(mover).collect();
        let kept = selections[pair].kept().iter();
        let is_closed = |kept: &KeptNode| nodes[pair][kept.side][kept.node].status != Status::Open;
        Party {
            configuration: &configurations[pair],
            selection: &selections[pair],
            movers: Side::BOTH.map(nodes_of),
            closed: kept.map(is_closed).collect(),
            has_friction: !of.friction.is_frictionless(),
            placements: Some([start.placements[pair], imposed.placements[pair]]),
        }
    };
    let parties: Vec<Party> = (0..selections.len()).map(party).collect();
    let Some(freedoms) = slip_freedoms(&parties) else {
        return;
    };
    for (selection, freedoms) in selections.iter_mut().zip(freedoms) {
        selection.slip_freedoms = freedoms;
    }
}
