//! Elimination of short rows from a matrix whose other rows are dense.
//!
//! Rows `g_r` are eliminated one after the other, the shortest first; each
//! pivots on one of its largest entries in the column that fewest rows share
//! (Markowitz, doi:10.1287/mnsc.3.3.255, with threshold). A row that becomes
//! long or vanishes is *deferred*: it is left to the dense part. What is
//! recorded serves for right-hand sides, for solutions, and for the dense rows,
//! whose columns are combined: `d_j -= d_c u_j / u_c` for every pivot `(r, c)`.

use std::collections::BTreeSet;

/// Share of the largest entry in its row that a pivot must have.
const THRESHOLD: f64 = 0.1;
/// Entry of an equilibrated matrix that counts as zero.
const TINY: f64 = 1e-9;
/// Share of the largest entry in its row below which an entry is dropped at the start.
pub const DROPPED: f64 = 1e-16;

/// Entries of a row with their columns, rising.
pub type Row = Vec<(u32, f64)>;

/// Record of an elimination, in order.
#[derive(Debug, Default)]
pub struct SparseElimination {
    /// The steps.
    pub pivots: Vec<Pivot>,
    /// Other entries of the pivot rows, all divided by the pivot.
    upper: Vec<(u32, f64)>,
    /// Multiples of the pivot row that were taken off other rows.
    lower: Vec<(u32, f64)>,
    /// Rows that were left.
    pub deferred: Vec<u32>,
}

/// One elimination step.
#[derive(Clone, Copy, Debug)]
pub struct Pivot {
    /// Row of the pivot.
    pub row: u32,
    /// Its column.
    pub column: u32,
    value: f64,
    upper: (usize, usize),
    lower: (usize, usize),
}

/// Preference for a column as a pivot: low ranks first.
pub type Ranks<'a> = &'a [u8];

impl SparseElimination {
    /// Eliminates rows that do not become longer than `longest`.
    pub fn new(rows: Vec<Row>, ranks: Ranks<'_>, longest: usize) -> Self {
        let mut active = Active::new(rows, ranks.len());
        let mut done = Self::default();
        while let Some((length, r)) = active.queue.pop_first() {
            let row = std::mem::take(&mut active.rows[r as usize]);
            row.iter()
                .for_each(|&(c, _)| active.counts[c as usize] -= 1);
            match active.pivot(&row, ranks).filter(|_| length <= longest) {
                Some(place) => done.eliminate(&mut active, r, row, place),
                None => done.deferred.push(r),
            }
        }
        done.deferred.sort_unstable();
        done
    }

    fn eliminate(&mut self, active: &mut Active, r: u32, row: Row, place: usize) {
        let (column, value) = row[place];
        let (upper, lower) = (self.upper.len(), self.lower.len());
        let others = row.iter().filter(|&&(c, _)| c != column);
        self.upper.extend(others.map(|&(c, a)| (c, a / value)));
        let pivot_row = &self.upper[upper..];
        for i in std::mem::take(&mut active.holders[column as usize]) {
            let Some(factor) = active.remove(i, column) else {
                continue;
            };
            self.lower.push((i, factor / value));
            active.subtract(i, factor, pivot_row);
        }
        self.pivots.push(Pivot {
            row: r,
            column,
            value,
            upper: (upper, self.upper.len()),
            lower: (lower, self.lower.len()),
        });
    }

    /// Other entries of a pivot row over the pivot.
    pub fn upper(&self, pivot: &Pivot) -> &[(u32, f64)] {
        &self.upper[pivot.upper.0..pivot.upper.1]
    }

    /// Multiples of a pivot row that were taken off other rows.
    fn lower(&self, pivot: &Pivot) -> &[(u32, f64)] {
        &self.lower[pivot.lower.0..pivot.lower.1]
    }

    /// Columns of dense rows: `d_j -= d_c u_j / u_c` for every pivot.
    pub fn combine_columns<const W: usize>(&self, columns: &mut [[f64; W]]) {
        for pivot in &self.pivots {
            let own = columns[pivot.column as usize];
            if own.iter().all(|&d| d == 0.0) {
                continue;
            }
            for &(j, u) in self.upper(pivot) {
                let target = &mut columns[j as usize];
                for lane in 0..W {
                    target[lane] -= own[lane] * u;
                }
            }
        }
    }

    /// The right-hand side of the pivot rows after elimination.
    pub fn forward(&self, rhs: &mut [f64]) {
        for pivot in &self.pivots {
            let own = rhs[pivot.row as usize];
            for &(i, factor) in self.lower(pivot) {
                rhs[i as usize] -= factor * own;
            }
        }
    }

