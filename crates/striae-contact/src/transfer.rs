//! Transfer of traction to nodes that are not kept.
//!
//! ```text
//! (I - M_TT) Z_T = M_TK,   (I - S_TT) Y_T = S_TK,   S_tj = +-M_tj
//! ```
//!
//! Row `t` of `M` holds the weights of the opposing nodes at the clamped projection of
//! node `t`, restricted to nodes with weight and normalised. Against a rigid surface it
//! is the mean of the own neighbours, `M_tk = D_tk / sum over k != t`, over whole facets
//! for a node without weight. A node whose row leads to no kept node takes the mean of
//! the nearest ones of its patch. `Z >= 0` and `Z 1 = 1`, see `absorption.rs`.
//!
//! Pressure has no side, friction acts on the surface of its node: what is handed on from one
//! surface to the one that it faces changes its sign, so `S` has `-` there and `+` among
//! neighbours. Between two sides `Y = +-Z`. In self-contact both follow from one chain on two
//! sheets, with a node on each, that every change of sign changes: with `Z+` and `Z-` what leads
//! from the first sheet to each of them, `Z = Z+ + Z-`, `Y = Z+ - Z-`, so `|Y| <= Z`.

use striae_surface::node::SurfaceNode;

use crate::{
    absorption::{State, absorption, combined, normalised},
    common_mass::{CommonMass, SparseRow, SparseSum},
    interface::{Interface, Opponent},
    side::Side,
};

/// Sum of weights below which a projection sees no node with weight.
const UNSEEN: f64 = 1e-12;
/// Share of its row by which a node has to be tied to kept ones.
const TIED: f64 = 1e-2;
/// Kept nodes whose distances differ less, relative to the smallest, are equally near.
const EQUALLY_NEAR: f64 = 1e-6;

/// Place of a kept node, and its shares in pressure and friction: entries of `Z` and `Y`.
pub(crate) type Share = (u32, [f64; 2]);

/// Rows of `Z` and `Y`, and what they follow from, by place in the order of the common mass.
pub(crate) struct Transfer {
    /// Empty for nodes that carry nothing.
    pub rows: Vec<Vec<Share>>,
    /// For every kept node what it would take if it were not: a combination of kept nodes.
    pub released: Vec<Vec<Share>>,
}

impl Transfer {
    /// Solves for the rows.
    pub fn new(interface: &Interface, mass: &CommonMass, kept: &[u32]) -> Self {
        let count = mass.nodes.len();
        let mut is_kept = vec![false; count];
        kept.iter().for_each(|&k| is_kept[k as usize] = true);
        let mut taken: Vec<SparseRow> = (0..count as u32)
            .map(|t| {
                // Also nodes without weight yet: they may cross the edge of a facet within the
                // increment.
                if mass.carries[t as usize] {
                    taken(interface, mass, t)
                } else {
                    SparseRow::new()
                }
            })
            .collect();
        let tied = tied(mass, &taken, &is_kept);
        let mut is_nearest = vec![false; count];
        for t in 0..count {
            let alone = if mass.weighted[t] {
                !tied[t]
            } else {
                taken[t].is_empty()
            };
            if mass.carries[t] && (is_kept[t] && taken[t].is_empty() || !is_kept[t] && alone) {
                // Without a row of its own the chain would never reach a kept node.
                taken[t] = nearest(interface, mass, t as u32, kept);
                is_nearest[t] = true;
            }
        }
        let state = |t: usize| match (is_kept[t], mass.carries[t]) {
            (true, _) => State::Absorbing,
            (false, true) => State::Transient(taken[t].clone()),
            (false, false) => State::Outside,
        };
        match interface.opponent {
            Opponent::Deformable | Opponent::Rigid { .. } => {
                let rows = absorption((0..count).map(state).collect());
                let mut sum = SparseSum::new(count);
                let released = kept.iter().map(|&k| {
                    let taken = &taken[k as usize];
                    match is_nearest[k as usize] {
                        true => taken.clone(),
                        false => combined(taken, &rows, &mut sum),
                    }
                });
                let released: Vec<SparseRow> = released.collect();
                let signed = |t: u32, row: &SparseRow| -> Vec<Share> {
                    let (side, _) = mass.nodes[t as usize];
                    let sign = |k: u32| match mass.nodes[k as usize].0 == side {
                        true => 1.0,
                        false => -1.0,
                    };
                    row.iter().map(|&(k, z)| (k, [z, z * sign(k)])).collect()
                };
                Self {
                    rows: (0..).zip(&rows).map(|(t, row)| signed(t, row)).collect(),
                    released: kept
                        .iter()
                        .zip(&released)
                        .map(|(&k, row)| signed(k, row))
                        .collect(),
                }
            }
            Opponent::Itself { .. } => {
                let sign = |t: u32, j: u32| match is_nearest[t as usize] {
                    true => interface.sign([t, j].map(|k| mass.nodes[k as usize])),
                    false => -1.0,
                };
                on_two_sheets((0..count).map(state).collect(), &taken, kept, sign)
            }
        }
    }
}

