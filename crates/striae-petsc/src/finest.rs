//! The finest level of the cycle on the bodies, with aggregates of its own.
//!
//! They do not reach over contact: bodies that slide on each other keep motions of their
//! own. PETSc's aggregation would not know that, as what constraints couple is as strong as
//! elements are. The coarser levels are PETSc's. Smoothing, aggregates and interpolation
//! are those of [`striae_sparse::aggregation`]; aggregates do not reach over ranks either.

use crate::{
    binding::{Cycle, Entry, Lay, Library, Matrix, Side},
    error::Error,
    foreign::starts,
    product::{norm, orthonormalise, pseudo_random},
};
use rayon::prelude::*;
use std::sync::Arc;
use striae_solve::team::Team;
use striae_sparse::aggregation::{
    Coarsening, MODES, NONE,
    blocks::{Blocks, invert},
};

/// Values of an interpolation from an aggregate to a node.
const AREA: usize = 3 * MODES;
/// Steps of the power method.
const STEPS: usize = 12;
/// By how much its estimate of the largest eigenvalue is raised.
const SAFETY: f64 = 1.1;
/// Largest eigenvalue over the smallest one that smoothing reduces.
const RATIO: f64 = 10.0;
/// Degree of the smoothing polynomial.
const DEGREE: usize = 2;

/// A matrix of three unknowns a node with a cycle in the place of its inverse.
#[derive(Debug)]
pub(crate) struct Finest {
    matrix: Matrix,
    /// Inverses of the diagonal blocks.
    inverses: Vec<[f64; 9]>,
    /// Largest eigenvalue of the matrix times those.
    largest: f64,
    interpolation: Matrix,
    coarser: Cycle,
    /// Vectors of this level and of the next.
    residual: Vec<f64>,
    step: Vec<f64>,
    restricted: Vec<f64>,
    correction: Vec<f64>,
}

/// What a level is made of, but for its rows.
pub(crate) struct Problem<'a> {
    pub(crate) library: &'a Arc<Library>,
    pub(crate) team: &'a dyn Team,
    pub(crate) side: Side,
    /// What the bodies couple on this rank.
    pub(crate) near: Blocks<3, 3, f64>,
    /// Near-kernel on this rank, column by column.
    pub(crate) kernel: &'a [Vec<f64>],
}

/// What is known of the solution before smoothing.
#[derive(Clone, Copy, PartialEq)]
enum Start {
    Zero,
    Given,
}

impl Finest {
    /// From the rows of this rank's nodes and their diagonal blocks; `None` where it is not
    /// definite. Collective.
    pub(crate) fn new(
        problem: Problem<'_>,
        row: impl Fn(usize, &mut Vec<Entry<9>>) + Sync,
        diagonal: impl Fn(usize) -> [f64; 9] + Sync,
    ) -> Result<Option<Self>, Error> {
        let Problem {
            library,
            team,
            side,
            near,
            kernel,
        } = problem;
        let own = side.blocks.own;
        let by_node = (0..3 * own).flat_map(|k| kernel.iter().map(move |mode| mode[k]));
        let coarsening = Coarsening::new(&near, &by_node.collect::<Vec<f64>>());
        drop(near);
        let inverses = (0..own).into_par_iter().with_min_len(64).map(|k| {
            let mut inverse = [0.0; 9];
            invert::<3>(&diagonal(k), &mut inverse);
            inverse
        });
        let inverses: Vec<[f64; 9]> = inverses.collect();
        let mut matrix = Matrix::assembled(library, (side, side), row)?;
        let largest = SAFETY * power_method(team, &mut matrix, &inverses)?;
        let aggregates = aggregates(team, &coarsening);
        let omega = 4.0 / 3.0 / largest;
        let interpolation = smoothed(&matrix, (&coarsening, aggregates), &inverses, omega)?;
        let mut coarse = matrix.galerkin(&interpolation)?;
        let Lay {
            first, own: size, ..
        } = aggregates.unknowns();
        coarse.set_ones(coarsening.empty().map(|unknown| first + unknown))?;
        let mut kernel: Vec<Vec<f64>> = (0..MODES)
            .map(|mode| {
                let rows = coarsening.near_kernel.chunks_exact(MODES);
                rows.map(|row| row[mode]).collect()
            })
            .collect();
        drop(coarsening);
        orthonormalise(team, &mut kernel);
        Ok(Cycle::new(coarse, &kernel)?.map(|coarser| Self {
            matrix,
            inverses,
            largest,
            interpolation,
            coarser,
            residual: vec![0.0; 3 * own],
            step: vec![0.0; 3 * own],
            restricted: vec![0.0; size],
            correction: vec![0.0; size],
        }))
    }

