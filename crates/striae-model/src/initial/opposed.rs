//! Faces of a pair that can touch.
//!
//! The faces of a named pair are stated because they touch. Contact of everything states all faces
//! of a body, most of which never touch a given other one: a facet at `x` of normal `n` can touch
//! one at `y` of normal `m` only if they are opposed and in front of each other, but for half the
//! size `h` of a facet, within which contact is searched.
//!
//! ```text
//! n . m < -.2,   n . (y - x) >= -h/2,   m . (x - y) >= -h/2
//! ```
//!
//! Facets of the other side that look in about the same direction are one patch, which has the
//! mean of their normals and is anywhere in the box around them, so that time goes by the number of
//! facets. Of a plane, and where overlaps are closed or pressed out, directions alone decide.

use std::collections::BTreeMap;

use striae_contact::segment::FACING;
use striae_mesh::{Face, Vec3};

use crate::model::{ContactSurface, Initial, Model, Pair, RigidShape};

/// Directions of patches over the length of a normal.
const DIRECTIONS: f64 = 4.0;

/// Faces of the deformable sides of a pair that can touch the other side as they lie; none of a
/// rigid side.
pub fn opposed(model: &Model, pair: &Pair) -> [Vec<Face>; 2] {
    let sides = [&pair.a, &pair.b];
    let faces = sides.map(|side| match side {
        ContactSurface::Deformable { faces, .. } => faces.clone(),
        ContactSurface::Rigid(_) | ContactSurface::Itself => Vec::new(),
    });
    if pair.is_expected_to_touch() || pair.is_within_a_body() {
        return faces;
    }
    let facets = sides.map(|side| facets(model, side));
    let others = [1, 0].map(|side| patches(model, pair, sides[side], &facets[side]));
    [0, 1].map(|side| {
        let meets = |facet: &Facet| others[side].iter().any(|patch| patch.meets(facet));
        let of_side = faces[side].iter().zip(&facets[side]);
        let of_side = of_side.filter(|(_, facet)| meets(facet));
        of_side.map(|(face, _)| *face).collect()
    })
}

/// A facet of a side.
struct Facet {
    corners: [Vec3; 4],
    normal: Vec3,
    size: f64,
}

/// Facets of a side; none of a plane.
fn facets(model: &Model, side: &ContactSurface) -> Vec<Facet> {
    let facet = |corners: [Vec3; 4]| {
        let [a, b, c, d] = corners;
        let area = (c - a).cross(&(d - b)) * 0.5;
        Facet {
            corners,
            normal: area.normalize(),
            size: area.norm().sqrt(),
        }
    };
    match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            let corners = faces.iter().map(|face| mesh.face_positions(*face));
            corners.map(facet).collect()
        }
        ContactSurface::Rigid(rigid) => match &model.rigid_surfaces[rigid.0].shape {
            RigidShape::Facets { positions, facets } => {
                let corners = facets.iter();
                let corners = corners.map(|of| of.map(|node| positions[node.index()]));
                corners.map(facet).collect()
            }
            RigidShape::Plane { .. } | RigidShape::Bare => Vec::new(),
        },
        ContactSurface::Itself => Vec::new(),
    }
}

/// Facets that look in about the same direction.
struct Patch {
    normal: Vec3,
    low: Vec3,
    high: Vec3,
    /// Distance by which facets that touch may lie behind each other.
    depth: f64,
}

/// Patches of a side of a pair, one of a plane.
fn patches(model: &Model, pair: &Pair, side: &ContactSurface, facets: &[Facet]) -> Vec<Patch> {
    if let ContactSurface::Rigid(rigid) = side
        && let RigidShape::Plane { point, normal } = model.rigid_surfaces[rigid.0].shape
    {
        return vec![Patch {
            normal: normal.normalize(),
            low: point,
            high: point,
            depth: f64::INFINITY,
        }];
    }
    let mut patches: BTreeMap<[i64; 3], Patch> = BTreeMap::new();
    for facet in facets {
        let direction = [0, 1, 2].map(|axis| (DIRECTIONS * facet.normal[axis]).round() as i64);
        let patch = patches.entry(direction).or_insert(Patch {
            normal: Vec3::zeros(),
            low: Vec3::repeat(f64::INFINITY),
            high: Vec3::repeat(f64::NEG_INFINITY),
            depth: match pair.initial {
                Initial::AsMeshed => 0.0,
                Initial::Close(_) | Initial::Resolve => f64::INFINITY,
            },
        });
        patch.normal += facet.normal;
        patch.depth = patch.depth.max(0.5 * facet.size);
        for corner in &facet.corners {
            patch.low = patch.low.inf(corner);
            patch.high = patch.high.sup(corner);
        }
    }
    let patches = patches.into_values();
    let unit = |patch: Patch| Patch {
        normal: patch.normal.normalize(),
        ..patch
    };
    patches.map(unit).collect()
}

impl Patch {
    fn meets(&self, facet: &Facet) -> bool {
        let depth = self.depth.max(0.5 * facet.size);
        let (n, m) = (&facet.normal, &self.normal);
        let in_front = |x: &Vec3| {
            n.dot(&(self.farthest(n) - x)) >= -depth && m.dot(&(x - self.farthest(&-m))) >= -depth
        };
        n.dot(m) < FACING && facet.corners.iter().any(in_front)
    }

    /// Corner of its box that is farthest in a direction.
    fn farthest(&self, direction: &Vec3) -> Vec3 {
        Vec3::from_fn(|axis, _| match direction[axis] > 0.0 {
            true => self.high[axis],
            false => self.low[axis],
        })
    }
}
