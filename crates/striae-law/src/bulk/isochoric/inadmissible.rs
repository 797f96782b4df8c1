//! Reasons to refuse the constants of rubber.

/// Constants for which a hyperelastic law would not be stable at rest.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InadmissibleHyperelastic {
    /// A constant is no finite number.
    #[error("`{name}` is {value}, but it must be a finite number")]
    NotFinite {
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A constant must be positive.
    #[error("`{name}` is {value}, but it must be positive")]
    NotPositive {
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// An exponent of Ogden's law is zero.
    #[error("`alpha` of term {0} is 0, but it must be positive or negative")]
    NoExponent(usize),
    /// Ogden's law without a term.
    #[error("the law has no term, but it needs at least one")]
    NoTerm,
    /// The shear modulus at rest.
    #[error("the constants give the shear modulus {0} at rest, but it must be positive")]
    Shear(f64),
    /// Chains that lock before they are stretched.
    #[error("`locking_stretch` is {0}, but it must be above 1")]
    Locked(f64),
    /// The bulk modulus.
    #[error(
        "the bulk modulus is {bulk} and the shear modulus {shear}: Poisson's ratio would be {ratio}, but it must be above -1 and below 0.5"
    )]
    Bulk {
        /// Bulk modulus.
        bulk: f64,
        /// Shear modulus at rest.
        shear: f64,
        /// Poisson's ratio at rest.
        ratio: f64,
    },
}
