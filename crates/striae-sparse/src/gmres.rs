//! One cycle of right-preconditioned GMRES (Saad & Schultz, doi:10.1137/0907058).
//!
//! Preconditioned directions are kept (as in doi:10.1137/0914028), which saves the
//! last application. Inner products are sums over fixed pieces: threads do not
//! change a bit.

use crate::triangular::{Block, subtract, subtract_transposed};
use rayon::prelude::*;

/// Entries of a vector in a piece of an inner product.
const PIECE: usize = 4096;

/// Result of a cycle.
pub struct Correction {
    /// The approximate solution.
    pub solution: Vec<f64>,
    /// Iterations that were made.
    pub iterations: usize,
}

/// Criteria by which a cycle ends.
#[derive(Clone, Copy)]
pub struct Ends {
    /// Number of iterations.
    pub iterations: usize,
    /// Size of the residual over that of the right-hand side.
    pub reduction: f64,
}

/// Approximate solution of `A x = b` in the Krylov space of `A M^-1` from zero.
pub fn solve(
    multiply: &dyn Fn(&[f64], &mut [f64]),
    precondition: &dyn Fn(&mut [f64]),
    b: &[f64],
    ends: Ends,
) -> Correction {
    let n = b.len();
    let size = norm(b);
    if size == 0.0 || !size.is_finite() {
        return Correction {
            solution: vec![0.0; n],
            iterations: 0,
        };
    }
    // One vector after the other, and what the preconditioner makes of them.
    let mut basis: Vec<f64> = b.iter().map(|b| b / size).collect();
    let mut directions: Vec<f64> = Vec::new();
    let mut hessenberg: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<(f64, f64)> = Vec::new();
    let mut residual = vec![size];
    for k in 0..ends.iterations.min(n) {
        directions.extend_from_slice(&basis[k * n..]);
        let direction = &mut directions[k * n..];
        precondition(direction);
        let mut image = vec![0.0; n];
        multiply(direction, &mut image);
        let mut column = orthogonalise(&mut image, &basis);
        let length = norm(&image);
        if !length.is_finite() {
            break;
        }
        residual.push(0.0);
        for (i, &(c, s)) in rotations.iter().enumerate() {
            rotate(&mut column, i, c, s);
        }
        let radius = column[k].hypot(length);
        if radius == 0.0 {
            residual.pop();
            break;
        }
        let (c, s) = (column[k] / radius, length / radius);
        column[k] = radius;
        rotations.push((c, s));
        hessenberg.push(column);
        rotate(&mut residual, k, c, s);
        if length == 0.0 || residual[k + 1].abs() <= ends.reduction * size {
            break;
        }
        basis.extend(image.iter().map(|v| v / length));
    }
    Correction {
        solution: combination(&directions, &hessenberg, &residual, n),
        iterations: hessenberg.len(),
    }
}

/// Coefficients on the basis, which are taken off the vector (twice, for stability).
fn orthogonalise(vector: &mut [f64], basis: &[f64]) -> Vec<f64> {
    let n = vector.len();
    let count = basis.len() / n;
    let basis = Block::new(basis, n);
    let mut coefficients = vec![0.0; count];
    for _ in 0..2 {
        let pieces = vector.par_chunks(PIECE).enumerate();
        let products = pieces.map(|(k, piece)| {
            let mut products = vec![0.0; count];
            subtract_transposed(&mut products, basis.at(k * PIECE, 0), piece);
            products
        });
        let products: Vec<Vec<f64>> = products.collect();
        let mut taken = vec![0.0; count];
        for products in products {
            taken.iter_mut().zip(products).for_each(|(t, p)| *t -= p);
        }
        subtract(vector, basis, &taken);
        coefficients
            .iter_mut()
            .zip(taken)
            .for_each(|(c, t)| *c += t);
    }
    coefficients
}

/// Givens rotation of entries `i` and `i + 1`.
fn rotate(v: &mut [f64], i: usize, c: f64, s: f64) {
    (v[i], v[i + 1]) = (c * v[i] + s * v[i + 1], c * v[i + 1] - s * v[i]);
}

/// Directions times the solution of the triangular system.
fn combination(
    directions: &[f64],
    hessenberg: &[Vec<f64>],
    residual: &[f64],
    n: usize,
) -> Vec<f64> {
    // With the other sign, as products are subtracted.
    let mut y: Vec<f64> = residual[..hessenberg.len()].iter().map(|r| -r).collect();
    for k in (0..y.len()).rev() {
        y[k] /= hessenberg[k][k];
        for i in 0..k {
            y[i] -= hessenberg[k][i] * y[k];
        }
    }
    let mut sum = vec![0.0; n];
    subtract(&mut sum, Block::new(directions, n), &y);
    sum
}

/// Length of a vector, the squares summed piece by piece.
pub fn norm(v: &[f64]) -> f64 {
    let pieces = v.chunks(PIECE).map(|piece| {
        let mut sum = [0.0];
        subtract_transposed(&mut sum, Block::new(piece, piece.len()), piece);
        -sum[0]
    });
    pieces.sum::<f64>().sqrt()
}
