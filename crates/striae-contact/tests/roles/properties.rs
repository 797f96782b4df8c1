//! Properties that hold for every flat pair: positivity, partition of unity, symmetry, invariance.

use std::collections::BTreeMap;

use proptest::prelude::*;
use striae_contact::{
    interface::{FacetMass, LastIncrement, Overlap},
    side::Side,
    traction_basis::{KeptNode, TractionBasis},
};
use striae_surface::node::SurfaceNode;

use crate::flat::{Face, Pair};

/// Grid lines whose spacings differ by up to a factor of e.
fn line(origin: f64, length: f64) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-0.5..0.5_f64, 1..8).prop_map(move |exponents| {
        let spacings: Vec<f64> = exponents.iter().map(|e| e.exp()).collect();
        let total: f64 = spacings.iter().sum();
        let mut line = vec![origin];
        for spacing in spacings {
            line.push(line[line.len() - 1] + spacing / total * length);
        }
        line
    })
}

/// Two graded faces with an overhang anywhere and any ratio of moduli.
fn graded() -> impl Strategy<Value = [Face; 2]> {
    let upper = (0.3..0.9_f64, -0.2..0.8_f64).prop_flat_map(|(l, o)| line(o, l));
    let upper_y = (0.3..0.9_f64, -0.2..0.8_f64).prop_flat_map(|(l, o)| line(o, l));
    let lower = (line(0.0, 1.0), line(0.0, 1.0));
    (lower, upper, upper_y, -4.0..4.0_f64).prop_map(|((x0, y0), x1, y1, ratio)| {
        let modulus = 10.0_f64.powf(ratio);
        [
            Face {
                xs: x0,
                ys: y0,
                modulus: 1.0,
            },
            Face {
                xs: x1,
                ys: y1,
                modulus,
            },
        ]
    })
}

/// Two uniform faces with all sorts of exact ties: whole, half and no shift, equal
/// and multiple divisions, equal moduli.
fn regular() -> impl Strategy<Value = [Face; 2]> {
    let ratio = prop::sample::select(vec![1.0, 1.0, 0.01, 100.0]);
    let shift = prop::sample::select(vec![0.0, 0.0, 0.25, 0.5, 1.0]);
    let shift_y = prop::sample::select(vec![0.0, 0.0, 0.25, 0.5, 1.0]);
    (2..7_usize, 1..7_usize, ratio, shift, shift_y).prop_map(|(m, n, modulus, dx, dy)| {
        let lower = Face::uniform([m, m], [1.0, 1.0], [0.0, 0.0], 1.0);
        let step = 1.0 / m as f64;
        let upper = Face::uniform([n, n], [1.0, 1.0], [dx * step, dy * step], modulus);
        [lower, upper]
    })
}

fn row_sum(row: &[(u32, f64)]) -> f64 {
    row.iter().map(|(_, value)| value).sum()
}

fn check_basis(pair: &Pair, basis: &TractionBasis) -> Result<(), TestCaseError> {
    for side in Side::BOTH {
        for (node, row) in basis.rows[side].iter().enumerate() {
            prop_assert!(row.iter().all(|&(_, value)| value >= 0.0));
            if pair.whole.is_none() {
                prop_assert!(!row.is_empty(), "all within reach carry");
            }
            if !row.is_empty() {
                prop_assert!((row_sum(row) - 1.0).abs() < 1e-14, "{}", row_sum(row));
            }
            if let Some(k) = basis.index[side][node] {
                prop_assert_eq!(row, &vec![(k, 1.0)]);
            }
        }
    }
    let area: f64 = basis.node_weights[0].iter().sum();
    prop_assert!((basis.weights.iter().sum::<f64>() - area).abs() < 1e-13);
    prop_assert!(basis.weights.iter().all(|&w| w > 0.0));
    for weak in &basis.ramp {
        prop_assert!(weak.coefficient >= 0.0);
        prop_assert!(row_sum(&weak.row).abs() < 1e-14);
    }
    Ok(())
}

