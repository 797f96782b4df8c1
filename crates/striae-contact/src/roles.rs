//! Choice of the nodes of a pair that keep traction unknowns.
//!
//! The choice maximises pivots of a local, dimensionless surrogate of the compliance
//! that the unknowns of both bodies see:
//!
//! ```text
//! l_k  = (1/w_k) sum_J D_kJ h_J/E_J
//! S_kl = sum_J D_kJ kappa_J D_Jl / sqrt(w_k l_k w_l l_l),   kappa_J = 1/(E_J h_J)
//! d_k  = S_kk - S_kn S_nn^-1 S_nk,   n: kept nodes that couple with k
//! ```
//!
//! with `J` over the nodes of both sides. The largest pivot is kept next while it is
//! at least [`THETA_0`]. A node kept in the last increment competes with twice its
//! pivot: equals would flip otherwise, and a node that leaves would not have faded yet.
//! Every patch keeps at least one node.
//!
//! Pivots within [`TIE`] of the largest are ties and kept from the middle of all
//! candidates (weighted by `w_k`) outwards: a regular pattern then grows from one
//! place and meets itself nowhere, its irregularities fall on the rim, and nodes that
//! are uncovered soon come last. Of equally distant nodes the one with the smaller
//! coordinates goes first. Distances and coordinates within [`SAME_PLACE`] of the
//! extent are equal, by clusters rather than by rounding, which would tear equals
//! apart.
//!
//! The order in which dependent nodes are kept decides their pivots, so two of them that
//! change places would make pivots jump. The ramp takes pivots that no order enters:
//! against all kept neighbours at once, with a diagonal that is stiffer by `BLUR`,
//!
//! ```text
//! d_k = S_kk - S_kn (S_nn + BLUR I)^-1 S_nk
//! ```
//!
//! In self-contact a node of the mesh may be pressed from both of its faces, which scalars do not
//! see. There the forces of unit pressures are vectors,
//!
//! ```text
//! f_Jk = sum_segments (+-) D_kJ n,   S_kl = sum_J kappa_J f_Jk . f_Jl / sqrt(w_k l_k w_l l_l)
//! ```
//!
//! with `J` over the nodes of the mesh and `kappa_J` the mean over their faces.
//!
//! Against a rigid surface unknowns of one side do not compete. There
//! `d_k = 1/4 sum_i D_ki^2 / sum_i (D_ki of whole facets)^2`: 1/4 as that of an
//! interior node above, and falling to zero as a sliver does.
//!
//! Longer than other files, as the contest of the nodes is one algorithm.

mod actions;

use std::{cmp::Ordering, collections::BinaryHeap};

use striae_mesh::Vec3;

use crate::{
    common_mass::{CommonMass, SparseRow, SparseSum, ranks},
    interface::{Interface, LastIncrement, Opponent},
    pivots::Pivots,
    roles::actions::Actions,
};

/// Pivot from which a node is kept.
pub const THETA_0: f64 = 0.005;
/// Pivots that differ less, relative to the largest, are equal.
pub const TIE: f64 = 1e-3;
/// Distance below which two places are one, over the extent of the candidates.
pub const SAME_PLACE: f64 = 1e-9;
/// Factor on the pivot of a node that was kept in the last increment.
const STAY: f64 = 2.0;
/// Coupling below which two nodes are no neighbours.
const UNCOUPLED: f64 = 1e-14;
/// Term added to the diagonal for pivots against all kept neighbours.
const BLUR: f64 = 0.02;
/// Pivot of an interior node.
const INTERIOR: f64 = 0.25;

/// Kept nodes, by place in the order of the common mass.
pub(crate) struct Choice {
    /// Sorted by side and number.
    pub kept: Vec<u32>,
    /// Mutual independence of the kept nodes, for the ramp.
    pub pivots: Vec<f64>,
    /// `l_k`.
    pub flexibility: Vec<f64>,
}

