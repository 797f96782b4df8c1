//! Forward and backward substitution with multifrontal factors, for the
//! factored matrix and its transpose.

use crate::{front::FrontFactor, numeric::Numeric, tree::AssemblyTree};
use faer::{
    Accum, Par,
    linalg::{matmul::matmul, triangular_solve as triangular},
    mat::{MatMut, MatRef},
};

/// `x := A^-1 x`.
pub(crate) fn solve(tree: &AssemblyTree, numeric: &Numeric<FrontFactor>, x: &mut [f64]) {
    let storage = storage(tree);
    let mut solution = vec![0.0; x.len()];
    for (f, factor) in numeric.fronts.iter().enumerate() {
        let blocks = Blocks::new(factor, &numeric.values[storage[f]..]);
        blocks.forward(&factor.rows, x);
    }
    for (f, factor) in numeric.fronts.iter().enumerate().rev() {
        let blocks = Blocks::new(factor, &numeric.values[storage[f]..]);
        blocks.backward(&factor.rows, &factor.columns, x, &mut solution);
    }
    x.copy_from_slice(&solution);
}

/// `x := A^-T x`.
pub(crate) fn solve_transposed(tree: &AssemblyTree, numeric: &Numeric<FrontFactor>, x: &mut [f64]) {
    let storage = storage(tree);
    let mut solution = vec![0.0; x.len()];
    for (f, factor) in numeric.fronts.iter().enumerate() {
        let blocks = Blocks::new(factor, &numeric.values[storage[f]..]);
        blocks.forward_transposed(&factor.rows, &factor.columns, x, &mut solution);
    }
    for (f, factor) in numeric.fronts.iter().enumerate().rev() {
        let blocks = Blocks::new(factor, &numeric.values[storage[f]..]);
        blocks.backward_transposed(&factor.rows, &mut solution);
    }
    x.copy_from_slice(&solution);
}

/// Begin of the storage of each front.
fn storage(tree: &AssemblyTree) -> Vec<usize> {
    let mut next = 0;
    let begin = |front: &crate::tree::Front| {
        next += front.entries();
        next - front.entries()
    };
    tree.fronts.iter().map(begin).collect()
}

/// Factors of one front, `[L\U U_delayed U_border; L_below]`.
struct Blocks<'a> {
    /// `L` (unit, below the diagonal) and `U` of the pivots.
    pivots: MatRef<'a, f64>,
    /// Rows of `L` below the pivots.
    below: MatRef<'a, f64>,
    /// Columns of `U` of delayed pivots.
    delayed: MatRef<'a, f64>,
    /// Columns of `U` of the border.
    border: MatRef<'a, f64>,
}

impl<'a> Blocks<'a> {
    fn new(factor: &'a FrontFactor, planned: &'a [f64]) -> Self {
        let (size, summed, count) = (factor.size(), factor.summed, factor.pivots);
        let (left, above) = factor.values(planned);
        let above = &above[..summed * (size - summed)];
        let left = MatRef::from_column_major_slice(left, size, summed);
        let above = MatRef::from_column_major_slice(above, summed, size - summed);
        Self {
            pivots: left.submatrix(0, 0, count, count),
            below: left.submatrix(count, 0, size - count, count),
            delayed: left.submatrix(0, count, count, summed - count),
            border: above.submatrix(0, 0, count, size - summed),
        }
    }

    fn count(&self) -> usize {
        self.pivots.nrows()
    }

    /// `y := L^-1 y` in the rows of the front.
    fn forward(&self, rows: &[u32], y: &mut [f64]) {
        let (mut pivots, mut rest) = gather(rows, y, self.count());
        triangular::solve_unit_lower_triangular_in_place(
            self.pivots,
            column(&mut pivots),
            Par::Seq,
        );
        subtract(&mut rest, self.below, &pivots);
        scatter(rows, y, &pivots, &rest);
    }

    /// Solves for the pivot columns, from `y` by rows and `x` by columns.
    fn backward(&self, rows: &[u32], columns: &[u32], y: &[f64], x: &mut [f64]) {
        let (mut pivots, _) = gather(&rows[..self.count()], y, self.count());
        let (_, known) = gather(columns, x, self.count());
        let (delayed, border) = known.split_at(self.delayed.ncols());
        subtract(&mut pivots, self.delayed, delayed);
        subtract(&mut pivots, self.border, border);
        triangular::solve_upper_triangular_in_place(self.pivots, column(&mut pivots), Par::Seq);
        scatter(&columns[..self.count()], x, &pivots, &[]);
    }

    /// `y := U^-T y` in the columns of the front; pivots are put into `x` by rows.
    fn forward_transposed(&self, rows: &[u32], columns: &[u32], y: &mut [f64], x: &mut [f64]) {
        let (mut pivots, mut rest) = gather(columns, y, self.count());
        let lower = self.pivots.transpose();
        triangular::solve_lower_triangular_in_place(lower, column(&mut pivots), Par::Seq);
        let (delayed, border) = rest.split_at_mut(self.delayed.ncols());
        subtract(delayed, self.delayed.transpose(), &pivots);
        subtract(border, self.border.transpose(), &pivots);
        scatter(columns, y, &pivots, &rest);
        scatter(&rows[..self.count()], x, &pivots, &[]);
    }

    /// `x := L^-T x` in the rows of the front.
    fn backward_transposed(&self, rows: &[u32], x: &mut [f64]) {
        let (mut pivots, rest) = gather(rows, x, self.count());
        subtract(&mut pivots, self.below.transpose(), &rest);
        let upper = self.pivots.transpose();
        triangular::solve_unit_upper_triangular_in_place(upper, column(&mut pivots), Par::Seq);
        scatter(&rows[..self.count()], x, &pivots, &[]);
    }
}

/// `y -= A x`.
fn subtract(y: &mut [f64], a: MatRef<'_, f64>, x: &[f64]) {
    if !y.is_empty() && !x.is_empty() {
        let x = MatRef::from_column_major_slice(x, x.len(), 1);
        matmul(column(y), Accum::Add, a, x, -1.0, Par::Seq);
    }
}

fn column(v: &mut [f64]) -> MatMut<'_, f64> {
    let rows = v.len();
    MatMut::from_column_major_slice_mut(v, rows, 1)
}

/// Entries of a vector at some places, the first `count` apart.
fn gather(places: &[u32], v: &[f64], count: usize) -> (Vec<f64>, Vec<f64>) {
    let (first, others) = places.split_at(count);
    let at = |places: &[u32]| places.iter().map(|&p| v[p as usize]).collect();
    (at(first), at(others))
}

fn scatter(places: &[u32], v: &mut [f64], first: &[f64], others: &[f64]) {
    for (&place, value) in places.iter().zip(first.iter().chain(others)) {
        v[place as usize] = *value;
    }
}
