//! `[[pair]]` with its friction, and `[[tie]]`.

use super::Texture;
use crate::{
    declare::{either, table, words},
    faults::FaultList,
    form::Form,
    law::{ByAccumulatedSlip, ByPressure, BySlipRate, ByState, Decay, Stated},
    read::{Place, Read, Value, read_table, unexpected},
    value::{Angle, NonNegative, Number, Positive, Text, Truth},
};
use toml::de::DeValue;

table! {
    /// Two surfaces that may touch; neither is master or slave.
    Pair {
        /// Unique name.
        required name: Text,
        /// First side.
        required a: Side,
        /// Second side, or `itself`: facets of side `a` that may touch each other.
        required b: SecondSide,
        /// Friction from the start; steps may change it. Default: frictionless.
        optional friction: Friction,
        /// Enforcement of contact. Default: `weighted`.
        optional enforcement: Enforcement,
        /// Distance within which contact is searched. It affects the cost, not the result. Default:
        /// half the local facet size.
        optional search_distance: Positive,
        /// Treatment of gaps and overlaps of the meshes before any motion: `as-meshed` keeps gaps
        /// and refuses overlaps of more than 2 % of the local facet size; `close` moves nodes
        /// without strain until overlaps are gone, and closes gaps of up to a tenth of the local
        /// facet size or up to a given size; `resolve` removes overlaps gradually during the first
        /// step, which strains the bodies. Default: `as-meshed`.
        optional initial: Initial,
        /// Interference of a press fit, a length: where the two sides face each other within the
        /// search distance or overlap, they count as touching at the start, whatever the gap
        /// between their facets, and are then pressed apart by this much in the course of the first
        /// step. Negative for a clearance. Default: none, gaps are those of the meshes.
        optional interference: Interference,
        /// Wear of the sides, by which gaps open: the depth that wears off per pressure and slip
        /// (Archard), the coefficient of wear over the hardness, an inverse stress. One number for
        /// all deformable sides, or a table with one for each. Default: none.
        optional wear: Wear,
        /// Coefficients of wear across the texture of the side that has one, over those along it,
        /// which `wear` states. Default: 1.
        optional wear_across: Positive,
        /// `true`: viscous forces between the sides carry bodies without other restraints across a
        /// gap, in steps without inertia. They fall to zero in the course of each step. Default:
        /// false.
        optional stabilise: Truth,
        /// Dihedral angle in degrees from which on an edge separates faces: nodes there have a
        /// normal and a traction for each face. Default: nodes have one normal for all their faces.
        optional feature_angle: Angle,
    }
}

table! {
    /// Two surfaces of bodies, glued together from the start; their meshes need not match.
    BodyTie {
        /// Unique name.
        required name: Text,
        /// First side.
        required a: DeformableSide,
        /// Second side. The order of the two does not matter.
        required b: DeformableSide,
        /// Distance up to which facets that face each other are tied; others are free. Default: a
        /// tenth of the facet size; facets between that distance and half of the facet size apart
        /// are then a fault.
        optional within: Positive,
    }
}

/// The interference of a press fit.
#[derive(Clone, Debug)]
pub(crate) enum Interference {
    /// Reached along a ramp.
    Value(Number),
    /// Reached along a curve.
    Along(InterferenceAlong),
}

table! {
    /// An interference along a curve.
    InterferenceAlong {
        /// Interference at the end of the first step, kept from there on.
        required value: Number,
        /// Curve of the approach in the first step: `ramp`, `constant`, `smooth` or the name of a
        /// curve. Default: `ramp`.
        optional curve: Text,
    }
}

impl Read for Interference {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::Table(_) => read_table(value, place, faults).map(Self::Along),
            _ => Number::read(value, place, faults).map(Self::Value),
        }
    }

    fn form() -> Form {
        Form::Any(vec![Number::form(), InterferenceAlong::form()])
    }
}

/// Coefficients of wear over the hardness.
#[derive(Clone, Debug)]
pub(crate) enum Wear {
    /// Of all deformable sides.
    All(NonNegative),
    /// Of each side.
    Sides(WearOfSides),
}

table! {
    /// Wear of each side: depth per pressure and slip, an inverse stress.
    WearOfSides {
        /// Coefficient of side `a`. Default: 0.
        optional a: NonNegative,
        /// Coefficient of side `b`. Default: 0.
        optional b: NonNegative,
    }
}

