//! Facets of the two sides that face each other, with the integrals over their segments.
//!
//! Two facets are paired where they face each other, have a common segment (see
//! [`crate::segment`]) and are near: the least gap on the segment is at most the larger
//! reach of their corners, and they overlap in the mean by no more than that and the `depth`
//! that the bodies move towards each other.

mod candidates;
mod cover;
mod past_edges;
mod self_contact;
#[cfg(test)]
mod tests;

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{facet::Shape, node::SurfaceNode};

use candidates::Candidates;
use cover::Cover;
pub use cover::Folded;
use past_edges::face_past_edges;
use self_contact::{Neighbourhood, is_outside};

use crate::{
    configuration::Configuration,
    segment::{FIRST, Facet, Segment, SegmentDerivatives, mixed, plane_segment, segment_facing},
    side::Side,
};

/// Two facets and their segment.
#[derive(Clone, Debug)]
pub struct PairedFacets {
    /// Sides of the two facets: `a` and `b` or, in self-contact, twice `a`.
    pub sides: [Side; 2],
    /// The two facets; a plane has none.
    pub facets: [Option<FacetId>; 2],
    /// Corners of the first facet, then of the second one, as surface-local nodes.
    pub corners: [[SurfaceNode; 4]; 2],
    /// Their current positions.
    pub x: [Vec3; 8],
    /// Least gap up to which they are paired.
    pub reach: f64,
    /// Integrals over the segment.
    pub segment: Segment,
}

/// Facets that are paired.
#[derive(Clone, Copy, Debug)]
pub struct Scope<'a> {
    /// Compliance `h/E` of the facets by side, which weighs their normals; zero if rigid.
    pub compliances: &'a [Vec<f64>; 2],
    /// Overlap beyond the reach up to which facets are paired.
    pub depth: f64,
    /// Positions of the surface nodes by side at the start of the increment, if there is one.
    pub start: Option<&'a [Vec<Vec3>; 2]>,
}

impl Scope<'_> {
    /// Weights of the normals of two paired facets.
    pub fn weights(&self, paired: &PairedFacets) -> [f64; 2] {
        std::array::from_fn(|at| match paired.facets[at] {
            Some(facet) => self.compliances[paired.sides[at]][facet.index()],
            None => 0.0,
        })
    }
}

impl PairedFacets {
    /// `sum_d s_d D_cd (x_d - o)` for the points `x` at the corners, with `s = -1` on the first
    /// facet and `1` on the second one.
    pub fn difference(&self, corner: usize, x: &[Vec3; 8], origin: &Vec3) -> Vec3 {
        let row = &self.segment.mass[corner];
        (0..8).map(|d| (x[d] - origin) * (SIGNS[d] * row[d])).sum()
    }

    /// Area that belongs to a corner, `integral N_c da`.
    pub fn area_of(&self, corner: usize) -> f64 {
        let row = &self.segment.mass[corner];
        let own = if row[..4].iter().any(|m| *m != 0.0) {
            &row[..4]
        } else {
            &row[4..]
        };
        own.iter().sum()
    }

    /// A point from which positions are measured: on the plane, or near the facets.
    pub fn origin(&self, configuration: &Configuration) -> Vec3 {
        match configuration.plane() {
            Some((point, _)) => point,
            None => self.x[0],
        }
    }

    /// Heights of the corners along the normal, with the sign of their side in the gap.
    pub fn heights(&self, configuration: &Configuration) -> [f64; 8] {
        let origin = self.origin(configuration);
        let n = &self.segment.normal;
        std::array::from_fn(|d| SIGNS[d] * n.dot(&(self.x[d] - origin)))
    }

    /// Least gap at the vertices of the segment.
    pub fn least_gap(&self, configuration: &Configuration) -> f64 {
        let heights = self.heights(configuration);
        let Some(vertices) = self.segment.at_vertices() else {
            return heights[..4].iter().copied().fold(f64::INFINITY, f64::min);
        };
        let gap = |n: &[f64; 8]| -> f64 { n.iter().zip(&heights).map(|(n, h)| n * h).sum() };
        vertices.iter().map(gap).fold(f64::INFINITY, f64::min)
    }

    /// Mean gap over the segment.
    pub fn mean_gap(&self, configuration: &Configuration) -> f64 {
        let origin = self.origin(configuration);
        let sum: Vec3 = (0..4).map(|c| self.difference(c, &self.x, &origin)).sum();
        self.segment.normal.dot(&sum) / self.segment.area
    }

    /// Side and surface-local node of a corner of a deformable side; `None` for the corners
    /// of a rigid side and the repeated corner of a triangle.
    pub fn node(
        &self,
        configuration: &Configuration,
        corner: usize,
    ) -> Option<(Side, SurfaceNode)> {
        let (side, at) = (self.sides[corner / 4], corner % 4);
        let corners = &self.corners[corner / 4];
        let repeated = at == 3 && Shape::of(corners) == Shape::Triangle;
        let rigid = side == Side::B && configuration.pair.is_rigid();
        (!rigid && !repeated).then(|| (side, corners[at]))
    }
}

