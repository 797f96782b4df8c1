//! The traction field of a pair: its unknowns and how nodes take part in it.
//!
//! ```text
//! phi_k = 1/2 (N^i Z + N^j Z)_k,   against a rigid surface (N^i Z)_k
//! psi_k = 1/2 (N^i Y - N^j Y)_k,   against a rigid surface (N^i Y)_k
//! w_k   = integral phi_k
//! ```
//!
//! on the facets `i` and `j` of a segment, with `Z` for pressure and `Y` for friction seen from `i`,
//! see `transfer`.
//!
//! `phi_k >= 0` and `sum_k phi_k = 1` on every common polygon.
//!
//! The *ramp* ties a kept node with a small pivot to what it would take if it were
//! not kept, the more so the less independent it is:
//!
//! ```text
//! E = sum over weak k of eps_k w_k R_k^T R_k,   R_k = e_k - M_k Z,   for friction e_k - M'_k Y
//! eps_k = c (h_a/E_a + h_b/E_b) (theta_1 - d_k)/(d_k - theta_0)
//! ```

use striae_surface::node::SurfaceNode;

use crate::{
    common_mass::{CommonMass, SparseRow},
    interface::{Interface, Opponent},
    roles::{Choice, THETA_0},
    side::Side,
    transfer::{Share, Transfer},
    wear_rows::wear_rows,
};

/// Pivot below which a kept node is weak.
pub const THETA_1: f64 = 0.1;
/// Factor of the ramp.
const RAMP: f64 = 0.1;
/// Smallest distance of a pivot from [`THETA_0`] over the latter.
const CLOSEST: f64 = 1e-3;

/// A node with traction unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct KeptNode {
    /// Its side.
    pub side: Side,
    /// Its number on that side.
    pub node: SurfaceNode,
}

impl KeptNode {
    /// Side and node as indices.
    pub fn place(self) -> (Side, SurfaceNode) {
        (self.side, self.node)
    }
}

/// A weak kept node.
#[derive(Clone, Debug, PartialEq)]
pub struct Weak {
    /// Its place among the kept nodes.
    pub kept: u32,
    /// `eps_k w_k`.
    pub coefficient: f64,
    /// `R_k` by place among the kept nodes, of sum zero.
    pub row: Vec<(u32, f64)>,
    /// Row for friction, of the same places.
    pub friction_row: Vec<(u32, f64)>,
}

/// Unknowns of a pair and their basis.
#[derive(Clone, Debug, PartialEq)]
pub struct TractionBasis {
    /// Kept nodes, by side and number.
    pub kept: Vec<KeptNode>,
    /// Place of every node among them.
    pub index: [Vec<Option<u32>>; 2],
    /// Pivots `d_k` of the kept nodes.
    pub pivots: Vec<f64>,
    /// `l_k`, what `h_a/E_a + h_b/E_b` is on average around the kept nodes.
    pub flexibility: Vec<f64>,
    /// `integral phi_k` of the kept nodes.
    pub weights: Vec<f64>,
    /// `integral N_k` of all nodes over the common polygons.
    pub node_weights: [Vec<f64>; 2],
    /// Rows of `Z` of all nodes by place among the kept ones: `(k, 1)` for a kept
    /// node, empty for one that carries nothing.
    pub rows: [Vec<Vec<(u32, f64)>>; 2],
    /// Entries of `Y`, in the order of those rows.
    pub friction_rows: [Vec<Vec<f64>>; 2],
    /// Weak kept nodes.
    pub ramp: Vec<Weak>,
    /// Rows of `E` by place among the kept nodes, ascending.
    pub coupling: Vec<Vec<(u32, f64)>>,
    /// Rows of `M` by place among the kept nodes, ascending: how wear at them opens the gaps, see
    /// `wear_rows`. Empty for pairs without wear.
    pub wear: Vec<Vec<(u32, f64)>>,
    /// Nodes of the surface opposite to the kept nodes, with their shares in its mean over the
    /// support, `D_kJ/sum_J D_kJ`; empty against a rigid surface.
    pub opposite: Vec<Vec<(Side, SurfaceNode, f64)>>,
}

impl TractionBasis {
    /// Chooses the unknowns of an increment and their basis.
    pub fn new(interface: &Interface) -> Self {
        let mass = CommonMass::new(interface);
        let choice = Choice::new(interface, &mass);
        Self::of(interface, &mass, &choice)
    }

