//! Solvers against dense algebra.

use super::solvers;
use faer::{Mat, prelude::*};
use proptest::prelude::*;
use striae_sparse::{
    LinearSolver, MultifrontalLu, SolveError, SparseMatrix, Structure, Supervariable, Tier,
};

/// Deterministic numbers in (-1, 1).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn below(&mut self, bound: usize) -> usize {
        ((self.next() + 1.0) / 2.0 * bound as f64) as usize % bound
    }
}

pub fn cliques(lists: &[&[usize]]) -> Vec<Vec<Supervariable>> {
    lists
        .iter()
        .map(|list| list.iter().map(|&i| Supervariable(i)).collect())
        .collect()
}

/// Random graph of `groups` supervariables of up to six unknowns.
fn random_structure(groups: usize, edges: usize, numbers: &mut Numbers) -> Structure {
    let mut offsets = vec![0];
    for k in 0..groups {
        offsets.push(offsets[k] + numbers.below(7));
    }
    let cliques: Vec<Vec<Supervariable>> = (0..edges)
        .map(|_| {
            (0..3)
                .map(|_| Supervariable(numbers.below(groups)))
                .collect()
        })
        .collect();
    Structure::from_cliques(offsets, &cliques).unwrap()
}

/// Fills every entry of the pattern.
pub fn fill(matrix: &mut SparseMatrix, mut value: impl FnMut(usize, usize) -> f64) {
    let structure = matrix.structure().clone();
    for row in 0..structure.unknowns() {
        let columns: Vec<usize> = matrix.row(row).map(|(column, _)| column).collect();
        let values: Vec<f64> = columns.iter().map(|&column| value(row, column)).collect();
        matrix.add(&[row], &columns, &values).unwrap();
    }
}

fn dense(matrix: &SparseMatrix) -> Mat<f64> {
    let n = matrix.structure().unknowns();
    let mut dense = Mat::zeros(n, n);
    for row in 0..n {
        matrix
            .row(row)
            .for_each(|(column, a)| dense[(row, column)] = a);
    }
    dense
}

/// Solves with a known solution and returns the largest relative error.
pub fn error(solver: &mut dyn LinearSolver, matrix: &SparseMatrix) -> Result<f64, SolveError> {
    let n = matrix.structure().unknowns();
    error_of(solver, matrix, &vec![1.0; n])
}

/// Error for a solution in the given units.
fn error_of(
    solver: &mut dyn LinearSolver,
    matrix: &SparseMatrix,
    units: &[f64],
) -> Result<f64, SolveError> {
    solver.analyse(matrix.structure())?;
    solver.factor(matrix)?;
    let n = matrix.structure().unknowns();
    let exact: Vec<f64> = (0..n).map(|k| units[k] * (1.0 + (k % 7) as f64)).collect();
    let (mut rhs, mut x) = (vec![0.0; n], vec![0.0; n]);
    matrix.multiply(&exact, &mut rhs);
    let report = solver.solve(matrix, &rhs, &mut x)?;
    assert!(report.backward_error <= 1e-14, "{report:?}");
    Ok(x.iter()
        .zip(&exact)
        .map(|(x, e)| (x - e).abs() / e)
        .fold(0.0, f64::max))
}

/// Hexahedral-like grid with three unknowns a node; singular if nothing is held.
pub struct Grid {
    side: [usize; 3],
    pub structure: Structure,
}

