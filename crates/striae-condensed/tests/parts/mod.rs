//! Tangents made from whole matrices.

use striae_condensed::{Partition, Tangent};
use striae_sparse::{PlacedBlock, SparseMatrix};

/// The two parts of a matrix on the whole pattern: contact has what bodies have no place for,
/// and a `share` of what lies between kept supervariables otherwise.
pub fn tangent(partition: &Partition, whole: &SparseMatrix, share: f64) -> Tangent {
    let mut tangent = Tangent::zero(partition.structure());
    let mut blocks = Vec::new();
    for row in 0..partition.unknowns() {
        for (column, a) in whole.row(row).filter(|entry| entry.1 != 0.0) {
            let of_contact = match tangent.bodies.get(row, column) {
                None => a,
                Some(_)
                    if [row, column]
                        .iter()
                        .all(|&u| partition.is_kept(partition.owner(u))) =>
                {
                    share * a
                }
                Some(_) => 0.0,
            };
            if of_contact != a {
                let left = a - of_contact;
                tangent.bodies.add(&[row], &[column], &[left]).unwrap();
            }
            if of_contact != 0.0 {
                blocks.push(PlacedBlock {
                    rows: vec![(row, 0)],
                    columns: std::iter::once(column..column + 1).collect(),
                    values: vec![of_contact].into(),
                });
            }
        }
    }
    tangent.contact = partition.gathered(&blocks).unwrap();
    tangent
}
