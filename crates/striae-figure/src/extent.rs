//! One panel on the page: its limits, the room it needs, and its shapes.

use super::arrows::{self, ArrowScale};
use super::axis::Mapping;
use super::description::{Aspect, Axis, Content, Frame, Panel, Scale};
use super::font::{self, DIGIT_HEIGHT};
use super::frame::{self, BOTTOM_ROOM, LABEL, Margins, SPACING, TICK_LABEL};
use super::legend;
use super::panel::{Coordinates, bar_mapping, layers};
use super::polar;
use super::shape::{Anchor, Rectangle, Shape};

/// Height of a title.
pub(super) const TITLE: f64 = 14.0;

/// Default height of a frame over its width.
pub(super) const FLATNESS: f64 = 0.7;

/// A panel with the limits of its axes.
pub(super) struct Extent<'a> {
    panel: &'a Panel,
    /// Of both axes; of a polar panel, the radius twice.
    limits: [(f64, f64); 2],
    bar: Option<(&'a Axis, (f64, f64))>,
}

impl<'a> Extent<'a> {
    /// The limits of a panel; the error is a sentence.
    pub fn of(panel: &'a Panel) -> Result<Self, String> {
        let points = |axis: usize| {
            panel
                .series
                .iter()
                .flat_map(move |s| s.content.coordinates(axis))
        };
        let limits = match &panel.frame {
            Frame::Cartesian { x, y, .. } => [x.limits(points(0))?, y.limits(points(1))?],
            Frame::Polar { radius } => {
                let (_, last) = radius.limits(points(1).chain([0.0]))?;
                [(0.0, last); 2]
            }
        };
        let mut bar = None;
        for series in &panel.series {
            series
                .content
                .check(&panel.frame)
                .map_err(|cause| format!("`{}`: {cause}", series.name))?;
            if let Content::Facets {
                values, bar: axis, ..
            } = &series.content
            {
                bar = Some((axis, axis.bar_limits(values)?));
            }
        }
        Ok(Self { panel, limits, bar })
    }

    /// Height wanted for a frame of some width.
    pub fn height(&self, width: f64) -> f64 {
        let [x, y] = self.limits.map(|(first, last)| (last - first).abs());
        match &self.panel.frame {
            Frame::Polar { .. } => width,
            Frame::Cartesian {
                aspect: Aspect::Equal,
                ..
            } => width * (y / x).clamp(0.35, 1.3),
            Frame::Cartesian { .. } => FLATNESS * width,
        }
    }

    fn coordinates(&self, frame: Rectangle) -> Coordinates {
        let mapping = |scale, (first, last), from, to| Mapping {
            scale,
            first,
            last,
            from,
            to,
        };
        let [mut x_limits, mut y_limits] = self.limits;
        match &self.panel.frame {
            Frame::Cartesian { x, y, aspect } => {
                if *aspect == Aspect::Equal {
                    let x_unit = frame.width / (x_limits.1 - x_limits.0).abs();
                    let y_unit = frame.height / (y_limits.1 - y_limits.0).abs();
                    x_limits = widened(x_limits, (x_unit / y_unit).max(1.0));
                    y_limits = widened(y_limits, (y_unit / x_unit).max(1.0));
                }
                Coordinates::Cartesian {
                    x: mapping(x.scale, x_limits, frame.left, frame.right()),
                    y: mapping(y.scale, y_limits, frame.bottom(), frame.top),
                }
            }
            Frame::Polar { .. } => {
                let centre = [
                    frame.left + frame.width / 2.0,
                    frame.top + frame.height / 2.0,
                ];
                let full = frame.width.min(frame.height) / 2.0;
                Coordinates::Polar {
                    centre,
                    radius: mapping(Scale::Linear, x_limits, centre[0], centre[0] + full),
                }
            }
        }
    }

    fn arrow_scales(&self, frame: Rectangle) -> Vec<ArrowScale> {
        match self.coordinates(frame) {
            Coordinates::Cartesian { x, .. } => {
                let point = frame.width / (x.last - x.first).abs();
                arrows::scales(self.panel, point)
            }
            Coordinates::Polar { .. } => Vec::new(),
        }
    }

    fn legend(&self, frame: Rectangle, cell: f64) -> Vec<Vec<legend::Entry>> {
        legend::rows(
            legend::entries(self.panel, &self.arrow_scales(frame)),
            cell - 4.0,
        )
    }

