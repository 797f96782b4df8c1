//! `.vtu` files.
//!
//! Arrays are text, or bytes in base64 within the text or in an appended section, which can be
//! raw. Bytes begin with their number as `UInt32` or `UInt64`, or, where they are compressed,
//! with `blocks, size of a block, size of the last, compressed sizes..` before the blocks. In
//! base64 numbers and blocks are encoded apart, each part ending in padding where it needs
//! some, so that parts are decoded one after the other.

use std::io::Read;

use base64::{Engine, engine::general_purpose::STANDARD};
use flate2::read::ZlibDecoder;
use roxmltree::{Document, Node};

use super::super::lines::quoted;
use super::super::{MeshFileFault, Place};
use super::number::{Number, Order, Values};
use super::{Grid, Named};
use striae_mesh::Vec3;

/// The grid of a file.
pub(super) fn grid(bytes: &[u8]) -> Result<Grid, MeshFileFault> {
    let (text, appended) = parted(bytes);
    let document = Document::parse(&text).map_err(|error| {
        let place = Place::Line(error.pos().row as usize);
        let reason = error.to_string();
        let reason = reason
            .rsplit_once(" at ")
            .map_or(&reason[..], |(reason, _)| reason);
        MeshFileFault::at(place, "XML", format!("invalid text: {reason}"))
    })?;
    let root = document.root_element();
    let file = File::new(root, appended)?;
    let grid = child(root, "UnstructuredGrid")?;
    let piece = child(grid, "Piece")?;
    let mut others = grid.children().filter(|node| node.has_tag_name("Piece"));
    if let Some(second) = others.nth(1) {
        let fault = fault(second, "a single piece", "another one");
        return Err(fault.with_remedy("write the grid into one file as a whole"));
    }
    file.piece(piece)
}

/// Properties shared by all arrays.
struct File<'a> {
    order: Order,
    /// Type of the numbers before the bytes of an array.
    header: Number,
    compression: Compression,
    appended: Option<Appended<'a>>,
}

#[derive(PartialEq)]
enum Compression {
    None,
    Zlib,
}

/// Bytes behind the text.
struct Appended<'a> {
    bytes: &'a [u8],
    encoding: Encoding,
}

#[derive(PartialEq)]
enum Encoding {
    Raw,
    Base64,
}

/// The text without the appended section, and what that holds.
fn parted(bytes: &[u8]) -> (String, Option<Appended<'_>>) {
    const TAG: &[u8] = b"<AppendedData";
    let lossy = |bytes| String::from_utf8_lossy(bytes).into_owned();
    let Some(at) = bytes.windows(TAG.len()).position(|word| word == TAG) else {
        return (lossy(bytes), None);
    };
    let text = lossy(&bytes[..at]) + "</VTKFile>";
    let section = &bytes[at..];
    let end = section.iter().position(|byte| *byte == b'>');
    let (tag, section) = section.split_at(end.unwrap_or(section.len()));
    let tag = String::from_utf8_lossy(tag);
    let begin = section.iter().position(|byte| *byte == b'_');
    let section = &section[begin.map_or(section.len(), |begin| begin + 1)..];
    const END: &[u8] = b"</AppendedData";
    let end = section.windows(END.len()).rposition(|word| word == END);
    let encoding = match tag.contains("base64") {
        true => Encoding::Base64,
        false => Encoding::Raw,
    };
    let bytes = &section[..end.unwrap_or(section.len())];
    (text, Some(Appended { bytes, encoding }))
}

impl<'a> File<'a> {
    fn new(root: Node<'_, '_>, appended: Option<Appended<'a>>) -> Result<Self, MeshFileFault> {
        let kind = root.attribute("type").unwrap_or_default();
        if !root.has_tag_name("VTKFile") || kind != "UnstructuredGrid" {
            let found = format!("`{}` of type `{kind}`", root.tag_name().name());
            return Err(fault(root, "`VTKFile` of type `UnstructuredGrid`", found));
        }
        let order = match root.attribute("byte_order") {
            None | Some("LittleEndian") => Order::Little,
            Some("BigEndian") => Order::Big,
            Some(other) => {
                let expected = "byte order `LittleEndian` or `BigEndian`";
                return Err(fault(root, expected, quoted(other)));
            }
        };
        let header = match root.attribute("header_type") {
            None | Some("UInt32") => Number::U32,
            Some("UInt64") => Number::U64,
            Some(other) => {
                return Err(fault(
                    root,
                    "header type `UInt32` or `UInt64`",
                    quoted(other),
                ));
            }
        };
        let compression = match root.attribute("compressor") {
            None | Some("") => Compression::None,
            Some("vtkZLibDataCompressor") => Compression::Zlib,
            Some(other) => {
                let expected = "compression by `vtkZLibDataCompressor` or none";
                let fault = fault(root, expected, quoted(other));
                return Err(fault.with_remedy("save the grid with zlib or as text"));
            }
        };
        Ok(Self {
            order,
            header,
            compression,
            appended,
        })
    }

