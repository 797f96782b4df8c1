//! `fibres` of a material.
//!
//! A family is no law of its own, which would be declared in `striae-law`: it stands in any elastic
//! solid. Its directions are declared.

use crate::{
    declare::{either, table},
    law::FibreDirection,
    value::{NonNegative, Positive},
};

table! {
    /// A family of fibres.
    Fibres {
        /// Stiffness of the fibres.
        include stiffness: FibreStiffness,
        /// Direction at rest, evaluated at the centre of each element.
        required direction: FibreDirection,
    }
}

either! {
    /// Stiffness of fibres.
    FibreStiffness {
        Exponential(ExponentialFibres),
        Linear(LinearFibres),
    }
}

table! {
    /// Stiffening in tension, slack in compression: energy `k1/(2 k2) (exp(k2 E^2) - 1)` if their strain `E` is positive.
    ExponentialFibres {
        /// Modulus.
        required k1: Positive,
        /// Exponent of stiffening.
        required k2: NonNegative,
        /// Dispersion, from 0, all along the direction, to 1/3, in all directions. Default: 0.
        optional dispersion: NonNegative,
    }
}

table! {
    /// Linear in tension and compression: energy `M/8 (I4 - 1)^2` of the square `I4` of their stretch.
    LinearFibres {
        /// Modulus `M` that the family adds along its direction at rest.
        required modulus: Positive,
    }
}
