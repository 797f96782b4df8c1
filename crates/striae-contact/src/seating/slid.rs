//! Faces that were seated and have slid along their curvature since.
//!
//! With the normals `m` of the common surface at the start, interpolated from the nodes of each side
//! and outward of side `a`, let `A` and `B` be the points of two facets at the centroid of their
//! segment, and `m_A`, `m_B` the normals there. Seen from the tangent planes of the common surface at
//! `A` and `B`, which lie on each other now, the gap of the facets at the start is
//!
//! ```text
//! g_0 = -m_A . (X_a - A) + m_B . (X_b - B) + c
//! ```
//!
//! *Near* facets, which had slid past each other by less than their sizes, have `c` such that the
//! common surface slides on itself: the normals at the ends of a chord of a circle are at the same
//! angle to it. With `D = m_B - m_A`, `m = (m_A + m_B)/2` along `n_0` and the part `d` of `B - A` along
//! the facets,
//!
//! ```text
//! g_0 = |m| n_0 . (X_b - B - X_a + A) + 1/2 D . (X_a - A + X_b - B) + n_0 . (B - A)/|m| + m . d/|m|^2
//! ```
//!
//! which is `n_0 . (X_b - X_a)` before anything slides. *Far* ones have
//! `c = s_A + s_B + G`, with the heights `s` of the curved surfaces ([`crate::sagitta`]) at `A` and
//! `B` and their gap `G` at the start.
//!
//! Surfaces that conform are parabolas of one curvature, the difference of which is linear however
//! far one of them has slid: `g_0` does not depend on which points are taken. About the centroid the
//! derivative by their places, which is left out, has no mean over the segment.

use striae_mesh::Vec3;
use striae_surface::{
    facet::{Shape, facet_normal},
    node::SurfaceNode,
    normal::nodal_normals,
    scalar::combination,
};

use super::Seating;
use crate::{
    configuration::Configuration,
    interference::{Standing, nearest_of},
    pairing::{PairedFacets, SIGNS},
    projection::weights_at,
    sagitta::{EDGE, height},
    segment::FACING,
    side::Side,
};

/// Normals of the common surface of two sides at their nodes, outward of side `a`: the mean of both
/// sides, or the own one where the other side does not face a node. None against a plane.
pub(super) fn normals(start: &Configuration) -> [Vec<Vec3>; 2] {
    let [Some(a), Some(b)] = start.sides.each_ref().map(Option::as_ref) else {
        return Default::default();
    };
    let own = [a, b].map(|side| nodal_normals(side.surface, &side.x));
    Side::BOTH.map(|side| {
        let other = side.opposite();
        let [this, target] = [side, other].map(|side| start.side(side));
        let facing = |node: SurfaceNode| {
            let nearest = nearest_of(target, &this.x[node])?;
            let is_opposite = own[side][node.index()].dot(&nearest.normal) < FACING;
            if nearest.standing == Standing::Beside || !is_opposite {
                return None;
            }
            let corners = target.corners(nearest.facet);
            let x = target.corner_positions(nearest.facet);
            let shares = weights_at(Shape::of(&corners), &x, &nearest.point);
            let normals = corners.map(|node| own[other][node.index()]);
            Some(combination(&shares, &normals))
        };
        let mean = |node: SurfaceNode| {
            let opposite = facing(node).unwrap_or_else(Vec3::zeros);
            outward(side) * (own[side][node.index()] - opposite).normalize()
        };
        SurfaceNode::all(this.x.len()).map(mean).collect()
    })
}

/// Sign of the outward normal of a side along that of side `a`.
fn outward(side: Side) -> f64 {
    -SIGNS[4 * side.index()]
}

/// Two facets that have slid, at the points `A` and `B`.
pub(super) struct Slid {
    spots: [Spot; 2],
    /// Corners at the start.
    x: [[Vec3; 4]; 2],
}

/// A point of a facet at the start.
struct Spot {
    point: Vec3,
    /// Normal of the common surface.
    normal: Vec3,
    /// Height of the curved surface over the facet.
    height: f64,
}

impl Slid {
    /// Two facets at their segment; `None` where they have no curved surface there.
    pub(super) fn new(seating: &Seating, paired: &PairedFacets) -> Option<Self> {
        let corners = |of: &[Vec<Vec3>; 2], side: Side| {
            paired.corners[side].map(|node| of[side][node.index()])
        };
        let x = Side::BOTH.map(|side| corners(&seating.x, side));
        let spot = |side: Side| {
            let share = |c: usize| paired.area_of(4 * side.index() + c) / paired.segment.area;
            let normals = corners(&seating.normals, side);
            Spot::new(side, [&x[side], &normals], &[0, 1, 2, 3].map(share))
        };
        Some(Self {
            spots: [spot(Side::A)?, spot(Side::B)?],
            x,
        })
    }

    /// `g_0` in shares of the corners, with those of `n_0 . (X_b - X_a)`.
    pub(super) fn near(&self, mut shares: [f64; 8], n: &Vec3) -> [f64; 8] {
        let [a, b] = &self.spots;
        let half = 0.5 * (b.normal - a.normal);
        let mean = 0.5 * (a.normal + b.normal);
        let way = b.point - a.point;
        let along = way - n * n.dot(&way);
        let (gap, cosine) = (n.dot(&way), mean.norm());
        let constant = gap * (1.0 / cosine - cosine) + mean.dot(&along) / mean.norm_squared();
        for (d, share) in shares.iter_mut().enumerate() {
            let from = self.x[d / 4][d % 4] - self.spots[d / 4].point;
            *share = cosine * *share + half.dot(&from) + if d < 4 { constant } else { 0.0 };
        }
        shares
    }

    /// `g_0` in shares of the corners, with those of `G`.
    pub(super) fn far(&self, gap: &[f64; 8]) -> [f64; 8] {
        let constant = self.spots.iter().map(|spot| spot.height).sum::<f64>();
        std::array::from_fn(|d| {
            let spot = &self.spots[d / 4];
            let height = SIGNS[d] * spot.normal.dot(&(self.x[d / 4][d % 4] - spot.point));
            height + gap[d] + if d < 4 { constant } else { 0.0 }
        })
    }
}

impl Spot {
    /// The point of a facet of a side with these shares of its corners, from their positions and
    /// normals; edges of the body do not count as curved.
    fn new(side: Side, [x, normals]: [&[Vec3; 4]; 2], shares: &[f64; 4]) -> Option<Self> {
        let flat = facet_normal(x);
        let own = normals.map(|normal| outward(side) * normal);
        let normal = match own.iter().any(|normal| normal.angle(&flat) > EDGE) {
            true => flat,
            false => combination(shares, &own).normalize(),
        };
        let spot = Self {
            point: combination(shares, x),
            normal: outward(side) * normal,
            height: height(x, &own, |i, j| shares[i] * shares[j]),
        };
        let sum = spot.point.sum() + spot.normal.sum() + spot.height;
        sum.is_finite().then_some(spot)
    }
}
