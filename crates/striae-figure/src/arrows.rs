//! Arrows: one length for all vectors of a unit, and the key that explains it.

use super::color::Rgb;
use super::description::{Content, Panel, Series};
use super::shape::{Place, Shape};
use super::ticks::round_below;

/// Length of the longest arrow over the mean distance of the tails.
const REACH: f64 = 1.25;

/// Least and largest length of the longest arrow on the page.
const LENGTHS: std::ops::Range<f64> = 8.0..36.0;
const WIDTH: f64 = 0.7;

/// The lengths of arrows of one group.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ArrowScale {
    /// See [`group`].
    pub group: String,
    /// Points on the page for one unit.
    pub length: f64,
    /// A round number for the key.
    pub key: f64,
}

/// Group of arrows with a common scale: that of the unit or, without one, of the series.
pub(super) fn group<'a>(series: &'a Series, unit: &'a str) -> &'a str {
    if unit.is_empty() { &series.name } else { unit }
}

/// The scale of every group in a panel where a unit of the axes is `unit_length` long.
pub(super) fn scales(panel: &Panel, unit_length: f64) -> Vec<ArrowScale> {
    let mut groups: Vec<(&str, f64, f64)> = Vec::new();
    for series in &panel.series {
        if let Content::Arrows {
            origins,
            vectors,
            unit,
        } = &series.content
        {
            let (longest, reach) = (longest(vectors), reach(origins));
            let name = group(series, unit);
            match groups.iter_mut().find(|group| group.0 == name) {
                Some(group) => *group = (name, group.1.max(longest), group.2.min(reach)),
                None => groups.push((name, longest, reach)),
            }
        }
    }
    let scale = |(group, longest, reach): (&str, f64, f64)| {
        let length = (reach * unit_length).clamp(LENGTHS.start, LENGTHS.end);
        let moving = longest > 0.0;
        ArrowScale {
            group: group.to_owned(),
            length: if moving { length / longest } else { 0.0 },
            key: if moving { round_below(longest) } else { 0.0 },
        }
    };
    groups.into_iter().map(scale).collect()
}

/// Tails, and about where the heads will be, in units of the axes.
pub(super) fn ends(origins: &[[f64; 2]], vectors: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let (longest, reach) = (longest(vectors), reach(origins));
    let head = |(origin, vector): (&[f64; 2], &[f64; 2])| {
        [0, 1].map(|axis| origin[axis] + vector[axis] / longest * reach)
    };
    let heads = origins.iter().zip(vectors).map(head);
    origins.iter().copied().chain(heads).collect()
}

fn longest(vectors: &[[f64; 2]]) -> f64 {
    let norms = vectors
        .iter()
        .map(|v| v[0].hypot(v[1]))
        .filter(|norm| norm.is_finite());
    norms.fold(0.0, f64::max)
}

/// Length of the longest arrow, in units of the axes.
fn reach(origins: &[[f64; 2]]) -> f64 {
    let span = |axis: usize| {
        let tails = || {
            origins
                .iter()
                .map(|origin| origin[axis])
                .filter(|c| c.is_finite())
        };
        tails().fold(f64::NEG_INFINITY, f64::max) - tails().fold(f64::INFINITY, f64::min)
    };
    let [x, y] = [span(0), span(1)];
    let count = origins.len().max(1) as f64;
    let area_each = (x * y / count).sqrt();
    REACH * area_each.max(x.max(y) / count)
}

/// An arrow from `tail` along `reach`, both on the page.
pub(super) fn arrow(tail: Place, reach: Place, color: Rgb) -> Vec<Shape> {
    let length = reach[0].hypot(reach[1]);
    if length < 0.3 {
        let r = 0.5;
        let places = [[-r, -r], [r, -r], [r, r], [-r, r]].map(|d| [tail[0] + d[0], tail[1] + d[1]]);
        return vec![Shape::Fill {
            places: places.into(),
            color,
        }];
    }
    let along = reach.map(|c| c / length);
    let head = (0.42 * length).min(4.2);
    let at = |s: f64, t: f64| {
        [
            tail[0] + s * along[0] - t * along[1],
            tail[1] + s * along[1] + t * along[0],
        ]
    };
    let neck = length - head;
    vec![
        Shape::Stroke {
            places: vec![tail, at(neck + 0.3 * head, 0.0)],
            width: WIDTH,
            color,
        },
        Shape::Fill {
            places: vec![
                at(length, 0.0),
                at(neck, 0.36 * head),
                at(neck, -0.36 * head),
            ],
            color,
        },
    ]
}
