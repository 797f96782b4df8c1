//! Laws with internal variables: the old state of a point goes in, the new one comes out.
//!
//! ```text
//! (P, A, new) = response(F, old, dt)
//! ```
//!
//! A point has a fixed number of variables, all zero in a mesh that has not been deformed; those of
//! fibres are directions, which stay. `A = dP/dF` is taken at fixed old variables, so that Newton's
//! method converges quadratically. A law without memory has no variables, and none of this concerns
//! it.

/// History of a point up to the last converged state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Past<'a> {
    /// The variables then, as many as the law has.
    pub variables: &'a [f64],
    /// Time since then.
    pub elapsed: f64,
}

/// New state of a point.
#[derive(Debug, Default, PartialEq)]
pub struct Present<'a> {
    /// The variables now, as many as the law has.
    pub variables: &'a mut [f64],
    /// Energy per reference volume that has been dissipated since the last converged state.
    pub dissipated: f64,
}

impl<'a> Past<'a> {
    /// History of one of `count` points, where the variables of all points are stored one after the
    /// other.
    pub fn of_point(&self, point: usize, count: usize) -> Self {
        let each = self.variables.len() / count;
        Past {
            variables: &self.variables[point * each..(point + 1) * each],
            elapsed: self.elapsed,
        }
    }
}

/// A variable that is written with the results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name there.
    pub name: String,
    /// Its number among the variables.
    pub variable: usize,
}
