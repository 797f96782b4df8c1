//! Reads files that [`write`](super::write) made: arrays by name, each decompressed on request.
//!
//! Cells may be of any of VTK's types; see [`Stored::cells`]. Files of other programs are
//! read as far as they are of the same form: one piece, raw appended arrays in blocks
//! compressed by zlib, `UInt64` headers, little endian. Pieces are put together by the numbers
//! of their points and cells.

use std::{io::Read, path::Path};

use flate2::read::ZlibDecoder;

use super::{
    stored::{StoredCells, StoredValues},
    together::{ELEMENT, Joint, NODE},
};
use crate::OutputError;
use striae_files::{FileError, read_text};

/// Beginning of the appended section.
const SECTION: &[u8] = b"<AppendedData encoding=\"raw\">";

/// A grid in a file, or in the pieces that a `.pvtu` file names.
pub struct Stored {
    /// The file, or the pieces.
    files: Vec<OneFile>,
    /// Joint of the pieces; `None` if there is one file.
    joint: Option<Joint>,
    /// Time of the state.
    pub time: f64,
}

/// One file.
struct OneFile {
    bytes: Vec<u8>,
    /// Start of the appended section, behind its underscore.
    section: usize,
    arrays: Vec<Described>,
    time: f64,
}

/// Description of an array in the text of a file.
struct Described {
    /// `Points`, `Cells`, `PointData` or `CellData`.
    group: String,
    name: String,
    number: String,
    components: usize,
    offset: usize,
}

impl Stored {
    /// Reads the text of a file, or of all pieces; arrays are read on request.
    ///
    /// # Errors
    /// When a file cannot be read or is of another form.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        if path.extension().is_none_or(|end| end != "pvtu") {
            let file = OneFile::open(path)?;
            return Ok(Self {
                time: file.time,
                files: vec![file],
                joint: None,
            });
        }
        let text = read_text(path)?;
        let pieces = text.split('<').filter(|tag| tag.starts_with("Piece "));
        let pieces = pieces.filter_map(|tag| attribute(tag, "Source"));
        let files = pieces.map(|source| OneFile::open(&path.with_file_name(plain(source))));
        let files: Vec<OneFile> = files.collect::<Result<_, _>>()?;
        let numbers = |group: &str, name: &str| {
            let files = files.iter();
            let of = files.map(|file| Ok(file.found(group, Some(name))?.numbers));
            of.collect::<Result<Vec<_>, String>>()
        };
        let nodes = numbers("PointData", NODE).map_err(content(path))?;
        let elements = numbers("CellData", ELEMENT).map_err(content(path))?;
        let first = files.first().ok_or_else(|| "no piece".to_owned());
        Ok(Self {
            time: first.map_err(content(path))?.time,
            joint: Some(Joint::new(&nodes, &elements)),
            files,
        })
    }

    /// Names of the arrays with a value a point, and their numbers a point.
    pub fn names(&self) -> impl Iterator<Item = (&str, usize)> {
        let arrays = self.files.first().map_or(&[][..], |file| &file.arrays);
        let points = arrays.iter().filter(|array| array.group == "PointData");
        let named = points.map(|array| (array.name.as_str(), array.components));
        named.filter(|(name, _)| *name != NODE || self.joint.is_none())
    }

    /// Positions of the points.
    ///
    /// # Errors
    /// When the array is missing or damaged.
    pub fn points(&self, path: &Path) -> Result<Vec<[f64; 3]>, OutputError> {
        let values = self.at_points("Points", None).map_err(content(path))?;
        let rows = values.numbers.chunks_exact(3);
        Ok(rows.map(|row| [row[0], row[1], row[2]]).collect())
    }

    /// The cells.
    ///
    /// # Errors
    /// When an array is missing or damaged.
    pub fn cells(&self, path: &Path) -> Result<StoredCells, OutputError> {
        let cells = self.files.iter().map(OneFile::cells);
        let cells: Vec<StoredCells> = cells.collect::<Result<_, _>>().map_err(content(path))?;
        Ok(match &self.joint {
            Some(joint) => joint.cells(&cells),
            None => cells.into_iter().next().unwrap_or_default(),
        })
    }

    /// An array with a value a point; `None` if there is none of that name.
    ///
    /// # Errors
    /// When it is damaged.
    pub fn array(&self, path: &Path, name: &str) -> Result<Option<StoredValues>, OutputError> {
        if self.files.iter().any(|file| !file.has("PointData", name)) {
            return Ok(None);
        }
        let values = self.at_points("PointData", Some(name));
        values.map(Some).map_err(content(path))
    }

    /// An array with a value a cell; `None` if there is none of that name.
    ///
    /// # Errors
    /// When it is damaged.
    pub fn cell_array(&self, path: &Path, name: &str) -> Result<Option<StoredValues>, OutputError> {
        if self.files.iter().any(|file| !file.has("CellData", name)) {
            return Ok(None);
        }
        let values = self.of_files("CellData", Some(name));
        let mut values = values.map_err(content(path))?;
        Ok(match &self.joint {
            Some(joint) => Some(joint.in_cells(&values)),
            None => values.pop(),
        })
    }

    fn at_points(&self, group: &str, name: Option<&str>) -> Result<StoredValues, String> {
        let mut values = self.of_files(group, name)?;
        match &self.joint {
            Some(joint) => Ok(joint.at_points(&values)),
            None => values.pop().ok_or_else(|| "no file".to_owned()),
        }
    }

    fn of_files(&self, group: &str, name: Option<&str>) -> Result<Vec<StoredValues>, String> {
        let files = self.files.iter();
        files.map(|file| file.found(group, name)).collect()
    }
}

