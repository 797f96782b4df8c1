//! From a factorisation to a solution whose residual has been checked.
//!
//! Iterative refinement, measured by the componentwise backward error
//! `max_i |r|_i / (|A| |x| + |b|)_i` with the safeguard for rows where the
//! denominator vanishes of Arioli, Demmel & Duff (doi:10.1137/0610013), which
//! compares unknowns in the units of the equilibrated system. When it stalls above 1e-12, GMRES preconditioned by the factors takes over.

use crate::{
    equilibration::Equilibration,
    error::SolveError,
    gmres,
    products::LinearOperator,
    singularity::Factors,
    solver::{Age, SolveReport},
};

/// Backward error at which refinement stops.
const TARGET: f64 = 4.0 * f64::EPSILON;
/// Largest backward error of an answer that is handed out.
const ACCEPTED: f64 = 1e-12;
const REFINEMENTS: usize = 30;
const GMRES_CYCLES: usize = 4;
/// A cycle of GMRES.
const CYCLE: gmres::Ends = gmres::Ends {
    iterations: 30,
    reduction: 1e-15,
};

/// Solves `matrix x = rhs` with factors of the equilibrated matrix.
pub fn solve(
    matrix: &dyn LinearOperator,
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
        let multiply = |x: &[f64], y: &mut [f64]| matrix.multiply(x, y);
        let correction = gmres::solve(&multiply, &precondition, &residual.values, CYCLE);
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

/// Solves `matrix x = rhs` by one cycle of GMRES with factors of a nearby matrix.
///
/// `None` if the residual of the equilibrated system is not as small as requested.
pub fn solve_nearby(
    matrix: &dyn LinearOperator,
    scaling: &Equilibration,
    factors: &dyn Factors,
    (rhs, x): (&[f64], &mut [f64]),
    ends: gmres::Ends,
) -> Result<Option<SolveReport>, SolveError> {
    check(matrix, rhs, x)?;
    let multiply = |v: &[f64], image: &mut [f64]| {
        let mut v = v.to_vec();
        scaling.scale_columns(&mut v);
        matrix.multiply(&v, image);
        scaling.scale_rows(image);
    };
    let precondition = |v: &mut [f64]| factors.solve_in_place(v);
    let mut b = rhs.to_vec();
    scaling.scale_rows(&mut b);
    let correction = gmres::solve(&multiply, &precondition, &b, ends);
    let mut image = vec![0.0; b.len()];
    multiply(&correction.solution, &mut image);
    let left = image.iter().zip(&b).map(|(image, b)| b - image);
    let left = left.map(|r| r * r).sum::<f64>().sqrt();
    let whole = b.iter().map(|b| b * b).sum::<f64>().sqrt();
    x.copy_from_slice(&correction.solution);
    scaling.scale_columns(x);
    let small = left <= 2.0 * ends.reduction * whole;
    Ok(small.then_some(SolveReport {
        backward_error: if left == 0.0 { 0.0 } else { left / whole },
        refinements: 0,
        krylov_iterations: correction.iterations,
        age: Age::Stale,
    }))
}

fn check(matrix: &dyn LinearOperator, rhs: &[f64], x: &[f64]) -> Result<(), SolveError> {
    let expected = matrix.unknowns();
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
