//! Axes on the page: grid, ticks, labels and colour bar, and the room they need.

use super::axis::Mapping;
use super::color::{FRAME, GRID, Rgb, viridis};
use super::description::Axis;
use super::font::{self, DIGIT_HEIGHT};
use super::panel::bar_mapping;
use super::shape::{Anchor, Direction, Place, Rectangle, Shape, Text};
use super::ticks::Ticks;

pub(super) const LABEL: f64 = 8.5;
pub(super) const TICK_LABEL: f64 = 8.0;
const THIN: f64 = 0.45;
const TICK: f64 = 2.6;
pub(super) const GAP: f64 = 2.5;
const BAR_GAP: f64 = 6.0;
const BAR: f64 = 7.0;
const BAR_STEPS: usize = 96;

/// Room beside the frame on the four sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Margins {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

/// Spacing of ticks: along a horizontal axis, along a vertical one.
pub(super) const SPACING: [f64; 2] = [26.0, 24.0];

/// Ticks of a horizontal axis whose labels do not touch.
pub(super) fn horizontal_ticks(mapping: &Mapping) -> Ticks {
    let mut spacing = SPACING[0];
    loop {
        let ticks = mapping.ticks(spacing);
        let mut end = f64::NEG_INFINITY;
        let mut free = true;
        let mut places: Vec<(f64, f64)> = ticks
            .major
            .iter()
            .filter_map(|(n, words)| Some((mapping.place(*n)?, font::width(words, TICK_LABEL))))
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (place, wide) in places {
            free &= place - wide / 2.0 > end + 5.0;
            end = place + wide / 2.0;
        }
        if free || spacing > 300.0 {
            return ticks;
        }
        spacing *= 1.25;
    }
}

/// Room needed left of the frame for ticks and label.
pub(super) fn left_room(ticks: &Ticks) -> f64 {
    TICK + GAP + widest(ticks) + GAP + LABEL + 1.0
}

/// Room needed below the frame for ticks and label.
pub(super) const BOTTOM_ROOM: f64 = TICK + GAP + TICK_LABEL + GAP + LABEL + 2.0;

/// Room needed right of the frame for a colour bar.
pub(super) fn bar_room(ticks: &Ticks) -> f64 {
    BAR_GAP + BAR + TICK + GAP + widest(ticks) + 2.0 * GAP + LABEL + 1.0
}

fn widest(ticks: &Ticks) -> f64 {
    let widths = ticks
        .major
        .iter()
        .map(|(_, words)| font::width(words, TICK_LABEL));
    widths.fold(0.0, f64::max)
}

/// Grid of perpendicular axes.
pub(super) fn grid(frame: Rectangle, x: (&Mapping, &Ticks), y: (&Mapping, &Ticks)) -> Vec<Shape> {
    let upright = x.1.major.iter().filter_map(|(n, _)| x.0.place(*n));
    let level = y.1.major.iter().filter_map(|(n, _)| y.0.place(*n));
    upright
        .map(|x| [[x, frame.top], [x, frame.bottom()]])
        .chain(level.map(|y| [[frame.left, y], [frame.right(), y]]))
        .map(|ends| stroke(ends.into(), GRID))
        .collect()
}

