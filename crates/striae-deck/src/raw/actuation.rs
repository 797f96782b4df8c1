//! Actuation of bodies: strain and tension that a step imposes on them.

use crate::{
    declare::{either, table},
    faults::FaultList,
    form::Form,
    read::{Place, Read, Value, unexpected},
    value::{Number, Text, word},
};
use toml::de::DeValue;

table! {
    /// Stress-free strain or tension of a body, from the present value to the target. Values of different kinds add up: `stretch` and `strain` are one kind except with `along = "fibres"`, `thermal_expansion` is another, and so is `tension` along each line.
    Actuation {
        /// Name of the body.
        required body: Text,
        /// Element set of the actuated section. Default: the whole body.
        optional section: Text,
        /// The strain or tension imposed.
        include kind: ActuationKind,
        /// Curve towards the target: `ramp`, `constant`, `smooth` or the name of a curve. Default:
        /// `ramp`.
        optional curve: Text,
    }
}

either! {
    /// A strain or tension imposed on a body.
    ActuationKind {
        Stretch(Stretch),
        Strain(StressFreeStrain),
        Thermal(ThermalExpansion),
        Tension(ActiveTension),
    }
}

table! {
    /// Lines that lengthen without stress.
    Stretch {
        /// Target of the stress-free strain `s`, above -1: lengths at rest grow by the factor `1 +
        /// s`.
        required stretch: Number,
        /// Lines that grow: a direction at rest of any length, or `fibres` for those of the
        /// material. Default: lines in all directions.
        optional along: Lines,
    }
}

table! {
    /// A tensor of stress-free strain.
    StressFreeStrain {
        /// Target of the components `xx`, `yy`, `zz`, `xy`, `yz`, `zx` of the stress-free strain;
        /// its principal values are above -1.
        required strain: [Number; 6],
        /// First axis of the components, and a vector that determines the second one. Default:
        /// those of the model.
        optional axes: [[Number; 3]; 2],
    }
}

table! {
    /// Thermal expansion.
    ThermalExpansion {
        /// Coefficient of thermal expansion: strain per change of temperature.
        required thermal_expansion: Number,
        /// Target of the change of temperature since the start.
        required temperature: Number,
    }
}

table! {
    /// Active tension of a body, as of muscles.
    ActiveTension {
        /// Target of the force per area at rest with which lines pull.
        required tension: Number,
        /// Lines that pull: a direction at rest of any length, or `fibres` for those of the
        /// material.
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
