//! Factors of a whole matrix, by MUMPS.

use super::{
    ffi,
    library::{give_back, text, world},
    matrix::Matrix,
    vectors::{Lay, Vector},
};
use crate::error::Error;
use std::{ffi::c_int, thread};

/// Prefix of the options.
const PREFIX: &str = "striae_direct_";
/// Control of MUMPS: per cent of memory beyond what it predicts.
const ROOM: c_int = 14;
/// Control of MUMPS: whether pivots that are zero are passed over.
const NULL_PIVOTS: c_int = 24;
/// Information of MUMPS: its error code, and entries of the factors, in millions if negative.
const STATUS: c_int = 1;
const ENTRIES: c_int = 29;
/// Status: too little room, for integers and for numbers.
const NO_ROOM: [c_int; 2] = [-8, -9];
/// Status: not enough memory on the machine.
const NO_MEMORY: c_int = -13;
/// Room in per cent, one trial after the other.
const ROOMS: [c_int; 3] = [40, 150, 500];

/// A matrix and its factors.
#[derive(Debug)]
pub(crate) struct Factors {
    raw: ffi::Pc,
    x: Vector,
    y: Vector,
    /// The matrix that was factored.
    pub(crate) matrix: Matrix,
    /// Entries of the factors on all ranks.
    pub(crate) entries: usize,
}

/// Ending of a factorisation.
#[derive(Debug)]
pub(crate) enum Made {
    /// With factors.
    Factors(Box<Factors>),
    /// For lack of memory.
    NoMemory,
    /// With this code of MUMPS.
    Failed(c_int),
}

impl Factors {
    /// Factors a matrix. Pivots that are zero are passed over.
    pub(crate) fn of(matrix: Matrix, lay: Lay) -> Result<Made, Error> {
        let library = matrix.library().clone();
        let mut factors = Self {
            raw: ffi::Pc::NULL,
            x: Vector::new(&library, lay, 1)?,
            y: Vector::new(&library, lay, 1)?,
            matrix,
            entries: 0,
        };
        let mut status = 0;
        for room in ROOMS {
            status = factors.make(room)?;
            if !NO_ROOM.contains(&status) {
                break;
            }
        }
        Ok(match status {
            0.. => Made::Factors(Box::new(factors)),
            NO_MEMORY => Made::NoMemory,
            _ if NO_ROOM.contains(&status) => Made::NoMemory,
            _ => Made::Failed(status),
        })
    }

    /// Factors with so much room, and returns how that went.
    fn make(&mut self, room: c_int) -> Result<c_int, Error> {
        let library = self.matrix.library();
        let own = self.matrix.raw();
        let prefix = text(PREFIX);
        let (mut within, mut status, mut entries) = (ffi::Mat::NULL, 0, 0);
        // SAFETY: live objects, strings that end with zero, and places for the answers.
        unsafe {
            library.check(ffi::PCDestroy(&mut self.raw))?;
            library.check(ffi::PCCreate(world(), &mut self.raw))?;
            library.check(ffi::PCSetOptionsPrefix(self.raw, prefix.as_ptr()))?;
            library.check(ffi::PCSetType(self.raw, c"lu".as_ptr()))?;
            library.check(ffi::PCSetOperators(self.raw, own, own))?;
            let solver = c"mumps".as_ptr();
            library.check(ffi::PCFactorSetMatSolverType(self.raw, solver))?;
            library.check(ffi::PCFactorSetUpMatSolverType(self.raw))?;
            library.check(ffi::PCFactorGetMatrix(self.raw, &mut within))?;
            library.check(ffi::MatMumpsSetIcntl(within, ROOM, room))?;
            library.check(ffi::MatMumpsSetIcntl(within, NULL_PIVOTS, 1))?;
            library.check(ffi::PCSetFromOptions(self.raw))?;
            library.check(ffi::PCSetUp(self.raw))?;
            library.check(ffi::PCFactorGetMatrix(self.raw, &mut within))?;
            library.check(ffi::MatMumpsGetInfog(within, STATUS, &mut status))?;
            library.check(ffi::MatMumpsGetInfog(within, ENTRIES, &mut entries))?;
        }
        self.entries = match entries {
            0.. => entries as usize,
            _ => entries.unsigned_abs() as usize * 1_000_000,
        };
        Ok(status)
    }

    /// `y = A^-1 x`.
    pub(crate) fn solve(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Error> {
        let (x, y) = (self.x.with(x)?, self.y.with_mut(y)?);
        // SAFETY: vectors with values, of which `y` is borrowed alone.
        let code = unsafe { ffi::PCApply(self.raw, x.raw(), y.raw()) };
        self.matrix.library().check(code)
    }

    /// `y = A^-T x`.
    pub(crate) fn solve_transposed(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Error> {
        let (x, y) = (self.x.with(x)?, self.y.with_mut(y)?);
        // SAFETY: vectors with values, of which `y` is borrowed alone.
        let code = unsafe { ffi::PCApplyTranspose(self.raw, x.raw(), y.raw()) };
        self.matrix.library().check(code)
    }
}

impl Drop for Factors {
    fn drop(&mut self) {
        if !thread::panicking() {
            // SAFETY: null or created in `make`, not destroyed before.
            unsafe { ffi::PCDestroy(&mut self.raw) };
            give_back();
        }
    }
}
