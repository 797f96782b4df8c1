//! `.vtk` files, versions 1 to 5, as text and binary.
//!
//! ```text
//! # vtk DataFile Version 5.1
//! title
//! ASCII                              or BINARY, big-endian
//! DATASET UNSTRUCTURED_GRID
//! POINTS 8 double
//! CELLS 2 8                          number of cells and one more, size of the connectivity
//! OFFSETS vtktypeint64
//! CONNECTIVITY vtktypeint64
//! CELL_TYPES 1
//! CELL_DATA 1
//! SCALARS material int 1
//! LOOKUP_TABLE default
//! ```
//!
//! Up to version 4 `CELLS` is followed by a list in which the number of its points precedes
//! each cell. Attributes are `SCALARS`, or arrays of `FIELD name count`; all others are passed
//! over.

mod file;

use super::super::lines::quoted;
use super::super::{MeshFileFault, Place};
use super::number::Number;
use super::{Grid, Named};
use file::{File, Form, Words};
use striae_mesh::Vec3;

/// The grid of a file.
pub(super) fn grid(bytes: &[u8]) -> Result<Grid, MeshFileFault> {
    let mut file = File::new(bytes)?;
    let mut grid = Grid::default();
    let mut group = None;
    while let Some(line) = file.line() {
        let mut words = Words::new(line, file.place);
        let keyword = words.next("a keyword")?.to_uppercase();
        match keyword.as_str() {
            "DATASET" => {
                let kind = words.next("UNSTRUCTURED_GRID")?;
                if !kind.eq_ignore_ascii_case("UNSTRUCTURED_GRID") {
                    return Err(words.fault("UNSTRUCTURED_GRID", quoted(kind)));
                }
            }
            "POINTS" => {
                let count = words.count()?.saturating_mul(3);
                let x = file.values(count, words.number()?)?.reals();
                grid.points = x.chunks_exact(3).map(Vec3::from_row_slice).collect();
            }
            "CELLS" => file.cells(&mut words, &mut grid)?,
            "CELL_TYPES" => grid.codes = file.whole(words.count()?, Number::I32)?,
            "CELL_DATA" => group = Some(attributed(&mut words, Of::Cells, grid.ends.len())?),
            "POINT_DATA" => group = Some(attributed(&mut words, Of::Points, grid.points.len())?),
            "METADATA" => file.skip_metadata(),
            _ => {
                let arrays = file.attributes(&keyword, &mut words, group.map(|group| group.1))?;
                match group {
                    Some((Of::Cells, _)) => grid.cell_arrays.extend(arrays),
                    Some((Of::Points, _)) => grid.point_arrays.extend(arrays),
                    None => {}
                }
            }
        }
    }
    if grid.codes.len() != grid.ends.len() {
        let expected = format!("types of {} cells", grid.ends.len());
        return Err(MeshFileFault::at(
            file.place,
            expected,
            grid.codes.len().to_string(),
        ));
    }
    Ok(grid)
}

/// The number of values that arrays have from here on.
fn attributed(
    words: &mut Words<'_>,
    of: Of,
    expected: usize,
) -> Result<(Of, usize), MeshFileFault> {
    let count = words.count()?;
    if count == expected {
        return Ok((of, count));
    }
    let of = match of {
        Of::Cells => "cells",
        Of::Points => "points",
    };
    Err(words.fault(&format!("values of {expected} {of}"), count.to_string()))
}

/// Entities that attributes belong to.
#[derive(Clone, Copy)]
enum Of {
    Cells,
    Points,
}

