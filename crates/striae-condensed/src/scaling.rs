//! Scaling by the diagonal of the bulk.

use crate::{entries::Kept, partition::Partition, tangent::Tangent};
use rayon::prelude::*;
use striae_sparse::{Equilibration, SolveError, check_finite, root, sparse_elimination::Row};

/// Number of rows that a thread processes at a time.
const ROWS: usize = 512;
/// Smallest entry that a column of multipliers is scaled to, over the largest of all columns.
const FAINT: f64 = 1e-3;

/// Factors from the diagonal of the bulk, for the condensed solver; `rows` are the entries
/// between kept unknowns.
///
/// Bulk unknowns and their rows get `1/sqrt|a_ii|`. The multipliers of a
/// supervariable are scaled alike, to the largest entry that bulk rows have in
/// their columns: one that acts on prescribed unknowns leaves no more than
/// round-off there. Their rows are scaled to the largest entry.
///
/// A node that hardly touches has hardly an entry in bulk rows. Columns scaled to entries below
/// [`FAINT`] would make unknowns, and with them rows, of any size: what is left of those rows would
/// hide what is left of the equilibrium from whoever measures a residual of the scaled system.
pub(crate) fn by_diagonal(
    partition: &Partition,
    tangent: &Tangent,
    (kept, rows): (&Kept, &[Row]),
) -> Result<Equilibration, SolveError> {
    check_finite(&tangent.bodies)?;
    let mut bulk = vec![1.0; partition.unknowns()];
    for i in 0..partition.supervariables() {
        for u in partition.bulk_group(i) {
            bulk[u] = root(tangent.diagonal(u).abs());
        }
    }
    Ok(with_multipliers(partition, bulk, (kept, rows)))
}

/// Scaling that reuses the existing factors of bulk unknowns.
pub(crate) fn with_multipliers(
    partition: &Partition,
    bulk: Vec<f64>,
    (kept, rows): (&Kept, &[Row]),
) -> Equilibration {
    let mut scaling = Equilibration {
        columns: bulk.clone(),
        rows: bulk,
    };
    let multipliers = || (0..kept.unknowns.len()).filter(|&k| kept.is_multiplier[k]);
    let mut largest = largest_in_columns((kept, rows), &scaling.rows);
    for i in partition.kept().map(|i| i.0) {
        let group = partition.multiplier_group(i);
        if !partition.bulk_group(i).is_empty() && !group.is_empty() {
            let first = kept.place(group.start) as usize;
            let own = &mut largest[first..first + group.len()];
            let common = own.iter().copied().fold(0.0, f64::max);
            own.fill(common);
        }
    }
    let faint = FAINT * largest.iter().copied().fold(0.0, f64::max);
    for k in multipliers() {
        scaling.columns[kept.unknowns[k] as usize] = inverse(largest[k].max(faint));
    }
    scale_rows(&mut scaling, (kept, rows));
    scaling
}

/// Scales the rows of multipliers to the largest of their entries times the factors of columns.
fn scale_rows(scaling: &mut Equilibration, (kept, rows): (&Kept, &[Row])) {
    let columns = &scaling.columns;
    let size = |row: &Row| {
        let sizes = row
            .iter()
            .map(|&(k, a)| a.abs() * columns[kept.unknowns[k as usize] as usize]);
        inverse(sizes.fold(0.0, f64::max))
    };
    let all = rows.par_iter().zip(&kept.is_multiplier).with_min_len(64);
    let sizes: Vec<Option<f64>> = all
        .map(|(row, &is_multiplier)| is_multiplier.then(|| size(row)))
        .collect();
    for (&unknown, size) in kept.unknowns.iter().zip(sizes) {
        if let Some(size) = size {
            scaling.rows[unknown as usize] = size;
        }
    }
}

/// Largest magnitude of the entries in the column of each multiplier in the rows of the bulk,
/// times factors of the rows; zero in all other columns.
fn largest_in_columns((kept, rows): (&Kept, &[Row]), factors: &[f64]) -> Vec<f64> {
    let chunks = rows.par_chunks(ROWS).enumerate();
    let found = chunks.map(|(chunk, rows)| {
        let mut largest = vec![0.0_f64; kept.unknowns.len()];
        let rows = (chunk * ROWS..).zip(rows);
        for (k, row) in rows.filter(|(k, _)| !kept.is_multiplier[*k]) {
            let factor = factors[kept.unknowns[k] as usize];
            for &(column, a) in row {
                let column = column as usize;
                if kept.is_multiplier[column] {
                    largest[column] = largest[column].max(a.abs() * factor);
                }
            }
        }
        largest
    });
    let larger = |mut all: Vec<f64>, some: Vec<f64>| {
        all.iter_mut().zip(some).for_each(|(a, b)| *a = a.max(b));
        all
    };
    found.reduce(|| vec![0.0; kept.unknowns.len()], larger)
}

/// Power of two nearest to `1/maximum` in the exponent; one for zero.
fn inverse(maximum: f64) -> f64 {
    if maximum == 0.0 {
        return 1.0;
    }
    (-maximum.log2().round()).exp2()
}
