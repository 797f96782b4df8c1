use super::*;

/// A fixed sparse matrix of `n` rows in `m` columns with a dominant entry in each row.
fn rows(n: usize, m: usize) -> Vec<Row> {
    let value = |i: usize, j: usize| ((7 * i + 13 * j) % 11) as f64 / 11.0 - 0.4;
    let row = |i: usize| {
        let mut columns: Vec<usize> = [0, 3, 17, 29].map(|k| (i * i + k * (i + 1)) % m).into();
        columns.push(i);
        columns.sort_unstable();
        columns.dedup();
        let entry = |j: usize| (j as u32, if i == j { 2.5 } else { value(i, j) });
        columns.into_iter().map(entry).collect()
    };
    (0..n).map(row).collect()
}

fn product(rows: &[Row], x: &[f64]) -> Vec<f64> {
    let sum = |row: &Row| row.iter().map(|&(j, a)| a * x[j as usize]).sum();
    rows.iter().map(sum).collect()
}

#[test]
fn rows_are_solved_for_their_pivots() {
    let (n, m) = (40, 60);
    let matrix = rows(n, m);
    let exact: Vec<f64> = (0..m).map(|j| 1.0 + (j % 5) as f64).collect();
    let done = SparseElimination::new(matrix.clone(), &vec![0; m], m);
    assert_eq!((done.pivots.len(), done.deferred.len()), (n, 0));
    let mut rhs = product(&matrix, &exact);
    done.forward(&mut rhs);
    let mut x = exact.clone();
    done.pivots.iter().for_each(|p| x[p.column as usize] = 0.0);
    done.backward(&rhs, &mut x);
    for (x, exact) in x.iter().zip(&exact) {
        assert!((x - exact).abs() < 1e-12, "{x} {exact}");
    }
}

#[test]
fn dense_rows_lose_the_pivot_columns() {
    // Whatever solves the short rows has the same product with a dense row
    // before elimination and, from the columns that are left, after it.
    let (n, m) = (40, 60);
    let matrix = rows(n, m);
    let done = SparseElimination::new(matrix.clone(), &vec![0; m], m);
    let dense: Vec<[f64; 1]> = (0..m).map(|j| [((j * j) % 7) as f64 - 3.0]).collect();
    let mut x: Vec<f64> = (0..m).map(|j| (j % 3) as f64 - 0.7).collect();
    done.backward(&vec![0.0; n], &mut x);
    let before: f64 = dense.iter().zip(&x).map(|(d, x)| d[0] * x).sum();
    let mut combined = dense.clone();
    done.combine_columns(&mut combined);
    let mut left = combined.clone();
    done.pivots
        .iter()
        .for_each(|p| left[p.column as usize] = [0.0]);
    let after: f64 = left.iter().zip(&x).map(|(d, x)| d[0] * x).sum();
    assert!((before - after).abs() < 1e-11, "{before} {after}");
}

#[test]
fn the_transposed_block_is_solved() {
    let n = 40;
    let matrix = rows(n, n);
    let done = SparseElimination::new(matrix.clone(), &vec![0; n], n);
    let exact: Vec<f64> = (0..n).map(|i| 1.0 + (i % 4) as f64).collect();
    let mut columns = vec![[0.0]; n];
    for (row, x) in matrix.iter().zip(&exact) {
        row.iter()
            .for_each(|&(j, a)| columns[j as usize][0] += a * x);
    }
    done.combine_columns(&mut columns);
    let combined: Vec<f64> = columns.iter().map(|c| c[0]).collect();
    let mut x = vec![0.0; n];
    done.backward_transposed(&combined, &mut x);
    for (x, exact) in x.iter().zip(&exact) {
        assert!((x - exact).abs() < 1e-11, "{x} {exact}");
    }
}

#[test]
fn long_and_empty_rows_are_left() {
    let mut matrix = rows(20, 30);
    matrix[3] = (0..30).map(|j| (j, 1.0)).collect();
    matrix[7].clear();
    matrix.push(matrix[5].clone());
    let done = SparseElimination::new(matrix, &[0; 30], 8);
    assert!(done.deferred.contains(&3) && done.deferred.contains(&7));
    // One of two equal rows vanishes or both were long.
    assert_eq!(done.pivots.len() + done.deferred.len(), 21);
    assert!(done.deferred.contains(&5) || done.deferred.contains(&20));
}
