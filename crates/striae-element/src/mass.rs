//! Consistent mass.
//!
//! ```text
//! m_ab = rho0 int N_a N_b dV0,   M_aibk = m_ab d_ik
//! ```
//!
//! with the mass `rho0` per reference volume.
//!
//! Mass of corners that are to have none moves along edges: their shape functions
//! are added in equal parts to those of the nearest corners that keep theirs,
//!
//! ```text
//! N'_a = sum_b w_ab N_b,   sum_a w_ab = 1,   m' = w m w^T,
//! ```
//!
//! so the whole mass and the momentum of a translation do not change. The idea is
//! of Khenous, Laborde & Renard (Eur. J. Mech. A/Solids 27, 2008), who choose the
//! shares otherwise; moments of inertia change by the order of the elements.

use striae_mesh::{CellKind, MAX_CORNERS};

/// The scalar mass matrix `m_ab`; every component of the position has the same one.
/// Zero beyond the last corner.
pub type Mass = [[f64; MAX_CORNERS]; MAX_CORNERS];

/// The mass matrix with the mass of `massless` corners moved to the others, of which
/// there has to be one.
pub fn redistributed(kind: CellKind, mass: &Mass, massless: &[bool]) -> Mass {
    let shares: Vec<Vec<f64>> = (0..massless.len())
        .map(|from| shares(kind, from, massless))
        .collect();
    let mut moved = Mass::default();
    for (a, row) in mass.iter().enumerate().take(massless.len()) {
        for (b, m) in row.iter().enumerate().take(massless.len()) {
            for (to_a, share_a) in shares[a].iter().enumerate() {
                for (to_b, share_b) in shares[b].iter().enumerate() {
                    moved[to_a][to_b] += share_a * m * share_b;
                }
            }
        }
    }
    moved
}

/// Parts of a corner's shape function that the corners get.
fn shares(kind: CellKind, from: usize, massless: &[bool]) -> Vec<f64> {
    let steps = |to: usize| kind.edges_between(from, to);
    let keeping = || (0..massless.len()).filter(|&to| !massless[to]);
    let least = keeping().map(steps).min();
    let nearest = |&to: &usize| Some(steps(to)) == least;
    let count = keeping().filter(nearest).count();
    let mut shares = vec![0.0; massless.len()];
    keeping()
        .filter(nearest)
        .for_each(|to| shares[to] = 1.0 / count as f64);
    shares
}
