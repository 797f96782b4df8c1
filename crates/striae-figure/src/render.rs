//! From shapes to files: SVG and PNG by the backends of `plotters`.
//!
//! Both backends count in whole pixels. The SVG has 20 of them a point and
//! names its true size in millimetres. The bitmap is drawn with three times
//! the dots in both directions and averaged down to 300 dots per inch, which
//! smooths every edge.

use std::fmt::Display;
use std::path::Path;

use plotters::backend::{BitMapBackend, SVGBackend};
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, DrawingBackend};

use super::color::{Rgb, WHITE};
use super::description::Figure;
use super::font::{BASELINE_LIFT, TextStyle};
use super::layout::{Page, page};
use super::shape::{Direction, Place, Shape, Text};
use super::table;
use crate::FigureError;
use striae_files::write_atomically;

const SVG_PIXELS: f64 = 20.0;
const DOTS_PER_INCH: f64 = 300.0;
const OVERSAMPLING: usize = 3;

impl Figure {
    /// Writes the figure as SVG alone.
    ///
    /// # Errors
    /// When it cannot be drawn or the file not written.
    pub fn write_svg(&self, path: &Path) -> Result<(), FigureError> {
        let drawn = page(self).and_then(|page| svg(&page));
        let text = drawn.map_err(|cause| FigureError::Description {
            path: path.to_owned(),
            cause,
        })?;
        Ok(write_atomically(path, text.as_bytes())?)
    }

    /// Writes `NAME.svg`, `NAME.png` and `NAME.csv` into a folder.
    pub fn write(&self, folder: &Path, name: &str) -> Result<(), FigureError> {
        let path = |extension: &str| folder.join(format!("{name}.{extension}"));
        let fault = |extension: &str| {
            let path = path(extension);
            move |cause: String| FigureError::Description { path, cause }
        };
        let page = page(self).map_err(fault("svg"))?;
        let svg = svg(&page).map_err(fault("svg"))?;
        let png = png(&page).map_err(fault("png"))?;
        write_atomically(&path("svg"), svg.as_bytes())?;
        write_atomically(&path("png"), &png)?;
        write_atomically(&path("csv"), table::text(self).as_bytes())?;
        Ok(())
    }
}

