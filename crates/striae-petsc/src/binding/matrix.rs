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

/// A block and the column of blocks it is in.
pub(crate) type Entry<const AREA: usize> = (u32, [f64; AREA]);

/// A matrix of square blocks.
#[derive(Debug)]
pub(crate) struct Matrix {
    raw: ffi::Mat,
    x: Vector,
    y: Vector,
    /// Entries of this rank's rows.
    pub(crate) entries: usize,
    /// Sums of magnitudes in this rank's rows.
    pub(crate) row_sums: Vec<f64>,
    library: Arc<Library>,
}

impl Matrix {
    /// A matrix of blocks of `block * block = AREA` values. `lay` counts rows of blocks;
    /// `row` lists what is in one of this rank's, in any order, where blocks of one column
    /// add up.
    pub(crate) fn assembled<const AREA: usize>(
        library: &Arc<Library>,
        (lay, block): (Lay, usize),
        row: impl Fn(usize, &mut Vec<Entry<AREA>>) + Sync,
    ) -> Result<Self, Error> {
        let rows = Lay {
            first: lay.first * block,
            own: lay.own * block,
            total: lay.total * block,
        };
        let summed = |k: usize| {
            let mut entries = Vec::with_capacity(64);
            row(k, &mut entries);
            sum(&mut entries);
            entries
        };
        let near = lay.first as u32..(lay.first + lay.own) as u32;
        let counts = (0..lay.own).into_par_iter().with_min_len(256).map(|k| {
            let entries = summed(k);
            let inside = entries.iter().filter(|e| near.contains(&e.0)).count();
            [inside, entries.len() - inside].map(|count| (count * block) as c_int)
        });
        let counts: Vec<[c_int; 2]> = counts.collect();
        let spread = |side: usize| {
            let each = counts.iter().map(move |c| c[side]);
            each.flat_map(|count| std::iter::repeat_n(count, block))
                .collect::<Vec<c_int>>()
        };
        let total: c_int = counts.iter().flatten().sum();
        let mut matrix = Self {
            raw: ffi::Mat::NULL,
            x: Vector::new(library, rows, block)?,
            y: Vector::new(library, rows, block)?,
            entries: total as usize * block,
            row_sums: Vec::with_capacity(rows.own),
            library: Arc::clone(library),
        };
        matrix.create(rows, block, [&spread(0), &spread(1)])?;
        for start in (0..lay.own).step_by(ROWS) {
            let piece = start..lay.own.min(start + ROWS);
            let piece: Vec<Vec<Entry<AREA>>> = piece.into_par_iter().map(summed).collect();
            for (k, entries) in (lay.first + start..).zip(piece) {
                matrix.set_row(k, block, &entries)?;
            }
        }
        // SAFETY: a live matrix whose values are set.
        unsafe {
            library.check(ffi::MatAssemblyBegin(matrix.raw, ffi::FINAL_ASSEMBLY))?;
            library.check(ffi::MatAssemblyEnd(matrix.raw, ffi::FINAL_ASSEMBLY))?;
        }
        Ok(matrix)
    }

    fn create(&mut self, rows: Lay, block: usize, counts: [&[c_int]; 2]) -> Result<(), Error> {
        let (own, total, block) = (index(rows.own)?, index(rows.total)?, index(block)?);
        let [inside, outside] = counts.map(<[c_int]>::as_ptr);
        let library = &self.library;
        let is_alone = ranks() == 1;
        let kind = if is_alone { c"seqaij" } else { c"mpiaij" };
        // SAFETY: counts have one entry a row, and are copied.
        unsafe {
            library.check(ffi::MatCreate(world(), &mut self.raw))?;
            library.check(ffi::MatSetSizes(self.raw, own, own, total, total))?;
            library.check(ffi::MatSetBlockSize(self.raw, block))?;
            library.check(ffi::MatSetType(self.raw, kind.as_ptr()))?;
            library.check(match is_alone {
                true => ffi::MatSeqAIJSetPreallocation(self.raw, 0, inside),
                false => ffi::MatMPIAIJSetPreallocation(self.raw, 0, inside, 0, outside),
            })
        }
    }

    /// Puts a row of blocks in its place.
    fn set_row<const AREA: usize>(
        &mut self,
        row: usize,
        block: usize,
        entries: &[Entry<AREA>],
    ) -> Result<(), Error> {
        let rows: Vec<c_int> = (0..block).map(|r| (row * block + r) as c_int).collect();
        let columns: Vec<c_int> = entries
            .iter()
            .flat_map(|e| (0..block).map(|c| e.0 as c_int * block as c_int + c as c_int))
            .collect();
        let mut values = Vec::with_capacity(AREA * entries.len());
        for r in 0..block {
            let start = values.len();
            for (_, own) in entries {
                values.extend_from_slice(&own[r * block..(r + 1) * block]);
            }
            let sizes = values[start..].iter().map(|a: &f64| a.abs());
            self.row_sums.push(sizes.sum());
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

    /// `y = A x` on this rank's rows.
    pub(crate) fn multiply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Error> {
        let (x, y) = (self.x.with(x)?, self.y.with_mut(y)?);
        // SAFETY: vectors with values, of which `y` is borrowed alone.
        let code = unsafe { ffi::MatMult(self.raw, x.raw(), y.raw()) };
        self.library.check(code)
    }

    pub(super) fn raw(&self) -> ffi::Mat {
        self.raw
    }

    pub(super) fn library(&self) -> &Arc<Library> {
        &self.library
    }
}

impl Drop for Matrix {
    fn drop(&mut self) {
        if !thread::panicking() {
            // SAFETY: null or created in `create`, not destroyed before.
            unsafe { ffi::MatDestroy(&mut self.raw) };
        }
    }
}

/// Sorts blocks by column and adds up those of one column, in the order they came in.
fn sum<const AREA: usize>(entries: &mut Vec<Entry<AREA>>) {
    entries.sort_by_key(|entry| entry.0);
    entries.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        if is_same {
            kept.1.iter_mut().zip(next.1).for_each(|(a, b)| *a += b);
        }
        is_same
    });
}
