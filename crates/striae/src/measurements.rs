//! Measured friction in text files, for [`fit`](crate::law::fit).
//!
//! One reading a line, numbers separated by commas, under a line with the names of the
//! columns; empty lines and what follows a `#` are passed over.
//!
//! | column | meaning |
//! | --- | --- |
//! | `angle` | direction in which the textured surface slips, from its texture `a` (across the grooves, against a nap), counter-clockwise as seen from outside it; of two textured surfaces from the bisector of `a_a` and `a_b'` (degrees) |
//! | `friction` | tangential over normal force: the part against slip, or its whole size where there is a `direction` (no unit) |
//! | `tangential`, `normal` | the two forces, in place of `friction` (force) |
//! | `direction` | direction of `-tau`, the force that drags the textured surface, counted as `angle` (degrees); optional |
//! | `theta` | angle between the textures of two surfaces (degrees); optional, 0 |
//! | `spread` | standard deviation in proportion to that of other readings (no unit); optional, 1 |

use std::fmt;

use striae_law::fit::Reading;

/// Names of columns.
const COLUMNS: [&str; 7] = [
    "angle",
    "friction",
    "tangential",
    "normal",
    "direction",
    "theta",
    "spread",
];

/// All that is wrong with a file of measurements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct MeasurementFaults {
    /// What the file is called.
    pub file: String,
    /// The faults, by place.
    pub faults: Vec<MeasurementFault>,
}

/// One fault of a file of measurements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeasurementFault {
    /// Line and column of the text, from 1; `None` where the whole file is meant.
    pub place: Option<(usize, usize)>,
    /// What was found and what is needed.
    pub message: String,
}

impl MeasurementFaults {
    /// That a file cannot be read.
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

/// Readings of a text; `file` is what faults call it.
///
/// # Errors
/// All its faults.
pub fn parse(text: &str, file: &str) -> Result<Vec<Reading>, MeasurementFaults> {
    let mut faults = Vec::new();
    let readings = readings(text, &mut faults);
    if faults.is_empty() {
        Ok(readings)
    } else {
        let file = file.to_owned();
        Err(MeasurementFaults { file, faults })
    }
}

fn fault(place: Option<(usize, usize)>, message: impl Into<String>) -> MeasurementFault {
    MeasurementFault {
        place,
        message: message.into(),
    }
}

fn readings(text: &str, faults: &mut Vec<MeasurementFault>) -> Vec<Reading> {
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let mut lines = lines
        .map(|(at, line)| (at + 1, line.split('#').next().unwrap_or("")))
        .filter(|(_, line)| !line.trim().is_empty());
    let Some((number, first)) = lines.next() else {
        let message = "it is empty: a line with names of columns is needed, such as \
                       `angle, friction`, and a line for each reading";
        faults.push(fault(None, message));
        return Vec::new();
    };
    let Some(header) = Header::read(number, first, faults) else {
        return Vec::new();
    };
    let rows = lines.filter_map(|(number, line)| header.reading(number, line, faults));
    let readings: Vec<Reading> = rows.collect();
    if readings.is_empty() && faults.is_empty() {
        faults.push(fault(None, "it has no readings below the names of columns"));
    }
    readings
}

/// The fields of a line, with their columns in the text.
fn fields(line: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut start = 0;
    line.split(',').map(move |field| {
        let blanks = field.chars().take_while(|c| c.is_whitespace()).count();
        let column = start + blanks + 1;
        start += field.chars().count() + 1;
        (column, field.trim())
    })
}

/// Which field of a line is which quantity.
struct Header {
    /// Index in [`COLUMNS`] of each field.
    columns: Vec<usize>,
}

impl Header {
    fn read(number: usize, line: &str, faults: &mut Vec<MeasurementFault>) -> Option<Self> {
        let before = faults.len();
        let mut columns = Vec::new();
        for (column, name) in fields(line) {
            let place = Some((number, column));
            match COLUMNS.iter().position(|known| *known == name) {
                Some(known) if columns.contains(&known) => {
                    let message = format!("column `{name}` is there twice");
                    faults.push(fault(place, message));
                }
                Some(known) => columns.push(known),
                None => {
                    let known = COLUMNS.map(|name| format!("`{name}`")).join(", ");
                    let message = format!("`{name}` is no column; columns are {known}");
                    faults.push(fault(place, message));
                }
            }
        }
        let header = Self { columns };
        if faults.len() == before {
            let ratio = [header.has("tangential"), header.has("normal")];
            let message = match (header.has("friction"), ratio) {
                _ if !header.has("angle") => "a column `angle` is needed: slip in degrees",
                (true, [false, false]) | (false, [true, true]) => return Some(header),
                (true, _) => "either `friction` is needed or `tangential` and `normal`, not both",
                (false, _) => "a column `friction` is needed, or `tangential` and `normal`",
            };
            faults.push(fault(Some((number, 1)), message));
        }
        None
    }