impl Choice {
    /// Chooses.
    pub fn new(interface: &Interface, mass: &CommonMass) -> Self {
        let flexibility = flexibility(interface, mass);
        let contest = Contest::new(interface, mass);
        let chosen = match interface.opponent {
            Opponent::Deformable | Opponent::Itself { .. } => {
                let surrogate = surrogate(interface, mass, &flexibility);
                let chosen = contest.greedy(Pivots::new(surrogate.clone()));
                independence(surrogate, chosen)
            }
            Opponent::Rigid { .. } => contest.all(&covered(mass)),
        };
        Self::of(mass, flexibility, chosen)
    }

    /// Keeps given nodes, as far as they have overlaps.
    pub fn given(interface: &Interface, mass: &CommonMass, kept: &[Vec<bool>; 2]) -> Self {
        let flexibility = flexibility(interface, mass);
        let count = mass.nodes.len() as u32;
        let is_kept = |&k: &u32| {
            let (side, node) = mass.nodes[k as usize];
            mass.weighted[k as usize] && kept[side][node]
        };
        let given = (0..count).filter(is_kept);
        let chosen = match interface.opponent {
            Opponent::Deformable | Opponent::Itself { .. } => {
                let surrogate = surrogate(interface, mass, &flexibility);
                independence(surrogate, given.map(|k| (k, 0.0)).collect())
            }
            Opponent::Rigid { .. } => {
                let pivots = covered(mass);
                given.map(|k| (k, pivots[k as usize])).collect()
            }
        };
        Self::of(mass, flexibility, chosen)
    }

    fn of(mass: &CommonMass, flexibility: Vec<f64>, mut chosen: Vec<(u32, f64)>) -> Self {
        // The order of choice is a heuristic; unknowns are numbered by side and node, whatever it
        // was.
        chosen.sort_by_key(|&(k, _)| mass.nodes[k as usize]);
        Self {
            flexibility: chosen
                .iter()
                .map(|&(k, _)| flexibility[k as usize])
                .collect(),
            pivots: chosen.iter().map(|&(_, pivot)| pivot).collect(),
            kept: chosen.into_iter().map(|(k, _)| k).collect(),
        }
    }
}

/// Pivots of the kept nodes against all kept neighbours, with a stiffer diagonal.
fn independence(mut surrogate: Vec<SparseRow>, chosen: Vec<(u32, f64)>) -> Vec<(u32, f64)> {
    for (k, row) in surrogate.iter_mut().enumerate() {
        if let Some(entry) = row.iter_mut().find(|entry| entry.0 == k as u32) {
            // Without it two nodes that depend on each other would both count as worthless, and the
            // ramp would stiffen both.
            entry.1 += BLUR;
        }
    }
    let mut pivots = Pivots::new(surrogate);
    chosen.iter().for_each(|&(k, _)| pivots.keep(k));
    // The pivots of the choice depend on the order in which nodes were kept and jump when two of
    // them change places; these do not.
    let of = |&(k, _): &(u32, f64)| (k, pivots.refresh(k, 0.0) - BLUR);
    chosen.iter().map(of).collect()
}

/// `l_k`, zero for nodes without weight.
fn flexibility(interface: &Interface, mass: &CommonMass) -> Vec<f64> {
    let of = |k: usize| {
        let seen = mass.rows[k]
            .iter()
            .map(|&(j, value)| value * mass.node(interface, j).flexibility);
        if mass.weighted[k] {
            seen.sum::<f64>() / mass.weights[k]
        } else {
            0.0
        }
    };
    (0..mass.nodes.len()).map(of).collect()
}

/// Rows `S_k`, empty for nodes that are no candidates.
fn surrogate(interface: &Interface, mass: &CommonMass, flexibility: &[f64]) -> Vec<SparseRow> {
    let count = mass.nodes.len();
    let scale: Vec<f64> = (0..count)
        .map(|k| {
            let square = mass.weights[k] * flexibility[k];
            if square > 0.0 {
                square.sqrt().recip()
            } else {
                0.0
            }
        })
        .collect();
    let actions = match interface.opponent {
        Opponent::Itself { mesh, .. } => Some(Actions::new(interface, mass, mesh)),
        Opponent::Deformable | Opponent::Rigid { .. } => None,
    };
    let mut sum = SparseSum::new(count);
    let row = |k: usize| {
        if scale[k] == 0.0 {
            return SparseRow::new();
        }
        if let Some(actions) = &actions {
            for &(l, value) in &actions.row(k) {
                if scale[l as usize] > 0.0 {
                    sum.add(l, value);
                }
            }
        } else {
            for &(j, by_k) in &mass.rows[k] {
                let compliance = mass.node(interface, j).compliance;
                for &(l, by_l) in &mass.rows[j as usize] {
                    if scale[l as usize] > 0.0 {
                        sum.add(l, compliance * (by_k * by_l));
                    }
                }
            }
        }
        let mut row = sum.take();
        for (l, value) in &mut row {
            *value *= scale[k] * scale[*l as usize];
        }
        // Round-off would couple nodes that share no segment, and lengthen every elimination.
        row.retain(|&(_, value)| value.abs() > UNCOUPLED);
        row
    };
    (0..count).map(row).collect()
}