    /// The unknowns of the pivots from an eliminated right-hand side and the others.
    pub fn backward(&self, rhs: &[f64], x: &mut [f64]) {
        for pivot in self.pivots.iter().rev() {
            let known: f64 = self
                .upper(pivot)
                .iter()
                .map(|&(j, u)| u * x[j as usize])
                .sum();
            x[pivot.column as usize] = rhs[pivot.row as usize] / pivot.value - known;
        }
    }

    /// Solves with the transposed pivot block: rows and columns change parts.
    ///
    /// `combined` is the right-hand side by columns after
    /// [`combine_columns`](Self::combine_columns), `x` the solution by rows.
    pub fn backward_transposed(&self, combined: &[f64], x: &mut [f64]) {
        for pivot in self.pivots.iter().rev() {
            let known: f64 = self
                .lower(pivot)
                .iter()
                .map(|&(i, factor)| factor * x[i as usize])
                .sum();
            x[pivot.row as usize] = combined[pivot.column as usize] / pivot.value - known;
        }
    }

    /// Entries recorded for dense rows.
    pub fn entries(&self) -> usize {
        self.upper.len()
    }
}

/// Rows that are left, and who holds which column.
struct Active {
    rows: Vec<Row>,
    /// Rows that may hold a column.
    holders: Vec<Vec<u32>>,
    /// Rows that do.
    counts: Vec<u32>,
    queue: BTreeSet<(usize, u32)>,
    merged: Row,
}

impl Active {
    fn new(mut rows: Vec<Row>, columns: usize) -> Self {
        let mut holders = vec![Vec::new(); columns];
        let mut counts = vec![0; columns];
        let mut queue = BTreeSet::new();
        for (r, row) in rows.iter_mut().enumerate() {
            let largest = row.iter().fold(0.0_f64, |m, e| m.max(e.1.abs()));
            row.retain(|&(_, a)| a.abs() > DROPPED * largest);
            for &(c, _) in row.iter() {
                holders[c as usize].push(r as u32);
                counts[c as usize] += 1;
            }
            queue.insert((row.len(), r as u32));
        }
        Self {
            rows,
            holders,
            counts,
            queue,
            merged: Row::new(),
        }
    }

    /// Place of the pivot in a row.
    fn pivot(&self, row: &Row, ranks: Ranks<'_>) -> Option<usize> {
        let largest = row.iter().fold(0.0_f64, |m, e| m.max(e.1.abs()));
        let key = |&place: &usize| {
            let (c, _) = row[place];
            (ranks[c as usize], self.counts[c as usize])
        };
        let acceptable = |&place: &usize| row[place].1.abs() >= THRESHOLD * largest;
        if largest.is_nan() || largest <= TINY {
            return None;
        }
        let mut best = None;
        for place in (0..row.len()).filter(acceptable) {
            let better = best.is_none_or(|old: usize| {
                key(&place) < key(&old)
                    || key(&place) == key(&old) && row[place].1.abs() > row[old].1.abs()
            });
            if better {
                best = Some(place);
            }
        }
        best
    }

    /// Takes an entry out of a row.
    fn remove(&mut self, i: u32, column: u32) -> Option<f64> {
        let row = &mut self.rows[i as usize];
        let place = row.binary_search_by_key(&column, |e| e.0).ok()?;
        self.queue.remove(&(row.len(), i));
        Some(row.remove(place).1)
    }

    /// `row_i -= factor * pivot_row`, after an entry was removed.
    fn subtract(&mut self, i: u32, factor: f64, pivot_row: &[(u32, f64)]) {
        let row = &self.rows[i as usize];
        self.merged.clear();
        let mut rest = row.iter().copied().peekable();
        for &(c, u) in pivot_row {
            while let Some(entry) = rest.next_if(|e| e.0 < c) {
                self.merged.push(entry);
            }
            match rest.next_if(|e| e.0 == c) {
                Some((_, a)) => self.merged.push((c, a - factor * u)),
                None => {
                    self.merged.push((c, -factor * u));
                    self.holders[c as usize].push(i);
                    self.counts[c as usize] += 1;
                }
            }
        }
        self.merged.extend(rest);
        std::mem::swap(&mut self.rows[i as usize], &mut self.merged);
        self.queue.insert((self.rows[i as usize].len(), i));
    }
}

#[cfg(test)]
mod tests;
