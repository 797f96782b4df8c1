//! The stiffness of an element by components: of the blocks
//!
//! ```text
//! K_ik = df_ai/dx_bk,    a, b over the corners,
//! ```
//!
//! those with `i <= k`, as a law with an energy makes `K_ki` the transpose of `K_ik`.

use super::UNKNOWNS;

/// A block `K_ik`, by the corners `a` and `b`.
pub(super) type Block = [[f64; 8]; 8];

/// Components of the blocks that are kept.
pub(super) const COMPONENTS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// Derivative of the internal force of an element by its corner positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stiffness(pub(super) [Block; 6]);

impl Stiffness {
    /// Derivative of the force on corner `a` by the position of corner `b`.
    pub fn between(&self, a: usize, b: usize) -> [[f64; 3]; 3] {
        let [xx, xy, xz, yy, yz, zz] = &self.0;
        [
            [xx[a][b], xy[a][b], xz[a][b]],
            [xy[b][a], yy[a][b], yz[a][b]],
            [xz[b][a], yz[b][a], zz[a][b]],
        ]
    }

    /// All entries, row by row.
    pub fn by_rows(&self) -> [f64; UNKNOWNS * UNKNOWNS] {
        std::array::from_fn(|at| {
            let (row, column) = (at / UNKNOWNS, at % UNKNOWNS);
            self.between(row / 3, column / 3)[row % 3][column % 3]
        })
    }

    /// Multiplies all entries.
    pub(crate) fn scale(&mut self, factor: f64) {
        let entries = self.0.as_flattened_mut().as_flattened_mut();
        entries.iter_mut().for_each(|k| *k *= factor);
    }

    /// Adds to the derivative of the force on corner `a` by the position of corner `b`, both
    /// along one axis.
    pub(crate) fn add_along(&mut self, axis: usize, a: usize, b: usize, value: f64) {
        self.0[[0, 3, 5][axis]][a][b] += value;
    }
}
