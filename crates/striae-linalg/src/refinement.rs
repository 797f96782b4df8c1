//! From a factorisation to a solution whose residual has been checked.
//!
//! Iterative refinement, measured by the componentwise backward error
//! `max_i |r|_i / (|A| |x| + |b|)_i` with the safeguard for rows where the
//! denominator vanishes of Arioli, Demmel & Duff (doi:10.1137/0610013), which
//! compares unknowns in the units of the equilibrated system. When it stalls above [`ACCEPTED`], GMRES preconditioned by the factors takes over.

use crate::{
    equilibration::Equilibration, error::SolveError, gmres, matrix::SparseMatrix,
    singularity::Factors, solver::SolveReport,
};

/// Backward error at which refinement stops.
const TARGET: f64 = 4.0 * f64::EPSILON;
/// Largest backward error of an answer that is handed out.
const ACCEPTED: f64 = 1e-12;
const REFINEMENTS: usize = 30;
const GMRES_CYCLES: usize = 4;

/// Solves `matrix x = rhs` with factors of the equilibrated matrix.
pub(crate) fn solve(
    matrix: &SparseMatrix,
    scaling: &Equilibration,
    factors: &dyn Factors,
    rhs: &[f64],
    x: &mut [f64],
) -> Result<SolveReport, SolveError> {
    check(matrix, rhs, x)?;
    let mut report = SolveReport::default();
    let precondition = |v: &mut [f64]| {
        scaling.scale_rows(v);
        factors.solve_in_place(v);
        scaling.scale_columns(v);
    };
    x.copy_from_slice(rhs);
    precondition(x);
    let mut residual = matrix.residual(x, rhs, &scaling.columns);
    while residual.backward_error > TARGET && report.refinements < REFINEMENTS {
        let mut correction = residual.values.clone();
        precondition(&mut correction);
        let improved: Vec<f64> = x.iter().zip(&correction).map(|(x, d)| x + d).collect();
        let next = matrix.residual(&improved, rhs, &scaling.columns);
        report.refinements += 1;
        let gained = next.backward_error < 0.5 * residual.backward_error;
        if next.backward_error < residual.backward_error {
            x.copy_from_slice(&improved);
            residual = next;
        }
        if !gained {
            break;
        }
    }
    for _ in 0..GMRES_CYCLES {
        if residual.backward_error <= ACCEPTED {
            break;
        }
        let correction = gmres::solve(matrix, &precondition, &residual.values);
        report.krylov_iterations += correction.iterations;
        x.iter_mut()
            .zip(&correction.solution)
            .for_each(|(x, d)| *x += d);
        residual = matrix.residual(x, rhs, &scaling.columns);
    }
    report.backward_error = residual.backward_error;
    if report.backward_error <= ACCEPTED {
        Ok(report)
    } else {
        Err(SolveError::Inaccurate {
            backward_error: report.backward_error,
        })
    }
}

fn check(matrix: &SparseMatrix, rhs: &[f64], x: &[f64]) -> Result<(), SolveError> {
    let expected = matrix.structure().unknowns();
    for found in [rhs.len(), x.len()] {
        if found != expected {
            return Err(SolveError::Length { found, expected });
        }
    }
    match rhs.iter().position(|b| !b.is_finite()) {
        Some(row) => Err(SolveError::NotFinite { row }),
        None => Ok(()),
    }
}
