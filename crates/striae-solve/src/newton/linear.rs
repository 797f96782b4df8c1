//! Linear systems of Newton's method, over any solver.

use striae_condensed::{Automatic, Choice, Tangent, TangentSolver};
use striae_model::Backend;
use striae_sparse::{SolveError, SolveReport};

/// The solver that a backend is, which chooses among others.
pub(super) fn automatic(backend: Backend) -> Automatic {
    Automatic::new(match backend {
        Backend::Condensed => Choice::ByCost,
        Backend::Iterative => Choice::Iterative,
        Backend::Multifrontal | Backend::Mumps => Choice::Multifrontal,
        Backend::Faer => Choice::Faer,
    })
}

/// The solution of `tangent correction = -residual` with a factored tangent.
pub(super) fn solved(
    solver: &mut dyn TangentSolver,
    tangent: &Tangent,
    residual: &[f64],
    part: f64,
) -> Result<(Vec<f64>, SolveReport), SolveError> {
    let mut correction = vec![0.0; residual.len()];
    let report = solver.solve_to(tangent, &negative(residual), &mut correction, part)?;
    Ok((correction, report))
}

/// The solution for a tangent close to the one that was factored, up to a part of the residual,
/// without a change for later ones; `None` where the factors do not serve.
pub(super) fn solved_beside(
    solver: &dyn TangentSolver,
    tangent: &Tangent,
    residual: &[f64],
    part: f64,
) -> Result<Option<Vec<f64>>, SolveError> {
    let mut correction = vec![0.0; residual.len()];
    let solved = solver.solve_beside(tangent, &negative(residual), &mut correction, part)?;
    Ok(solved.map(|_| correction))
}

/// The solution with another contact on older factors of the bodies; `None` where there are
/// none.
pub(super) fn solved_with_other_contact(
    solver: &mut dyn TangentSolver,
    tangent: &Tangent,
    residual: &[f64],
) -> Option<Vec<f64>> {
    let correction = solver.solve_other_contact(tangent, &negative(residual));
    correction.ok().flatten()
}

fn negative(residual: &[f64]) -> Vec<f64> {
    residual.iter().map(|r| -r).collect()
}
