//! Facets of different sizes and directions.

use striae_mesh::{FacetId, NodeId, Vec3};
use striae_surface::{facet::Shape, topology::Surface};
use striae_verify::Random;

use super::{Candidates, Corners, PairedFacets, Scope, compliances, joined, paired_facets, reach};
use crate::{
    configuration::Configuration,
    pair::{ContactPair, Enforcement, Geometry, PairedSurface},
    placement::Placement,
    segment::{FACING, Facet, SegmentDerivatives, segment_facing},
    side::Side,
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
    (side(&facets), x.collect())
}

/// A deformable side of these facets.
pub(super) fn side(facets: &[[NodeId; 4]]) -> PairedSurface {
    PairedSurface {
        geometry: Geometry::Deformable(Surface::new(facets)),
        stiffness: 1.0,
        texture: None,
        behind: Vec::new(),
        enclosure: None,
    }
}

/// A pair of two sides.
pub(super) fn pair_of(sides: [PairedSurface; 2], search_distance: Option<f64>) -> ContactPair {
    ContactPair {
        name: "pair".to_owned(),
        sides,
        enforcement: Enforcement::Weighted,
        search_distance,
        has_faces: false,
        one_body: false,
        wear: [0.0; 2],
        wear_across: 1.0,
    }
}

/// Number of pairs of squares with so many facets along an edge, across a gap.
fn paired(counts: [usize; 2], gap: f64, search_distance: Option<f64>) -> usize {
    let (a, x_a) = square(counts[0], 0.0, true);
    let (b, x_b) = square(counts[1], gap, false);
    let pair = pair_of([a, b], search_distance);
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

/// Squares and slender rectangles all over a cube, looking in all directions, with their places.
fn scattered(random: &mut Random, count: usize) -> (PairedSurface, Vec<Vec3>) {
    let mut x = Vec::new();
    for _ in 0..count {
        let (turn, middle) = (random.rotation(), random.vector3());
        let half = [0, 1].map(|_| 10f64.powf(-0.6 + 0.8 * random.vector3().x));
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        // Warped a little, as facets of a mesh are.
        x.extend(corners.map(|[p, q]| {
            let flat = Vec3::new(p * half[0], q * half[1], 0.0);
            middle + turn * flat + random.vector3() * (0.05 * half[0].min(half[1]))
        }));
    }
    let facets = (0..count).map(|facet| [0, 1, 2, 3].map(|corner| NodeId::new(4 * facet + corner)));
    (side(&facets.collect::<Vec<_>>()), x)
}

/// Holds the facets that are looked at against all there are.
#[test]
fn no_pair_is_lost_by_looking_at_candidates_alone() {
    let mut random = Random::new(41);
    let (mut near, mut tried, mut all) = (0, 0, 0);
    for scene in 0..60 {
        let (a, x_a) = scattered(&mut random, 30);
        let (b, x_b) = scattered(&mut random, 30);
        let pair = pair_of([a, b], None);
        let at = Configuration::new(&pair, [x_a, x_b], Placement::at_rest());
        let mut compliances = compliances(&at);
        if scene % 3 > 0 {
            // As far as a normal can be from the middle of two: that of one facet.
            compliances[scene % 3 - 1].fill(0.0);
        }
        let depth = 0.1 * (scene % 4) as f64;
        let scope = Scope {
            compliances: &compliances,
            depth,
            start: None,
        };
        let candidates = Candidates::new(&at, scope);
        for facet in (0..30).map(FacetId::new) {
            let own = at.side(Side::A);
            let of_facet = candidates.of(facet, reach(&at, Side::A, &own.corners(facet)));
            tried += of_facet.len();
            for opposite in (0..30).map(FacetId::new) {
                all += 1;
                let both = [(Side::A, facet), (Side::B, opposite)];
                let [one, other] = both.map(|(side, facet)| Facet {
                    corners: at.side(side).corner_positions(facet),
                    shape: Shape::Quadrilateral,
                });
                let weights = both.map(|(side, facet)| compliances[side][facet.index()]);
                let none = SegmentDerivatives::None;
                let Some(segment) = segment_facing([&one, &other], FACING, weights, none) else {
                    continue;
                };
                let corners = both.map(|(side, facet)| at.side(side).corners(facet));
                let reaches = [0, 1].map(|of| reach(&at, both[of].0, &corners[of]));
                let found = PairedFacets {
                    sides: Side::BOTH,
                    facets: both.map(|(_, facet)| Some(facet)),
                    corners,
                    x: joined(&one.corners, &other.corners),
                    reach: reaches[0].max(reaches[1]),
                    segment,
                };
                let gap = found.mean_gap(&at);
                let is_near = gap <= found.reach || found.least_gap(&at) <= found.reach;
                if -gap <= found.reach + depth && is_near {
                    near += 1;
                    assert!(of_facet.contains(&(opposite.0)), "{scene}: {both:?}");
                }
            }
        }
    }
    assert!(near > 1000 && tried < all / 2, "{near} of {tried} of {all}");
}

/// Near facets of surfaces at growing distances are never passed over.
#[test]
fn sides_with_near_facets_are_not_apart() {
    let mut random = Random::new(43);
    let (mut near, mut apart) = (0, 0);
    for scene in 0..800 {
        let (a, x_a) = scattered(&mut random, 3);
        let (b, mut x_b) = scattered(&mut random, 3);
        let shift = random.vector3() * (0.01 * f64::from(scene));
        x_b.iter_mut().for_each(|x| *x += shift);
        let search_distance = (scene % 3 == 0).then_some(0.7);
        let pair = pair_of([a, b], search_distance);
        let at = Configuration::new(&pair, [x_a, x_b], Placement::at_rest());
        let compliances = compliances(&at);
        let depth = 0.1 * f64::from(scene % 4);
        let scope = Scope {
            compliances: &compliances,
            depth,
            start: None,
        };
        let candidates = Candidates::new(&at, scope);
        let none = |_: &[Corners]| SegmentDerivatives::None;
        let facets = (0..3).map(FacetId::new);
        // Without the look at the whole sides.
        let found =
            facets.map(|facet| super::of_facet(&candidates, scope, &none, facet, |_| true).len());
        let found: usize = found.sum();
        assert!(found == 0 || !at.is_apart(depth), "{scene}");
        near += usize::from(found > 0);
        apart += usize::from(at.is_apart(depth));
    }
    assert!(near > 50 && apart > 50, "{near} near, {apart} apart");
}
