//! Amplitudes as curves.
//!
//! Abaqus's value is `a(t) v`; a deck's goes from the present value `p` to the target
//! `T = a(end) v` by `p + c (T - p)`, so that `c = (a v - p)/(T - p)`. `SMOOTH STEP` is
//! `x^3 (10 - 15 x + 6 x^2)` between two points, here in twenty pieces. Source: Abaqus analysis
//! guide, "Amplitude curves".

use super::{Model, has, numbers};
use crate::write::value::{list, number, text};

/// Pieces of a smooth step between two points.
const PIECES: usize = 20;

/// Approach of a condition to its value.
pub(super) struct Approach {
    pub(super) target: f64,
    /// The name of the curve, `None` for the ramp.
    pub(super) curve: Option<String>,
}

/// Period of a step, and the course of conditions without an amplitude.
#[derive(Clone, Copy)]
pub(super) struct Period {
    pub(super) start: f64,
    pub(super) duration: f64,
    pub(super) at_once: bool,
}

impl Model<'_> {
    /// Approach of a condition from a present value to a value with an amplitude.
    pub(super) fn approach(
        &mut self,
        amplitude: Option<&str>,
        period: Period,
        [present, value]: [f64; 2],
    ) -> Result<Approach, String> {
        let Some(name) = amplitude else {
            let curve = (period.at_once && present != value).then(|| "constant".to_owned());
            let target = value;
            return Ok(Approach { target, curve });
        };
        let points = self.amplitude(name, period)?;
        let target = points[points.len() - 1][1] * value;
        let values = points.iter().map(|[s, a]| [*s, a * value]);
        let values: Vec<[f64; 2]> = values.collect();
        if values.iter().all(|[_, v]| *v == target) && target == present {
            return Ok(Approach {
                target,
                curve: None,
            });
        }
        if target == present {
            return Err(format!(
                "amplitude `{name}` ends at the value it begins with; divide the step"
            ));
        }
        let shares = values
            .iter()
            .map(|[s, v]| [*s, (v - present) / (target - present)]);
        let curve = self.curve(name, shares.collect());
        Ok(Approach { target, curve })
    }

    /// The name of the curve with these points, `None` for the ramp.
    fn curve(&mut self, amplitude: &str, points: Vec<[f64; 2]>) -> Option<String> {
        if points == [[0.0, 0.0], [1.0, 1.0]] {
            return None;
        }
        if let Some((name, _)) = self.curves.iter().find(|(_, known)| *known == points) {
            return Some(name.clone());
        }
        let names = (1..).map(|count| match count {
            1 if !["ramp", "constant", "smooth"].contains(&amplitude) => amplitude.to_owned(),
            _ => format!("{amplitude}-{count}"),
        });
        let is_free = |name: &String| self.curves.iter().all(|(known, _)| known != name);
        let name = names.into_iter().find(is_free)?;
        self.curves.push((name.clone(), points));
        Some(name)
    }

    /// Points `(s, a)` of an amplitude over a step, `s` rising from 0 to 1.
    fn amplitude(&mut self, name: &str, period: Period) -> Result<Vec<[f64; 2]>, String> {
        let mut known = self.keywords.iter();
        let keyword = known
            .find(|keyword| keyword.name == "AMPLITUDE" && has(keyword, "NAME", name))
            .ok_or_else(|| format!("there is no *AMPLITUDE `{name}`"))?;
        let kind = keyword
            .parameter("DEFINITION")
            .unwrap_or("TABULAR")
            .to_uppercase();
        if !["TABULAR", "SMOOTH STEP"].contains(&kind.as_str()) {
            return Err(format!("amplitude `{name}` with DEFINITION={kind}"));
        }
        if keyword
            .parameter("VALUE")
            .is_some_and(|value| !value.eq_ignore_ascii_case("RELATIVE"))
        {
            return Err(format!("amplitude `{name}` with VALUE other than RELATIVE"));
        }
        let mut all = Vec::new();
        for row in &keyword.rows {
            let row =
                numbers(&row.words).ok_or_else(|| format!("amplitude `{name}`: no numbers"))?;
            all.extend(row);
        }
        let points: Vec<[f64; 2]> = all.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
        let rises = points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        if points.is_empty() || !rises {
            return Err(format!("amplitude `{name}` with times that do not rise"));
        }
        self.used.insert(keyword.line);
        let offset = match has(keyword, "TIME", "TOTAL TIME") {
            true => period.start,
            false => 0.0,
        };
        let is_smooth = kind == "SMOOTH STEP";
        let at = |s: f64| value(&points, is_smooth, offset + s * period.duration);
        let mut places = vec![0.0, 1.0];
        for pair in points.windows(2) {
            let pieces = if is_smooth && pair[0][1] != pair[1][1] {
                PIECES
            } else {
                1
            };
            for piece in 0..=pieces {
                let time = pair[0][0] + (pair[1][0] - pair[0][0]) * piece as f64 / pieces as f64;
                places.push((time - offset) / period.duration);
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
pub(super) fn tables(curves: &[(String, Vec<[f64; 2]>)]) -> String {
    let table = |(name, points): &(String, Vec<[f64; 2]>)| {
        let points = points.iter().map(|pair| list(pair.map(number)));
        format!(
            "\n[[curve]]\nname = {}\npoints = {}\n",
            text(name),
            list(points)
        )
    };
    curves.iter().map(table).collect()
}
