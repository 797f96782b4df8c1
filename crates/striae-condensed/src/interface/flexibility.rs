//! The flexibility of a body: the dense inverse of its stiffness at what contact touches.
//!
//! With `S` the Schur complement of the body on its kept unknowns and `A` the entries
//! between them in the matrix, which may hold terms of contact that are not symmetric,
//!
//! ```text
//! F = (S + (A + A^T) / 2)^-1 = L^-T L^-1
//! ```
//!
//! `F` is found once for each factorisation of the interior and kept while contact
//! touches no more. It serves as a preconditioner only: that `A` changes meanwhile
//! costs iterations, not accuracy. Products are cut into pieces that depend on the
//! sizes alone, so that threads do not change a bit.

use super::{Block, Kind};
use faer::{
    Accum, Par,
    linalg::{matmul::matmul, triangular_solve::solve_lower_triangular_in_place},
    mat::{MatMut, MatRef},
};
use rayon::prelude::*;
use striae_sparse::{
    Real, Values, mirror_lower,
    sparse_elimination::Row,
    symmetric,
    triangular::{self, subtract},
};

/// Columns of the inverse in a piece.
const PIECE: usize = 96;
/// Not in this body.
const NONE: u32 = u32::MAX;

/// Inverses of all bodies, in the precision of their complements.
#[derive(Debug)]
pub(crate) enum Flexibility {
    /// In single precision.
    Single(Vec<Inverse<f32>>),
    /// In double precision.
    Double(Vec<Inverse<f64>>),
}

/// Inverse of the stiffness of one body.
#[derive(Debug)]
pub(crate) struct Inverse<T> {
    /// Kept unknown of each row.
    pub(crate) places: Vec<u32>,
    /// Both triangles, column by column.
    pub(crate) values: Vec<T>,
}

impl Flexibility {
    /// Inverts the stiffness of every body; `None` where one has a pivot below the
    /// smallest of a regular system, as a body has that nothing but contact holds.
    ///
    /// `rows` are the scaled entries between kept unknowns.
    pub(crate) fn new(
        blocks: &[Block<'_>],
        (kinds, rows): (&[Kind], &[Row]),
        smallest: f64,
    ) -> Option<Self> {
        let is_single = |block: &Block<'_>| matches!(block.values, Values::Single(_));
        let blocks = blocks.par_iter();
        if blocks.clone().all(is_single) {
            let inverses = blocks.map(|block| Inverse::new(block, (kinds, rows), smallest));
            inverses.collect::<Option<_>>().map(Self::Single)
        } else {
            let inverses = blocks.map(|block| Inverse::new(block, (kinds, rows), smallest));
            inverses.collect::<Option<_>>().map(Self::Double)
        }
    }
}

impl<T: Real> Inverse<T> {
    fn new(block: &Block<'_>, (kinds, rows): (&[Kind], &[Row]), smallest: f64) -> Option<Self> {
        let is_bulk = |&row: &u32| kinds[block.places[row as usize] as usize] != Kind::Apart;
        let own: Vec<u32> = (0..block.places.len() as u32).filter(is_bulk).collect();
        let places: Vec<u32> = own.iter().map(|&r| block.places[r as usize]).collect();
        let n = own.len();
        let mut stiffness = vec![T::default(); n * n];
        let columns = stiffness.par_chunks_mut(n.max(1)).zip(&own);
        columns.for_each(|(target, &column)| match block.values {
            Values::Single(values) => {
                let source = &values[column as usize * block.places.len()..];
                let source = own.iter().map(|&row| T::of(source[row as usize].double()));
                target.iter_mut().zip(source).for_each(|(t, s)| *t = s);
            }
            Values::Double(values) => {
                let source = &values[column as usize * block.places.len()..];
                let source = own.iter().map(|&row| T::of(source[row as usize]));
                target.iter_mut().zip(source).for_each(|(t, s)| *t = s);
            }
        });
        let mut position = vec![NONE; rows.len()];
        for (at, &place) in places.iter().enumerate() {
            position[place as usize] = at as u32;
        }
        for (i, &place) in places.iter().enumerate() {
            for &(to, a) in &rows[place as usize] {
                let j = position[to as usize];
                if j != NONE {
                    let half = T::of(0.5 * a);
                    stiffness[i * n + j as usize] += half;
                    stiffness[j as usize * n + i] += half;
                }
            }
        }
        let values = inverse(stiffness, n, smallest)?;
        Some(Self { places, values })
    }

    /// `y := F x` for vectors of the body.
    pub(crate) fn product(&self, x: &[T], y: &mut [T]) {
        let minus: Vec<T> = x.iter().map(|&x| T::default() - x).collect();
        y.fill(T::default());
        subtract(y, triangular::Block::new(&self.values, x.len()), &minus);
    }
}

/// Inverse of a symmetric matrix of order `n`; `None` where a square on the diagonal of
/// its Cholesky factor is below `smallest`.
fn inverse<T: Real>(mut matrix: Vec<T>, n: usize, smallest: f64) -> Option<Vec<T>> {
    let failure = symmetric::eliminate(&mut matrix, &mut [], n);
    let diagonal = matrix.iter().step_by(n + 1);
    let pivots = diagonal.map(|l| l.double().powi(2));
    if failure.is_some() || pivots.fold(f64::INFINITY, f64::min) < smallest {
        return None;
    }
    let lower = MatRef::from_column_major_slice(&matrix, n, n);
    let mut inverted = vec![T::default(); n * n];
    let pieces = inverted.par_chunks_mut((PIECE * n).max(1)).enumerate();
    pieces.for_each(|(k, piece)| {
        let (first, columns) = (k * PIECE, piece.len() / n);
        (0..columns).for_each(|c| piece[c * n + first + c] = T::of(1.0));
        let piece = MatMut::from_column_major_slice_mut(piece, n, columns);
        let (_, below) = piece.split_at_row_mut(first);
        solve_lower_triangular_in_place(lower.get(first.., first..), below, Par::Seq);
    });
    let inverted = MatRef::from_column_major_slice(&inverted, n, n);
    // The factor is not needed any more.
    let pieces = matrix.par_chunks_mut((PIECE * n).max(1)).enumerate();
    pieces.for_each(|(k, piece)| {
        let (first, columns) = (k * PIECE, piece.len() / n);
        let piece = MatMut::from_column_major_slice_mut(piece, n, columns);
        let (_, below) = piece.split_at_row_mut(first);
        let own = inverted.get(first.., first..first + columns);
        let all = inverted.get(first.., first..).transpose();
        matmul(below, Accum::Replace, all, own, T::of(1.0), Par::Seq);
    });
    mirror_lower(&mut matrix, n);
    Some(matrix)
}
