//! The stiffness of an element by components: of the blocks
//!
//! ```text
//! K_ik = df_ai/dx_bk,    a, b over the corners,
//! ```
//!
//! those with `i <= k`, as a law with an energy makes `K_ki` the transpose of `K_ik`.

/// Components of the blocks that are kept.
pub(super) const COMPONENTS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// The blocks of [`COMPONENTS`] for `N` corners, by the corners `a` and `b`.
pub(super) type Blocks<'a, const N: usize> = &'a mut [[[f64; N]; N]];

/// Derivative of the internal force of an element by its corner positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Stiffness {
    corners: usize,
    /// Block by block, row by row.
    entries: Vec<f64>,
}

impl Stiffness {
    pub(super) fn zero(corners: usize) -> Self {
        Self {
            corners,
            entries: vec![0.0; COMPONENTS.len() * corners * corners],
        }
    }

    /// Derivative of the force on corner `a` by the position of corner `b`.
    pub fn between(&self, a: usize, b: usize) -> [[f64; 3]; 3] {
        let n = self.corners;
        let (there, back) = (a * n + b, b * n + a);
        let at = |block: usize, place: usize| self.entries[block * n * n + place];
        [
            [at(0, there), at(1, there), at(2, there)],
            [at(1, back), at(3, there), at(4, there)],
            [at(2, back), at(4, back), at(5, there)],
        ]
    }

    /// Derivatives of the three components of the force on corner `a` by the positions of all
    /// `N` corners.
    pub fn rows<const N: usize>(&self, a: usize) -> [[[f64; 3]; N]; 3] {
        let (lines, _) = self.entries.as_chunks::<N>();
        let block = |block: usize| &lines[block * N..][..N];
        let [xx, xy, xz, yy, yz, zz] = [0, 1, 2, 3, 4, 5].map(block);
        [
            std::array::from_fn(|b| [xx[a][b], xy[a][b], xz[a][b]]),
            std::array::from_fn(|b| [xy[b][a], yy[a][b], yz[a][b]]),
            std::array::from_fn(|b| [xz[b][a], yz[b][a], zz[a][b]]),
        ]
    }

    /// All entries, row by row; unknown `3 a + i` is component `i` of corner `a`.
    pub fn by_rows(&self) -> Vec<f64> {
        let unknowns = 3 * self.corners;
        let entry =
            |row: usize, column: usize| self.between(row / 3, column / 3)[row % 3][column % 3];
        let rows = (0..unknowns).flat_map(|row| (0..unknowns).map(move |column| (row, column)));
        rows.map(|(row, column)| entry(row, column)).collect()
    }

    /// Multiplies all entries.
    pub fn scale(&mut self, factor: f64) {
        self.entries.iter_mut().for_each(|k| *k *= factor);
    }

    /// Adds to the derivative of the force on corner `a` by the position of corner `b`, both
    /// along one axis.
    pub fn add_along(&mut self, axis: usize, a: usize, b: usize, value: f64) {
        let n = self.corners;
        self.entries[[0, 3, 5][axis] * n * n + a * n + b] += value;
    }

    /// Adds a block, by rows, to the derivative of the force on corner `a` by the position of corner
    /// `b`; that of the corners swapped has to be its transpose.
    pub fn add_between(&mut self, a: usize, b: usize, block: &[[f64; 3]; 3]) {
        let n = self.corners;
        for (at, (i, k)) in COMPONENTS.into_iter().enumerate() {
            self.entries[at * n * n + a * n + b] += block[i][k];
        }
    }

    /// The blocks of [`COMPONENTS`] for `N` corners, by the corners `a` and `b`.
    pub(super) fn blocks_mut<const N: usize>(&mut self) -> Blocks<'_, N> {
        let (rows, _) = self.entries.as_chunks_mut::<N>();
        rows.as_chunks_mut::<N>().0
    }
}
