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
//! with `F` in the place of `(S + A)^-1`: terms of contact in `A` that are not symmetric,
//! couple two bodies or are newer than `F` are left to a few iterations of GMRES, whose
//! matrix is the true one. They are small: of the order of the pressure over the stiffness.

use super::{Block, Dense, Kind, Places};
use crate::{
    flexibility::{Flexibility, Inverse},
    gmres::{self, Ends},
    real::Real,
    schur::Values,
    sparse_elimination::Row,
    triangular::{self, subtract},
};
use faer::{
    Accum, Par,
    linalg::matmul::matmul,
    mat::{MatMut, MatRef},
};
use pulp::{Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;

/// Columns of `F C` that are worked on at a time.
const WIDTH: usize = 64;
/// Not a row of a panel.
const NONE: u32 = u32::MAX;
/// Rows without entries between two with entries that are taken along.
const GAP: usize = 12;
/// Rows of a sparse product for one thread at a time.
const ROWS: usize = 64;
/// Most iterations of GMRES.
const MOST: usize = 16;
/// Residuals they reach: in a preconditioner, whose solver makes up for what is left, and
/// in a solution, in either precision.
const ROUGH: f64 = 1e-3;
const SINGLE: f64 = 1e-6;
const DOUBLE: f64 = 1e-10;

/// What a solution is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// A preconditioner.
    Precondition,
    /// An answer.
    Answer,
}

/// Whether factors are tried on a right-hand side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Trial {
    /// They are.
    Due,
    /// Those of a similar system were.
    Waived,
}

/// A contact system whose multipliers are factored.
#[derive(Debug)]
pub(crate) struct Compliant {
    kinds: Vec<Kind>,
    /// Scaled entries between kept unknowns.
    rows: Vec<Row>,
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
        let lu = match flexibility {
            Flexibility::Single(inverses) => complement(&kinds, &rows, &multipliers, inverses),
            Flexibility::Double(inverses) => complement(&kinds, &rows, &multipliers, inverses),
        };
        let (of_rows, of_columns) = (multipliers.clone(), multipliers.clone());
        let Ok(factors) = Dense::factored(of_rows, of_columns, lu, smallest) else {
            return Err(rows);
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
            Err(own.rows)
        }
    }

    /// Whether GMRES converges for one right-hand side.
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
        self.rows_times(z, y, |_| true);
        for block in blocks {
            match block.values {
                Values::Single(values) => add_product(block.places, values, z, y),
                Values::Double(values) => add_product(block.places, values, z, y),
            }
        }
        let kinds = self.kinds.iter().zip(y);
        kinds
            .filter(|(kind, _)| **kind == Kind::Apart)
            .for_each(|(_, y)| *y = 0.0);
    }

    /// `y := A z` in some rows.
    fn rows_times(&self, z: &[f64], y: &mut [f64], of: impl Fn(Kind) -> bool + Sync) {
        let rows = self.rows.par_chunks(ROWS).zip(self.kinds.par_chunks(ROWS));
        let chunks = rows.zip(y.par_chunks_mut(ROWS));
        chunks.for_each(|((rows, kinds), y)| {
            for ((row, kind), y) in rows.iter().zip(kinds).zip(y) {
                if of(*kind) {
                    *y = row.iter().map(|&(c, a)| a * z[c as usize]).sum();
                }
            }
        });
    }

    /// The solution with the flexibilities in the place of the inverse.
    fn precondition<T: Real>(&self, inverses: &[Inverse<T>], y: &mut [f64]) {
        let mut z = vec![0.0; y.len()];
        add_flexible(inverses, y, &mut z, 1.0);
        let mut image = vec![0.0; y.len()];
        self.rows_times(&z, &mut image, |kind| kind == Kind::Multiplier);
        let rest: Vec<f64> = y.iter().zip(&image).map(|(y, g)| y - g).collect();
        let found = self.factors.solve(&rest);
        let mut multipliers = vec![0.0; y.len()];
        for (&k, value) in self.multipliers.iter().zip(found) {
            (multipliers[k as usize], z[k as usize]) = (value, value);
        }
        let is_bulk = |kind: Kind| matches!(kind, Kind::Bulk { .. });
        self.rows_times(&multipliers, &mut image, is_bulk);
        add_flexible(inverses, &image, &mut z, -1.0);
        y.copy_from_slice(&z);
    }
}

fn active((kind, value): (&Kind, &f64)) -> f64 {
    match kind {
        Kind::Apart => 0.0,
        Kind::Bulk { .. } | Kind::Multiplier => *value,
    }
}

/// `y += S z` in the precision of a complement.
fn add_product<T: Real>(places: &[u32], values: &[T], z: &[f64], y: &mut [f64]) {
    let x: Vec<T> = places.iter().map(|&k| T::of(-z[k as usize])).collect();
    let mut product = vec![T::default(); places.len()];
    subtract(
        &mut product,
        triangular::Block::new(values, places.len()),
        &x,
    );
    for (&k, value) in places.iter().zip(product) {
        y[k as usize] += value.double();
    }
}

/// `z += factor F y`.
fn add_flexible<T: Real>(inverses: &[Inverse<T>], y: &[f64], z: &mut [f64], factor: f64) {
    for inverse in inverses {
        let places = &inverse.places;
        let x: Vec<T> = places.iter().map(|&k| T::of(y[k as usize])).collect();
        let mut product = vec![T::default(); places.len()];
        inverse.product(&x, &mut product);
        for (&k, value) in places.iter().zip(product) {
            z[k as usize] += factor * value.double();
        }
    }
}