impl Read for Wear {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::Table(_) => read_table(value, place, faults).map(Self::Sides),
            _ => NonNegative::read(value, place, faults).map(Self::All),
        }
    }

    fn form() -> Form {
        Form::Any(vec![NonNegative::form(), WearOfSides::form()])
    }
}

/// Treatment of gaps and overlaps of the meshes.
#[derive(Clone, Debug)]
pub(crate) enum Initial {
    /// One of a few treatments.
    Word(InitialWord),
    /// Gaps are closed up to a given size.
    Close(CloseGaps),
}

words! {
    /// Treatment of gaps and overlaps of the meshes.
    InitialWord {
        /// Gaps remain, overlaps are a fault.
        AsMeshed = "as-meshed",
        /// Nodes are moved without strain.
        Close = "close",
        /// Overlaps are removed gradually in the course of the first step.
        Resolve = "resolve",
    }
}

table! {
    /// Gaps and overlaps closed without strain.
    CloseGaps {
        /// Largest gap that is closed.
        required close: NonNegative,
    }
}

impl Read for Initial {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::String(_) => InitialWord::read(value, place, faults).map(Self::Word),
            DeValue::Table(_) => read_table(value, place, faults).map(Self::Close),
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        Form::Any(vec![InitialWord::form(), CloseGaps::form()])
    }
}

/// The second side of a pair.
#[derive(Clone, Debug)]
pub(crate) enum SecondSide {
    /// The first side itself.
    Itself,
    /// Another side.
    Other(Box<Side>),
}

words! {
    /// The first side, as the second one.
    SameSide {
        /// Facets of side `a` that may touch each other.
        Itself = "itself",
    }
}

impl SecondSide {
    /// The side, if it is another one.
    pub(crate) fn other(&self) -> Option<&Side> {
        match self {
            Self::Itself => None,
            Self::Other(side) => Some(side),
        }
    }
}

impl Read for SecondSide {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::String(_) => SameSide::read(value, place, faults).map(|_| Self::Itself),
            DeValue::Table(_) => {
                read_table(value, place, faults).map(|side| Self::Other(Box::new(side)))
            }
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        Form::Any(vec![SameSide::form(), Side::form()])
    }
}

table! {
    /// One side of a pair.
    Side {
        /// The surface.
        include surface: SideSurface,
        /// Texture painted on the surface at rest, which it follows as it deforms. Default: none.
        optional texture: Texture,
    }
}

either! {
    /// The surface of a side.
    SideSurface {
        Deformable(DeformableSide),
        Rigid(RigidSide),
    }
}

table! {
    /// Facets of a body.
    DeformableSide {
        /// Name of the body.
        required body: Text,
        /// Name of its facet set.
        required facets: Text,
    }
}

table! {
    /// A rigid surface.
    RigidSide {
        /// Name of the rigid surface.
        required rigid: Text,
    }
}

words! {
    /// Enforcement of contact.
    Enforcement {
        /// Both sides share one traction field; gaps and slips are means weighted with it.
        Weighted = "weighted",
        /// Each side has its own field; gaps and slips are those at nodes (Jones & Papadopoulos).
        Collocated = "collocated",
    }
}

table! {
    /// Friction between the two sides of a pair.
    Friction {
        /// Law and its constants.
        include law: Stated<striae_law::friction::Friction>,
        /// Largest value of `mu p`; laws of directions keep their proportions. Default: none.
        optional shear_cap: Positive,
        /// Decay of all coefficients with the rate of slip. Default: none.
        optional decay: Decay,
        /// Dependence of all coefficients on the pressure. Default: none.
        optional by_pressure: ByPressure,
        /// Dependence of all coefficients on the slip rate; replaces `decay`. Default: none.
        optional by_slip_rate: BySlipRate,
        /// Dependence of all coefficients on the slip that a point of a surface has accumulated
        /// since the start of the run. Default: none.
        optional by_accumulated_slip: ByAccumulatedSlip,
        /// Dependence of all coefficients on the slip rate and on a state of the surface, which
        /// evolves with time and slip; replaces `decay` and `by_slip_rate`. Default: none.
        optional by_state: ByState,
    }
}
