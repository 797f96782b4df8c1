//! Scenes with a known answer.

use std::time::Instant;

use striae_contact::{
    interface::LastIncrement,
    roles::THETA_0,
    side::Side,
    traction_basis::{KeptNode, THETA_1, TractionBasis},
};
use striae_surface::node::SurfaceNode;

use crate::flat::{Face, Pair};

fn square(divisions: usize, size: f64, origin: f64, modulus: f64) -> Face {
    Face::uniform([divisions; 2], [size; 2], [origin; 2], modulus)
}

#[test]
fn equal_faces_keep_one_node_of_every_pair() {
    let face = square(5, 1.0, 0.0, 1.0);
    let pair = Pair::new([&face, &face]);
    let basis = TractionBasis::new(&pair.interface());
    let sides: Vec<Side> = basis.kept.iter().map(|kept| kept.side).collect();
    assert_eq!(basis.kept.len(), 36);
    assert!(sides.iter().all(|&side| side == sides[0]), "of one side");
    for node in 0..36 {
        assert_eq!(basis.rows[0][node], basis.rows[1][node], "node {node}");
        assert_eq!(basis.rows[0][node], vec![(node as u32, 1.0)]);
    }
    assert_eq!(basis.weights, basis.node_weights[0]);
}

#[test]
fn a_much_softer_fine_face_keeps_its_nodes() {
    let (soft, hard) = (square(8, 1.0, 0.0, 1.0), square(2, 1.0, 0.0, 1e6));
    for (faces, side) in [([&soft, &hard], Side::A), ([&hard, &soft], Side::B)] {
        let pair = Pair::new(faces);
        let basis = TractionBasis::new(&pair.interface());
        let own = basis.kept.iter().filter(|kept| kept.side == side).count();
        assert!(own >= 70, "{own} of 81");
    }
}

#[test]
fn a_node_amid_a_matching_face_is_not_weak() {
    let (soft, hard) = (square(8, 1.0, 0.0, 1.0), square(8, 1.0, 0.0, 1e9));
    let pair = Pair::new([&soft, &hard]);
    let basis = TractionBasis::new(&pair.interface());
    let [own, other] = Side::BOTH.map(|side| basis.index[side][40]);
    let middle = own.or(other).expect("one of both is kept") as usize;
    assert!(basis.pivots[middle] > THETA_1, "{}", basis.pivots[middle]);
    assert!((basis.flexibility[middle] - 0.125).abs() < 1e-8);
}

#[test]
fn a_fully_covered_face_on_a_rigid_one_has_pivots_of_a_quarter() {
    let (own, rigid) = (square(4, 1.0, 0.0, 1.0), square(3, 2.0, -0.5, 1.0));
    let basis = TractionBasis::new(&Pair::on_rigid([&own, &rigid]).interface());
    assert_eq!(basis.kept.len(), 25);
    assert!(
        basis
            .pivots
            .iter()
            .all(|pivot| (pivot - 0.25).abs() < 1e-14)
    );
    assert!(basis.ramp.is_empty());
    assert_eq!(basis.weights, basis.node_weights[0]);
}

#[test]
fn slivers_on_a_rigid_face_fade_out() {
    let own = square(4, 1.0, 0.0, 1.0);
    let mut last = 0.0;
    for share in [0.01, 0.1, 0.2, 0.4, 0.8] {
        // The facets of the fourth column are covered by this share of their width.
        let rigid = square(1, 0.75 + 0.25 * share, 0.0, 1.0);
        let basis = TractionBasis::new(&Pair::on_rigid([&own, &rigid]).interface());
        let corner = basis.index[0][24];
        let pivot = corner.map_or(0.0, |k| basis.pivots[k as usize]);
        assert!(pivot >= last);
        assert_eq!(corner.is_some(), pivot >= THETA_0);
        if let Some(k) = corner {
            let weak = basis.ramp.iter().any(|weak| weak.kept == k);
            assert_eq!(weak, pivot < 0.1, "{share} {pivot}");
        } else {
            let row = &basis.rows[0][24];
            assert!((row.iter().map(|(_, v)| v).sum::<f64>() - 1.0).abs() < 1e-15);
        }
        last = pivot;
    }
    assert!(last > 0.01);
}