impl OneFile {
    fn open(path: &Path) -> Result<Self, OutputError> {
        let bytes = std::fs::read(path).map_err(|cause| FileError::Read {
            path: path.to_owned(),
            cause,
        })?;
        Self::of(bytes).map_err(content(path))
    }

    fn of(bytes: Vec<u8>) -> Result<Self, String> {
        let tag = position(&bytes, SECTION).ok_or("no raw appended section")?;
        let after = tag + SECTION.len();
        let underscore = bytes[after..].iter().position(|byte| *byte == b'_');
        let section = after + underscore.ok_or("no raw appended section")? + 1;
        let text = std::str::from_utf8(&bytes[..tag]).map_err(|cause| cause.to_string())?;
        for (name, expected) in [
            ("header_type", "UInt64"),
            ("byte_order", "LittleEndian"),
            ("compressor", "vtkZLibDataCompressor"),
        ] {
            let found = attribute(text, name).unwrap_or_default();
            if found != expected {
                return Err(format!("`{name}` is `{found}`, not `{expected}`"));
            }
        }
        let (arrays, time) = described(text)?;
        Ok(Self {
            arrays,
            time,
            section,
            bytes,
        })
    }

    fn cells(&self) -> Result<StoredCells, String> {
        let whole = |name| {
            let numbers = self.found("Cells", Some(name))?.numbers;
            Ok::<_, String>(numbers.into_iter().map(|number| number as usize))
        };
        let cells = StoredCells {
            corners: whole("connectivity")?.collect(),
            ends: whole("offsets")?.collect(),
            shapes: whole("types")?.map(|code| code as u8).collect(),
        };
        let sound = cells.ends.is_sorted()
            && cells.ends.last().copied().unwrap_or(0) == cells.corners.len()
            && cells.ends.len() == cells.shapes.len();
        match sound {
            true => Ok(cells),
            false => Err("the cell arrays do not match".to_owned()),
        }
    }

    fn has(&self, group: &str, name: &str) -> bool {
        let mut arrays = self.arrays.iter();
        arrays.any(|array| array.group == group && array.name == name)
    }

    fn found(&self, group: &str, name: Option<&str>) -> Result<StoredValues, String> {
        let fits =
            |array: &&Described| array.group == group && name.is_none_or(|name| array.name == name);
        let found = self.arrays.iter().find(fits);
        let array = found.ok_or_else(|| format!("no array `{}`", name.unwrap_or(group)))?;
        let damaged = || format!("array `{}` is damaged", array.name);
        let bytes = inflated(&self.bytes, self.section + array.offset).ok_or_else(damaged)?;
        let numbers = numbers(&array.number, &bytes)
            .ok_or_else(|| format!("array `{}` is of type `{}`", array.name, array.number))?;
        Ok(StoredValues {
            components: array.components,
            numbers,
        })
    }
}

