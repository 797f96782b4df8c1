//! Nodes of contact surfaces whose ties determine how they move past what they face.
//!
//! On the border of a tie, facets of the same two bodies that are not tied may be a pair. What is
//! glued there to the other side has no gap and no slip of its own.
//!
//! If two tied bodies rest on a third, the gap of a dependent node follows from the nodes that it
//! depends on. If these touch the same opponent, a row of its own would repeat theirs, and its
//! pressure would not be determined. Such nodes are no candidates for one and carry what their
//! neighbours have.

use striae_contact::side::Side;

use striae_model::{node::GlobalNode, pair_geometry::PairGeometry, tie::Ties};

/// Weight over the largest one of a node that is not asked.
const SMALL: f64 = 0.05;

/// Opponent of a side: a rigid surface or a body.
type Opponent = (Option<usize>, Option<usize>);

/// Such nodes, by pair and side; no lists without ties.
pub(super) fn shadowed(
    pairs: &[PairGeometry],
    first_node: &[usize],
    ties: &Ties,
) -> Vec<[Vec<bool>; 2]> {
    if ties.is_empty() {
        return Vec::new();
    }
    let of_side = |pair: &PairGeometry, side: Side| -> Vec<GlobalNode> {
        let (Some(body), Some(surface)) = (pair.bodies[side], pair.contact.sides[side].surface())
        else {
            return Vec::new();
        };
        let nodes = surface.nodes().iter();
        nodes
            .map(|node| GlobalNode(first_node[body] + node.index()))
            .collect()
    };
    let opponent = |pair: &PairGeometry, side: Side| -> Opponent {
        (
            pair.bodies[side.opposite()],
            pair.rigid.filter(|_| side == Side::A),
        )
    };
    let mut faces: Vec<Vec<Opponent>> = vec![Vec::new(); first_node[first_node.len() - 1]];
    for pair in pairs {
        for side in Side::BOTH {
            for node in of_side(pair, side) {
                faces[node].push(opponent(pair, side));
            }
        }
    }
    let is_shadowed = |node: GlobalNode, opponent: &Opponent| {
        let Some(follower) = ties.follower(node) else {
            return false;
        };
        let followed = || follower.weights.iter().flatten().flatten();
        let largest = followed().map(|(_, w)| w.abs()).fold(0.0, f64::max);
        followed()
            .filter(|(_, weight)| weight.abs() > SMALL * largest)
            .all(|(other, _)| faces[*other].contains(opponent))
    };
    let of_pair = |pair: &PairGeometry| {
        Side::BOTH.map(|side| {
            let opponent = opponent(pair, side);
            let is_glued = |node: GlobalNode| match (pair.bodies[side], opponent.0) {
                (Some(own), Some(other)) => ties.glues(node, [own, other]),
                _ => false,
            };
            let nodes = of_side(pair, side).into_iter();
            nodes
                .map(|node| is_shadowed(node, &opponent) || is_glued(node))
                .collect()
        })
    };
    pairs.iter().map(of_pair).collect()
}
