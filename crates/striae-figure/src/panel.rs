//! Appearance of the series of a panel on the page.

use super::arrows::{ArrowScale, arrow, ends, group};
use super::axis::Mapping;
use super::color::{Rgb, viridis};
use super::description::{Content, Frame, Line, Marker, Panel, Scale};
use super::fit::power_law;
use super::shape::{Place, Rectangle, Shape, dashes};

const LINE: f64 = 1.1;
const MARKER: f64 = 2.3;

/// From the numbers of a panel to places on the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Coordinates {
    Cartesian {
        x: Mapping,
        y: Mapping,
    },
    /// The radius is mapped from the centre to the right.
    Polar {
        centre: Place,
        radius: Mapping,
    },
}

impl Coordinates {
    /// Position of a point, if it is in the panel.
    pub fn place(&self, point: [f64; 2]) -> Option<Place> {
        match self {
            Self::Cartesian { x, y } => Some([x.place(point[0])?, y.place(point[1])?]),
            Self::Polar { centre, radius } => {
                let length = radius.place(point[1])? - centre[0];
                let (sine, cosine) = point[0].sin_cos();
                let place = [centre[0] + length * cosine, centre[1] - length * sine];
                place[0].is_finite().then_some(place)
            }
        }
    }
}

impl Panel {
    /// The colour of every series.
    pub(super) fn colors(&self) -> Vec<Rgb> {
        let mut drawn = 0;
        let colors = self.series.iter().map(|series| {
            let color = series.color.rgb(drawn);
            if !matches!(series.content, Content::Facets { .. }) {
                drawn += 1;
            }
            color
        });
        colors.collect()
    }
}

impl Content {
    /// Numbers that must be seen along axis 0 or 1.
    pub(super) fn coordinates(&self, axis: usize) -> Vec<f64> {
        match self {
            Self::Curve { points, .. } | Self::PowerLaw { points, .. } => {
                points.iter().map(|point| point[axis]).collect()
            }
            Self::Facets { polygons, .. } => {
                polygons.iter().flatten().map(|point| point[axis]).collect()
            }
            Self::Arrows {
                origins, vectors, ..
            } => ends(origins, vectors).iter().map(|end| end[axis]).collect(),
        }
    }

    /// Refuses what cannot be drawn; the error is a sentence.
    pub(super) fn check(&self, frame: &Frame) -> Result<(), String> {
        let polar = matches!(frame, Frame::Polar { .. });
        let (counts, what) = match self {
            Self::Arrows {
                origins, vectors, ..
            } => ([origins.len(), vectors.len()], "vectors"),
            Self::Facets {
                polygons, values, ..
            } => ([polygons.len(), values.len()], "values"),
            _ => return Ok(()),
        };
        if polar {
            Err(format!("{what} cannot be drawn in a polar panel"))
        } else if counts[0] != counts[1] {
            Err(format!(
                "{} {what} where {} are needed",
                counts[1], counts[0]
            ))
        } else {
            Ok(())
        }
    }
}

/// All series, clipped by the frame; `back` are those below the grid.
pub(super) struct Layers {
    pub back: Vec<Shape>,
    pub front: Vec<Shape>,
}

/// The shapes of all series of a panel.
pub(super) fn layers(
    panel: &Panel,
    frame: Rectangle,
    coordinates: Coordinates,
    bar: Option<(f64, f64)>,
    scales: &[ArrowScale],
) -> Layers {
    let (mut back, mut front) = (Vec::new(), Vec::new());
    for (series, color) in panel.series.iter().zip(panel.colors()) {
        match &series.content {
            Content::Curve {
                points,
                line,
                marker,
            } => {
                front.extend(curve(points, *line, *marker, color, frame, coordinates));
            }
            Content::PowerLaw { points, marker } => {
                let fitted = fitted_line(points);
                front.extend(curve(
                    &fitted,
                    Line::Dashed,
                    Marker::None,
                    color,
                    frame,
                    coordinates,
                ));
                front.extend(curve(
                    points,
                    Line::None,
                    *marker,
                    color,
                    frame,
                    coordinates,
                ));
            }
            Content::Arrows {
                origins,
                vectors,
                unit,
            } => {
                let length = scales
                    .iter()
                    .find(|scale| scale.group == group(series, unit))
                    .map_or(0.0, |scale| scale.length);
                for (&origin, vector) in origins.iter().zip(vectors) {
                    let tail = coordinates
                        .place(origin)
                        .filter(|t| frame.contains(*t, 0.1));
                    let reach = [vector[0] * length, -vector[1] * length];
                    if let (Some(tail), true) = (tail, reach.iter().all(|c| c.is_finite())) {
                        front.extend(arrow(tail, reach, color));
                    }
                }
            }
            Content::Facets {
                polygons, values, ..
            } => {
                let limits = bar.unwrap_or((0.0, 1.0));
                for (polygon, value) in polygons.iter().zip(values) {
                    back.extend(facet(polygon, *value, limits, frame, coordinates));
                }
            }
        }
    }
    Layers { back, front }
}

