//! Faces that are taken as touching at the start, whatever the gap between their facets is.
//!
//! Facets are chords of a curved surface, so that the gap between two of them changes along them
//! by the sagitta `h^2/(8R)`, which may be larger than the interference of a press fit. A *seating*
//! knows the gap `g_0` of the meshes at the points of facets that face each other at the start,
//! and contact sees
//!
//! ```text
//! g - g_0 - i,   g_0 = n_0 . (X_b - X_a)
//! ```
//!
//! with the interference `i`, the positions `X` at the start of the two points that face each
//! other now, and the normal `n_0` of their two facets at the start. At the start that is `-i` at
//! every point, whatever facets cover each other. It is linear in the corners, so that in an
//! increment it is a constant at each of them.
//!
//! Facets are seated if the other side faces them at the start, at a gap up to the reach of the
//! pair or at any overlap. Where two facets meet that were further apart along the surface than
//! their size, the mean gaps of both at the start count instead, as `n_0` knows nothing of the
//! surface between them. Facets beside the edge of the other side take the value of what they
//! meet; others keep their gaps, and know no interference.
//!
//! Overlaps of meshes that are to be pressed out are those of the curved surfaces. Over a facet with
//! the corners `x_i` and the normals `n_i` there its surface lies by
//! `s = 1/2 sum_{i<j} N_i N_j (n_j - n_i) . (x_j - x_i)` farther out, and the gap `G_I` at a node is
//! its distance from the facets of the other side less `s`. Between nodes the gap is
//! `G = 1/2 (sum N_I^A G_I^A + sum N_J^B G_J^B)`, on a rigid side `G = sum N_I^A G_I^A`. Contact sees
//! `g - (g_0 - G)`, so that facets touch everywhere at once. That is so only where the surfaces
//! conform: where `G` changes less over the faces that are seated than the correction `g_0 - G`.
//! Otherwise the correction would not be that of points that come to face each other later.
//!
//! `n_0` belongs to where the facets were at the start. Faces that have slid along their curvature
//! since have other normals there; what follows from that is added.

mod heights;
mod slid;

use std::sync::Arc;

use striae_mesh::{FacetId, Vec3};
use striae_surface::{facet::Shape, node::SurfaceNode};

use crate::{
    configuration::Configuration,
    initial::overlaps,
    interference::{AHEAD, Stage, Standing, inside, nearest_of},
    pairing::{PairedFacets, Scope, compliances, paired_facets},
    sagitta,
    segment::{FACING, Facet, SegmentDerivatives, facet_normal, normal_between},
    side::Side,
};

use heights::{between, heights, middle, size};
use slid::Slid;

/// Error of overlaps of facets over those of the curved surfaces from which on the surfaces count.
const CURVED: f64 = 0.01;

/// Opposition of a facet at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Met {
    /// The other side, at this mean gap.
    Facing(f64),
    /// Nothing, as it lies beside the edge of the other side.
    Beside,
    /// Nothing that is near enough.
    Apart,
}

/// The faces of a pair that are taken as touching.
#[derive(Clone, Debug, PartialEq)]
pub struct Seating {
    /// Positions of the surface nodes at the start, by side; empty for a plane.
    x: [Vec<Vec3>; 2],
    /// The plane at the start that side `b` is, if it is one.
    plane: Option<(Vec3, Vec3)>,
    compliances: [Vec<f64>; 2],
    /// Normals of the common surface at the nodes; empty against a plane.
    normals: [Vec<Vec3>; 2],
    met: [Vec<Met>; 2],
    /// Gaps at the nodes along their own normals, for collocated rows.
    gaps: [Vec<Option<f64>>; 2],
    /// The largest gap or overlap of facets that are seated.
    largest: f64,
    /// Gaps `G_I` of the nodes of deformable sides from the curved surface of the other side.
    surfaces: [Vec<Option<f64>>; 2],
    /// Contact sees the gaps of the curved surfaces; otherwise faces are taken as touching.
    sees_surfaces: bool,
    /// Share of the nodes of a side in `G`.
    share: f64,
    /// Largest distance `|g_0 - G|` that facets are corrected by.
    correction: f64,
}

/// A seating and how much the faces interfere.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Facets that touch initially.
    pub seating: Arc<Seating>,
    /// Interference `i`; negative for a clearance.
    pub interference: f64,
}

impl Seating {
    /// Faces of the configuration at the start that are taken as touching.
    pub fn new(stage: &Stage) -> Self {
        Self::with(stage, false)
    }

