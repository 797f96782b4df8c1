//! Cavities and their contents.

use crate::{
    declare::{either, table},
    read::At,
    value::{Number, Positive, Text},
};

table! {
    /// A cavity with a pressure inside. Until a step states its content, the pressure is that of
    /// the surroundings.
    Cavity {
        /// Unique name.
        required name: Text,
        /// Facets around it, which look into it: closed, but for rims in planes of symmetry.
        required faces: Vec<At<super::DeformableSide>>,
    }
}

table! {
    /// Content of a cavity, until a later step states another one.
    Filling {
        /// Name of the cavity.
        required cavity: Text,
        /// The content.
        include content: CavityContent,
        /// Curve from the present value to the target: `ramp`, `constant`, `smooth` or the name of a
        /// curve. Default: `ramp`.
        optional curve: Text,
    }
}

either! {
    /// The content of a cavity.
    CavityContent {
        Pressure(CavityPressure),
        Volume(CavityVolume),
        VolumeRatio(CavityVolumeRatio),
        Gas(CavityGas),
    }
}

table! {
    /// A pressure.
    CavityPressure {
        /// Pressure over that of the surroundings.
        required pressure: Number,
    }
}

table! {
    /// A volume, in steps without inertia.
    CavityVolume {
        /// Volume.
        required volume: Positive,
    }
}

table! {
    /// A volume by that at rest, in steps without inertia.
    CavityVolumeRatio {
        /// Volume over that at rest.
        required volume_ratio: Positive,
    }
}

table! {
    /// An amount of gas: what the cavity contains at the start of the step.
    CavityGas {
        /// The gas that is sealed in.
        required gas: Gas,
    }
}

table! {
    /// A gas.
    Gas {
        /// Absolute pressure of the surroundings.
        required ambient: Positive,
        /// Polytropic exponent `n` of `p V^n`. Default: 1, a constant temperature.
        optional exponent: Positive,
    }
}
