//! Factorisation times on stacked blocks of hexahedra: `blocks [unknowns ...]`.
//!
//! Systems on two blocks, one above the other: `K`, symmetric positive definite
//! with three unknowns a node; `U`, with three multipliers at every node of one
//! block's face that tie it to the other's, unsymmetric; `S`, the Schur
//! complement of `K` on both faces. The sparse Cholesky of faer (ordering AMD)
//! on `K` is the yardstick.

use faer::{
    Side,
    sparse::{SparseColMat, Triplet},
};
use std::time::Instant;
use striae_sparse::{
    LinearSolver, MultifrontalLu, Precision, SchurCholesky, SparseMatrix, Structure, Supervariable,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sizes: Vec<usize> = std::env::args()
        .skip(1)
        .filter_map(|s| s.parse().ok())
        .collect();
    let sizes = if sizes.is_empty() {
        vec![10_000, 45_000, 150_000]
    } else {
        sizes
    };
    for unknowns in sizes {
        let side = (unknowns as f64 / 3.0).cbrt().round() as usize;
        let stiffness = blocks(side, Ties::None)?;
        let yardstick = cholesky(&stiffness)?;
        println!(
            "K {:7}  faer Cholesky {yardstick:7.3} s",
            stiffness.structure().unknowns()
        );
        multifrontal("K", &stiffness, yardstick)?;
        condensation(&stiffness, side, yardstick)?;
        drop(stiffness);
        multifrontal("U", &blocks(side, Ties::Layer)?, yardstick)?;
    }
    Ok(())
}

fn multifrontal(
    name: &str,
    matrix: &SparseMatrix,
    yardstick: f64,
) -> Result<(), Box<dyn std::error::Error>> {
    let n = matrix.structure().unknowns();
    let mut solver = MultifrontalLu::new();
    let start = Instant::now();
    let analysis = solver.analyse(matrix.structure())?;
    let analyse = start.elapsed().as_secs_f64();
    let mut factor = [0.0; 2];
    let mut report = Default::default();
    for time in &mut factor {
        let start = Instant::now();
        report = solver.factor(matrix)?;
        *time = start.elapsed().as_secs_f64();
    }
    let (rhs, mut x) = (vec![1.0; n], vec![0.0; n]);
    let start = Instant::now();
    let solved = solver.solve(matrix, &rhs, &mut x)?;
    let solve = start.elapsed().as_secs_f64();
    println!(
        "{name} {n:7}  analyse {analyse:6.3} s  factor {:7.3} s, again {:7.3} s ({:.2} x Cholesky, {:.1} Gflop/s)  solve {solve:6.3} s",
        factor[0],
        factor[1],
        factor[1] / yardstick,
        1e-9 * analysis.flops / factor[1],
    );
    println!(
        "           {:.1} M entries, peak {:.2} GB; {report:?}; {solved:?}",
        1e-6 * analysis.factor_entries as f64,
        1e-9 * analysis.peak_bytes as f64,
    );
    Ok(())
}

/// Schur complement on the two faces.
fn condensation(
    matrix: &SparseMatrix,
    side: usize,
    yardstick: f64,
) -> Result<(), Box<dyn std::error::Error>> {
    let area = side * side;
    let kept: Vec<_> = (side / 2 * area..(side / 2 + 2) * area)
        .map(Supervariable)
        .collect();
    let mut schur = SchurCholesky::analyse(matrix.structure(), &kept)?;
    for precision in [Precision::Double, Precision::Single] {
        schur.factor(matrix, precision)?;
        let start = Instant::now();
        schur.factor(matrix, precision)?;
        let factor = start.elapsed().as_secs_f64();
        println!(
            "S {:7}  condensed, {precision:?} {factor:7.3} s ({:.2} x Cholesky, {:.1} Gflop/s)",
            schur.kept_unknowns().len(),
            factor / yardstick,
            1e-9 * schur.cost(precision).flops / factor,
        );
    }
    Ok(())
}

/// Option to tie the face of the lower block by multipliers.
#[derive(Clone, Copy, PartialEq)]
enum Ties {
    None,
    Layer,
}

