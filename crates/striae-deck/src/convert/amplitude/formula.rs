//! Amplitudes by a formula.
//!
//! With `x = t - t0`, and `A0` before,
//!
//! ```text
//! PERIODIC    A0 + sum_n (A_n cos n w x + B_n sin n w x)    N, w, t0, A0; A_1, B_1, ...
//! MODULATED   A0 + A sin w1 x sin w2 x                      A0, A, t0, w1, w2
//! DECAY       A0 + A exp(-x/d)                              A0, A, t0, d
//! ```
//!
//! Source: Abaqus keywords reference guide, `*AMPLITUDE`.

use super::Period;

/// Points in the shortest period of a formula.
const POINTS: f64 = 60.0;
/// Most points in a step.
const MOST: f64 = 4000.0;

/// Reason why a formula cannot be used.
pub(super) enum Fault {
    Kind,
    Numbers,
}

/// A formula.
pub(super) struct Formula {
    /// `t0`.
    pub(super) begin: f64,
    mean: f64,
    terms: Terms,
}

enum Terms {
    /// `w` with the pairs `A_n`, `B_n`.
    Periodic(f64, Vec<[f64; 2]>),
    /// `A`, `w1`, `w2`.
    Modulated([f64; 3]),
    /// `A`, `d`.
    Decay([f64; 2]),
}

impl Formula {
    /// The formula of a kind with all numbers below its keyword.
    pub(super) fn read(kind: &str, all: &[f64]) -> Result<Self, Fault> {
        match (kind, all) {
            ("PERIODIC", [count, frequency, begin, mean, pairs @ ..]) if !pairs.is_empty() => {
                let mut pairs: Vec<[f64; 2]> = pairs
                    .chunks(2)
                    .map(|of| [of[0], of.get(1).copied().unwrap_or(0.0)])
                    .collect();
                if *count > pairs.len() as f64 {
                    return Err(Fault::Numbers);
                }
                pairs.truncate(*count as usize);
                Ok(Self {
                    begin: *begin,
                    mean: *mean,
                    terms: Terms::Periodic(*frequency, pairs),
                })
            }
            ("MODULATED", [mean, height, begin, first, second]) => Ok(Self {
                begin: *begin,
                mean: *mean,
                terms: Terms::Modulated([*height, *first, *second]),
            }),
            ("DECAY", [mean, height, begin, time]) if *time != 0.0 => Ok(Self {
                begin: *begin,
                mean: *mean,
                terms: Terms::Decay([*height, *time]),
            }),
            ("PERIODIC" | "MODULATED" | "DECAY", _) => Err(Fault::Numbers),
            _ => Err(Fault::Kind),
        }
    }

    /// Function of the time of the run, where the time of the formula begins at `offset`.
    pub(super) fn text(&self, offset: f64) -> String {
        let x = match offset + self.begin {
            0.0 => "t".to_owned(),
            begin => format!("(t - {begin:?})"),
        };
        let terms = match &self.terms {
            Terms::Periodic(frequency, pairs) => {
                let term = |(at, [a, b]): (usize, &[f64; 2])| {
                    let arm = format!("{:?}*{x}", (at + 1) as f64 * frequency);
                    format!(" + ({a:?})*cos({arm}) + ({b:?})*sin({arm})")
                };
                pairs.iter().enumerate().map(term).collect::<String>()
            }
            Terms::Modulated([height, first, second]) => {
                format!(" + ({height:?})*sin({first:?}*{x})*sin({second:?}*{x})")
            }
            Terms::Decay([height, time]) => format!(" + ({height:?})*exp(-{x}/({time:?}))"),
        };
        format!("{:?}{terms}", self.mean)
    }

    /// Points over a step.
    pub(super) fn points(&self, offset: f64, period: Period) -> Vec<[f64; 2]> {
        let fastest = match &self.terms {
            Terms::Periodic(frequency, pairs) => frequency * pairs.len() as f64,
            Terms::Modulated([_, first, second]) => first.abs() + second.abs(),
            Terms::Decay([_, time]) => std::f64::consts::TAU / time.abs(),
        };
        let periods = fastest.abs() * period.duration / std::f64::consts::TAU;
        let count = (POINTS * periods).clamp(POINTS, MOST).ceil();
        let places = (0..=count as usize).map(|at| at as f64 / count);
        let time = |s: f64| period.start + s * period.duration - offset - self.begin;
        places.map(|s| [s, self.at(time(s))]).collect()
    }

    fn at(&self, x: f64) -> f64 {
        let terms: f64 = match &self.terms {
            Terms::Periodic(frequency, pairs) => {
                let term = |(at, [a, b]): (usize, &[f64; 2])| {
                    let (sin, cos) = ((at + 1) as f64 * frequency * x).sin_cos();
                    a * cos + b * sin
                };
                pairs.iter().enumerate().map(term).sum()
            }
            Terms::Modulated([height, first, second]) => {
                height * (first * x).sin() * (second * x).sin()
            }
            Terms::Decay([height, time]) => height * (-x / time).exp(),
        };
        self.mean + terms
    }
}
