//! Patterns and values.

use proptest::prelude::*;
use striae_sparse::{
    CliquePlaces, CompressedRows, LinearOperator, Member, MemberRows, OutsidePattern, PlacedBlock,
    RowSums, SparseMatrix, Structure, StructureError, Supervariable,
};

fn s(list: &[usize]) -> Vec<Supervariable> {
    list.iter().map(|&i| Supervariable(i)).collect()
}

fn structure() -> Structure {
    Structure::from_cliques(vec![0, 3, 4, 4, 6], &[s(&[0, 1]), s(&[3, 1, 2])]).unwrap()
}

#[test]
fn pattern_is_the_union_of_the_cliques() {
    let structure = structure();
    let near = |i| structure.neighbours(Supervariable(i)).collect::<Vec<_>>();
    assert_eq!(near(0), s(&[0, 1]));
    assert_eq!(near(1), s(&[0, 1, 2, 3]));
    assert_eq!(near(3), s(&[1, 2, 3]));
    assert_eq!((structure.unknowns(), structure.supervariables()), (6, 4));
    assert_eq!(structure.entries(), 3 * 4 + 6 + 2 * 3);
    assert_eq!(structure.owner(3), Supervariable(1));
    assert_eq!(structure.unknowns_of(Supervariable(3)), 4..6);
}

#[test]
fn growing_adds_to_the_pattern() {
    let grown = structure().grown(&[s(&[0, 3])]).unwrap();
    let direct = Structure::from_cliques(
        vec![0, 3, 4, 4, 6],
        &[s(&[0, 1]), s(&[3, 1, 2]), s(&[3, 0])],
    );
    let direct = direct.unwrap();
    for i in (0..4).map(Supervariable) {
        assert!(grown.neighbours(i).eq(direct.neighbours(i)));
    }
    assert_eq!(grown.entries(), direct.entries());
    assert!(!grown.same_as(&structure()) && grown.same_as(&direct));
}

#[test]
fn faulty_structures_are_refused() {
    let none: [Vec<Supervariable>; 0] = [];
    let from = |offsets: &[usize]| Structure::from_cliques(offsets.to_vec(), &none).unwrap_err();
    assert!(matches!(
        from(&[]),
        StructureError::Offsets { index: 0, .. }
    ));
    assert!(matches!(
        from(&[1, 2]),
        StructureError::Offsets {
            index: 0,
            offset: 1,
            ..
        }
    ));
    let decrease = StructureError::Offsets {
        index: 2,
        offset: 3,
        previous: 4,
    };
    assert_eq!(from(&[0, 4, 3]), decrease);
    let unknown = Structure::from_cliques(vec![0, 1], &[s(&[0]), s(&[0, 7])]).unwrap_err();
    assert!(matches!(
        unknown,
        StructureError::UnknownSupervariable { clique: 1, .. }
    ));
    assert!(matches!(
        structure().with_tiers(vec![]),
        Err(StructureError::Tiers { .. })
    ));
}

#[test]
fn entries_outside_the_pattern_are_refused_and_change_nothing() {
    let mut matrix = SparseMatrix::zero(&structure());
    let block = [1.0; 4];
    let outside = matrix.add(&[0, 3], &[3, 4], &block);
    assert_eq!(outside, Err(OutsidePattern { row: 0, column: 4 }));
    let (a, b) = (Supervariable(0), Supervariable(3));
    assert!(matrix.add_block(a, b, &[0.0; 6]).is_err());
    assert_eq!(matrix.infinity_norm(), 0.0);
    assert_eq!((matrix.get(3, 4), matrix.get(0, 4)), (Some(0.0), None));
}

proptest! {
    #[test]
    fn what_is_added_is_found_again(
        values in prop::collection::vec(-1.0..1.0_f64, 9),
        rows in prop::collection::vec(3_usize..6, 3),
        columns in prop::collection::vec(3_usize..6, 3),
    ) {
        let mut expected = [[0.0; 6]; 6];
        for (r, &row) in rows.iter().enumerate() {
            for (c, &column) in columns.iter().enumerate() {
                expected[row][column] += values[3 * r + c];
            }
        }
        let structure = structure();
        let mut a = SparseMatrix::zero(&structure);
        a.add(&rows, &columns, &values).unwrap();
        a.add_to_diagonal(rows[0], values[0]);
        expected[rows[0]][rows[0]] += values[0];
        let transposed = a.transpose();
        for row in 0..6 {
            for column in 0..6 {
                let e = expected[row][column];
                prop_assert!((a.get(row, column).unwrap_or(0.0) - e).abs() < 1e-15);
                prop_assert_eq!(a.get(row, column), transposed.get(column, row));
            }
        }
    }
}