    fn piece(&self, piece: Node<'_, '_>) -> Result<Grid, MeshFileFault> {
        let count = |name: &str| -> Result<usize, MeshFileFault> {
            let word = attribute(piece, name)?;
            let count = word.parse();
            count.map_err(|_| fault(piece, format!("a whole number as `{name}`"), quoted(word)))
        };
        let (points, cells) = (count("NumberOfPoints")?, count("NumberOfCells")?);
        let array = child(child(piece, "Points")?, "DataArray")?;
        let positions = self.values(array, points.saturating_mul(3))?.reals();
        let of_cells = child(piece, "Cells")?;
        let named = |name: &str| {
            let mut arrays = arrays(of_cells);
            let array = arrays.find(|array| array.attribute("Name") == Some(name));
            array.ok_or_else(|| fault(of_cells, format!("an array `{name}`"), "none"))
        };
        let ends = self.whole(named("offsets")?, cells)?;
        let codes = self.whole(named("types")?, cells)?;
        let all = ends.last().copied().unwrap_or(0);
        let all = usize::try_from(all).unwrap_or(0);
        Ok(Grid {
            points: (positions.chunks_exact(3).map(Vec3::from_row_slice)).collect(),
            nodes: self.whole(named("connectivity")?, all)?,
            ends,
            codes,
            cell_arrays: self.named(piece, "CellData", cells)?,
            point_arrays: self.named(piece, "PointData", points)?,
        })
    }

    /// Arrays of integers with a value each.
    fn named(
        &self,
        piece: Node<'_, '_>,
        group: &str,
        count: usize,
    ) -> Result<Vec<Named>, MeshFileFault> {
        let groups = piece.children().filter(|node| node.has_tag_name(group));
        let is_single = |array: &Node<'_, '_>| {
            let components = array.attribute("NumberOfComponents").unwrap_or("1");
            let kind = array.attribute("type").and_then(Number::of_xml);
            ["0", "1"].contains(&components) && kind.is_some_and(Number::is_whole)
        };
        let arrays = groups.flat_map(arrays).filter(is_single);
        let arrays = arrays.map(|array| {
            Ok(Named {
                name: attribute(array, "Name")?.to_owned(),
                values: self.whole(array, count)?,
            })
        });
        arrays.collect()
    }

    fn whole(&self, array: Node<'_, '_>, count: usize) -> Result<Vec<i64>, MeshFileFault> {
        let whole = self.values(array, count)?.whole();
        whole.ok_or_else(|| fault(array, "integers", "real numbers"))
    }

    /// The values of an array, so many.
    fn values(&self, array: Node<'_, '_>, count: usize) -> Result<Values, MeshFileFault> {
        let kind = attribute(array, "type")?;
        let number = Number::of_xml(kind);
        let number = number.ok_or_else(|| fault(array, "a type such as `Int64`", quoted(kind)))?;
        let text = array.text().unwrap_or_default();
        let values = match array.attribute("format").unwrap_or("ascii") {
            "ascii" => {
                let values = number.parsed(text.split_ascii_whitespace());
                values.map_err(|word| fault(array, "numbers", quoted(word)))?
            }
            "binary" => {
                let bytes = decoded(text.as_bytes());
                let bytes = bytes.ok_or_else(|| fault(array, "base64", quoted(text.trim())))?;
                number.values(self.order, &self.unpacked(array, &bytes)?)
            }
            "appended" => number.values(self.order, &self.appended(array)?),
            other => {
                let expected = "format `ascii`, `binary` or `appended`";
                return Err(fault(array, expected, quoted(other)));
            }
        };
        if values.len() != count {
            let name = array.attribute("Name").unwrap_or("Points");
            let expected = format!("{count} numbers in array `{name}`");
            return Err(fault(array, expected, values.len().to_string()));
        }
        Ok(values)
    }

    fn appended(&self, array: Node<'_, '_>) -> Result<Vec<u8>, MeshFileFault> {
        let word = attribute(array, "offset")?;
        let section = self.appended.as_ref();
        let section = section.ok_or_else(|| fault(array, "a section `AppendedData`", "none"))?;
        let bytes = word.parse::<usize>().ok();
        let bytes = bytes.and_then(|offset| section.bytes.get(offset..));
        let bytes = bytes.ok_or_else(|| {
            let expected = format!("an offset up to {}", section.bytes.len());
            fault(array, expected, quoted(word))
        })?;
        match section.encoding {
            Encoding::Raw => self.unpacked(array, bytes),
            Encoding::Base64 => {
                let bytes = self.prefix(bytes);
                let decoded = bytes.and_then(decoded);
                let decoded = decoded.ok_or_else(|| fault(array, "base64", "something else"))?;
                self.unpacked(array, &decoded)
            }
        }
    }