/// Pivots against a rigid surface.
fn covered(mass: &CommonMass) -> Vec<f64> {
    let square = |row: &SparseRow| row.iter().map(|(_, value)| value * value).sum::<f64>();
    let pivot = |(row, whole): (&SparseRow, &SparseRow)| {
        let whole = square(whole);
        if whole > 0.0 {
            INTERIOR * square(row) / whole
        } else {
            0.0
        }
    };
    mass.rows.iter().zip(&mass.whole).map(pivot).collect()
}

/// Competing nodes, and the order among equals.
struct Contest<'a> {
    mass: &'a CommonMass,
    /// Candidates, the first to win a tie first.
    candidates: Vec<u32>,
    /// Place among them.
    rank: Vec<u32>,
    /// Factor on the pivot.
    factor: Vec<f64>,
}

/// A pivot with its factor, in a queue with the largest on top.
#[derive(PartialEq)]
struct Bid {
    value: f64,
    rank: u32,
    node: u32,
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

impl<'a> Contest<'a> {
    fn new(interface: &Interface, mass: &'a CommonMass) -> Self {
        let count = mass.nodes.len() as u32;
        let competes = |&k: &u32| mass.weighted[k as usize];
        let candidates = (0..count).filter(competes).collect();
        let candidates = from_the_middle(interface, mass, candidates);
        let mut rank = vec![0; count as usize];
        for (at, &k) in candidates.iter().enumerate() {
            rank[k as usize] = at as u32;
        }
        let factor = |k| match mass.node(interface, k).last {
            LastIncrement::Kept => STAY,
            LastIncrement::NotKept => 1.0,
        };
        Self {
            mass,
            candidates,
            rank,
            factor: (0..count).map(factor).collect(),
        }
    }

    fn bid(&self, k: u32, pivot: f64) -> Bid {
        Bid {
            value: pivot * self.factor[k as usize],
            rank: self.rank[k as usize],
            node: k,
        }
    }

    /// Lazy greedy choice, tie by tie: kept nodes and their pivots.
    fn greedy(&self, mut pivots: Pivots) -> Vec<(u32, f64)> {
        let first: Vec<(u32, f64)> = self
            .candidates
            .iter()
            .map(|&k| (k, pivots.bound(k)))
            .collect();
        let mut queue: BinaryHeap<Bid> = first.iter().map(|&(k, d)| self.bid(k, d)).collect();
        let mut kept = Vec::new();
        while let Some(tie) = self.next_tie(&mut queue, &mut pivots) {
            // Bids this close are equal but for round-off: position decides among them, not the
            // last digits.
            let least = (tie.largest * (1.0 - TIE)).max(THETA_0);
            for k in tie.nodes {
                let floor = least / self.factor[k as usize];
                // A member of the tie that was kept just before may have taken most of this pivot.
                let bid = self.bid(k, pivots.refresh(k, floor));
                if bid.value >= least {
                    kept.push((k, pivots.bound(k)));
                    pivots.keep(k);
                    pivots.drop(k);
                } else if bid.value >= THETA_0 {
                    queue.push(bid);
                } else {
                    pivots.drop(k);
                }
            }
        }
        // A patch without unknowns could not bear any force, however small its pivots are.
        self.complete(&mut kept, &first);
        kept
    }