    /// Basis of unknowns at given nodes, of which those without an overlap are left out.
    pub fn with_kept(interface: &Interface, kept: &[Vec<bool>; 2]) -> Self {
        let mass = CommonMass::new(interface);
        let choice = Choice::given(interface, &mass, kept);
        Self::of(interface, &mass, &choice)
    }

    fn of(interface: &Interface, mass: &CommonMass, choice: &Choice) -> Self {
        let transfer = Transfer::new(interface, mass, &choice.kept);
        let kept: Vec<KeptNode> = choice
            .kept
            .iter()
            .map(|&k| {
                let (side, node) = mass.nodes[k as usize];
                KeptNode { side, node }
            })
            .collect();
        let mut basis = Self {
            index: Side::BOTH.map(|side| vec![None; interface.nodes[side].len()]),
            node_weights: Side::BOTH.map(|side| vec![0.0; interface.nodes[side].len()]),
            rows: Side::BOTH.map(|side| vec![Vec::new(); interface.nodes[side].len()]),
            friction_rows: Side::BOTH.map(|side| vec![Vec::new(); interface.nodes[side].len()]),
            weights: weights(interface, mass, &transfer, &choice.kept),
            pivots: choice.pivots.clone(),
            flexibility: choice.flexibility.clone(),
            kept,
            ramp: Vec::new(),
            coupling: Vec::new(),
            wear: Vec::new(),
            opposite: opposite(interface, mass, &choice.kept),
        };
        for (k, &KeptNode { side, node }) in basis.kept.iter().enumerate() {
            basis.index[side][node] = Some(k as u32);
        }
        for (t, &(side, node)) in mass.nodes.iter().enumerate() {
            basis.node_weights[side][node] = mass.weights[t];
            let row = basis.numbered(mass, &transfer.rows[t]);
            basis.rows[side][node] = row.iter().map(|&(k, [z, _])| (k, z)).collect();
            basis.friction_rows[side][node] = row.iter().map(|&(_, [_, y])| y).collect();
        }
        basis.ramp = basis.ramp(interface, mass, &transfer.released);
        let pressures = basis.ramp.iter().map(|weak| (weak.coefficient, &weak.row));
        basis.coupling = coupling(pressures, basis.kept.len());
        if interface.wear != [0.0; 2] {
            let rows = wear_rows(mass, &transfer, interface.wear, interface.share());
            basis.wear = basis.wear(mass, &rows, &choice.kept);
        }
        basis
    }

    /// Rows of `M`, from those of `w_k M` by place in the order of the common mass.
    fn wear(&self, mass: &CommonMass, rows: &[SparseRow], kept: &[u32]) -> Vec<Vec<(u32, f64)>> {
        let kept = kept.iter().zip(&self.weights);
        kept.map(|(&place, weight)| {
            let row = rows[place as usize].iter();
            let mut row: Vec<(u32, f64)> = row
                .map(|&(l, value)| (self.place(mass, l), value / weight))
                .collect();
            row.sort_by_key(|&(l, _)| l);
            row
        })
        .collect()
    }

    /// A row by place among the kept nodes.
    fn numbered(&self, mass: &CommonMass, row: &[Share]) -> Vec<Share> {
        let kept = |&(k, value): &Share| (self.place(mass, k), value);
        let mut row: Vec<_> = row.iter().map(kept).collect();
        row.sort_by_key(|&(k, _)| k);
        row
    }

    /// Place among the kept nodes of one in the order of the common mass.
    fn place(&self, mass: &CommonMass, k: u32) -> u32 {
        let (side, node) = mass.nodes[k as usize];
        self.index[side][node].expect("rows lead to kept nodes")
    }

    fn ramp(&self, interface: &Interface, mass: &CommonMass, released: &[Vec<Share>]) -> Vec<Weak> {
        let place = |k: usize| {
            let KeptNode { side, node } = self.kept[k];
            mass.index[side][node]
        };
        let weak = (0..self.kept.len()).filter(|&k| self.pivots[k] < THETA_1);
        let weak = weak.filter_map(|k| {
            let pivot = self.pivots[k];
            // A node kept by hysteresis may lie below the threshold; its ramp stays finite and
            // positive.
            let over = (pivot - THETA_0).max(CLOSEST * THETA_0);
            let eps = RAMP * facing(interface, self.kept[k]) * (THETA_1 - pivot) / over;
            let row = departure(place(k)?, &released[k]);
            if row.is_empty() {
                return None;
            }
            let row = self.numbered(mass, &row);
            Some(Weak {
                kept: k as u32,
                coefficient: eps * self.weights[k],
                friction_row: row.iter().map(|&(k, [_, y])| (k, y)).collect(),
                row: row.iter().map(|&(k, [z, _])| (k, z)).collect(),
            })
        });
        weak.collect()
    }
}

