//! Directions of fibres as fields in space at rest.
//!
//! About an axis through the point `o` with the unit direction `d`, and `r` the part of `X - o`
//! across it,
//!
//! ```text
//! axial            cos(t) d - sin(t) d x e       e = r/|r|
//! circumferential  cos(t) d x e + sin(t) d
//! radial           e
//! ```
//!
//! turned by the angle `t` about `e`, counter-clockwise seen from outside. On the axis, where
//! there is no `e`, any direction across it is taken.

use std::convert::Infallible;

use nalgebra::Vector3;
use serde::Serialize;
use striae_declared::{ANY, Absent, Declared, Kind, Parameter, Statement, Values, degrees};

/// Rotation of lines about the radius.
const TURN: Parameter = Parameter::number(
    "turn",
    ANY,
    "degrees",
    "Angle by which the lines are rotated about the radius, counter-clockwise seen from outside.",
)
.or(Absent::Number(0.0));

/// Directions of fibres that decks know by their keys.
pub static DIRECTIONS: &[&Declared<Direction>] = &[&UNIFORM, &CIRCUMFERENTIAL, &AXIAL, &RADIAL];

static UNIFORM: Declared<Direction> = Declared {
    name: "uniform",
    summary: "One direction.",
    parameters: &[Parameter::direction(
        "uniform",
        "The direction, of any length.",
    )],
    build: |values| Ok(Direction::Uniform(values.array("uniform").into())),
    fit: None,
};

static CIRCUMFERENTIAL: Declared<Direction> = Declared {
    name: "circumferential",
    summary: "Circles about an axis by the right-hand rule.",
    parameters: &[Parameter::axis("circumferential", "The axis."), TURN],
    build: |values| {
        let turn = values.number("turn").to_radians();
        let lines = LinesAbout::Circumferential { turn };
        Ok(Direction::about(values.table("circumferential"), lines))
    },
    fit: None,
};

static AXIAL: Declared<Direction> = Declared {
    name: "axial",
    summary: "Parallels of an axis.",
    parameters: &[Parameter::axis("axial", "The axis."), TURN],
    build: |values| {
        let turn = values.number("turn").to_radians();
        let lines = LinesAbout::Axial { turn };
        Ok(Direction::about(values.table("axial"), lines))
    },
    fit: None,
};

static RADIAL: Declared<Direction> = Declared {
    name: "radial",
    summary: "Rays away from an axis.",
    parameters: &[Parameter::axis("radial", "The axis.")],
    build: |values| Ok(Direction::about(values.table("radial"), LinesAbout::Radial)),
    fit: None,
};

/// Direction of a family of fibres at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Direction {
    /// One direction everywhere, of any length.
    Uniform(Vector3<f64>),
    /// About an axis.
    About {
        /// A point of the axis.
        point: Vector3<f64>,
        /// Its direction, of any length.
        axis: Vector3<f64>,
        /// Kind of lines.
        lines: LinesAbout,
    },
}

/// Directions about an axis; angles in radians.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum LinesAbout {
    /// Along it, turned about the radius.
    Axial {
        /// The angle.
        turn: f64,
    },
    /// Around it, turned about the radius.
    Circumferential {
        /// The angle.
        turn: f64,
    },
    /// Away from it.
    Radial,
}

impl Kind for Direction {
    type Refusal = Infallible;
    type Fit = Infallible;
}

impl Direction {
    fn about(axis: &Values, lines: LinesAbout) -> Self {
        Self::About {
            point: axis.array("point").into(),
            axis: axis.array("direction").into(),
            lines,
        }
    }

    /// Returns the declared direction that this one is, with its values.
    pub fn stated(&self) -> Statement {
        let vector = |of: &Vector3<f64>| -> [f64; 3] { (*of).into() };
        let (law, values) = match self {
            Self::Uniform(direction) => (
                UNIFORM.name,
                Values::default().with("uniform", vector(direction)),
            ),
            Self::About { point, axis, lines } => {
                let (law, turn) = match *lines {
                    LinesAbout::Axial { turn } => (AXIAL.name, Some(turn)),
                    LinesAbout::Circumferential { turn } => (CIRCUMFERENTIAL.name, Some(turn)),
                    LinesAbout::Radial => (RADIAL.name, None),
                };
                let about = Values::default().with("point", vector(point));
                let about = about.with("direction", vector(axis));
                let values = Values::default().with(law, about);
                (law, values.with_any(TURN.name, turn.map(degrees)))
            }
        };
        Statement { law, values }
    }

    /// The unit direction at a place of the body at rest.
    pub fn at(&self, place: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Uniform(direction) => direction.normalize(),
            Self::About { point, axis, lines } => {
                let d = axis.normalize();
                let arm = place - point;
                let across = arm - d * d.dot(&arm);
                let e = match across.try_normalize(1e-12 * arm.norm()) {
                    Some(e) => e,
                    None => d.cross(&Vector3::ith(d.iamin(), 1.0)).normalize(),
                };
                let around = d.cross(&e);
                match lines {
                    LinesAbout::Axial { turn } => d * turn.cos() + around * -turn.sin(),
                    LinesAbout::Circumferential { turn } => around * turn.cos() + d * turn.sin(),
                    LinesAbout::Radial => e,
                }
            }
        }
    }

    /// Returns whether all its vectors have nonzero length.
    pub(super) fn has_length(&self) -> bool {
        let (vector, point) = match self {
            Self::Uniform(direction) => (direction, Vector3::zeros()),
            Self::About { point, axis, .. } => (axis, *point),
        };
        let norm = vector.norm();
        norm > 0.0 && norm.is_finite() && point.iter().all(|x| x.is_finite())
    }
}