/// `h/E` of the facets of deformable sides.
pub(crate) fn compliances(configuration: &Configuration) -> [Vec<f64>; 2] {
    Side::BOTH.map(|side| {
        let of_side = &configuration.pair.sides[side];
        let Some(surface) = of_side.surface() else {
            return Vec::new();
        };
        let rigid = side == Side::B && configuration.pair.is_rigid();
        let facets = surface.facets().iter();
        facets
            .map(|corners| {
                // A rigid side does not tilt, so the normal of a pair is its normal alone.
                if rigid {
                    return 0.0;
                }
                let sizes = corners.map(|node| configuration.side(side).sizes[node]);
                0.25 * sizes.iter().sum::<f64>() / of_side.stiffness
            })
            .collect()
    })
}

/// Facets that are paired and the topologies of their segments, as one number.
pub fn topology<'a>(paired: impl Iterator<Item = &'a PairedFacets>) -> u64 {
    let number = |facet: Option<FacetId>| facet.map_or(u64::MAX, |facet| facet.index() as u64);
    paired.fold(FIRST, |hash, paired| {
        let facets = paired.facets.map(number).into_iter();
        facets.chain([paired.segment.topology]).fold(hash, mixed)
    })
}

/// Sign of the corners in the gap: second facet minus first one.
pub const SIGNS: [f64; 8] = [-1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0];

/// 1 on side `a`, -1 on side `b`: how normal and friction of a node are seen from side `a`.
pub fn side_sign(side: Side) -> f64 {
    if side == Side::A { 1.0 } else { -1.0 }
}

/// Sign of normal and friction of what belongs to a corner, seen from the first facet.
pub fn corner_sign(corner: usize) -> f64 {
    -SIGNS[corner]
}

/// All paired facets whose facet of side `a` is `wanted`, in self-contact one of both, in the
/// order of their facets; `slopes` says by the corners of both whether derivatives are.
pub fn paired_facets(
    configuration: &Configuration,
    scope: Scope,
    slopes: &(impl Fn(&[Corners]) -> SegmentDerivatives + Sync),
    wanted: impl Fn(FacetId) -> bool + Sync,
) -> Vec<PairedFacets> {
    let all = paired_up_to(f64::INFINITY, configuration, scope, slopes, wanted);
    all.expect("areas have no limit")
}

/// Paired facets of a trial state as of [`paired_facets`]; `start` is the last converged one.
///
/// # Errors
/// When the surfaces are folded over each other, before there is memory for all of their segments.
pub fn paired_unless_folded(
    configuration: &Configuration,
    start: &Configuration,
    scope: Scope,
    slopes: &(impl Fn(&[Corners]) -> SegmentDerivatives + Sync),
    wanted: impl Fn(FacetId) -> bool + Sync,
) -> Result<Vec<PairedFacets>, Folded> {
    let most = cover::most(configuration);
    if let Some(all) = paired_up_to(most, configuration, scope, slopes, &wanted) {
        return Ok(all);
    }
    let none = |_: &[Corners]| SegmentDerivatives::None;
    let before = of_facets(start, scope, &none, &wanted, |paired| cover::area(&paired));
    let after = cover::most_after(before.iter().sum());
    if after <= most {
        return Err(Folded);
    }
    paired_up_to(after, configuration, scope, slopes, wanted).ok_or(Folded)
}

/// All paired facets; `None` where the areas of their segments sum up to more than `most`.
fn paired_up_to(
    most: f64,
    configuration: &Configuration,
    scope: Scope,
    slopes: &(impl Fn(&[Corners]) -> SegmentDerivatives + Sync),
    wanted: impl Fn(FacetId) -> bool + Sync,
) -> Option<Vec<PairedFacets>> {
    let cover = Cover::up_to(most);
    // Once there are too many, none is needed, and no more are looked for.
    let wanted = |facet: FacetId| wanted(facet) && !cover.is_exceeded();
    let kept = |paired: Vec<PairedFacets>| {
        cover.add(&paired);
        if cover.is_exceeded() {
            Vec::new()
        } else {
            paired
        }
    };
    let found = of_facets(configuration, scope, slopes, wanted, kept);
    if cover.is_exceeded() {
        return None;
    }
    // A list that grows as it is filled would be touched twice.
    let mut all = Vec::with_capacity(found.iter().map(Vec::len).sum());
    all.extend(found.into_iter().flatten());
    if configuration.pair.is_in_one_body() {
        self_contact::drop_hidden(configuration, &mut all);
    }
    Some(all)
}

