//! Kept unknowns that contact does not touch now.
//!
//! Nodes are kept where contact may touch them. Those it does not touch belong to
//! the bodies: their unknowns `f` are eliminated from the Schur complement of their
//! body once, and contact is solved on the others, `p`, while it touches no more than
//! those. With `S` the complement and `A` the body's entries between kept unknowns,
//!
//! ```text
//! L L^T = (S + A)_ff,   W = (S + A)_pf L^-T,   S_pp - W W^T
//! ```

use super::NONE;
use crate::interface::{Block, Kind};
use rayon::prelude::*;
use striae_sparse::{
    Real, Values, mirror_lower,
    sparse_elimination::Row,
    symmetric,
    triangular::{self, Diagonal, solve_lower, solve_lower_transposed},
};

/// Part by which two mirrored entries of a scaled matrix differ where contact is in them.
const ASYMMETRIC: f64 = 1e-8;
/// Columns of a matrix that a thread takes to the next one at a time.
const COLUMNS: usize = 32;

/// Eliminated unknowns of one body.
#[derive(Debug)]
pub(super) struct Untouched {
    /// Kept unknowns that are eliminated, and those of the body that are left.
    eliminated: Vec<u32>,
    left: Vec<u32>,
    factors: Factors,
}

/// Factors in the precision of the complement.
#[derive(Debug)]
enum Factors {
    Single(Parts<f32>),
    Double(Parts<f64>),
}

/// `L` above `W`, and both triangles of the complement that is left.
#[derive(Debug)]
struct Parts<T> {
    columns: Vec<T>,
    complement: Vec<T>,
}

impl Untouched {
    /// Eliminates what is not touched; `None` when there is nothing or a pivot is below
    /// the smallest of a regular system.
    ///
    /// `rows` are the scaled entries between kept unknowns.
    pub(super) fn new(
        block: &Block<'_>,
        rows: &[Row],
        touched: &[bool],
        smallest: f64,
    ) -> Option<Self> {
        let within = 0..block.places.len() as u32;
        let is_left = |&row: &u32| touched[block.places[row as usize] as usize];
        let (left, eliminated): (Vec<u32>, Vec<u32>) = within.partition(is_left);
        if eliminated.is_empty() {
            return None;
        }
        let order = [&eliminated[..], &left].concat();
        let factors = match block.values {
            Values::Single(values) => {
                let parts = Parts::new((block, values), rows, &order, left.len(), smallest);
                Factors::Single(parts?)
            }
            Values::Double(values) => {
                let parts = Parts::new((block, values), rows, &order, left.len(), smallest);
                Factors::Double(parts?)
            }
        };
        let places = |rows: Vec<u32>| rows.iter().map(|&r| block.places[r as usize]).collect();
        Some(Self {
            eliminated: places(eliminated),
            left: places(left),
            factors,
        })
    }

    /// Kept unknowns that are eliminated.
    pub(super) fn eliminated(&self) -> &[u32] {
        &self.eliminated
    }

    /// Takes the eliminated unknowns out of the contact system, and numbers the rows of
    /// the others.
    pub(super) fn set_apart(&self, kinds: &mut [Kind], rows: &mut [Row]) {
        for &k in &self.eliminated {
            kinds[k as usize] = Kind::Apart;
            rows[k as usize].clear();
        }
        for (at, &k) in self.left.iter().enumerate() {
            if let Kind::Bulk { row, .. } = &mut kinds[k as usize] {
                *row = at as u32;
            }
            rows[k as usize].retain(|&(to, _)| kinds[to as usize] != Kind::Apart);
        }
    }

    /// Remaining block of the complement.
    pub(super) fn block(&self) -> Block<'_> {
        Block {
            places: &self.left,
            values: match &self.factors {
                Factors::Single(parts) => Values::Single(&parts.complement),
                Factors::Double(parts) => Values::Double(&parts.complement),
            },
        }
    }

    /// Operations of the elimination.
    pub(super) fn flops(&self) -> f64 {
        let (f, p) = (self.eliminated.len() as f64, self.left.len() as f64);
        f * (f * f / 3.0 + f * p + p * p)
    }

    /// Entries of `L` and `W`.
    pub(super) fn entries(&self) -> usize {
        self.eliminated.len() * (self.eliminated.len() + self.left.len())
    }

    /// `y_f := L^-1 y_f`, `y_p := y_p - W y_f`, by kept unknowns.
    pub(super) fn condense(&self, y: &mut [f64]) {
        match &self.factors {
            Factors::Single(parts) => parts.condense(&self.eliminated, &self.left, y),
            Factors::Double(parts) => parts.condense(&self.eliminated, &self.left, y),
        }
    }

    /// `y_f := L^-T (y_f - W^T y_p)`, by kept unknowns.
    pub(super) fn expand(&self, y: &mut [f64]) {
        match &self.factors {
            Factors::Single(parts) => parts.expand(&self.eliminated, &self.left, y),
            Factors::Double(parts) => parts.expand(&self.eliminated, &self.left, y),
        }
    }
}

