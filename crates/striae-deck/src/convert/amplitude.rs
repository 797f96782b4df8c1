//! Amplitudes as curves.
//!
//! Abaqus's value is `a(t) v`. That is a curve over the time of the run with the target `v`. Where
//! only some of what a curve drives changes, a curve over the step does the same: it goes from the
//! present value `p` to the target `T = a(end) v` by `p + c (T - p)`, with `c = (a v - p)/(T - p)`.
//! `SMOOTH STEP` is `x^3 (10 - 15 x + 6 x^2)` between two points, here in twenty pieces; formulas
//! are functions of time where a curve over the run can be used, and points else. Source: Abaqus
//! analysis guide, "Amplitude curves".

use super::{Model, has, numbers};
use crate::write::value::{list, number, text};
use striae_meshfile::Keyword;

mod formula;

use formula::Formula;

/// Pieces of a smooth step between two points, and of a velocity between two.
const PIECES: usize = 20;

/// Approach of a condition to its value.
pub(super) struct Approach {
    /// Value at the end of the step.
    pub(super) reached: f64,
    /// Target in the deck.
    pub(super) target: f64,
    /// The name of the curve, `None` for the ramp.
    pub(super) curve: Option<String>,
}

/// Abscissa of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Over {
    /// The step, if that is possible.
    Step,
    /// The run.
    Run,
}

/// A curve of the deck.
#[derive(PartialEq)]
pub(super) enum Curve {
    Step(Vec<[f64; 2]>),
    Run(Vec<[f64; 2]>),
    Function(String),
}

/// Period of a step, and the course of conditions without an amplitude.
#[derive(Clone, Copy)]
pub(super) struct Period {
    pub(super) start: f64,
    pub(super) duration: f64,
    pub(super) at_once: bool,
    /// Line of the step.
    pub(super) line: usize,
}

/// An amplitude over a step.
struct Course {
    /// Points `(s, a)`, `s` rising from 0 to 1.
    points: Vec<[f64; 2]>,
    /// The formula over the time of the run.
    formula: Option<String>,
    /// `true` if it states the value itself and not a factor of one.
    is_absolute: bool,
}

