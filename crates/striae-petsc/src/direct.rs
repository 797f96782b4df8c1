//! MUMPS on the whole matrix, equilibrated, put together from all parts.

use crate::{
    binding::{Entry, Factors, Made, Matrix, Side, Sum, sum},
    borders::lay,
    error::Error,
    foreign::{exchange, starts},
    iterative::Shared,
    product::{Product, largest, norm, normalise, place, pseudo_random, scale},
};
use rayon::prelude::*;
use striae_condensed::Tangent;
use striae_solve::team::Team;
use striae_sparse::{Age, Equilibration, SolveError, SolveReport, root};

/// Most sweeps of the equilibration.
const SWEEPS: usize = 6;
/// Backward error at which refinement stops.
const TARGET: f64 = 4.0 * f64::EPSILON;
/// Refinements at most.
const REFINEMENTS: usize = 10;
/// Multiple of the round-off unit at which a matrix counts as singular.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// Projections on the null space.
const PROJECTIONS: usize = 2;

/// Factors of the sum of parts.
#[derive(Debug)]
pub(crate) struct Direct {
    factors: Box<Factors>,
    /// Factors of own unknowns and rows.
    scaling: Equilibration,
    /// Largest sum of magnitudes in a row.
    norm: f64,
}

impl Direct {
    /// Factors the sum of all parts. Collective.
    pub(crate) fn new(shared: &mut Shared<'_>) -> Result<Self, SolveError> {
        let ranks = shared.ranks;
        let scaling = equilibration(shared)?;
        let (matrix, norm) = assembled(shared, &scaling)?;
        let lay = lay(shared.numbering);
        let own = |values: &[f64]| {
            let places = shared.borders.own.iter();
            places.map(|&unknown| values[unknown as usize]).collect()
        };
        let mut direct = match Factors::of(matrix, lay)? {
            Made::Factors(factors) => Self {
                factors,
                norm,
                scaling: Equilibration {
                    rows: own(&scaling.rows),
                    columns: own(&scaling.columns),
                },
            },
            Made::NoMemory => return Err(SolveError::TooLarge { bytes: 0 }),
            Made::Failed(code) => {
                let library = "MUMPS";
                return Err(SolveError::Library { library, code });
            }
        };
        direct.check_regular(ranks, shared.numbering.own.start)?;
        Ok(direct)
    }

    /// Entries of the factors on all ranks.
    pub(crate) fn entries(&self) -> usize {
        self.factors.entries
    }

    /// Solves for own unknowns, and refines the solution.
    pub(crate) fn solve(
        &mut self,
        product: &mut Product<'_>,
        team: &dyn Team,
        (rhs, x): (&[f64], &mut [f64]),
        reduction: f64,
    ) -> Result<SolveReport, SolveError> {
        let scaling = self.scaling.clone();
        self.solve_scaled(rhs, x)?;
        let size = |values: &[f64]| {
            let mut scaled = values.to_vec();
            scale(&mut scaled, &scaling.rows);
            norm(team, &scaled)
        };
        let whole = size(rhs);
        let mut residual = product.residual(team, (x, rhs), &scaling.columns)?;
        let mut refinements = 0;
        while residual.backward_error > TARGET && refinements < REFINEMENTS {
            let mut correction = vec![0.0; x.len()];
            self.solve_scaled(&residual.values, &mut correction)?;
            let improved: Vec<f64> = x.iter().zip(&correction).map(|(x, d)| x + d).collect();
            let next = product.residual(team, (&improved, rhs), &scaling.columns)?;
            refinements += 1;
            let gained = next.backward_error < 0.5 * residual.backward_error;
            if next.backward_error < residual.backward_error {
                x.copy_from_slice(&improved);
                residual = next;
            }
            if !gained {
                break;
            }
        }
        let backward_error = residual.backward_error;
        match residual.suffices(size(&residual.values), reduction * whole) {
            true => Ok(SolveReport {
                backward_error,
                refinements,
                krylov_iterations: 0,
                age: Age::Fresh,
            }),
            false => Err(SolveError::Inaccurate { backward_error }),
        }
    }

    /// `x = C (R A C)^-1 R b`.
    fn solve_scaled(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), Error> {
        let mut scaled = b.to_vec();
        scale(&mut scaled, &self.scaling.rows);
        self.factors.solve(&scaled, x)?;
        scale(x, &self.scaling.columns);
        Ok(())
    }