impl File<'_> {
    fn cells(&mut self, words: &mut Words<'_>, grid: &mut Grid) -> Result<(), MeshFileFault> {
        let (count, size) = (words.count()?, words.count()?);
        if self.version >= 5 {
            let ends = self.named_integers("OFFSETS", count)?;
            grid.nodes = self.named_integers("CONNECTIVITY", size)?;
            grid.ends = ends.into_iter().skip(1).collect();
            return Ok(());
        }
        let list = self.whole(size, Number::I32)?;
        let mut rest = &list[..];
        for at in 0..count {
            let cell = rest.split_first().and_then(|(count, rest)| {
                let count = usize::try_from(*count).ok()?;
                rest.split_at_checked(count)
            });
            let (cell, behind) = cell.ok_or_else(|| {
                let expected = "a cell size followed by as many points";
                let found = format!("a list of {size} numbers that does not match");
                MeshFileFault::at(Place::Cell(at), expected, found)
            })?;
            grid.nodes.extend(cell);
            grid.ends.push(grid.nodes.len() as i64);
            rest = behind;
        }
        Ok(())
    }

    /// A line `NAME type` and so many integers.
    fn named_integers(&mut self, name: &str, count: usize) -> Result<Vec<i64>, MeshFileFault> {
        let mut words = self.words(name)?;
        let found = words.next(name)?;
        if !found.eq_ignore_ascii_case(name) {
            return Err(words.fault(name, quoted(words.all)));
        }
        self.whole(count, words.number()?)
    }

    /// The arrays of integers with a value each that a keyword brings.
    fn attributes(
        &mut self,
        keyword: &str,
        words: &mut Words<'_>,
        count: Option<usize>,
    ) -> Result<Vec<Named>, MeshFileFault> {
        if keyword == "FIELD" {
            words.next("a name")?;
            return self.field(words.count()?, count);
        }
        let unknown = || {
            let expected = "a keyword such as POINTS, CELLS, CELL_DATA or SCALARS";
            words.fault(expected, quoted(words.all))
        };
        let count = count.ok_or_else(unknown)?;
        let components = match keyword {
            "SCALARS" | "GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS" => 1,
            "VECTORS" | "NORMALS" => 3,
            "TENSORS6" => 6,
            "TENSORS" => 9,
            "TEXTURE_COORDINATES" | "COLOR_SCALARS" | "LOOKUP_TABLE" => 0,
            _ => return Err(unknown()),
        };
        let name = plain(words.next("a name")?);
        let (number, components, count) = match keyword {
            "SCALARS" => {
                let number = words.number()?;
                let components = words.rest.next().map_or(Ok(1), |word| {
                    word.parse()
                        .map_err(|_| words.fault("a number of components", quoted(word)))
                })?;
                self.skip_line("LOOKUP_TABLE");
                (number, components, count)
            }
            "TEXTURE_COORDINATES" => {
                let components = words.count()?;
                (words.number()?, components, count)
            }
            "COLOR_SCALARS" => (self.colours(), words.count()?, count),
            "LOOKUP_TABLE" => (self.colours(), 4, words.count()?),
            _ => (words.number()?, components, count),
        };
        let values = self.values(count.saturating_mul(components), number)?;
        let values = values.whole().filter(|_| components == 1);
        Ok(values
            .map(|values| Named { name, values })
            .into_iter()
            .collect())
    }

    /// Type of the numbers of colours.
    fn colours(&self) -> Number {
        match self.form {
            Form::Text => Number::F64,
            Form::Binary => Number::U8,
        }
    }

    /// Arrays with a line `name components tuples type` each, and `expected` tuples.
    fn field(
        &mut self,
        count: usize,
        expected: Option<usize>,
    ) -> Result<Vec<Named>, MeshFileFault> {
        let mut arrays = Vec::new();
        for _ in 0..count {
            let mut words = self.words("an array of the field")?;
            if words.all.eq_ignore_ascii_case("METADATA") {
                self.skip_metadata();
                words = self.words("an array of the field")?;
            }
            let name = plain(words.next("the name of an array")?);
            let (components, tuples) = (words.count()?, words.count()?);
            if let Some(expected) = expected.filter(|expected| *expected != tuples) {
                let expected = format!("{expected} tuples in array `{name}`");
                return Err(words.fault(&expected, tuples.to_string()));
            }
            let values = self.values(components.saturating_mul(tuples), words.number()?)?;
            let values = values.whole().filter(|_| components == 1);
            arrays.extend(values.map(|values| Named { name, values }));
        }
        Ok(arrays)
    }
}

/// A name without its escapes `%20`.
fn plain(name: &str) -> String {
    let mut parts = name.split('%');
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let code = part
            .get(..2)
            .and_then(|code| u8::from_str_radix(code, 16).ok());
        match code {
            Some(code) => {
                plain.push(char::from(code));
                plain.push_str(&part[2..]);
            }
            None => {
                plain.push('%');
                plain.push_str(part);
            }
        }
    }
    plain
}
