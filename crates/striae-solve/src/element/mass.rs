//! Consistent mass.
//!
//! ```text
//! m_ab = rho0 int N_a N_b dV0,   M_aibk = m_ab d_ik
//! ```
//!
//! with the mass `rho0` per reference volume.

use super::ReferenceElement;
use super::shape::{gauss_point, shape};

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
