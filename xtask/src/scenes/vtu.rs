//! Reads VTK XML unstructured grids with raw appended data.
//!
//! After `<AppendedData encoding="raw">` and an underscore, arrays stand one after the
//! other at the offsets that their elements name. Compressed, an array is
//!
//! ```text
//! blocks | bytes of a full block | bytes of a partial last block, or 0 | compressed bytes of block 1 | ...
//! ```
//!
//! in numbers of the header's type, then its blocks, each a zlib stream; uncompressed,
//! the count of its bytes and these. Source: VTK File Formats, "XML File Formats",
//! docs.vtk.org. All numbers are read as `f64`.

use std::{collections::BTreeMap, fs, io::Read, path::Path};

use flate2::read::ZlibDecoder;

use super::vector::Vector;

/// A grid with its results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Positions of the points.
    pub points: Vec<Vector>,
    /// Points of every cell.
    pub cells: Vec<Vec<usize>>,
    arrays: BTreeMap<String, Array>,
}

#[derive(Clone, Debug, PartialEq)]
struct Array {
    components: usize,
    values: Vec<f64>,
}

impl Grid {
    /// Reads a file.
    ///
    /// # Errors
    /// Returns the fault of the file, in words.
    pub fn read(path: &Path) -> Result<Self, String> {
        let bytes = fs::read(path).map_err(|cause| format!("{}: {cause}", path.display()))?;
        Self::of(&bytes).map_err(|wrong| format!("{}: {wrong}", path.display()))
    }

    /// Reads the content of a file.
    ///
    /// # Errors
    /// Returns the fault of the content, in words.
    pub fn of(bytes: &[u8]) -> Result<Self, String> {
        let section = position(bytes, b"<AppendedData").ok_or("there are no appended data")?;
        let underscore = position(&bytes[section..], b"_").ok_or("the data do not begin")?;
        let appended = &bytes[section + underscore + 1..];
        let text = String::from_utf8_lossy(&bytes[..section]);
        let file = tags(&text, "VTKFile")
            .next()
            .ok_or("this is not a VTK file")?;
        let reader = Reader {
            appended,
            compressed: attribute(file, "compressor").is_some(),
            wide: attribute(file, "header_type") == Some("UInt64"),
        };
        let mut grid = Self::default();
        let mut cells = [Vec::new(), Vec::new()];
        for tag in tags(&text, "DataArray") {
            if attribute(tag, "format") != Some("appended") {
                continue;
            }
            let name = attribute(tag, "Name").unwrap_or("Points");
            let array = reader
                .array(tag)
                .map_err(|wrong| format!("array `{name}`: {wrong}"))?;
            match name {
                "Points" => grid.points = vectors(&array.values),
                "connectivity" => cells[0] = whole(&array.values),
                "offsets" => cells[1] = whole(&array.values),
                _ => {
                    grid.arrays.insert(name.to_owned(), array);
                }
            }
        }
        let [corners, ends] = cells;
        let mut start = 0;
        for end in ends {
            let cell = corners
                .get(start..end)
                .ok_or("a cell ends before it begins")?;
            if cell.iter().any(|&corner| corner >= grid.points.len()) {
                return Err("a cell has a point that is not there".into());
            }
            grid.cells.push(cell.to_vec());
            start = end;
        }
        Ok(grid)
    }

    /// A grid without arrays.
    #[cfg(test)]
    pub fn plain(points: Vec<Vector>, cells: Vec<Vec<usize>>) -> Self {
        Self {
            points,
            cells,
            arrays: BTreeMap::new(),
        }
    }

    /// Grid with one more array.
    #[cfg(test)]
    pub fn with(mut self, name: &str, components: usize, values: Vec<f64>) -> Self {
        self.arrays
            .insert(name.to_owned(), Array { components, values });
        self
    }

    /// One number a point, if there is such an array.
    pub fn scalars(&self, name: &str) -> Option<&[f64]> {
        let array = self.arrays.get(name)?;
        (array.components == 1 && array.values.len() == self.points.len())
            .then_some(&array.values[..])
    }

