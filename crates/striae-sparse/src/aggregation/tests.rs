//! A clamped elastic block: what a V-cycle must be and how good it is.

use super::{
    Hierarchy, MODES, NONE, aggregates::Aggregates, blocks::Blocks, level::Level, others::Nobody,
    prolongator::Tentative,
};
use crate::gmres;

#[path = "../../tests/elastic/mod.rs"]
mod elastic;
mod parts;

/// Cube of `n` elements an edge with its lowest nodes held, and its near-kernel.
fn clamped(n: usize, poisson: f64) -> (Blocks<3, 3, f64>, Vec<f64>) {
    let side = n + 1;
    let nodes = side * side * side;
    let lambda = 2.0 * poisson / (1.0 - 2.0 * poisson);
    let cell = elastic::cell(lambda, 1.0, 1.0);
    let place = |k: usize| [k % side, k / side % side, k / (side * side)];
    let held = |k: usize| place(k)[2] == 0;
    let matrix = Blocks::from_rows(nodes, nodes, |i, sum| {
        if held(i) {
            (0..3).for_each(|k| sum.block(i)[4 * k] = 1.0);
            return;
        }
        let at = place(i);
        for a in 0..8 {
            let low: Option<Vec<usize>> = (0..3).map(|k| at[k].checked_sub(a >> k & 1)).collect();
            let Some(low) = low.filter(|low| low.iter().all(|&x| x < n)) else {
                continue;
            };
            for b in 0..8 {
                let [x, y, z] = [0, 1, 2].map(|k| low[k] + (b >> k & 1));
                let j = x + side * (y + side * z);
                if !held(j) {
                    for entry in 0..9 {
                        let (r, c) = (entry / 3, entry % 3);
                        sum.block(j)[entry] += cell[(3 * a + r) * 24 + 3 * b + c];
                    }
                }
            }
        }
    });
    let kernel = (0..nodes).flat_map(|k| {
        let [x, y, z] = place(k).map(|x| x as f64 / n as f64 - 0.5);
        let scale = if held(k) { 0.0 } else { 1.0 };
        let rows = [
            [1.0, 0.0, 0.0, 0.0, z, -y],
            [0.0, 1.0, 0.0, -z, 0.0, x],
            [0.0, 0.0, 1.0, y, -x, 0.0],
        ];
        rows.into_iter().flatten().map(move |v| scale * v)
    });
    (matrix, kernel.collect())
}

fn numbers(n: usize, seed: usize) -> Vec<f64> {
    let number = |k: usize| ((k * 7919 + seed * 104_729) % 1000) as f64 / 500.0 - 1.0;
    (0..n).map(number).collect()
}

fn apply(hierarchy: &Hierarchy, v: &[f64]) -> Vec<f64> {
    let b: Vec<f32> = v.iter().map(|&v| v as f32).collect();
    let mut x = vec![0.0; b.len()];
    hierarchy.apply(&b, &mut x);
    x.into_iter().map(f64::from).collect()
}

/// One part for all nodes of a near-kernel.
fn one_part(kernel: &[f64]) -> Vec<u32> {
    vec![0; kernel.len() / (3 * MODES)]
}

/// Iterations to reduce the residual by a million.
fn iterations(n: usize, poisson: f64) -> usize {
    let (matrix, kernel) = clamped(n, poisson);
    let multiply = |x: &[f64], y: &mut [f64]| {
        for i in 0..matrix.rows() {
            let mut sum = [0.0; 3];
            for (j, block) in matrix.row(i) {
                for entry in 0..9 {
                    sum[entry / 3] += block[entry] * x[3 * j + entry % 3];
                }
            }
            y[3 * i..3 * i + 3].copy_from_slice(&sum);
        }
    };
    let hierarchy = Hierarchy::new(matrix.clone(), &kernel, &one_part(&kernel)).unwrap();
    let precondition = |v: &mut [f64]| v.copy_from_slice(&apply(&hierarchy, v));
    let b = numbers(3 * matrix.rows(), 1);
    let ends = gmres::Ends {
        iterations: 100,
        reduction: 1e-6,
    };
    gmres::solve(&multiply, &precondition, &b, ends).iterations
}

