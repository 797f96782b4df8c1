//! History of the surfaces of bodies: slip, states of friction and depths that have worn off belong
//! to the material, in whichever pair it touches.
//!
//! Each pair lets the histories of its nodes evolve as if it were alone. Those of a place `J` that
//! several pairs `i` have then become one again,
//!
//! ```text
//! h_J = sum_i A_iJ h_iJ / sum_i A_iJ,   A_iJ = integral N_J da over what is opposite in pair i
//! ```
//!
//! For slip and states the sum is over the pairs in which the place is in contact with friction: it
//! slips as much as it does there, whatever else is opposite. For depths it is over all of them, as the mean
//! pressure that wears is over all that is opposite.

use std::collections::BTreeSet;

use striae_contact::{
    pair_state::PairState,
    side::Side,
    unknowns::{Status, Tractions},
};
use striae_law::friction::Friction;

use crate::problem::{PairNode, Problem};

/// A node with the area that belongs to it in its pair.
type Weighted = (PairNode, f64);

/// Makes the histories of places that several pairs have the same in all of them, at the end of an
/// increment with these laws of friction.
pub(crate) fn join(problem: &Problem, frictions: &[Friction], pairs: &mut [PairState]) {
    if problem.shared_nodes.is_empty() {
        return;
    }
    let of_pairs = problem.pairs.iter().zip(&*pairs);
    let areas: Vec<[Vec<f64>; 2]> = of_pairs
        .map(|(geometry, state)| Side::BOTH.map(|side| geometry.areas(side, state)))
        .collect();
    let laws = by_law(pairs);
    for place in &problem.shared_nodes {
        let weighted = place
            .iter()
            .map(|at| (*at, areas[at.pair][at.side][at.node]));
        let weighted: Vec<Weighted> = weighted.filter(|(_, area)| *area > 0.0).collect();
        if weighted.is_empty() {
            continue;
        }
        // Slip is not seen without friction.
        let touches = |(at, _): &Weighted| {
            let status = pairs[at.pair].nodes[at.side][at.node].status;
            status != Status::Open && !frictions[at.pair].is_frictionless()
        };
        let touching: Vec<Weighted> = weighted.iter().copied().filter(touches).collect();
        let evolves = |(at, _): &Weighted| frictions[at.pair].rate_and_state().is_some();
        let evolving: Vec<Weighted> = touching.iter().copied().filter(evolves).collect();
        share(place, &weighted, pairs, |tractions, at| {
            Some(&mut tractions.worn[at.side][at.node])
        });
        share(place, &touching, pairs, |tractions, at| {
            Some(&mut tractions.accumulated[at.side][at.node])
        });
        share(place, &evolving, pairs, |tractions, at| {
            Some(&mut tractions.states[at.side][at.node])
        });
        for (count, have) in &laws {
            let having = |at: &PairNode| have[at.pair];
            let place: Vec<PairNode> = place.iter().copied().filter(having).collect();
            let touching = touching.iter().copied().filter(|(at, _)| having(at));
            let touching: Vec<Weighted> = touching.collect();
            for number in 0..*count {
                share(&place, &touching, pairs, |tractions, at| {
                    let of_side = &mut tractions.factors.as_mut()?.values[at.side];
                    of_side.get_mut(count * at.node.index() + number)
                });
            }
        }
    }
}

/// Pairs with the states of a factor of friction, law by law, with their number a node.
fn by_law(pairs: &[PairState]) -> Vec<(usize, Vec<bool>)> {
    let law = |pair: &PairState| {
        let factors = pair.tractions.factors.as_ref();
        factors.map(|factors| (factors.law.clone(), factors.count))
    };
    let laws: BTreeSet<_> = pairs.iter().filter_map(law).collect();
    let having = |of: &(String, usize)| {
        pairs
            .iter()
            .map(|pair| law(pair).as_ref() == Some(of))
            .collect()
    };
    laws.iter().map(|of| (of.1, having(of))).collect()
}

/// Gives the mean of some nodes of a place to all of its nodes.
fn share(
    place: &[PairNode],
    weighted: &[Weighted],
    pairs: &mut [PairState],
    value: impl for<'a> Fn(&'a mut Tractions, PairNode) -> Option<&'a mut f64>,
) {
    let mut found = weighted.iter().filter_map(|&(at, area)| {
        let value = value(&mut pairs[at.pair].tractions, at)?;
        Some((*value, area))
    });
    let Some((first, mut whole)) = found.next() else {
        return;
    };
    // As a difference from one of them: equal values stay what they are to the last bit.
    let mut more = 0.0;
    for (value, area) in found {
        more += area * (value - first);
        whole += area;
    }
    let mean = first + more / whole;
    for &at in place {
        if let Some(value) = value(&mut pairs[at.pair].tractions, at) {
            *value = mean;
        }
    }
}