/// Rows of transferred nodes hold at their own values.
fn check_transfer(pair: &Pair, basis: &TractionBasis) -> Result<(), TestCaseError> {
    let positive = |side: Side, node: SurfaceNode| basis.node_weights[side][node] > 0.0;
    for side in Side::BOTH {
        for (node, row) in basis.rows[side].iter().enumerate() {
            let Some((corners, weights)) = pair.opposing[side][node] else {
                continue;
            };
            if basis.index[side][node].is_some() {
                continue;
            }
            let seen = || (0..4).filter(|&c| positive(side.opposite(), corners[c]));
            let total: f64 = seen().map(|c| weights[c]).sum();
            let mut difference: BTreeMap<u32, f64> = row.iter().copied().collect();
            for c in seen() {
                for &(k, value) in &basis.rows[side.opposite()][corners[c]] {
                    *difference.entry(k).or_default() -= weights[c] / total * value;
                }
            }
            let miss = difference.values().fold(0.0_f64, |m, v| m.max(v.abs()));
            let nearest = row.iter().all(|&(_, value)| value == row[0].1);
            prop_assert!(miss < 1e-12 || nearest || total < 1e-12, "{miss:e}");
        }
    }
    Ok(())
}

/// The pair with its nodes in another order, facets and polygons too, and with the
/// sides changed over if told so.
struct Relabelled {
    pair: Pair,
    /// New number of an old node.
    to: [Vec<SurfaceNode>; 2],
    swap: usize,
}

fn shuffled(count: usize, seed: &mut u64) -> Vec<u32> {
    let mut order: Vec<u32> = (0..count as u32).collect();
    for at in (1..count).rev() {
        *seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        order.swap(at, (*seed >> 33) as usize % (at + 1));
    }
    order
}

fn relabelled_side(side: Side, swap: usize) -> Side {
    Side::BOTH[side.index() ^ swap]
}

fn relabelled(pair: &Pair, mut seed: u64, swap: usize) -> Relabelled {
    let to = Side::BOTH.map(|side| {
        let order = shuffled(pair.nodes[side].len(), &mut seed);
        order.into_iter().map(SurfaceNode).collect::<Vec<_>>()
    });
    let turn = (seed >> 40) as usize % 4;
    let corners = |side: Side, c: [SurfaceNode; 4]| {
        let c = c.map(|node| to[side][node]);
        [0, 1, 2, 3].map(|at: usize| c[(at + turn) % 4])
    };
    let new_side = |side| relabelled_side(side, swap);
    let mut nodes = pair.nodes.clone();
    let mut opposing = pair.opposing.clone();
    for side in Side::BOTH {
        for node in 0..pair.nodes[side].len() {
            let at = to[side][node].index();
            nodes[new_side(side)].resize(pair.nodes[side].len(), pair.nodes[side][0]);
            nodes[new_side(side)][at] = pair.nodes[side][node];
            opposing[new_side(side)].resize(pair.nodes[side].len(), None);
            opposing[new_side(side)][at] = pair.opposing[side][node].map(|(c, w)| {
                let w = [0, 1, 2, 3].map(|at: usize| w[(at + turn) % 4]);
                (corners(side.opposite(), c), w)
            });
        }
    }
    let overlap = |o: &Overlap| {
        let old = |c: usize| 4 * new_side(Side::BOTH[c / 4]).index() + (c % 4 + turn) % 4;
        Overlap {
            corners: Side::BOTH.map(|side| corners(new_side(side), o.corners[new_side(side)])),
            mass: std::array::from_fn(|c| std::array::from_fn(|d| o.mass[old(c)][old(d)])),
            normal: o.normal,
        }
    };
    let order = shuffled(pair.overlaps.len(), &mut seed);
    let overlaps = order.iter().map(|&at| overlap(&pair.overlaps[at as usize]));
    let facet = |f: &FacetMass| FacetMass {
        corners: corners(Side::A, f.corners),
        mass: std::array::from_fn(|c| {
            std::array::from_fn(|d| f.mass[(c + turn) % 4][(d + turn) % 4])
        }),
    };
    let pair = Pair {
        overlaps: overlaps.collect(),
        nodes,
        opposing,
        whole: pair
            .whole
            .as_ref()
            .map(|w| w.iter().rev().map(facet).collect()),
    };
    Relabelled { pair, to, swap }
}

/// Bits of rows by the old labels.
type Named = BTreeMap<(Side, SurfaceNode), Vec<(KeptNode, u64)>>;