/// The page as SVG.
pub(super) fn svg(page: &Page) -> Result<String, String> {
    let size = [page.width, page.height].map(|length| (length * SVG_PIXELS).round() as u32);
    let mut text = String::new();
    draw(
        page,
        SVGBackend::with_string(&mut text, (size[0], size[1])),
        SVG_PIXELS,
        Strokes::Lines,
    )?;
    let millimetres = |pixels: u32| f64::from(pixels) / SVG_PIXELS * 25.4 / 72.0;
    let plain = format!(r#"width="{}" height="{}""#, size[0], size[1]);
    let true_size = format!(
        r#"width="{:.2}mm" height="{:.2}mm" stroke-linejoin="round" stroke-linecap="butt""#,
        millimetres(size[0]),
        millimetres(size[1])
    );
    Ok(text.replacen(&plain, &true_size, 1))
}

/// The page as PNG.
pub(super) fn png(page: &Page) -> Result<Vec<u8>, String> {
    let dots = DOTS_PER_INCH / 72.0;
    let size = [page.width, page.height].map(|length| (length * dots).round() as usize);
    let fine = size.map(|length| length * OVERSAMPLING);
    let mut pixels = vec![255; 3 * fine[0] * fine[1]];
    let backend = BitMapBackend::with_buffer(&mut pixels, (fine[0] as u32, fine[1] as u32));
    draw(page, backend, dots * OVERSAMPLING as f64, Strokes::Polygons)?;
    encoded(&averaged(&pixels, size), size).map_err(|error| error.to_string())
}

/// Strokes passed to a backend: the bitmap one joins wide lines badly.
#[derive(Clone, Copy, PartialEq)]
enum Strokes {
    Lines,
    Polygons,
}

struct Stroke {
    color: Rgb,
    width: u32,
}

impl BackendStyle for Stroke {
    fn color(&self) -> BackendColor {
        opaque(self.color)
    }

    fn stroke_width(&self) -> u32 {
        self.width
    }
}

fn draw<B: DrawingBackend>(
    page: &Page,
    mut backend: B,
    scale: f64,
    strokes: Strokes,
) -> Result<(), String> {
    let (width, height) = backend.get_size();
    let all = (width as i32, height as i32);
    backend
        .draw_rect((0, 0), all, &opaque(WHITE), true)
        .map_err(sentence)?;
    let pixel = |place: &Place| pixel(place, scale);
    for shape in &page.shapes {
        match shape {
            Shape::Fill { places, color } => {
                fill(
                    &mut backend,
                    places.iter().map(pixel).collect(),
                    *color,
                    strokes,
                )?;
            }
            Shape::Stroke {
                places,
                width,
                color,
            } if strokes == Strokes::Lines => {
                let width = (width * scale).round().max(1.0) as u32;
                let style = Stroke {
                    color: *color,
                    width,
                };
                backend
                    .draw_path(places.iter().map(pixel), &style)
                    .map_err(sentence)?;
            }
            Shape::Stroke {
                places,
                width,
                color,
            } => {
                for polygon in outlines(places, *width) {
                    fill(
                        &mut backend,
                        polygon.iter().map(pixel).collect(),
                        *color,
                        strokes,
                    )?;
                }
            }
            Shape::Text(text) => write(&mut backend, text, scale)?,
        }
    }
    backend.present().map_err(sentence)
}

/// Puts words on the page.
fn write<B: DrawingBackend>(backend: &mut B, text: &Text, scale: f64) -> Result<(), String> {
    let lift = BASELINE_LIFT * text.size;
    let place = match text.direction {
        Direction::Right => [text.place[0], text.place[1] + lift],
        Direction::Up => [text.place[0] + lift, text.place[1]],
    };
    let style = TextStyle {
        size: text.size * scale,
        anchor: text.anchor,
        direction: text.direction,
    };
    backend
        .draw_text(&text.words, &style, pixel(&place, scale))
        .map_err(sentence)
}

/// Pixel of a place.
fn pixel(place: &Place, scale: f64) -> BackendCoord {
    place.map(|c| (c * scale).round() as i32).into()
}

/// Fills a polygon; in SVG with a hairline of its own colour, without which
/// neighbours would show a seam.
fn fill<B: DrawingBackend>(
    backend: &mut B,
    corners: Vec<BackendCoord>,
    color: Rgb,
    strokes: Strokes,
) -> Result<(), String> {
    if strokes == Strokes::Lines {
        let around: Vec<BackendCoord> = corners.iter().chain(corners.first()).copied().collect();
        let hairline = Stroke { color, width: 3 };
        backend.draw_path(around, &hairline).map_err(sentence)?;
    }
    backend
        .fill_polygon(corners, &opaque(color))
        .map_err(sentence)
}

/// A line as polygons: one a segment, and a disc at every bend.
fn outlines(places: &[Place], width: f64) -> Vec<Vec<Place>> {
    let half = width / 2.0;
    let segments = places.windows(2).filter_map(|ends| {
        let step = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let length = step[0].hypot(step[1]);
        let [across, up] = [-step[1] / length * half, step[0] / length * half];
        let side = |end: Place, sign: f64| [end[0] + sign * across, end[1] + sign * up];
        (length > 0.0).then(|| {
            vec![
                side(ends[0], 1.0),
                side(ends[1], 1.0),
                side(ends[1], -1.0),
                side(ends[0], -1.0),
            ]
        })
    });
    let bends = places.iter().take(places.len().saturating_sub(1)).skip(1);
    let discs = bends.map(|bend| {
        let angles = (0..12).map(|i| f64::from(i) * std::f64::consts::TAU / 12.0);
        angles
            .map(|a| [bend[0] + half * a.cos(), bend[1] + half * a.sin()])
            .collect()
    });
    segments.chain(discs).collect()
}

fn averaged(fine: &[u8], [width, height]: [usize; 2]) -> Vec<u8> {
    let mut coarse = Vec::with_capacity(3 * width * height);
    for row in 0..height {
        for column in 0..width {
            for channel in 0..3 {
                let dots = (0..OVERSAMPLING * OVERSAMPLING).map(|dot| {
                    let y = row * OVERSAMPLING + dot / OVERSAMPLING;
                    let x = column * OVERSAMPLING + dot % OVERSAMPLING;
                    usize::from(fine[3 * (y * width * OVERSAMPLING + x) + channel])
                });
                coarse.push((dots.sum::<usize>() / (OVERSAMPLING * OVERSAMPLING)) as u8);
            }
        }
    }
    coarse
}

/// An RGB picture of columns and rows as PNG.
pub(super) fn encoded(
    pixels: &[u8],
    [width, height]: [usize; 2],
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let per_metre = (DOTS_PER_INCH / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}

fn opaque(rgb: Rgb) -> BackendColor {
    BackendColor { alpha: 1.0, rgb }
}

fn sentence(error: impl Display) -> String {
    error.to_string()
}
