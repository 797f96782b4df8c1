//! Points, cells and the values they carry, as plain values.

use std::collections::BTreeSet;
use std::path::Path;

use nalgebra::Matrix3;
use striae_mesh::{NodeId, Vec3};

use crate::OutputError;

/// One mesh with its results at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<'a> {
    /// Position of every point.
    pub points: &'a [Vec3],
    /// How points make cells.
    pub cells: Cells<'a>,
    /// Arrays with one value a point.
    pub point_arrays: Vec<Array>,
    /// Arrays with one value a cell.
    pub cell_arrays: Vec<Array>,
    /// Time of the state.
    pub time: f64,
}

/// How points make cells; corners are numbered as in VTK.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cells<'a> {
    /// Eight-node hexahedra.
    Hexahedra(&'a [[NodeId; 8]]),
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
    /// How many values there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Scalars(values) => values.len(),
            Self::Vectors(values) => values.len(),
            Self::SymmetricTensors(values) | Self::Tensors(values) => values.len(),
            Self::Integers(values) => values.len(),
            Self::Codes(values) => values.len(),
        }
    }

    /// Whether there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Cells<'_> {
    /// How many cells there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Hexahedra(cells) => cells.len(),
            Self::Quadrilaterals(cells) => cells.len(),
            Self::Triangles(cells) => cells.len(),
            Self::Polygons(cells) => cells.len(),
        }
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Corners of cell `index`.
    pub(super) fn corners(&self, index: usize) -> &[NodeId] {
        match self {
            Self::Hexahedra(cells) => &cells[index],
            Self::Quadrilaterals(cells) => &cells[index],
            Self::Triangles(cells) => &cells[index],
            Self::Polygons(cells) => &cells[index],
        }
    }

    /// VTK's code for the shape of cell `index`.
    pub(super) fn shape(&self, index: usize) -> u8 {
        const TRIANGLE: u8 = 5;
        const POLYGON: u8 = 7;
        const QUAD: u8 = 9;
        const HEXAHEDRON: u8 = 12;
        match (self, self.corners(index).len()) {
            (Self::Hexahedra(_), _) => HEXAHEDRON,
            (_, 3) => TRIANGLE,
            (_, 4) => QUAD,
            _ => POLYGON,
        }
    }
}

impl Grid<'_> {
    /// Refuses arrays of a wrong length, names used twice and missing points.
    pub(super) fn check(&self, path: &Path) -> Result<(), OutputError> {
        check_arrays(path, &self.point_arrays, self.points.len())?;
        check_arrays(path, &self.cell_arrays, self.cells.len())?;
        for cell in 0..self.cells.len() {
            let corners = self.cells.corners(cell);
            if let Some(missing) = corners.iter().find(|id| id.index() >= self.points.len()) {
                return Err(OutputError::MissingPoint {
                    path: path.to_owned(),
                    cell,
                    point: missing.index(),
                    points: self.points.len(),
                });
            }
        }
        Ok(())
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
