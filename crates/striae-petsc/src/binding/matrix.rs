//! Matrices in compressed rows, a range of rows on each rank.

use super::{
    ffi,
    library::{Library, index, ranks, world},
    vectors::{Lay, Vector},
};
use crate::error::Error;
use rayon::prelude::*;
use std::{ffi::c_int, sync::Arc, thread};

/// Rows of blocks that are put together at a time.
const ROWS: usize = 4096;

/// A block, row by row, and the column of blocks it is in.
pub(crate) type Entry<const AREA: usize> = (u32, [f64; AREA]);

/// Rows or columns of blocks: how they lie, and how many unknowns each has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Side {
    /// Blocks on the ranks.
    pub(crate) blocks: Lay,
    /// Unknowns of a block.
    pub(crate) size: usize,
}

/// A matrix of blocks.
#[derive(Debug)]
pub(crate) struct Matrix {
    raw: ffi::Mat,
    rows: Side,
    columns: Side,
    /// Vectors of columns and of rows.
    x: Vector,
    y: Vector,
    library: Arc<Library>,
}

impl Side {
    /// Layout in unknowns instead of blocks.
    pub(crate) fn unknowns(self) -> Lay {
        Lay {
            first: self.blocks.first * self.size,
            own: self.blocks.own * self.size,
            total: self.blocks.total * self.size,
        }
    }

    /// Returns whether this rank owns a block.
    pub(crate) fn contains(self, block: u32) -> bool {
        let Lay { first, own, .. } = self.blocks;
        (first..first + own).contains(&(block as usize))
    }
}

impl Matrix {
    /// A matrix of blocks; `row` lists what is in one of this rank's rows, in any order,
    /// where blocks of one column add up.
    pub(crate) fn assembled<const AREA: usize>(
        library: &Arc<Library>,
        (rows, columns): (Side, Side),
        row: impl Fn(usize, &mut Vec<Entry<AREA>>) + Sync,
    ) -> Result<Self, Error> {
        let own = rows.blocks.own;
        let summed = |k: usize| {
            let mut entries = Vec::with_capacity(64);
            row(k, &mut entries);
            sum(&mut entries);
            entries
        };
        let counts = (0..own).into_par_iter().with_min_len(256).map(|k| {
            let entries = summed(k);
            let inside = entries.iter().filter(|e| columns.contains(e.0)).count();
            [inside, entries.len() - inside].map(|count| (count * columns.size) as c_int)
        });
        let counts: Vec<[c_int; 2]> = counts.collect();
        let spread = |side: usize| -> Vec<c_int> {
            let each = counts.iter().map(move |c| c[side]);
            each.flat_map(|count| std::iter::repeat_n(count, rows.size))
                .collect()
        };
        let mut matrix = Self::of(library, (rows, columns), ffi::Mat::NULL)?;
        matrix.create([&spread(0), &spread(1)])?;
        for start in (0..own).step_by(ROWS) {
            let piece = start..own.min(start + ROWS);
            let piece: Vec<Vec<Entry<AREA>>> = piece.into_par_iter().map(summed).collect();
            for (k, entries) in (rows.blocks.first + start..).zip(piece) {
                matrix.set_row(k, &entries)?;
            }
        }
        matrix.finish()?;
        Ok(matrix)
    }

    fn of(
        library: &Arc<Library>,
        (rows, columns): (Side, Side),
        raw: ffi::Mat,
    ) -> Result<Self, Error> {
        Ok(Self {
            raw,
            rows,
            columns,
            x: Vector::new(library, columns.unknowns(), columns.size)?,
            y: Vector::new(library, rows.unknowns(), rows.size)?,
            library: Arc::clone(library),
        })
    }

