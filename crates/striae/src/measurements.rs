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
//! | `angle` | direction in which the textured surface slips, from its texture `a` (across the grooves, against a nap), counter-clockwise as seen from outside it; of two textured surfaces from the bisector of `a_a` and `a_b'` (degrees) |
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

/// Layout of a file of measurements.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Form {
    /// Direction that angles count from.
    pub angle_from: AngleFrom,
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

#[cfg(test)]
mod tests {
    use super::{AngleFrom, Form, Reading, parse, read};

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
            "m.csv:3:5: `much` is not a finite number for `friction`\nm.csv:3:11: `0` is not a positive number for `spread`\nm.csv:4:1: fields: 2, but columns: 3; each needs one\nm.csv:5:5: `inf` is not a finite number for `friction`"
        );
        for (text, message) in [
            ("", "it is empty"),
            ("angle,friction\n", "no readings"),
            ("0,0.3\n", "m.csv:1:1: numbers, but no names of columns"),
            (
                "angle,COF\n0,1\n",
                "m.csv:1:1: a column `friction` is needed, or `tangential` and `normal`; there are `angle`, `COF`; name yours by `--columns`, such as `--columns friction=COLUMN`",
            ),
            (
                "panel,x,y\n1,0,1\n",
                "there are `panel`, `x`, `y`; name yours by `--columns`, such as `--columns angle=COLUMN`",
            ),
            (
                "Angle,angle (deg),friction\n0,0,1\n",
                "m.csv:1:7: columns `Angle` and `angle (deg)` can both be `angle`; name one of them: `--columns angle=1`",
            ),
            (
                "angle [rad],friction\n0,1\n",
                "m.csv:1:1: column `angle [rad]`: `angle` is needed in degrees; convert it",
            ),
            (
                "angle,tangental,normal\n0,1,1\n",
                "unknown column `tangental`; did you mean `tangential`?",
            ),
            ("angle,angle,friction\n", "column `angle` appears twice"),
            ("friction\n1\n", "a column `angle` is needed"),
            ("angle,normal\n1,1\n", "a column `friction` is needed, or"),
            ("angle,friction,normal\n1,1,1\n", "not both"),
            (
                "angle,tangential,normal\n1,1,-1\n",
                "m.csv:2:5: `-1` is not a positive number",
            ),
            (
                "angle,friction\n0,.3\n90,1e308\n",
                "m.csv:3:4: friction of more than 1000, but it is tangential over normal force",
            ),
            (
                "angle,tangential,normal\n1,1e200,1e-200\n",
                "m.csv:2:3: friction of more than 1000",
            ),
            (
                "angle,friction,spread\n1,.3,1e-300\n",
                "m.csv:2:6: `spread` must lie between 0.000001 and 1000000",
            ),
        ] {
            let told = parse(text, "m.csv").unwrap_err().to_string();
            assert!(told.contains(message), "{told}");
        }
    }

    #[test]
    fn files_of_instruments_are_read() {
        let text =
            "Tribometer 7\nTest;Angle;Fz [N];Fx [N];Temp\n1;0;2,5;0,5;23,1\n2;90;2;0,8;warm\n";
        let columns = ["angle=Angle", "normal=Fz [N]", "tangential=4"];
        let form = Form {
            skipped: 1,
            columns: columns.map(|one| one.parse().unwrap()).to_vec(),
            ..Form::default()
        };
        let measured = read(text, "m.csv", &form).unwrap();
        let expected = [(0.0, 0.2), (90f64.to_radians(), 0.4)];
        let expected = expected.map(|(slip, friction)| Reading::against(slip, friction));
        assert_eq!(measured.readings, expected);
        assert_eq!(measured.notes, ["unused columns: `Test`, `Temp`"]);
        let bare = read(
            "0\t0.2\n90\t0.4\n",
            "m.csv",
            &Form {
                columns: ["angle=1", "friction=2"]
                    .map(|one| one.parse().unwrap())
                    .to_vec(),
                ..Form::default()
            },
        );
        assert_eq!(bare.unwrap().readings, expected);
        let missing = Form {
            columns: vec!["normal=Fy".parse().unwrap()],
            ..form
        };
        let told = read(text, "m.csv", &missing).unwrap_err().to_string();
        assert!(
            told.contains("m.csv:2:1: unknown column `Fy`; there are `Test`"),
            "{told}"
        );
    }

    #[test]
    fn names_have_capitals_and_units_and_blanks_separate() {
        let expected = parse("angle,friction\n0,.3\n90,.2\n", "m.csv").unwrap();
        for text in [
            "Angle (deg),Mu\n0,.3\n90,.2\n",
            "Friction;angle [°];Normal (N)\n0,3;0;7\n0,2;90;8\n",
            "angle  friction\n 0  .3\n90  .2\n",
        ] {
            let measured = read(text, "m.csv", &Form::default()).unwrap();
            assert_eq!(measured.readings, expected, "{text}");
            assert_eq!(measured.notes.is_empty(), !text.contains("Normal"));
        }
    }

    #[test]
    fn numbers_that_are_hardly_meant_are_noted() {
        let notes = |text: &str| read(text, "m.csv", &Form::default()).unwrap().notes;
        let usual = "angle,friction\n0,.3\n90,.2\n180,.25\n";
        assert!(notes(usual).is_empty());
        for (line, words) in [
            (
                "45,-.2\n",
                "negative friction, which would drive the slip: -0.2 in line 5; ",
            ),
            (
                "45,35\n",
                "more than 10 times the median 0.3000: 35 in line 5; is it in percent",
            ),
        ] {
            let told = notes(&format!("{usual}{line}"));
            assert!(told.len() == 1 && told[0].contains(words), "{told:?}");
        }
        let told = notes("angle,friction\n0,.3\n1.5708,.2\n3.1416,.25\n");
        assert!(told[0].contains("are they in radians?"), "{told:?}");
    }

    #[test]
    fn specimens_are_numbered_by_their_names() {
        let text = "specimen,angle,friction\nleft,0,0.2\nright,0,0.3\nleft,90,0.4\n";
        let measured = read(text, "m.csv", &Form::default()).unwrap();
        let numbers: Vec<usize> = measured.readings.iter().map(|one| one.specimen).collect();
        assert_eq!(numbers, [0, 1, 0]);
        assert_eq!(measured.specimens, ["left", "right"]);
        let told = parse("specimen,angle,friction\n,0,0.2\n", "m.csv");
        let told = told.unwrap_err().to_string();
        assert!(
            told.contains("m.csv:2:1: the name of the specimen is missing"),
            "{told}"
        );
    }

    #[test]
    fn angles_from_the_grooves_are_turned_by_a_quarter() {
        let form = Form {
            angle_from: AngleFrom::Along,
            ..Form::default()
        };
        let text = "angle,friction,direction\n90,0.4,100\n";
        let along = read(text, "m.csv", &form).unwrap().readings[0];
        let across = parse("angle,friction,direction\n0,0.4,10\n", "m.csv").unwrap()[0];
        assert!((along.slip - across.slip).abs() < 1e-15);
        assert!((along.against - across.against).abs() < 1e-15);
        assert!((along.across.unwrap() - across.across.unwrap()).abs() < 1e-15);
    }
}
