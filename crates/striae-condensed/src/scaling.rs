//! Scaling by the diagonal of the bulk.

use crate::partition::Partition;
use rayon::prelude::*;
use std::ops::Range;
use striae_sparse::{Equilibration, SolveError, SparseMatrix, Supervariable, check_finite, root};

/// Factors from the diagonal of the bulk, for the condensed solver.
///
/// Bulk unknowns and their rows get `1/sqrt|a_ii|`. The multipliers of a
/// supervariable are scaled alike, to the largest entry that bulk rows have in
/// their columns: one that acts on prescribed unknowns leaves no more than
/// round-off there. Their rows are scaled to the largest entry. Multipliers
/// that only other multipliers know come last.
///
/// With an `older` one the bulk unknowns keep its factors.
pub(crate) fn by_diagonal(
    partition: &Partition,
    matrix: &SparseMatrix,
    older: Option<&Equilibration>,
) -> Result<Equilibration, SolveError> {
    check_finite(matrix)?;
    let n = partition.unknowns();
    let mut scaling = Equilibration {
        rows: vec![1.0; n],
        columns: vec![1.0; n],
    };
    let mut multipliers = Vec::new();
    for i in 0..partition.supervariables() {
        multipliers.extend(partition.multiplier_group(i));
        for u in partition.bulk_group(i) {
            let scale = match older {
                Some(older) => older.columns[u],
                None => root(matrix.get(u, u).unwrap_or(0.0).abs()),
            };
            (scaling.rows[u], scaling.columns[u]) = (scale, scale);
        }
    }
    let mut is_multiplier = vec![false; n];
    multipliers.iter().for_each(|&m| is_multiplier[m] = true);
    let kept_bulk = |i: usize| match partition.is_kept(Supervariable(i)) {
        true => partition.bulk_group(i),
        false => 0..0,
    };
    let mut largest = largest_in_columns((partition, matrix), &scaling.rows, |_| true, kept_bulk);
    for i in 0..partition.supervariables() {
        if !partition.bulk_group(i).is_empty() {
            let own = &mut largest[partition.multiplier_group(i)];
            let common = own.iter().copied().fold(0.0, f64::max);
            own.fill(common);
        }
    }
    multipliers
        .iter()
        .for_each(|&m| scaling.columns[m] = inverse(largest[m]));
    let unknown = |v: usize| is_multiplier[v] && largest[v] == 0.0;
    let columns: Vec<f64> = (0..n)
        .map(|v| if unknown(v) { 0.0 } else { scaling.columns[v] })
        .collect();
    scale_rows(&mut scaling, matrix, &multipliers, &columns);
    if !multipliers.iter().any(|&m| unknown(m)) {
        return Ok(scaling);
    }
    let with_unknown = |i: usize| partition.multiplier_group(i).any(unknown);
    let others = |i: usize| partition.multiplier_group(i);
    let late = largest_in_columns((partition, matrix), &scaling.rows, with_unknown, others);
    for &m in multipliers.iter().filter(|&&m| unknown(m)) {
        scaling.columns[m] = inverse(late[m]);
    }
    let columns = scaling.columns.clone();
    scale_rows(&mut scaling, matrix, &multipliers, &columns);
    Ok(scaling)
}

/// Scales some rows to the largest of their entries times `columns`.
fn scale_rows(scaling: &mut Equilibration, matrix: &SparseMatrix, rows: &[usize], columns: &[f64]) {
    let sizes = rows.par_iter().with_min_len(16);
    let sizes: Vec<f64> = sizes
        .map(|&row| inverse(largest_in_row(matrix, row, columns)))
        .collect();
    for (&row, size) in rows.iter().zip(sizes) {
        scaling.rows[row] = size;
    }
}

/// Largest magnitude of the entries of a row times factors of the columns.
fn largest_in_row(matrix: &SparseMatrix, row: usize, columns: &[f64]) -> f64 {
    let structure = matrix.structure();
    let i = structure.owner(row).0;
    let mut values = &matrix.values()[structure.row(i, row - structure.group(i).start)];
    let mut largest = 0.0_f64;
    for group in structure.column_groups(i) {
        let (own, others) = values.split_at(group.len());
        values = others;
        for (a, factor) in own.iter().zip(&columns[group]) {
            largest = largest.max(a.abs() * factor);
        }
    }
    largest
}

/// Largest magnitude of the entries in each column of the multipliers of some supervariables,
/// in some rows of each neighbour, times factors of the rows; zero in all other columns.
fn largest_in_columns(
    (structure, matrix): (&Partition, &SparseMatrix),
    factors: &[f64],
    wanted: impl Fn(usize) -> bool + Sync,
    rows: impl Fn(usize) -> Range<usize> + Sync,
) -> Vec<f64> {
    let of_one = |&t: &usize| {
        let own = structure.multiplier_group(t);
        let mut largest = vec![0.0_f64; own.len()];
        for i in structure.edges(t).map(|edge| structure.target(edge)) {
            let rows = rows(i);
            // The pattern is symmetric, so the mirrored edge exists.
            let Some(edge) = structure.edge(i, t).filter(|_| !rows.is_empty()) else {
                continue;
            };
            let offset = structure.column(edge) + own.start - structure.group(t).start;
            for row in rows {
                let place = structure.row(i, row - structure.group(i).start);
                let entries = &matrix.values()[place][offset..];
                for (largest, a) in largest.iter_mut().zip(entries) {
                    *largest = largest.max(a.abs() * factors[row]);
                }
            }
        }
        largest
    };
    let has_any = |t: &usize| !structure.multiplier_group(*t).is_empty() && wanted(*t);
    let owners: Vec<usize> = (0..structure.supervariables()).filter(has_any).collect();
    let found: Vec<Vec<f64>> = owners.par_iter().with_min_len(8).map(of_one).collect();
    let mut largest = vec![0.0; structure.unknowns()];
    for (&t, found) in owners.iter().zip(found) {
        largest[structure.multiplier_group(t)].copy_from_slice(&found);
    }
    largest
}

/// Power of two nearest to `1/maximum` in the exponent; one for zero.
fn inverse(maximum: f64) -> f64 {
    if maximum == 0.0 {
        return 1.0;
    }
    (-maximum.log2().round()).exp2()
}
