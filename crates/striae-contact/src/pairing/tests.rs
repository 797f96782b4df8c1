//! Facets of different sizes.

use striae_mesh::{NodeId, Vec3};
use striae_surface::topology::Surface;

use super::{Corners, Scope, compliances, paired_facets};
use crate::{
    configuration::Configuration,
    pair::{ContactPair, Enforcement, Geometry, PairedSurface},
    placement::Placement,
    segment::SegmentDerivatives,
};

/// A unit square of `count` by `count` facets at a height, that looks upwards or downwards, with
/// the places of its nodes.
fn square(count: usize, height: f64, up: bool) -> (PairedSurface, Vec<Vec3>) {
    let node = |i: usize, j: usize| NodeId::new(i + (count + 1) * j);
    let places = || (0..=count).flat_map(|j| (0..=count).map(move |i| [i, j]));
    let x = places().map(|at| {
        let [x, y] = at.map(|k| k as f64 / count as f64);
        Vec3::new(x, y, height)
    });
    let cells = places().filter(|[i, j]| *i < count && *j < count);
    let facets: Vec<_> = cells
        .map(|[i, j]| {
            let [a, b, c, d] = [
                node(i, j),
                node(i + 1, j),
                node(i + 1, j + 1),
                node(i, j + 1),
            ];
            if up { [a, b, c, d] } else { [a, d, c, b] }
        })
        .collect();
    let side = PairedSurface {
        geometry: Geometry::Deformable(Surface::new(&facets)),
        stiffness: 1.0,
        texture: None,
        behind: Vec::new(),
        enclosure: None,
    };
    (side, x.collect())
}

/// Number of pairs of squares with so many facets along an edge, across a gap.
fn paired(counts: [usize; 2], gap: f64, search_distance: Option<f64>) -> usize {
    let (a, x_a) = square(counts[0], 0.0, true);
    let (b, x_b) = square(counts[1], gap, false);
    let pair = ContactPair {
        name: "squares".to_owned(),
        sides: [a, b],
        enforcement: Enforcement::Weighted,
        search_distance,
        has_faces: false,
        one_body: false,
        wear: [0.0; 2],
        wear_across: 1.0,
    };
    let at = Configuration::new(&pair, [x_a, x_b], Placement::at_rest());
    let compliances = compliances(&at);
    let scope = Scope {
        compliances: &compliances,
        depth: 0.0,
        start: None,
    };
    let none = |_: &[Corners]| SegmentDerivatives::None;
    paired_facets(&at, scope, &none, |_| true).len()
}

#[test]
fn the_larger_of_two_facets_decides_how_far_they_look() {
    for [one, other] in [[1, 10], [2, 20], [4, 4]] {
        let (half, all) = (0.5 / one as f64, other * other);
        for counts in [[one, other], [other, one]] {
            assert_eq!(paired(counts, 0.99 * half, None), all, "{counts:?}");
            assert_eq!(paired(counts, 1.01 * half, None), 0, "{counts:?}");
            let search = Some(1.5 * half);
            assert_eq!(paired(counts, 1.49 * half, search), all, "{counts:?}");
            assert_eq!(paired(counts, 1.51 * half, search), 0, "{counts:?}");
        }
    }
}