impl Grid {
    pub fn new(side: [usize; 3], extra: &[(usize, Vec<usize>)]) -> Self {
        let node = |x: usize, y: usize, z: usize| x + side[0] * (y + side[1] * z);
        let mut cliques = Vec::new();
        for z in 0..side[2].max(1) - 1 {
            for y in 0..side[1] - 1 {
                for x in 0..side[0] - 1 {
                    let corner = |k: usize| node(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
                    cliques.push((0..8).map(|k| Supervariable(corner(k))).collect::<Vec<_>>());
                }
            }
        }
        let nodes: usize = side.iter().product();
        let mut offsets: Vec<usize> = (0..=nodes).map(|k| 3 * k).collect();
        for (group, (size, neighbours)) in extra.iter().enumerate() {
            offsets.push(offsets[nodes + group] + size);
            for &node in neighbours {
                cliques.push(vec![Supervariable(nodes + group), Supervariable(node)]);
            }
        }
        Self {
            side,
            structure: Structure::from_cliques(offsets, &cliques).unwrap(),
        }
    }

    /// Graph Laplacian of the cells in each component: constant null vectors.
    pub fn laplacian(&self) -> SparseMatrix {
        let mut matrix = SparseMatrix::zero(&self.structure);
        let nodes: usize = self.side.iter().product();
        for i in 0..nodes {
            let near: Vec<usize> = self
                .structure
                .neighbours(Supervariable(i))
                .map(|j| j.0)
                .filter(|&j| j < nodes && j != i)
                .collect();
            for c in 0..3 {
                let diagonal = [near.len() as f64];
                matrix.add(&[3 * i + c], &[3 * i + c], &diagonal).unwrap();
                for &j in &near {
                    matrix.add(&[3 * i + c], &[3 * j + c], &[-1.0]).unwrap();
                }
            }
        }
        matrix
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_unsymmetric_systems_agree_with_dense_lu(seed in any::<u64>(), groups in 1_usize..60, tiers in 1_usize..4) {
        let mut numbers = Numbers(seed);
        let structure = random_structure(groups, 2 * groups, &mut numbers);
        let list = (0..groups).map(|_| Tier(numbers.below(tiers) as u32)).collect();
        let structure = structure.with_tiers(list).unwrap();
        let mut matrix = SparseMatrix::zero(&structure);
        fill(&mut matrix, |_, _| numbers.next());
        let n = structure.unknowns();
        let rhs: Vec<f64> = (0..n).map(|_| numbers.next()).collect();
        let column = Mat::from_fn(n, 1, |i, _| rhs[i]);
        let dense = dense(&matrix).partial_piv_lu().solve(&column);
        for (name, mut solver) in solvers() {
            solver.analyse(&structure).unwrap();
            solver.factor(&matrix).unwrap();
            let mut x = vec![0.0; n];
            let report = solver.solve(&matrix, &rhs, &mut x).unwrap();
            prop_assert!(report.backward_error < 1e-14);
            let size = x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let norm = matrix.infinity_norm();
            for i in 0..n {
                let difference = (x[i] - dense[(i, 0)]).abs();
                prop_assert!(difference < 1e-8 * size * norm, "{name} {i} {difference:e}");
            }
        }
    }

    #[test]
    fn bad_scaling_does_no_harm(seed in any::<u64>()) {
        let mut numbers = Numbers(seed);
        let structure = random_structure(30, 70, &mut numbers);
        let n = structure.unknowns();
        let scale: Vec<f64> = (0..2 * n).map(|_| 10_f64.powf(8.0 * numbers.next())).collect();
        let mut matrix = SparseMatrix::zero(&structure);
        fill(&mut matrix, |i, j| {
            let diagonal = if i == j { 200.0 } else { 0.0 };
            diagonal + numbers.next()
        });
        matrix.scale(&scale[..n], &scale[n..]);
        let units: Vec<f64> = scale[n..].iter().map(|c| 1.0 / c).collect();
        for (name, mut solver) in solvers() {
            let error = error_of(&mut *solver, &matrix, &units).unwrap();
            prop_assert!(error < 1e-12, "{name} {error:e}");
        }
    }
}

#[test]
fn saddle_points_with_zero_diagonal_blocks() {
    // Multipliers in supervariables of their own tie nodes to each other.
    let ties: Vec<(usize, Vec<usize>)> = (0..16).map(|k| (3, vec![k, 48 + k])).collect();
    let grid = Grid::new([4, 4, 4], &ties);
    let mut matrix = grid.laplacian();
    let nodes = 64;
    for (k, (_, pair)) in ties.iter().enumerate() {
        for c in 0..3 {
            let multiplier = 3 * (nodes + k) + c;
            for (&node, sign) in pair.iter().zip([1.0, -1.0]) {
                matrix.add(&[multiplier], &[3 * node + c], &[sign]).unwrap();
                matrix.add(&[3 * node + c], &[multiplier], &[sign]).unwrap();
            }
        }
    }
    for c in 0..3 {
        matrix.add(&[3 * 21 + c], &[3 * 21 + c], &[1.0]).unwrap();
    }
    for (name, mut solver) in solvers() {
        let error = error(&mut *solver, &matrix).unwrap();
        assert!(error < 1e-10, "{name} {error:e}");
    }
}

#[test]
fn a_part_held_by_multipliers_of_another_tier_needs_delayed_pivots() {
    // Every node of a free part is eliminated before the multipliers that hold it.
    let holds: Vec<(usize, Vec<usize>)> = [0, 3, 12, 63].map(|k| (3, vec![k])).to_vec();
    let grid = Grid::new([4, 4, 4], &holds);
    let mut tiers = vec![Tier(0); 64];
    tiers.extend([Tier(1); 4]);
    let structure = grid.structure.with_tiers(tiers).unwrap();
    let grid = Grid { structure, ..grid };
    let mut matrix = grid.laplacian();
    for (k, (_, nodes)) in holds.iter().enumerate() {
        for c in 0..3 {
            let (multiplier, unknown) = (3 * (64 + k) + c, 3 * nodes[0] + c);
            matrix.add(&[multiplier], &[unknown], &[1.0]).unwrap();
            matrix.add(&[unknown], &[multiplier], &[1.0]).unwrap();
        }
    }
    let mut solver = MultifrontalLu::new();
    let error = error(&mut solver, &matrix).unwrap();
    assert!(error < 1e-12, "{error:e}");
    let report = solver.factor(&matrix).unwrap();
    assert!(
        report.delayed_pivots >= 3 && report.perturbed_pivots == 0,
        "{report:?}"
    );
}

#[test]
fn pivots_that_exist_only_in_the_parent_are_delayed() {
    // Leaves with zero diagonal, each paired with an unknown of one centre.
    let leaves = 40;
    let lists: Vec<Vec<Supervariable>> = (0..leaves)
        .map(|k| vec![Supervariable(k), Supervariable(leaves)])
        .collect();
    let offsets = (0..=leaves).chain([2 * leaves]).collect();
    let structure = Structure::from_cliques(offsets, &lists).unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    for k in 0..leaves {
        matrix.add(&[k], &[leaves + k], &[1.0 + k as f64]).unwrap();
        matrix.add(&[leaves + k], &[k], &[2.0]).unwrap();
    }
    let mut solver = MultifrontalLu::new();
    assert!(error(&mut solver, &matrix).unwrap() < 1e-14);
}

#[test]
fn small_systems() {
    for unknowns in [0, 1, 2] {
        let structure = Structure::from_cliques((0..=unknowns).collect(), &cliques(&[])).unwrap();
        let mut matrix = SparseMatrix::zero(&structure);
        fill(&mut matrix, |_, _| -4.0);
        for (name, mut solver) in solvers() {
            let error = error(&mut *solver, &matrix).unwrap();
            assert!(error < 1e-14, "{name} {unknowns} {error:e}");
        }
    }
    let structure = Structure::from_cliques(vec![0, 0, 1, 1], &cliques(&[&[0, 1, 2]])).unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    matrix.add(&[0], &[0], &[3.0]).unwrap();
    for (name, mut solver) in solvers() {
        let error = error(&mut *solver, &matrix).unwrap();
        assert!(error < 1e-14, "{name} {error:e}");
    }
}

#[test]
fn one_analysis_serves_many_matrices() {
    let mut numbers = Numbers(5);
    let structure = random_structure(50, 100, &mut numbers);
    let n = structure.unknowns();
    let mut solver = MultifrontalLu::new();
    solver.analyse(&structure).unwrap();
    for _ in 0..4 {
        let mut matrix = SparseMatrix::zero(&structure);
        fill(&mut matrix, |_, _| numbers.next());
        solver.factor(&matrix).unwrap();
        let (rhs, mut x) = (vec![1.0; n], vec![f64::NAN; n]);
        let report = solver.solve(&matrix, &rhs, &mut x).unwrap();
        let mut product = vec![0.0; n];
        matrix.multiply(&x, &mut product);
        assert!(report.backward_error < 1e-14);
        assert!(product.iter().all(|p| (p - 1.0).abs() < 1e-9));
    }
}

#[test]
fn an_old_factorisation_still_solves_a_nearby_matrix() {
    let grid = Grid::new([5, 5, 5], &[]);
    let mut matrix = grid.laplacian();
    let mut numbers = Numbers(11);
    fill(&mut matrix, |i, j| if i == j { 1.0 } else { 0.0 });
    let mut solver = MultifrontalLu::new();
    solver.analyse(&grid.structure).unwrap();
    solver.factor(&matrix).unwrap();
    fill(&mut matrix, |_, _| 0.8 * numbers.next());
    let n = grid.structure.unknowns();
    let mut x = vec![0.0; n];
    let report = solver.solve(&matrix, &vec![1.0; n], &mut x).unwrap();
    assert!(
        report.krylov_iterations > 0 && report.backward_error < 1e-12,
        "{report:?}"
    );
}

#[test]
fn threads_do_not_change_a_bit() {
    let grid = Grid::new([12, 12, 11], &[]);
    let mut matrix = grid.laplacian();
    let mut numbers = Numbers(3);
    fill(
        &mut matrix,
        |i, j| if i == j { 2.0 } else { 0.1 * numbers.next() },
    );
    let n = grid.structure.unknowns();
    let solution = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut solver = MultifrontalLu::new();
            solver.analyse(&grid.structure).unwrap();
            solver.factor(&matrix).unwrap();
            let mut x = vec![0.0; n];
            solver.solve(&matrix, &vec![1.0; n], &mut x).unwrap();
            x.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
        })
    };
    let one = solution(1);
    assert!(one == solution(2) && one == solution(3));
}