    /// One vector a point, if there is such an array.
    pub fn vectors(&self, name: &str) -> Option<Vec<Vector>> {
        let array = self.arrays.get(name)?;
        (array.components == 3 && array.values.len() == 3 * self.points.len())
            .then(|| vectors(&array.values))
    }

    /// Numbers of an array, or lengths of its vectors; none without such an array.
    pub fn sizes(&self, name: &str) -> Vec<f64> {
        let length = |vector: &[f64]| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        match self.arrays.get(name) {
            Some(array) if array.components == 1 => array.values.clone(),
            Some(array) => array.values.chunks(array.components).map(length).collect(),
            None => Vec::new(),
        }
    }

    /// Returns whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        let finite = |array: &Array| array.values.iter().all(|x| x.is_finite());
        self.points.iter().flatten().all(|x| x.is_finite()) && self.arrays.values().all(finite)
    }

    /// Position of the points of a cell.
    pub fn corners(&self, cell: usize) -> Vec<Vector> {
        self.cells[cell].iter().map(|&i| self.points[i]).collect()
    }
}

/// The appended section and how it is written.
struct Reader<'a> {
    appended: &'a [u8],
    compressed: bool,
    wide: bool,
}

impl Reader<'_> {
    fn array(&self, tag: &str) -> Result<Array, String> {
        let number = |name| attribute(tag, name).and_then(|text| text.parse::<usize>().ok());
        let offset = number("offset").ok_or("it has no offset")?;
        let bytes = self.bytes(offset)?;
        let kind = attribute(tag, "type").ok_or("it has no type")?;
        Ok(Array {
            components: number("NumberOfComponents").unwrap_or(1),
            values: numbers(kind, &bytes)?,
        })
    }

    fn bytes(&self, offset: usize) -> Result<Vec<u8>, String> {
        const SHORT: &str = "its data end too early";
        if !self.compressed {
            let count = self.count(offset, 0)?;
            let start = offset + self.width();
            let end = start.checked_add(count).ok_or(SHORT)?;
            return Ok(self.appended.get(start..end).ok_or(SHORT)?.to_vec());
        }
        let blocks = self.count(offset, 0)?;
        let mut start = offset + (3 + blocks) * self.width();
        let mut all = Vec::new();
        for block in 0..blocks {
            let end = start + self.count(offset, 3 + block)?;
            let packed = self.appended.get(start..end).ok_or(SHORT)?;
            ZlibDecoder::new(packed)
                .read_to_end(&mut all)
                .map_err(|cause| cause.to_string())?;
            start = end;
        }
        Ok(all)
    }

    fn width(&self) -> usize {
        if self.wide { 8 } else { 4 }
    }

    fn count(&self, offset: usize, index: usize) -> Result<usize, String> {
        let start = offset + index * self.width();
        let bytes = self.appended.get(start..start + self.width());
        let bytes = bytes.ok_or("its header ends too early")?;
        let little = bytes
            .iter()
            .rev()
            .fold(0u64, |sum, &b| (sum << 8) | u64::from(b));
        usize::try_from(little).map_err(|_| "its header is too large".into())
    }
}

fn numbers(kind: &str, bytes: &[u8]) -> Result<Vec<f64>, String> {
    macro_rules! read {
        ($number:ty) => {{
            let (chunks, rest) = bytes.as_chunks::<{ size_of::<$number>() }>();
            if !rest.is_empty() {
                return Err("its length is not a multiple of its numbers'".into());
            }
            Ok(chunks
                .iter()
                .map(|&chunk| <$number>::from_le_bytes(chunk) as f64)
                .collect())
        }};
    }
    match kind {
        "Float64" => read!(f64),
        "Float32" => read!(f32),
        "Int64" => read!(i64),
        "Int32" => read!(i32),
        "UInt64" => read!(u64),
        "UInt32" => read!(u32),
        "UInt8" => read!(u8),
        "Int8" => read!(i8),
        _ => Err(format!("numbers of the kind {kind} are not read")),
    }
}