#[test]
fn two_patches_do_not_take_from_each_other() {
    // Feet that touch a large base: one well covered, one by a sliver of a corner.
    let base = square(4, 4.0, 0.0, 1.0);
    let foot = square(2, 1.0, 0.5, 1.0);
    let mut pair = Pair::new([&base, &foot]);
    let sliver = Pair::new([&square(1, 1.0, 10.0, 1.0), &square(1, 1.0, 10.98, 1.0)]);
    let shift = Side::BOTH.map(|side| pair.nodes[side].len() as u32);
    for side in Side::BOTH {
        pair.nodes[side].extend(&sliver.nodes[side]);
        let moved = sliver.opposing[side].iter().map(|hit| {
            hit.map(|(corners, weights)| {
                (
                    corners.map(|node| SurfaceNode(node.0 + shift[side.opposite()])),
                    weights,
                )
            })
        });
        pair.opposing[side].extend(moved);
    }
    for mut overlap in sliver.overlaps {
        for side in Side::BOTH {
            overlap.corners[side] =
                overlap.corners[side].map(|node| SurfaceNode(node.0 + shift[side]));
        }
        pair.overlaps.push(overlap);
    }
    let basis = TractionBasis::new(&pair.interface());
    let is_in_sliver = |kept: &KeptNode| kept.node.0 >= shift[kept.side];
    assert_eq!(
        basis.kept.iter().filter(|kept| is_in_sliver(kept)).count(),
        1
    );
    for side in Side::BOTH {
        for (node, row) in basis.rows[side].iter().enumerate() {
            let sliver = node as u32 >= shift[side];
            for &(k, _) in row {
                assert_eq!(
                    is_in_sliver(&basis.kept[k as usize]),
                    sliver,
                    "{side} {node}"
                );
            }
        }
    }
}

#[test]
fn a_node_that_was_kept_leaves_at_the_threshold_like_any_other() {
    let own = square(4, 1.0, 0.0, 1.0);
    let at = |share: f64, last: LastIncrement| {
        let rigid = square(1, 0.75 + 0.25 * share, 0.0, 1.0);
        let mut pair = Pair::on_rigid([&own, &rigid]);
        pair.nodes[0].iter_mut().for_each(|node| node.last = last);
        TractionBasis::new(&pair.interface()).kept
    };
    for share in (1..100).map(|at| 0.01 * f64::from(at)) {
        let [was, was_not] = [LastIncrement::Kept, LastIncrement::NotKept].map(|l| at(share, l));
        assert_eq!(was, was_not, "{share}");
    }
}

#[test]
fn of_equals_those_that_were_kept_are_kept_again() {
    let square = square(4, 1.0, 0.0, 1.0);
    for side in Side::BOTH {
        let mut pair = Pair::new([&square, &square]);
        let were_kept = &mut pair.nodes[side];
        were_kept
            .iter_mut()
            .for_each(|node| node.last = LastIncrement::Kept);
        let kept = TractionBasis::new(&pair.interface()).kept;
        assert!(!kept.is_empty() && kept.iter().all(|kept| kept.side == side));
    }
}

#[test]
fn faces_with_nothing_in_common_keep_nothing() {
    let pair = Pair::new([&square(2, 1.0, 0.0, 1.0), &square(2, 1.0, 3.0, 1.0)]);
    let basis = TractionBasis::new(&pair.interface());
    assert!(basis.kept.is_empty() && basis.ramp.is_empty());
    assert!(basis.rows.iter().flatten().all(Vec::is_empty));
}

#[test]
fn thousands_of_candidates_take_a_moment() {
    for (divisions, modulus) in [
        ([38, 38], 1.0),
        ([38, 38], 100.0),
        ([50, 20], 1.0),
        ([50, 20], 0.01),
        ([100, 100], 1.0),
    ] {
        let lower = square(divisions[0], 1.0, 0.0, 1.0);
        let upper = square(divisions[1], 1.0, 0.013, modulus);
        let pair = Pair::new([&lower, &upper]);
        let start = Instant::now();
        let basis = TractionBasis::new(&pair.interface());
        let candidates = basis
            .node_weights
            .iter()
            .flatten()
            .filter(|&&w| w > 0.0)
            .count();
        println!(
            "{candidates} candidates, {} kept: {:.1} ms",
            basis.kept.len(),
            1e3 * start.elapsed().as_secs_f64()
        );
        // Far above what it takes: only a change of order shows, whatever the load.
        assert!(start.elapsed().as_secs_f64() < 20.0);
    }
}