    /// `x = M^-1 b`: smoothing, a correction by the coarser levels, smoothing.
    pub(crate) fn apply(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), Error> {
        x.fill(0.0);
        self.smooth(b, x, Start::Zero)?;
        self.find_residual(b, x)?;
        let Self {
            interpolation,
            coarser,
            residual,
            restricted,
            correction,
            ..
        } = self;
        interpolation.multiply_transposed(residual, restricted)?;
        coarser.apply(restricted, correction)?;
        interpolation.multiply(correction, residual)?;
        x.iter_mut().zip(residual).for_each(|(x, d)| *x += *d);
        self.smooth(b, x, Start::Given)
    }

    /// `residual = b - A x`.
    fn find_residual(&mut self, b: &[f64], x: &[f64]) -> Result<(), Error> {
        self.matrix.multiply(x, &mut self.residual)?;
        self.residual
            .iter_mut()
            .zip(b)
            .for_each(|(r, b)| *r = b - *r);
        Ok(())
    }

    /// Chebyshev iteration on the upper part of the spectrum (Saad, Iterative Methods, alg. 12.1).
    fn smooth(&mut self, b: &[f64], x: &mut [f64], start: Start) -> Result<(), Error> {
        let (upper, lower) = (self.largest, self.largest / RATIO);
        let (centre, half) = (0.5 * (upper + lower), 0.5 * (upper - lower));
        let sigma = centre / half;
        let mut rho = 1.0 / sigma;
        for k in 0..DEGREE {
            match k > 0 || start == Start::Given {
                true => self.find_residual(b, x)?,
                false => self.residual.copy_from_slice(b),
            }
            let (keep, take) = if k == 0 {
                (0.0, 1.0 / centre)
            } else {
                let before = rho;
                rho = 1.0 / (2.0 * sigma - before);
                (rho * before, 2.0 * rho / half)
            };
            let Self {
                inverses,
                residual,
                step,
                ..
            } = self;
            let nodes = step.par_chunks_exact_mut(3).zip(x.par_chunks_exact_mut(3));
            let nodes = nodes.zip(residual.par_chunks_exact(3)).zip(&*inverses);
            nodes
                .with_min_len(1024)
                .for_each(|(((step, x), residual), inverse)| {
                    for (r, image) in product(inverse, residual).into_iter().enumerate() {
                        step[r] = keep * step[r] + take * image;
                        x[r] += step[r];
                    }
                });
        }
        Ok(())
    }
}

/// Aggregates of all ranks.
fn aggregates(team: &dyn Team, coarsening: &Coarsening) -> Side {
    let starts = starts(team, coarsening.count);
    Side {
        blocks: Lay {
            first: starts[team.rank()],
            own: coarsening.count,
            total: starts[team.size()],
        },
        size: MODES,
    }
}

/// `B r` of a block.
fn product(block: &[f64; 9], r: &[f64]) -> [f64; 3] {
    [0, 3, 6].map(|row| block[row] * r[0] + block[row + 1] * r[1] + block[row + 2] * r[2])
}

/// Largest eigenvalue of `D^-1 A`, from below.
fn power_method(team: &dyn Team, matrix: &mut Matrix, inverses: &[[f64; 9]]) -> Result<f64, Error> {
    let Lay { first, own, .. } = matrix.rows().unknowns();
    let mut x: Vec<f64> = (first..first + own).map(pseudo_random).collect();
    let mut image = vec![0.0; own];
    let (mut estimate, mut before) = (1.0, norm(team, &x));
    for _ in 0..STEPS {
        matrix.multiply(&x, &mut image)?;
        for (x, (image, inverse)) in x
            .chunks_exact_mut(3)
            .zip(image.chunks_exact(3).zip(inverses))
        {
            x.copy_from_slice(&product(inverse, image));
        }
        let after = norm(team, &x);
        if before == 0.0 || after == 0.0 {
            break;
        }
        estimate = after / before;
        x.iter_mut().for_each(|x| *x /= after);
        before = 1.0;
    }
    Ok(estimate)
}

/// `(I - omega D^-1 A) T` with the orthonormal columns `T`.
fn smoothed(
    matrix: &Matrix,
    (coarsening, columns): (&Coarsening, Side),
    inverses: &[[f64; 9]],
    omega: f64,
) -> Result<Matrix, Error> {
    let (library, rows) = (matrix.library(), matrix.rows());
    let first = columns.blocks.first as u32;
    let tentative = |k: usize, entries: &mut Vec<Entry<AREA>>| {
        let aggregate = coarsening.aggregates[k];
        let values = coarsening.columns[k * AREA..].first_chunk();
        if let (true, Some(values)) = (aggregate != NONE, values) {
            entries.push((first + aggregate, *values));
        }
    };
    let tentative = Matrix::assembled(library, (rows, columns), tentative)?;
    let inverse = |k: usize, entries: &mut Vec<Entry<9>>| {
        entries.push(((rows.blocks.first + k) as u32, inverses[k]));
    };
    let inverse = Matrix::assembled(library, (rows, rows), inverse)?;
    let image = matrix.product(&tentative)?;
    let mut smoothed = inverse.product(&image)?;
    drop((inverse, image));
    smoothed.scale_and_add(-omega, &tentative)?;
    Ok(smoothed)
}