/// Rows of `E` of so many kept nodes, by coefficients and rows of weak nodes.
pub(crate) fn coupling<'a>(
    ramp: impl IntoIterator<Item = (f64, &'a Vec<(u32, f64)>)>,
    kept: usize,
) -> Vec<Vec<(u32, f64)>> {
    let mut rows: Vec<Vec<(u32, f64)>> = vec![Vec::new(); kept];
    for (coefficient, row) in ramp {
        for &(k, weight) in row {
            let part = |&(l, other): &(u32, f64)| (l, coefficient * weight * other);
            rows[k as usize].extend(row.iter().map(part));
        }
    }
    for row in &mut rows {
        // Stable, so that terms add up in the order of the weak nodes.
        row.sort_by_key(|&(l, _)| l);
        row.dedup_by(|next, sum| {
            let same = next.0 == sum.0;
            if same {
                sum.1 += next.1;
            }
            same
        });
    }
    rows
}

/// `e_k` minus a row of sum one; its own entry is the sum of the others, which is zero
/// on constants and loses no digits. Empty if the row is `e_k`.
fn departure(k: u32, released: &[Share]) -> Vec<Share> {
    let mut row: Vec<Share> = released
        .iter()
        .filter(|&&(l, _)| l != k)
        .map(|&(l, [z, y])| (l, [-z, -y]))
        .collect();
    let others: f64 = row.iter().map(|(_, [z, _])| z).sum();
    if row.is_empty() {
        return row;
    }
    let at = row.partition_point(|&(l, _)| l < k);
    // The weights add up to zero, so the ramp vanishes on constant tractions and patch tests do not
    // see it.
    row.insert(at, (k, [-others; 2]));
    row
}

/// `h/E` of a node and of the opposing body at its projection.
fn facing(interface: &Interface, kept: KeptNode) -> f64 {
    let KeptNode { side, node } = kept;
    let own = interface.nodes[side][node].flexibility;
    let other = match (interface.opponent, interface.opposing[side][node]) {
        (Opponent::Deformable | Opponent::Itself { .. }, Some((corners, weights))) => {
            let opposing = interface.opposing_side(side);
            let at = |c: usize| interface.nodes[opposing][corners[c]].flexibility;
            let mut parts = [0, 1, 2, 3].map(|c| at(c) * weights[c]);
            // In an order that does not depend on the facet's first corner.
            parts.sort_by(f64::total_cmp);
            parts.iter().sum()
        }
        _ => 0.0,
    };
    own + other
}

/// Nodes of the surface opposite to the kept ones, with `D_kJ/sum_J D_kJ`.
fn opposite(
    interface: &Interface,
    mass: &CommonMass,
    kept: &[u32],
) -> Vec<Vec<(Side, SurfaceNode, f64)>> {
    let opposite = |&k: &u32| {
        let own = mass.nodes[k as usize];
        let row = mass.rows[k as usize].iter();
        let others = row.map(|&(other, common)| (mass.nodes[other as usize], common));
        let others = others.filter(|(other, _)| interface.sign([own, *other]) < 0.0);
        let whole: f64 = others.clone().map(|(_, common)| common).sum();
        let shares = others.filter(|_| whole > 0.0);
        shares
            .map(|((side, node), common)| (side, node, common / whole))
            .collect()
    };
    kept.iter().map(opposite).collect()
}

/// `integral phi_k` of the kept nodes.
fn weights(
    interface: &Interface,
    mass: &CommonMass,
    transfer: &Transfer,
    kept: &[u32],
) -> Vec<f64> {
    let share = interface.share();
    let mut weights = vec![0.0; mass.nodes.len()];
    for (row, weight) in transfer.rows.iter().zip(&mass.weights) {
        for &(k, [z, _]) in row {
            weights[k as usize] += share * weight * z;
        }
    }
    kept.iter().map(|&k| weights[k as usize]).collect()
}
