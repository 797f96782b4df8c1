//! Bodies that move themselves: strain and tension that a step gives them.

use crate::{
    declare::{either, table},
    faults::FaultList,
    form::Form,
    read::{Place, Read, Value, unexpected},
    value::{Number, Text, word},
};
use toml::de::DeValue;

table! {
    /// Strain without stress, or tension, that a body takes on of itself, from the present value to the target. Those of different kinds add up: `stretch` and `strain` are one kind but for `along = "fibres"`, `thermal_expansion` is another, and so is `tension` along each line.
    Actuation {
        /// Name of the body.
        required body: Text,
        /// Element set of the section of it that is actuated. Default: all of the body.
        optional section: Text,
        /// The strain or tension that it takes on.
        include kind: ActuationKind,
        /// How the target is approached: `ramp`, `constant`, `smooth` or the name of a curve. Default: `ramp`.
        optional curve: Text,
    }
}

either! {
    /// A strain or tension that a body takes on of itself.
    ActuationKind {
        Stretch(Stretch),
        Strain(StressFreeStrain),
        Thermal(ThermalExpansion),
        Tension(ActiveTension),
    }
}

table! {
    /// Lines that become longer without stress.
    Stretch {
        /// Target of the strain `s` without stress, above -1: lengths at rest grow by the factor `1 + s`.
        required stretch: Number,
        /// Lines that grow: a direction at rest of any length, or `fibres`, those of the material. Default: all, in all directions.
        optional along: Lines,
    }
}

table! {
    /// A tensor of strain without stress.
    StressFreeStrain {
        /// Target of the components `xx`, `yy`, `zz`, `xy`, `yz`, `zx` of the strain without stress; its principal values are above -1.
        required strain: [Number; 6],
        /// First axis of the components, and a vector that gives the second one with it. Default: those of the model.
        optional axes: [[Number; 3]; 2],
    }
}

table! {
    /// Expansion by temperature.
    ThermalExpansion {
        /// Coefficient of thermal expansion: strain per change of temperature.
        required thermal_expansion: Number,
        /// Target of the change of temperature since the start.
        required temperature: Number,
    }
}

table! {
    /// A tension that the body has of itself, as muscles have.
    ActiveTension {
        /// Target of the force per area at rest with which lines pull.
        required tension: Number,
        /// Lines that pull: a direction at rest of any length, or `fibres`, those of the material.
        required along: Lines,
    }
}

/// Lines of a material.
#[derive(Clone, Debug)]
pub(crate) enum Lines {
    /// A direction.
    Direction([Number; 3]),
    /// Its fibres.
    Fibres,
}

/// The word for fibres.
const FIBRES: &str = "fibres";

impl Read for Lines {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::String(_) => word(value, place, faults, &[FIBRES]).map(|_| Self::Fibres),
            DeValue::Array(_) => <[Number; 3]>::read(value, place, faults).map(Self::Direction),
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        let fibres = (FIBRES, "All families of fibres of the material.");
        Form::Any(vec![Form::Words(vec![fibres]), <[Number; 3]>::form()])
    }
}
