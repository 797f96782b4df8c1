//! The shapes a figure is made of, in points (1/72 inch), y downwards.

use super::color::Rgb;

/// A place on the page.
pub(super) type Place = [f64; 2];

/// Shape to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    /// An open line.
    Stroke {
        places: Vec<Place>,
        width: f64,
        color: Rgb,
    },
    /// A filled convex polygon.
    Fill { places: Vec<Place>, color: Rgb },
    /// A line of text.
    Text(Text),
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Text {
    pub words: String,
    /// On the base line, at the start, middle or end of the words.
    pub place: Place,
    pub size: f64,
    pub anchor: Anchor,
    pub direction: Direction,
}

/// Part of a text that is anchored at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Direction of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    Right,
    Up,
}

/// A rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rectangle {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
}

impl Rectangle {
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Returns whether a place is inside or closer to the shape than `margin`.
    pub fn contains(&self, place: Place, margin: f64) -> bool {
        (self.left - margin..=self.right() + margin).contains(&place[0])
            && (self.top - margin..=self.bottom() + margin).contains(&place[1])
    }

    /// The part of a segment inside (Liang and Barsky).
    fn clip_segment(&self, from: Place, to: Place) -> Option<(Place, Place)> {
        let step = [to[0] - from[0], to[1] - from[1]];
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        let low = [self.left, self.top];
        let high = [self.right(), self.bottom()];
        for axis in 0..2 {
            if step[axis] == 0.0 {
                if from[axis] < low[axis] || from[axis] > high[axis] {
                    return None;
                }
            } else {
                let at = [low, high].map(|bound| (bound[axis] - from[axis]) / step[axis]);
                first = first.max(at[0].min(at[1]));
                last = last.min(at[0].max(at[1]));
            }
        }
        let at = |s: f64| [from[0] + s * step[0], from[1] + s * step[1]];
        (first <= last).then(|| (at(first), at(last)))
    }

    /// The parts of a line inside.
    pub fn clip_line(&self, places: &[Place]) -> Vec<Vec<Place>> {
        let mut parts: Vec<Vec<Place>> = Vec::new();
        for pair in places.windows(2) {
            let Some((from, to)) = self.clip_segment(pair[0], pair[1]) else {
                continue;
            };
            match parts.last_mut() {
                Some(part) if part.last() == Some(&from) => part.push(to),
                _ => parts.push(vec![from, to]),
            }
        }
        parts
    }

    /// The part of a convex polygon inside (Sutherland and Hodgman).
    pub fn clip_polygon(&self, places: &[Place]) -> Vec<Place> {
        let sides = [
            (0, 1.0, self.left),
            (0, -1.0, -self.right()),
            (1, 1.0, self.top),
            (1, -1.0, -self.bottom()),
        ];
        sides
            .into_iter()
            .fold(places.to_vec(), |polygon, (axis, sign, bound)| {
                clip_side(&polygon, |place| sign * place[axis] - bound)
            })
    }
}

/// Part of a polygon where `inside` is not negative.
fn clip_side(polygon: &[Place], inside: impl Fn(Place) -> f64) -> Vec<Place> {
    let mut kept = Vec::new();
    for (index, &to) in polygon.iter().enumerate() {
        let from = polygon[(index + polygon.len() - 1) % polygon.len()];
        let (before, after) = (inside(from), inside(to));
        if (before < 0.0) != (after < 0.0) {
            let s = before / (before - after);
            kept.push([
                from[0] + s * (to[0] - from[0]),
                from[1] + s * (to[1] - from[1]),
            ]);
        }
        if after >= 0.0 {
            kept.push(to);
        }
    }
    kept
}

/// A line cut into pieces of lengths `pattern[0]`, with gaps of `pattern[1]`.
pub(super) fn dashes(places: &[Place], pattern: [f64; 2]) -> Vec<Vec<Place>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<Place> = places.first().copied().into_iter().collect();
    let (mut phase, mut left) = (0, pattern[0]);
    for pair in places.windows(2) {
        let step = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let length = step[0].hypot(step[1]);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let s = done / length;
            let place = [pair[0][0] + s * step[0], pair[0][1] + s * step[1]];
            if phase == 0 {
                piece.push(place);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![place];
            }
            phase = 1 - phase;
            left = pattern[phase];
        }
        left -= length - done;
        if phase == 0 {
            piece.push(pair[1]);
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}
