//! Inputs that the solvers must reject, and the parts that their messages name.

use super::{
    problems::{Grid, cliques, error, fill},
    solvers,
};
use striae_sparse::{
    FaerLu, LinearSolver, MultifrontalLu, SolveError, SparseMatrix, Structure, Supervariable,
};

#[test]
fn a_free_floating_part_is_named() {
    // Two separate parts in one structure; the second one is not held.
    let lists: Vec<Vec<Supervariable>> = [0, 100]
        .iter()
        .flat_map(|&first| {
            (first..first + 99).map(|k| vec![Supervariable(k), Supervariable(k + 1)])
        })
        .collect();
    let structure = Structure::from_cliques((0..=200).collect(), &lists).unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    for (k, list) in lists.iter().enumerate() {
        let stiffness = 1.0 + 0.37 * k as f64;
        let pair = [list[0].0, list[1].0];
        let block = [stiffness, -stiffness, -stiffness, stiffness];
        matrix.add(&pair, &pair, &block).unwrap();
    }
    matrix.add(&[0], &[0], &[1.0]).unwrap();
    for (name, mut solver) in solvers() {
        solver.analyse(&structure).unwrap();
        match solver.factor(&matrix) {
            Err(SolveError::Singular { unknown, equation }) => {
                assert!((100..200).contains(&unknown), "{name} {unknown}");
                assert!((100..200).contains(&equation), "{name} {equation}");
            }
            other => panic!("{name}: {other:?}"),
        }
        let failed = solver.solve(&matrix, &[0.0; 200], &mut [0.0; 200]);
        assert_eq!(failed, Err(SolveError::NotFactored), "{name}");
    }
}

#[test]
fn a_free_floating_grid_is_singular_and_holding_it_helps() {
    let grid = Grid::new([6, 5, 4], &[]);
    let mut matrix = grid.laplacian();
    // Hold two of the three components: the third one is to be named.
    for c in [0, 2] {
        matrix.add(&[c], &[c], &[1.0]).unwrap();
    }
    let (mut multifrontal, mut faer) = (MultifrontalLu::new(), FaerLu::new());
    for solver in [&mut multifrontal as &mut dyn LinearSolver, &mut faer] {
        solver.analyse(&grid.structure).unwrap();
        match solver.factor(&matrix) {
            Err(SolveError::Singular { unknown, equation }) => {
                assert_eq!((unknown % 3, equation % 3), (1, 1));
            }
            other => panic!("{other:?}"),
        }
    }
    matrix.add(&[1], &[1], &[1.0]).unwrap();
    multifrontal.factor(&matrix).unwrap();
    assert!(error(&mut multifrontal, &matrix).unwrap() < 1e-11);
}

#[test]
fn empty_rows_and_columns_are_named() {
    let structure = Structure::from_cliques(vec![0, 2, 5], &cliques(&[&[0, 1]])).unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    fill(&mut matrix, |i, j| {
        if i == 3 || j == 1 {
            0.0
        } else {
            1.0 / (1 + i + 2 * j) as f64
        }
    });
    for (name, mut solver) in solvers() {
        solver.analyse(&structure).unwrap();
        let found = solver.factor(&matrix).map(|_| ());
        assert_eq!(
            found,
            Err(SolveError::Singular {
                unknown: 1,
                equation: 3
            }),
            "{name}"
        );
    }
}

#[test]
fn redundant_constraints_are_named() {
    // Two multipliers hold the same unknown.
    let structure =
        Structure::from_cliques(vec![0, 1, 2, 3, 4], &cliques(&[&[0, 1], &[1, 2], &[1, 3]]))
            .unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    matrix
        .add(&[0, 1], &[0, 1], &[2.0, -1.0, -1.0, 2.0])
        .unwrap();
    for multiplier in [2, 3] {
        matrix.add(&[1], &[multiplier], &[1.0]).unwrap();
        matrix.add(&[multiplier], &[1], &[1.0]).unwrap();
    }
    for (name, mut solver) in solvers() {
        solver.analyse(&structure).unwrap();
        match solver.factor(&matrix) {
            Err(SolveError::Singular { unknown, equation }) => {
                assert!(unknown >= 2 && equation >= 2, "{name} {unknown} {equation}");
            }
            other => panic!("{name} {other:?}"),
        }
    }
}

#[test]
fn misuse_is_refused() {
    let structure = Structure::from_cliques(vec![0, 2], &cliques(&[])).unwrap();
    let other = Structure::from_cliques(vec![0, 1, 2], &cliques(&[])).unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    matrix.add(&[0, 1], &[0, 1], &[1.0, 2.0, 3.0, 4.0]).unwrap();
    for (name, mut solver) in solvers() {
        assert_eq!(
            solver.factor(&matrix),
            Err(SolveError::NotAnalysed),
            "{name}"
        );
        solver.analyse(&other).unwrap();
        assert_eq!(
            solver.factor(&matrix),
            Err(SolveError::NotAnalysed),
            "{name}"
        );
        solver.analyse(&structure).unwrap();
        let early = solver.solve(&matrix, &[0.0; 2], &mut [0.0; 2]);
        assert_eq!(early, Err(SolveError::NotFactored), "{name}");
        solver.factor(&matrix).unwrap();
        let short = solver.solve(&matrix, &[0.0], &mut [0.0; 2]);
        assert_eq!(
            short,
            Err(SolveError::Length {
                found: 1,
                expected: 2
            }),
            "{name}"
        );
        let mut bad = matrix.clone();
        bad.add(&[1], &[0], &[f64::NAN]).unwrap();
        assert_eq!(
            solver.factor(&bad),
            Err(SolveError::NotFinite { row: 1 }),
            "{name}"
        );
    }
}
