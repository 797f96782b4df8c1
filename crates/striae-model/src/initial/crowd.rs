//! Pairs with so many facets opposite to one that no run has the memory for their contact.

use striae_contact::{initial::Fit, opposite::Opposite};
use striae_mesh::Vec3;

use crate::model::{ContactSurface, Model, PairId};

/// Memory for the contact of one facet that is too much.
const LIMIT: f64 = 1e10;

/// Facets of a pair opposite to one another; `None` for surfaces that choose no unknowns
/// against each other, as those of rigid bodies.
pub fn opposite(model: &Model, pair: PairId, fit: &Fit) -> Option<Opposite> {
    let pair = &model.pairs[pair.0];
    let (a, b) = (corners(model, &pair.a)?, corners(model, &pair.b)?);
    let gap = fit.gap.map_or(0.0, |opening| opening.gap.max(0.0));
    Opposite::of([&a, &b], gap, LIMIT)
}

/// The facet that has too many others opposite to it.
pub(super) fn crowd(model: &Model, pair: PairId, fit: &Fit) -> Option<Opposite> {
    opposite(model, pair, fit).filter(|found| found.bytes > LIMIT)
}

fn corners(model: &Model, side: &ContactSurface) -> Option<Vec<[Vec3; 4]>> {
    let ContactSurface::Deformable { body, faces } = side else {
        return None;
    };
    let mesh = &model.bodies[body.0].mesh;
    let corners = faces.iter().map(|face| mesh.face_positions(*face));
    Some(corners.collect())
}