    /// Room needed around a frame.
    pub fn margins(&self, frame: Rectangle, cell: f64) -> Margins {
        let legend = legend::ROW * self.legend(frame, cell).len() as f64;
        let title = if self.panel.title.is_empty() {
            0.0
        } else {
            TITLE
        };
        let top = title + legend + 4.0;
        let bar = self.bar.map_or(0.0, |(_, limits)| {
            frame::bar_room(&bar_mapping(limits, frame).ticks(SPACING[1]))
        });
        match self.coordinates(frame) {
            Coordinates::Polar { .. } => Margins {
                left: polar::ROOM[0],
                right: polar::ROOM[0],
                top: top + polar::ROOM[1],
                bottom: polar::ROOM[1] + LABEL + 6.0,
            },
            Coordinates::Cartesian { x, y } => {
                let ticks = frame::horizontal_ticks(&x);
                let overhang = ticks.major.iter().filter_map(|(number, words)| {
                    Some(x.place(*number)? + font::width(words, TICK_LABEL) / 2.0 - frame.right())
                });
                Margins {
                    left: frame::left_room(&y.ticks(SPACING[1])),
                    right: bar.max(overhang.fold(1.0, f64::max) + 1.0),
                    top,
                    bottom: BOTTOM_ROOM,
                }
            }
        }
    }

    /// Everything in the cell of a panel.
    pub fn shapes(&self, frame: Rectangle, cell: Rectangle) -> Vec<Shape> {
        let scales = self.arrow_scales(frame);
        let coordinates = self.coordinates(frame);
        let limits = self.bar.map(|(_, limits)| limits);
        let layers = layers(self.panel, frame, coordinates, limits, &scales);
        let mut shapes = layers.back;
        match (&self.panel.frame, coordinates) {
            (Frame::Cartesian { x, y, .. }, Coordinates::Cartesian { x: right, y: up }) => {
                let ticks = [frame::horizontal_ticks(&right), up.ticks(SPACING[1])];
                if self.bar.is_none() {
                    shapes.extend(frame::grid(frame, (&right, &ticks[0]), (&up, &ticks[1])));
                }
                shapes.extend(layers.front);
                shapes.extend(frame::axes(
                    frame,
                    (x, &right, &ticks[0]),
                    (y, &up, &ticks[1]),
                ));
            }
            (Frame::Polar { radius: axis }, Coordinates::Polar { centre, radius }) => {
                let ticks = radius.ticks(polar::SPACING);
                shapes.extend(polar::grid(centre, &radius, &ticks));
                let numbers = polar::numbers(centre, &radius, &ticks, &layers.front);
                shapes.extend(layers.front);
                shapes.extend(numbers);
                shapes.extend(polar::axes(centre, axis, &radius, &ticks));
            }
            _ => unreachable!("coordinates are made from the frame"),
        }
        if let Some((axis, limits)) = self.bar {
            shapes.extend(frame::bar(frame, axis, limits));
        }
        shapes.extend(self.head(frame, cell));
        shapes
    }

    /// Title and legend.
    fn head(&self, frame: Rectangle, cell: Rectangle) -> Vec<Shape> {
        let rows = self.legend(frame, cell.width);
        let widths = rows.iter().map(|row| legend::row_width(row));
        let widest = widths.fold(0.0, f64::max);
        let polar = matches!(self.panel.frame, Frame::Polar { .. });
        let above = if polar { polar::ROOM[1] } else { 0.0 };
        let middle = frame.left + (frame.width - widest) / 2.0;
        let wanted = if polar { middle } else { frame.left };
        let left = wanted.min(cell.right() - widest).max(cell.left);
        let top = frame.top - above - 3.0 - legend::ROW * rows.len() as f64;
        let mut shapes = legend::shapes(&rows, [left, top]);
        if !self.panel.title.is_empty() {
            let place = [
                frame.left + frame.width / 2.0,
                cell.top + DIGIT_HEIGHT * LABEL + 1.0,
            ];
            shapes.push(frame::text(&self.panel.title, place, LABEL, Anchor::Middle));
        }
        shapes
    }
}

fn widened((first, last): (f64, f64), factor: f64) -> (f64, f64) {
    let (middle, half) = ((first + last) / 2.0, factor * (last - first) / 2.0);
    (middle - half, middle + half)
}
