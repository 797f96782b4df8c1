//! One cycle of algebraic multigrid as a substitute for the inverse of a matrix.

use super::{
    ffi,
    library::{Library, give_back, index, text, world},
    matrix::Matrix,
    vectors::Vector,
};
use crate::error::Error;
use std::{sync::Arc, thread};

/// Prefix of the options.
const PREFIX: &str = "striae_bulk_";
/// Options unless others are given: smoothed aggregation, smoothed by Chebyshev polynomials
/// over symmetric sweeps of every rank.
const OPTIONS: [(&str, &str); 7] = [
    ("pc_gamg_agg_nsmooths", "1"),
    ("pc_gamg_threshold", "0.04"),
    ("pc_gamg_coarse_eq_limit", "1000"),
    ("mg_levels_ksp_type", "chebyshev"),
    ("mg_levels_ksp_max_it", "2"),
    ("mg_levels_pc_type", "sor"),
    ("mg_levels_esteig_ksp_type", "cg"),
];

/// A preconditioner of a symmetric positive definite matrix.
#[derive(Debug)]
pub(crate) struct Cycle {
    raw: ffi::Pc,
    x: Vector,
    y: Vector,
    library: Arc<Library>,
    /// Matrix that the cycle was set up for.
    matrix: Matrix,
}

impl Cycle {
    /// For a matrix with orthonormal vectors that it nearly takes to zero. `None` where the
    /// matrix does not have such an inverse.
    pub(crate) fn new(matrix: Matrix, kernel: &[Vec<f64>]) -> Result<Option<Self>, Error> {
        let library = Arc::clone(matrix.library());
        let (lay, block) = (matrix.rows().unknowns(), matrix.rows().size);
        for (name, value) in OPTIONS {
            library.option(PREFIX, name, value)?;
        }
        let cycle = Self {
            raw: create(&library)?,
            x: Vector::new(&library, lay, block)?,
            y: Vector::new(&library, lay, block)?,
            library: Arc::clone(&library),
            matrix,
        };
        let mut vectors = Vec::new();
        for _ in kernel {
            vectors.push(Vector::new(&library, lay, block)?);
        }
        let lent = vectors.iter_mut().zip(kernel);
        let lent: Vec<_> = lent.map(|(v, x)| v.with(x)).collect::<Result<_, _>>()?;
        let raw: Vec<ffi::Vec> = lent.iter().map(|lent| lent.raw()).collect();
        let own = cycle.matrix.raw();
        let mut reason = 0;
        // SAFETY: live objects; vectors have values up to the end of the function, and are
        // not looked at after set-up.
        unsafe {
            let mut space = ffi::NullSpace::NULL;
            let count = index(raw.len())?;
            let code =
                ffi::MatNullSpaceCreate(world(), ffi::FALSE, count, raw.as_ptr(), &mut space);
            library.check(code)?;
            library.check(ffi::MatSetNearNullSpace(own, space))?;
            library.check(ffi::PCSetOperators(cycle.raw, own, own))?;
            let set_up = library.check(ffi::PCSetUp(cycle.raw));
            library.check(ffi::MatSetNearNullSpace(own, ffi::NullSpace::NULL))?;
            library.check(ffi::MatNullSpaceDestroy(&mut space))?;
            set_up?;
            library.check(ffi::PCGetFailedReason(cycle.raw, &mut reason))?;
        }
        Ok((reason == 0).then_some(cycle))
    }

    /// Returns whether options select a preconditioner other than the default one.
    pub(crate) fn is_chosen(library: &Library) -> Result<bool, Error> {
        library.has_option(PREFIX, "pc_type")
    }

    /// `y = M^-1 x`.
    pub(crate) fn apply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Error> {
        let (x, y) = (self.x.with(x)?, self.y.with_mut(y)?);
        // SAFETY: vectors with values, of which `y` is borrowed alone.
        let code = unsafe { ffi::PCApply(self.raw, x.raw(), y.raw()) };
        self.library.check(code)
    }
}

/// A preconditioner that has its options.
fn create(library: &Library) -> Result<ffi::Pc, Error> {
    let mut raw = ffi::Pc::NULL;
    let prefix = text(PREFIX);
    // SAFETY: a place for the handle, and a string that is copied.
    unsafe {
        library.check(ffi::PCCreate(world(), &mut raw))?;
        library.check(ffi::PCSetOptionsPrefix(raw, prefix.as_ptr()))?;
        library.check(ffi::PCSetType(raw, c"gamg".as_ptr()))?;
        library.check(ffi::PCSetFromOptions(raw))?;
    }
    Ok(raw)
}

impl Drop for Cycle {
    fn drop(&mut self) {
        if !thread::panicking() {
            // SAFETY: created in `new`, not destroyed before.
            unsafe { ffi::PCDestroy(&mut self.raw) };
            give_back();
        }
    }
}
