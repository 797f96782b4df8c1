//! Triplets of the tangent, one for each place.
//!
//! The rows of a node come from many terms, each with all that it depends on: ten times as many
//! entries as places. They are added up row by row, in the order of the terms, so that the sums do
//! not depend on the number of threads.

use rayon::prelude::*;

use super::numbers::Numbers;
use crate::term::LocalTerm;

/// Number of rows that a thread adds up at a time.
const ROWS: usize = 256;

/// Entries of a matrix, by row and then by column, both ascending.
#[derive(Clone, Debug, Default)]
pub(super) struct Triplets {
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
    pub values: Vec<f64>,
}

impl Triplets {
    /// Sums of the terms of all pairs.
    pub(super) fn of(terms: &[Vec<LocalTerm>], numbers: &Numbers) -> Self {
        let terms: Vec<(usize, &LocalTerm)> = terms
            .iter()
            .enumerate()
            .flat_map(|(pair, terms)| terms.iter().map(move |term| (pair, term)))
            .collect();
        let placed: Vec<Placed> = terms
            .par_iter()
            .map(|&(pair, term)| Placed::new(pair, term, numbers))
            .collect();
        let rows = Rows::of(&placed, numbers.all());
        let chunks: Vec<Self> = rows
            .stated
            .par_chunks(ROWS)
            .map(|stated| {
                let mut sums = Sums::new(numbers.all());
                let mut found = Self::default();
                for &row in stated {
                    for &(term, at) in rows.of_row(row) {
                        placed[term as usize].add_row(at as usize, &mut sums);
                    }
                    sums.drain(row, &mut found);
                }
                found
            })
            .collect();
        let count = chunks.iter().map(|chunk| chunk.values.len()).sum();
        let mut all = Self {
            rows: Vec::with_capacity(count),
            columns: Vec::with_capacity(count),
            values: Vec::with_capacity(count),
        };
        for chunk in chunks {
            all.rows.extend(chunk.rows);
            all.columns.extend(chunk.columns);
            all.values.extend(chunk.values);
        }
        all
    }
}

/// A term with the numbers of its unknowns in the system.
struct Placed<'a> {
    term: &'a LocalTerm,
    rows: Vec<usize>,
    /// Numbers of the triples of its columns, a third of those of their first unknowns.
    triples: Vec<usize>,
}

impl<'a> Placed<'a> {
    fn new(pair: usize, term: &'a LocalTerm, numbers: &Numbers) -> Self {
        let number = |&unknown: &u32| numbers.number(pair, unknown);
        Self {
            term,
            rows: term.rows.iter().map(number).collect(),
            triples: term
                .columns
                .iter()
                .step_by(3)
                .map(number)
                .map(|first| first / 3)
                .collect(),
        }
    }

    fn add_row(&self, at: usize, sums: &mut Sums) {
        let width = self.term.columns.len();
        let values = self.term.tangent[at * width..(at + 1) * width].chunks_exact(3);
        for (&triple, values) in self.triples.iter().zip(values) {
            sums.add(triple, values);
        }
    }
}

/// Terms that state each row, and which of their rows it is.
struct Rows {
    /// Rows that some term states, ascending.
    stated: Vec<usize>,
    /// First entry of every row in `by`, and the number of entries at the end.
    first: Vec<usize>,
    by: Vec<(u32, u32)>,
}

impl Rows {
    fn of(placed: &[Placed], count: usize) -> Self {
        let mut first = vec![0; count + 1];
        for &row in placed.iter().flat_map(|term| &term.rows) {
            first[row + 1] += 1;
        }
        let stated = (0..count).filter(|&row| first[row + 1] > 0).collect();
        for row in 0..count {
            first[row + 1] += first[row];
        }
        let mut next = first.clone();
        let mut by = vec![(0, 0); first[count]];
        for (term, placed) in placed.iter().enumerate() {
            for (at, &row) in placed.rows.iter().enumerate() {
                by[next[row]] = (term as u32, at as u32);
                next[row] += 1;
            }
        }
        Self { stated, first, by }
    }

    fn of_row(&self, row: usize) -> &[(u32, u32)] {
        &self.by[self.first[row]..self.first[row + 1]]
    }
}

/// Sums of the entries of a row.
struct Sums {
    values: Vec<[f64; 3]>,
    is_touched: Vec<bool>,
    touched: Vec<usize>,
}

impl Sums {
    fn new(unknowns: usize) -> Self {
        Self {
            values: vec![[0.0; 3]; unknowns / 3],
            is_touched: vec![false; unknowns / 3],
            touched: Vec::new(),
        }
    }

    fn add(&mut self, triple: usize, values: &[f64]) {
        if !self.is_touched[triple] {
            self.is_touched[triple] = true;
            self.touched.push(triple);
        }
        for (sum, value) in self.values[triple].iter_mut().zip(values) {
            *sum += value;
        }
    }

    /// Moves the sums of a row to the entries found, and is empty again.
    fn drain(&mut self, row: usize, found: &mut Triplets) {
        self.touched.sort_unstable();
        for triple in self.touched.drain(..) {
            self.is_touched[triple] = false;
            for (component, value) in std::mem::take(&mut self.values[triple])
                .into_iter()
                .enumerate()
            {
                found.rows.push(row);
                found.columns.push(3 * triple + component);
                found.values.push(value);
            }
        }
    }
}
