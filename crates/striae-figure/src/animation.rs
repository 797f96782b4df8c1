//! Pictures one after another in one file: GIF and animated PNG (APNG).
//!
//! Every frame but the first stores only the rectangle in which it differs from the one before. A
//! GIF has one palette of 255 colours for all frames, so that what stands still does not flicker;
//! an animated PNG has the colours of the pictures themselves.
//!
//! Sources: CompuServe, *Graphics Interchange Format, version 89a* (1990); W3C, *Portable Network
//! Graphics (PNG) Specification*, third edition (2025), which includes APNG.

use std::{ops::Range, path::Path};

use striae_files::write_atomically;

use crate::{Dot, Dots, FigureError, palette::Palette};

/// Frames that the palette of a GIF is made from.
const SAMPLES: usize = 12;

/// Shortest time of the last frame (seconds), so that the end is seen before the start.
const REST: f64 = 1.0;

/// Number of the colour of a GIF that lets the frame before through.
const THROUGH: u8 = 255;

/// Formats of animations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moving {
    /// GIF: 255 colours, shown by all programs.
    Gif,
    /// Animated PNG: all colours, shown by browsers.
    Png,
}

impl Moving {
    /// The format of a file, by the extension of its name: `gif`, `png` or `apng`.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "gif" => Some(Self::Gif),
            "png" | "apng" => Some(Self::Png),
            _ => None,
        }
    }
}

/// An animation: frames of one size, shown over and over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Animation {
    /// Number of frames.
    pub frames: usize,
    /// Time of a frame (seconds), rounded to hundredths.
    pub seconds: f64,
}

impl Animation {
    /// Writes the animation, whole or not at all. Frames are drawn when they are written, some
    /// twice, so that they need not be in memory together.
    ///
    /// # Errors
    /// When there are no frames or one cannot be drawn, or the file cannot be written.
    pub fn write<E: From<FigureError>>(
        &self,
        path: &Path,
        moving: Moving,
        mut frame: impl FnMut(usize) -> Result<Dots, E>,
    ) -> Result<(), E> {
        let bytes = match moving {
            Moving::Gif => self.gif(path, &mut frame),
            Moving::Png => self.png(path, &mut frame),
        }?;
        Ok(write_atomically(path, &bytes).map_err(FigureError::from)?)
    }

    fn gif<E: From<FigureError>>(
        &self,
        path: &Path,
        frame: &mut impl FnMut(usize) -> Result<Dots, E>,
    ) -> Result<Vec<u8>, E> {
        let mut last = self.first(path, frame)?;
        let samples = self.frames.min(SAMPLES);
        let mut sampled = vec![last.clone()];
        for sample in 1..samples {
            // The last frame is among them.
            sampled.push(frame(sample * (self.frames - 1) / (samples - 1))?);
        }
        let mut palette = Palette::of(sampled.iter().flat_map(Dots::all), usize::from(THROUGH));
        drop(sampled);
        let mut bytes = Vec::new();
        let [width, height] = last.size().map(|side| side as u16);
        let encoder = gif::Encoder::new(&mut bytes, width, height, &palette.bytes());
        let mut encoder = encoder.map_err(fault(path))?;
        let looped = encoder.set_repeat(gif::Repeat::Infinite);
        looped.map_err(fault(path))?;
        for at in 0..self.frames {
            let (before, dots) = match at {
                0 => (None, last.clone()),
                _ => (Some(&last), frame(at)?),
            };
            let changed = changed(before, &dots);
            let frame = gif::Frame {
                delay: self.hundredths(at),
                dispose: gif::DisposalMethod::Keep,
                transparent: Some(THROUGH),
                left: changed.columns.start as u16,
                top: changed.rows.start as u16,
                width: changed.columns.len() as u16,
                height: changed.rows.len() as u16,
                buffer: changed.numbers(before, &dots, &mut palette).into(),
                ..gif::Frame::default()
            };
            encoder.write_frame(&frame).map_err(fault(path))?;
            last = dots;
        }
        drop(encoder);
        Ok(bytes)
    }

