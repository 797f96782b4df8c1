//! `fibres` of a material.
//!
//! A family is no law of its own, which would be declared in `striae-law`: it stands in any elastic
//! solid, and its direction is a field in the space of the body.

use super::{
    super::declare::{either, table},
    Axis,
};
use crate::value::{NonNegative, Number, Positive};

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

either! {
    /// Direction of fibres at rest.
    FibreDirection {
        Uniform(UniformFibres),
        Circumferential(CircumferentialFibres),
        Axial(AxialFibres),
        Radial(RadialFibres),
    }
}

table! {
    /// One direction.
    UniformFibres {
        /// The direction, of any length.
        required uniform: [Number; 3],
    }
}

table! {
    /// Circles about an axis by the right-hand rule.
    CircumferentialFibres {
        /// The axis.
        required circumferential: Axis,
        /// Angle in degrees by which they are rotated about the radius, counter-clockwise seen from
        /// outside. Default: 0.
        optional turn: Number,
    }
}

table! {
    /// Parallels of an axis.
    AxialFibres {
        /// The axis.
        required axial: Axis,
        /// Angle in degrees by which they are rotated about the radius, counter-clockwise seen from
        /// outside. Default: 0.
        optional turn: Number,
    }
}

table! {
    /// Rays away from an axis.
    RadialFibres {
        /// The axis.
        required radial: Axis,
    }
}
