//! Condensation against dense algebra.

use proptest::prelude::*;
use striae_sparse::{
    Mat, Precision, SchurCholesky, SolveError, SparseMatrix, Structure, Supervariable,
};

/// Chains of springs between random pairs plus a small foundation: positive definite.
fn springs(groups: usize, pairs: &[(usize, usize)], foundation: f64) -> SparseMatrix {
    let offsets = (0..=groups).scan(0, |next, k| {
        let offset = *next;
        *next += 1 + k % 3;
        Some(offset)
    });
    let cliques: Vec<[Supervariable; 2]> = pairs
        .iter()
        .map(|&(a, b)| [Supervariable(a % groups), Supervariable(b % groups)])
        .collect();
    let structure = Structure::from_cliques(offsets.collect(), &cliques).unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    for (k, clique) in cliques.iter().enumerate() {
        let unknowns: Vec<usize> = clique
            .iter()
            .flat_map(|&s| structure.unknowns_of(s))
            .collect();
        let shape: Vec<f64> = (0..unknowns.len())
            .map(|a| ((3 * a + k) % 5) as f64 - 1.9)
            .collect();
        let block: Vec<f64> = shape
            .iter()
            .flat_map(|a| shape.iter().map(move |b| a * b))
            .collect();
        matrix.add(&unknowns, &unknowns, &block).unwrap();
    }
    for k in 0..structure.unknowns() {
        matrix.add(&[k], &[k], &[foundation]).unwrap();
    }
    matrix
}

/// `S`, `g` and the whole solution by dense algebra.
fn dense(matrix: &SparseMatrix, kept: &[usize], rhs: &[f64]) -> (Mat<f64>, Vec<f64>, Vec<f64>) {
    use faer::prelude::*;
    let n = matrix.structure().unknowns();
    let a = Mat::from_fn(n, n, |i, j| matrix.get(i, j).unwrap_or(0.0));
    let interior: Vec<usize> = (0..n).filter(|k| !kept.contains(k)).collect();
    let part = |r: &[usize], c: &[usize]| Mat::from_fn(r.len(), c.len(), |i, j| a[(r[i], c[j])]);
    let b = |r: &[usize]| Mat::from_fn(r.len(), 1, |i, _| rhs[r[i]]);
    let inner = part(&interior, &interior).partial_piv_lu();
    let s = part(kept, kept) - part(kept, &interior) * inner.solve(part(&interior, kept));
    let g = b(kept) - part(kept, &interior) * inner.solve(b(&interior));
    let all: Vec<usize> = (0..n).collect();
    let x = a.partial_piv_lu().solve(b(&all));
    (
        s,
        (0..kept.len()).map(|i| g[(i, 0)]).collect(),
        (0..n).map(|i| x[(i, 0)]).collect(),
    )
}

/// Precisions of the factors, and what they leave on matrices of springs.
const PRECISIONS: [(Precision, f64); 2] = [(Precision::Double, 1e-9), (Precision::Single, 1e-3)];

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn condensation_agrees_with_dense_algebra(
        groups in 1_usize..60,
        pairs in prop::collection::vec((any::<usize>(), any::<usize>()), 0..150),
        every in 1_usize..9,
        scale in -6..6_i32,
        (precision, bound) in prop::sample::select(PRECISIONS.to_vec()),
    ) {
        let mut matrix = springs(groups, &pairs, 1.0);
        let structure = matrix.structure().clone();
        let factors: Vec<f64> = (0..structure.unknowns())
            .map(|k| 10_f64.powi(scale * (k % 2) as i32))
            .collect();
        matrix.scale(&factors, &factors);
        let list: Vec<Supervariable> = (0..groups).filter(|k| k % every == 1).map(Supervariable).collect();
        let rhs: Vec<f64> = (0..structure.unknowns()).map(|k| factors[k] * ((k % 5) as f64 - 2.0)).collect();
        let mut schur = SchurCholesky::analyse(&structure, &list).unwrap();
        schur.factor(&matrix, precision).unwrap();
        let s = schur.complement();
        let kept = schur.kept_unknowns().to_vec();
        let (s_dense, g_dense, x_dense) = dense(&matrix, &kept, &rhs);
        let mut condensed = schur.condense(&rhs).unwrap();
        let g: Vec<f64> = kept.iter().map(|&k| condensed[k]).collect();
        for i in 0..kept.len() {
            for j in 0..kept.len() {
                let size = factors[kept[i]] * factors[kept[j]];
                prop_assert!((s[(i, j)] - s_dense[(i, j)]).abs() < bound * size);
            }
            prop_assert!((g[i] - g_dense[i]).abs() < bound * factors[kept[i]]);
        }
        kept.iter().for_each(|&k| condensed[k] = x_dense[k]);
        let x = schur.expand(condensed).unwrap();
        for k in 0..x.len() {
            prop_assert!((x[k] - x_dense[k]).abs() < bound / factors[k]);
        }
    }
}