    fn png<E: From<FigureError>>(
        &self,
        path: &Path,
        frame: &mut impl FnMut(usize) -> Result<Dots, E>,
    ) -> Result<Vec<u8>, E> {
        let mut last = self.first(path, frame)?;
        let mut bytes = Vec::new();
        let mut writer = self
            .png_header(&mut bytes, last.size())
            .map_err(fault(path))?;
        for at in 0..self.frames {
            let (before, dots) = match at {
                0 => (None, last.clone()),
                _ => (Some(&last), frame(at)?),
            };
            let changed = changed(before, &dots);
            let written = changed.write_png(&mut writer, &dots, self.hundredths(at));
            written.map_err(fault(path))?;
            last = dots;
        }
        writer.finish().map_err(fault(path))?;
        Ok(bytes)
    }

    fn first<E: From<FigureError>>(
        &self,
        path: &Path,
        frame: &mut impl FnMut(usize) -> Result<Dots, E>,
    ) -> Result<Dots, E> {
        match self.frames {
            0 => Err(fault(path)("an animation without frames").into()),
            _ => frame(0),
        }
    }

    fn png_header<'a>(
        &self,
        room: &'a mut Vec<u8>,
        size: [usize; 2],
    ) -> Result<png::Writer<&'a mut Vec<u8>>, png::EncodingError> {
        let [width, height] = size.map(|side| side as u32);
        let mut encoder = png::Encoder::new(room, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_animated(self.frames as u32, 0)?;
        encoder.write_header()
    }

    /// Time of a frame.
    fn hundredths(&self, frame: usize) -> u16 {
        let rests = frame + 1 == self.frames;
        let seconds = match rests {
            true => self.seconds.max(REST),
            false => self.seconds,
        };
        (seconds * 100.0).round().clamp(1.0, f64::from(u16::MAX)) as u16
    }
}

/// The dots in which a frame differs from the one before.
struct Changed {
    columns: Range<usize>,
    rows: Range<usize>,
}

impl Changed {
    /// Numbers of the colours of a palette.
    fn numbers(&self, before: Option<&Dots>, dots: &Dots, palette: &mut Palette) -> Vec<u8> {
        let columns = dots.size()[0];
        let row = |row: usize| self.columns.clone().map(move |c| row * columns + c);
        let places = self.rows.clone().flat_map(row);
        let number = |at: usize| {
            let dot = dots.all()[at];
            match before {
                Some(before) if before.all()[at] == dot => THROUGH,
                _ => palette.number(dot),
            }
        };
        places.map(number).collect()
    }

    /// Writes the dots as the next frame.
    fn write_png(
        &self,
        writer: &mut png::Writer<&mut Vec<u8>>,
        dots: &Dots,
        hundredths: u16,
    ) -> Result<(), png::EncodingError> {
        // A frame must lie in the picture after each of these calls.
        writer.set_frame_position(0, 0)?;
        writer.set_frame_dimension(self.columns.len() as u32, self.rows.len() as u32)?;
        writer.set_frame_position(self.columns.start as u32, self.rows.start as u32)?;
        writer.set_frame_delay(hundredths, 100)?;
        let columns = dots.size()[0];
        let row = |row: usize| {
            let start = row * columns;
            &dots.all()[start + self.columns.start..start + self.columns.end]
        };
        let rows: Vec<Dot> = self.rows.clone().flat_map(row).copied().collect();
        writer.write_image_data(rows.as_flattened())
    }
}

/// The rectangle in which a frame differs from the one before: all of the first one, and one dot
/// of one that does not.
fn changed(before: Option<&Dots>, dots: &Dots) -> Changed {
    let [columns, rows] = dots.size();
    let Some(before) = before else {
        return Changed {
            columns: 0..columns,
            rows: 0..rows,
        };
    };
    let pairs = dots.all().iter().zip(before.all()).enumerate();
    let places = pairs.filter_map(|(at, (a, b))| (a != b).then_some([at % columns, at / columns]));
    let span = places.fold(None, |span: Option<[[usize; 2]; 2]>, place| {
        Some(match span {
            None => [place, place],
            Some([low, high]) => [
                [low[0].min(place[0]), low[1].min(place[1])],
                [high[0].max(place[0]), high[1].max(place[1])],
            ],
        })
    });
    let [low, high] = span.unwrap_or([[0, 0], [0, 0]]);
    Changed {
        columns: low[0]..high[0] + 1,
        rows: low[1]..high[1] + 1,
    }
}

