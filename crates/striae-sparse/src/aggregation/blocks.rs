//! Sparse matrices of small dense blocks of fixed size, by rows.
//!
//! Rows are made and multiplied in parallel, each by one thread in a fixed
//! order of its terms, so that the number of threads does not change a bit.

use rayon::prelude::*;

/// Rows that are made at a time.
const CHUNK: usize = 256;
/// Fewest rows of a product that are worth a thread.
const FEWEST: usize = 128;

/// A matrix of `R` by `C` blocks, each stored by rows; columns rise within a row.
#[derive(Clone, Debug, Default)]
pub struct Blocks<const R: usize, const C: usize, T> {
    pub(super) starts: Vec<usize>,
    pub(super) columns: Vec<u32>,
    pub(super) values: Vec<T>,
}

impl<const R: usize, const C: usize, T: Copy> Blocks<R, C, T> {
    /// Number of rows of blocks.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of blocks.
    pub fn count(&self) -> usize {
        self.columns.len()
    }

    /// Block columns and values of a row of blocks.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, &[T])> {
        let range = self.starts[i]..self.starts[i + 1];
        let values = self.values[range.start * R * C..range.end * R * C].chunks_exact(R * C);
        let columns = self.columns[range].iter();
        columns.map(|&column| column as usize).zip(values)
    }
}

impl<const R: usize, const C: usize> Blocks<R, C, f64> {
    /// A matrix whose rows are added up by `fill`.
    pub fn from_rows(
        rows: usize,
        columns: usize,
        fill: impl Fn(usize, &mut RowSum<R, C>) + Sync,
    ) -> Self {
        let chunks: Vec<Self> = (0..rows.div_ceil(CHUNK))
            .into_par_iter()
            .map_init(
                || RowSum::new(columns),
                |sum, chunk| {
                    let mut part = Self {
                        starts: vec![0],
                        columns: Vec::new(),
                        values: Vec::new(),
                    };
                    for i in chunk * CHUNK..rows.min((chunk + 1) * CHUNK) {
                        fill(i, sum);
                        sum.finish(&mut part);
                    }
                    part
                },
            )
            .collect();
        let count = chunks.iter().map(Self::count).sum();
        let mut whole = Self {
            starts: Vec::with_capacity(rows + 1),
            columns: Vec::with_capacity(count),
            values: Vec::with_capacity(count * R * C),
        };
        whole.starts.push(0);
        chunks.into_iter().for_each(|chunk| whole.append(chunk));
        whole
    }

    /// Puts more rows below.
    pub(crate) fn append(&mut self, below: Self) {
        let before = self.columns.len();
        let ends = below.starts[1..].iter().map(|end| before + end);
        self.starts.extend(ends);
        self.columns.extend(below.columns);
        self.values.extend(below.values);
    }

    /// Copy in single precision.
    pub fn rounded(&self) -> Blocks<R, C, f32> {
        Blocks {
            starts: self.starts.clone(),
            columns: self.columns.clone(),
            values: self.values.par_iter().map(|&a| a as f32).collect(),
        }
    }
}

impl<const R: usize, const C: usize> Blocks<R, C, f32> {
    /// `y = f(A x, y)` in every component.
    pub(crate) fn combine(&self, x: &[f32], y: &mut [f32], f: impl Fn(f32, f32) -> f32 + Sync) {
        y.par_chunks_exact_mut(R)
            .with_min_len(FEWEST)
            .enumerate()
            .for_each(|(i, y)| {
                let product = self.row_product(i, x);
                for r in 0..R {
                    y[r] = f(product[r], y[r]);
                }
            });
    }

    /// A row of blocks times a vector.
    fn row_product(&self, i: usize, x: &[f32]) -> [f32; R] {
        let mut sum = [0.0; R];
        for (j, block) in self.row(i) {
            let x = &x[j * C..][..C];
            let block = &block[..R * C];
            for r in 0..R {
                for c in 0..C {
                    sum[r] += block[r * C + c] * x[c];
                }
            }
        }
        sum
    }
}

/// Rows and positions of the blocks of every column of blocks: the transposed pattern.
#[derive(Clone, Debug, Default)]
pub struct Mirror {
    starts: Vec<usize>,
    /// Row and position of each block, by rising row.
    entries: Vec<(u32, u32)>,
}