    /// Base64 letters that encode the bytes of one array.
    fn prefix<'b>(&self, letters: &'b [u8]) -> Option<&'b [u8]> {
        let encoded = |bytes: usize| bytes.div_ceil(3).checked_mul(4);
        let size = self.header.size();
        let word = |bytes: &[u8], at: usize| {
            let word = bytes.get(size * at..size * (at + 1))?;
            let word = self.header.values(self.order, word).whole()?;
            usize::try_from(*word.first()?).ok()
        };
        let first = decoded(letters.get(..encoded(size)?)?)?;
        let first = word(&first, 0)?;
        if self.compression == Compression::None {
            return letters.get(..encoded(size.checked_add(first)?)?.min(letters.len()));
        }
        let header = encoded(size.checked_mul(first.checked_add(3)?)?)?;
        let sizes = decoded(letters.get(..header)?)?;
        let blocks = (0..first).map(|block| word(&sizes, 3 + block));
        let blocks: usize = blocks.sum::<Option<usize>>()?;
        letters.get(..header.checked_add(encoded(blocks)?)?)
    }

    /// The bytes of an array without the numbers before them, and decompressed.
    fn unpacked(&self, array: Node<'_, '_>, bytes: &[u8]) -> Result<Vec<u8>, MeshFileFault> {
        let damaged = |expected: &str| fault(array, expected, "an array that is damaged");
        let size = self.header.size();
        let word = |at: usize| {
            let begin = at.checked_mul(size)?;
            let word = bytes.get(begin..begin.checked_add(size)?)?;
            let word = self.header.values(self.order, word).whole()?;
            usize::try_from(*word.first()?).ok()
        };
        let short = || damaged("the size of the array");
        let first = word(0).ok_or_else(short)?;
        if self.compression == Compression::None {
            let rest = &bytes[size..];
            let found = rest.len().to_string();
            let rest = rest.get(..first);
            let short = || fault(array, format!("{first} bytes of the array"), found);
            return rest.map(<[u8]>::to_vec).ok_or_else(short);
        }
        let mut all = Vec::new();
        let header = first
            .checked_add(3)
            .and_then(|words| words.checked_mul(size));
        let mut at = header.ok_or_else(short)?;
        let most = word(1).ok_or_else(short)?;
        for block in 0..first {
            let end = word(3 + block).and_then(|length| at.checked_add(length));
            let packed = end.and_then(|end| bytes.get(at..end));
            let packed = packed.ok_or_else(|| damaged("a compressed block"))?;
            let mut decoder = ZlibDecoder::new(packed).take(most as u64);
            let read = decoder.read_to_end(&mut all);
            read.map_err(|_| damaged("a compressed block"))?;
            at += packed.len();
        }
        Ok(all)
    }
}

/// The bytes of a text in base64, of several parts one after the other.
fn decoded(text: &[u8]) -> Option<Vec<u8>> {
    let letters = text.iter().copied();
    let letters: Vec<u8> = letters.filter(|byte| !byte.is_ascii_whitespace()).collect();
    let mut bytes = Vec::with_capacity(letters.len() / 4 * 3);
    let mut begin = 0;
    while begin < letters.len() {
        let rest = &letters[begin..];
        let padding = rest.iter().position(|byte| *byte == b'=');
        // Parts are whole groups of four letters.
        let end = padding.map_or(rest.len(), |at| at / 4 * 4 + 4);
        STANDARD.decode_vec(rest.get(..end)?, &mut bytes).ok()?;
        begin += end;
    }
    Some(bytes)
}

fn arrays<'a, 'b>(group: Node<'a, 'b>) -> impl Iterator<Item = Node<'a, 'b>> {
    let children = group.children();
    children.filter(|node| node.has_tag_name("DataArray"))
}

fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Result<Node<'a, 'b>, MeshFileFault> {
    let mut children = node.children();
    let child = children.find(|child| child.has_tag_name(name));
    child.ok_or_else(|| fault(node, format!("an element `{name}`"), "none"))
}

fn attribute<'a>(node: Node<'a, '_>, name: &str) -> Result<&'a str, MeshFileFault> {
    let value = node.attribute(name);
    value.ok_or_else(|| fault(node, format!("an attribute `{name}`"), "none"))
}

/// A fault at an element of the text.
fn fault(
    node: Node<'_, '_>,
    expected: impl Into<String>,
    found: impl Into<String>,
) -> MeshFileFault {
    let at = node.document().text_pos_at(node.range().start);
    MeshFileFault::at(Place::Line(at.row as usize), expected, found)
}