    /// Refuses a singular matrix, by one step of inverse iteration with `A A^T`, as the LU
    /// of one rank does. Pivots that were zero make factors of a matrix near by: then the
    /// projections show the null space.
    fn check_regular(&mut self, team: &dyn Team, first: usize) -> Result<(), SolveError> {
        let own = self.scaling.rows.len();
        let mut left = vec![0.0; own];
        let start: Vec<f64> = (first..first + own).map(pseudo_random).collect();
        self.factors.solve_transposed(&start, &mut left)?;
        normalise(team, &mut left);
        let (mut right, mut image, mut correction) = (left.clone(), left.clone(), left.clone());
        self.factors.solve(&left, &mut right)?;
        for _ in 0..=PROJECTIONS {
            if normalise(team, &mut right) == 0.0 {
                break;
            }
            self.factors.matrix.multiply(&right, &mut image)?;
            let size = largest(team, &image) / self.norm;
            if size <= ROUND_OFF {
                return Err(SolveError::Singular {
                    unknown: place(team, &right, first),
                    equation: place(team, &left, first),
                });
            }
            self.factors.solve(&image, &mut correction)?;
            right.iter_mut().zip(&correction).for_each(|(v, c)| *v -= c);
        }
        Ok(())
    }
}

/// Factors of all unknowns and rows of a part, by the largest entries of parts.
fn equilibration(shared: &mut Shared<'_>) -> Result<Equilibration, Error> {
    let count = shared.numbering.whole.len();
    let mut scaling = Equilibration {
        rows: vec![1.0; count],
        columns: vec![1.0; count],
    };
    for _ in 0..SWEEPS {
        let (mut rows, mut columns) = largest_entries(shared.tangent, &scaling);
        shared.borders.join(&mut rows, Sum::Largest)?;
        shared.borders.join(&mut columns, Sum::Largest)?;
        for (factors, largest) in [(&mut scaling.rows, rows), (&mut scaling.columns, columns)] {
            let pairs = factors.iter_mut().zip(largest);
            pairs.for_each(|(factor, largest)| *factor *= root(largest));
        }
    }
    Ok(scaling)
}

/// Largest scaled entries of rows and columns.
fn largest_entries(tangent: &Tangent, scaling: &Equilibration) -> (Vec<f64>, Vec<f64>) {
    let count = scaling.rows.len();
    let (mut rows, mut columns) = (vec![0.0_f64; count], vec![0.0_f64; count]);
    for row in 0..count {
        for (column, a) in tangent.row(row) {
            let size = a.abs() * scaling.rows[row] * scaling.columns[column];
            rows[row] = rows[row].max(size);
            columns[column] = columns[column].max(size);
        }
    }
    (rows, columns)
}

/// The scaled sum of all parts, and its largest sum of magnitudes in a row.
fn assembled(shared: &Shared<'_>, scaling: &Equilibration) -> Result<(Matrix, f64), Error> {
    let Shared {
        ranks,
        numbering,
        tangent,
        ..
    } = *shared;
    let own = &shared.borders.own;
    let add_row = |unknown: usize, entries: &mut Vec<Entry<1>>| {
        for (column, a) in tangent.row(unknown).filter(|entry| entry.1 != 0.0) {
            let value = scaling.rows[unknown] * a * scaling.columns[column];
            entries.push((numbering.whole[column] as u32, [value]));
        }
    };
    let others = shared.borders.others.iter().map(|&unknown| {
        let mut entries = Vec::new();
        add_row(unknown as usize, &mut entries);
        (numbering.whole[unknown as usize] as u32, entries)
    });
    let starts = starts(ranks, own.len());
    let foreign = exchange(ranks, &starts, others);
    let row = |k: usize, entries: &mut Vec<Entry<1>>| {
        add_row(own[k] as usize, entries);
        if let Some(others) = foreign.get(&((numbering.own.start + k) as u32)) {
            entries.extend_from_slice(others);
        }
    };
    let blocks = lay(numbering);
    let side = Side { blocks, size: 1 };
    let sums = (0..own.len()).into_par_iter().with_min_len(256).map(|k| {
        let mut entries = Vec::new();
        row(k, &mut entries);
        sum(&mut entries);
        entries.iter().map(|entry| entry.1[0].abs()).sum()
    });
    let norm = largest(ranks, &sums.collect::<Vec<f64>>());
    let matrix = Matrix::assembled(ranks.library(), (side, side), row)?;
    Ok((matrix, norm))
}
