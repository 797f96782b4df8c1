//! Spread of contact over a side, up to its rim, as facets of the other side come closer.
//!
//! Along the direction `d` in which a step moves the sides together, a node `x` of the side meets
//! the other one, undeformed, at a distance `r`; the smallest one of all nodes is the gap `g`. A
//! smooth contact that is pressed together by `u` reaches, as that of Hertz does, nodes with
//!
//! ```text
//! r - g <= (u - g)/2
//! ```

use std::collections::BTreeSet;

use striae_mesh::{Face, NodeId, Vec3};
use striae_model::{BodyId, ContactSurface, Model, RigidShape, Step};

use super::super::resolution::of_side;

/// Nodes times facets up to which distances are looked for.
const COUNTED: usize = 50_000_000;
/// Position in a triangle that counts as its edge.
const EDGE: f64 = 1e-9;

/// Returns whether contact of a side with facets reaches a node of its rim in a step.
pub(super) fn reaches(
    model: &Model,
    (body, faces): (BodyId, &[Face]),
    other: &ContactSurface,
    step: &Step,
    rim: &[NodeId],
) -> bool {
    let side = ContactSurface::Deformable {
        body,
        faces: Vec::new(),
    };
    let way = of_side(model, step, &side) - of_side(model, step, other);
    let Some(d) = way.try_normalize(0.0) else {
        return false;
    };
    let mesh = &model.bodies[body.0].mesh;
    let nodes: BTreeSet<NodeId> = faces
        .iter()
        .flat_map(|face| mesh.face_nodes(*face))
        .collect();
    let facets = facets(model, other, &d);
    if nodes.len().saturating_mul(facets.len()) > COUNTED {
        return false;
    }
    let distance = |node: &NodeId| {
        let x = mesh.positions[node.index()];
        let met = facets.iter().filter_map(|facet| along(&x, &d, facet));
        // The side may overlap the other one.
        met.filter(|r| r.abs() <= way.norm()).reduce(f64::min)
    };
    let Some(gap) = nodes.iter().filter_map(distance).reduce(f64::min) else {
        return false;
    };
    let reached = gap + 0.5 * (way.norm() - gap);
    rim.iter().filter_map(distance).any(|r| r <= reached)
}

/// Corners of the facets of a side that look against a direction.
fn facets(model: &Model, side: &ContactSurface, d: &Vec3) -> Vec<[Vec3; 4]> {
    let all: Vec<[Vec3; 4]> = match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            let faces = faces.iter();
            faces.map(|face| mesh.face_positions(*face)).collect()
        }
        ContactSurface::Rigid(rigid) => match &model.rigid_surfaces[rigid.0].shape {
            RigidShape::Facets { positions, facets } => {
                let facets = facets.iter();
                let corners = facets.map(|facet| facet.map(|node| positions[node.index()]));
                corners.collect()
            }
            RigidShape::Plane { .. } | RigidShape::Bare => Vec::new(),
        },
        ContactSurface::Itself => Vec::new(),
    };
    let looks = |[a, b, c, e]: &[Vec3; 4]| (c - a).cross(&(e - b)).dot(d) < 0.0;
    all.into_iter().filter(looks).collect()
}

/// Distance from a point along a direction to a facet, negative behind the point.
fn along(x: &Vec3, d: &Vec3, [a, b, c, e]: &[Vec3; 4]) -> Option<f64> {
    let triangle = |b: &Vec3, c: &Vec3| {
        let [u, v] = [b - a, c - a];
        let across = d.cross(&v);
        let volume = u.dot(&across);
        let from = x - a;
        let first = from.dot(&across) / volume;
        let second = d.dot(&from.cross(&u)) / volume;
        let inside = first >= -EDGE && second >= -EDGE && first + second <= 1.0 + EDGE;
        inside.then(|| v.dot(&from.cross(&u)) / volume)
    };
    triangle(b, c).or_else(|| triangle(c, e))
}
