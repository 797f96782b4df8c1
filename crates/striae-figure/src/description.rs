//! Description of a figure, as plain values.

use super::Color;

/// Panels side by side, `columns` in a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Width on paper.
    pub width: Width,
    /// Panels in one row.
    pub columns: usize,
    /// Panels, row by row.
    pub panels: Vec<Panel>,
}

/// Width of a figure on paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Width {
    /// One column of a journal, 85 mm.
    Column,
    /// The whole page, 175 mm.
    Page,
    /// Any other width, mm.
    Millimetres(f64),
}

/// One pair of axes with its series.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Title above the panel, may be empty.
    pub title: String,
    /// The axes.
    pub frame: Frame,
    /// Series to be drawn, back to front.
    pub series: Vec<Series>,
}

/// The axes of a panel.
#[derive(Clone, Debug, PartialEq)]
pub enum Frame {
    /// Perpendicular axes.
    Cartesian {
        /// The axis to the right.
        x: Axis,
        /// The axis upwards.
        y: Axis,
        /// Aspect: whether both axes have one scale.
        aspect: Aspect,
    },
    /// Angle counter-clockwise from the right, in radians; radius from the
    /// centre, which is zero.
    Polar {
        /// The axis from the centre outwards.
        radius: Axis,
    },
}

/// Aspect of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aspect {
    /// The panel is filled.
    Free,
    /// One unit is as long on both axes.
    Equal,
}

/// One axis, or a colour bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The quantity.
    pub label: String,
    /// Its unit, may be empty.
    pub unit: String,
    /// Conversion of numbers to lengths.
    pub scale: Scale,
    /// First and last number.
    pub limits: Limits,
}

/// Conversion of numbers to lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    Linear,
    /// Every decade as long.
    Logarithmic,
}

/// First and last number of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limits {
    /// Range of the series, and a small margin.
    Automatic,
    /// As given.
    Fixed(f64, f64),
}

/// Something drawn in a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; without a name it is not in the legend.
    pub name: String,
    /// Content of the series.
    pub content: Content,
    /// Its colour; colour maps have their own.
    pub color: Color,
}

/// Content of a series. Points are `[x, y]`, or `[angle, radius]` in a polar panel; a point that is
/// not finite interrupts a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Points joined by a line, with markers.
    Curve {
        /// The points.
        points: Vec<[f64; 2]>,
        /// The line between them.
        line: Line,
        /// The mark on each of them.
        marker: Marker,
    },
    /// Markers and the power law fitted to them; the legend gives its exponent.
    PowerLaw {
        /// The points.
        points: Vec<[f64; 2]>,
        /// The mark on each of them.
        marker: Marker,
    },
    /// Arrows in the plane; Cartesian panels only. The legend holds a key. All
    /// arrows of a panel with one unit have one scale; series without a unit have
    /// their own.
    Arrows {
        /// Tails of the arrows.
        origins: Vec<[f64; 2]>,
        /// Vectors that the arrows show.
        vectors: Vec<[f64; 2]>,
        /// Unit of the vectors.
        unit: String,
    },
    /// Polygons filled by the colour of a value; Cartesian panels only.
    Facets {
        /// Corners of every polygon.
        polygons: Vec<Vec<[f64; 2]>>,
        /// One value a polygon.
        values: Vec<f64>,
        /// The colour bar; always linear.
        bar: Axis,
    },
}

/// Connection of the points of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// Not at all.
    None,
    /// Without gaps.
    Solid,
    /// By dashes.
    Dashed,
    /// By dots.
    Dotted,
}

/// The mark on a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Marker {
    None,
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
}

impl Figure {
    /// A figure with all panels in one row.
    pub fn new(width: Width, panels: Vec<Panel>) -> Self {
        Self {
            width,
            columns: panels.len().max(1),
            panels,
        }
    }
}

impl Panel {
    /// An empty panel with perpendicular axes.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self::framed(Frame::Cartesian {
            x,
            y,
            aspect: Aspect::Free,
        })
    }

    /// An empty panel with perpendicular axes of one scale.
    pub fn plane(x: Axis, y: Axis) -> Self {
        Self::framed(Frame::Cartesian {
            x,
            y,
            aspect: Aspect::Equal,
        })
    }

    /// An empty polar panel.
    pub fn polar(radius: Axis) -> Self {
        Self::framed(Frame::Polar { radius })
    }

    fn framed(frame: Frame) -> Self {
        Self {
            title: String::new(),
            frame,
            series: Vec::new(),
        }
    }

    /// The panel under a title.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// The panel with one more series.
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }
}

impl Axis {
    /// A linear axis with automatic limits.
    pub fn linear(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            unit: unit.into(),
            scale: Scale::Linear,
            limits: Limits::Automatic,
        }
    }

    /// A logarithmic axis with automatic limits.
    pub fn logarithmic(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            scale: Scale::Logarithmic,
            ..Self::linear(label, unit)
        }
    }

    /// The axis from `first` to `last`.
    pub fn within(mut self, first: f64, last: f64) -> Self {
        self.limits = Limits::Fixed(first, last);
        self
    }
}

impl Series {
    /// A series in the next colour.
    pub fn new(name: impl Into<String>, content: Content) -> Self {
        Self {
            name: name.into(),
            content,
            color: Color::Automatic,
        }
    }

    /// The series in a certain colour.
    pub fn colored(mut self, color: Color) -> Self {
        self.color = color;
        self
    }
}

impl Content {
    /// A solid line.
    pub fn line(points: Vec<[f64; 2]>) -> Self {
        Self::Curve {
            points,
            line: Line::Solid,
            marker: Marker::None,
        }
    }

    /// A dashed line.
    pub fn dashed(points: Vec<[f64; 2]>) -> Self {
        Self::Curve {
            points,
            line: Line::Dashed,
            marker: Marker::None,
        }
    }

    /// Markers alone.
    pub fn markers(points: Vec<[f64; 2]>, marker: Marker) -> Self {
        Self::Curve {
            points,
            line: Line::None,
            marker,
        }
    }
}
