//! The sparse system of multipliers and patches.

use super::{NONE, scaled::Scaled};
use striae_sparse::{
    SolveError, SparseMatrix, Structure, Supervariable, Tier, sparse_elimination::Row,
};

/// A row that is being added up.
pub(super) struct RowSum {
    values: Vec<f64>,
    is_there: Vec<bool>,
    columns: Vec<u32>,
}

impl RowSum {
    pub(super) fn new(unknowns: usize) -> Self {
        Self {
            values: vec![0.0; unknowns],
            is_there: vec![false; unknowns],
            columns: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, unknown: u32, value: f64) {
        let at = unknown as usize;
        if !self.is_there[at] {
            self.is_there[at] = true;
            self.columns.push(unknown);
        }
        self.values[at] += value;
    }

    pub(super) fn get(&self, unknown: u32) -> f64 {
        self.values[unknown as usize]
    }

    /// The row in rising order; the sum is empty again.
    pub(super) fn take(&mut self) -> Row {
        self.columns.sort_unstable();
        let row = self.columns.drain(..).map(|unknown| {
            let at = unknown as usize;
            self.is_there[at] = false;
            (unknown, std::mem::take(&mut self.values[at]))
        });
        row.collect()
    }
}

/// A matrix by sorted rows: of the multipliers, grouped as in the whole system, then of as
/// many motions as each patch has.
pub(super) fn assembled(
    scaled: &Scaled<'_>,
    patches: impl Iterator<Item = usize>,
    rows: &[Row],
) -> Result<SparseMatrix, SolveError> {
    let partition = &scaled.nodes.partition;
    let (mut offsets, mut tiers) = (vec![0], Vec::<Tier>::new());
    let mut before = None;
    for (k, &u) in scaled.nodes.multipliers.iter().enumerate() {
        let owner = partition.owner(u as usize);
        if before != Some(owner) {
            tiers.push(partition.tier(owner));
            offsets.push(k);
        }
        before = Some(owner);
        offsets[tiers.len()] = k + 1;
    }
    let last = tiers.iter().copied().max().unwrap_or(Tier(0));
    for motions in patches {
        offsets.push(offsets[offsets.len() - 1] + motions);
        tiers.push(last);
    }
    let mut owners = vec![NONE; rows.len()];
    for (i, ends) in (0..).zip(offsets.windows(2)) {
        owners[ends[0]..ends[1]].fill(i);
    }
    let mut pairs: Vec<[Supervariable; 2]> = Vec::new();
    for (i, ends) in offsets.windows(2).enumerate() {
        let near = rows[ends[0]..ends[1]].iter().flatten();
        let mut near: Vec<usize> = near.map(|&(v, _)| owners[v as usize] as usize).collect();
        near.sort_unstable();
        near.dedup();
        near.retain(|&j| j != i);
        pairs.extend(near.into_iter().map(|j| [i, j].map(Supervariable)));
    }
    let structure = Structure::from_cliques(offsets, &pairs)
        .and_then(|structure| structure.with_tiers(tiers))
        .map_err(|_| SolveError::NotAnalysed)?;
    let mut matrix = SparseMatrix::zero(&structure);
    for (k, row) in rows.iter().enumerate() {
        let i = owners[k] as usize;
        let start = structure.row(i, k - structure.group(i).start).start;
        for entries in row.chunk_by(|a, b| owners[a.0 as usize] == owners[b.0 as usize]) {
            let j = owners[entries[0].0 as usize] as usize;
            let edge = structure.edge(i, j).ok_or(SolveError::NotAnalysed)?;
            let first = start + structure.column(edge);
            for &(v, a) in entries {
                matrix.values_mut()[first + v as usize - structure.group(j).start] = a;
            }
        }
    }
    Ok(matrix)
}
