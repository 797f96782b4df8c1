//! Bulk laws.

/// A bulk material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Compressible neo-Hookean solid.
    NeoHookean {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus `G`.
        shear: f64,
    },
    /// Linear elasticity of small strains.
    LinearElastic {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus `G`.
        shear: f64,
    },
}
