//! Arrows: one length for all vectors of a unit, and the key that explains it.

use super::description::{Content, Panel};
use super::shape::{Place, Shape};
use super::color::Rgb;
use super::ticks::round_below;

/// Length of the longest arrow over the mean distance of their tails.
const REACH: f64 = 1.6;
const WIDTH: f64 = 0.7;

/// The lengths of arrows with one unit.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ArrowScale {
    pub unit: String,
    /// Points on the page for one unit.
    pub length: f64,
    /// A round number for the key.
    pub key: f64,
}

/// The scale of every unit in a panel, on a page with `area` to draw on.
pub(super) fn scales(panel: &Panel, area: f64) -> Vec<ArrowScale> {
    let mut largest: Vec<(String, f64, usize)> = Vec::new();
    for series in &panel.series {
        if let Content::Arrows { vectors, unit, .. } = &series.content {
            let norms = vectors.iter().map(|v| v[0].hypot(v[1])).filter(|n| n.is_finite());
            let longest = norms.fold(0.0, f64::max);
            match largest.iter_mut().find(|entry| entry.0 == *unit) {
                Some(entry) => *entry = (unit.clone(), entry.1.max(longest), entry.2.max(vectors.len())),
                None => largest.push((unit.clone(), longest, vectors.len())),
            }
        }
    }
    let scale = |(unit, longest, count): (String, f64, usize)| {
        let spacing = (area / count.max(1) as f64).sqrt();
        let reach = (REACH * spacing).clamp(8.0, 42.0);
        ArrowScale {
            unit,
            length: if longest > 0.0 { reach / longest } else { 0.0 },
            key: if longest > 0.0 { round_below(longest) } else { 0.0 },
        }
    };
    largest.into_iter().map(scale).collect()
}

/// An arrow from `tail` along `reach`, both on the page.
pub(super) fn arrow(tail: Place, reach: Place, color: Rgb) -> Vec<Shape> {
    let length = reach[0].hypot(reach[1]);
    if length < 0.3 {
        let r = 0.5;
        let places = [[-r, -r], [r, -r], [r, r], [-r, r]].map(|d| [tail[0] + d[0], tail[1] + d[1]]);
        return vec![Shape::Fill { places: places.into(), color }];
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
            places: vec![at(length, 0.0), at(neck, 0.36 * head), at(neck, -0.36 * head)],
            color,
        },
    ]
}