impl Model<'_> {
    /// Approach of a condition from a present value to a value with an amplitude.
    pub(super) fn approach(
        &mut self,
        amplitude: Option<&str>,
        period: Period,
        over: Over,
        [present, value]: [f64; 2],
    ) -> Result<Approach, String> {
        let Some(name) = amplitude else {
            let curve = (period.at_once && present != value).then(|| "constant".to_owned());
            return Ok(Approach {
                reached: value,
                target: value,
                curve,
            });
        };
        let course = self.course(name, period)?;
        let value = if course.is_absolute { 1.0 } else { value };
        let reached = course.points[course.points.len() - 1][1] * value;
        let mut all = course.points.iter();
        if all.all(|[_, a]| a * value == reached) {
            return Ok(Approach {
                reached,
                target: reached,
                curve: (reached != present).then(|| "constant".to_owned()),
            });
        }
        if over == Over::Step && reached != present && course.formula.is_none() {
            let share = |[s, a]: &[f64; 2]| [*s, (a * value - present) / (reached - present)];
            let shares = course.points.iter().map(share).collect();
            let curve = self.curve(name, Curve::Step(shares));
            return Ok(Approach {
                reached,
                target: reached,
                curve,
            });
        }
        let curve = match course.formula {
            Some(formula) => Curve::Function(formula),
            None => {
                let time = |s: f64| period.start + s * period.duration;
                let points = course.points.iter().map(|[s, a]| [time(*s), *a]);
                Curve::Run(points.collect())
            }
        };
        Ok(Approach {
            reached,
            target: value,
            curve: self.curve(name, curve),
        })
    }

    /// Approach of a displacement whose velocity is given.
    pub(super) fn travel(
        &mut self,
        amplitude: Option<&str>,
        period: Period,
        [present, velocity]: [f64; 2],
    ) -> Result<Approach, String> {
        let way = velocity * period.duration;
        let Some(name) = amplitude else {
            let reached = present + way;
            return Ok(Approach {
                reached,
                target: reached,
                curve: None,
            });
        };
        let course = self.course(name, period)?;
        if course.is_absolute {
            return Err(format!(
                "amplitude `{name}` with VALUE other than RELATIVE for a velocity"
            ));
        }
        // The trapezoids are exact at these points, as amplitudes are straight between theirs.
        let (mut places, mut sum) = (vec![[0.0, 0.0]], 0.0);
        for pair in course.points.windows(2) {
            let [[s0, a0], [s1, a1]] = [pair[0], pair[1]];
            let pieces = if a0 == a1 { 1 } else { PIECES };
            for piece in 1..=pieces {
                let [x, y] = [piece - 1, piece].map(|at| at as f64 / pieces as f64);
                let [a, b] = [x, y].map(|x| a0 + (a1 - a0) * x);
                sum += 0.5 * (a + b) * (y - x) * (s1 - s0);
                places.push([s0 + (s1 - s0) * y, sum]);
            }
        }
        if sum == 0.0 {
            return Err(format!(
                "a velocity with amplitude `{name}`, which leads back; state the displacement"
            ));
        }
        if let Some(last) = places.last_mut() {
            last[0] = 1.0;
        }
        let reached = present + way * sum;
        let shares = places.iter().map(|[s, w]| [*s, w / sum]).collect();
        let curve = self.curve(&format!("{name} as velocity"), Curve::Step(shares));
        Ok(Approach {
            reached,
            target: reached,
            curve,
        })
    }

    /// The name of a curve, `None` for the ramp.
    fn curve(&mut self, amplitude: &str, curve: Curve) -> Option<String> {
        if curve == Curve::Step(vec![[0.0, 0.0], [1.0, 1.0]]) {
            return None;
        }
        if let Some((name, _)) = self.curves.iter().find(|(_, known)| *known == curve) {
            return Some(name.clone());
        }
        let names = (1..).map(|count| match count {
            1 if !["ramp", "constant", "smooth"].contains(&amplitude) => amplitude.to_owned(),
            _ => format!("{amplitude}-{count}"),
        });
        let is_free = |name: &String| self.curves.iter().all(|(known, _)| known != name);
        let name = names.into_iter().find(is_free)?;
        self.curves.push((name.clone(), curve));
        Some(name)
    }

    fn course(&mut self, name: &str, period: Period) -> Result<Course, String> {
        let mut known = self.keywords.iter();
        let keyword = known
            .find(|keyword| keyword.name == "AMPLITUDE" && has(keyword, "NAME", name))
            .ok_or_else(|| format!("there is no *AMPLITUDE `{name}`"))?;
        let known = [
            "NAME",
            "DEFINITION",
            "VALUE",
            "TIME",
            "BEGIN",
            "FIXED INTERVAL",
        ];
        if !self.used.contains(&keyword.line) {
            self.list_parameters(keyword, &known);
        }
        let kind = keyword.parameter("DEFINITION").unwrap_or("TABULAR");
        let kind = kind.to_uppercase();
        let is_total = has(keyword, "TIME", "TOTAL TIME");
        let offset = if is_total { 0.0 } else { period.start };
        let mut all = Vec::new();
        for row in &keyword.rows {
            let words = match row.words.iter().rposition(|word| !word.is_empty()) {
                Some(last) => &row.words[..=last],
                None => &[],
            };
            all.extend(numbers(words).ok_or_else(|| format!("amplitude `{name}`: no numbers"))?);
        }
        let is_absolute = keyword
            .parameter("VALUE")
            .is_some_and(|value| !value.eq_ignore_ascii_case("RELATIVE"));
        let end = (period.start + period.duration) * (1.0 + 1e-9);
        let mut goes_on = true;
        let course = match kind.as_str() {
            "TABULAR" | "SMOOTH STEP" => {
                let pairs: Vec<_> = all.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
                goes_on = pairs.last().is_some_and(|[time, _]| *time > end);
                let points = sampled(pairs, kind == "SMOOTH STEP", offset, period);
                points.map(|points| (points, None))
            }
            "EQUALLY SPACED" => {
                let number = |key| keyword.parameter(key).and_then(striae_meshfile::finite);
                let interval = number("FIXED INTERVAL");
                let interval =
                    interval.ok_or_else(|| format!("amplitude `{name}` without FIXED INTERVAL"))?;
                let begin = number("BEGIN").unwrap_or(0.0);
                let place = |(at, a): (usize, &f64)| [begin + at as f64 * interval, *a];
                let pairs: Vec<_> = all.iter().enumerate().map(place).collect();
                goes_on = pairs.last().is_some_and(|[time, _]| *time > end);
                sampled(pairs, false, offset, period).map(|points| (points, None))
            }
            _ => {
                let formula = Formula::read(&kind, &all).map_err(|what| match what {
                    formula::Fault::Kind => format!("amplitude `{name}` with DEFINITION={kind}"),
                    formula::Fault::Numbers => format!("amplitude `{name}`: too few numbers"),
                })?;
                if offset + formula.begin > period.start {
                    return Err(format!(
                        "amplitude `{name}` that begins within a step; divide the step there"
                    ));
                }
                let points = formula.points(offset, period);
                Ok((points, Some(formula.text(offset))))
            }
        };
        let (points, formula) = course.map_err(|what| format!("amplitude `{name}` {what}"))?;
        self.used.insert(keyword.line);
        if is_total && goes_on && self.is_left_after(name, period.line) {
            let what = format!(
                "*AMPLITUDE `{name}` beyond the end of the step that refers to it: state its conditions in later steps, too"
            );
            self.list(keyword.line, what);
        }
        Ok(Course {
            points,
            formula,
            is_absolute,
        })
    }

    /// Returns whether there are steps after one, and none of them refers to an amplitude.
    fn is_left_after(&self, name: &str, step: usize) -> bool {
        let later = || self.keywords.iter().filter(|keyword| keyword.line > step);
        let mut later_steps = later()
            .skip_while(|keyword| keyword.name != "STEP")
            .peekable();
        later_steps.peek().is_some() && !later_steps.any(|keyword| has(keyword, "AMPLITUDE", name))
    }

    /// Lists amplitudes that nothing refers to.
    pub(super) fn list_idle_amplitudes(&mut self) {
        let keywords: &[Keyword<'_>] = self.keywords;
        let amplitudes = keywords
            .iter()
            .filter(|keyword| keyword.name == "AMPLITUDE");
        for keyword in amplitudes {
            if !self.used.contains(&keyword.line) {
                let name = keyword.parameter("NAME").unwrap_or_default();
                let what = format!("*AMPLITUDE `{name}`, which nothing here follows");
                self.list(keyword.line, what);
            }
        }
    }
}

