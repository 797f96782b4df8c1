//! Vectors that lend PETSc slices, and values sent between ranks.

use super::{
    ffi,
    library::{Library, alone, index, ranks, world},
};
use crate::error::Error;
use std::{ffi::c_int, marker::PhantomData, ptr, sync::Arc, thread};

/// Layout of vectors on the ranks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Lay {
    /// First entry of this rank.
    pub(crate) first: usize,
    /// Entries of this rank.
    pub(crate) own: usize,
    /// Entries of all.
    pub(crate) total: usize,
}

/// A vector of PETSc without values of its own.
#[derive(Debug)]
pub(super) struct Vector {
    raw: ffi::Vec,
    own: usize,
    pub(super) library: Arc<Library>,
}

/// A vector with the values of a slice.
pub(super) struct Lent<'a> {
    raw: ffi::Vec,
    lives: PhantomData<&'a [f64]>,
}

impl Vector {
    /// A vector over all ranks.
    pub(super) fn new(library: &Arc<Library>, lay: Lay, block: usize) -> Result<Self, Error> {
        let mut raw = ffi::Vec::NULL;
        let (block, own) = (index(block)?, index(lay.own)?);
        let null = ptr::null();
        // SAFETY: null instead of values is allowed.
        let code = unsafe {
            match ranks() {
                1 => ffi::VecCreateSeqWithArray(world(), block, own, null, &mut raw),
                _ => {
                    let total = index(lay.total)?;
                    ffi::VecCreateMPIWithArray(world(), block, own, total, null, &mut raw)
                }
            }
        };
        library.check(code)?;
        Ok(Self::of(library, raw, lay.own))
    }

    /// A vector of this rank alone.
    pub(super) fn alone(library: &Arc<Library>, own: usize) -> Result<Self, Error> {
        let mut raw = ffi::Vec::NULL;
        // SAFETY: null instead of values is allowed.
        let code =
            unsafe { ffi::VecCreateSeqWithArray(alone(), 1, index(own)?, ptr::null(), &mut raw) };
        library.check(code)?;
        Ok(Self::of(library, raw, own))
    }

    fn of(library: &Arc<Library>, raw: ffi::Vec, own: usize) -> Self {
        let library = Arc::clone(library);
        Self { raw, own, library }
    }

    /// The vector with values that PETSc reads.
    pub(super) fn with<'a>(&'a mut self, values: &'a [f64]) -> Result<Lent<'a>, Error> {
        assert_eq!(values.len(), self.own, "length of a vector");
        // SAFETY: the slice is as long as the vector and outlives the loan.
        let code = unsafe { ffi::VecPlaceArray(self.raw, values.as_ptr()) };
        self.library.check(code)?;
        let (raw, lives) = (self.raw, PhantomData);
        Ok(Lent { raw, lives })
    }

    /// The vector with values that PETSc changes.
    pub(super) fn with_mut<'a>(&'a mut self, values: &'a mut [f64]) -> Result<Lent<'a>, Error> {
        self.with(values)
    }
}

impl Lent<'_> {
    /// The handle, while the loan lives.
    pub(super) fn raw(&self) -> ffi::Vec {
        self.raw
    }
}

impl Drop for Lent<'_> {
    fn drop(&mut self) {
        // SAFETY: an array was placed.
        unsafe { ffi::VecResetArray(self.raw) };
    }
}

impl Drop for Vector {
    fn drop(&mut self) {
        if !thread::panicking() {
            // SAFETY: created in `new` or `alone`, not destroyed before.
            unsafe { ffi::VecDestroy(&mut self.raw) };
        }
    }
}

/// Combination of values at a shared entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sum {
    /// The values add up.
    Added,
    /// The largest stays.
    Largest,
}

/// Sends values of entries to ranks that want them, and back.
#[derive(Debug)]
pub(crate) struct Scatter {
    raw: ffi::VecScatter,
    whole: Vector,
    wanted: Vector,
}

impl Scatter {
    /// For the entries that this rank wants.
    pub(crate) fn new(library: &Arc<Library>, lay: Lay, wanted: &[u32]) -> Result<Self, Error> {
        let whole = Vector::new(library, lay, 1)?;
        let local = Vector::alone(library, wanted.len())?;
        let from: Vec<c_int> = wanted.iter().map(|&at| at as c_int).collect();
        let to: Vec<c_int> = (0..wanted.len() as c_int).collect();
        let (from, to) = (IndexSet::new(library, &from)?, IndexSet::new(library, &to)?);
        let mut raw = ffi::VecScatter::NULL;
        // SAFETY: live objects of matching lengths; their values are not looked at.
        let code =
            unsafe { ffi::VecScatterCreate(whole.raw, from.raw, local.raw, to.raw, &mut raw) };
        library.check(code)?;
        let wanted = local;
        Ok(Self { raw, whole, wanted })
    }

    /// Fetches what is wanted from all ranks' `own`.
    pub(crate) fn fetch(&mut self, own: &[f64], wanted: &mut [f64]) -> Result<(), Error> {
        let library = Arc::clone(&self.whole.library);
        let (from, to) = (self.whole.with(own)?, self.wanted.with_mut(wanted)?);
        let (insert, mode) = (ffi::INSERT_VALUES, ffi::SCATTER_FORWARD);
        // SAFETY: both have values of the right length, and `to` is borrowed alone.
        unsafe {
            library.check(ffi::VecScatterBegin(
                self.raw, from.raw, to.raw, insert, mode,
            ))?;
            library.check(ffi::VecScatterEnd(self.raw, from.raw, to.raw, insert, mode))
        }
    }

    /// Brings values back to where they were fetched from.
    pub(crate) fn bring(&mut self, wanted: &[f64], own: &mut [f64], sum: Sum) -> Result<(), Error> {
        let library = Arc::clone(&self.whole.library);
        let (from, to) = (self.wanted.with(wanted)?, self.whole.with_mut(own)?);
        let insert = match sum {
            Sum::Added => ffi::ADD_VALUES,
            Sum::Largest => ffi::MAX_VALUES,
        };
        let mode = ffi::SCATTER_REVERSE;
        // SAFETY: both have values of the right length, and `to` is borrowed alone.
        unsafe {
            library.check(ffi::VecScatterBegin(
                self.raw, from.raw, to.raw, insert, mode,
            ))?;
            library.check(ffi::VecScatterEnd(self.raw, from.raw, to.raw, insert, mode))
        }
    }
}

impl Drop for Scatter {
    fn drop(&mut self) {
        if !thread::panicking() {
            // SAFETY: created in `new`, not destroyed before.
            unsafe { ffi::VecScatterDestroy(&mut self.raw) };
        }
    }
}

/// A set of indices, for the time a scatter is made.
struct IndexSet {
    raw: ffi::IndexSet,
}

impl IndexSet {
    fn new(library: &Library, indices: &[c_int]) -> Result<Self, Error> {
        let mut raw = ffi::IndexSet::NULL;
        let (count, mode) = (index(indices.len())?, ffi::COPY_VALUES);
        // SAFETY: PETSc copies so many indices.
        let code =
            unsafe { ffi::ISCreateGeneral(alone(), count, indices.as_ptr(), mode, &mut raw) };
        library.check(code)?;
        Ok(Self { raw })
    }
}

impl Drop for IndexSet {
    fn drop(&mut self) {
        // SAFETY: created in `new`, not destroyed before.
        unsafe { ffi::ISDestroy(&mut self.raw) };
    }
}