fn named(
    basis: &TractionBasis,
    old: impl Fn(Side, SurfaceNode) -> (Side, SurfaceNode),
) -> (Named, Named) {
    let label = |k: u32| {
        let KeptNode { side, node } = basis.kept[k as usize];
        let (side, node) = old(side, node);
        KeptNode { side, node }
    };
    let row = |row: &[(u32, f64)]| {
        let mut row: Vec<_> = row.iter().map(|&(k, v)| (label(k), v.to_bits())).collect();
        row.sort();
        row
    };
    let mut rows = Named::new();
    for side in Side::BOTH {
        for (node, values) in basis.rows[side].iter().enumerate() {
            rows.insert(old(side, SurfaceNode::new(node)), row(values));
        }
    }
    let mut kept = Named::new();
    for k in 0..basis.kept.len() {
        let own = label(k as u32);
        let mut all = vec![
            (own, basis.pivots[k].to_bits()),
            (own, basis.flexibility[k].to_bits()),
            (own, basis.weights[k].to_bits()),
        ];
        for weak in basis.ramp.iter().filter(|weak| weak.kept == k as u32) {
            all.push((own, weak.coefficient.to_bits()));
            all.extend(row(&weak.row));
        }
        kept.insert((own.side, own.node), all);
    }
    (rows, kept)
}

fn check_labels(pair: &Pair, seed: u64, swap: usize) -> Result<(), TestCaseError> {
    let basis = TractionBasis::new(&pair.interface());
    let other = relabelled(pair, seed, swap);
    let again = TractionBasis::new(&other.pair.interface());
    let back = Side::BOTH.map(|side| {
        let mut back = vec![SurfaceNode(0); other.to[side].len()];
        for (old, &new) in other.to[side].iter().enumerate() {
            back[new] = SurfaceNode::new(old);
        }
        back
    });
    let old = |side: Side, node: SurfaceNode| {
        let side = relabelled_side(side, other.swap);
        (side, back[side][node])
    };
    let (rows, kept) = named(&basis, |side, node| (side, node));
    let (rows_again, kept_again) = named(&again, old);
    prop_assert_eq!(kept, kept_again);
    prop_assert_eq!(rows, rows_again);
    Ok(())
}

/// Returns whether both faces are equal to the last bit, so that only labels distinguish them.
fn are_alike(faces: &[Face; 2]) -> bool {
    faces[0].xs == faces[1].xs && faces[0].ys == faces[1].ys && faces[0].modulus == faces[1].modulus
}

fn remember(pair: &mut Pair, basis: &TractionBasis) {
    for side in Side::BOTH {
        for (node, kept) in pair.nodes[side].iter_mut().zip(&basis.index[side]) {
            node.last = match kept {
                Some(_) => LastIncrement::Kept,
                None => LastIncrement::NotKept,
            };
        }
    }
}

/// Nodes that a repetition with memory keeps or drops newly.
fn flips(pair: &mut Pair) -> usize {
    let basis = TractionBasis::new(&pair.interface());
    remember(pair, &basis);
    let again = TractionBasis::new(&pair.interface());
    let new = again.kept.iter().filter(|k| !basis.kept.contains(k));
    let gone = basis.kept.iter().filter(|k| !again.kept.contains(k));
    new.count() + gone.count()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..Default::default() })]

    #[test]
    fn the_field_is_positive_and_sums_to_one(faces in prop_oneof![graded(), regular()], rigid in 0..3) {
        let faces = faces.each_ref();
        let pair = if rigid == 0 { Pair::on_rigid(faces) } else { Pair::new(faces) };
        prop_assume!(!pair.overlaps.is_empty());
        let basis = TractionBasis::new(&pair.interface());
        check_basis(&pair, &basis)?;
        if rigid != 0 {
            check_transfer(&pair, &basis)?;
        }
    }

    #[test]
    fn neither_numbers_nor_sides_matter(faces in prop_oneof![graded(), regular()], seed: u64, swap in 0..2_usize) {
        prop_assume!(!are_alike(&faces));
        let pair = Pair::new(faces.each_ref());
        prop_assume!(!pair.overlaps.is_empty());
        check_labels(&pair, seed, swap)?;
    }

    #[test]
    fn numbers_do_not_matter_on_a_rigid_surface(faces in prop_oneof![graded(), regular()], seed: u64) {
        let pair = Pair::on_rigid(faces.each_ref());
        prop_assume!(!pair.overlaps.is_empty());
        check_labels(&pair, seed, 0)?;
    }

    #[test]
    fn equals_stay_what_they_were(faces in regular()) {
        let mut pair = Pair::new(faces.each_ref());
        prop_assume!(!pair.overlaps.is_empty());
        prop_assert_eq!(flips(&mut pair), 0);
    }

    #[test]
    fn graded_meshes_stay_what_they_were(faces in graded()) {
        let mut pair = Pair::new(faces.each_ref());
        prop_assume!(!pair.overlaps.is_empty());
        prop_assert_eq!(flips(&mut pair), 0);
    }
}
