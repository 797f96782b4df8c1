//! Grids of VTK in all their encodings, whole and broken.
//!
//! Longer than other files, as it writes each encoding itself before it breaks it.

use super::block;
use crate::vtk::{legacy_body, xml_body};
use base64::{Engine, engine::general_purpose::STANDARD};
use flate2::{Compression, write::ZlibEncoder};
use proptest::prelude::*;
use std::fmt::Write as _;
use std::io::Write as _;
use striae_mesh::generate::Block;
use striae_mesh::{CellKind, Mesh, NodeId};

/// A grid as it is written.
struct Grid {
    points: Vec<f64>,
    connectivity: Vec<i64>,
    offsets: Vec<i64>,
    types: Vec<i64>,
    /// 1 and 2 in the lower and upper half, 10 and more on facets of the sets in their order.
    material: Vec<i64>,
    /// 1 at the first node, 0 at all others.
    first: Vec<i64>,
}

/// Triangle of a wedge that comes first.
#[derive(Clone, Copy)]
enum Wedge {
    Inward,
    Outward,
}

impl Grid {
    fn new(mesh: &Mesh, wedge: Wedge) -> Self {
        let mut grid = Self {
            points: mesh
                .positions
                .iter()
                .flat_map(|x| [x.x, x.y, x.z])
                .collect(),
            connectivity: Vec::new(),
            offsets: Vec::new(),
            types: Vec::new(),
            material: Vec::new(),
            first: vec![0; mesh.positions.len()],
        };
        grid.first[0] = 1;
        let lower = mesh.element_sets.get("lower half").unwrap_or_default();
        for (at, corners) in mesh.elements().enumerate() {
            let mut corners = corners.to_vec();
            let kind = mesh.kind(striae_mesh::ElementId::new(at));
            if let (CellKind::Wedge, Wedge::Outward) = (kind, wedge) {
                corners.swap(1, 2);
                corners.swap(4, 5);
            }
            let code = match kind {
                CellKind::Tetrahedron => 10,
                CellKind::Hexahedron => 12,
                CellKind::Wedge => 13,
                CellKind::Pyramid => 14,
                CellKind::CompositeTetrahedron => 24,
            };
            let is_lower = lower.iter().any(|id| id.index() == at);
            grid.add(code, &corners, if is_lower { 1 } else { 2 });
        }
        let each = mesh.blocks[0].kind.shape().faces_a_side;
        for (value, (_, faces)) in (10..).zip(mesh.facet_sets.iter()) {
            for side in faces.chunks(each) {
                match (each, mesh.face_nodes(side[0])) {
                    (4, [a, ab, ca, _]) => {
                        let [_, b, bc, _] = mesh.face_nodes(side[1]);
                        let c = mesh.face_nodes(side[2])[2];
                        grid.add(22, &[a, b, c, ab, bc, ca], value);
                    }
                    (_, [a, b, c, d]) if c == d => grid.add(5, &[a, b, c], value),
                    (_, corners) => grid.add(9, &corners, value),
                }
            }
        }
        grid
    }

    fn add(&mut self, code: i64, corners: &[NodeId], material: i64) {
        self.connectivity
            .extend(corners.iter().map(|id| i64::from(id.0)));
        self.offsets.push(self.connectivity.len() as i64);
        self.types.push(code);
        self.material.push(material);
    }
}

/// Encoding of a file.
#[derive(Clone, Copy, Debug)]
struct How {
    format: Format,
    /// Bytes of the numbers before an array.
    header: usize,
    big: bool,
    zlib: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Ascii,
    Inline,
    Raw,
    Base64,
}

impl How {
    const ASCII: Self = Self {
        format: Format::Ascii,
        header: 4,
        big: false,
        zlib: false,
    };

