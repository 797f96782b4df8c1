//! FGMRES with a matrix and a preconditioner that are functions of Rust.

use super::{
    ffi,
    library::{Library, give_back, index, text, world},
    vectors::{Lay, Vector},
};
use crate::error::Error;
use std::{
    ffi::{c_int, c_void},
    slice,
    sync::Arc,
    thread,
};

/// Prefix of the options.
const PREFIX: &str = "striae_";
/// Iterations between restarts: each keeps two vectors.
const CYCLE: c_int = 60;
/// Growth of the residual that ends it.
const DIVERGED: f64 = 1e6;
/// Error code of a function that failed: an error of a library.
const FAILED: ffi::Code = 76;

/// A linear function from vectors to vectors, that may fail.
pub(crate) type Linear<'a> = dyn FnMut(&[f64], &mut [f64]) -> Result<(), Error> + 'a;

/// Ending of the iterations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Ended {
    /// Their number.
    pub(crate) iterations: usize,
}

/// FGMRES for systems of one size.
#[derive(Debug)]
pub(crate) struct Krylov {
    lay: Lay,
    x: Vector,
    y: Vector,
    library: Arc<Library>,
}

/// Context passed to the functions that PETSc calls.
struct Context<'a, 'b> {
    multiply: &'a mut Linear<'b>,
    precondition: &'a mut Linear<'b>,
    failure: Option<Error>,
}

impl Krylov {
    /// For vectors that lie on the ranks like this.
    pub(crate) fn new(library: &Arc<Library>, lay: Lay) -> Result<Self, Error> {
        Ok(Self {
            lay,
            x: Vector::new(library, lay, 1)?,
            y: Vector::new(library, lay, 1)?,
            library: Arc::clone(library),
        })
    }

    /// Solves from zero until the residual is `reduction` times the right-hand side, for so
    /// many iterations at most.
    pub(crate) fn solve<'b>(
        &mut self,
        (multiply, precondition): (&mut Linear<'b>, &mut Linear<'b>),
        (rhs, solution): (&[f64], &mut [f64]),
        (reduction, most): (f64, usize),
    ) -> Result<Ended, Error> {
        solution.fill(0.0);
        let mut context = Context {
            multiply,
            precondition,
            failure: None,
        };
        let place = (&raw mut context).cast::<c_void>();
        let (own, total) = (index(self.lay.own)?, index(self.lay.total)?);
        let library = Arc::clone(&self.library);
        let mut objects = Objects::default();
        let (rhs, solution) = (self.x.with(rhs)?, self.y.with_mut(solution)?);
        let mut iterations = 0;
        // SAFETY: live objects. The context outlives them, and is used by the functions
        // that PETSc calls from within `KSPSolve`, one at a time.
        unsafe {
            let created =
                ffi::MatCreateShell(world(), own, own, total, total, place, &mut objects.matrix);
            library.check(created)?;
            let (matrix, name) = (objects.matrix, ffi::MATOP_MULT);
            library.check(ffi::MatShellSetOperation(matrix, name, multiplied))?;
            library.check(ffi::KSPCreate(world(), &mut objects.ksp))?;
            let ksp = objects.ksp;
            let prefix = text(PREFIX);
            library.check(ffi::KSPSetOptionsPrefix(ksp, prefix.as_ptr()))?;
            library.check(ffi::KSPSetOperators(ksp, matrix, matrix))?;
            library.check(ffi::KSPSetType(ksp, c"fgmres".as_ptr()))?;
            library.check(ffi::KSPGMRESSetRestart(ksp, CYCLE))?;
            let most = index(most)?;
            library.check(ffi::KSPSetTolerances(ksp, reduction, 0.0, DIVERGED, most))?;
            let mut pc = ffi::Pc::NULL;
            library.check(ffi::KSPGetPC(ksp, &mut pc))?;
            library.check(ffi::PCSetType(pc, c"shell".as_ptr()))?;
            library.check(ffi::PCShellSetContext(pc, place))?;
            library.check(ffi::PCShellSetApply(pc, preconditioned))?;
            library.check(ffi::KSPSetFromOptions(ksp))?;
            let solved = library.check(ffi::KSPSolve(ksp, rhs.raw(), solution.raw()));
            if let Some(failure) = context.failure.take() {
                return Err(failure);
            }
            solved?;
            library.check(ffi::KSPGetIterationNumber(ksp, &mut iterations))?;
        }
        Ok(Ended {
            iterations: iterations as usize,
        })
    }
}

/// Objects destroyed at the end of a solution.
struct Objects {
    ksp: ffi::Ksp,
    matrix: ffi::Mat,
}

impl Default for Objects {
    fn default() -> Self {
        Self {
            ksp: ffi::Ksp::NULL,
            matrix: ffi::Mat::NULL,
        }
    }
}

impl Drop for Objects {
    fn drop(&mut self) {
        if !thread::panicking() {
            // SAFETY: null or created, not destroyed before.
            unsafe {
                ffi::KSPDestroy(&mut self.ksp);
                ffi::MatDestroy(&mut self.matrix);
            }
            give_back();
        }
    }
}

/// Multiplies for PETSc.
unsafe extern "C" fn multiplied(matrix: ffi::Mat, x: ffi::Vec, y: ffi::Vec) -> ffi::Code {
    let mut place: *mut Context = std::ptr::null_mut();
    // SAFETY: the context was given with the matrix, and lives while it is solved with.
    unsafe {
        let code = ffi::MatShellGetContext(matrix, (&raw mut place).cast());
        match place.as_mut() {
            Some(context) if code == 0 => called(context.multiply, &mut context.failure, x, y),
            _ => FAILED,
        }
    }
}

/// Preconditions for PETSc.
unsafe extern "C" fn preconditioned(pc: ffi::Pc, x: ffi::Vec, y: ffi::Vec) -> ffi::Code {
    let mut place: *mut Context = std::ptr::null_mut();
    // SAFETY: the context was given with the preconditioner, and lives while it is solved
    // with.
    unsafe {
        let code = ffi::PCShellGetContext(pc, (&raw mut place).cast());
        match place.as_mut() {
            Some(context) if code == 0 => called(context.precondition, &mut context.failure, x, y),
            _ => FAILED,
        }
    }
}

/// Calls a function with the values of vectors.
///
/// # Safety
/// Both are live, and not the same.
unsafe fn called(
    function: &mut Linear<'_>,
    failure: &mut Option<Error>,
    x: ffi::Vec,
    y: ffi::Vec,
) -> ffi::Code {
    let (mut from, mut to) = (std::ptr::null(), std::ptr::null_mut());
    let mut size = 0;
    // SAFETY: the slices are as long as the vectors say, and given back before the end.
    unsafe {
        let codes = [
            ffi::VecGetLocalSize(x, &mut size),
            ffi::VecGetArrayRead(x, &mut from),
            ffi::VecGetArray(y, &mut to),
        ];
        if let Some(&code) = codes.iter().find(|&&code| code != 0) {
            return code;
        }
        let (input, output): (&[f64], &mut [f64]) = match size {
            0 => (&[], &mut []),
            _ => (
                slice::from_raw_parts(from, size as usize),
                slice::from_raw_parts_mut(to, size as usize),
            ),
        };
        let done = function(input, output);
        let codes = [
            ffi::VecRestoreArrayRead(x, &mut from),
            ffi::VecRestoreArray(y, &mut to),
        ];
        match done {
            Ok(()) => codes.into_iter().find(|&code| code != 0).unwrap_or(0),
            Err(error) => {
                *failure = Some(error);
                FAILED
            }
        }
    }
}
