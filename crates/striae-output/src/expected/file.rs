//! Content of `expected.toml`, checked.

use std::collections::BTreeSet;
use std::path::Path;

use serde::Deserialize;

use crate::OutputError;
use striae_files::read_text;

/// Results that a case must give.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// Quantities in the order of the file.
    pub quantities: Vec<Quantity>,
}

/// One expected quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Name, as in histories.
    pub name: String,
    /// Range in which the quantity must lie.
    pub target: Target,
    /// Source of the target.
    pub source: String,
    /// Unit, for the reader only.
    pub unit: String,
}

/// Range in which a quantity must lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Near a value.
    Value {
        /// The value.
        value: f64,
        /// Allowed distance.
        tolerance: Tolerance,
    },
    /// Between two values, both included.
    Range {
        /// The least value, or minus infinity.
        min: f64,
        /// The largest value, or infinity.
        max: f64,
    },
}

/// Allowed distance of a quantity from its expected value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Largest difference.
    Absolute(f64),
    /// Largest difference over the expected value.
    Relative(f64),
}

impl Expected {
    /// Reads and checks an `expected.toml`.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        Self::parse(&read_text(path)?).map_err(|cause| OutputError::Content {
            path: path.to_owned(),
            cause,
        })
    }

    /// Parses a text; the error is a sentence.
    pub fn parse(text: &str) -> Result<Self, String> {
        let raw: RawFile = toml::from_str(text).map_err(|cause| cause.to_string())?;
        let mut names = BTreeSet::new();
        if let Some(twice) = raw.quantity.iter().find(|q| !names.insert(&q.name)) {
            return Err(format!("`{}` is expected twice", twice.name));
        }
        let quantities = raw.quantity.into_iter().map(RawQuantity::lower);
        Ok(Self {
            quantities: quantities.collect::<Result<_, _>>()?,
        })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFile {
    #[serde(default)]
    quantity: Vec<RawQuantity>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawQuantity {
    name: String,
    value: Option<f64>,
    min: Option<f64>,
    max: Option<f64>,
    relative: Option<f64>,
    absolute: Option<f64>,
    source: String,
    #[serde(default)]
    unit: String,
}

impl RawQuantity {
    fn lower(self) -> Result<Quantity, String> {
        let target = self
            .target()
            .map_err(|cause| format!("`{}`: {cause}", self.name))?;
        Ok(Quantity {
            name: self.name,
            target,
            source: self.source,
            unit: self.unit,
        })
    }

    fn target(&self) -> Result<Target, &'static str> {
        let tolerance = match (self.relative, self.absolute) {
            (Some(r), None) if r >= 0.0 => Some(Tolerance::Relative(r)),
            (None, Some(a)) if a >= 0.0 => Some(Tolerance::Absolute(a)),
            (None, None) => None,
            (Some(_), Some(_)) => return Err("give `relative` or `absolute`, not both"),
            _ => return Err("a tolerance must not be negative"),
        };
        match (self.value, self.min, self.max, tolerance) {
            (Some(0.0), None, None, Some(Tolerance::Relative(_))) => {
                Err("a tolerance relative to zero is meaningless; give `absolute`")
            }
            (Some(value), None, None, Some(tolerance)) => Ok(Target::Value { value, tolerance }),
            (Some(_), None, None, None) => Err("a `value` needs `relative` or `absolute`"),
            (Some(_), ..) => Err("give `value` or `min` and `max`, not both"),
            (None, None, None, _) => Err("give `value`, or `min` and `max`"),
            (None, _, _, Some(_)) => Err("a range has no tolerance: widen the range"),
            (None, min, max, None) => {
                let min = min.unwrap_or(f64::NEG_INFINITY);
                let max = max.unwrap_or(f64::INFINITY);
                if min <= max {
                    Ok(Target::Range { min, max })
                } else {
                    Err("`min` is above `max`")
                }
            }
        }
    }
}