    /// Candidates that are equal to the largest; none once that is too small.
    fn next_tie(&self, queue: &mut BinaryHeap<Bid>, pivots: &mut Pivots) -> Option<Tie> {
        let mut tie: Option<Tie> = None;
        while let Some(top) = queue.pop() {
            let least = tie
                .as_ref()
                .map_or(THETA_0, |tie| tie.largest * (1.0 - TIE));
            if top.value < least {
                queue.push(top);
                break;
            }
            // Pivots only fall as nodes are kept, so an old value is an upper bound and is updated
            // only when it leads the queue.
            if !pivots.is_fresh(top.node) {
                let next = queue.peek().map_or(THETA_0, |bid| bid.value);
                let floor = next.max(THETA_0) * (1.0 - TIE) / self.factor[top.node as usize];
                let bid = self.bid(top.node, pivots.refresh(top.node, floor));
                if bid.value >= THETA_0 {
                    queue.push(bid);
                } else {
                    pivots.drop(top.node);
                }
                continue;
            }
            let tie = tie.get_or_insert(Tie {
                largest: top.value,
                nodes: Vec::new(),
            });
            tie.nodes.push(top.node);
        }
        if let Some(tie) = &mut tie {
            // The queue holds equal bids in no defined order.
            tie.nodes.sort_by_key(|&k| self.rank[k as usize]);
        }
        tie
    }

    /// All whose pivot is large enough, where none takes from another.
    fn all(&self, pivots: &[f64]) -> Vec<(u32, f64)> {
        let pivots: Vec<(u32, f64)> = self
            .candidates
            .iter()
            .map(|&k| (k, pivots[k as usize]))
            .collect();
        let enough = |&&(_, pivot): &&(u32, f64)| pivot >= THETA_0;
        let mut kept = pivots.iter().filter(enough).copied().collect();
        self.complete(&mut kept, &pivots);
        kept
    }

    /// The largest pivot of every patch that has no kept node yet.
    fn complete(&self, kept: &mut Vec<(u32, f64)>, pivots: &[(u32, f64)]) {
        let patch =
            |k: u32| self.mass.patch[k as usize].expect("candidates have overlaps") as usize;
        let mut has_kept = vec![false; self.mass.nodes.len()];
        for &(k, _) in kept.iter() {
            has_kept[patch(k)] = true;
        }
        let mut largest = vec![0.0_f64; self.mass.nodes.len()];
        for &(k, pivot) in pivots {
            let value = self.bid(k, pivot).value;
            largest[patch(k)] = largest[patch(k)].max(value);
        }
        for &(k, pivot) in pivots {
            let enough = largest[patch(k)] * (1.0 - TIE);
            if !has_kept[patch(k)] && self.bid(k, pivot).value >= enough {
                has_kept[patch(k)] = true;
                kept.push((k, pivot));
            }
        }
    }
}

/// Candidates with equal pivots.
struct Tie {
    largest: f64,
    nodes: Vec<u32>,
}

/// Candidates by distance from their middle, then by coordinates.
fn from_the_middle(interface: &Interface, mass: &CommonMass, candidates: Vec<u32>) -> Vec<u32> {
    let position = |k: u32| mass.node(interface, k).position;
    let (mut moment, mut weight) = (Vec3::zeros(), 0.0);
    let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    for &k in &candidates {
        moment += position(k) * mass.weights[k as usize];
        weight += mass.weights[k as usize];
        low = low.inf(&position(k));
        high = high.sup(&position(k));
    }
    let middle = moment / weight;
    // Nodes that mirror each other differ by round-off only; they have to get equal keys.
    let tolerance = SAME_PLACE * (high - low).norm();
    let ranked = |value: &dyn Fn(u32) -> f64| {
        let values: Vec<f64> = candidates.iter().map(|&k| value(k)).collect();
        ranks(&values, tolerance)
    };
    let keys = [
        ranked(&|k| (position(k) - middle).norm()),
        ranked(&|k| position(k).x),
        ranked(&|k| position(k).y),
        ranked(&|k| position(k).z),
    ];
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    // Nodes of both sides at one place differ in nothing but their side, which must not decide by
    // its name.
    let first = |at: usize| mass.precedence(candidates[at]);
    order.sort_by_key(|&at| (keys.each_ref().map(|key| key[at]), first(at)));
    order.into_iter().map(|at| candidates[at]).collect()
}