fn fault<C: ToString>(path: &Path) -> impl Fn(C) -> FigureError {
    move |cause| FigureError::Description {
        path: path.to_owned(),
        cause: cause.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bar on a gradient, farther to the right in each frame.
    fn frame(at: usize) -> Result<Dots, FigureError> {
        let mut dots = Dots::white([40, 20]);
        for column in 0..40 {
            *dots.dot([column, 3]) = crate::color_map(column as f64 / 39.0);
        }
        for row in 5..15 {
            *dots.dot([4 * at, row]) = [200, 30, 30];
        }
        Ok(dots)
    }

    const ANIMATION: Animation = Animation {
        frames: 5,
        seconds: 0.25,
    };

    fn written(moving: Moving) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("animation");
        ANIMATION.write(&path, moving, frame).unwrap();
        std::fs::read(path).unwrap()
    }

    #[test]
    fn an_animated_png_has_all_frames_to_the_bit() {
        let bytes = written(Moving::Png);
        let mut reader = png::Decoder::new(&bytes[..]).read_info().unwrap();
        let control = *reader.info().animation_control().unwrap();
        assert_eq!((control.num_frames, control.num_plays), (5, 0));
        let mut canvas = Dots::white([40, 20]);
        let mut buffer = vec![0; reader.output_buffer_size()];
        for at in 0..5 {
            reader.next_frame(&mut buffer).unwrap();
            let control = *reader.info().frame_control().unwrap();
            let delay = if at == 4 { 100 } else { 25 };
            assert_eq!((control.delay_num, control.delay_den), (delay, 100));
            let [left, top, width] =
                [control.x_offset, control.y_offset, control.width].map(|side| side as usize);
            for (place, dot) in buffer.chunks_exact(3).enumerate() {
                if place < width * control.height as usize {
                    let to = [left + place % width, top + place / width];
                    *canvas.dot(to) = [dot[0], dot[1], dot[2]];
                }
            }
            assert_eq!(canvas, frame(at).unwrap(), "frame {at}");
        }
    }

    #[test]
    fn a_gif_has_all_frames_but_for_the_rounding_of_colours() {
        let bytes = written(Moving::Gif);
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(&bytes[..]).unwrap();
        assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
        let mut canvas = Dots::white([40, 20]);
        for at in 0..5 {
            let found = decoder.read_next_frame().unwrap().unwrap();
            assert_eq!(found.delay, if at == 4 { 100 } else { 25 });
            let [left, top, width] = [found.left, found.top, found.width].map(usize::from);
            for (place, dot) in found.buffer.chunks_exact(4).enumerate() {
                if dot[3] == 255 {
                    let to = [left + place % width, top + place / width];
                    *canvas.dot(to) = [dot[0], dot[1], dot[2]];
                }
            }
            let expected = frame(at).unwrap();
            for (a, b) in canvas.all().iter().zip(expected.all()) {
                assert!((0..3).all(|c| a[c].abs_diff(b[c]) <= 2), "{a:?} {b:?}");
            }
            assert_eq!(canvas.dot([39, 19]), &[255; 3]);
        }
        assert!(decoder.read_next_frame().unwrap().is_none());
    }

    #[test]
    fn frames_that_cannot_be_drawn_leave_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("animation.gif");
        let refused = |at: usize| match at {
            3 => Err(fault(&path)("no")),
            _ => frame(at),
        };
        for moving in [Moving::Gif, Moving::Png] {
            ANIMATION.write(&path, moving, refused).unwrap_err();
            let none = Animation {
                frames: 0,
                ..ANIMATION
            };
            none.write(&path, moving, frame).unwrap_err();
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn the_extension_states_the_format() {
        let of = |name: &str| Moving::of(Path::new(name));
        assert_eq!(of("a.GIF"), Some(Moving::Gif));
        assert_eq!([of("a.png"), of("a.apng")], [Some(Moving::Png); 2]);
        assert_eq!([of("a.mp4"), of("gif")], [None; 2]);
    }
}