    fn all() -> Vec<Self> {
        let mut all = vec![Self::ASCII];
        for format in [Format::Inline, Format::Raw, Format::Base64] {
            for (header, big, zlib) in [
                (4, false, false),
                (8, false, true),
                (8, true, false),
                (4, true, true),
            ] {
                all.push(Self {
                    format,
                    header,
                    big,
                    zlib,
                });
            }
        }
        all
    }

    fn word<const N: usize>(self, little: [u8; N]) -> Vec<u8> {
        let mut bytes = little.to_vec();
        if self.big {
            bytes.reverse();
        }
        bytes
    }

    fn size(self, size: usize) -> Vec<u8> {
        match self.header {
            4 => self.word((size as u32).to_le_bytes()),
            _ => self.word((size as u64).to_le_bytes()),
        }
    }

    /// The parts of an array that are encoded apart.
    fn parts(self, bytes: &[u8]) -> [Vec<u8>; 2] {
        const BLOCK: usize = 100;
        if !self.zlib {
            let mut all = self.size(bytes.len());
            all.extend(bytes);
            return [all, Vec::new()];
        }
        let blocks: Vec<Vec<u8>> = (bytes.chunks(BLOCK))
            .map(|block| {
                let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
                encoder.write_all(block).unwrap();
                encoder.finish().unwrap()
            })
            .collect();
        let mut header = self.size(blocks.len());
        header.extend(self.size(BLOCK));
        header.extend(self.size(bytes.len() % BLOCK));
        blocks
            .iter()
            .for_each(|block| header.extend(self.size(block.len())));
        [header, blocks.concat()]
    }

    fn array(self, name: &str, numbers: &Numbers<'_>, xml: &mut String, appended: &mut Vec<u8>) {
        let (kind, text, bytes): (_, String, Vec<u8>) = match numbers {
            Numbers::Real(numbers) => (
                "Float64",
                numbers.iter().map(|x| format!("{x} ")).collect(),
                numbers
                    .iter()
                    .flat_map(|x| self.word(x.to_le_bytes()))
                    .collect(),
            ),
            Numbers::Long(numbers) => (
                "Int64",
                numbers.iter().map(|x| format!("{x}\n")).collect(),
                numbers
                    .iter()
                    .flat_map(|x| self.word(x.to_le_bytes()))
                    .collect(),
            ),
            Numbers::Short(numbers) => (
                "UInt8",
                numbers.iter().map(|x| format!("{x} ")).collect(),
                numbers.iter().map(|x| *x as u8).collect(),
            ),
        };
        let components = if name == "Points" { 3 } else { 1 };
        let _ = write!(
            xml,
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" "
        );
        let _ = match self.format {
            Format::Ascii => writeln!(xml, "format=\"ascii\">\n{text}\n</DataArray>"),
            Format::Inline => {
                let text: String = self
                    .parts(&bytes)
                    .map(|part| STANDARD.encode(part))
                    .concat();
                writeln!(xml, "format=\"binary\">\n  {text}\n</DataArray>")
            }
            Format::Raw | Format::Base64 => {
                let offset = appended.len();
                for part in self.parts(&bytes) {
                    match self.format {
                        Format::Raw => appended.extend(part),
                        _ => appended.extend(STANDARD.encode(part).into_bytes()),
                    }
                }
                writeln!(xml, "format=\"appended\" offset=\"{offset}\"/>")
            }
        };
    }
}