    /// Faces of the configuration at the start as far apart as their curved surfaces; `None` where
    /// facets overlap as those do, or the surfaces do not conform.
    pub fn of_surfaces(stage: &Stage) -> Option<Self> {
        let start = stage.configuration;
        let depths = inside(stage, 0.0).into_iter().map(|found| found.depth);
        let deepest = depths.fold(0.0, f64::max);
        if deepest == 0.0 || sagitta::share(stage, deepest) <= CURVED {
            return None;
        }
        let seating = Self::with(stage, true);
        (seating.spread(start) < seating.correction).then_some(seating)
    }

    /// Difference of the largest and the smallest gap of the curved surfaces at nodes of seated
    /// facets.
    fn spread(&self, start: &Configuration) -> f64 {
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for side in Side::BOTH {
            let gaps = &self.surfaces[side];
            if gaps.is_empty() {
                continue;
            }
            let facets = start.side(side).surface.facets();
            for (corners, met) in facets.iter().zip(&self.met[side]) {
                if matches!(met, Met::Facing(_)) {
                    for gap in corners.iter().filter_map(|&node| gaps[node.index()]) {
                        (least, most) = (least.min(gap), most.max(gap));
                    }
                }
            }
        }
        most - least
    }

    fn with(stage: &Stage, sees_surfaces: bool) -> Self {
        let start = stage.configuration;
        let surfaces = Side::BOTH.map(|side| match start.pair.is_deformable(side) {
            true => sagitta::nodal_gaps(stage, side),
            false => Vec::new(),
        });
        let compliances = compliances(start);
        let deepest = overlaps(stage)
            .iter()
            .flatten()
            .copied()
            .fold(0.0, f64::max);
        let scope = Scope {
            compliances: &compliances,
            depth: AHEAD * deepest,
            start: None,
        };
        let none = |_: &[_]| SegmentDerivatives::None;
        let paired = paired_facets(start, scope, &none, |_| true);
        let mut sums = start.sides.each_ref().map(|side| {
            let count = side.as_ref().map_or(0, |side| side.surface.facets().len());
            vec![[0.0; 2]; count]
        });
        let share = start.pair.share();
        let (mut largest, mut correction) = (0.0_f64, 0.0_f64);
        for paired in &paired {
            let mut gap = paired.mean_gap(start);
            if gap > paired.reach {
                continue;
            }
            largest = largest.max(gap.abs());
            if sees_surfaces {
                let Some(between) = between(&surfaces, share, paired) else {
                    continue;
                };
                let area = paired.segment.area;
                let mean = |c: usize| paired.area_of(c) / area * between[c];
                gap -= (0..8).map(mean).sum::<f64>();
                let heights = paired.heights(start);
                for n in paired.segment.at_vertices().into_iter().flatten() {
                    let at = |c: usize| n[c] * (heights[c] - between[c]);
                    correction = correction.max((0..8).map(at).sum::<f64>().abs());
                }
            }
            for (sums, facet) in sums.iter_mut().zip(paired.facets) {
                if let Some(facet) = facet {
                    let [area, sum] = &mut sums[facet.index()];
                    *area += paired.segment.area;
                    *sum += paired.segment.area * gap;
                }
            }
        }
        let met = Side::BOTH.map(|side| {
            let facets = sums[side].iter().enumerate();
            let met = facets.map(|(facet, [area, sum])| match *area > 0.0 {
                true => Met::Facing(sum / area),
                false => unmet(start, side, FacetId::new(facet)),
            });
            met.collect()
        });
        let gaps = Side::BOTH.map(|side| match start.pair.is_deformable(side) {
            true => nodal_gaps(start, side, AHEAD * deepest),
            false => Vec::new(),
        });
        Self {
            x: start.sides.each_ref().map(|side| {
                let x = side.as_ref().map(|side| side.x.clone());
                x.unwrap_or_default()
            }),
            plane: start.plane(),
            compliances,
            normals: slid::normals(start),
            met,
            gaps,
            largest,
            surfaces,
            sees_surfaces,
            share,
            correction,
        }
    }

    /// Overlaps of the curved surfaces at the nodes, by side.
    pub fn overlaps(&self) -> [Vec<f64>; 2] {
        if !self.sees_surfaces {
            return Default::default();
        }
        self.surfaces.each_ref().map(|side| {
            let overlap = |gap: &Option<f64>| (-gap.unwrap_or(0.0)).max(0.0);
            side.iter().map(overlap).collect()
        })
    }

    /// Largest distance by which facets that touch overlap or are apart, as chords of curved
    /// surfaces; zero if faces are taken as touching.
    pub fn correction(&self) -> f64 {
        self.correction
    }

    /// Returns whether no facets are seated.
    pub fn is_empty(&self) -> bool {
        let mut all = self.met.iter().flatten();
        !all.any(|met| matches!(met, Met::Facing(_)))
    }

