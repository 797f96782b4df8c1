//! Colours: the palette of Okabe and Ito for series, viridis for maps.
//!
//! Source: M. Okabe, K. Ito, "Color universal design" (2008),
//! <https://jfly.uni-koeln.de/color/>.

use plotters::style::{
    RGBColor,
    colors::colormaps::{ColorMap, ViridisRGB},
};

/// Colour of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Color {
    /// The next of blue, vermillion, green, purple, orange, sky and black.
    Automatic,
    Blue,
    Vermillion,
    Green,
    Purple,
    Orange,
    Sky,
    Black,
    Grey,
}

/// Red, green and blue.
pub(super) type Rgb = (u8, u8, u8);

pub(super) const BLACK: Rgb = (0, 0, 0);
pub(super) const FRAME: Rgb = (60, 60, 60);
pub(super) const GRID: Rgb = (222, 222, 222);
pub(super) const WHITE: Rgb = (255, 255, 255);

const SEQUENCE: [Color; 7] = [
    Color::Blue,
    Color::Vermillion,
    Color::Green,
    Color::Purple,
    Color::Orange,
    Color::Sky,
    Color::Black,
];

impl Color {
    /// The colour itself, for series number `index` if automatic.
    pub(super) fn rgb(self, index: usize) -> Rgb {
        match self {
            Self::Automatic => SEQUENCE[index % SEQUENCE.len()].rgb(0),
            Self::Blue => (0, 114, 178),
            Self::Vermillion => (213, 94, 0),
            Self::Green => (0, 158, 115),
            Self::Purple => (204, 121, 167),
            Self::Orange => (230, 159, 0),
            Self::Sky => (86, 180, 233),
            Self::Black => BLACK,
            Self::Grey => (128, 128, 128),
        }
    }
}

/// Viridis at `fraction` of the bar, 0 to 1.
pub(super) fn viridis(fraction: f64) -> Rgb {
    let RGBColor(red, green, blue) =
        ViridisRGB.get_color_normalized(fraction.clamp(0.0, 1.0), 0.0, 1.0);
    (red, green, blue)
}