impl<T: Real> Parts<T> {
    /// `order` are the rows of the block, those that stay last.
    fn new(
        (block, values): (&Block<'_>, &[T]),
        rows: &[Row],
        order: &[u32],
        left: usize,
        smallest: f64,
    ) -> Option<Self> {
        let (size, pivots) = (order.len(), order.len() - left);
        let mut position = vec![NONE; rows.len()];
        for (at, &row) in order.iter().enumerate() {
            position[block.places[row as usize] as usize] = at as u32;
        }
        let source = |at: usize| &values[order[at] as usize * size..][..size];
        let mut columns = vec![T::default(); size * pivots];
        let targets = columns.par_chunks_mut(size.max(1)).with_min_len(COLUMNS);
        targets.enumerate().for_each(|(at, target)| {
            let source = source(at);
            let values = order.iter().map(|&row| source[row as usize]);
            target.iter_mut().zip(values).for_each(|(t, s)| *t = s);
            for &(k, a) in &rows[block.places[order[at] as usize] as usize] {
                if position[k as usize] != NONE {
                    target[position[k as usize] as usize] += T::of(a);
                }
            }
        });
        let mut complement = vec![T::default(); left * left];
        let targets = complement.par_chunks_mut(left.max(1)).with_min_len(COLUMNS);
        targets.enumerate().for_each(|(at, target)| {
            let source = source(pivots + at);
            let values = order[pivots..].iter().map(|&row| source[row as usize]);
            target.iter_mut().zip(values).for_each(|(t, s)| *t = s);
        });
        let failure = symmetric::eliminate(&mut columns, &mut complement, size);
        if failure.is_some() || smallest_pivot(&columns, size) < smallest {
            return None;
        }
        mirror_lower(&mut complement, left);
        Some(Self {
            columns,
            complement,
        })
    }

    fn condense(&self, eliminated: &[u32], left: &[u32], y: &mut [f64]) {
        let mut x: Vec<T> = eliminated.iter().map(|&k| T::of(y[k as usize])).collect();
        x.resize(eliminated.len() + left.len(), T::default());
        let columns = triangular::Block::new(&self.columns, x.len());
        solve_lower(columns, Diagonal::Stored, &mut x, eliminated.len());
        let (own, taken) = x.split_at(eliminated.len());
        for (&k, x) in eliminated.iter().zip(own) {
            y[k as usize] = x.double();
        }
        for (&k, x) in left.iter().zip(taken) {
            y[k as usize] += x.double();
        }
    }

    fn expand(&self, eliminated: &[u32], left: &[u32], y: &mut [f64]) {
        let known = eliminated.iter().chain(left);
        let mut x: Vec<T> = known.map(|&k| T::of(y[k as usize])).collect();
        let columns = triangular::Block::new(&self.columns, x.len());
        solve_lower_transposed(columns, Diagonal::Stored, &mut x, eliminated.len());
        for (&k, x) in eliminated.iter().zip(&x) {
            y[k as usize] = x.double();
        }
    }
}

/// Smallest of the squares on the diagonal of `L`.
fn smallest_pivot<T: Real>(columns: &[T], size: usize) -> f64 {
    let diagonal = columns.iter().step_by(size + 1);
    diagonal
        .map(|l| l.double().powi(2))
        .fold(f64::INFINITY, f64::min)
}

/// Kept unknowns that contact touches or has touched.
pub(super) struct Touched {
    /// Flags of the kept unknowns that contact touches.
    pub(super) touched: Vec<bool>,
    /// `true` if there are more than before.
    pub(super) is_more: bool,
}

/// Kept unknowns that contact touches: bulk unknowns that share an entry with a multiplier or with
/// another body, or whose mirror entry differs. Unknowns that are solved for separately count as
/// touched, and so do those touched `before`, if these are known.
pub(super) fn touched(kinds: &[Kind], rows: &[Row], before: Vec<bool>) -> Touched {
    let entry = |i: u32, j: u32| {
        let row = &rows[i as usize];
        let found = row.binary_search_by_key(&j, |e| e.0);
        found.map_or(0.0, |at| row[at].1)
    };
    let is_new = |k: usize| before.get(k).is_none_or(|touched| !touched);
    let by_row = rows.par_iter().enumerate().with_min_len(64);
    let coupled = by_row.flat_map_iter(|(k, row)| {
        let own = k as u32;
        let own_is_new = is_new(k);
        let couples = move |&&(c, a): &&(u32, f64)| {
            (own_is_new || is_new(c as usize))
                && match (kinds[k], kinds[c as usize]) {
                    (Kind::Bulk { block, .. }, Kind::Bulk { block: other, .. }) => {
                        block != other || (a - entry(c, own)).abs() > ASYMMETRIC
                    }
                    _ => true,
                }
        };
        let entries = row.iter().filter(couples);
        entries.flat_map(move |&(c, _)| [own, c])
    });
    let coupled: Vec<u32> = coupled.collect();
    let apart = kinds.iter().map(|&kind| kind == Kind::Apart);
    let mut touched: Vec<bool> = apart.collect();
    coupled.into_iter().for_each(|k| touched[k as usize] = true);
    let is_more = before.is_empty() || (0..touched.len()).any(|k| touched[k] && is_new(k));
    let sum = touched.iter_mut().zip(&before);
    sum.for_each(|(now, before)| *now |= before);
    Touched { touched, is_more }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touched_are_those_with_multipliers_other_bodies_or_unlike_mirror_images() {
        let bulk = |block: u32, row: u32| Kind::Bulk { block, row };
        let mut kinds: Vec<Kind> = (0..6).map(|row| bulk(0, row)).collect();
        kinds.extend([bulk(1, 0), Kind::Multiplier, Kind::Apart]);
        let mut rows: Vec<Row> = (0..9).map(|k| vec![(k, 1.0)]).collect();
        // Alike, to round-off.
        rows[0].push((1, 0.2));
        rows[1].insert(0, (0, 0.2 + 1e-15));
        // Not alike: only one of them has the entry.
        rows[2].push((3, 0.1));
        rows[4].push((6, -0.1));
        rows[7].insert(0, (5, 1.0));
        let expected = [false, false, true, true, true, true, true, true, true];
        assert_eq!(touched(&kinds, &rows, Vec::new()).touched, expected);
    }
}
