//! Figures for papers and web pages, from a description to files.
//!
//! A [`Figure`] is plain values: panels side by side, each with axes and
//! series. [`Figure::write`] lays it out once and writes the same shapes as
//! `NAME.svg` and `NAME.png` (300 dots per inch), and all that was drawn as
//! `NAME.csv`. Text is set in DejaVu Sans, embedded in the program, so widths
//! do not depend on the machine.
//!
//! Lengths inside are points (1/72 inch), y downwards. Colours of series are
//! those of Okabe and Ito (2008), colour maps are viridis
//! (<https://doi.org/10.1371/journal.pone.0199239>); both are safe for
//! colour-blind readers. Legends stand above the axes and cover no data.
//!
//! [`Dots`] are pictures that somebody else draws, with words and a colour bar on them.
//!
//! ```no_run
//! use striae_figure::{Axis, Content, Figure, Panel, Series, Width};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let pressure = (0..=50).map(|i| f64::from(i) / 50.0).map(|x| [x, (1.0 - x * x).sqrt()]);
//! let panel = Panel::new(Axis::linear("x / a", ""), Axis::linear("p", "GPa"))
//!     .with(Series::new("Hertz", Content::line(pressure.collect())));
//! Figure::new(Width::Column, vec![panel]).write("figures".as_ref(), "hertz")?;
//! # Ok(()) }
//! ```

mod animation;
mod arrows;
mod axis;
mod color;
mod description;
mod dots;
mod error;
mod extent;
mod fit;
mod font;
mod frame;
mod layout;
mod legend;
mod palette;
mod panel;
mod polar;
mod render;
mod shape;
mod table;
#[cfg(test)]
mod tests;
mod ticks;

pub use animation::{Animation, Moving};
pub use color::Color;
pub use description::{
    Aspect, Axis, Content, Figure, Frame, Limits, Line, Marker, Panel, Scale, Series, Width,
};
pub use dots::{Dot, Dots, color_map};
pub use error::FigureError;
pub use fit::{PowerLaw, power_law};