/// A line on the page in its style.
pub(super) fn curve_shapes(places: &[Place], line: Line, color: Rgb) -> Vec<Shape> {
    let pieces = match line {
        Line::None => Vec::new(),
        Line::Solid => vec![places.to_vec()],
        Line::Dashed => dashes(places, [4.0, 2.2]),
        Line::Dotted => dashes(places, [1.2, 1.8]),
    };
    let stroke = |places| Shape::Stroke {
        places,
        width: LINE,
        color,
    };
    pieces.into_iter().map(stroke).collect()
}

/// A marker on the page.
pub(super) fn marker_shapes(place: Place, marker: Marker, color: Rgb) -> Vec<Shape> {
    let at = |d: [f64; 2]| [place[0] + MARKER * d[0], place[1] + MARKER * d[1]];
    let fill = |corners: &[[f64; 2]]| {
        vec![Shape::Fill {
            places: corners.iter().map(|&d| at(d)).collect(),
            color,
        }]
    };
    match marker {
        Marker::None => Vec::new(),
        Marker::Circle => {
            let angle = |i: u32| f64::from(i) * std::f64::consts::TAU / 24.0;
            let corners: Vec<_> = (0..24).map(|i| [angle(i).cos(), angle(i).sin()]).collect();
            fill(&corners)
        }
        Marker::Square => fill(&[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]),
        Marker::Triangle => fill(&[[0.0, -1.25], [1.1, 0.75], [-1.1, 0.75]]),
        Marker::Diamond => fill(&[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]]),
        Marker::Cross => [[[-1.0, -1.0], [1.0, 1.0]], [[-1.0, 1.0], [1.0, -1.0]]]
            .map(|ends| Shape::Stroke {
                places: ends.map(at).into(),
                width: LINE,
                color,
            })
            .into(),
    }
}

fn curve(
    points: &[[f64; 2]],
    line: Line,
    marker: Marker,
    color: Rgb,
    frame: Rectangle,
    coordinates: Coordinates,
) -> Vec<Shape> {
    let places: Vec<Option<Place>> = points.iter().map(|p| coordinates.place(*p)).collect();
    let runs = places.split(Option::is_none);
    let lines = runs.flat_map(|run| {
        let run: Vec<Place> = run.iter().flatten().copied().collect();
        frame.clip_line(&run)
    });
    let mut shapes: Vec<Shape> = lines.flat_map(|l| curve_shapes(&l, line, color)).collect();
    let visible = places
        .iter()
        .flatten()
        .filter(|place| frame.contains(**place, 0.1));
    shapes.extend(visible.flat_map(|place| marker_shapes(*place, marker, color)));
    shapes
}

fn facet(
    polygon: &[[f64; 2]],
    value: f64,
    (low, high): (f64, f64),
    frame: Rectangle,
    coordinates: Coordinates,
) -> Option<Shape> {
    let places: Option<Vec<Place>> = polygon.iter().map(|p| coordinates.place(*p)).collect();
    let places = frame.clip_polygon(&places?);
    (value.is_finite() && places.len() > 2).then(|| Shape::Fill {
        places,
        color: viridis((value - low) / (high - low)),
    })
}

fn fitted_line(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let positive = || points.iter().map(|p| p[0]).filter(|x| *x > 0.0);
    let (low, high) = (
        positive().fold(f64::INFINITY, f64::min),
        positive().fold(0.0, f64::max),
    );
    power_law(points).map_or(Vec::new(), |law| {
        let steps = (0..=32).map(|i| low * (high / low).powf(f64::from(i) / 32.0));
        steps.map(|x| [x, law.at(x)]).collect()
    })
}

/// Mapping of a colour bar's numbers onto its height.
pub(super) fn bar_mapping((first, last): (f64, f64), frame: Rectangle) -> Mapping {
    Mapping {
        scale: Scale::Linear,
        first,
        last,
        from: frame.bottom(),
        to: frame.top,
    }
}
