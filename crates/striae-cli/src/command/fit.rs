//! `striae fit MEASUREMENTS --law LAW`: constants of a friction law from measured friction.
//!
//! Prints the law as a table of a deck, the interval of each constant and the scatter of the
//! readings about the law; see [`striae_law::fit`].

mod sought;

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use serde_json::{Value, json};
use striae::{
    figures,
    measurements::{self, AngleFrom, Angles, Form, Measured, MeasurementFaults, NamedColumn},
};
use striae_declared::{self as declared, Absent, Kind};
use striae_law::{
    fit::{Fit, Reading, Sought, Standing, fit},
    friction::{Friction, RequiredTextures},
};

use super::law::make_folder;
use crate::failure::Failure;
use sought::Law;

/// Find the constants of a friction law from measurements.
///
/// MEASUREMENTS is a text file with commas, semicolons, tabs or blanks between numbers, one reading
/// a line, under a line with the names of columns, in any letters and with units in brackets behind
/// where you like: `angle`, the direction in which the textured
/// surface slips, in degrees from its texture `a` (across the grooves, against a nap; of two
/// textures from the bisector of both; `--angle-from along` counts from the grooves), which
/// `--law coulomb` does without;
/// `friction`, tangential over normal force, or the forces `tangential` and `normal`; and where
/// they are known `direction`, the angle of the force that drags the textured surface, `theta`,
/// the angle between the textures of two surfaces, `spread`, the standard deviation of a reading
/// in proportion to others, and `specimen`, the name of the one that was measured; readings of
/// one specimen are not taken as independent. Other columns are not used.
#[derive(clap::Args)]
pub struct Arguments {
    /// The file of measurements.
    measurements: PathBuf,
    #[command(flatten)]
    law: Law,
    /// Direction of slip at the angle 0: across the grooves (against a nap), or along them.
    #[arg(long, value_enum, default_value = "across")]
    angle_from: FromName,
    /// A quantity that the file names otherwise, with the name or number of its column.
    #[arg(long, value_name = "QUANTITY=COLUMN", value_delimiter = ',')]
    columns: Vec<NamedColumn>,
    /// Lines at the beginning of the file to pass over.
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    skip_lines: usize,
    /// Probability with which a constant lies in its interval.
    #[arg(long, default_value_t = 0.95)]
    level: f64,
    /// Draws measurements and law; written as .svg, .png and .csv.
    #[arg(long, value_name = "NAME.svg")]
    plot: Option<PathBuf>,
    /// Print the same as JSON.
    #[arg(long)]
    json: bool,
}

/// Directions that angles count from.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum FromName {
    Across,
    Along,
}

impl Arguments {
    fn form(&self) -> Form {
        Form {
            angle_from: match self.angle_from {
                FromName::Across => AngleFrom::Across,
                FromName::Along => AngleFrom::Along,
            },
            angles: match self.law.0.is_isotropic() {
                true => Angles::Optional,
                false => Angles::Needed,
            },
            skipped: self.skip_lines,
            columns: self.columns.clone(),
        }
    }

    /// Direction of slip at the angle 0, for laws that depend on it.
    fn convention(&self, found: &Friction) -> Option<&'static str> {
        match (found.required_textures(), self.angle_from) {
            (RequiredTextures::Any, _) => None,
            (RequiredTextures::Both, FromName::Across) => Some(
                "angle 0 is slip across the bisector of the two textures; if yours counts from along it, add `--angle-from along`",
            ),
            (RequiredTextures::One, FromName::Across) => Some(
                "angle 0 is slip across the grooves (against a nap); if yours is along them, add `--angle-from along`",
            ),
            (_, FromName::Along) => Some("angle 0 is slip along the grooves"),
        }
    }
}

/// Fits, prints and draws.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let file = arguments.measurements.display().to_string();
    let text = std::fs::read_to_string(&arguments.measurements)
        .map_err(|cause| MeasurementFaults::unreadable(&file, &cause))?;
    let measured = measurements::read(&text, &file, &arguments.form())?;
    let Measured {
        readings,
        specimens,
        notes,
    } = measured;
    let Law(sought) = &arguments.law;
    let found = fit(sought, &readings, arguments.level)?;
    let said = Said {
        deck: snippet(sought, &found),
        convention: arguments.convention(&found.friction),
        specimens,
        notes,
    };
    match arguments.json {
        true => writeln!(out, "{:#}", said.json(&found, &readings))?,
        false => write!(out, "{}", said.text(&found, &readings))?,
    }
    if let Some(plot) = &arguments.plot {
        draw(plot, arguments.json, &found, &readings, out)?;
    }
    Ok(())
}

/// Draws measurements and law; says where, but in JSON.
fn draw(
    plot: &Path,
    json: bool,
    found: &Fit,
    readings: &[Reading],
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let folder = plot.parent().unwrap_or(Path::new(""));
    let name = plot
        .file_stem()
        .unwrap_or(plot.as_os_str())
        .to_string_lossy();
    if folder != Path::new("") {
        make_folder(folder)?;
    }
    figures::fit::figure(found, readings).write(folder, &name)?;
    if !json {
        let file = folder.join(&*name);
        writeln!(out, "wrote {}.svg, .png and .csv", file.display())?;
    }
    Ok(())
}