    fn has(&self, name: &str) -> bool {
        self.field(name).is_some()
    }

    fn field(&self, name: &str) -> Option<usize> {
        let columns = self.columns.iter();
        columns.copied().position(|known| COLUMNS[known] == name)
    }

    /// The reading of a line, or `None` after its faults have been noted.
    fn reading(
        &self,
        number: usize,
        line: &str,
        faults: &mut Vec<MeasurementFault>,
    ) -> Option<Reading> {
        let before = faults.len();
        let fields: Vec<(usize, &str)> = fields(line).collect();
        if fields.len() != self.columns.len() {
            let (found, needed) = (fields.len(), self.columns.len());
            let message = format!("numbers: {found}, but columns: {needed}; each needs one");
            faults.push(fault(Some((number, 1)), message));
            return None;
        }
        let mut value = |name: &str, positive: Sign| {
            let (column, text) = fields[self.field(name)?];
            let found = text
                .parse::<f64>()
                .ok()
                .filter(|value| positive.allows(*value));
            if found.is_none() {
                let message = format!("`{text}` is no {} for `{name}`", positive.words());
                faults.push(fault(Some((number, column)), message));
            }
            found
        };
        let angle = value("angle", Sign::Any);
        let friction = match self.has("friction") {
            true => value("friction", Sign::Any),
            false => {
                let forces = [
                    value("tangential", Sign::Any),
                    value("normal", Sign::Positive),
                ];
                forces[0].zip(forces[1]).map(|(t, n)| t / n)
            }
        };
        let direction = value("direction", Sign::Any);
        let theta = value("theta", Sign::Any);
        let spread = value("spread", Sign::Positive);
        if faults.len() > before {
            return None;
        }
        let (slip, friction) = (angle?.to_radians(), friction?);
        let reading = match direction {
            Some(direction) => Reading::directed(slip, friction, direction.to_radians()),
            None => Reading::against(slip, friction),
        };
        Some(Reading {
            theta: theta.unwrap_or(0.0).to_radians(),
            spread: spread.unwrap_or(1.0),
            ..reading
        })
    }
}

/// What a number has to be.
#[derive(Clone, Copy)]
enum Sign {
    Any,
    Positive,
}

impl Sign {
    fn allows(self, value: f64) -> bool {
        match self {
            Self::Any => value.is_finite(),
            Self::Positive => value.is_finite() && value > 0.0,
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Any => "finite number",
            Self::Positive => "positive number",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Reading, parse};

    #[test]
    fn readings_are_read() {
        let text = "\u{feff}# ground steel\nangle, tangential, normal, theta # degrees, N\n\
                    0, 3, 10, 0\n\n90, 2, 10, 45\n";
        let readings = parse(text, "m.csv").unwrap();
        assert_eq!(readings[0], Reading::against(0.0, 0.3));
        assert_eq!(readings[1].theta, 45f64.to_radians());
        let text = "spread,direction,friction,angle\n2,120,.5,90\n";
        let reading = parse(text, "m.csv").unwrap()[0];
        let directed = Reading::directed(90f64.to_radians(), 0.5, 120f64.to_radians());
        assert_eq!(
            reading,
            Reading {
                spread: 2.0,
                ..directed
            }
        );
        assert!((reading.across.unwrap() - 0.25).abs() < 1e-15);
    }

    #[test]
    fn all_faults_are_told_with_their_places() {
        let text = "angle, friction, spread\n0, 0.3, 1\n30, much, 0\n60, 0.2\n90, inf, 1\n";
        assert_eq!(
            parse(text, "m.csv").unwrap_err().to_string(),
            "m.csv:3:5: `much` is no finite number for `friction`\n\
             m.csv:3:11: `0` is no positive number for `spread`\n\
             m.csv:4:1: numbers: 2, but columns: 3; each needs one\n\
             m.csv:5:5: `inf` is no finite number for `friction`"
        );
        for (text, message) in [
            ("", "it is empty"),
            ("angle,friction\n", "no readings"),
            (
                "0,0.3\n",
                "m.csv:1:1: `0` is no column; columns are `angle`, `friction`",
            ),
            ("angle,mu\n0,1\n", "m.csv:1:7: `mu` is no column"),
            ("angle,angle,friction\n", "column `angle` is there twice"),
            ("friction\n1\n", "a column `angle` is needed"),
            ("angle,normal\n1,1\n", "a column `friction` is needed, or"),
            ("angle,friction,normal\n1,1,1\n", "not both"),
            (
                "angle,tangential,normal\n1,1,-1\n",
                "m.csv:2:5: `-1` is no positive number",
            ),
        ] {
            let told = parse(text, "m.csv").unwrap_err().to_string();
            assert!(told.contains(message), "{told}");
        }
    }
}
