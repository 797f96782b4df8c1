//! The embedded font: widths of texts, and texts as grey pixels.
//!
//! Sizes are those of the em square, as in SVG. DejaVu Sans is freely
//! licensed (Bitstream Vera licence, changes in the public domain).

use std::convert::Infallible;
use std::sync::LazyLock;

use ab_glyph::{Font as _, FontRef, Glyph, PxScale, ScaleFont, point};
use plotters_backend::{
    BackendColor, BackendCoord, BackendTextStyle, FontFamily, FontStyle, FontTransform, text_anchor,
};

use super::color::BLACK;
use super::shape::{Anchor, Direction};

/// Families to be named where the font is not embedded; Verdana has nearly the same widths.
const FAMILIES: &str = "DejaVu Sans, Bitstream Vera Sans, Verdana, sans-serif";

/// Height of a digit over the size.
pub(super) const DIGIT_HEIGHT: f64 = 0.729;

/// Half the height of a lower-case letter over the size: where the SVG
/// backend puts a base line above the place of a text anchored at its bottom.
pub(super) const BASELINE_LIFT: f64 = 0.2734;

/// Divisor that the SVG backend applies to sizes.
const BACKEND_SIZE_FACTOR: f64 = 1.24;

static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(dejavu::sans::regular()).expect("the embedded font is sound")
});

/// Width of a text of some size.
pub(super) fn width(words: &str, size: f64) -> f64 {
    glyphs(words, size).1
}

/// A text style for both backends.
pub(super) struct TextStyle {
    /// Size of the em square, pixels.
    pub size: f64,
    pub anchor: Anchor,
    pub direction: Direction,
}

impl BackendTextStyle for TextStyle {
    type FontError = Infallible;

    fn color(&self) -> BackendColor {
        BackendColor {
            alpha: 1.0,
            rgb: BLACK,
        }
    }

    fn size(&self) -> f64 {
        self.size * BACKEND_SIZE_FACTOR
    }

    fn transform(&self) -> FontTransform {
        match self.direction {
            Direction::Right => FontTransform::None,
            Direction::Up => FontTransform::Rotate270,
        }
    }

    fn style(&self) -> FontStyle {
        FontStyle::Normal
    }

    fn anchor(&self) -> text_anchor::Pos {
        let along = match self.anchor {
            Anchor::Start => text_anchor::HPos::Left,
            Anchor::Middle => text_anchor::HPos::Center,
            Anchor::End => text_anchor::HPos::Right,
        };
        text_anchor::Pos::new(along, text_anchor::VPos::Bottom)
    }

    fn family(&self) -> FontFamily<'_> {
        FontFamily::Name(FAMILIES)
    }

    fn layout_box(&self, words: &str) -> Result<(BackendCoord, BackendCoord), Infallible> {
        let along = width(words, self.size).round() as i32;
        Ok(((0, 0), (along, (BASELINE_LIFT * self.size).round() as i32)))
    }

    /// The base line is at height zero of the layout box.
    fn draw<E, F: FnMut(i32, i32, BackendColor) -> Result<(), E>>(
        &self,
        words: &str,
        (left, base): BackendCoord,
        mut draw: F,
    ) -> Result<Result<(), E>, Infallible> {
        let mut pixels = Vec::new();
        for glyph in glyphs(words, self.size).0 {
            if let Some(outline) = FONT.outline_glyph(glyph) {
                let corner = outline.px_bounds().min;
                outline.draw(|x, y, coverage| {
                    let at = (
                        left + corner.x as i32 + x as i32,
                        base + corner.y as i32 + y as i32,
                    );
                    pixels.push((at, f64::from(coverage).min(1.0)));
                });
            }
        }
        for ((x, y), alpha) in pixels.into_iter().filter(|(_, alpha)| *alpha > 0.0) {
            if let Err(error) = draw(x, y, BackendColor { alpha, rgb: BLACK }) {
                return Ok(Err(error));
            }
        }
        Ok(Ok(()))
    }
}

/// Glyphs in a row from the origin, and where the row ends.
fn glyphs(words: &str, size: f64) -> (Vec<Glyph>, f64) {
    let em = FONT
        .units_per_em()
        .map_or(1.0, |units| FONT.height_unscaled() / units);
    let scale = PxScale::from(size as f32 * em);
    let font = FONT.as_scaled(scale);
    let (mut row, mut x): (Vec<Glyph>, f32) = (Vec::new(), 0.0);
    for letter in words.chars() {
        let id = font.glyph_id(letter);
        if let Some(before) = row.last() {
            x += font.kern(before.id, id);
        }
        row.push(id.with_scale_and_position(scale, point(x, 0.0)));
        x += font.h_advance(id);
    }
    (row, x.into())
}