    /// The largest gap or overlap of the meshes where facets are seated.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// `g_0`, or `g_0 - G`, of two facets in shares of their corners that sum up to the one at a
    /// point; `None` where they are not seated.
    fn gap_of(&self, paired: &PairedFacets) -> Option<[f64; 8]> {
        let met = |side: Side| {
            let facet = paired.facets[side]?;
            Some(self.met[side][facet.index()])
        };
        let mean = match (met(Side::A)?, met(Side::B)) {
            (Met::Facing(gap), None | Some(Met::Beside))
            | (Met::Beside, Some(Met::Facing(gap))) => gap,
            (Met::Facing(a), Some(Met::Facing(b))) => 0.5 * (a + b),
            _ => return None,
        };
        let a = self.facet(paired, Side::A);
        let between = between(&self.surfaces, self.share, paired);
        let heights = match self.plane {
            Some((point, normal)) => Some(heights(&a, None, &-normal, &point)),
            None => {
                let b = self.facet(paired, Side::B);
                let slid = Slid::new(self, paired);
                match self.normal(paired, [&a, &b]) {
                    Some(n) => {
                        let near = heights(&a, Some(&b), &n, &a.corners[0]);
                        Some(slid.map_or(near, |slid| slid.near(near, &n)))
                    }
                    None => slid.zip(between).map(|(slid, gap)| slid.far(&gap)),
                }
            }
        };
        let Some(mut heights) = heights else {
            return Some(std::array::from_fn(|d| if d < 4 { mean } else { 0.0 }));
        };
        if self.sees_surfaces {
            for (height, gap) in heights.iter_mut().zip(between?) {
                *height -= gap;
            }
        }
        Some(heights)
    }

    /// A facet at the start.
    fn facet(&self, paired: &PairedFacets, side: Side) -> Facet {
        Facet {
            corners: paired.corners[side].map(|node| self.x[side][node]),
            shape: Shape::of(&paired.corners[side]),
        }
    }

    /// `n_0` of two facets; `None` where they did not face each other or were far apart.
    fn normal(&self, paired: &PairedFacets, [a, b]: [&Facet; 2]) -> Option<Vec3> {
        if facet_normal(a)?.dot(&facet_normal(b)?) > FACING {
            return None;
        }
        let weights = Side::BOTH.map(|side| {
            let facet = paired.facets[side];
            facet.map_or(0.0, |facet| self.compliances[side][facet.index()])
        });
        let n = normal_between(a, b, weights)?;
        let way = middle(b) - middle(a);
        let along = (way - n * n.dot(&way)).norm();
        (along <= size(a) + size(b)).then_some(n)
    }
}

impl Fitted {
    /// Offset of the gap, split among the corners of two facets such that the shares sum to the
    /// offset at a point.
    pub(crate) fn at_corners(&self, paired: &PairedFacets) -> [f64; 8] {
        let Some(gap) = self.seating.gap_of(paired) else {
            return [0.0; 8];
        };
        std::array::from_fn(|d| match d {
            0..4 => -gap[d] - self.interference,
            _ => -gap[d],
        })
    }

    /// Offset of the gap at a node along its own normal.
    pub(crate) fn at_node(&self, side: Side, node: SurfaceNode) -> f64 {
        let at_node =
            |gaps: &[Vec<Option<f64>>; 2]| gaps[side].get(node.index()).copied().flatten();
        let between = match self.seating.sees_surfaces {
            true => at_node(&self.seating.surfaces),
            false => Some(0.0),
        };
        match (at_node(&self.seating.gaps), between) {
            (Some(gap), Some(between)) => between - gap - self.interference,
            _ => 0.0,
        }
    }
}

/// Classification of a facet that faces nothing near it.
fn unmet(start: &Configuration, side: Side, facet: FacetId) -> Met {
    if start.plane().is_some() {
        return Met::Apart;
    }
    let snapshot = start.side(side);
    let corners = snapshot.corners(facet);
    let centre = middle(&Facet {
        corners: snapshot.corner_positions(facet),
        shape: Shape::of(&corners),
    });
    let nearest = nearest_of(start.side(side.opposite()), &centre);
    match nearest.map(|nearest| nearest.standing) {
        Some(Standing::Beside) => Met::Beside,
        _ => Met::Apart,
    }
}

/// Gaps at nodes that are at most their reach open.
fn nodal_gaps(start: &Configuration, side: Side, depth: f64) -> Vec<Option<f64>> {
    let snapshot = start.side(side);
    let nodes = SurfaceNode::all(snapshot.x.len());
    nodes
        .map(|node| {
            let reach = start.reach(side, node);
            let (contact, _) = start.opposite(side, node)?;
            (contact.gap <= reach && contact.gap >= -reach - depth).then_some(contact.gap)
        })
        .collect()
}