/// Two blocks that make a cube of `side^3` nodes: cell matrices of a vector Laplacian with some coupling.
fn blocks(side: usize, ties: Ties) -> Result<SparseMatrix, Box<dyn std::error::Error>> {
    let node = |x: usize, y: usize, z: usize| x + side * (y + side * z);
    let layer = side / 2;
    let tied = |k: usize| ties == Ties::Layer && k / (side * side) == layer;
    let mut offsets = vec![0];
    for k in 0..side * side * side {
        offsets.push(offsets[k] + if tied(k) { 6 } else { 3 });
    }
    let mut cells = Vec::new();
    for z in 0..side - 1 {
        for y in 0..side - 1 {
            for x in 0..side - 1 {
                if z != layer {
                    let corner = |k: usize| node(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
                    cells.push((0..8).map(|k| Supervariable(corner(k))).collect::<Vec<_>>());
                }
            }
        }
    }
    let grid = cells.len();
    if ties == Ties::Layer {
        cells.extend(pairs(side, layer));
    }
    let structure = Structure::from_cliques(offsets, &cells)?;
    let mut matrix = SparseMatrix::zero(&structure);
    for cell in &cells[..grid] {
        let first = |s: &Supervariable| structure.unknowns_of(*s).start;
        let unknowns: Vec<usize> = cell
            .iter()
            .flat_map(|s| (0..3).map(move |c| first(s) + c))
            .collect();
        matrix.add(&unknowns, &unknowns, &cell_matrix())?;
    }
    for tie in &cells[grid..] {
        add_tie(&mut matrix, tie)?;
    }
    for k in 0..side * side {
        for fixed in [k, structure.supervariables() - 1 - k] {
            let first = structure.unknowns_of(Supervariable(fixed)).start;
            for c in first..first + 3 {
                matrix.add(&[c], &[c], &[1.0])?;
            }
        }
    }
    Ok(matrix)
}

/// Each node of the layer with the four nearest nodes of the next one.
fn pairs(side: usize, layer: usize) -> impl Iterator<Item = Vec<Supervariable>> {
    (0..side * side).map(move |k| {
        let (x, y) = (k % side, k / side);
        let (x, y) = (x.min(side - 2), y.min(side - 2));
        let above = |dx: usize, dy: usize| x + dx + side * (y + dy + side * (layer + 1));
        let list = [
            k + side * side * layer,
            above(0, 0),
            above(1, 0),
            above(0, 1),
            above(1, 1),
        ];
        list.map(Supervariable).to_vec()
    })
}

/// Multipliers tie a node to the mean of four; the tangential rows are "slipping".
fn add_tie(
    matrix: &mut SparseMatrix,
    tie: &[Supervariable],
) -> Result<(), Box<dyn std::error::Error>> {
    let structure = matrix.structure().clone();
    let multiplier = structure.unknowns_of(tie[0]).start + 3;
    for c in 0..3 {
        for (k, s) in tie.iter().enumerate() {
            let weight = if k == 0 { 1.0 } else { -0.25 };
            let unknown = structure.unknowns_of(*s).start + c;
            matrix.add(&[unknown], &[multiplier + c], &[weight])?;
            let slips = c > 0 && tie[0].0.is_multiple_of(2);
            matrix.add(
                &[multiplier + c],
                &[unknown],
                &[if slips { 0.01 * weight } else { weight }],
            )?;
            if slips && k == 0 {
                matrix.add(
                    &[multiplier + c],
                    &[multiplier + c, multiplier],
                    &[1.0, -0.3],
                )?;
            }
        }
    }
    Ok(())
}

/// Element matrix on eight corners with three unknowns each: semidefinite, constants cost nothing.
fn cell_matrix() -> Vec<f64> {
    let coupling = [[1.0, 0.2, 0.1], [0.2, 1.2, 0.3], [0.1, 0.3, 0.9]];
    let mut block = vec![0.0; 24 * 24];
    for i in 0..24 {
        for j in 0..24 {
            let graph = if i / 3 == j / 3 { 7.0 } else { -1.0 };
            block[24 * i + j] = graph * coupling[i % 3][j % 3] / 8.0;
        }
    }
    block
}

/// Seconds for faer's numeric sparse Cholesky, symbolic part included.
fn cholesky(matrix: &SparseMatrix) -> Result<f64, Box<dyn std::error::Error>> {
    let n = matrix.structure().unknowns();
    let lower = (0..n).flat_map(|i| {
        let entries = matrix.row(i).filter(move |&(j, _)| j <= i);
        entries
            .map(move |(j, a)| Triplet::new(i, j, a))
            .collect::<Vec<_>>()
    });
    let lower: Vec<Triplet<usize, usize, f64>> = lower.collect();
    let sparse = SparseColMat::try_new_from_triplets(n, n, &lower).map_err(|e| format!("{e:?}"))?;
    drop(lower);
    let symbolic =
        faer::sparse::linalg::solvers::SymbolicLlt::try_new(sparse.symbolic(), Side::Lower)
            .map_err(|e| format!("{e:?}"))?;
    let start = Instant::now();
    faer::sparse::linalg::solvers::Llt::try_new_with_symbolic(
        symbolic,
        sparse.as_ref(),
        Side::Lower,
    )
    .map_err(|e| format!("{e:?}"))?;
    Ok(start.elapsed().as_secs_f64())
}