/// The tags of an element: what stands between its name and the bracket.
fn tags<'a>(text: &'a str, name: &str) -> impl Iterator<Item = &'a str> {
    let start = format!("<{name} ");
    text.match_indices(&start)
        .map(|(at, _)| &text[at..])
        .map(|rest| rest.split('>').next().unwrap_or(rest))
        .collect::<Vec<_>>()
        .into_iter()
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let start = tag.find(&format!(" {name}=\""))? + name.len() + 3;
    tag[start..].split('"').next()
}

fn position(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes
        .windows(wanted.len())
        .position(|window| window == wanted)
}

fn vectors(values: &[f64]) -> Vec<Vector> {
    values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect()
}

fn whole(values: &[f64]) -> Vec<usize> {
    values.iter().map(|&x| x as usize).collect()
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::{Compression, write::ZlibEncoder};

    use super::*;

    /// A triangle whose arrays are packed in blocks of 40 bytes.
    fn triangle(packed: bool) -> Vec<u8> {
        let points: Vec<u8> = (0..9).flat_map(|i| f64::from(i).to_le_bytes()).collect();
        let corners: Vec<u8> = [2i64, 0, 1]
            .into_iter()
            .flat_map(i64::to_le_bytes)
            .collect();
        let ends = 3i64.to_le_bytes().to_vec();
        let status = vec![0u8, 2, 1];
        let mut appended = Vec::new();
        let mut offsets = Vec::new();
        for raw in [points, corners, ends, status] {
            offsets.push(appended.len());
            if packed {
                appended.extend(in_blocks(&raw));
            } else {
                appended.extend((raw.len() as u64).to_le_bytes());
                appended.extend(raw);
            }
        }
        let compressor = if packed {
            " compressor=\"vtkZLibDataCompressor\""
        } else {
            ""
        };
        let array = |kind: &str, name: &str, count: usize, index: usize| {
            let offset = offsets[index];
            format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{count}\" \
                 format=\"appended\" offset=\"{offset}\"/>"
            )
        };
        let mut file = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\"{compressor}>\n\
             {}{}{}{}<AppendedData encoding=\"raw\">\n _",
            array("Float64", "Points", 3, 0),
            array("Int64", "connectivity", 1, 1),
            array("Int64", "offsets", 1, 2),
            array("UInt8", "status", 1, 3),
        )
        .into_bytes();
        file.extend(appended);
        file.extend(b"\n</AppendedData></VTKFile>");
        file
    }

    fn in_blocks(raw: &[u8]) -> Vec<u8> {
        const BLOCK: usize = 40;
        let blocks: Vec<Vec<u8>> = raw
            .chunks(BLOCK)
            .map(|block| {
                let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
                encoder.write_all(block).unwrap();
                encoder.finish().unwrap()
            })
            .collect();
        let header = [blocks.len(), BLOCK, raw.len() % BLOCK];
        let numbers = header.into_iter().chain(blocks.iter().map(Vec::len));
        let mut all: Vec<u8> = numbers.flat_map(|n| (n as u64).to_le_bytes()).collect();
        all.extend(blocks.into_iter().flatten());
        all
    }

    #[test]
    fn grids_are_read_packed_and_plain() {
        for packed in [true, false] {
            let grid = Grid::of(&triangle(packed)).unwrap();
            let points = [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0], [6.0, 7.0, 8.0]];
            assert_eq!(grid.points, points);
            assert_eq!(grid.cells, [[2, 0, 1]]);
            assert_eq!(grid.scalars("status").unwrap(), [0.0, 2.0, 1.0]);
            assert_eq!(grid.scalars("pressure"), None);
            assert_eq!(grid.corners(0), [points[2], points[0], points[1]]);
        }
    }

    #[test]
    fn a_file_that_ends_early_is_refused() {
        let whole = triangle(true);
        let found = Grid::of(&whole[..whole.len() - 40]);
        assert!(found.is_err(), "{found:?}");
    }
}