#[test]
fn iterations_hardly_grow_under_refinement() {
    let counts = [6, 12, 24].map(|n| iterations(n, 0.3));
    assert!(counts[2] <= counts[1] + 5 && counts[2] <= 20, "{counts:?}");
}

#[test]
fn a_nearly_incompressible_block_takes_more_but_not_many() {
    let count = iterations(12, 0.49);
    assert!(count <= 45, "{count}");
}

/// Returns whether no aggregate has nodes of two parts.
fn are_of_one_part(aggregates: &Aggregates, parts: &[u32]) -> bool {
    let own = aggregates.parts(parts);
    let mut pairs = aggregates.of.iter().zip(parts);
    pairs.all(|(&aggregate, part)| aggregate == NONE || own[aggregate as usize] == *part)
}

#[test]
fn aggregates_are_of_one_part_on_every_level() {
    let (matrix, kernel) = clamped(11, 0.3);
    let layers = 12 * 12;
    let parts: Vec<u32> = (0..matrix.rows())
        .map(|k| (k / (4 * layers)) as u32)
        .collect();
    let aggregates = Aggregates::new(&matrix, 0.06, &parts);
    assert!(are_of_one_part(&aggregates, &parts));
    let mut level = Level::new(&matrix, matrix.rows(), (&mut Nobody, &|own| own));
    let coarser = level.coarsen(matrix, &kernel, 0.06, &parts);
    assert_eq!(coarser.parts, aggregates.parts(&parts));
    let [with, without] = [coarser.parts.clone(), vec![0; coarser.parts.len()]]
        .map(|parts| Aggregates::new(&coarser.matrix, 0.03, &parts));
    assert!(are_of_one_part(&with, &coarser.parts));
    assert!(!are_of_one_part(&without, &coarser.parts));
}

#[test]
fn the_near_kernel_is_interpolated_exactly() {
    let (matrix, kernel) = clamped(7, 0.3);
    let aggregates = Aggregates::new(&matrix, 0.05, &vec![0; matrix.rows()]);
    let tentative = Tentative::new::<3>(&aggregates, &kernel);
    for (i, &aggregate) in aggregates.of.iter().enumerate() {
        // Held nodes are in no aggregate.
        let Some(r) = tentative
            .coarse
            .get(aggregate as usize * MODES * MODES..)
            .map(|r| &r[..MODES * MODES])
        else {
            assert!(i < 64);
            continue;
        };
        for row in 0..3 {
            let own = &tentative.values[(3 * i + row) * MODES..][..MODES];
            for c in 0..MODES {
                let sum: f64 = (0..MODES).map(|k| own[k] * r[k * MODES + c]).sum();
                let expected = kernel[(3 * i + row) * MODES + c];
                assert!((sum - expected).abs() < 1e-13, "{i} {sum} {expected}");
            }
        }
    }
}

#[test]
fn a_v_cycle_is_symmetric_and_positive_definite() {
    let (matrix, kernel) = clamped(9, 0.3);
    let n = 3 * matrix.rows();
    let hierarchy = Hierarchy::new(matrix, &kernel, &one_part(&kernel)).unwrap();
    let (u, v) = (numbers(n, 1), numbers(n, 2));
    let (mu, mv) = (apply(&hierarchy, &u), apply(&hierarchy, &v));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (uu, vv) = (dot(&u, &mu), dot(&v, &mv));
    assert!(uu > 0.0 && vv > 0.0);
    // Round-off of single precision.
    let difference = (dot(&u, &mv) - dot(&v, &mu)).abs();
    assert!(difference < 1e-5 * (uu * vv).sqrt(), "{difference:e}");
}

#[test]
fn there_are_three_levels_of_a_block_of_some_size() {
    let (matrix, kernel) = clamped(24, 0.3);
    let hierarchy = Hierarchy::new(matrix, &kernel, &one_part(&kernel)).unwrap();
    assert_eq!(hierarchy.levels(), 3);
}