impl Mirror {
    /// The mirror of a matrix with so many columns of blocks.
    pub fn of<const R: usize, const C: usize, T: Copy>(
        matrix: &Blocks<R, C, T>,
        columns: usize,
    ) -> Self {
        let mut starts = vec![0; columns + 1];
        for &column in &matrix.columns {
            starts[column as usize + 1] += 1;
        }
        for column in 0..columns {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let mut entries = vec![(0, 0); matrix.count()];
        for i in 0..matrix.rows() {
            for at in matrix.starts[i]..matrix.starts[i + 1] {
                let place = &mut next[matrix.columns[at] as usize];
                entries[*place] = (i as u32, at as u32);
                *place += 1;
            }
        }
        Self { starts, entries }
    }

    /// Number of columns of blocks.
    pub fn columns(&self) -> usize {
        self.starts.len() - 1
    }

    /// Row and position of the blocks of a column.
    pub fn column(&self, column: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let range = self.starts[column]..self.starts[column + 1];
        let entries = self.entries[range].iter();
        entries.map(|&(row, at)| (row as usize, at as usize))
    }

    /// `y = A^T x` with the matrix it mirrors.
    pub fn multiply<const R: usize, const C: usize>(
        &self,
        matrix: &Blocks<R, C, f32>,
        x: &[f32],
        y: &mut [f32],
    ) {
        y.par_chunks_exact_mut(C)
            .with_min_len(FEWEST / 16)
            .enumerate()
            .for_each(|(column, y)| {
                let mut sum = [0.0; C];
                for (i, at) in self.column(column) {
                    let block = &matrix.values[at * R * C..][..R * C];
                    let x = &x[i * R..][..R];
                    for r in 0..R {
                        for c in 0..C {
                            sum[c] += block[r * C + c] * x[r];
                        }
                    }
                }
                y.copy_from_slice(&sum);
            });
    }
}

/// A row of blocks that is being added up.
pub struct RowSum<const R: usize, const C: usize> {
    /// Place of every column in the row, if it is there.
    places: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
    order: Vec<u32>,
}

impl<const R: usize, const C: usize> RowSum<R, C> {
    fn new(columns: usize) -> Self {
        Self {
            places: vec![u32::MAX; columns],
            columns: Vec::new(),
            values: Vec::new(),
            order: Vec::new(),
        }
    }

    /// The block of a column, zero at first.
    pub fn block(&mut self, column: usize) -> &mut [f64] {
        if self.places[column] == u32::MAX {
            self.places[column] = self.columns.len() as u32;
            self.columns.push(column as u32);
            self.values.resize(self.values.len() + R * C, 0.0);
        }
        &mut self.values[self.places[column] as usize * R * C..][..R * C]
    }

    /// Appends the row to a matrix and is empty again.
    fn finish(&mut self, matrix: &mut Blocks<R, C, f64>) {
        self.order.clear();
        self.order.extend(0..self.columns.len() as u32);
        self.order
            .sort_unstable_by_key(|&k| self.columns[k as usize]);
        for &k in &self.order {
            let k = k as usize;
            matrix.columns.push(self.columns[k]);
            matrix
                .values
                .extend(&self.values[k * R * C..(k + 1) * R * C]);
            self.places[self.columns[k] as usize] = u32::MAX;
        }
        matrix.starts.push(matrix.columns.len());
        self.columns.clear();
        self.values.clear();
    }
}

/// `target += factor a b` for row-major blocks.
pub(crate) fn add_product<const M: usize, const K: usize, const N: usize>(
    target: &mut [f64],
    factor: f64,
    a: &[f64],
    b: &[f64],
) {
    let (target, a, b) = (&mut target[..M * N], &a[..M * K], &b[..K * N]);
    for m in 0..M {
        for k in 0..K {
            let scaled = factor * a[m * K + k];
            for n in 0..N {
                target[m * N + n] += scaled * b[k * N + n];
            }
        }
    }
}

/// `target += a^T b` for row-major blocks.
pub(crate) fn add_transposed_product<const M: usize, const K: usize, const N: usize>(
    target: &mut [f64],
    a: &[f64],
    b: &[f64],
) {
    let (target, a, b) = (&mut target[..M * N], &a[..K * M], &b[..K * N]);
    for k in 0..K {
        for m in 0..M {
            for n in 0..N {
                target[m * N + n] += a[k * M + m] * b[k * N + n];
            }
        }
    }
}

/// Smallest pivot over its diagonal entry.
const SMALL: f64 = 1e-10;

/// Inverse of a symmetric positive definite block by Gauss-Jordan steps; that of its diagonal where it is not definite.
pub fn invert<const N: usize>(block: &[f64], target: &mut [f64]) {
    let mut a = block.to_vec();
    target.fill(0.0);
    (0..N).for_each(|k| target[k * N + k] = 1.0);
    for k in 0..N {
        let pivot = a[k * N + k];
        if pivot.is_nan() || pivot <= SMALL * block[k * N + k].abs() {
            target.fill(0.0);
            for k in 0..N {
                let own = block[k * N + k].abs();
                target[k * N + k] = if own > 0.0 { 1.0 / own } else { 1.0 };
            }
            return;
        }
        for c in 0..N {
            a[k * N + c] /= pivot;
            target[k * N + c] /= pivot;
        }
        for r in (0..N).filter(|&r| r != k) {
            let factor = a[r * N + k];
            for c in 0..N {
                a[r * N + c] -= factor * a[k * N + c];
                target[r * N + c] -= factor * target[k * N + c];
            }
        }
    }
}
