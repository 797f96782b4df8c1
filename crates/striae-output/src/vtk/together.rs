//! Files in pieces: a `.pvtu` file names the `.vtu` files that together are a grid.
//!
//! Points at the borders of pieces are in each of them. Pieces have the numbers of their points
//! and cells in the whole as arrays, [`NODE`] and [`ELEMENT`], by which they are put together
//! again.

use std::{fmt::Write as _, path::Path};

use super::{
    Array, Grid,
    stored::{StoredCells, StoredValues},
    xml::{escaped, form},
};
use crate::OutputError;
use striae_files::write_atomically;

/// Number of each point in the whole.
pub(crate) const NODE: &str = "node_number";
/// Number of each cell in the whole.
pub(crate) const ELEMENT: &str = "element_number";

/// Writes the file that names pieces, given one of them and where all are, relative to it.
pub(crate) fn write_together(
    path: &Path,
    like: &Grid,
    pieces: &[String],
) -> Result<(), OutputError> {
    let sources: String = pieces
        .iter()
        .map(|piece| format!("    <Piece Source=\"{}\"/>\n", escaped(piece)))
        .collect();
    let text = format!(
        r#"<?xml version="1.0"?>
<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
  <PUnstructuredGrid GhostLevel="0">
    <PPoints>
      <PDataArray type="Float64" Name="Points" NumberOfComponents="3"/>
    </PPoints>
    <PPointData>
{points}    </PPointData>
    <PCellData>
{cells}    </PCellData>
{sources}  </PUnstructuredGrid>
</VTKFile>
"#,
        points = arrays(&like.point_arrays),
        cells = arrays(&like.cell_arrays),
    );
    write_atomically(path, text.as_bytes())?;
    Ok(())
}

fn arrays(arrays: &[Array]) -> String {
    let mut text = String::new();
    for array in arrays {
        let (number, components) = form(&array.values);
        let (name, count) = (escaped(&array.name), components.len().max(1));
        write!(
            text,
            r#"      <PDataArray type="{number}" Name="{name}" NumberOfComponents="{count}""#
        )
        .expect("text grows");
        for (index, component) in components.iter().enumerate() {
            write!(text, r#" ComponentName{index}="{component}""#).expect("text grows");
        }
        text += "/>\n";
    }
    text
}

/// Joint of the points and cells of pieces into one grid.
pub(super) struct Joint {
    /// Piece and number in it of every point.
    points: Vec<(usize, usize)>,
    /// Piece and number in it of every cell.
    cells: Vec<(usize, usize)>,
    /// Number in the whole of every point of every piece.
    of_piece: Vec<Vec<usize>>,
}

impl Joint {
    /// The order of points and cells by their numbers in the whole, by piece.
    pub fn new(nodes: &[Vec<f64>], elements: &[Vec<f64>]) -> Self {
        let points = order(nodes);
        let mut of_piece: Vec<Vec<usize>> =
            nodes.iter().map(|piece| vec![0; piece.len()]).collect();
        let (mut last, mut kept) = (None, Vec::new());
        for (whole, piece, at) in points {
            if last != Some(whole) {
                kept.push((piece, at));
                last = Some(whole);
            }
            of_piece[piece][at] = kept.len() - 1;
        }
        let cells = order(elements).into_iter();
        Self {
            points: kept,
            cells: cells.map(|(_, piece, at)| (piece, at)).collect(),
            of_piece,
        }
    }

    /// Values at the points, of those of the pieces.
    pub fn at_points(&self, pieces: &[StoredValues]) -> StoredValues {
        join(&self.points, pieces)
    }

    /// Values in the cells.
    pub fn in_cells(&self, pieces: &[StoredValues]) -> StoredValues {
        join(&self.cells, pieces)
    }

    /// The cells.
    pub fn cells(&self, pieces: &[StoredCells]) -> StoredCells {
        let each: Vec<Vec<(u8, &[usize])>> =
            pieces.iter().map(|cells| cells.iter().collect()).collect();
        let mut joined = StoredCells::default();
        for &(piece, at) in &self.cells {
            let (shape, corners) = each[piece][at];
            let numbers = corners.iter().map(|corner| self.of_piece[piece][*corner]);
            joined.corners.extend(numbers);
            joined.ends.push(joined.corners.len());
            joined.shapes.push(shape);
        }
        joined
    }
}

/// Number in the whole, piece and place of all, in order.
fn order(numbers: &[Vec<f64>]) -> Vec<(u64, usize, usize)> {
    let mut all = Vec::new();
    for (piece, of_piece) in numbers.iter().enumerate() {
        let places = of_piece.iter().enumerate();
        all.extend(places.map(|(at, whole)| (*whole as u64, piece, at)));
    }
    all.sort_unstable();
    all
}

fn join(places: &[(usize, usize)], pieces: &[StoredValues]) -> StoredValues {
    let components = pieces.first().map_or(1, |piece| piece.components);
    let of = |&(piece, at): &(usize, usize)| {
        let first = at * components;
        pieces[piece].numbers[first..first + components]
            .iter()
            .copied()
    };
    StoredValues {
        components,
        numbers: places.iter().flat_map(of).collect(),
    }
}