#[test]
fn a_loose_interior_is_named() {
    let pairs: Vec<(usize, usize)> = (0..5).map(|k| (k, k + 1)).collect();
    let matrix = springs(9, &pairs, 0.0);
    let mut schur = SchurCholesky::analyse(matrix.structure(), &[Supervariable(0)]).unwrap();
    let found = schur.factor(&matrix, Precision::Double).unwrap_err();
    assert!(
        matches!(found, SolveError::NotPositiveDefinite { .. }),
        "{found:?}"
    );
    let rhs = vec![0.0; matrix.structure().unknowns()];
    assert_eq!(schur.condense(&rhs), Err(SolveError::NotFactored));
}

#[test]
fn a_part_held_by_kept_unknowns_only_is_condensed() {
    // A chain of unit springs: between its kept ends acts one spring of 1/n.
    let n = 50;
    let cliques: Vec<[Supervariable; 2]> = (0..n)
        .map(|k| [Supervariable(k), Supervariable(k + 1)])
        .collect();
    let structure = Structure::from_cliques((0..=n + 1).collect(), &cliques).unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    for k in 0..n {
        matrix
            .add(&[k, k + 1], &[k, k + 1], &[1.0, -1.0, -1.0, 1.0])
            .unwrap();
    }
    let ends = [Supervariable(0), Supervariable(n)];
    let mut schur = SchurCholesky::analyse(&structure, &ends).unwrap();
    schur.factor(&matrix, Precision::Double).unwrap();
    let s = schur.complement();
    assert_eq!(schur.kept_unknowns(), [0, n]);
    let spring = 1.0 / n as f64;
    for (i, j, sign) in [(0, 0, 1.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 1.0)] {
        assert!((s[(i, j)] - sign * spring).abs() < 1e-14);
    }
    let mut condensed = schur.condense(&vec![0.0; n + 1]).unwrap();
    condensed[n] = 1.0;
    let x = schur.expand(condensed).unwrap();
    assert!(
        x.iter()
            .enumerate()
            .all(|(k, x)| (x - k as f64 * spring).abs() < 1e-13)
    );
}

#[test]
fn a_right_hand_side_on_what_is_kept_stays_as_it_is() {
    let pairs: Vec<(usize, usize)> = (0..400).map(|k| (k * k % 101, k % 101)).collect();
    let matrix = springs(101, &pairs, 3.0);
    let kept: Vec<Supervariable> = (0..20).map(|k| Supervariable(5 * k)).collect();
    let mut schur = SchurCholesky::analyse(matrix.structure(), &kept).unwrap();
    schur.factor(&matrix, Precision::Double).unwrap();
    let mut rhs = vec![0.0; matrix.structure().unknowns()];
    for &u in schur.kept_unknowns() {
        rhs[u] = u as f64 - 80.5;
    }
    assert_eq!(schur.condense(&rhs).unwrap(), rhs);
}

#[test]
fn threads_do_not_change_a_bit() {
    let pairs: Vec<(usize, usize)> = (0..6000)
        .map(|k| (k * k % 1201, (k * 31 + k / 7) % 1201))
        .collect();
    let matrix = springs(1201, &pairs, 3.0);
    let kept: Vec<Supervariable> = (0..100).map(|k| Supervariable(12 * k)).collect();
    let unknowns = matrix.structure().unknowns();
    let rhs: Vec<f64> = (0..unknowns).map(|k| (k % 7) as f64 - 3.0).collect();
    let all = |threads: usize, precision: Precision| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut schur = SchurCholesky::analyse(matrix.structure(), &kept).unwrap();
            schur.factor(&matrix, precision).unwrap();
            let complement = schur.complement();
            let condensed = schur.condense(&rhs).unwrap();
            let expanded = schur.expand(condensed.clone()).unwrap();
            (complement, condensed, expanded)
        })
    };
    for (precision, _) in PRECISIONS {
        assert!(all(1, precision) == all(2, precision));
    }
}
