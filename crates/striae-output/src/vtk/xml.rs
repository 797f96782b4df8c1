//! The text around the arrays, and the writer itself.

use std::fmt::Write as _;
use std::path::Path;

use super::appended::{Appended, value_bytes, vector_bytes};
use super::{Array, Cells, Grid, Values};
use crate::OutputError;
use striae_files::write_atomically;

/// Writes a grid with its results as a `.vtu` file, whole or not at all.
pub fn write(path: &Path, grid: &Grid) -> Result<(), OutputError> {
    grid.check(path)?;
    write_atomically(path, &encode(grid))?;
    Ok(())
}

/// The content of a `.vtu` file.
pub(super) fn encode(grid: &Grid) -> Vec<u8> {
    let mut appended = Appended::default();
    let mut content = piece(grid, &mut appended).into_bytes();
    content.extend_from_slice(&appended.bytes);
    content.extend_from_slice(b"\n  </AppendedData>\n</VTKFile>\n");
    content
}

/// The text with five XML characters escaped.
pub(super) fn escaped(text: &str) -> String {
    text.chars().fold(String::new(), |mut out, letter| {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            _ => out.push(letter),
        }
        out
    })
}

fn piece(grid: &Grid, appended: &mut Appended) -> String {
    let points = element(
        "Float64",
        "Points",
        3,
        &[],
        vector_bytes(grid.points),
        appended,
    );
    format!(
        r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
  <UnstructuredGrid>
    <FieldData>
      <DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{time:?}</DataArray>
    </FieldData>
    <Piece NumberOfPoints="{point_count}" NumberOfCells="{cell_count}">
      <Points>
{points}      </Points>
      <Cells>
{cells}      </Cells>
      <PointData>
{point_arrays}      </PointData>
      <CellData>
{cell_arrays}      </CellData>
    </Piece>
  </UnstructuredGrid>
  <AppendedData encoding="raw">
   _"#,
        time = grid.time,
        point_count = grid.points.len(),
        cell_count = grid.cells.len(),
        cells = connectivity(grid.cells, appended),
        point_arrays = arrays(&grid.point_arrays, appended),
        cell_arrays = arrays(&grid.cell_arrays, appended),
    )
}

fn connectivity(cells: Cells, appended: &mut Appended) -> String {
    let (mut corners, mut offsets, mut shapes) = (Vec::new(), Vec::new(), Vec::new());
    let mut end = 0_i64;
    cells.each(|shape, nodes| {
        corners.extend(nodes.iter().flat_map(|id| i64::from(id.0).to_le_bytes()));
        end += nodes.len() as i64;
        offsets.extend(end.to_le_bytes());
        shapes.push(shape);
    });
    element("Int64", "connectivity", 1, &[], corners, appended)
        + &element("Int64", "offsets", 1, &[], offsets, appended)
        + &element("UInt8", "types", 1, &[], shapes, appended)
}

fn arrays(arrays: &[Array], appended: &mut Appended) -> String {
    arrays
        .iter()
        .map(|array| {
            let (number, components) = form(&array.values);
            let (name, count) = (escaped(&array.name), components.len().max(1));
            let bytes = value_bytes(&array.values);
            element(number, &name, count, components, bytes, appended)
        })
        .collect()
}

/// VTK's type of the numbers of an array, and names of its components.
pub(super) fn form(values: &Values) -> (&'static str, &'static [&'static str]) {
    match values {
        Values::Scalars(_) => ("Float64", &[]),
        Values::Vectors(_) => ("Float64", &["X", "Y", "Z"]),
        Values::SymmetricTensors(_) => ("Float64", &["XX", "YY", "ZZ", "XY", "YZ", "XZ"]),
        Values::Tensors(_) => (
            "Float64",
            &["XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"],
        ),
        Values::Integers(_) => ("Int32", &[]),
        Values::Codes(_) => ("UInt8", &[]),
    }
}

fn element(
    number: &str,
    name: &str,
    count: usize,
    components: &[&str],
    bytes: Vec<u8>,
    appended: &mut Appended,
) -> String {
    let offset = appended.push(&bytes);
    let mut text =
        format!(r#"        <DataArray type="{number}" Name="{name}" NumberOfComponents="{count}""#);
    for (index, component) in components.iter().enumerate() {
        write!(text, r#" ComponentName{index}="{component}""#).expect("text grows");
    }
    text + &format!(" format=\"appended\" offset=\"{offset}\"/>\n")
}
