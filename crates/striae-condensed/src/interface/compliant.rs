//! The contact system in compliance form.
//!
//! Bulk unknowns `x` are kept out of the dense algebra by the flexibilities `F` of the
//! bodies; what is factored is of the order of the multipliers `m` alone:
//!
//! ```text
//! [ S + A  C  ] [x]   [b]          x = F (b - C m)
//! [   G   G_m ] [m] = [c],         (G_m - G F C) m = c - G F b
//! ```
//!
//! with `F` instead of `(S + A)^-1`: terms of contact in `A` that are not symmetric, couple two
//! bodies or are newer than `F` are left to a few iterations of GMRES, whose matrix is the true
//! one. They are small: of the order of the pressure over the stiffness.

mod complement;
mod couplings;

use super::{
    Block, Dense, Kind, Places,
    flexibility::{Flexibility, Inverse},
};
use complement::complement;
use couplings::Couplings;
use rayon::prelude::*;
use striae_sparse::{
    Real, Values,
    gmres::{self, Ends},
    sparse_elimination::Row,
    triangular::{self, subtract},
};

/// Rows of a sparse product for one thread at a time.
const ROWS: usize = 64;
/// Most iterations of GMRES.
const MOST: usize = 16;
/// Residuals they reach: in a preconditioner, whose solver makes up for what is left, and
/// in a solution, in either precision.
const ROUGH: f64 = 1e-3;
const SINGLE: f64 = 1e-6;
const DOUBLE: f64 = 1e-10;

/// Purpose of a solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// A preconditioner.
    Precondition,
    /// An answer.
    Answer,
}

/// Decision on a trial solve with new factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Trial {
    /// The factors are tried.
    Due,
    /// Factors of a similar system passed the trial.
    Waived,
}

/// A contact system whose multipliers are factored.
#[derive(Debug)]
pub(crate) struct Compliant {
    kinds: Vec<Kind>,
    /// Scaled entries between kept unknowns.
    rows: Couplings,
    /// Multipliers, as kept unknowns.
    multipliers: Vec<u32>,
    factors: Dense,
}

