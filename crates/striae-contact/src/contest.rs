//! Greedy choice of the nodes with the largest pivots.
//!
//! Pivots within [`TIE`] of the largest are ties, which ranks decide.

use std::{cmp::Ordering, collections::BinaryHeap};

use striae_mesh::Vec3;

use crate::{common_mass::ranks, pivots::Pivots};

/// Pivots that differ less, relative to the largest, are equal.
pub(crate) const TIE: f64 = 1e-3;
/// Distance below which two places are one, over the extent of the candidates.
pub(crate) const SAME_PLACE: f64 = 1e-9;
/// Factor on the pivot of a node that was kept in the last increment.
pub(crate) const STAY: f64 = 2.0;

/// A node that competes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    /// Its place among the pivots.
    pub node: u32,
    /// Factor on its pivot.
    pub factor: f64,
    /// Pivot times factor from which it is kept.
    pub least: f64,
}

/// Competing nodes, the first to win a tie first.
pub(crate) struct Contest {
    candidates: Vec<Candidate>,
}

/// A pivot with its factor, in a queue with the largest on top.
#[derive(PartialEq)]
struct Bid {
    value: f64,
    /// Place among the candidates.
    rank: u32,
}

impl Eq for Bid {}

impl PartialOrd for Bid {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Bid {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_value = self.value.total_cmp(&other.value);
        // The queue returns the largest bid first, so a low rank has to compare as large.
        by_value.then(other.rank.cmp(&self.rank))
    }
}

/// Candidates with equal pivots, by rank.
struct Tie {
    largest: f64,
    ranks: Vec<u32>,
}

impl Contest {
    /// A contest of candidates, of which the first wins a tie.
    pub fn new(candidates: Vec<Candidate>) -> Self {
        Self { candidates }
    }

    /// Candidates in the order in which they win ties.
    pub fn candidates(&self) -> &[Candidate] {
        &self.candidates
    }

    /// Lazy greedy choice, tie by tie: kept nodes and their pivots.
    pub fn greedy(&self, pivots: &mut Pivots) -> Vec<(u32, f64)> {
        let mut queue = BinaryHeap::with_capacity(self.candidates.len());
        for rank in 0..self.candidates.len() as u32 {
            let bound = pivots.bound(self.node(rank));
            self.queue_up(&mut queue, pivots, rank, bound);
        }
        let mut kept = Vec::new();
        while let Some(tie) = self.next_tie(&mut queue, pivots) {
            // Bids this close are equal but for round-off: position decides among them, not the
            // last digits.
            let equal = tie.largest * (1.0 - TIE);
            for rank in tie.ranks {
                let Candidate {
                    node,
                    factor,
                    least,
                } = self.candidates[rank as usize];
                let enough = equal.max(least);
                // A member of the tie that was kept just before may have taken most of this pivot.
                let pivot = pivots.refresh(node, enough / factor);
                if pivot * factor >= enough {
                    kept.push((node, pivots.bound(node)));
                    pivots.keep(node);
                    pivots.drop(node);
                } else {
                    self.queue_up(&mut queue, pivots, rank, pivot);
                }
            }
        }
        kept
    }

    fn node(&self, rank: u32) -> u32 {
        self.candidates[rank as usize].node
    }

    /// Adds the bid of a candidate, or forgets it if its pivot is too small already.
    fn queue_up(&self, queue: &mut BinaryHeap<Bid>, pivots: &mut Pivots, rank: u32, pivot: f64) {
        let Candidate {
            node,
            factor,
            least,
        } = self.candidates[rank as usize];
        let value = pivot * factor;
        if value >= least {
            queue.push(Bid { value, rank });
        } else {
            pivots.drop(node);
        }
    }

    /// Candidates that are equal to the largest; none once all are too small.
    fn next_tie(&self, queue: &mut BinaryHeap<Bid>, pivots: &mut Pivots) -> Option<Tie> {
        let mut tie: Option<Tie> = None;
        while let Some(top) = queue.pop() {
            let equal = tie.as_ref().map_or(0.0, |tie| tie.largest * (1.0 - TIE));
            if top.value < equal {
                queue.push(top);
                break;
            }
            let Candidate {
                node,
                factor,
                least,
            } = self.candidates[top.rank as usize];
            // Pivots only fall as nodes are kept, so an old value is an upper bound and is updated
            // only when it leads the queue.
            if !pivots.is_fresh(node) {
                let next = queue.peek().map_or(0.0, |bid| bid.value);
                let floor = next.max(least) * (1.0 - TIE) / factor;
                let pivot = pivots.refresh(node, floor);
                self.queue_up(queue, pivots, top.rank, pivot);
                continue;
            }
            let tie = tie.get_or_insert(Tie {
                largest: top.value,
                ranks: Vec::new(),
            });
            tie.ranks.push(top.rank);
        }
        if let Some(tie) = &mut tie {
            // The queue holds equal bids in no defined order.
            tie.ranks.sort_unstable();
        }
        tie
    }
}

/// Order of places: by distance from their middle, weighted, then by coordinates, then by a key.
pub(crate) fn from_the_middle<K: Ord>(
    places: &[(Vec3, f64)],
    key: impl Fn(usize) -> K,
) -> Vec<usize> {
    let (mut moment, mut weight) = (Vec3::zeros(), 0.0);
    let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    for (position, of_place) in places {
        moment += position * *of_place;
        weight += of_place;
        low = low.inf(position);
        high = high.sup(position);
    }
    let middle = moment / weight;
    // Nodes that mirror each other differ by round-off only; they have to get equal keys.
    let tolerance = SAME_PLACE * (high - low).norm();
    let ranked = |value: &dyn Fn(&Vec3) -> f64| {
        let values: Vec<f64> = places.iter().map(|(position, _)| value(position)).collect();
        ranks(&values, tolerance)
    };
    let keys = [
        ranked(&|x| (x - middle).norm()),
        ranked(&|x| x.x),
        ranked(&|x| x.y),
        ranked(&|x| x.z),
    ];
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by_key(|&at| (keys.each_ref().map(|of| of[at]), key(at)));
    order
}