/// Words of an answer beside the numbers of its fit.
struct Said {
    deck: String,
    convention: Option<&'static str>,
    specimens: Vec<String>,
    notes: Vec<String>,
}

impl Said {
    fn text(&self, found: &Fit, readings: &[Reading]) -> String {
        let mut text = format!(
            "{}\n\n{}{}\n",
            self.deck,
            intervals(found),
            verdict(found, readings)
        );
        let notes = self.notes.iter().cloned();
        let convention = self.convention.map(str::to_owned);
        let lines = self.beside_the_law(found, readings);
        for line in lines.into_iter().chain(convention).chain(notes) {
            text += &format!("  {line}\n");
        }
        text
    }

    /// Friction of the specimens over that of the law, in a sentence.
    fn beside_the_law(&self, found: &Fit, readings: &[Reading]) -> Option<String> {
        let told = found.specimens.iter().map(|one| {
            let of = readings.iter().filter(|own| own.specimen == one.number);
            let (name, count) = (&self.specimens[one.number], of.count());
            format!("`{name}` {:.3} ({count})", one.factor)
        });
        let told: Vec<String> = told.collect();
        let text = format!(
            "specimens: {}; friction over that of the law (readings): {}",
            told.len(),
            told.join(", ")
        );
        (!told.is_empty()).then_some(text)
    }

    fn json(&self, found: &Fit, readings: &[Reading]) -> Value {
        let constants = found.constants.iter().map(|one| {
            let interval = one
                .interval
                .filter(|ends| ends.iter().all(|end| end.is_finite()));
            json!({ "name": one.name.to_string(), "value": one.value, "interval": interval })
        });
        let specimens = found
            .specimens
            .iter()
            .map(|one| json!({ "name": self.specimens[one.number], "factor": one.factor }));
        json!({
            "deck": self.deck,
            "constants": constants.collect::<Vec<_>>(),
            "level": found.level,
            "readings": readings.len(),
            "degrees_of_freedom": found.degrees_of_freedom,
            "deviation": found.deviation,
            "at_bound": found.standing == Standing::AtBound,
            "specimens": specimens.collect::<Vec<_>>(),
            "convention": self.convention,
            "notes": self.notes,
        })
    }
}

/// The law as a deck states it, but for words that are the default.
fn snippet(sought: &Sought, found: &Fit) -> String {
    let law = sought.law();
    let stated = found.friction.statement();
    let mut text = format!("friction = {{ law = \"{}\"", law.name);
    for parameter in law.parameters {
        let value = stated.and_then(|stated| stated.values.get(parameter.name));
        let value = match (value, parameter.absent) {
            (None, _) => continue,
            (Some(declared::Value::Word(word)), Absent::Word(default)) if *word == default => {
                continue;
            }
            (Some(declared::Value::Word(word)), _) => format!("\"{word}\""),
            (Some(declared::Value::Number(number)), _) => rounded(*number),
            (Some(declared::Value::Numbers(numbers)), _) => {
                let numbers: Vec<String> = numbers.iter().copied().map(rounded).collect();
                format!("[{}]", numbers.join(", "))
            }
            // No fit finds values of other forms.
            _ => continue,
        };
        text += &format!(", {} = {value}", parameter.name);
    }
    text + " }"
}

/// Six digits, more than any measurement has.
fn rounded(value: f64) -> String {
    let digits = 5 - value.abs().log10().floor().clamp(-300.0, 5.0) as i32;
    let text = format!("{value:.*}", digits.unsigned_abs() as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// A line for each constant.
fn intervals(found: &Fit) -> String {
    let level = figures_of(100.0 * found.level);
    let width = found.constants.iter().map(|one| one.name.to_string().len());
    let width = width.max().unwrap_or(0);
    let line = |one: &striae_law::fit::Constant| {
        let interval = match one.interval {
            Some([low, high]) if low.is_finite() => {
                format!("   {level} % within {low:.4} .. {high:.4}")
            }
            Some(_) => "   open: the measurements do not bound it".to_owned(),
            None => String::new(),
        };
        let name = one.name.to_string();
        format!("  {name:<width$}  {:8.4}{interval}\n", one.value)
    };
    found.constants.iter().map(line).collect()
}

fn figures_of(number: f64) -> String {
    ((number * 1e6).round() / 1e6).to_string()
}

/// Quality of the law in words.
fn verdict(found: &Fit, readings: &[Reading]) -> String {
    let mean = readings.iter().map(|reading| reading.against).sum::<f64>() / readings.len() as f64;
    let mut text = format!("  readings: {}", readings.len());
    match found.deviation {
        Some(deviation) => {
            let share = 100.0 * deviation / mean;
            text += &format!(
                ", degrees of freedom: {}, standard deviation of a reading from the law: \
                 {deviation:.4} ({share:.1} % of the mean friction {mean:.4})",
                found.degrees_of_freedom
            );
        }
        None => text += ", as many as constants: there is nothing to tell their errors by",
    }
    if found.standing == Standing::AtBound {
        text += "\n  the law that is closest to the readings would create energy; this is the \
                 closest one that does not. Look at the angles of the readings, or try another law";
    }
    text
}
