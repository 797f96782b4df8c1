//! The whole program in the limit of small displacements against an independent
//! implementation for small strains and flat faces.
//!
//! Coulomb contact that touches without load is homogeneous of degree one: forces over
//! the depth `d` of a press tend to those of the linear theory, from which they differ by
//! the powers of `d` that the changes of the geometry bring. These are extrapolated away.

mod blocks;
mod prediction;
mod reference;

use blocks::{Faces, History};
use reference::{Case, cases};
use striae_contact::side::Side;
use striae_mesh::Vec3;

/// The largest depth; the others are its halves.
const DEPTH: f64 = 1e-5;
/// Number of depths.
const DEPTHS: usize = 5;
/// Part of the largest value to which the limits agree: where supports are partly closed, points
/// open and close as the depth is halved.
const AGREEMENT: f64 = 2e-8;

/// The limits for vanishing depth of values at a sequence of halved depths.
fn limit(mut values: Vec<Vec<f64>>) -> Vec<f64> {
    let mut factor = 2.0;
    while values.len() > 1 {
        values = values
            .windows(2)
            .map(|pair| {
                let at = pair[0].iter().zip(&pair[1]);
                at.map(|(coarse, fine)| (factor * fine - coarse) / (factor - 1.0))
                    .collect()
            })
            .collect();
        factor *= 2.0;
    }
    values.remove(0)
}

fn coordinates(vectors: impl IntoIterator<Item = Vec3>) -> Vec<f64> {
    vectors.into_iter().flat_map(|v| [v.x, v.y, v.z]).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| most.max(v.abs()))
}

fn assert_close(found: &[f64], expected: &[f64], scale: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let apart = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
    let apart = apart.fold(0.0, f64::max) / scale;
    assert!(apart <= AGREEMENT, "{what}: {apart:.1e}");
}

/// Asserts that tractions scale with the load, and that friction keeps within its bound.
fn assert_admissible(mu: f64, [limit, at_depth]: [&[f64]; 2], what: &str) {
    let scale = largest(limit);
    let apart = limit.iter().zip(at_depth).map(|(a, b)| (a - b).abs());
    let apart = apart.fold(0.0, f64::max) / scale;
    assert!(apart <= 1e-3, "{what}: {apart:.1e} of the load");
    for node in limit.chunks_exact(3) {
        let beyond = node[1].hypot(node[2]) - mu * node[0];
        assert!(node[0] > -AGREEMENT * scale, "{what}: {node:?}");
        assert!(beyond <= AGREEMENT * scale, "{what}: {node:?}");
    }
}

fn assert_agrees(case: &Case) {
    let histories: Vec<History> = (0..DEPTHS)
        .map(|halvings| History::of(case, DEPTH * 0.5_f64.powi(halvings as i32)))
        .collect();
    for (at, expected) in case.increments.iter().enumerate() {
        let what = |of: &str| format!("{of} in increment {at} of {}", case.name);
        let over_depth = |of: &dyn Fn(&Faces) -> Vec<Vec3>| {
            let values = histories.iter().map(|history| {
                let values = of(&history.increments[at]).into_iter();
                coordinates(values.map(|value| value / history.depth))
            });
            limit(values.collect())
        };
        for history in &histories {
            let kept = &history.increments[at].kept;
            assert_eq!(kept, &expected.kept, "{}", what("roles"));
        }
        let unknowns = over_depth(&|faces: &Faces| faces.unknowns.clone());
        if expected.unknowns.is_empty() {
            let first = histories[0].increments[at].unknowns.iter();
            let first = coordinates(first.map(|value| value / histories[0].depth));
            assert_admissible(case.mu, [&unknowns, &first], &what("tractions"));
            continue;
        }
        let scale = largest(&expected.unknowns);
        assert_close(&unknowns, &expected.unknowns, scale, &what("tractions"));
        for side in Side::BOTH {
            let forces = over_depth(&|faces: &Faces| faces.forces[side].clone());
            let of_side = &expected.forces[side];
            let scale = largest(of_side);
            assert_close(&forces, of_side, scale, &what("forces"));
        }
    }
}

/// Frictionless and with friction, by the number of the case.
macro_rules! agrees {
    ($($name:ident: $number:literal),+ $(,)?) => {
        $(#[test]
        fn $name() {
            assert_agrees(&cases()[$number]);
        })+
    };
}

agrees! {
    soft_punch: 0,
    stiff_punch: 1,
    soft_coarse_punch_on_a_fine_base: 2,
    stiff_fine_punch_on_a_coarse_base: 3,
    overhang: 4,
    sheared: 5,
    sheared_stiff_punch: 6,
    sheared_soft_overhang: 7,
    sheared_stiff_coarse_punch: 8,
    slide_with_moving_overlap: 9,
    slide_from_flush_edges: 10,
}