/// A value of the pairs of each facet of side `a`.
fn of_facets<T: Send>(
    configuration: &Configuration,
    scope: Scope,
    slopes: &(impl Fn(&[Corners]) -> SegmentDerivatives + Sync),
    wanted: impl Fn(FacetId) -> bool + Sync,
    value: impl Fn(Vec<PairedFacets>) -> T + Sync,
) -> Vec<T> {
    if configuration.is_apart(scope.depth) {
        return Vec::new();
    }
    let own = configuration.side(Side::A);
    let itself = configuration.pair.is_self_contact();
    let candidates = Candidates::new(configuration, scope);
    (0..own.surface.facets().len())
        .into_par_iter()
        // Results are collected by facet, so the division of work among threads changes no bit.
        .with_min_len(4)
        .map(|facet| {
            let facet = FacetId::new(facet);
            value(if itself {
                let is_wanted = |other: FacetId| wanted(facet) || wanted(other);
                of_facet(&candidates, scope, slopes, facet, is_wanted)
            } else if wanted(facet) {
                of_facet(&candidates, scope, slopes, facet, |_| true)
            } else {
                Vec::new()
            })
        })
        .collect()
}

/// A side and the corners of a facet of it.
pub type Corners = (Side, [SurfaceNode; 4]);

fn of_facet(
    candidates: &Candidates,
    scope: Scope,
    slopes: &impl Fn(&[Corners]) -> SegmentDerivatives,
    facet: FacetId,
    is_wanted: impl Fn(FacetId) -> bool,
) -> Vec<PairedFacets> {
    let configuration = candidates.configuration();
    let own = configuration.side(Side::A);
    let corners = own.corners(facet);
    let positions = own.corner_positions(facet);
    let a = Facet {
        corners: positions,
        shape: Shape::of(&corners),
    };
    let reach = reach(configuration, Side::A, &corners);
    let is_near = |paired: &PairedFacets| {
        let gap = paired.mean_gap(configuration);
        let near = || paired.least_gap(configuration) <= paired.reach;
        // Segments deeper than the reach face each other through a body, unless the sides approach
        // that far in this increment.
        -gap <= paired.reach + scope.depth && (gap <= paired.reach || near())
    };
    if let Some((point, normal)) = configuration.plane() {
        let nothing = [point; 4];
        let slopes = slopes(&[(Side::A, corners)]);
        let paired = plane_segment(&a, &normal, slopes).map(|segment| PairedFacets {
            sides: Side::BOTH,
            facets: [Some(facet), None],
            corners: [corners, [SurfaceNode(0); 4]],
            x: joined(&positions, &nothing),
            reach,
            segment,
        });
        return paired.into_iter().filter(is_near).collect();
    }
    let sides = configuration.pair.facing_sides();
    let other = configuration.side(sides[1]);
    let itself = configuration.pair.is_self_contact();
    let one_body = configuration.pair.is_in_one_body();
    let mut found = Vec::new();
    for item in candidates.of(facet, reach) {
        let opposite = FacetId(item);
        // Each pair of facets of one surface would be found twice.
        if itself && (opposite <= facet || !is_wanted(opposite)) {
            continue;
        }
        let corners_b = other.corners(opposite);
        let positions_b = other.corner_positions(opposite);
        let b = Facet {
            corners: positions_b,
            shape: Shape::of(&corners_b),
        };
        let neighbourhood = match one_body {
            true => self_contact::neighbourhood([own, other], [&corners, &corners_b]),
            false => Neighbourhood::Apart,
        };
        let limit = neighbourhood.facing_limit();
        let weights = [
            scope.compliances[sides[0]][facet.index()],
            scope.compliances[sides[1]][opposite.index()],
        ];
        let slopes = slopes(&[(sides[0], corners), (sides[1], corners_b)]);
        let Some(segment) = segment_facing([&a, &b], limit, weights, slopes) else {
            continue;
        };
        let reach = match configuration.pair.is_rigid() {
            true => reach,
            // The larger reach of both, so that the pairing does not depend on which side is `a`.
            false => reach.max(self::reach(configuration, sides[1], &corners_b)),
        };
        let paired = PairedFacets {
            sides,
            facets: [Some(facet), Some(opposite)],
            corners: [corners, corners_b],
            x: joined(&positions, &positions_b),
            reach,
            segment,
        };
        let is_past_edges = || {
            let start = scope.start.filter(|_| configuration.pair.has_faces);
            start.is_some_and(|start| face_past_edges(configuration, &paired, start))
        };
        if is_near(&paired)
            && (!configuration.pair.is_by_faces() || is_outside(configuration, &paired))
            && !is_past_edges()
        {
            found.push(paired);
        }
    }
    found
}

fn joined(a: &[Vec3; 4], b: &[Vec3; 4]) -> [Vec3; 8] {
    std::array::from_fn(|at| if at < 4 { a[at] } else { b[at - 4] })
}

/// Largest reach of the corners of a facet.
fn reach(configuration: &Configuration, side: Side, corners: &[SurfaceNode; 4]) -> f64 {
    let reaches = corners.map(|node| configuration.reach(side, node));
    reaches.into_iter().fold(0.0, f64::max)
}
