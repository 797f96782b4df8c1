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
//! Pivots within `TIE` of the largest are ties and kept from the middle of all candidates
//! (weighted by `w_k`) outwards: a regular pattern then grows from one place and meets
//! itself nowhere, its irregularities fall on the rim, and nodes that are uncovered soon
//! come last. Of equally distant nodes the one with the smaller coordinates goes first.
//! Distances and coordinates that differ by `SAME_PLACE` of the
//! extent are equal, by clusters rather than by rounding, which would tear equals apart.
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

mod actions;

use crate::{
    common_mass::{CommonMass, SparseRow, SparseSum},
    contest::{Candidate, Contest, STAY, TIE, from_the_middle},
    interface::{Interface, LastIncrement, Opponent},
    pivots::Pivots,
    roles::actions::Actions,
};

/// Pivot from which a node is kept.
pub const THETA_0: f64 = 0.005;
/// Coupling below which two nodes are no neighbours.
const UNCOUPLED: f64 = 1e-14;
/// Term added to the diagonal for pivots against all kept neighbours.
const BLUR: f64 = 0.02;
/// Pivot of an interior node.
pub(crate) const INTERIOR: f64 = 0.25;

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
        let contest = contest(interface, mass);
        let chosen = match interface.opponent {
            Opponent::Deformable | Opponent::Itself { .. } => {
                let surrogate = surrogate(interface, mass, &flexibility);
                let mut pivots = Pivots::new(surrogate.clone());
                let alone: Vec<f64> = (0..surrogate.len() as u32)
                    .map(|k| pivots.bound(k))
                    .collect();
                let mut chosen = contest.greedy(&mut pivots);
                // A patch without unknowns could not bear any force, however small its pivots are.
                complete(mass, &contest, &alone, &mut chosen);
                independence(surrogate, chosen)
            }
            Opponent::Rigid { .. } => {
                let pivots = covered(mass);
                let mut chosen = all(&contest, &pivots);
                complete(mass, &contest, &pivots, &mut chosen);
                chosen
            }
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

/// Candidates of a pair.
fn contest(interface: &Interface, mass: &CommonMass) -> Contest {
    let competes = |&k: &u32| mass.weighted[k as usize];
    let nodes: Vec<u32> = (0..mass.nodes.len() as u32).filter(competes).collect();
    let place = |&k: &u32| (mass.node(interface, k).position, mass.weights[k as usize]);
    let places: Vec<_> = nodes.iter().map(place).collect();
    // Nodes of both sides at one place differ in nothing but their side, which must not decide by
    // its name.
    let order = from_the_middle(&places, |at| mass.precedence(nodes[at]));
    let candidate = |at: usize| Candidate {
        node: nodes[at],
        factor: match mass.node(interface, nodes[at]).last {
            LastIncrement::Kept => STAY,
            LastIncrement::NotKept => 1.0,
        },
        least: THETA_0,
    };
    Contest::new(order.into_iter().map(candidate).collect())
}

/// All whose pivot is large enough, where none takes from another.
fn all(contest: &Contest, pivots: &[f64]) -> Vec<(u32, f64)> {
    let candidates = contest.candidates().iter();
    let of_candidates = candidates.map(|of| (of.node, pivots[of.node as usize]));
    of_candidates
        .filter(|&(_, pivot)| pivot >= THETA_0)
        .collect()
}

/// Adds the largest pivot of every patch that has no kept node yet.
fn complete(mass: &CommonMass, contest: &Contest, pivots: &[f64], kept: &mut Vec<(u32, f64)>) {
    let patch = |k: u32| mass.patch[k as usize].expect("candidates have overlaps") as usize;
    let bid = |of: &Candidate| pivots[of.node as usize] * of.factor;
    let mut has_kept = vec![false; mass.nodes.len()];
    for &(k, _) in kept.iter() {
        has_kept[patch(k)] = true;
    }
    let mut largest = vec![0.0_f64; mass.nodes.len()];
    for of in contest.candidates() {
        let at = patch(of.node);
        largest[at] = largest[at].max(bid(of));
    }
    for of in contest.candidates() {
        let at = patch(of.node);
        if !has_kept[at] && bid(of) >= largest[at] * (1.0 - TIE) {
            has_kept[at] = true;
            kept.push((of.node, pivots[of.node as usize]));
        }
    }
}