/// `G_m - G F C`, column by column.
fn complement<T: Real>(
    kinds: &[Kind],
    rows: &[Row],
    multipliers: &[u32],
    inverses: &[Inverse<T>],
) -> Vec<f64> {
    let count = multipliers.len();
    let mut number = vec![NONE; kinds.len()];
    for (at, &k) in multipliers.iter().enumerate() {
        number[k as usize] = at as u32;
    }
    // Where the bulk unknowns are in a panel of `F C`, and the columns of `C`.
    let mut at = vec![NONE; kinds.len()];
    let mut columns = vec![Row::new(); count];
    let mut order = 0;
    for inverse in inverses {
        for &k in &inverse.places {
            at[k as usize] = order;
            order += 1;
            for &(c, a) in &rows[k as usize] {
                if number[c as usize] != NONE {
                    columns[number[c as usize] as usize].push((k, a));
                }
            }
        }
    }
    let constraints: Vec<Constraint<T>> = multipliers
        .par_iter()
        .map(|&k| Constraint::new(&rows[k as usize], &at, &number))
        .collect();
    let mut complement = vec![0.0; count * count];
    let panels = complement.par_chunks_mut((count * WIDTH).max(1));
    panels
        .zip(columns.par_chunks(WIDTH))
        .enumerate()
        .for_each(|(k, (target, columns))| {
            let mut panel = vec![T::default(); order as usize * WIDTH];
            let mut first = 0;
            for inverse in inverses {
                let end = first + inverse.places.len() * WIDTH;
                multiplied(
                    inverse,
                    columns,
                    (&at, first / WIDTH),
                    &mut panel[first..end],
                );
                first = end;
            }
            let first = (k * WIDTH) as u32;
            for (row, constraint) in constraints.iter().enumerate() {
                let mut entries = [T::default(); WIDTH];
                let multiplied = Combined {
                    bulk: &constraint.bulk,
                    panel: &panel,
                    entries: &mut entries,
                };
                pulp::Arch::new().dispatch(multiplied);
                for &(column, a) in &constraint.multipliers {
                    if let Some(lane) = column.checked_sub(first)
                        && (lane as usize) < columns.len()
                    {
                        entries[lane as usize] += T::of(a);
                    }
                }
                let targets = target.iter_mut().skip(row).step_by(count);
                targets.zip(&entries).for_each(|(t, e)| *t = e.double());
            }
        });
    complement
}

/// A row of `[G G_m]`.
struct Constraint<T> {
    /// Rows of the panel and entries with the other sign.
    bulk: Vec<(u32, T)>,
    /// Numbers of multipliers and entries.
    multipliers: Row,
}

impl<T: Real> Constraint<T> {
    fn new(row: &Row, at: &[u32], number: &[u32]) -> Self {
        let bulk = row.iter().filter(|e| at[e.0 as usize] != NONE);
        let others = row.iter().filter(|e| number[e.0 as usize] != NONE);
        Self {
            bulk: bulk.map(|&(k, a)| (at[k as usize], T::of(-a))).collect(),
            multipliers: others.map(|&(k, a)| (number[k as usize], a)).collect(),
        }
    }
}

/// `F C` for some columns and one body, row by row.
fn multiplied<T: Real>(
    inverse: &Inverse<T>,
    columns: &[Row],
    (at, first): (&[u32], usize),
    panel: &mut [T],
) {
    let n = inverse.places.len();
    let own = |k: u32| {
        (at[k as usize] as usize)
            .checked_sub(first)
            .filter(|&i| i < n)
    };
    // Rows in which the columns have entries.
    let mut place = vec![NONE; n];
    let entries = columns.iter().flatten();
    entries
        .filter_map(|&(k, _)| own(k))
        .for_each(|i| place[i] = 0);
    let runs = runs(&place);
    let mut dense: Vec<T> = Vec::new();
    for run in &runs {
        for i in run.clone() {
            place[i] = (dense.len() / WIDTH) as u32;
            dense.resize(dense.len() + WIDTH, T::default());
        }
    }
    for (lane, column) in columns.iter().enumerate() {
        for &(k, a) in column {
            if let Some(i) = own(k) {
                dense[place[i] as usize * WIDTH + lane] += T::of(a);
            }
        }
    }
    for run in runs {
        let first = place[run.start] as usize * WIDTH;
        matmul(
            MatMut::from_row_major_slice_mut(panel, n, WIDTH),
            Accum::Add,
            MatRef::from_column_major_slice(
                &inverse.values[run.start * n..run.end * n],
                n,
                run.len(),
            ),
            MatRef::from_row_major_slice(&dense[first..][..run.len() * WIDTH], run.len(), WIDTH),
            T::of(1.0),
            Par::Seq,
        );
    }
}

/// Ranges of rows that are marked, with gaps too short to be worth a product of their own.
fn runs(marked: &[u32]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for i in (0..marked.len()).filter(|&i| marked[i] != NONE) {
        match runs.last_mut().filter(|run| i - run.end <= GAP) {
            Some(run) => run.end = i + 1,
            None => runs.push(i..i + 1),
        }
    }
    runs
}

/// A sparse combination of the rows of a panel.
struct Combined<'a, T> {
    bulk: &'a [(u32, T)],
    panel: &'a [T],
    entries: &'a mut [T; WIDTH],
}

impl<T: Real> WithSimd for Combined<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (sums, _) = T::lanes_mut::<S>(self.entries);
        for &(row, factor) in self.bulk {
            let (values, _) = T::lanes::<S>(&self.panel[row as usize * WIDTH..][..WIDTH]);
            let factor = T::splat(simd, factor);
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum = T::multiply_add(simd, *value, factor, *sum);
            }
        }
    }
}

#[cfg(test)]
mod tests;