/// A block of a clique, different for every two members.
fn block(clique: usize, a: usize, b: usize) -> [[f64; 2]; 2] {
    let at = |row: usize, column: usize| (8 * row + 4 * column + 16 * a + b) as f64;
    [0, 1].map(|row| [0, 1].map(|column| (at(row, column) * 0.37 + clique as f64).sin()))
}

proptest! {
    #[test]
    fn batches_of_cliques_are_added_as_their_blocks_one_by_one(
        members in prop::collection::vec(prop::array::uniform3(0_u32..40), 300),
        batch in 1_usize..150,
    ) {
        let sizes = (0..40).map(|i| 2 + i % 3);
        let mut offsets = vec![0];
        offsets.extend(sizes.scan(0, |sum, size| {
            *sum += size;
            Some(*sum)
        }));
        let cliques = members.iter().map(|clique| clique.map(|i| Supervariable(i as usize)));
        let cliques: Vec<[Supervariable; 3]> = cliques.collect();
        let structure = Structure::from_cliques(offsets, &cliques).unwrap();
        let mut expected = SparseMatrix::zero(&structure);
        let mut found = expected.clone();
        found.values_mut().fill(7.0);
        for (at, clique) in cliques.iter().enumerate() {
            for (a, row) in clique.iter().enumerate() {
                for (b, column) in clique.iter().enumerate() {
                    let first = |i: &Supervariable| structure.unknowns_of(*i).start;
                    let (row, column) = (first(row), first(column));
                    let values = block(at, a, b).concat();
                    expected.add(&[row, row + 1], &[column, column + 1], &values).unwrap();
                }
            }
        }
        let places = CliquePlaces::new(&structure, 3, batch, members.concat());
        prop_assert_eq!(places.batches().map(|batch| batch.len()).sum::<usize>(), 300);
        let mut seen = vec![Vec::new(); 40];
        let add = |member: Member, mut rows: MemberRows, seen: &mut Vec<usize>| {
            // Only the rows that cliques come to are cleared.
            if seen.is_empty() {
                rows.clear();
            }
            seen.push(member.clique);
            let blocks = [0, 1, 2].map(|slot| block(member.clique, member.slot, slot));
            for row in 0..2 {
                rows.add(row, &blocks.map(|block| block[row]));
            }
        };
        for batch in 0..places.batches().len() {
            found.add_batch(&places, batch, &mut seen, add);
        }
        let others = (0..40).filter(|at| seen[*at].is_empty()).map(Supervariable);
        found.clear_rows(others);
        prop_assert_eq!(found.values(), expected.values());
        prop_assert!(seen.iter().all(|cliques| cliques.is_sorted()));
    }
}

#[test]
fn cliques_outside_the_pattern_have_no_place() {
    let mut places = CliquePlaces::new(&structure(), 2, 2, vec![0, 1, 0, 3, 3, 1]);
    assert_eq!(
        [0, 1, 2].map(|at| places.has_place(at)),
        [true, false, true]
    );
    places.find(&structure().grown(&[s(&[0, 3])]).unwrap());
    assert!((0..3).all(|at| places.has_place(at)));
    assert!(places.batches().eq([0..2, 2..3]));
}