impl Compliant {
    /// Factors the system of the multipliers; `None` where it is singular, or where what is
    /// left to GMRES is too much. `rows` are handed back then.
    pub(crate) fn factor(
        places: &Places,
        rows: Vec<Row>,
        (blocks, flexibility): (&[Block<'_>], &Flexibility),
        (smallest, trial): (f64, Trial),
    ) -> Result<Self, Vec<Row>> {
        let kinds = places.kinds.clone();
        let numbered = (0..kinds.len() as u32).filter(|&k| kinds[k as usize] == Kind::Multiplier);
        let multipliers: Vec<u32> = numbered.collect();
        let rows = Couplings::new(&kinds, rows);
        let lu = match flexibility {
            Flexibility::Single(inverses) => complement(&kinds, &rows, &multipliers, inverses),
            Flexibility::Double(inverses) => complement(&kinds, &rows, &multipliers, inverses),
        };
        let (of_rows, of_columns) = (multipliers.clone(), multipliers.clone());
        let Ok(factors) = Dense::factored(of_rows, of_columns, lu, smallest) else {
            return Err(rows.into_rows());
        };
        let own = Self {
            kinds,
            rows,
            multipliers,
            factors,
        };
        if trial == Trial::Waived || own.is_good(blocks, flexibility) {
            Ok(own)
        } else {
            Err(own.rows.into_rows())
        }
    }

    /// Returns whether GMRES converges for one right-hand side.
    fn is_good(&self, blocks: &[Block<'_>], flexibility: &Flexibility) -> bool {
        let one = |kind: &Kind| f64::from(u8::from(*kind != Kind::Apart));
        let rhs: Vec<f64> = self.kinds.iter().map(one).collect();
        let given = (blocks, flexibility);
        self.solved(given, &rhs, Purpose::Answer).iterations < MOST
    }

    /// Order of the dense matrix.
    pub(crate) fn dense_order(&self) -> usize {
        self.multipliers.len()
    }

    /// Entries of the factors.
    pub(crate) fn entries(&self) -> usize {
        self.factors.lu.len()
    }

    /// Solves for all kept unknowns.
    pub(crate) fn solve(
        &self,
        given: (&[Block<'_>], &Flexibility),
        rhs: &[f64],
        purpose: Purpose,
    ) -> Vec<f64> {
        let rhs: Vec<f64> = self.kinds.iter().zip(rhs).map(active).collect();
        self.solved(given, &rhs, purpose).solution
    }

    fn solved(
        &self,
        (blocks, flexibility): (&[Block<'_>], &Flexibility),
        rhs: &[f64],
        purpose: Purpose,
    ) -> gmres::Correction {
        let multiply = |z: &[f64], y: &mut [f64]| self.multiply(blocks, z, y);
        let precondition = |y: &mut [f64]| match flexibility {
            Flexibility::Single(inverses) => self.precondition(inverses, y),
            Flexibility::Double(inverses) => self.precondition(inverses, y),
        };
        let ends = Ends {
            iterations: MOST,
            reduction: match (purpose, flexibility) {
                (Purpose::Precondition, _) => ROUGH,
                (Purpose::Answer, Flexibility::Single(_)) => SINGLE,
                (Purpose::Answer, Flexibility::Double(_)) => DOUBLE,
            },
        };
        gmres::solve(&multiply, &precondition, rhs, ends)
    }

    /// `y := (A + S) z`.
    fn multiply(&self, blocks: &[Block<'_>], z: &[f64], y: &mut [f64]) {
        self.rows_times(z, y, |_, k| self.rows.all(k));
        let products = blocks.par_iter().map(|block| match block.values {
            Values::Single(values) => product(block.places, values, z),
            Values::Double(values) => product(block.places, values, z),
        });
        let products: Vec<Vec<f64>> = products.collect();
        for (block, product) in blocks.iter().zip(products) {
            for (&k, value) in block.places.iter().zip(product) {
                y[k as usize] += value;
            }
        }
        let kinds = self.kinds.iter().zip(y);
        kinds
            .filter(|(kind, _)| **kind == Kind::Apart)
            .for_each(|(_, y)| *y = 0.0);
    }

    /// `y := A z`, with the entries of each row that are wanted.
    fn rows_times<'a>(
        &'a self,
        z: &[f64],
        y: &mut [f64],
        wanted: impl Fn(Kind, usize) -> &'a [(u32, f64)] + Sync,
    ) {
        let chunks = y.par_chunks_mut(ROWS).enumerate();
        chunks.for_each(|(chunk, y)| {
            for (k, y) in (chunk * ROWS..).zip(y) {
                *y = row_times(wanted(self.kinds[k], k), z);
            }
        });
    }

    /// The solution with the flexibilities instead of the inverse.
    fn precondition<T: Real>(&self, inverses: &[Inverse<T>], y: &mut [f64]) {
        let mut z = vec![0.0; y.len()];
        add_flexible(inverses, y, &mut z, 1.0);
        let mut image = vec![0.0; y.len()];
        self.rows_times(&z, &mut image, |kind, k| match kind {
            Kind::Multiplier => self.rows.with_bulk(k),
            _ => &[],
        });
        let rest: Vec<f64> = y.iter().zip(&image).map(|(y, g)| y - g).collect();
        let found = self.factors.solve(&rest);
        let mut multipliers = vec![0.0; y.len()];
        for (&k, value) in self.multipliers.iter().zip(found) {
            (multipliers[k as usize], z[k as usize]) = (value, value);
        }
        self.rows_times(&multipliers, &mut image, |kind, k| match kind {
            Kind::Bulk { .. } => self.rows.with_multipliers(k),
            _ => &[],
        });
        add_flexible(inverses, &image, &mut z, -1.0);
        y.copy_from_slice(&z);
    }
}

/// A sparse row times a vector, in four sums that need not wait for each other.
fn row_times(row: &[(u32, f64)], z: &[f64]) -> f64 {
    let product = |&(c, a): &(u32, f64)| a * z[c as usize];
    let (fours, rest) = row.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for four in fours {
        let entries = sums.iter_mut().zip(four);
        entries.for_each(|(sum, entry)| *sum += product(entry));
    }
    let rest: f64 = rest.iter().map(product).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

fn active((kind, value): (&Kind, &f64)) -> f64 {
    match kind {
        Kind::Apart => 0.0,
        Kind::Bulk { .. } | Kind::Multiplier => *value,
    }
}

/// `S z` in the precision of a complement.
fn product<T: Real>(places: &[u32], values: &[T], z: &[f64]) -> Vec<f64> {
    let x: Vec<T> = places.iter().map(|&k| T::of(-z[k as usize])).collect();
    let mut product = vec![T::default(); places.len()];
    let complement = triangular::Block::new(values, places.len());
    subtract(&mut product, complement, &x);
    product.into_iter().map(Real::double).collect()
}

/// `z += factor F y`.
fn add_flexible<T: Real>(inverses: &[Inverse<T>], y: &[f64], z: &mut [f64], factor: f64) {
    let products = inverses.par_iter().map(|inverse| {
        let x = inverse.places.iter().map(|&k| T::of(y[k as usize]));
        let x: Vec<T> = x.collect();
        let mut product = vec![T::default(); x.len()];
        inverse.product(&x, &mut product);
        product
    });
    let products: Vec<Vec<T>> = products.collect();
    for (inverse, product) in inverses.iter().zip(products) {
        for (&k, value) in inverse.places.iter().zip(product) {
            z[k as usize] += factor * value.double();
        }
    }
}

#[cfg(test)]
mod tests;
