//! The verdicts, and how they are shown.

use std::path::Path;

use super::{Expected, Quantity, Target, Tolerance};
use crate::OutputError;
use striae_files::quoted;
use striae_files::write_atomically;

/// One quantity, computed against expected.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Expected quantity.
    pub quantity: Quantity,
    /// Computed value, if there is one.
    pub computed: Option<f64>,
    /// Verdict on the quantity.
    pub verdict: Verdict,
}

/// Verdict on a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Inside the tolerance.
    Pass,
    /// Outside the tolerance, or not a number.
    Fail,
    /// Not computed at all.
    Missing,
}

/// Compares every expected quantity with what `computed` has under its name.
pub fn compare(expected: &Expected, computed: impl Fn(&str) -> Option<f64>) -> Vec<Comparison> {
    let quantities = expected.quantities.iter().cloned();
    quantities
        .map(|quantity| {
            let computed = computed(&quantity.name);
            let verdict = match computed {
                None => Verdict::Missing,
                Some(found) if quantity.target.contains(found) => Verdict::Pass,
                Some(_) => Verdict::Fail,
            };
            Comparison {
                quantity,
                computed,
                verdict,
            }
        })
        .collect()
}

/// The comparisons as an aligned table `quantity | computed | expected | deviation | verdict`.
pub fn report(comparisons: &[Comparison]) -> String {
    let mut rows =
        vec![["quantity", "computed", "expected", "deviation", "verdict"].map(String::from)];
    rows.extend(comparisons.iter().map(|comparison| {
        let unit = &comparison.quantity.unit;
        let name = if unit.is_empty() {
            comparison.quantity.name.clone()
        } else {
            format!("{} [{unit}]", comparison.quantity.name)
        };
        [
            name,
            comparison.computed.map_or("-".into(), number),
            comparison.quantity.target.text(),
            comparison.deviation_text(),
            comparison.verdict.word().to_owned(),
        ]
    }));
    let widths: [usize; 5] = std::array::from_fn(|c| {
        rows.iter()
            .map(|row| row[c].chars().count())
            .max()
            .unwrap_or(0)
    });
    let rule = widths.map(|width| "-".repeat(width)).join("-+-");
    let mut lines: Vec<String> = rows.iter().map(|row| aligned(row, widths)).collect();
    lines.insert(1, rule);
    lines.join("\n") + "\n"
}

/// Writes the comparisons, with their sources, as comma-separated text.
pub fn write_csv(path: &Path, comparisons: &[Comparison], extent: &str) -> Result<(), OutputError> {
    let mut text = String::from("quantity,unit,computed,min,max,deviation,verdict,source,run\n");
    for comparison in comparisons {
        let (min, max) = comparison.quantity.target.interval();
        let exact = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:?}"));
        let fields = [
            quoted(&comparison.quantity.name),
            quoted(&comparison.quantity.unit),
            exact(comparison.computed),
            exact(Some(min)),
            exact(Some(max)),
            exact(comparison.deviation()),
            comparison.verdict.word().to_owned(),
            quoted(&comparison.quantity.source),
            quoted(extent),
        ];
        text += &(fields.join(",") + "\n");
    }
    write_atomically(path, text.as_bytes())?;
    Ok(())
}

impl Comparison {
    /// Relative deviation for a relative tolerance, difference for an absolute
    /// one, distance to the range (0 inside) for a range.
    pub fn deviation(&self) -> Option<f64> {
        let found = self.computed?;
        Some(match self.quantity.target {
            Target::Value { value, tolerance } => match tolerance {
                Tolerance::Absolute(_) => found - value,
                Tolerance::Relative(_) => (found - value) / value.abs(),
            },
            Target::Range { max, .. } if found > max => found - max,
            Target::Range { min, .. } if found < min => found - min,
            Target::Range { .. } if found.is_nan() => f64::NAN,
            Target::Range { .. } => 0.0,
        })
    }

    fn deviation_text(&self) -> String {
        match (self.deviation(), self.quantity.target) {
            (None, _) => "-".into(),
            (Some(0.0), Target::Range { .. }) => "inside".into(),
            (
                Some(deviation),
                Target::Value {
                    tolerance: Tolerance::Relative(_),
                    ..
                },
            ) => format!("{:+.2} %", 100.0 * deviation)
                .replace("+0.00 %", "0.00 %")
                .replace("-0.00 %", "0.00 %"),
            (Some(deviation), _) => format!("{deviation:+.2e}"),
        }
    }
}

impl Verdict {
    /// The verdict as a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "FAIL",
            Self::Missing => "MISSING",
        }
    }
}

impl Target {
    /// Returns whether `found` is within the bounds; `false` for a NaN.
    pub fn contains(&self, found: f64) -> bool {
        match *self {
            Self::Value { value, tolerance } => (found - value).abs() <= tolerance.width(value),
            Self::Range { min, max } => min <= found && found <= max,
        }
    }

    /// Least and largest value that pass.
    pub fn interval(&self) -> (f64, f64) {
        match *self {
            Self::Value { value, tolerance } => {
                let width = tolerance.width(value);
                (value - width, value + width)
            }
            Self::Range { min, max } => (min, max),
        }
    }

    fn text(&self) -> String {
        match *self {
            Self::Value {
                value,
                tolerance: Tolerance::Relative(width),
            } => {
                format!("{} ± {} %", number(value), number(100.0 * width))
            }
            Self::Value {
                value,
                tolerance: Tolerance::Absolute(width),
            } => {
                format!("{} ± {}", number(value), number(width))
            }
            Self::Range { min, max } if min == f64::NEG_INFINITY => format!("<= {}", number(max)),
            Self::Range { min, max } if max == f64::INFINITY => format!(">= {}", number(min)),
            Self::Range { min, max } => format!("{} .. {}", number(min), number(max)),
        }
    }
}

impl Tolerance {
    fn width(self, value: f64) -> f64 {
        match self {
            Self::Absolute(width) => width,
            Self::Relative(fraction) => fraction * value.abs(),
        }
    }
}

/// Six significant digits, trailing zeros dropped.
fn number(value: f64) -> String {
    let magnitude = value.abs();
    if value != 0.0 && !(1e-4..1e7).contains(&magnitude) {
        let text = format!("{value:.5e}");
        return match text.split_once('e') {
            Some((digits, exponent)) if digits.contains('.') => {
                let digits = digits.trim_end_matches('0').trim_end_matches('.');
                format!("{digits}e{exponent}")
            }
            _ => text,
        };
    }
    let before = if value == 0.0 {
        1
    } else {
        magnitude.log10().floor() as i32 + 1
    };
    let decimals = (6 - before).clamp(1, 10) as usize;
    let text = format!("{value:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn aligned(row: &[String; 5], widths: [usize; 5]) -> String {
    let cells = row
        .iter()
        .zip(widths)
        .enumerate()
        .map(|(column, (cell, width))| {
            if (1..4).contains(&column) {
                format!("{cell:>width$}")
            } else {
                format!("{cell:<width$}")
            }
        });
    cells.collect::<Vec<_>>().join(" | ").trim_end().to_owned()
}