proptest! {
    #[test]
    fn gathered_blocks_are_those_added_one_by_one(
        values in prop::collection::vec(-1.0..1.0_f64, 40 * 36),
        rows in prop::collection::vec(prop::array::uniform3(0_usize..10), 40),
        triples in prop::collection::vec(prop::array::uniform4(0_usize..4), 40),
    ) {
        let structure = Structure::from_cliques(vec![0, 3, 6, 10], &[s(&[0, 1, 2])]);
        let mut expected = SparseMatrix::zero(&structure.unwrap());
        let mut blocks = Vec::new();
        for ((values, rows), triples) in values.chunks(36).zip(&rows).zip(&triples) {
            let triples = triples.map(|at| [0, 3, 6, 7][at]);
            let columns: Vec<usize> = triples.iter().flat_map(|at| *at..at + 3).collect();
            // The first row is left out.
            expected.add(&rows[1..], &columns, &values[12..]).unwrap();
            blocks.push(PlacedBlock {
                rows: vec![(rows[1], 1), (rows[2], 2)],
                columns: triples.iter().map(|&at| at..at + 3).collect(),
                values: values.into(),
            });
        }
        let found = CompressedRows::gathered(expected.structure(), &blocks).unwrap();
        for row in 0..10 {
            prop_assert!(expected.row(row).filter(|entry| entry.1 != 0.0).eq(found.row(row)));
        }
        let x: Vec<f64> = (0..10).map(|at| f64::from(at) - 4.5).collect();
        let (mut by_rows, mut by_blocks) = (vec![1.0; 10], vec![1.0; 10]);
        found.add_product(&x, &mut by_rows);
        blocks.iter().for_each(|block| block.add_product(&x, &mut by_blocks));
        let units = [1.0; 10];
        let mut sums = vec![RowSums::default(); 10];
        found.add_row_sums(&x, &units, &mut sums);
        for (row, expected) in expected.row_sums(&x, &units).iter().enumerate() {
            let round_off = 1e-14 * (1.0 + expected.terms);
            prop_assert!((sums[row].product - expected.product).abs() <= round_off);
            prop_assert!((sums[row].terms - expected.terms).abs() <= round_off);
            prop_assert!((sums[row].norm - expected.norm).abs() <= round_off);
            prop_assert!((by_rows[row] - 1.0 - expected.product).abs() <= round_off);
            prop_assert!((by_blocks[row] - 1.0 - expected.product).abs() <= round_off);
        }
    }
}

#[test]
fn blocks_outside_the_pattern_are_named() {
    let block = |row: usize, column: usize| PlacedBlock {
        rows: vec![(1, 0), (row, 0)],
        columns: vec![3..6, column..column + 3],
        values: vec![1.0; 6].into(),
    };
    let cliques = [s(&[0, 1]), s(&[1, 2])];
    let structure = Structure::from_cliques(vec![0, 3, 6, 9], &cliques).unwrap();
    let blocks = [block(3, 0), block(0, 6), block(2, 0), block(7, 0)];
    assert_eq!(
        CompressedRows::gathered(&structure, &blocks),
        Err(vec![1, 3])
    );
    let nothing = CompressedRows::gathered(&structure, &[]).unwrap();
    assert_eq!(nothing, CompressedRows::zero(9));
    assert!(nothing.is_zero());
}

#[test]
fn products_norms_and_scaling() {
    let structure = structure();
    let mut matrix = SparseMatrix::zero(&structure);
    matrix
        .add_block(Supervariable(0), Supervariable(1), &[1.0, -2.0, 3.0])
        .unwrap();
    matrix
        .add_block(Supervariable(1), Supervariable(3), &[4.0, 5.0])
        .unwrap();
    let mut y = [0.0; 6];
    matrix.multiply(&[1.0, 1.0, 1.0, 2.0, 10.0, -1.0], &mut y);
    assert_eq!(y, [2.0, -4.0, 6.0, 35.0, 0.0, 0.0]);
    assert_eq!(matrix.row_maxima(), [1.0, 2.0, 3.0, 5.0, 0.0, 0.0]);
    assert_eq!(matrix.column_maxima(), [0.0, 0.0, 0.0, 3.0, 4.0, 5.0]);
    assert_eq!(matrix.infinity_norm(), 9.0);
    matrix.scale(
        &[2.0, 1.0, 1.0, 0.5, 1.0, 1.0],
        &[1.0, 1.0, 1.0, 10.0, 1.0, 1.0],
    );
    assert_eq!(
        (matrix.get(0, 3), matrix.get(3, 5)),
        (Some(20.0), Some(2.5))
    );
    matrix.clear();
    assert_eq!(matrix.infinity_norm(), 0.0);
}
