//! Gaps and overlaps of pairs, pairs that never meet, surfaces that look away.

use striae_contact::{initial::Fit, interference::Spot, side::Side};
use striae_mesh::{Vec3, place, significant};
use striae_model::{
    ContactSurface, Model, Pair, PairId, RigidShape,
    initial::{ROUND_OFF, other_name, surface_node, turned},
};
use striae_solve::warning::warnings_at_start;

use super::{Advice, Topic};

/// Cosine between the normals of surfaces that face each other.
const FACING: f64 = -0.2;
/// Length of the sum of area vectors over the area from which on a surface is almost plane.
const PLANE: f64 = 0.95;

/// Notes how every pair fits.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    let mut far = Vec::new();
    for (index, (pair, fit)) in model.pairs.iter().zip(fits).enumerate() {
        let Some(fit) = fit.as_ref().filter(|_| !pair.is_on_itself()) else {
            continue;
        };
        if !pair.is_expected_to_touch() && is_far(model, pair, fit) {
            far.push(index);
        } else {
            let text = format!("pair `{}`: {}", pair.name, words(model, PairId(index), fit));
            advice.note(Topic::Fit, &pair.name, text);
        }
        if looks_away(model, pair) || turned(model, PairId(index)).is_some() {
            let [a, b] = [Side::B, Side::A].map(|side| other_name(model, PairId(index), side));
            let text = format!(
                "pair `{}`: the surface of `{a}` faces away from that of `{b}`, so they cannot touch; name the facets that face each other, or reverse the normal of a rigid side",
                pair.name
            );
            advice.warn(Topic::Facing, &pair.name, text);
        }
    }
    if let Some(&first) = far.first() {
        let (count, pairs) = (far.len(), if far.len() == 1 { "pair" } else { "pairs" });
        let text = format!(
            "contact of everything: {count} {pairs} of surfaces farther apart than their facets are wide"
        );
        let body = other_name(model, PairId(first), Side::B);
        advice.note(Topic::Contact, body, text);
    }
    for warning in warnings_at_start(model, fits) {
        let name = warning.pair.unwrap_or_default();
        advice.warn(Topic::NeverMeets, &name, warning.text);
    }
}

/// Returns whether the sides of a pair are farther apart than their widest facet.
fn is_far(model: &Model, pair: &Pair, fit: &Fit) -> bool {
    let widths = pair.surfaces().map(|side| match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            let areas = faces.iter().map(|face| mesh.area_vector(*face).norm());
            areas.fold(0.0, f64::max).sqrt()
        }
        ContactSurface::Rigid(_) | ContactSurface::Itself => 0.0,
    });
    let distance = fit.gap.as_ref().map_or(fit.distance, |gap| gap.gap);
    fit.overlap.is_none() && distance.is_finite() && distance > widths[0].max(widths[1])
}

/// Smallest gap and deepest overlap of a pair, and where.
fn words(model: &Model, pair: PairId, fit: &Fit) -> String {
    let at = |side: Side, spot: Spot, x: &Vec3| {
        let spot = match spot {
            Spot::Node(node) => surface_node(model, pair, side, node).map(|node| node.to_string()),
            Spot::Centre(facet) => Some(format!("the centre of {facet}")),
        };
        format!(
            "{} of `{}` {}",
            spot.unwrap_or_default(),
            other_name(model, pair, side.opposite()),
            place(x)
        )
    };
    let overlap = fit
        .overlap
        .as_ref()
        .filter(|overlap| overlap.share() > ROUND_OFF);
    let gap = match (&fit.gap, overlap) {
        (Some(gap), _) => {
            let place = at(gap.side, gap.spot, &gap.point);
            format!("smallest gap {} at {place}", significant(gap.gap, 4))
        }
        // All that faces the other side is inside it.
        (None, Some(_)) => "no gap".to_owned(),
        (None, None) => format!(
            "the sides do not face each other; nearest distance {}",
            significant(fit.distance, 4)
        ),
    };
    let overlap = overlap.map_or("no overlap".into(), |overlap| {
        let place = at(overlap.side, overlap.spot, &overlap.point);
        let share = 100.0 * overlap.share();
        format!(
            "largest overlap {} ({share:.1} % of the facet size) at {place}",
            significant(overlap.depth, 4)
        )
    });
    format!("{gap}; {overlap}")
}

/// Returns whether no facets of the sides face each other, as far as their normals tell.
fn looks_away(model: &Model, pair: &Pair) -> bool {
    // Parts of one body may face each other only once it is bent, and contact of everything has
    // pairs of all faces.
    if pair.is_within_a_body() || !pair.is_expected_to_touch() {
        return false;
    }
    let a = area_vectors(model, &pair.a);
    let b = match &pair.b {
        ContactSurface::Rigid(rigid) => match &model.rigid_surfaces[rigid.0].shape {
            RigidShape::Plane { normal, .. } => {
                let n = normal.normalize();
                return a.iter().all(|v| v.dot(&n) > FACING * v.norm());
            }
            _ => area_vectors(model, &pair.b),
        },
        ContactSurface::Deformable { .. } => area_vectors(model, &pair.b),
        // Facets of a body that face each other now are no condition.
        ContactSurface::Itself => return false,
    };
    match (plane(&a), plane(&b)) {
        (Some(a), Some(b)) => a.dot(&b) > FACING,
        _ => false,
    }
}

/// Area vectors of the facets of a side; none of a plane.
pub(super) fn area_vectors(model: &Model, side: &ContactSurface) -> Vec<Vec3> {
    match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            faces.iter().map(|&face| mesh.area_vector(face)).collect()
        }
        ContactSurface::Rigid(rigid) => match &model.rigid_surfaces[rigid.0].shape {
            RigidShape::Facets { positions, facets } => {
                let facets = facets.iter();
                let corners = facets.map(|facet| facet.map(|node| positions[node.index()]));
                corners
                    .map(|[a, b, c, d]| (c - a).cross(&(d - b)) * 0.5)
                    .collect()
            }
            RigidShape::Plane { .. } | RigidShape::Bare => Vec::new(),
        },
        ContactSurface::Itself => Vec::new(),
    }
}

/// Normal of a surface that is almost plane.
fn plane(vectors: &[Vec3]) -> Option<Vec3> {
    let sum: Vec3 = vectors.iter().sum();
    let area: f64 = vectors.iter().map(|v| v.norm()).sum();
    (area > 0.0 && sum.norm() > PLANE * area).then(|| sum.normalize())
}
