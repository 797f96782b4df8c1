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

use super::ReferenceElement;
use super::shape::{CORNERS, gauss_point, shape};

impl ReferenceElement {
    /// The scalar mass matrix `m_ab`; every component of the position has the
    /// same one. `density` is mass per reference volume.
    pub fn mass(&self, density: f64) -> [[f64; 8]; 8] {
        let mut mass = [[0.0; 8]; 8];
        for (g, weight) in self.weights.iter().enumerate() {
            let values = shape(&gauss_point(g));
            for a in 0..8 {
                for b in 0..8 {
                    mass[a][b] += density * weight * values[a] * values[b];
                }
            }
        }
        mass
    }
}

/// The mass matrix with the mass of `massless` corners moved to the others, of which
/// there has to be one.
pub fn redistributed(mass: &[[f64; 8]; 8], massless: &[bool; 8]) -> [[f64; 8]; 8] {
    let shares: [[f64; 8]; 8] = std::array::from_fn(|from| shares(from, massless));
    let mut moved = [[0.0; 8]; 8];
    for (a, row) in mass.iter().enumerate() {
        for (b, m) in row.iter().enumerate() {
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
fn shares(from: usize, massless: &[bool; 8]) -> [f64; 8] {
    let steps = |to: usize| {
        (0..3)
            .filter(|&j| CORNERS[from][j] != CORNERS[to][j])
            .count()
    };
    let keeping = || (0..8).filter(|&to| !massless[to]);
    let least = keeping().map(steps).min();
    let nearest = |&to: &usize| Some(steps(to)) == least;
    let count = keeping().filter(nearest).count();
    let mut shares = [0.0; 8];
    keeping()
        .filter(nearest)
        .for_each(|to| shares[to] = 1.0 / count as f64);
    shares
}
