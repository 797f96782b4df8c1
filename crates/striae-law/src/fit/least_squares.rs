//! Linear least squares under linear bounds.
//!
//! ```text
//! minimise |A q - b|^2   subject to   G q >= m
//! ```
//!
//! Without bounds in the way `q = H^-1 A^T b`, `H = A^T A`. With bounds, `q = q_0 + H^-1 G^T
//! lambda` where the multipliers `lambda >= 0` come from Hildreth's method, which meets one
//! bound after the other:
//!
//! ```text
//! lambda_i <- max(0, lambda_i + (m - G_i q)/(G_i H^-1 G_i^T)) .
//! ```
//!
//! Source: Hildreth (1957), "A quadratic programming procedure", Naval Research Logistics
//! Quarterly 4, 79-85, doi:10.1002/nav.3800040113. Columns are scaled to the same length first.

use nalgebra::{DMatrix, DVector};

/// Least eigenvalue of the scaled `A^T A` of measurements that determine `q`.
const DETERMINED: f64 = 1e-9;
/// Rounds of Hildreth's method, and the change over `m` that ends them.
const ROUNDS: usize = 100_000;
const SETTLED: f64 = 1e-9;

/// The minimum.
pub(super) struct Minimum {
    /// `q`.
    pub q: DVector<f64>,
    /// `true` if the parameter is not held at a bound.
    pub free: bool,
    /// `H^-1`.
    pub inverse: DMatrix<f64>,
}

/// The minimum of `|A q - b|^2` under `G q >= m`; `None` where `A` leaves parameters open.
#[allow(non_snake_case)]
pub(super) fn least_squares(
    A: &DMatrix<f64>,
    b: &DVector<f64>,
    G: &DMatrix<f64>,
    m: f64,
) -> Option<Minimum> {
    let lengths: Vec<f64> = A.column_iter().map(|column| column.norm()).collect();
    if lengths.contains(&0.0) || A.nrows() < A.ncols() {
        return None;
    }
    let scale = DMatrix::from_diagonal(&DVector::from_iterator(
        lengths.len(),
        lengths.iter().map(|length| 1.0 / length),
    ));
    let scaled = A * &scale;
    let normal = scaled.transpose() * &scaled;
    if normal.symmetric_eigenvalues().min() < DETERMINED {
        return None;
    }
    let inverse = &scale * normal.cholesky()?.inverse() * &scale;
    let q = scaled.svd(true, true).solve(b, 0.0).ok()?;
    let q = &scale * q;
    let free = (G * &q).iter().all(|value| *value >= m);
    let q = if free { q } else { bounded(q, &inverse, G, m) };
    Some(Minimum { q, free, inverse })
}

/// Hildreth's method from the free minimum.
#[allow(non_snake_case)]
fn bounded(mut q: DVector<f64>, inverse: &DMatrix<f64>, G: &DMatrix<f64>, m: f64) -> DVector<f64> {
    let steps = inverse * G.transpose();
    let mut lambda = vec![0.0; G.nrows()];
    for _ in 0..ROUNDS {
        let mut change: f64 = 0.0;
        for (i, lambda) in lambda.iter_mut().enumerate() {
            let row = G.row(i);
            let value = (row * &q)[0];
            let stiffness = (row * steps.column(i))[0];
            let next = (*lambda + (m - value) / stiffness).max(0.0);
            if next != *lambda {
                q += steps.column(i) * (next - *lambda);
                change = change.max(((next - *lambda) * stiffness).abs());
                *lambda = next;
            }
        }
        if change <= SETTLED * m {
            break;
        }
    }
    q
}
