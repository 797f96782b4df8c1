//! Rows by which wear at the kept nodes opens the gaps of others.
//!
//! ```text
//! M_kl = 1/w_k sum_s k_s sum_{J in s} D_kJ Z_Jl,   D_kJ = integral phi_k N_J
//! ```
//!
//! with the coefficient `k_s` of side `s` and the transfer `Z` of [`crate::traction_basis`], so that
//! `sum_l M_kl = sum_s k_s` where the whole support of `k` faces the other side.

use crate::{
    common_mass::{CommonMass, SparseRow, SparseSum},
    transfer::Transfer,
};

/// Rows of `w_k M` of all nodes by place in the order of the common mass, for a field of which each
/// facet contributes `share`. Empty for nodes that are not kept.
pub(crate) fn wear_rows(
    mass: &CommonMass,
    transfer: &Transfer,
    coefficients: [f64; 2],
    share: f64,
) -> Vec<SparseRow> {
    let count = mass.nodes.len();
    let mut sum = SparseSum::new(count);
    // `sum_J D_tJ k_s Z_Jl` of the interpolation function of every node.
    let worn: Vec<SparseRow> = (mass.rows.iter())
        .map(|row| {
            for &(other, common) in row {
                let (side, _) = mass.nodes[other as usize];
                let factor = coefficients[side] * common;
                for &(l, [z, _]) in &transfer.rows[other as usize] {
                    if factor != 0.0 {
                        sum.add(l, factor * z);
                    }
                }
            }
            sum.take()
        })
        .collect();
    let mut contributors = vec![Vec::new(); count];
    for (t, row) in transfer.rows.iter().enumerate() {
        for &(k, [z, _]) in row {
            contributors[k as usize].push((t, share * z));
        }
    }
    let row = |of: &Vec<(usize, f64)>| {
        for &(t, weight) in of {
            for &(l, value) in &worn[t] {
                sum.add(l, weight * value);
            }
        }
        sum.take()
    };
    contributors.iter().map(row).collect()
}
