//! `fibres` of a material.

use super::{
    super::declare::{either, table},
    Axis,
};
use crate::value::{NonNegative, Number, Positive};

table! {
    /// A family of fibres.
    Fibres {
        /// How they take up stretch.
        include stiffness: FibreStiffness,
        /// Where they point at rest, in the middle of each element.
        required direction: FibreDirection,
    }
}

either! {
    /// How fibres take up stretch.
    FibreStiffness {
        Exponential(ExponentialFibres),
        Linear(LinearFibres),
    }
}

table! {
    /// Stiffer the more they are stretched, slack in compression: energy `k1/(2 k2) (exp(k2 E^2) - 1)` where their strain `E` is positive.
    ExponentialFibres {
        /// Modulus.
        required k1: Positive,
        /// How fast they stiffen.
        required k2: NonNegative,
        /// From 0, all along the direction, to 1/3, in all directions. Default: 0.
        optional dispersion: NonNegative,
    }
}

table! {
    /// In tension and compression: energy `M/8 (I4 - 1)^2` of the square `I4` of their stretch.
    LinearFibres {
        /// Modulus `M` that the family adds along its direction at rest.
        required modulus: Positive,
    }
}

either! {
    /// Where fibres point at rest.
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
    /// Around an axis by the right-hand rule.
    CircumferentialFibres {
        /// The axis.
        required circumferential: Axis,
        /// Angle in degrees by which they are turned about the radius, counter-clockwise seen from outside. Default: 0.
        optional turn: Number,
    }
}

table! {
    /// Along an axis.
    AxialFibres {
        /// The axis.
        required axial: Axis,
        /// Angle in degrees by which they are turned about the radius, counter-clockwise seen from outside. Default: 0.
        optional turn: Number,
    }
}

table! {
    /// Away from an axis.
    RadialFibres {
        /// The axis.
        required radial: Axis,
    }
}
