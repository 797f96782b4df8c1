//! Pictures that are made of dots from the start, with words and a colour bar on them.
//!
//! Places are dots from the upper left corner, `x` to the right and `y` downwards.

use plotters_backend::BackendTextStyle;

use super::{
    FigureError,
    color::{FRAME, viridis},
    font::{DIGIT_HEIGHT, TextStyle, width},
    render::encoded,
    shape::{Anchor, Direction},
    ticks::{linear, power_of_ten},
};
use std::path::Path;
use striae_files::write_atomically;

/// Red, green and blue, 0 to 255.
pub type Dot = [u8; 3];

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Dots {
    size: [usize; 2],
    dots: Vec<Dot>,
}

/// Viridis at a fraction of the bar, 0 to 1.
pub fn color_map(fraction: f64) -> Dot {
    viridis(fraction).into()
}

impl Dots {
    /// A white picture of so many columns and rows.
    pub fn white(size: [usize; 2]) -> Self {
        Self {
            size,
            dots: vec![[255; 3]; size[0] * size[1]],
        }
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The dot of a column and a row that the picture has.
    pub fn dot(&mut self, [column, row]: [usize; 2]) -> &mut Dot {
        &mut self.dots[row * self.size[0] + column]
    }

    /// All dots, row by row.
    pub(super) fn all(&self) -> &[Dot] {
        &self.dots
    }

    /// Writes words in black, whose base line begins at a place.
    pub fn write_words(&mut self, words: &str, place: [f64; 2], size: f64) {
        let style = TextStyle {
            size,
            anchor: Anchor::Start,
            direction: Direction::Right,
        };
        let at = (place[0].round() as i32, place[1].round() as i32);
        let drawn = style.draw(words, at, |x, y, color| {
            self.darken([x, y], color.alpha);
            Ok::<(), std::convert::Infallible>(())
        });
        let (Ok(Ok(())) | Err(_) | Ok(Err(_))) = drawn;
    }

    /// Draws a colour bar of a width and height from its upper left corner, with ticks at
    /// its right.
    pub fn write_bar(&mut self, corner: [usize; 2], size: [usize; 2], limits: [f64; 2], text: f64) {
        for row in 0..size[1] {
            let fraction = 1.0 - (row as f64 + 0.5) / size[1] as f64;
            for column in 0..size[0] {
                if corner[0] + column < self.size[0] && corner[1] + row < self.size[1] {
                    *self.dot([corner[0] + column, corner[1] + row]) = color_map(fraction);
                }
            }
        }
        let [least, largest] = limits;
        let right = (corner[0] + size[0]) as f64;
        if least >= largest {
            let middle = (corner[1] + size[1] / 2) as f64 + 0.5 * DIGIT_HEIGHT * text;
            return self.write_words(&few_digits(least), [right + 6.0, middle], text);
        }
        let ticks = linear(least, largest, 6);
        for (number, label) in &ticks.major {
            let up = (number - least) / (largest - least) * size[1] as f64;
            let row = (corner[1] + size[1]) as f64 - up;
            for column in 0..4 {
                self.frame([corner[0] + size[0] + column, row as usize]);
            }
            let base = row + 0.5 * DIGIT_HEIGHT * text;
            self.write_words(label, [right + 7.0, base], text);
        }
        if ticks.exponent != 0 {
            let words = format!("× {}", power_of_ten(ticks.exponent));
            let below = (corner[1] + size[1]) as f64 + 1.8 * text;
            self.write_words(&words, [corner[0] as f64, below], text);
        }
    }

    /// Width of words of a size.
    pub fn words_width(words: &str, size: f64) -> f64 {
        width(words, size)
    }

    /// The picture as a PNG file.
    ///
    /// # Errors
    /// When it has no dots or cannot be written.
    pub fn write_png(&self, path: &Path) -> Result<(), FigureError> {
        let bytes = encoded(self.dots.as_flattened(), self.size);
        let bytes = bytes.map_err(|cause| FigureError::Description {
            path: path.to_owned(),
            cause: cause.to_string(),
        })?;
        Ok(write_atomically(path, &bytes)?)
    }

    fn darken(&mut self, [x, y]: [i32; 2], alpha: f64) {
        let inside = |at: i32, end: usize| usize::try_from(at).ok().filter(|at| *at < end);
        if let (Some(x), Some(y)) = (inside(x, self.size[0]), inside(y, self.size[1])) {
            for channel in self.dot([x, y]) {
                *channel = (f64::from(*channel) * (1.0 - alpha)).round() as u8;
            }
        }
    }

    fn frame(&mut self, [column, row]: [usize; 2]) {
        if column < self.size[0] && row < self.size[1] {
            *self.dot([column, row]) = FRAME.into();
        }
    }
}

/// A number with at most five digits.
fn few_digits(number: f64) -> String {
    let size = number.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        let words = format!("{number:.4e}");
        let (digits, power) = words.split_once('e').unwrap_or((&words, "0"));
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        return format!("{digits}e{power}").replace('-', "−");
    }
    let before = size.max(1.0).log10().floor() as usize;
    let words = format!("{number:.0$}", 4_usize.saturating_sub(before));
    let words = match words.contains('.') {
        true => words.trim_end_matches('0').trim_end_matches('.'),
        false => &words,
    };
    words.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_darken_where_they_stand_and_a_bar_runs_from_least_to_largest() {
        let mut picture = Dots::white([120, 60]);
        picture.write_words("ten", [5.0, 20.0], 12.0);
        let dark = |picture: &mut Dots, columns: std::ops::Range<usize>| {
            let mut count = 0;
            for column in columns {
                count += (0..60)
                    .filter(|row| picture.dot([column, *row])[0] < 128)
                    .count();
            }
            count
        };
        let end = 5 + Dots::words_width("ten", 12.0).ceil() as usize;
        assert!(dark(&mut picture, 5..end) > 20);
        assert_eq!(dark(&mut picture, end + 1..120), 0);
        picture.write_bar([60, 5], [10, 50], [0.0, 2.0], 9.0);
        assert!(*picture.dot([65, 5]) == color_map(0.99));
        assert!(*picture.dot([65, 54]) == color_map(0.01));
    }

    #[test]
    fn a_value_of_any_size_is_written_with_few_digits() {
        let words = [2.0, 40.0, 0.5, 12345.678, -1.5e-6, 2.5e9, 0.0].map(few_digits);
        let expected = ["2", "40", "0.5", "12346", "−1.5e−6", "2.5e9", "0"];
        assert_eq!(words, expected);
    }

    #[test]
    fn what_stands_outside_is_left_out() {
        let mut picture = Dots::white([10, 10]);
        picture.write_words("wide words", [-5.0, 3.0], 12.0);
        picture.write_bar([8, 8], [10, 10], [1.0, 1.0], 9.0);
        assert_eq!(picture.size(), [10, 10]);
    }
}
