//! Curved surfaces, whose chords facets are, and the overlaps of those surfaces.
//!
//! Over a facet with the corners `x_i` and the normals `n_i` of the surface there, the surface that
//! its chords stand for lies by
//!
//! ```text
//! s = 1/2 sum_{i<j} N_i N_j (n_j - n_i) . (x_j - x_i)
//! ```
//!
//! farther out: that is the sagitta `h^2/(8R)` in the middle of a chord, and zero at its ends. The
//! surfaces of two facets then overlap by `-g + s_A + s_B`. Where facets match, what one of them
//! lacks is what the other one has too much.

use striae_mesh::Vec3;
use striae_surface::{
    facet::{Shape, facet_normal},
    node::SurfaceNode,
    normal::nodal_normals,
};

use crate::{
    interference::{AHEAD, Nearest, Stage, Standing, nearest_of},
    pairing::{PairedFacets, Scope, compliances, paired_facets},
    projection::weights_at,
    segment::{FACING, SegmentDerivatives},
    side::Side,
};

/// Angle between the normal of a facet and those at its corners from which on its edges are taken
/// for edges of the body.
pub(crate) const EDGE: f64 = 0.4;
/// Largest error over the overlap that is told.
const ALL: f64 = 1e3;

/// Gaps between the nodes of a deformable side, which lie on its curved surface, and the curved
/// surface of the other side: negative where they overlap, `None` where they do not face it.
pub(crate) fn nodal_gaps(stage: &Stage, side: Side) -> Vec<Option<f64>> {
    let own = stage.configuration.side(side);
    let nodes = SurfaceNode::all(own.x.len());
    if let Some((point, normal)) = stage.configuration.plane() {
        return nodes
            .map(|node| Some((own.x[node] - point).dot(&normal)))
            .collect();
    }
    let other = stage.configuration.side(side.opposite());
    let normals = nodal_normals(other.surface, &other.x);
    let thickness = &stage.thickness.0[side.opposite()];
    let gap = |node: SurfaceNode| {
        let nearest = nearest_of(other, &own.x[node])?;
        let Nearest {
            facet,
            point,
            normal,
            distance,
            standing,
        } = nearest;
        let gap = match standing {
            Standing::Front => distance,
            Standing::Behind => -distance,
            Standing::Beside => (own.x[node] - point).dot(&normal),
        };
        let faces = own.normals[node].dot(&normal) < FACING;
        if !faces || gap < -thickness[facet.index()] {
            return None;
        }
        let corners = other.corners(facet);
        let x = other.corner_positions(facet);
        let n = corners.map(|node| normals[node]);
        let shares = weights_at(Shape::of(&corners), &x, &point);
        Some(gap - height(&x, &n, |i, j| shares[i] * shares[j]))
    };
    nodes.map(gap).collect()
}

/// Mean of `|s_A + s_B|` over the mean overlap of the surfaces, where the sides of a pair overlap
/// by up to `deepest`; [`ALL`] at most, if only their facets do.
pub(crate) fn share(stage: &Stage, deepest: f64) -> f64 {
    let start = stage.configuration;
    let compliances = compliances(start);
    let scope = Scope {
        compliances: &compliances,
        depth: AHEAD * deepest,
        start: None,
    };
    let normals = start.sides.each_ref().map(|side| {
        let normals = side
            .as_ref()
            .map(|side| nodal_normals(side.surface, &side.x));
        normals.unwrap_or_default()
    });
    let none = |_: &[_]| SegmentDerivatives::None;
    let (mut error, mut overlap) = (0.0, 0.0);
    for paired in paired_facets(start, scope, &none, |_| true) {
        let gap = paired.segment.area * paired.mean_gap(start);
        let beyond: f64 = Side::BOTH
            .map(|side| beyond(&paired, side, &normals[side]))
            .iter()
            .sum();
        if gap.min(gap - beyond) < 0.0 {
            error += beyond.abs();
            overlap += (beyond - gap).max(0.0);
        }
    }
    if error > 0.0 {
        error / overlap.max(error / ALL)
    } else {
        0.0
    }
}

/// Integral of `s` of the facet of a side over its common segment with another one.
fn beyond(paired: &PairedFacets, side: Side, normals: &[Vec3]) -> f64 {
    if paired.facets[side].is_none() {
        return 0.0;
    }
    let corners = paired.corners[side];
    let [x, n] = [
        std::array::from_fn::<_, 4, _>(|c| paired.x[4 * side.index() + c]),
        corners.map(|node| normals[node]),
    ];
    let mass = &paired.segment.mass;
    let first = 4 * side.index();
    height(&x, &n, |i, j| mass[first + i][first + j])
}

/// `s` of a facet with the corners `x` and the normals `n` there, with the products `N_i N_j`, or
/// their integrals; zero at the edges of the body.
pub(crate) fn height(x: &[Vec3; 4], n: &[Vec3; 4], product: impl Fn(usize, usize) -> f64) -> f64 {
    let flat = facet_normal(x);
    if n.iter().any(|n| n.angle(&flat) > EDGE) {
        return 0.0;
    }
    let mut sum = 0.0;
    for i in 0..4 {
        for j in i + 1..4 {
            sum += product(i, j) * (n[j] - n[i]).dot(&(x[j] - x[i]));
        }
    }
    0.5 * sum
}
