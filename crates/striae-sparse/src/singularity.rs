//! Test of whether a factored matrix is singular, and of which unknown shows it.
//!
//! One step of inverse iteration with `A A^T`, `w = A^-T z`, `v = A^-1 w`,
//! from a fixed pseudo-random `z` gives the singular vectors of the smallest
//! singular value: `|A v| <= 16 eps |A| |v|` (maximum norms) means singular to
//! working precision. The largest components of `v` and `w` name an unknown
//! that is not determined and an equation that depends on others.
//!
//! If tiny pivots were replaced, the factors are those of a matrix `M` near `A`; the step `v := v -
//! M^-1 A v` then projects on the null space of `A`.

use crate::{equilibration::Equilibration, error::SolveError, matrix::SparseMatrix};

/// Factors of the equilibrated matrix `R A C`.
pub trait Factors {
    /// `x := (R A C)^-1 x`.
    fn solve_in_place(&self, x: &mut [f64]);
}

/// Factors that also solve with the transposed matrix.
pub trait TransposedFactors: Factors {
    /// `x := (R A C)^-T x`.
    fn solve_transposed_in_place(&self, x: &mut [f64]);
}

/// Multiple of the round-off unit at which a matrix counts as singular.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// Projections on the null space.
const PROJECTIONS: usize = 2;

/// Error that names the undetermined unknown when the matrix is singular.
pub fn check_regular(
    matrix: &SparseMatrix,
    scaling: &Equilibration,
    factors: &dyn TransposedFactors,
) -> Result<(), SolveError> {
    let n = matrix.structure().unknowns();
    let mut left: Vec<f64> = pseudo_random().take(n).collect();
    factors.solve_transposed_in_place(&mut left);
    normalise(&mut left);
    let mut right = left.clone();
    factors.solve_in_place(&mut right);
    for _ in 0..=PROJECTIONS {
        if normalise(&mut right) == 0.0 {
            break;
        }
        let (image, size) = scaled_image(matrix, scaling, &right);
        if size <= ROUND_OFF {
            return Err(SolveError::Singular {
                unknown: largest(&right),
                equation: largest(&left),
            });
        }
        let mut correction = image;
        factors.solve_in_place(&mut correction);
        right.iter_mut().zip(&correction).for_each(|(v, c)| *v -= c);
    }
    Ok(())
}

/// `R A C v` and its size relative to `R A C`, in maximum norms.
fn scaled_image(matrix: &SparseMatrix, scaling: &Equilibration, v: &[f64]) -> (Vec<f64>, f64) {
    let mut image = vec![0.0; v.len()];
    let (mut largest, mut norm) = (0.0_f64, 0.0_f64);
    for row in 0..v.len() {
        let mut size = 0.0;
        for (column, a) in matrix.row(row) {
            let a = a * scaling.rows[row] * scaling.columns[column];
            image[row] += a * v[column];
            size += a.abs();
        }
        largest = if image[row].is_nan() {
            f64::NAN
        } else {
            largest.max(image[row].abs())
        };
        norm = norm.max(size);
    }
    let relative = if norm == 0.0 { 0.0 } else { largest / norm };
    (image, relative)
}

/// Divides by the largest magnitude, which is returned.
fn normalise(v: &mut [f64]) -> f64 {
    let size = v.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    if size > 0.0 {
        v.iter_mut().for_each(|v| *v /= size);
    }
    size
}

/// First position whose component is within one per cent of the largest.
fn largest(v: &[f64]) -> usize {
    let size = v.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    v.iter().position(|v| v.abs() >= 0.99 * size).unwrap_or(0)
}

/// Fixed sequence of numbers with magnitude between one half and one and any sign.
fn pseudo_random() -> impl Iterator<Item = f64> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    std::iter::repeat_with(move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        let magnitude = 0.5 + 0.5 * (state >> 12) as f64 / (1_u64 << 52) as f64;
        if state & 1 == 0 {
            magnitude
        } else {
            -magnitude
        }
    })
}
