//! Kept unknowns, numbered, and the entries of a matrix between them.

use crate::partition::Partition;
use rayon::prelude::*;
use striae_sparse::{SolveError, SparseMatrix, Supervariable, sparse_elimination::Row};

/// Not kept.
const NONE: u32 = u32::MAX;
/// Rows that a thread collects at a time.
const ROWS: usize = 32;

/// The unknowns of kept supervariables.
#[derive(Debug)]
pub(crate) struct Kept {
    /// Them, rising.
    pub(crate) unknowns: Vec<u32>,
    /// Place of every unknown among them.
    places: Vec<u32>,
    /// Whether each of them is a multiplier.
    pub(crate) is_multiplier: Vec<bool>,
}

impl Kept {
    /// Those of a partition.
    pub(crate) fn of(partition: &Partition) -> Self {
        let kept = partition.kept().map(|Supervariable(i)| i);
        let (mut unknowns, mut is_multiplier) = (Vec::new(), Vec::new());
        for i in kept {
            unknowns.extend(partition.group(i).map(|u| u as u32));
            is_multiplier.extend(partition.bulk_group(i).map(|_| false));
            is_multiplier.extend(partition.multiplier_group(i).map(|_| true));
        }
        let mut places = vec![NONE; partition.unknowns()];
        for (place, &unknown) in (0..).zip(&unknowns) {
            places[unknown as usize] = place;
        }
        Self {
            unknowns,
            places,
            is_multiplier,
        }
    }

    /// Place of a kept unknown among all of them.
    pub(crate) fn place(&self, unknown: usize) -> u32 {
        self.places[unknown]
    }

    /// Entries between kept unknowns that are not zero, row by row in the order of columns.
    ///
    /// # Errors
    /// [`SolveError::NotFinite`] for an entry of theirs.
    pub(crate) fn rows(
        &self,
        partition: &Partition,
        matrix: &SparseMatrix,
    ) -> Result<Vec<Row>, SolveError> {
        let row = |&u: &u32| {
            let row = u as usize;
            let owner = partition.owner(row).0;
            let values = &matrix.values()[partition.row(owner, row - partition.group(owner).start)];
            let mut entries = Row::with_capacity(values.len());
            let mut sum = 0.0;
            for edge in partition.edges(owner) {
                let target = partition.target(edge);
                if !partition.is_kept(Supervariable(target)) {
                    continue;
                }
                let values = &values[partition.column(edge)..];
                for (v, &a) in partition.group(target).zip(values) {
                    sum += 0.0 * a;
                    if a != 0.0 {
                        entries.push((self.places[v], a));
                    }
                }
            }
            match sum == 0.0 {
                true => Ok(entries),
                false => Err(SolveError::NotFinite { row }),
            }
        };
        let rows = self.unknowns.par_iter().with_min_len(ROWS);
        rows.map(row).collect()
    }
}
