//! Friction laws on the common kernel `-tau = L z + varpi eta`, `|z| <= varpi`.

/// A friction law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// No friction.
    Frictionless,
    /// Isotropic Coulomb friction.
    Coulomb {
        /// Coefficient of friction.
        mu: f64,
    },
}
