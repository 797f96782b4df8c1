//! Measured friction in text files, for [`fit`](crate::law::fit).
//!
//! One reading a line under a line with the names of the columns; empty lines and what follows
//! a `#` are passed over. Fields are separated by semicolons or tabs, if the first line has
//! one, otherwise by commas, or by blanks if it has none and the second line as many words;
//! beside these a comma may be the decimal sign. Names may have capitals, and a unit in brackets
//! behind: `Angle [deg]`. Columns of other names are not used, and a note says so.
//!
//! | column | meaning |
//! | --- | --- |
//! | `angle` | direction in which the textured surface slips, from its texture `a` (across the grooves, against a nap), counter-clockwise as seen from outside it; of two textured surfaces from the bisector of `a_a` and `a_b'` (degrees); optional for friction that is the same in all directions, see [`Angles`], unless there is a `direction` |
//! | `friction` | tangential over normal force: the part against slip, or its whole size where there is a `direction` (no unit); also `mu` |
//! | `tangential`, `normal` | the two forces, in place of `friction` (force) |
//! | `direction` | direction of `-tau`, the force that drags the textured surface, counted as `angle` (degrees); optional |
//! | `theta` | angle between the textures of two surfaces (degrees); optional, 0 |
//! | `spread` | standard deviation in proportion to that of other readings (no unit); optional, 1 |
//! | `specimen` | name or number of the specimen that was measured; optional |
//!
//! Angles may also count from along the texture, see [`AngleFrom`].

mod doubts;
mod header;
mod name;
#[cfg(test)]
mod tests;

use std::{fmt, str::FromStr};

use striae_files::Separator;
use striae_law::fit::Reading;

use doubts::doubts;
use header::{Header, Row};

/// Names of columns.
const COLUMNS: [&str; 8] = [
    "angle",
    "friction",
    "tangential",
    "normal",
    "direction",
    "theta",
    "spread",
    "specimen",
];

/// Direction that angles count from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AngleFrom {
    /// The texture `a`: across the grooves, against a nap.
    #[default]
    Across,
    /// The grooves, or the row of scales, `s`, a quarter turn before `a`.
    Along,
}

/// Necessity of the column `angle`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Angles {
    /// The law that is sought depends on the direction of slip, or may do so.
    #[default]
    Needed,
    /// Friction is the same in all directions of slip. Readings without an angle are taken as
    /// slip across the texture.
    Optional,
}

/// Layout of a file of measurements.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Form {
    /// Direction that angles count from.
    pub angle_from: AngleFrom,
    /// Necessity of angles.
    pub angles: Angles,
    /// Lines at the beginning that are passed over.
    pub skipped: usize,
    /// Columns that the file names otherwise.
    pub columns: Vec<NamedColumn>,
}

/// A quantity and the column of a file that it is in: `normal=Fz`, `angle=1`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedColumn {
    /// Name of the quantity, one of those of the [module](self).
    quantity: &'static str,
    /// Name of the column, or its number from 1.
    column: String,
}

impl FromStr for NamedColumn {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((quantity, column)) = text.split_once('=') else {
            return Err(format!(
                "expected QUANTITY=COLUMN, such as `normal=Fz`, found `{text}`"
            ));
        };
        Self::new(quantity.trim(), column.trim())
    }
}

impl NamedColumn {
    /// Returns the column of a quantity, by its name or its number from 1.
    ///
    /// # Errors
    /// When the quantity is not known.
    pub fn new(quantity: &str, column: &str) -> Result<Self, String> {
        match COLUMNS.into_iter().find(|known| *known == quantity) {
            Some(quantity) => Ok(Self {
                quantity,
                column: column.to_owned(),
            }),
            None => Err(format!(
                "unknown quantity `{quantity}`; known quantities are {}",
                COLUMNS.join(", ")
            )),
        }
    }
}

/// Readings of a file of measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The readings, with angles from across the texture.
    pub readings: Vec<Reading>,
    /// Names of the specimens by number, in the order of their first readings.
    pub specimens: Vec<String>,
    /// Notes on columns that were passed over, and on numbers that are hardly meant.
    pub notes: Vec<String>,
}

/// All that is wrong with a file of measurements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct MeasurementFaults {
    /// Name of the file.
    pub file: String,
    /// The faults, by place.
    pub faults: Vec<MeasurementFault>,
}

/// One fault of a file of measurements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeasurementFault {
    /// Line and column of the text, from 1; `None` where the whole file is meant.
    pub place: Option<(usize, usize)>,
    /// Message: what was found and what is needed.
    pub message: String,
}

impl MeasurementFaults {
    /// Fault of a file that cannot be read.
    pub fn unreadable(file: &str, cause: &impl fmt::Display) -> Self {
        Self {
            file: file.to_owned(),
            faults: vec![fault(None, format!("it cannot be read: {cause}"))],
        }
    }
}

impl fmt::Display for MeasurementFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, fault) in self.faults.iter().enumerate() {
            let end = if number == 0 { "" } else { "\n" };
            let file = &self.file;
            match fault.place {
                Some((line, column)) => write!(f, "{end}{file}:{line}:{column}: ")?,
                None => write!(f, "{end}{file}: ")?,
            }
            f.write_str(&fault.message)?;
        }
        Ok(())
    }
}

/// Readings of a text in the usual form; `file` is what faults call it.
///
/// # Errors
/// All its faults.
pub fn parse(text: &str, file: &str) -> Result<Vec<Reading>, MeasurementFaults> {
    read(text, file, &Form::default()).map(|measured| measured.readings)
}

/// Readings and notes of a text in a form; `file` is what faults call it.
///
/// # Errors
/// All its faults.
pub fn read(text: &str, file: &str, form: &Form) -> Result<Measured, MeasurementFaults> {
    let mut faults = Vec::new();
    let measured = measured(text, form, &mut faults);
    match measured {
        Some(measured) if faults.is_empty() => Ok(measured),
        _ => Err(MeasurementFaults {
            file: file.to_owned(),
            faults,
        }),
    }
}

fn fault(place: Option<(usize, usize)>, message: impl Into<String>) -> MeasurementFault {
    MeasurementFault {
        place,
        message: message.into(),
    }
}

fn measured(text: &str, form: &Form, faults: &mut Vec<MeasurementFault>) -> Option<Measured> {
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let mut lines = lines
        .map(|(at, line)| (at + 1, line.split('#').next().unwrap_or("")))
        .skip(form.skipped)
        .filter(|(_, line)| !line.trim().is_empty());
    let Some((number, first)) = lines.clone().next() else {
        let message = "it is empty: it must have a line with names of columns, such as `angle, friction`, and a line for each reading";
        faults.push(fault(None, message));
        return None;
    };
    let second = lines.clone().nth(1).map_or("", |(_, line)| line);
    let separator = Separator::of_two(first, second);
    let header = Header::read(separator, (number, first), form, faults)?;
    if header.is_named() {
        lines.next();
    }
    let mut specimens = Vec::new();
    let rows = lines.filter_map(|(number, line)| header.row(number, line, &mut specimens, faults));
    let rows: Vec<Row> = rows.collect();
    let mut readings: Vec<Reading> = rows.iter().map(|row| row.reading).collect();
    if readings.is_empty() && faults.is_empty() {
        faults.push(fault(None, "it has no readings below the names of columns"));
    }
    if form.angle_from == AngleFrom::Along {
        for reading in &mut readings {
            reading.slip -= 90f64.to_radians();
        }
    }
    let notes = header.note().into_iter().chain(doubts(&rows)).collect();
    Some(Measured {
        readings,
        specimens,
        notes,
    })
}
