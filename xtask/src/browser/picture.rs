//! Pictures of the page, as PNG in base64.

use std::{fs, path::Path};

use crate::fault::Fault;

/// A part of the page as it looks.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// PNG.
    pub file: Vec<u8>,
    /// RGB, row by row.
    pub pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// A picture in base64.
    ///
    /// # Errors
    /// When it is none.
    pub fn new(text: &str) -> Result<Self, Fault> {
        let none = || Fault::Browser("the browser's picture cannot be read".into());
        let file = bytes(text).ok_or_else(none)?;
        let mut reader = png::Decoder::new(&file[..])
            .read_info()
            .map_err(|_| none())?;
        let mut buffer = vec![0; reader.output_buffer_size()];
        let info = reader.next_frame(&mut buffer).map_err(|_| none())?;
        let wide = info.color_type.samples();
        let pixels = buffer[..info.buffer_size()].chunks_exact(wide);
        let pixels = pixels.map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        Ok(Self { file, pixels })
    }

    /// Keeps it on disk.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn keep(&self, path: &Path) -> Result<(), Fault> {
        fs::write(path, &self.file).map_err(|cause| Fault::Browser(cause.to_string()))
    }

    /// Share of pixels with a clear colour.
    pub fn colored(&self) -> f64 {
        self.share(|pixel, _| {
            let [low, high] = [pixel.iter().min(), pixel.iter().max()];
            high.zip(low).is_some_and(|(high, low)| high - low > 50)
        })
    }

    /// Share of pixels that differ from another picture.
    pub fn differs(&self, other: &Self) -> f64 {
        self.share(|pixel, at| {
            let Some(other) = other.pixels.get(at) else {
                return true;
            };
            pixel.iter().zip(other).any(|(a, b)| a.abs_diff(*b) > 12)
        })
    }

    fn share(&self, counts: impl Fn(&[u8; 3], usize) -> bool) -> f64 {
        let counted = self
            .pixels
            .iter()
            .enumerate()
            .filter(|(at, pixel)| counts(pixel, *at));
        counted.count() as f64 / self.pixels.len().max(1) as f64
    }
}

/// Bytes from base64 (RFC 4648).
fn bytes(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut word, mut bits) = (0_u32, 0);
    for letter in text.bytes().filter(|letter| *letter != b'=') {
        let six = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        };
        word = word << 6 | u32::from(six);
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((word >> bits) as u8);
            word &= (1 << bits) - 1;
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        for (plain, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(bytes(text).unwrap(), plain.as_bytes());
        }
        assert_eq!(bytes("?"), None);
    }
}
