//! Linear least squares under linear bounds.
//!
//! ```text
//! minimise |A q - b|^2   subject to   G q >= m
//! ```
//!
//! Without bounds in the way `q = H^-1 A^T b`, `H = A^T A`. Bounds that are not met are added
//! one by one to the active ones `N^T`, which hold with equality, by the dual method: along
//!
//! ```text
//! z = H^-1 n - H^-1 N r,   r = (N^T H^-1 N)^-1 N^T H^-1 n,   lambda <- lambda - t r,   q <- q + t z
//! ```
//!
//! with the row `n` of the bound, to where it is met or a multiplier `lambda` vanishes, whose bound
//! is left then. The sum of squares grows with every bound, so that no set of active ones comes
//! twice, and the method ends.
//!
//! Source: Goldfarb and Idnani (1983), "A numerically stable dual method for solving strictly
//! convex quadratic programs", Math. Program. 27, 1-33, doi:10.1007/BF02591962. Columns are scaled
//! to the same length first.

use nalgebra::{DMatrix, DVector};

/// Least eigenvalue of the scaled `A^T A` of measurements that determine `q`.
const DETERMINED: f64 = 1e-9;
/// Length of a column over the longest one below which it is round-off: sines of 180 degrees, and
/// their squares, are not zero.
const SHORT: f64 = 1e-10;
/// Shortfall of a bound over `m` that is round-off.
const MET: f64 = 1e-9;
/// Part of a bound that is not one of the active ones, below which it depends on them.
const DEPENDENT: f64 = 1e-10;
/// Steps a bound, more than any measurements need; round-off could take turns.
const STEPS: usize = 20;

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
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    if lengths.iter().any(|length| *length <= SHORT * longest) || A.nrows() < A.ncols() {
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

/// The dual method from the free minimum.
#[allow(non_snake_case)]
fn bounded(mut q: DVector<f64>, inverse: &DMatrix<f64>, G: &DMatrix<f64>, m: f64) -> DVector<f64> {
    let steps = inverse * G.transpose();
    let stiffness = G * &steps;
    let mut active: Vec<usize> = Vec::new();
    let mut lambda: Vec<f64> = Vec::new();
    let mut entering = None;
    for _ in 0..STEPS * G.nrows() {
        let lacks = |i: usize, q: &DVector<f64>| m - (G.row(i) * q)[0];
        let (p, gained) = match entering.take() {
            Some(entering) => entering,
            None => {
                let others = (0..G.nrows()).filter(|i| !active.contains(i));
                let lacking = others.max_by(|&i, &j| lacks(i, &q).total_cmp(&lacks(j, &q)));
                match lacking.filter(|i| lacks(*i, &q) > MET * m) {
                    Some(p) => (p, 0.0),
                    None => break,
                }
            }
        };
        // Along `n` with the active bounds held.
        let size = active.len();
        let among = DMatrix::from_fn(size, size, |i, j| stiffness[(active[i], active[j])]);
        let with = DVector::from_fn(size, |i, _| stiffness[(active[i], p)]);
        let solved = match size {
            0 => Some(with),
            _ => among.lu().solve(&with),
        };
        let Some(r) = solved else {
            break;
        };
        let z = active
            .iter()
            .zip(r.iter())
            .fold(steps.column(p).clone_owned(), |z, (i, r)| {
                z - steps.column(*i) * *r
            });
        let slope = (G.row(p) * &z)[0];
        let full = match slope > DEPENDENT * stiffness[(p, p)] {
            true => lacks(p, &q) / slope,
            false => f64::INFINITY,
        };
        let vanishing = (0..size).filter(|j| r[*j] > 0.0);
        let leaving = vanishing.min_by(|&i, &j| (lambda[i] / r[i]).total_cmp(&(lambda[j] / r[j])));
        let partial = leaving.map_or(f64::INFINITY, |j| lambda[j] / r[j]);
        let t = full.min(partial);
        if t.is_infinite() {
            break;
        }
        for (lambda, r) in lambda.iter_mut().zip(r.iter()) {
            *lambda -= t * r;
        }
        if full.is_finite() {
            q += z * t;
        }
        match leaving.filter(|_| partial < full) {
            Some(leaving) => {
                active.remove(leaving);
                lambda.remove(leaving);
                entering = Some((p, gained + t));
            }
            None => {
                active.push(p);
                lambda.push(gained + t);
            }
        }
    }
    q
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Normals of bounds around a circle.
    fn around(count: usize) -> DMatrix<f64> {
        let angle = |row: usize| row as f64 * std::f64::consts::TAU / count as f64;
        DMatrix::from_fn(count, 3, |row, column| {
            [1.0, angle(row).cos(), (2.0 * angle(row)).sin()][column]
        })
    }

    /// At the minimum the gradient is a sum of rows of active bounds, with factors that are not
    /// negative: no direction in which they hold leads down.
    #[test]
    #[allow(non_snake_case)]
    fn bounds_are_met_and_no_way_leads_further_down() {
        let G = around(60);
        let A = DMatrix::from_row_slice(3, 3, &[1.0, 0.2, 0.0, 0.3, 1.0, 0.9, 0.1, 0.0, 2.0]);
        for b in [[0.0, 1.0, 2.0], [-1.0, 0.3, 0.1], [0.2, -2.0, 1.0]] {
            let b = DVector::from_row_slice(&b);
            let found = least_squares(&A, &b, &G, 0.01).unwrap();
            assert!(!found.free);
            let least = (&G * &found.q).min();
            assert!((least - 0.01).abs() < 1e-10, "{least}");
            let squares = |q: &DVector<f64>| (&A * q - &b).norm_squared();
            let inside = DVector::from_row_slice(&[1.0, 0.0, 0.0]);
            for trial in 0..300 {
                let turn = |k: usize| ((trial * (k + 2)) as f64).sin();
                let aside = &found.q + DVector::from_fn(3, |k, _| 1e-3 * turn(k));
                // Drawn inside until all bounds hold.
                let holds = |t: &f64| (&G * (&aside + &inside * *t)).min() >= 0.01;
                let t = (0..100).map(|k| 1e-4 * f64::from(k)).find(holds).unwrap();
                assert!(squares(&(&aside + &inside * t)) > squares(&found.q) - 1e-9);
            }
        }
    }

    /// Rows that hardly differ in length take turns many thousand times where each is met alone.
    #[test]
    #[allow(non_snake_case)]
    fn nearly_dependent_bounds_take_some_steps() {
        let G = around(720);
        let A = DMatrix::from_row_slice(3, 3, &[1.0, 1.0, 1.0, 1.0, 1.001, 1.0, 1.0, 1.0, 1.002]);
        let b = DVector::from_row_slice(&[0.0, 1.0, -1.0]);
        let found = least_squares(&A, &b, &G, 1e-3).unwrap();
        assert!((&G * &found.q).min() > 1e-3 - 1e-11);
    }
}
