//! Kept unknowns, numbered, and the entries of a matrix between them.

use crate::{partition::Partition, tangent::Tangent};
use rayon::prelude::*;
use striae_sparse::{SolveError, Supervariable, sparse_elimination::Row};

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
    /// `true` for each unknown that is a multiplier.
    pub(crate) is_multiplier: Vec<bool>,
}

impl Kept {
    /// Kept unknowns of a partition.
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
    pub(crate) fn rows(&self, tangent: &Tangent) -> Result<Vec<Row>, SolveError> {
        let row = |&unknown: &u32| {
            let row = unknown as usize;
            let mut sum = 0.0;
            let between = tangent.row(row).filter_map(|(column, a)| {
                let place = self.places[column];
                sum += if place == NONE { 0.0 } else { 0.0 * a };
                (place != NONE && a != 0.0).then_some((place, a))
            });
            let entries: Row = between.collect();
            match sum == 0.0 {
                true => Ok(entries),
                false => Err(SolveError::NotFinite { row }),
            }
        };
        let rows = self.unknowns.par_iter().with_min_len(ROWS);
        rows.map(row).collect()
    }
}
