//! Forward and backward substitution with multifrontal factors, for the
//! factored matrix and its transpose.

use crate::{
    front::FrontFactor,
    numeric::Numeric,
    tree::AssemblyTree,
    triangular::{
        Block, Diagonal, solve_lower, solve_lower_transposed, solve_upper, solve_upper_transposed,
        subtract, subtract_transposed,
    },
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
    /// Number of pivots, and of pivots and delayed ones.
    count: usize,
    summed: usize,
    /// `L` (unit, below the diagonal) and `U` of the pivots and the delayed ones.
    left: Block<'a>,
    /// Columns of `U` of the border.
    border: Block<'a>,
}

impl<'a> Blocks<'a> {
    fn new(factor: &'a FrontFactor, planned: &'a [f64]) -> Self {
        let (left, above) = factor.values(planned);
        Self {
            count: factor.pivots,
            summed: factor.summed,
            left: Block::new(left, factor.size()),
            border: Block::new(above, factor.summed),
        }
    }

    /// Columns of `U` of delayed pivots.
    fn delayed(&self) -> Block<'a> {
        self.left.at(0, self.count)
    }

    /// `y := L^-1 y` in the rows of the front.
    fn forward(&self, rows: &[u32], y: &mut [f64]) {
        let mut local = gather(rows, y);
        solve_lower(self.left, Diagonal::Unit, &mut local, self.count);
        scatter(rows, y, &local);
    }

    /// Solves for the pivot columns, from `y` by rows and `x` by columns.
    fn backward(&self, rows: &[u32], columns: &[u32], y: &[f64], x: &mut [f64]) {
        let mut pivots = gather(&rows[..self.count], y);
        let known = gather(&columns[self.count..], x);
        let (delayed, border) = known.split_at(self.summed - self.count);
        subtract(&mut pivots, self.delayed(), delayed);
        subtract(&mut pivots, self.border, border);
        solve_upper(self.left, &mut pivots);
        scatter(columns, x, &pivots);
    }

    /// `y := U^-T y` in the columns of the front; pivots are put into `x` by rows.
    fn forward_transposed(&self, rows: &[u32], columns: &[u32], y: &mut [f64], x: &mut [f64]) {
        let mut local = gather(columns, y);
        let (pivots, rest) = local.split_at_mut(self.count);
        solve_upper_transposed(self.left, pivots);
        let (delayed, border) = rest.split_at_mut(self.summed - self.count);
        subtract_transposed(delayed, self.delayed(), pivots);
        subtract_transposed(border, self.border, pivots);
        scatter(columns, y, &local);
        scatter(rows, x, &local[..self.count]);
    }

    /// `x := L^-T x` in the rows of the front.
    fn backward_transposed(&self, rows: &[u32], x: &mut [f64]) {
        let mut local = gather(rows, x);
        solve_lower_transposed(self.left, Diagonal::Unit, &mut local, self.count);
        scatter(rows, x, &local[..self.count]);
    }
}

/// Entries of a vector at some places.
fn gather(places: &[u32], v: &[f64]) -> Vec<f64> {
    places.iter().map(|&p| v[p as usize]).collect()
}

/// Puts values at the first of some places.
fn scatter(places: &[u32], v: &mut [f64], values: &[f64]) {
    for (&place, value) in places.iter().zip(values) {
        v[place as usize] = *value;
    }
}
