//! Polar axes on the page: circles, rays and their labels.

use std::f64::consts::FRAC_PI_6;

use super::axis::Mapping;
use super::color::{FRAME, GRID, WHITE};
use super::description::Axis;
use super::font::{self, DIGIT_HEIGHT};
use super::frame::{GAP, LABEL, TICK_LABEL, stroke, text};
use super::shape::{Anchor, Place, Shape};
use super::ticks::Ticks;

/// Circles and rays of a polar panel.
pub(super) fn grid(centre: Place, radius: &Mapping, ticks: &Ticks) -> Vec<Shape> {
    let full = radius.to - radius.from;
    let rays = (0..12).map(|i| around(centre, full, f64::from(i) * FRAC_PI_6));
    let mut shapes: Vec<Shape> = rays.map(|end| stroke(vec![centre, end], GRID)).collect();
    for (number, _) in &ticks.major {
        if let Some(at) = radius.place(*number) {
            shapes.push(stroke(circle(centre, at - centre[0]), GRID));
        }
    }
    shapes
}

/// Numbers of the circles, to be drawn over `curves`: along the ray on which these stay farthest
/// from them, and on patches where none is free.
pub(super) fn numbers(
    centre: Place,
    radius: &Mapping,
    ticks: &Ticks,
    curves: &[Shape],
) -> Vec<Shape> {
    let angle = free_angle(centre, radius, ticks, curves);
    radius_labels(centre, radius, ticks, angle)
}

/// The angle between two rays at which the numbers of the circles are farthest from all
/// lines in the mean; the one next to the top where nothing is near.
fn free_angle(centre: Place, radius: &Mapping, ticks: &Ticks, curves: &[Shape]) -> f64 {
    let lines: Vec<Place> = curves
        .iter()
        .filter_map(|shape| match shape {
            Shape::Stroke { places, .. } => Some(places),
            Shape::Fill { .. } | Shape::Text(_) => None,
        })
        .flatten()
        .copied()
        .collect();
    let distance = |angle: f64| {
        let labels = ticks.major.iter().filter_map(|(number, words)| {
            let at = radius.place(*number).filter(|_| *number > 0.0)?;
            let place = around(centre, at - centre[0], angle);
            Some((place, font::width(words, TICK_LABEL) / 2.0))
        });
        let high = DIGIT_HEIGHT * TICK_LABEL / 2.0;
        let apart = labels.map(|(label, half)| {
            let beyond = |place: &Place| {
                let [x, y] = [0, 1].map(|axis| (place[axis] - label[axis]).abs());
                (x - half).max(0.0).hypot((y - high).max(0.0))
            };
            // What is farther than this is far enough.
            lines.iter().map(beyond).fold(TICK_LABEL, f64::min)
        });
        apart.sum::<f64>()
    };
    let angles = (0..12).map(|turn| (2.5 + f64::from(turn)) * FRAC_PI_6);
    let farthest = angles.reduce(|best, angle| match distance(angle) > distance(best) {
        true => angle,
        false => best,
    });
    farthest.unwrap_or(2.5 * FRAC_PI_6)
}

/// Numbers of the circles, on patches that interrupt what is below.
fn radius_labels(centre: Place, radius: &Mapping, ticks: &Ticks, angle: f64) -> Vec<Shape> {
    let full = radius.to - radius.from;
    let lower = DIGIT_HEIGHT * TICK_LABEL / 2.0;
    let mut shapes = Vec::new();
    for (number, words) in ticks.major.iter().filter(|(n, _)| *n > 0.0) {
        let Some(at) = radius.place(*number) else {
            continue;
        };
        let place = around(centre, at - centre[0], angle);
        let half = font::width(words, TICK_LABEL) / 2.0 + 1.0;
        let high = lower + 1.0;
        let corners = [[-half, -high], [half, -high], [half, high], [-half, high]];
        if at - centre[0] + half < full {
            shapes.push(Shape::Fill {
                places: corners.map(|d| [place[0] + d[0], place[1] + d[1]]).into(),
                color: WHITE,
            });
            shapes.push(text(
                words,
                [place[0], place[1] + lower],
                TICK_LABEL,
                Anchor::Middle,
            ));
        }
    }
    shapes
}

/// Outline and labels of a polar panel.
pub(super) fn axes(centre: Place, axis: &Axis, radius: &Mapping, ticks: &Ticks) -> Vec<Shape> {
    let full = radius.to - radius.from;
    let lower = DIGIT_HEIGHT * TICK_LABEL / 2.0;
    let mut shapes = vec![stroke(circle(centre, full), FRAME)];
    for step in 0..12 {
        let angle = f64::from(step) * FRAC_PI_6;
        let words = format!("{}°", 30 * step);
        let wide = font::width(&words, TICK_LABEL);
        let room = 4.0 + (wide / 2.0 * angle.cos().abs()).max(lower * angle.sin().abs());
        let at = around(centre, full + room, angle);
        shapes.push(text(
            &words,
            [at[0], at[1] + lower],
            TICK_LABEL,
            Anchor::Middle,
        ));
    }
    let base = centre[1] + full + ROOM[1] + LABEL + GAP;
    shapes.push(text(
        &axis.text(ticks.exponent),
        [centre[0], base],
        LABEL,
        Anchor::Middle,
    ));
    shapes
}

/// Spacing of the circles of a polar panel.
pub(super) const SPACING: f64 = 17.0;

/// Room beside and above a circle for the labels of its angles.
pub(super) const ROOM: [f64; 2] = [24.0, 13.0];

fn circle(centre: Place, radius: f64) -> Vec<Place> {
    let angles = (0..=120).map(|i| f64::from(i) * std::f64::consts::TAU / 120.0);
    angles.map(|angle| around(centre, radius, angle)).collect()
}

fn around(centre: Place, radius: f64, angle: f64) -> Place {
    [
        centre[0] + radius * angle.cos(),
        centre[1] - radius * angle.sin(),
    ]
}
