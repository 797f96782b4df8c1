//! Unstructured grids of VTK, as XML (`.vtu`) and in the legacy format (`.vtk`).
//!
//! Points and cells have no numbers and are counted from 0. Arrays of integers with a value a
//! cell make sets `<array>-<value>` of elements, and of facets and nodes where cells of lower
//! dimension have them; those with a value a point make sets of nodes. Other arrays are passed
//! over.
//!
//! Source: "VTK file formats", <https://docs.vtk.org/en/latest/vtk_file_formats/index.html>.

mod cells;
mod legacy;
mod number;
mod xml;

use super::collected::{Collected, FileElement, position};
use super::{MeshFileFault, Place};
use cells::{Cell, cell};
use std::collections::BTreeSet;
use striae_mesh::Vec3;

/// Most sets that an array makes; more values are no names.
const MOST_SETS: usize = 256;

/// The mesh of a body from an XML file.
#[cfg(test)]
pub(super) fn xml_body(bytes: &[u8]) -> Result<super::Reading, MeshFileFault> {
    xml_collected(bytes)?.mesh()
}

/// The mesh of a body from a legacy file.
#[cfg(test)]
pub(super) fn legacy_body(bytes: &[u8]) -> Result<super::Reading, MeshFileFault> {
    legacy_collected(bytes)?.mesh()
}

/// Mesh of a body as stated in an XML file.
pub(super) fn xml_collected(bytes: &[u8]) -> Result<Collected, MeshFileFault> {
    xml::grid(bytes)?.collected()
}

/// Mesh of a body as stated in a legacy file.
pub(super) fn legacy_collected(bytes: &[u8]) -> Result<Collected, MeshFileFault> {
    legacy::grid(bytes)?.collected()
}

/// The grid of a file.
#[derive(Debug, Default)]
struct Grid {
    points: Vec<Vec3>,
    /// Points of all cells, one cell after the other.
    nodes: Vec<i64>,
    /// End of each cell in `nodes`.
    ends: Vec<i64>,
    /// VTK's code of each cell.
    codes: Vec<i64>,
    cell_arrays: Vec<Named>,
    point_arrays: Vec<Named>,
}

/// An array of integers.
#[derive(Debug)]
struct Named {
    name: String,
    values: Vec<i64>,
}

impl Named {
    /// The name of the set of a value.
    fn set(&self, at: usize) -> String {
        format!("{}-{}", self.name, self.values[at])
    }
}

impl Grid {
    fn collected(mut self) -> Result<Collected, MeshFileFault> {
        let mut mesh = Collected::default();
        for (at, x) in self.points.iter().enumerate() {
            let x = position(Place::Point(at), at as u64, *x)?;
            mesh.nodes.insert(at as u64, x);
        }
        let (points, cells) = (self.points.len(), self.ends.len());
        named(&mut self.cell_arrays, "cells", cells, &mut mesh.notes);
        named(&mut self.point_arrays, "points", points, &mut mesh.notes);
        let mut begin = 0;
        for (at, (end, code)) in self.ends.iter().zip(&self.codes).enumerate() {
            let place = Place::Cell(at);
            let nodes = self.nodes(place, begin, *end)?;
            begin += nodes.len();
            let sets = self.cell_arrays.iter().map(|array| array.set(at));
            match cell(place, *code, &nodes, &self.points)? {
                Cell::Solid(kind, corners) => {
                    let number = at as u64;
                    for set in sets {
                        let set = mesh.element_sets.entry(set).or_default();
                        set.push((place, number));
                    }
                    mesh.elements.push(FileElement {
                        place,
                        number,
                        kind,
                        corners,
                    });
                }
                Cell::Lower(dimension, nodes) => mesh.add_lower(dimension, place, &nodes, sets),
                Cell::Empty => {}
            }
        }
        for array in &self.point_arrays {
            for at in 0..self.points.len() {
                let set = mesh.node_sets.entry(array.set(at)).or_default();
                set.push((Place::Point(at), at as u64));
            }
        }
        Ok(mesh)
    }

    /// Points of the cell that begins and ends there.
    fn nodes(&self, place: Place, begin: usize, end: i64) -> Result<Vec<u64>, MeshFileFault> {
        let nodes = usize::try_from(end).ok();
        let nodes = nodes.and_then(|end| self.nodes.get(begin..end));
        let nodes = nodes.ok_or_else(|| {
            let expected = format!("an end from {begin} to {}", self.nodes.len());
            MeshFileFault::at(place, expected, end.to_string())
        })?;
        let number = |node: &i64| {
            let number = u64::try_from(*node);
            number.map_err(|_| MeshFileFault::at(place, "an existing node", format!("node {node}")))
        };
        nodes.iter().map(number).collect()
    }
}

/// Leaves those arrays that make sets, of which each has a value for every cell or point.
fn named(arrays: &mut Vec<Named>, of: &str, count: usize, notes: &mut Vec<String>) {
    arrays.retain(|array| {
        if array.values.len() != count {
            notes.push(format!(
                "array `{}` has {} values for {count} {of} and makes no sets",
                array.name,
                array.values.len()
            ));
            return false;
        }
        let values: BTreeSet<&i64> = array.values.iter().collect();
        if values.len() > MOST_SETS {
            notes.push(format!(
                "array `{}` of {of} has {} different values and makes no sets",
                array.name,
                values.len()
            ));
        }
        values.len() <= MOST_SETS
    });
}