/// Outline, ticks and labels of perpendicular axes.
pub(super) fn axes(
    frame: Rectangle,
    x: (&Axis, &Mapping, &Ticks),
    y: (&Axis, &Mapping, &Ticks),
) -> Vec<Shape> {
    let mut shapes = vec![outline(frame)];
    let (bottom, left) = (frame.bottom(), frame.left);
    for (number, words) in &x.2.major {
        let Some(at) = x.1.place(*number) else {
            continue;
        };
        shapes.push(stroke(vec![[at, bottom], [at, bottom + TICK]], FRAME));
        let base = bottom + TICK + GAP + DIGIT_HEIGHT * TICK_LABEL;
        shapes.push(text(words, [at, base], TICK_LABEL, Anchor::Middle));
    }
    for (number, words) in &y.2.major {
        let Some(at) = y.1.place(*number) else {
            continue;
        };
        shapes.push(stroke(vec![[left, at], [left - TICK, at]], FRAME));
        let base = at + DIGIT_HEIGHT * TICK_LABEL / 2.0;
        shapes.push(text(
            words,
            [left - TICK - GAP, base],
            TICK_LABEL,
            Anchor::End,
        ));
    }
    let minors = |ticks: &Ticks, mapping: &Mapping| -> Vec<f64> {
        ticks
            .minor
            .iter()
            .filter_map(|n| mapping.place(*n))
            .collect()
    };
    for at in minors(x.2, x.1) {
        shapes.push(stroke(vec![[at, bottom], [at, bottom + TICK / 2.0]], FRAME));
    }
    for at in minors(y.2, y.1) {
        shapes.push(stroke(vec![[left, at], [left - TICK / 2.0, at]], FRAME));
    }
    let base = bottom + BOTTOM_ROOM - 2.5;
    let middle = [
        frame.left + frame.width / 2.0,
        frame.top + frame.height / 2.0,
    ];
    shapes.push(text(
        &x.0.text(x.2.exponent),
        [middle[0], base],
        LABEL,
        Anchor::Middle,
    ));
    let base = left - TICK - GAP - widest(y.2) - GAP - 1.5;
    shapes.push(upwards(&y.0.text(y.2.exponent), [base, middle[1]]));
    shapes
}

/// Colour bar to the right of a frame.
pub(super) fn bar(frame: Rectangle, axis: &Axis, limits: (f64, f64)) -> Vec<Shape> {
    let mapping = bar_mapping(limits, frame);
    let ticks = mapping.ticks(SPACING[1]);
    let left = frame.right() + BAR_GAP;
    let strip = Rectangle {
        left,
        width: BAR,
        ..frame
    };
    let step = frame.height / BAR_STEPS as f64;
    let mut shapes: Vec<Shape> = (0..BAR_STEPS)
        .map(|index| {
            let high = frame.bottom() - (index + 1) as f64 * step;
            let low = frame.bottom() - index as f64 * step;
            Shape::Fill {
                places: vec![
                    [left, low],
                    [strip.right(), low],
                    [strip.right(), high],
                    [left, high],
                ],
                color: viridis((index as f64 + 0.5) / BAR_STEPS as f64),
            }
        })
        .collect();
    shapes.push(outline(strip));
    let right = strip.right();
    for (number, words) in &ticks.major {
        let Some(at) = mapping.place(*number) else {
            continue;
        };
        shapes.push(stroke(vec![[right, at], [right + TICK, at]], FRAME));
        let base = at + DIGIT_HEIGHT * TICK_LABEL / 2.0;
        shapes.push(text(
            words,
            [right + TICK + GAP, base],
            TICK_LABEL,
            Anchor::Start,
        ));
    }
    let base = right + TICK + GAP + widest(&ticks) + 2.0 * GAP + DIGIT_HEIGHT * LABEL;
    let middle = frame.top + frame.height / 2.0;
    shapes.push(upwards(&axis.text(ticks.exponent), [base, middle]));
    shapes
}

/// A horizontal text.
pub(super) fn text(words: &str, place: Place, size: f64, anchor: Anchor) -> Shape {
    Shape::Text(Text {
        words: words.to_owned(),
        place,
        size,
        anchor,
        direction: Direction::Right,
    })
}

fn upwards(words: &str, place: Place) -> Shape {
    Shape::Text(Text {
        words: words.to_owned(),
        place,
        size: LABEL,
        anchor: Anchor::Middle,
        direction: Direction::Up,
    })
}

fn outline(frame: Rectangle) -> Shape {
    let (left, top, right, bottom) = (frame.left, frame.top, frame.right(), frame.bottom());
    let corners = vec![
        [left, top],
        [right, top],
        [right, bottom],
        [left, bottom],
        [left, top],
    ];
    Shape::Stroke {
        places: corners,
        width: 1.3 * THIN,
        color: FRAME,
    }
}

/// A thin line.
pub(super) fn stroke(places: Vec<Place>, color: Rgb) -> Shape {
    Shape::Stroke {
        places,
        width: THIN,
        color,
    }
}
