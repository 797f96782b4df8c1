//! Data from which the mass of elements is integrated.

use super::{
    composite::{self, Parts},
    mass::Mass,
    reference::Reference,
};

/// Data from which the mass of elements is integrated.
#[derive(Debug)]
pub(super) enum Inertia<const N: usize, const Q: usize> {
    /// `N_a` at the quadrature points, by point.
    Points([[f64; N]; Q]),
    /// The parts of composite elements, by element.
    Parts(Vec<Parts>),
}

impl<const N: usize, const Q: usize> Inertia<N, Q> {
    /// The mass matrix of an element; `density` is mass per reference volume.
    pub(super) fn mass(&self, at: usize, element: &Reference<N, Q>, density: f64) -> Mass {
        let values = match self {
            Self::Points(values) => values,
            Self::Parts(parts) => return composite::mass(&parts[at], density),
        };
        let mut mass = Mass::default();
        for (values, weight) in values.iter().zip(&element.weights) {
            for a in 0..N {
                for b in 0..N {
                    mass[a][b] += density * weight * values[a] * values[b];
                }
            }
        }
        mass
    }
}
