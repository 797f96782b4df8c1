//! Scatter between specimens.
//!
//! Readings of one specimen share its own error, so their number says little of what another
//! specimen would do. With `J_s`, `r_s` rows and residuals of specimen `s` of `S`, each over the
//! spread,
//!
//! ```text
//! cov q = S/(S - 1)  H^-1 ( sum_s J_s^T r_s r_s^T J_s ) H^-1 ,   H = J^T J ,
//! ```
//!
//! with Student's `t` for `S - 1` degrees of freedom: the covariance that is robust against
//! clusters (Liang and Zeger 1986, "Longitudinal data analysis using generalized linear models",
//! Biometrika 73, 13-22, doi:10.1093/biomet/73.1.13). Where the specimens were measured in the
//! same directions it is that of the mean of the constants of each, `sum_s (q_s - q)(q_s - q)^T
//! / S(S - 1)`, and the intervals are exact.

use nalgebra::{DMatrix, DVector};

use super::{Reading, Specimen};

/// Numbers of the specimens of readings, ascending.
pub(super) fn numbers(readings: &[Reading]) -> Vec<usize> {
    let mut numbers: Vec<usize> = readings.iter().map(|reading| reading.specimen).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// Rows of the equations, each over its spread, with what was measured and whose they are.
pub(super) struct Equations {
    /// `J`.
    pub rows: DMatrix<f64>,
    /// Right-hand sides.
    pub measured: DVector<f64>,
    /// Number of the specimen of each row.
    pub specimens: Vec<usize>,
}

impl Equations {
    /// Returns the residuals.
    pub(super) fn residuals(&self, q: &DVector<f64>) -> DVector<f64> {
        &self.rows * q - &self.measured
    }

    /// Returns the covariance of the parameters from the scatter between specimens; `inverse`
    /// is `H^-1`.
    pub(super) fn covariance(
        &self,
        q: &DVector<f64>,
        inverse: &DMatrix<f64>,
        specimens: &[usize],
    ) -> DMatrix<f64> {
        let residuals = self.residuals(q);
        let mut middle = DMatrix::zeros(q.len(), q.len());
        for specimen in specimens {
            let mut score = DVector::zeros(q.len());
            for (row, _) in self.of(*specimen) {
                score += self.rows.row(row).transpose() * residuals[row];
            }
            middle += &score * score.transpose();
        }
        let count = specimens.len() as f64;
        inverse * middle * inverse * (count / (count - 1.0))
    }

    /// Returns the specimens with the factors by which their friction is that of the law.
    pub(super) fn factors(&self, q: &DVector<f64>, specimens: &[usize]) -> Vec<Specimen> {
        let law = &self.rows * q;
        let factor = |&number: &usize| {
            let products = self.of(number).map(|(row, measured)| {
                let law: f64 = law[row];
                [law * measured, law * law]
            });
            let [both, square] = products.fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
            Specimen {
                number,
                factor: both / square,
            }
        };
        specimens.iter().map(factor).collect()
    }

    /// Rows of a specimen with what was measured.
    fn of(&self, specimen: usize) -> impl Iterator<Item = (usize, f64)> {
        let rows = self.specimens.iter().zip(self.measured.iter()).enumerate();
        let own = rows.filter(move |(_, (one, _))| **one == specimen);
        own.map(|(row, (_, measured))| (row, *measured))
    }
}
