//! The legend: samples and names in rows above the frame.

use super::arrows::{ArrowScale, arrow, group};
use super::color::Rgb;
use super::description::{Content, Line, Marker, Panel};
use super::fit::power_law;
use super::font::{self, DIGIT_HEIGHT};
use super::panel::{curve_shapes, marker_shapes};
use super::shape::{Anchor, Direction, Place, Shape, Text};
use super::ticks::{round_words, signed};

pub(super) const ROW: f64 = 11.0;
const SIZE: f64 = 8.0;
const SAMPLE: f64 = 17.0;
const SPACE: f64 = 4.0;
const BETWEEN: f64 = 10.0;

/// A name with what stands before it.
pub(super) struct Entry {
    words: String,
    sample: Sample,
    color: Rgb,
}

enum Sample {
    Curve(Line, Marker),
    Arrow(f64),
    /// Room alone, before words that continue the line above.
    Blank(f64),
}

impl Sample {
    fn width(&self) -> f64 {
        match self {
            Self::Curve(Line::None, _) => 7.0,
            Self::Curve(..) => SAMPLE,
            Self::Arrow(length) => length.max(4.0),
            Self::Blank(width) => *width,
        }
    }
}

/// The entries of a panel.
pub(super) fn entries(panel: &Panel, scales: &[ArrowScale]) -> Vec<Entry> {
    let named = panel.series.iter().zip(panel.colors());
    named
        .filter_map(|(series, color)| {
            let (words, sample) = match &series.content {
                Content::Facets { .. } => return None,
                Content::Arrows { unit, .. } => {
                    let scale = scales
                        .iter()
                        .find(|scale| scale.group == group(series, unit))?;
                    let key = format!("{} {unit}", round_words(scale.key));
                    let words = format!("{} ({})", series.name, key.trim());
                    (
                        words.trim().to_owned(),
                        Sample::Arrow(scale.key * scale.length),
                    )
                }
                _ if series.name.is_empty() => return None,
                Content::Curve { line, marker, .. } => {
                    (series.name.clone(), Sample::Curve(*line, *marker))
                }
                Content::PowerLaw { points, marker } => {
                    let slope = power_law(points).map_or(String::new(), |law| {
                        format!(" (slope {})", signed(format!("{:.2}", law.exponent)))
                    });
                    (
                        series.name.clone() + &slope,
                        Sample::Curve(Line::Dashed, *marker),
                    )
                }
            };
            Some(Entry {
                words,
                sample,
                color,
            })
        })
        .collect()
}

/// Entries in rows no wider than `width`, as far as single words allow.
pub(super) fn rows(entries: Vec<Entry>, width: f64) -> Vec<Vec<Entry>> {
    let mut rows: Vec<Vec<Entry>> = Vec::new();
    let mut end = 0.0;
    for entry in entries.into_iter().flat_map(|entry| entry.wrapped(width)) {
        let wide = entry.width();
        match rows.last_mut() {
            Some(row) if end + BETWEEN + wide <= width => {
                end += BETWEEN + wide;
                row.push(entry);
            }
            _ => {
                end = wide;
                rows.push(vec![entry]);
            }
        }
    }
    rows
}

/// Width of a row.
pub(super) fn row_width(row: &[Entry]) -> f64 {
    row.iter().map(|entry| entry.width() + BETWEEN).sum::<f64>() - BETWEEN
}

/// Draws rows from their left upper corner on.
pub(super) fn shapes(rows: &[Vec<Entry>], corner: Place) -> Vec<Shape> {
    let mut shapes = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let middle = corner[1] + (index as f64 + 0.5) * ROW;
        let mut x = corner[0];
        for entry in row {
            shapes.extend(entry.shapes([x, middle]));
            x += entry.width() + BETWEEN;
        }
    }
    shapes
}

impl Entry {
    fn width(&self) -> f64 {
        self.sample.width() + SPACE + font::width(&self.words, SIZE)
    }

    /// The entry in lines no wider than `width`.
    fn wrapped(mut self, width: f64) -> Vec<Self> {
        let mut words: Vec<&str> = self.words.split(' ').collect();
        let room = width - self.sample.width() - SPACE;
        let mut rest = Vec::new();
        while words.len() > 1 && font::width(&words.join(" "), SIZE) > room {
            rest.extend(words.pop());
        }
        rest.reverse();
        let (first, rest) = (words.join(" "), rest.join(" "));
        let next = Self {
            words: rest,
            sample: Sample::Blank(self.sample.width()),
            color: self.color,
        };
        self.words = first;
        let mut lines = vec![self];
        if !next.words.is_empty() {
            lines.extend(next.wrapped(width));
        }
        lines
    }

    fn shapes(&self, [x, middle]: Place) -> Vec<Shape> {
        let wide = self.sample.width();
        let mut shapes = match self.sample {
            Sample::Blank(_) => Vec::new(),
            Sample::Arrow(length) => arrow([x, middle], [length, 0.0], self.color),
            Sample::Curve(line, marker) => {
                let mut shapes = curve_shapes(&[[x, middle], [x + wide, middle]], line, self.color);
                shapes.extend(marker_shapes([x + wide / 2.0, middle], marker, self.color));
                shapes
            }
        };
        shapes.push(Shape::Text(Text {
            words: self.words.clone(),
            place: [x + wide + SPACE, middle + SIZE * DIGIT_HEIGHT / 2.0],
            size: SIZE,
            anchor: Anchor::Start,
            direction: Direction::Right,
        }));
        shapes
    }
}