enum Numbers<'a> {
    Real(&'a [f64]),
    Long(&'a [i64]),
    Short(&'a [i64]),
}

fn vtu(grid: &Grid, how: How) -> Vec<u8> {
    let (mut xml, mut appended) = (String::from("<?xml version=\"1.0\"?>\n"), Vec::new());
    let order = if how.big { "BigEndian" } else { "LittleEndian" };
    let header = if how.header == 4 { "UInt32" } else { "UInt64" };
    let compressor = match how.zlib {
        true => " compressor=\"vtkZLibDataCompressor\"",
        false => "",
    };
    let _ = writeln!(
        xml,
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{order}\" \
         header_type=\"{header}\"{compressor}>\n<UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">",
        grid.points.len() / 3,
        grid.types.len()
    );
    let mut section = |name: &str, arrays: &[(&str, Numbers<'_>)]| {
        let _ = writeln!(xml, "<{name}>");
        for (name, numbers) in arrays {
            how.array(name, numbers, &mut xml, &mut appended);
        }
        let _ = writeln!(xml, "</{name}>");
    };
    section("PointData", &[("first", Numbers::Short(&grid.first))]);
    section("CellData", &[("material", Numbers::Long(&grid.material))]);
    section("Points", &[("Points", Numbers::Real(&grid.points))]);
    section(
        "Cells",
        &[
            ("connectivity", Numbers::Long(&grid.connectivity)),
            ("offsets", Numbers::Long(&grid.offsets)),
            ("types", Numbers::Short(&grid.types)),
        ],
    );
    xml += "</Piece>\n</UnstructuredGrid>\n";
    let mut bytes = xml.into_bytes();
    if matches!(how.format, Format::Raw | Format::Base64) {
        let encoding = if how.format == Format::Raw {
            "raw"
        } else {
            "base64"
        };
        bytes.extend(format!("<AppendedData encoding=\"{encoding}\">\n_").into_bytes());
        bytes.extend(appended);
        bytes.extend(b"\n</AppendedData>\n");
    }
    bytes.extend(b"</VTKFile>\n");
    bytes
}

fn vtk(grid: &Grid, version: &str, binary: bool) -> Vec<u8> {
    let mut bytes = format!(
        "# vtk DataFile Version {version}\na grid\n{}\nDATASET UNSTRUCTURED_GRID\n",
        if binary { "BINARY" } else { "ASCII" }
    )
    .into_bytes();
    let mut put = |head: String, numbers: &Numbers<'_>| {
        bytes.extend(head.into_bytes());
        match numbers {
            Numbers::Real(numbers) => numbers.iter().for_each(|x| match binary {
                true => bytes.extend(x.to_be_bytes()),
                false => bytes.extend(format!("{x} ").into_bytes()),
            }),
            Numbers::Long(numbers) => numbers.iter().for_each(|x| match binary {
                true => bytes.extend(x.to_be_bytes()),
                false => bytes.extend(format!("{x}\n").into_bytes()),
            }),
            Numbers::Short(numbers) => numbers.iter().for_each(|x| match binary {
                true => bytes.extend((*x as i32).to_be_bytes()),
                false => bytes.extend(format!("{x} ").into_bytes()),
            }),
        }
        bytes.push(b'\n');
    };
    let (points, cells) = (grid.points.len() / 3, grid.types.len());
    put(
        format!("POINTS {points} double\n"),
        &Numbers::Real(&grid.points),
    );
    if version.starts_with('5') {
        put("METADATA\nINFORMATION 0\n\n".into(), &Numbers::Long(&[]));
        let mut offsets = vec![0];
        offsets.extend(&grid.offsets);
        let all = grid.connectivity.len();
        put(
            format!("CELLS {} {all}\nOFFSETS vtktypeint64\n", cells + 1),
            &Numbers::Long(&offsets),
        );
        put(
            "CONNECTIVITY vtktypeint64\n".into(),
            &Numbers::Long(&grid.connectivity),
        );
    } else {
        let mut list = Vec::new();
        let mut begin = 0;
        for end in &grid.offsets {
            list.push(end - begin);
            list.extend(&grid.connectivity[begin as usize..*end as usize]);
            begin = *end;
        }
        put(
            format!("CELLS {cells} {}\n", list.len()),
            &Numbers::Short(&list),
        );
    }
    put(
        format!("CELL_TYPES {cells}\n"),
        &Numbers::Short(&grid.types),
    );
    put(
        format!("CELL_DATA {cells}\nSCALARS material vtktypeint64\nLOOKUP_TABLE default\n"),
        &Numbers::Long(&grid.material),
    );
    put(
        "VECTORS flow double\n".into(),
        &Numbers::Real(&vec![0.5; 3 * cells]),
    );
    put(
        format!("POINT_DATA {points}\nFIELD FieldData 2\nheat%20flux 3 {points} double\n"),
        &Numbers::Real(&grid.points),
    );
    put(
        format!("first 1 {points} int\n"),
        &Numbers::Short(&grid.first),
    );
    bytes
}

/// Checks a mesh that was read against the one that was written.
fn assert_same(back: &crate::Reading, mesh: &Mesh, what: &str) {
    assert_eq!(back.notes, [""; 0], "{what}");
    let back = &back.mesh;
    assert_eq!(
        (&back.positions, &back.blocks),
        (&mesh.positions, &mesh.blocks),
        "{what}"
    );
    for (value, (_, faces)) in (10..).zip(mesh.facet_sets.iter()) {
        let name = format!("material-{value}");
        assert_eq!(back.facet_sets.get(&name), Some(faces), "{what}: {name}");
        let nodes = mesh.nodes_of_faces(faces);
        assert_eq!(back.node_sets.get(&name), Some(&nodes[..]), "{what}");
    }
    assert_eq!(
        back.element_sets.get("material-1"),
        mesh.element_sets.get("lower half"),
        "{what}"
    );
    assert_eq!(
        back.node_sets.get("first-1"),
        Some([NodeId(0)].as_slice()),
        "{what}"
    );
}

#[test]
fn meshes_come_back_from_xml_in_all_encodings() {
    for cells in CellKind::ALL {
        let mesh = block(cells);
        for wedge in [Wedge::Inward, Wedge::Outward] {
            let grid = Grid::new(&mesh, wedge);
            for how in How::all() {
                let back = xml_body(&vtu(&grid, how));
                let back = back.unwrap_or_else(|fault| panic!("{cells} {how:?}: {fault}"));
                assert_same(&back, &mesh, &format!("{cells} {how:?}"));
            }
        }
    }
}

#[test]
fn meshes_come_back_from_legacy_files() {
    for cells in CellKind::ALL {
        let mesh = block(cells);
        let grid = Grid::new(&mesh, Wedge::Outward);
        for version in ["2.0", "3.0", "4.2", "5.1"] {
            for binary in [false, true] {
                let back = legacy_body(&vtk(&grid, version, binary));
                let back = back.unwrap_or_else(|fault| panic!("{cells} {version}: {fault}"));
                assert_same(&back, &mesh, &format!("{cells} {version} {binary}"));
            }
        }
    }
}

#[test]
fn arrays_of_many_values_make_no_sets() {
    let mesh = Block {
        divisions: [7, 7, 6],
        ..Block::default()
    };
    let mut grid = Grid::new(&mesh.mesh().unwrap(), Wedge::Inward);
    grid.material = (0..grid.types.len() as i64).collect();
    let reading = xml_body(&vtu(&grid, How::ASCII)).unwrap();
    let many = format!(
        "array `material` of cells has {} different values and makes no sets",
        grid.types.len()
    );
    assert_eq!(
        reading.notes,
        [many, "in no set and left out: 266 surface elements".into()]
    );
    assert_eq!(reading.mesh.element_sets.names().count(), 1);
}

#[test]
fn broken_xml_files_are_explained() {
    let mesh = Block::default().mesh().unwrap();
    let text = |how| String::from_utf8(vtu(&Grid::new(&mesh, Wedge::Inward), how)).unwrap();
    let inline = How {
        format: Format::Inline,
        ..How::ASCII
    };
    let packed = How {
        zlib: true,
        ..inline
    };
    let appended = How {
        format: Format::Base64,
        ..How::ASCII
    };
    let mut messages = Vec::new();
    for (how, old, new, message) in [
        (
            How::ASCII,
            "</Piece>",
            "",
            "line 78: expected XML, found invalid text: expected 'Piece' tag, not 'UnstructuredGrid'",
        ),
        (
            How::ASCII,
            "type=\"UnstructuredGrid\"",
            "type=\"PolyData\"",
            "line 2: expected `VTKFile` of type `UnstructuredGrid`, found `VTKFile` of type \
             `PolyData`",
        ),
        (
            How::ASCII,
            "LittleEndian",
            "Middle",
            "line 2: expected byte order `LittleEndian` or `BigEndian`, found `Middle`",
        ),
        (
            How::ASCII,
            "UInt32",
            "UInt16",
            "line 2: expected header type `UInt32` or `UInt64`, found `UInt16`",
        ),
        (
            packed,
            "vtkZLibDataCompressor",
            "vtkLZ4DataCompressor",
            "line 2: expected compression by `vtkZLibDataCompressor` or none, found \
             `vtkLZ4DataCompressor`; save the grid with zlib or as text",
        ),
        (
            How::ASCII,
            "</Piece>",
            "</Piece><Piece/>",
            "line 77: expected a single piece, found another one; write the grid into one file \
             as a whole",
        ),
        (
            How::ASCII,
            "NumberOfPoints=\"8\"",
            "",
            "line 4: expected an attribute `NumberOfPoints`, found none",
        ),
        (
            How::ASCII,
            "NumberOfPoints=\"8\"",
            "NumberOfPoints=\"9\"",
            "line 23: expected 27 numbers in array `Points`, found 24",
        ),
        (
            How::ASCII,
            "Name=\"offsets\"",
            "Name=\"ends\"",
            "line 27: expected an array `offsets`, found none",
        ),
        (
            How::ASCII,
            "0 0 1 ",
            "0 zero 1 ",
            "line 23: expected numbers, found `zero`",
        ),
        (
            How::ASCII,
            "0 0 1 ",
            "0 NaN 1 ",
            "point 0: expected finite coordinates, found node 0 at (0, 0, NaN)",
        ),
        (
            How::ASCII,
            "\n12 9 ",
            "\n42 9 ",
            "cell 0: expected tetrahedra, pyramids, wedges or hexahedra, of 4, 5, 6, 8, 10, 15, \
             18, 20 or 27 points, found a cell of type 42; mesh with elements of first or second \
             order",
        ),
        (
            How::ASCII,
            "\n12 9 ",
            "\n13 9 ",
            "cell 0: expected 6 points of a wedge, found 8",
        ),
        (
            How::ASCII,
            "\n8\n12\n",
            "\n8\n7\n",
            "cell 1: expected an end from 8 to 32, found 7",
        ),
        (
            How::ASCII,
            "format=\"ascii\"",
            "format=\"octal\"",
            "line 6: expected format `ascii`, `binary` or `appended`, found `octal`",
        ),
        (
            How::ASCII,
            "UInt8\" Name=\"first",
            "UInt8\" Label=\"first",
            "line 6: expected an attribute `Name`, found none",
        ),
        (
            inline,
            "CAAAAAEA",
            "CAAAAA!!",
            "line 6: expected base64, found `CAAAAA!!AAAAAAAA`",
        ),
        (
            inline,
            "CAAAAAEA",
            "CQAAAAEA",
            "line 6: expected 9 bytes of the array, found 8",
        ),
        (
            packed,
            "eJx",
            "eJ9",
            "line 6: expected a compressed block, found an array that is damaged",
        ),
        (
            appended,
            "offset=\"0\"",
            "offset=\"999999\"",
            "line 6: expected an offset up to 805, found `999999`",
        ),
    ] {
        let text = text(how);
        assert!(text.contains(old), "{old}: {text}");
        let fault = xml_body(text.replacen(old, new, 1).as_bytes()).unwrap_err();
        messages.push([fault.to_string(), message.to_owned()]);
    }
    let wrong = messages
        .into_iter()
        .filter(|[found, expected]| found != expected);
    assert_eq!(wrong.collect::<Vec<_>>(), [[""; 2]; 0]);
}

#[test]
fn broken_legacy_files_are_explained() {
    let mesh = Block::default().mesh().unwrap();
    let grid = Grid::new(&mesh, Wedge::Inward);
    let file = |version| String::from_utf8(vtk(&grid, version, false)).unwrap();
    let mut messages = Vec::new();
    for (version, old, new, message) in [
        (
            "3.0",
            "Version 3.0",
            "Version 6.0",
            "line 1: expected # vtk DataFile Version 1.0 to 5.1, found `# vtk DataFile Version 6.0`",
        ),
        (
            "3.0",
            "ASCII",
            "EBCDIC",
            "line 3: expected ASCII or BINARY, found `EBCDIC`",
        ),
        (
            "3.0",
            "UNSTRUCTURED_GRID",
            "POLYDATA",
            "line 4: expected UNSTRUCTURED_GRID, found `POLYDATA`",
        ),
        (
            "3.0",
            "POINTS 8 double",
            "POINTS 8 complex",
            "line 5: expected a type of numbers such as int or double, found `complex`",
        ),
        (
            "3.0",
            "POINTS 8",
            "POINTS -8",
            "line 5: expected a whole number, found `-8`",
        ),
        (
            "3.0",
            "0 0 1 ",
            "0 zero 1 ",
            "line 6: expected a number, found `zero`",
        ),
        (
            "3.0",
            "CELLS 7 39",
            "CELLS 7 38",
            "cell 6: expected a cell size followed by as many points, found a list of 38 numbers that does not match",
        ),
        (
            "5.1",
            "OFFSETS",
            "ENDS",
            "line 12: expected OFFSETS, found `ENDS vtktypeint64`",
        ),
        (
            "3.0",
            "CELL_DATA 7",
            "CELL_DATA 8",
            "line 11: expected values of 7 cells, found 8",
        ),
        (
            "3.0",
            "first 1 8 int",
            "first 1 7 int",
            "line 28: expected 8 tuples in array `first`, found 7",
        ),
        (
            "3.0",
            "VECTORS",
            "ARROWS",
            "line 22: expected a keyword such as POINTS, CELLS, CELL_DATA or SCALARS, found \
             `ARROWS flow double`",
        ),
        (
            "3.0",
            "CELL_TYPES 7\n12 9 9 9 9 9 9 \n",
            "",
            "line 27: expected types of 7 cells, found 0",
        ),
    ] {
        let text = file(version);
        assert!(text.contains(old), "{old}: {text}");
        let fault = legacy_body(text.replacen(old, new, 1).as_bytes()).unwrap_err();
        messages.push([fault.to_string(), message.to_owned()]);
    }
    let wrong = messages
        .into_iter()
        .filter(|[found, expected]| found != expected);
    assert_eq!(wrong.collect::<Vec<_>>(), [[""; 2]; 0]);
    let mut short = vtk(&grid, "3.0", true);
    short.truncate(200);
    let fault = legacy_body(&short).unwrap_err().to_string();
    assert_eq!(fault, "byte 67: expected 24 numbers, found 14");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn damaged_files_never_panic(cut in 0.0..1.0f64, at in 0.0..1.0f64, byte: u8) {
        let grid = Grid::new(&Block::default().mesh().unwrap(), Wedge::Inward);
        let mut files: Vec<Vec<u8>> = How::all().into_iter().map(|how| vtu(&grid, how)).collect();
        for version in ["3.0", "5.1"] {
            files.extend([false, true].map(|binary| vtk(&grid, version, binary)));
        }
        for mut bytes in files {
            let end = bytes.len() as f64;
            let any = |bytes: &[u8]| [xml_body(bytes).is_ok(), legacy_body(bytes).is_ok()];
            let _ = any(&bytes[..(cut * end) as usize]);
            bytes[(at * end) as usize] = byte;
            let _ = any(&bytes);
        }
    }
}
