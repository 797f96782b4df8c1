//! From numbers to lengths: limits of an axis and its mapping onto the page.

use super::description::{Axis, Limits, Scale};
use super::ticks::{self, Ticks, power_of_ten};

/// Numbers `first..last` mapped onto lengths `from..to`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mapping {
    pub scale: Scale,
    pub first: f64,
    pub last: f64,
    pub from: f64,
    pub to: f64,
}

impl Mapping {
    /// Position of a number; `None` if it has no place on the axis.
    pub fn place(&self, number: f64) -> Option<f64> {
        let fraction = match self.scale {
            Scale::Linear => (number - self.first) / (self.last - self.first),
            Scale::Logarithmic => (number / self.first).ln() / (self.last / self.first).ln(),
        };
        let place = self.from + fraction * (self.to - self.from);
        place.is_finite().then_some(place)
    }

    /// Ticks about `spacing` apart.
    pub fn ticks(&self, spacing: f64) -> Ticks {
        let count = ((self.to - self.from).abs() / spacing).floor().max(2.0) as usize;
        match self.scale {
            Scale::Linear => ticks::linear(self.first, self.last, count),
            Scale::Logarithmic => ticks::logarithmic(self.first, self.last, count),
        }
    }
}

impl Axis {
    /// Label, power of ten and unit.
    pub(super) fn text(&self, exponent: i32) -> String {
        let factor = (exponent != 0).then(|| power_of_ten(exponent));
        let unit = (!self.unit.is_empty()).then(|| self.unit.clone());
        let brackets: Vec<String> = factor.into_iter().chain(unit).collect();
        if brackets.is_empty() {
            self.label.clone()
        } else {
            format!("{} [{}]", self.label, brackets.join(" "))
        }
    }

    /// First and last number, given all that must be seen.
    pub(super) fn limits(&self, numbers: impl Iterator<Item = f64>) -> Result<(f64, f64), String> {
        match self.limits {
            Limits::Fixed(first, last) => self.checked(first, last),
            Limits::Automatic => Ok(self.around(numbers)),
        }
    }

    /// First and last number of a colour bar: without room beside the values.
    pub(super) fn bar_limits(&self, values: &[f64]) -> Result<(f64, f64), String> {
        let finite = || values.iter().copied().filter(|value| value.is_finite());
        let low = finite().fold(f64::INFINITY, f64::min);
        let high = finite().fold(f64::NEG_INFINITY, f64::max);
        match self.limits {
            Limits::Automatic if low < high => Ok((low, high)),
            _ => self.limits(finite()),
        }
    }

    fn checked(&self, first: f64, last: f64) -> Result<(f64, f64), String> {
        let label = &self.label;
        if !(first.is_finite() && last.is_finite()) || first == last {
            Err(format!(
                "axis `{label}` cannot extend from {first} to {last}"
            ))
        } else if self.scale == Scale::Logarithmic && (first <= 0.0 || last <= 0.0) {
            Err(format!(
                "logarithmic axis `{label}` cannot extend from {first} to {last}"
            ))
        } else {
            Ok((first, last))
        }
    }

    fn around(&self, numbers: impl Iterator<Item = f64>) -> (f64, f64) {
        let logarithmic = self.scale == Scale::Logarithmic;
        let visible = numbers.filter(|n| n.is_finite() && (!logarithmic || *n > 0.0));
        let (low, high) = visible.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), n| {
            (low.min(n), high.max(n))
        });
        match (low <= high, logarithmic) {
            (false, false) => (0.0, 1.0),
            (true, false) if low == 0.0 && high == 0.0 => (0.0, 1.0),
            (false, true) => (0.1, 1.0),
            (true, true) => {
                let room = (high / low).powf(0.06).max(1.15);
                (low / room, high * room)
            }
            (true, false) => {
                let span = high - low;
                let room = if span > 1e-12 * high.abs().max(low.abs()) {
                    0.05 * span
                } else {
                    (0.5 * high.abs()).max(1e-12)
                };
                let first = if low == 0.0 { 0.0 } else { low - room };
                (
                    first,
                    if high == 0.0 {
                        0.0_f64.max(first + span)
                    } else {
                        high + room
                    },
                )
            }
        }
    }
}
