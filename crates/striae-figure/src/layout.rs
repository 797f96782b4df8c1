//! Layout of the page.
//!
//! Frames of one column share left and right edges, those of one row top and
//! bottom, so the room beside a frame is the most any of its neighbours needs.
//! That room depends on tick labels, and these on the frame: a few passes, each
//! over the frames of the one before, settle it.

use super::description::{Figure, Width};
use super::extent::{Extent, FLATNESS, TITLE};
use super::frame::{BOTTOM_ROOM, Margins};
use super::shape::{Rectangle, Shape};

const GAP: f64 = 10.0;
const EDGE: f64 = 3.0;
const PASSES: usize = 4;

/// A figure laid out, in points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Page {
    pub width: f64,
    pub height: f64,
    pub shapes: Vec<Shape>,
}

/// Lays a figure out; the error is a sentence.
pub(super) fn page(figure: &Figure) -> Result<Page, String> {
    if figure.panels.is_empty() {
        return Err("there is no panel".into());
    }
    let contents: Vec<Extent> = figure
        .panels
        .iter()
        .map(Extent::of)
        .collect::<Result<_, _>>()?;
    let columns = figure.columns.clamp(1, figure.panels.len());
    let width = figure.width.points();
    let cell = (width - 2.0 * EDGE - GAP * (columns - 1) as f64) / columns as f64;
    let mut frames = Frames::new(contents.len(), columns, cell);
    for _ in 0..PASSES {
        frames.settle(&contents);
    }
    let mut shapes = Vec::new();
    for (index, extent) in contents.iter().enumerate() {
        shapes.extend(extent.shapes(frames.rectangle(index), frames.cell(index)));
    }
    Ok(Page {
        width,
        height: frames.height(),
        shapes,
    })
}

impl Width {
    fn points(self) -> f64 {
        let millimetres = match self {
            Self::Column => 85.0,
            Self::Page => 175.0,
            Self::Millimetres(millimetres) => millimetres,
        };
        millimetres * 72.0 / 25.4
    }
}

/// The frames of all panels, while the page is being laid out.
struct Frames {
    columns: usize,
    cell_width: f64,
    margins: Vec<Margins>,
    heights: Vec<f64>,
}

impl Frames {
    fn new(count: usize, columns: usize, cell_width: f64) -> Self {
        let start = Margins {
            left: 34.0,
            right: 8.0,
            top: TITLE,
            bottom: BOTTOM_ROOM,
        };
        Self {
            columns,
            cell_width,
            margins: vec![start; count],
            heights: vec![FLATNESS * cell_width; count],
        }
    }

    /// Gives every frame the room it and its neighbours need.
    fn settle(&mut self, contents: &[Extent]) {
        let count = contents.len();
        let wanted: Vec<Margins> = (0..count)
            .map(|index| contents[index].margins(self.rectangle(index), self.cell_width))
            .collect();
        let most = |same: &dyn Fn(usize) -> bool, side: &dyn Fn(&Margins) -> f64| {
            let sides = (0..count).filter(|i| same(*i)).map(|i| side(&wanted[i]));
            sides.fold(0.0, f64::max)
        };
        for index in 0..count {
            let column = |other: usize| other % self.columns == index % self.columns;
            let row = |other: usize| other / self.columns == index / self.columns;
            self.margins[index] = Margins {
                left: most(&column, &|m| m.left),
                right: most(&column, &|m| m.right),
                top: most(&row, &|m| m.top),
                bottom: most(&row, &|m| m.bottom),
            };
        }
        let heights: Vec<f64> = (0..count)
            .map(|index| contents[index].height(self.width(index)))
            .collect();
        for index in 0..count {
            let row = (0..count).filter(|other| other / self.columns == index / self.columns);
            self.heights[index] = row.map(|other| heights[other]).fold(0.0, f64::max);
        }
    }

    fn width(&self, index: usize) -> f64 {
        self.cell_width - self.margins[index].left - self.margins[index].right
    }

    fn row_height(&self, index: usize) -> f64 {
        self.margins[index].top + self.heights[index] + self.margins[index].bottom
    }

    fn row_top(&self, index: usize) -> f64 {
        let rows = 0..index / self.columns;
        EDGE + rows
            .map(|row| self.row_height(row * self.columns) + GAP)
            .sum::<f64>()
    }

    /// All room a panel has.
    fn cell(&self, index: usize) -> Rectangle {
        Rectangle {
            left: EDGE + (index % self.columns) as f64 * (self.cell_width + GAP),
            top: self.row_top(index),
            width: self.cell_width,
            height: self.row_height(index),
        }
    }

    fn rectangle(&self, index: usize) -> Rectangle {
        let cell = self.cell(index);
        Rectangle {
            left: cell.left + self.margins[index].left,
            top: cell.top + self.margins[index].top,
            width: self.width(index),
            height: self.heights[index],
        }
    }

    fn height(&self) -> f64 {
        let last = self.heights.len() - 1;
        self.row_top(last) + self.row_height(last) + EDGE
    }
}
