//! Pivots of a sparse symmetric positive semi-definite matrix against kept neighbours.
//!
//! ```text
//! d_k = S_kk - S_kn S_nn^-1 S_nk,   n: kept nodes that couple with k
//! ```
//!
//! Every candidate has its own Cholesky factor of `S_nn`, which grows by a row when
//! a neighbour is kept and the pivot is asked for again. Pivots only fall.

use crate::common_mass::SparseRow;

/// Part of its diagonal below which a kept node depends on others.
const DEPENDENT: f64 = 1e-12;

/// Pivots of all candidates.
pub(crate) struct Pivots {
    rows: Vec<SparseRow>,
    of: Vec<Pivot>,
}

#[derive(Clone, Default)]
struct Pivot {
    value: f64,
    diagonal: f64,
    /// Neighbours kept since the value was found.
    pending: Vec<u32>,
    neighbours: Vec<u32>,
    /// Rows of `L` in `S_nn = L L^T`, one after the other.
    factor: Vec<f64>,
    /// `L^-1 S_nk`.
    projected: Vec<f64>,
}

impl Pivots {
    /// Pivots without kept nodes: the diagonal.
    pub fn new(rows: Vec<SparseRow>) -> Self {
        let of = (0..rows.len()).map(|k| {
            let diagonal = entry(&rows[k], k as u32);
            Pivot {
                value: diagonal,
                diagonal,
                ..Pivot::default()
            }
        });
        Self {
            of: of.collect(),
            rows,
        }
    }

    /// Tells the neighbours of a node that it is kept.
    pub fn keep(&mut self, k: u32) {
        for &(l, _) in &self.rows[k as usize] {
            if l != k {
                self.of[l as usize].pending.push(k);
            }
        }
    }

    /// Last value, an upper bound.
    pub fn bound(&self, k: u32) -> f64 {
        self.of[k as usize].value
    }

    /// Whether the last value still holds.
    pub fn is_fresh(&self, k: u32) -> bool {
        self.of[k as usize].pending.is_empty()
    }

    /// Brings the value up to date.
    pub fn refresh(&mut self, k: u32) -> f64 {
        let mut pivot = std::mem::take(&mut self.of[k as usize]);
        for j in std::mem::take(&mut pivot.pending) {
            self.append(&mut pivot, k, j);
        }
        let value = pivot.value;
        self.of[k as usize] = pivot;
        value
    }

    /// Forgets a candidate.
    pub fn drop(&mut self, k: u32) {
        let value = self.of[k as usize].value;
        self.of[k as usize] = Pivot {
            value,
            ..Pivot::default()
        };
    }

    fn append(&self, pivot: &mut Pivot, k: u32, j: u32) {
        let row = &self.rows[j as usize];
        let start = pivot.factor.len();
        let mut diagonal = entry(row, j);
        let mut coupling = entry(row, k);
        let scale = diagonal;
        let mut first = 0;
        for (at, &n) in pivot.neighbours.iter().enumerate() {
            let (before, new) = pivot.factor.split_at(start);
            let l = &before[first..first + at];
            let dot: f64 = l.iter().zip(new).map(|(a, b)| a * b).sum();
            let solved = (entry(row, n) - dot) / before[first + at];
            pivot.factor.push(solved);
            diagonal -= solved * solved;
            coupling -= solved * pivot.projected[at];
            first += at + 1;
        }
        if diagonal <= DEPENDENT * scale {
            pivot.factor.truncate(start);
            return;
        }
        let root = diagonal.sqrt();
        pivot.factor.push(root);
        pivot.neighbours.push(j);
        pivot.projected.push(coupling / root);
        pivot.value = (pivot.value - (coupling / root).powi(2)).clamp(0.0, pivot.diagonal);
    }
}

/// Entry of a sorted row.
fn entry(row: &SparseRow, column: u32) -> f64 {
    row.binary_search_by_key(&column, |&(at, _)| at)
        .map_or(0.0, |at| row[at].1)
}