    fn create(&mut self, counts: [&[c_int]; 2]) -> Result<(), Error> {
        let (rows, columns) = (self.rows.unknowns(), self.columns.unknowns());
        let (height, width) = (index(rows.own)?, index(columns.own)?);
        let (all_rows, all_columns) = (index(rows.total)?, index(columns.total)?);
        let (row, column) = (index(self.rows.size)?, index(self.columns.size)?);
        let [inside, outside] = counts.map(<[c_int]>::as_ptr);
        let library = &self.library;
        let is_alone = ranks() == 1;
        let kind = if is_alone { c"seqaij" } else { c"mpiaij" };
        // SAFETY: counts have one entry a row, and are copied.
        unsafe {
            library.check(ffi::MatCreate(world(), &mut self.raw))?;
            let raw = self.raw;
            library.check(ffi::MatSetSizes(raw, height, width, all_rows, all_columns))?;
            library.check(ffi::MatSetBlockSizes(raw, row, column))?;
            library.check(ffi::MatSetType(raw, kind.as_ptr()))?;
            library.check(match is_alone {
                true => ffi::MatSeqAIJSetPreallocation(raw, 0, inside),
                false => ffi::MatMPIAIJSetPreallocation(raw, 0, inside, 0, outside),
            })
        }
    }

    /// Puts a row of blocks in its place.
    fn set_row<const AREA: usize>(
        &mut self,
        row: usize,
        entries: &[Entry<AREA>],
    ) -> Result<(), Error> {
        let (height, width) = (self.rows.size, self.columns.size);
        let rows: Vec<c_int> = (0..height).map(|r| (row * height + r) as c_int).collect();
        let columns = entries.iter().map(|entry| entry.0 as usize);
        let columns: Vec<c_int> = columns
            .flat_map(|column| (0..width).map(move |c| (column * width + c) as c_int))
            .collect();
        let mut values = Vec::with_capacity(AREA * entries.len());
        for r in 0..height {
            for (_, own) in entries {
                values.extend_from_slice(&own[r * width..(r + 1) * width]);
            }
        }
        let (height, width) = (rows.len() as c_int, columns.len() as c_int);
        let mode = ffi::INSERT_VALUES;
        // SAFETY: as many rows, columns and values as are told, all copied.
        let code = unsafe {
            let (rows, columns) = (rows.as_ptr(), columns.as_ptr());
            ffi::MatSetValues(
                self.raw,
                height,
                rows,
                width,
                columns,
                values.as_ptr(),
                mode,
            )
        };
        self.library.check(code)
    }

    fn finish(&mut self) -> Result<(), Error> {
        let library = &self.library;
        // SAFETY: a live matrix whose values are set.
        unsafe {
            library.check(ffi::MatAssemblyBegin(self.raw, ffi::FINAL_ASSEMBLY))?;
            library.check(ffi::MatAssemblyEnd(self.raw, ffi::FINAL_ASSEMBLY))
        }
    }

    /// `y = A x`, on this rank's columns and rows.
    pub(crate) fn multiply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Error> {
        let (x, y) = (self.x.with(x)?, self.y.with_mut(y)?);
        // SAFETY: vectors with values, of which `y` is borrowed alone.
        let code = unsafe { ffi::MatMult(self.raw, x.raw(), y.raw()) };
        self.library.check(code)
    }

    /// Rows.
    pub(crate) fn rows(&self) -> Side {
        self.rows
    }

    pub(super) fn raw(&self) -> ffi::Mat {
        self.raw
    }

    pub(crate) fn library(&self) -> &Arc<Library> {
        &self.library
    }
}

impl Drop for Matrix {
    fn drop(&mut self) {
        if !thread::panicking() {
            // SAFETY: null or created, not destroyed before.
            unsafe { ffi::MatDestroy(&mut self.raw) };
        }
    }
}

/// Sorts blocks by column and adds up those of one column, in the order they came in.
pub(crate) fn sum<const AREA: usize>(entries: &mut Vec<Entry<AREA>>) {
    entries.sort_by_key(|entry| entry.0);
    entries.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        if is_same {
            kept.1.iter_mut().zip(next.1).for_each(|(a, b)| *a += b);
        }
        is_same
    });
}
