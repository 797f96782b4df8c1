//! Pivots of a sparse symmetric positive semi-definite matrix against kept neighbours.
//!
//! ```text
//! d_k = S_kk - S_kn S_nn^-1 S_nk,   n: kept nodes that couple with k
//! ```
//!
//! Every candidate has its own Cholesky factor of `S_nn`, which grows by a row when a neighbour is
//! kept and the pivot is requested again. Pivots only fall.

use crate::common_mass::SparseRow;

/// Part of its diagonal below which a kept node depends on others.
const DEPENDENT: f64 = 1e-12;

/// Rows by which a factor grows at once.
const BLOCK: usize = 4;

/// Pivots of all candidates.
pub(crate) struct Pivots {
    rows: Vec<SparseRow>,
    of: Vec<Pivot>,
    /// One more than the place of a node among the neighbours, zero between uses.
    place: Vec<u32>,
    /// New rows of a factor, side by side.
    solved: Vec<[f64; BLOCK]>,
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
            place: vec![0; rows.len()],
            solved: Vec::new(),
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

    /// Returns whether the last value is still valid.
    pub fn is_fresh(&self, k: u32) -> bool {
        self.of[k as usize].pending.is_empty()
    }

    /// Brings the value up to date, or at least below a floor: then it is a bound still.
    pub fn refresh(&mut self, k: u32, floor: f64) -> f64 {
        let mut pivot = std::mem::take(&mut self.of[k as usize]);
        let pending = std::mem::take(&mut pivot.pending);
        for (at, &n) in pivot.neighbours.iter().enumerate() {
            self.place[n as usize] = at as u32 + 1;
        }
        let mut done = 0;
        // Once the pivot is below the floor its exact value decides nothing; the rest stays
        // pending.
        while done < pending.len() && pivot.value >= floor {
            let block = &pending[done..pending.len().min(done + BLOCK)];
            self.append(&mut pivot, k, block);
            done += block.len();
        }
        for &n in &pivot.neighbours {
            self.place[n as usize] = 0;
        }
        pivot.pending = pending[done..].to_vec();
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

    fn append(&mut self, pivot: &mut Pivot, k: u32, block: &[u32]) {
        self.solve(pivot, block);
        let before = pivot.neighbours.len();
        for (b, &j) in block.iter().enumerate() {
            let row = &self.rows[j as usize];
            let start = pivot.factor.len();
            let solved = self.solved.iter().map(|values| values[b]);
            pivot.factor.extend(solved);
            for at in before..pivot.neighbours.len() {
                let (above, new) = pivot.factor.split_at(start);
                let [first, last] = [at * (at + 1) / 2, at * (at + 1) / 2 + at];
                let rest = entry(row, pivot.neighbours[at]) - dot(&above[first..last], new);
                let value = rest / above[last];
                pivot.factor.push(value);
            }
            let new = &pivot.factor[start..];
            let scale = entry(row, j);
            let diagonal = scale - dot(new, new);
            let coupling = entry(row, k) - dot(new, &pivot.projected);
            if diagonal <= DEPENDENT * scale {
                pivot.factor.truncate(start);
                continue;
            }
            let root = diagonal.sqrt();
            pivot.factor.push(root);
            pivot.neighbours.push(j);
            pivot.projected.push(coupling / root);
            pivot.value = (pivot.value - (coupling / root).powi(2)).clamp(0.0, pivot.diagonal);
            self.place[j as usize] = pivot.neighbours.len() as u32;
        }
    }

    /// `L^-1 S_nj` for the nodes of a block.
    fn solve(&mut self, pivot: &Pivot, block: &[u32]) {
        self.solved.clear();
        self.solved.resize(pivot.neighbours.len(), [0.0; BLOCK]);
        for (b, &j) in block.iter().enumerate() {
            for &(n, value) in &self.rows[j as usize] {
                let place = self.place[n as usize] as usize;
                if place > 0 {
                    self.solved[place - 1][b] = value;
                }
            }
        }
        let mut first = 0;
        for at in 0..self.solved.len() {
            let (solved, rest) = self.solved.split_at_mut(at);
            let known = products(&pivot.factor[first..first + at], solved);
            let diagonal = pivot.factor[first + at].recip();
            for b in 0..BLOCK {
                rest[0][b] = (rest[0][b] - known[b]) * diagonal;
            }
            first += at + 1;
        }
    }
}

/// Products of a vector with some side by side.
fn products(a: &[f64], columns: &[[f64; BLOCK]]) -> [f64; BLOCK] {
    let mut sums = [[0.0; BLOCK]; 2];
    let (a, columns) = (a.chunks_exact(2), columns.chunks_exact(2));
    if let (Some(&a), Some(x)) = (a.remainder().first(), columns.remainder().first()) {
        sums[0] = x.map(|x| a * x);
    }
    for (a, x) in a.zip(columns) {
        for half in 0..2 {
            for b in 0..BLOCK {
                sums[half][b] += a[half] * x[half][b];
            }
        }
    }
    std::array::from_fn(|b| sums[0][b] + sums[1][b])
}

/// Product of two vectors, in eight sums side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest = a.remainder().iter().zip(b.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    let mut sums = [0.0; 8];
    for (a, b) in a.zip(b) {
        for lane in 0..8 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// Entry of a sorted row.
fn entry(row: &SparseRow, column: u32) -> f64 {
    row.binary_search_by_key(&column, |&(at, _)| at)
        .map_or(0.0, |at| row[at].1)
}