/// Reads a collection.
///
/// # Errors
/// When the file cannot be read or is of another form.
pub fn read_series(path: &Path) -> Result<Vec<super::Snapshot>, OutputError> {
    let text = read_text(path)?;
    let mut snapshots: Vec<super::Snapshot> = Vec::new();
    for tag in text.split('<').filter(|tag| tag.starts_with("DataSet ")) {
        let word = |name| attribute(tag, name).ok_or_else(|| format!("an entry without `{name}`"));
        let entry = || {
            let time = word("timestep")?;
            let time: f64 = time
                .parse()
                .map_err(|_| format!("`{time}` is not a time"))?;
            Ok((time, plain(word("name")?), plain(word("file")?)))
        };
        let (time, name, file) = entry().map_err(content(path))?;
        match snapshots.last_mut() {
            Some(last) if last.time == time && last.parts.iter().all(|(n, _)| *n != name) => {
                last.parts.push((name, file.into()));
            }
            _ => snapshots.push(super::Snapshot {
                time,
                parts: vec![(name, file.into())],
            }),
        }
    }
    Ok(snapshots)
}

fn content(path: &Path) -> impl Fn(String) -> OutputError {
    move |cause| OutputError::Content {
        path: path.to_owned(),
        cause,
    }
}

fn described(text: &str) -> Result<(Vec<Described>, f64), String> {
    let (mut arrays, mut group, mut time) = (Vec::new(), String::new(), 0.0);
    for tag in text.split('<').skip(1) {
        let name = tag.split([' ', '>', '/']).next().unwrap_or_default();
        match name {
            "Points" | "Cells" | "PointData" | "CellData" => group = name.to_owned(),
            "DataArray" if attribute(tag, "Name") == Some("TimeValue") => {
                let value = tag.split('>').nth(1).unwrap_or_default().trim();
                time = value
                    .parse()
                    .map_err(|_| format!("`{value}` is not a time"))?;
            }
            "DataArray" => {
                let word = |name| attribute(tag, name).ok_or(format!("an array without `{name}`"));
                let whole = |name| {
                    let word = word(name)?;
                    word.parse()
                        .map_err(|_| format!("`{word}` is not a valid `{name}`"))
                };
                arrays.push(Described {
                    group: group.clone(),
                    name: plain(word("Name")?),
                    number: word("type")?.to_owned(),
                    components: whole("NumberOfComponents")?,
                    offset: whole("offset")?,
                });
            }
            _ => {}
        }
    }
    Ok((arrays, time))
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let after = tag.split_once(&format!(" {name}=\""))?.1;
    Some(after.split_once('"')?.0)
}

/// Text without XML's escapes.
fn plain(text: &str) -> String {
    text.replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&apos;", "'")
        .replace("&amp;", "&")
}

fn position(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes
        .windows(wanted.len())
        .position(|window| window == wanted)
}

fn inflated(bytes: &[u8], start: usize) -> Option<Vec<u8>> {
    let word = |index: usize| {
        let at = start.checked_add(8 * index)?;
        let word = bytes.get(at..at + 8)?;
        usize::try_from(u64::from_le_bytes(word.try_into().ok()?)).ok()
    };
    let blocks = word(0)?;
    let mut at = start + 8 * (3 + blocks);
    let mut all = Vec::new();
    for block in 0..blocks {
        let end = at.checked_add(word(3 + block)?)?;
        let mut decoder = ZlibDecoder::new(bytes.get(at..end)?);
        decoder.read_to_end(&mut all).ok()?;
        at = end;
    }
    Some(all)
}

fn numbers(kind: &str, bytes: &[u8]) -> Option<Vec<f64>> {
    macro_rules! words {
        ($type:ty) => {{
            let words = bytes.as_chunks::<{ size_of::<$type>() }>().0.iter();
            words
                .map(|word| <$type>::from_le_bytes(*word) as f64)
                .collect()
        }};
    }
    Some(match kind {
        "Float64" => words!(f64),
        "Float32" => words!(f32),
        "Int64" => words!(i64),
        "Int32" => words!(i32),
        "UInt8" => words!(u8),
        _ => return None,
    })
}
