//! Checks of shapes, before anything is computed from them.

use std::collections::BTreeMap;

use striae_mesh::{NodeId, Vec3};
use striae_surface::{
    facet::Shape,
    node::SurfaceNode,
    topology::{Surface, distinct_corners},
};

use super::fault::{FaultKind, Faults};

/// Area over the square of the longest edge, and length of the sum of normals over the sum of their
/// lengths, that is round-off.
const FLAT: f64 = 1e-12;

/// First row that is not finite.
pub(super) fn finite(rows: &[Vec3], place: &str) -> Result<(), Faults> {
    let bad = rows.iter().position(|x| !x.iter().all(|x| x.is_finite()));
    bad.map_or(Ok(()), |row| {
        Err(Faults::one(place, FaultKind::NotFinite { row }))
    })
}

/// Vectors of as many nodes as there are, all of them finite.
pub(super) fn vectors(rows: &[Vec3], needed: usize, place: &str) -> Result<(), Faults> {
    count(rows.len(), needed, place)?;
    finite(rows, place)
}

/// A list of the right length.
pub(super) fn count(found: usize, needed: usize, place: &str) -> Result<(), Faults> {
    match found == needed {
        true => Ok(()),
        false => Err(Faults::one(place, FaultKind::Count { found, needed })),
    }
}

/// Corners that are nodes, and that differ, of facets that differ.
pub(super) fn corners(facets: &[[NodeId; 4]], nodes: usize) -> Result<(), FaultKind> {
    if facets.is_empty() {
        return Err(FaultKind::NoFacet);
    }
    let mut known = BTreeMap::new();
    for (facet, corners) in facets.iter().enumerate() {
        if let Some(&node) = corners.iter().find(|node| node.index() >= nodes) {
            return Err(FaultKind::Node { facet, node, nodes });
        }
        let [a, b, c, d] = corners;
        let triangle = c == d;
        let repeats = a == b || b == c || a == c || !triangle && (d == a || d == b);
        if repeats {
            return Err(FaultKind::Degenerate { facet });
        }
        // In the order around it, from its least corner on.
        let mut around = corners[..if triangle { 3 } else { 4 }].to_vec();
        let least = (0..around.len()).min_by_key(|&at| around[at]).unwrap_or(0);
        around.rotate_left(least);
        if let Some(first) = known.insert(around, facet) {
            return Err(FaultKind::Repeated { facet, first });
        }
    }
    Ok(())
}

/// Facets with an area, around nodes at which they look the same way.
pub(super) fn areas(surface: &Surface, x: &[Vec3]) -> Result<(), FaultKind> {
    let mut sums = vec![(Vec3::zeros(), 0.0); x.len()];
    for (facet, corners) in surface.facets().iter().enumerate() {
        let places = corners.map(|node| x[node]);
        let [a, b, c, d] = places;
        let normal = match Shape::of(corners) {
            Shape::Triangle => (b - a).cross(&(c - a)),
            Shape::Quadrilateral => (c - a).cross(&(d - b)),
        };
        let longest = places.iter().map(|x| (x - a).norm_squared());
        let longest = longest.fold((d - b).norm_squared(), f64::max);
        let has_area = normal.norm() > FLAT * longest;
        if !has_area {
            return Err(FaultKind::Degenerate { facet });
        }
        let ring = distinct_corners(corners);
        for (at, &node) in ring.iter().enumerate() {
            let next = x[ring[(at + 1) % ring.len()]] - x[node];
            let previous = x[ring[(at + ring.len() - 1) % ring.len()]] - x[node];
            let own = next.cross(&previous);
            sums[node.index()].0 += own;
            sums[node.index()].1 += own.norm();
        }
    }
    let agrees = |(sum, size): &(Vec3, f64)| sum.norm() > FLAT * size;
    let folded = sums.iter().position(|sums| !agrees(sums));
    folded.map_or(Ok(()), |node| {
        let node = surface.nodes()[SurfaceNode::new(node).index()];
        Err(FaultKind::Folded { node })
    })
}

/// Quadrilaterals that are convex.
pub(super) fn convex(surface: &Surface, x: &[Vec3]) -> Result<(), FaultKind> {
    for (facet, corners) in surface.facets().iter().enumerate() {
        let [a, b, c, d] = corners.map(|node| x[node]);
        if Shape::of(corners) == Shape::Triangle {
            continue;
        }
        let normal = (c - a).cross(&(d - b));
        let places = [a, b, c, d];
        let turns = |at: usize| {
            let [before, here, next] = [3, 0, 1].map(|step| places[(at + step) % 4]);
            (next - here).cross(&(before - here)).dot(&normal) > 0.0
        };
        if !(0..4).all(turns) {
            return Err(FaultKind::Degenerate { facet });
        }
    }
    Ok(())
}