/// Points `(s, a)` of a table over a step.
fn sampled(
    points: Vec<[f64; 2]>,
    is_smooth: bool,
    offset: f64,
    period: Period,
) -> Result<Vec<[f64; 2]>, &'static str> {
    let rises = points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    if points.is_empty() || !rises {
        return Err("with times that do not rise");
    }
    let at = |s: f64| {
        let time = period.start + s * period.duration - offset;
        value(&points, is_smooth, time)
    };
    let mut places = vec![0.0, 1.0];
    for pair in points.windows(2) {
        let pieces = if is_smooth && pair[0][1] != pair[1][1] {
            PIECES
        } else {
            1
        };
        for piece in 0..=pieces {
            let time = pair[0][0] + (pair[1][0] - pair[0][0]) * piece as f64 / pieces as f64;
            places.push((time + offset - period.start) / period.duration);
        }
    }
    places.retain(|s| (0.0..=1.0).contains(s));
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    if let Some(last) = places.last_mut() {
        *last = 1.0;
    }
    Ok(places.into_iter().map(|s| [s, at(s)]).collect())
}

/// The value at a time; constant before the first point and after the last.
fn value(points: &[[f64; 2]], is_smooth: bool, time: f64) -> f64 {
    let after = points.partition_point(|[t, _]| *t <= time);
    let (Some(before), Some(next)) = (after.checked_sub(1), points.get(after)) else {
        return points[after.min(points.len() - 1)][1];
    };
    let [t, a] = points[before];
    let x = (time - t) / (next[0] - t);
    let share = match is_smooth {
        true => x * x * x * (10.0 - 15.0 * x + 6.0 * x * x),
        false => x,
    };
    a + share * (next[1] - a)
}

/// The tables of curves.
pub(super) fn tables(curves: &[(String, Curve)]) -> String {
    let points = |points: &[[f64; 2]]| list(points.iter().map(|pair| list(pair.map(number))));
    let table = |(name, curve): &(String, Curve)| {
        let course = match curve {
            Curve::Step(of) => format!("points = {}", points(of)),
            Curve::Run(of) => format!("points = {}\ntime = \"run\"", points(of)),
            Curve::Function(of) => format!("function = {}\ntime = \"run\"", text(of)),
        };
        format!("\n[[curve]]\nname = {}\n{course}\n", text(name))
    };
    curves.iter().map(table).collect()
}
