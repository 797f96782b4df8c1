//! The matrix of bodies in contact, in two parts.

use rayon::prelude::*;
use std::{borrow::Cow, cmp::Ordering, iter};
use striae_sparse::{CompressedRows, LinearOperator, RowSums, SparseMatrix, Structure};

/// Supervariables whose rows a thread puts together at a time.
const OWNERS: usize = 64;

/// Tangent of the bodies, and the terms that contact adds between kept supervariables.
///
/// A method that treats the bodies alone, as the condensed solver does for their interiors, need
/// not separate the two in one matrix; contact is renewed while the bodies stay. A [`SparseMatrix`]
/// is a tangent without contact.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// Elements, masses, ties and what is held, on the [pattern of the
    /// bodies](crate::Partition::structure).
    pub bodies: SparseMatrix,
    /// Contact, see [`Partition::gathered`](crate::Partition::gathered).
    pub contact: CompressedRows,
}

impl From<SparseMatrix> for Tangent {
    fn from(bodies: SparseMatrix) -> Self {
        Self {
            contact: CompressedRows::zero(bodies.structure().unknowns()),
            bodies,
        }
    }
}

impl Tangent {
    /// The zero matrix on a pattern of the bodies.
    pub fn zero(bodies: &Structure) -> Self {
        Self::from(SparseMatrix::zero(bodies))
    }

    /// Sets all values to zero.
    pub fn clear(&mut self) {
        self.bodies.clear();
        self.contact = CompressedRows::zero(self.unknowns());
    }

    /// Entries of a row with their columns, in rising order of the columns; some are zero.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let mut bodies = self.bodies.row(row).peekable();
        let mut contact = self.contact.row(row).peekable();
        iter::from_fn(move || {
            let (Some(own), Some(other)) = (bodies.peek(), contact.peek()) else {
                return bodies.next().or_else(|| contact.next());
            };
            match own.0.cmp(&other.0) {
                Ordering::Less => bodies.next(),
                Ordering::Greater => contact.next(),
                Ordering::Equal => {
                    let added = contact.next().map_or(0.0, |entry| entry.1);
                    bodies.next().map(|(column, a)| (column, a + added))
                }
            }
        })
    }

    /// An entry of the diagonal.
    pub(crate) fn diagonal(&self, unknown: usize) -> f64 {
        self.bodies.get(unknown, unknown).unwrap_or(0.0) + self.contact.get(unknown, unknown)
    }

    /// Both parts in one matrix on a [whole pattern](crate::Partition::whole).
    ///
    /// # Panics
    /// When an entry is outside that pattern.
    pub fn sum(&self, whole: &Structure) -> Cow<'_, SparseMatrix> {
        if self.contact.is_zero() && whole.same_as(self.bodies.structure()) {
            return Cow::Borrowed(&self.bodies);
        }
        let mut sum = SparseMatrix::zero(whole);
        let mut owners = Vec::with_capacity(whole.supervariables());
        let mut rest = sum.values_mut();
        for i in 0..whole.supervariables() {
            let (own, others) = rest.split_at_mut(whole.rows(i).len());
            owners.push((i, own));
            rest = others;
        }
        let owners = owners.into_par_iter().with_min_len(OWNERS);
        owners.for_each(|(i, values)| self.add_rows_of(i, whole, values));
        Cow::Owned(sum)
    }

    /// Puts the rows of a supervariable into those of a whole pattern.
    fn add_rows_of(&self, i: usize, whole: &Structure, values: &mut [f64]) {
        let (bodies, own) = (self.bodies.structure(), self.bodies.values());
        let length = whole.row_length(i);
        let has_place = "the whole pattern has both parts";
        for edge in bodies.edges(i) {
            let place = whole.edge(i, bodies.target(edge)).expect(has_place);
            let (to, from) = (whole.column(place), bodies.column(edge));
            let width = bodies.group(bodies.target(edge)).len();
            for local in 0..bodies.group(i).len() {
                let block = &own[bodies.row(i, local)][from..][..width];
                values[local * length + to..][..width].copy_from_slice(block);
            }
        }
        for (local, row) in whole.group(i).enumerate() {
            for (column, a) in self.contact.row(row) {
                let owner = whole.owner(column).0;
                let place = whole.edge(i, owner).expect(has_place);
                let at = whole.column(place) + column - whole.group(owner).start;
                values[local * length + at] += a;
            }
        }
    }
}

impl LinearOperator for Tangent {
    fn unknowns(&self) -> usize {
        self.bodies.structure().unknowns()
    }

    fn multiply(&self, x: &[f64], y: &mut [f64]) {
        self.bodies.multiply(x, y);
        self.contact.add_product(x, y);
    }

    fn row_sums(&self, x: &[f64], units: &[f64]) -> Vec<RowSums> {
        let mut sums = self.bodies.row_sums(x, units);
        self.contact.add_row_sums(x, units, &mut sums);
        sums
    }
}