/// Solves for the rows of `Z` and `Y` on two sheets, where what node `t` takes from `j` has the
/// sign `sign(t, j)`.
fn on_two_sheets(
    states: Vec<State>,
    taken: &[SparseRow],
    kept: &[u32],
    sign: impl Fn(u32, u32) -> f64,
) -> Transfer {
    let count = states.len() as u32;
    let row_of = |t: u32, sheet: u32| -> SparseRow {
        let entry = |&(j, value): &(u32, f64)| {
            let sheet = if sign(t, j) < 0.0 { 1 - sheet } else { sheet };
            (j + sheet * count, value)
        };
        let mut row: SparseRow = taken[t as usize].iter().map(entry).collect();
        row.sort_by_key(|&(j, _)| j);
        row
    };
    let on_sheet = |sheet: u32| {
        let states = (0..).zip(&states);
        states.map(move |(t, state)| match state {
            State::Transient(_) => State::Transient(row_of(t, sheet)),
            State::Absorbing => State::Absorbing,
            State::Outside => State::Outside,
        })
    };
    let rows = absorption(on_sheet(0).chain(on_sheet(1)).collect());
    let joined = |row: &SparseRow| -> Vec<Share> {
        let mut joined: Vec<Share> = Vec::with_capacity(row.len());
        let sheets = row.iter().map(|&(k, z)| match k < count {
            true => (k, [z, z]),
            false => (k - count, [z, -z]),
        });
        let mut entries: Vec<Share> = sheets.collect();
        entries.sort_by_key(|&(k, _)| k);
        for (k, [z, y]) in entries {
            match joined.last_mut() {
                Some((last, sum)) if *last == k => {
                    sum[0] += z;
                    sum[1] += y;
                }
                _ => joined.push((k, [z, y])),
            }
        }
        joined
    };
    let mut sum = SparseSum::new(2 * count as usize);
    let released = kept
        .iter()
        .map(|&k| joined(&combined(&row_of(k, 0), &rows, &mut sum)));
    Transfer {
        released: released.collect(),
        rows: rows[..count as usize].iter().map(joined).collect(),
    }
}

/// Row of `M`, empty if the node sees none with weight.
fn taken(interface: &Interface, mass: &CommonMass, t: u32) -> SparseRow {
    let (side, node) = mass.nodes[t as usize];
    let mut row = match interface.opponent {
        Opponent::Deformable | Opponent::Itself { .. } => opposing(interface, mass, side, node),
        Opponent::Rigid { .. } if mass.weighted[t as usize] => mass.rows[t as usize].clone(),
        Opponent::Rigid { .. } => mass.whole[t as usize].clone(),
    };
    row.retain(|&(j, value)| {
        !is_same(interface, mass, t, j) && mass.weighted[j as usize] && value > 0.0
    });
    let total: f64 = row.iter().map(|(_, value)| value).sum();
    let enough = match interface.opponent {
        Opponent::Deformable | Opponent::Itself { .. } => UNSEEN,
        Opponent::Rigid { .. } => 0.0,
    };
    if total > enough {
        normalised(row)
    } else {
        SparseRow::new()
    }
}

/// Returns whether two nodes are one node of the mesh.
fn is_same(interface: &Interface, mass: &CommonMass, t: u32, j: u32) -> bool {
    match interface.opponent {
        Opponent::Itself { mesh, .. } => {
            let [t, j] = [t, j].map(|k| mesh[mass.nodes[k as usize].1.index()]);
            t == j
        }
        Opponent::Deformable | Opponent::Rigid { .. } => t == j,
    }
}

fn opposing(interface: &Interface, mass: &CommonMass, side: Side, node: SurfaceNode) -> SparseRow {
    let Some((corners, weights)) = interface.opposing[side][node] else {
        return SparseRow::new();
    };
    let mut row: SparseRow = Vec::with_capacity(4);
    for (corner, weight) in corners.into_iter().zip(weights) {
        if let Some(j) = mass.index[interface.opposing_side(side)][corner] {
            match row.iter_mut().find(|entry| entry.0 == j) {
                Some(entry) => entry.1 += weight,
                None => row.push((j, weight)),
            }
        }
    }
    row.sort_by_key(|&(j, _)| j);
    row
}

/// Nodes with weight that reach kept ones by shares that are not small.
fn tied(mass: &CommonMass, taken: &[SparseRow], is_kept: &[bool]) -> Vec<bool> {
    let mut users = vec![Vec::new(); taken.len()];
    for (t, row) in taken.iter().enumerate() {
        if mass.weighted[t] && !is_kept[t] {
            row.iter().for_each(|&(j, _)| users[j as usize].push(t));
        }
    }
    let mut tied = is_kept.to_vec();
    let mut fresh: Vec<usize> = (0..taken.len()).filter(|&k| is_kept[k]).collect();
    while let Some(j) = fresh.pop() {
        for &t in &users[j] {
            let share = |row: &SparseRow| -> f64 {
                let tied = row.iter().filter(|&&(j, _)| tied[j as usize]);
                tied.map(|(_, value)| value).sum()
            };
            // A chain that reaches kept nodes with a tiny weight only would amplify round-off.
            if !tied[t] && share(&taken[t]) > TIED {
                tied[t] = true;
                fresh.push(t);
            }
        }
    }
    tied
}

/// Mean of the nearest other kept nodes, of the same patch if it has any.
fn nearest(interface: &Interface, mass: &CommonMass, t: u32, kept: &[u32]) -> SparseRow {
    let patch = mass.patch[t as usize];
    let others = || kept.iter().copied().filter(|&k| k != t);
    let mut near: Vec<u32> = others()
        .filter(|&k| patch.is_some() && mass.patch[k as usize] == patch)
        .collect();
    if near.is_empty() {
        // `t` may be the only kept node of its patch, or in no patch at all.
        near = others().collect();
    }
    let place = mass.node(interface, t).position;
    let distance = |k: u32| (mass.node(interface, k).position - place).norm();
    let least = near
        .iter()
        .map(|&k| distance(k))
        .fold(f64::INFINITY, f64::min);
    // All equally near nodes share: taking one of them would depend on the numbering.
    near.retain(|&k| distance(k) <= least * (1.0 + EQUALLY_NEAR));
    // Sums over the row run in a fixed order, so that their last bits are reproducible.
    near.sort_unstable();
    let share = 1.0 / near.len() as f64;
    near.into_iter().map(|k| (k, share)).collect()
}
