//! Points, cells and the values they carry, as plain values.

use std::collections::BTreeSet;
use std::path::Path;

use nalgebra::Matrix3;
use striae_mesh::{CellBlock, NodeId, Vec3};

use crate::OutputError;

/// One mesh with its results at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<'a> {
    /// Position of every point.
    pub points: &'a [Vec3],
    /// Cells formed by the points.
    pub cells: Cells<'a>,
    /// Arrays with one value a point.
    pub point_arrays: Vec<Array>,
    /// Arrays with one value a cell.
    pub cell_arrays: Vec<Array>,
    /// Time of the state.
    pub time: f64,
}

/// Cells formed by points; corners are numbered as in VTK.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cells<'a> {
    /// The elements of a mesh.
    Blocks(&'a [CellBlock]),
    /// Four-node quadrilaterals.
    Quadrilaterals(&'a [[NodeId; 4]]),
    /// Three-node triangles.
    Triangles(&'a [[NodeId; 3]]),
    /// Polygons of any number of corners, counter-clockwise.
    Polygons(&'a [Vec<NodeId>]),
}

/// A named array.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Name shown to the user.
    pub name: String,
    /// One value a point or cell.
    pub values: Values,
}

/// The values of an array, one a point or cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Real numbers, `Float64`.
    Scalars(Vec<f64>),
    /// Vectors, three `Float64`.
    Vectors(Vec<Vec3>),
    /// Symmetric tensors, six `Float64` in the order XX YY ZZ XY YZ XZ.
    /// The upper triangle is written.
    SymmetricTensors(Vec<Matrix3<f64>>),
    /// Tensors, nine `Float64` row by row.
    Tensors(Vec<Matrix3<f64>>),
    /// Whole numbers, `Int32`.
    Integers(Vec<i32>),
    /// Small codes such as a status, `UInt8`.
    Codes(Vec<u8>),
}

impl Array {
    /// An array called `name`.
    pub fn new(name: impl Into<String>, values: Values) -> Self {
        Self {
            name: name.into(),
            values,
        }
    }
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Scalars(values) => values.len(),
            Self::Vectors(values) => values.len(),
            Self::SymmetricTensors(values) | Self::Tensors(values) => values.len(),
            Self::Integers(values) => values.len(),
            Self::Codes(values) => values.len(),
        }
    }

    /// Returns whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Cells<'_> {
    /// Number of cells.
    pub fn len(&self) -> usize {
        match self {
            Self::Blocks(blocks) => blocks.iter().map(CellBlock::len).sum(),
            Self::Quadrilaterals(cells) => cells.len(),
            Self::Triangles(cells) => cells.len(),
            Self::Polygons(cells) => cells.len(),
        }
    }

    /// Returns whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Calls `visit` with VTK's code for the shape and with the corners of every cell.
    pub(super) fn each(&self, mut visit: impl FnMut(u8, &[NodeId])) {
        match self {
            Self::Blocks(blocks) => {
                for block in *blocks {
                    let shape = block.kind.shape().vtk;
                    for corners in block.cells() {
                        match *corners {
                            // VTK's wedge has the normal of its first triangle outward.
                            [a, b, c, d, e, f] => visit(shape, &[a, c, b, d, f, e]),
                            _ => visit(shape, corners),
                        }
                    }
                }
            }
            Self::Quadrilaterals(cells) => cells.iter().for_each(|cell| visit(polygon(cell), cell)),
            Self::Triangles(cells) => cells.iter().for_each(|cell| visit(polygon(cell), cell)),
            Self::Polygons(cells) => cells.iter().for_each(|cell| visit(polygon(cell), cell)),
        }
    }
}

/// VTK's code for a polygon.
fn polygon(corners: &[NodeId]) -> u8 {
    const TRIANGLE: u8 = 5;
    const POLYGON: u8 = 7;
    const QUAD: u8 = 9;
    match corners.len() {
        3 => TRIANGLE,
        4 => QUAD,
        _ => POLYGON,
    }
}

impl Grid<'_> {
    /// Refuses arrays of a wrong length, names used twice and missing points.
    pub(super) fn check(&self, path: &Path) -> Result<(), OutputError> {
        check_arrays(path, &self.point_arrays, self.points.len())?;
        check_arrays(path, &self.cell_arrays, self.cells.len())?;
        let (mut cell, mut missing) = (0, None);
        self.cells.each(|_, corners| {
            let beyond = corners.iter().find(|id| id.index() >= self.points.len());
            missing = missing.or(beyond.map(|id| (cell, id.index())));
            cell += 1;
        });
        match missing {
            None => Ok(()),
            Some((cell, point)) => Err(OutputError::MissingPoint {
                path: path.to_owned(),
                cell,
                point,
                points: self.points.len(),
            }),
        }
    }
}

fn check_arrays(path: &Path, arrays: &[Array], expected: usize) -> Result<(), OutputError> {
    let mut names = BTreeSet::new();
    for array in arrays {
        if array.values.len() != expected {
            return Err(OutputError::ArrayLength {
                path: path.to_owned(),
                array: array.name.clone(),
                expected,
                found: array.values.len(),
            });
        }
        if !names.insert(&array.name) {
            return Err(OutputError::Duplicate {
                path: path.to_owned(),
                name: array.name.clone(),
            });
        }
    }
    Ok(())
}
