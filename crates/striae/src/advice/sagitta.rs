//! Overlaps that are meant as an interference, beside the sagitta of curved surfaces.
//!
//! Facets are chords. Of a surface whose neighbouring facets, apart by `h`, turn by the angle `a`,
//! the middle of a facet is nearer to the centre of curvature than its edges by
//!
//! ```text
//! h^2/(8R) = h a/8,
//! ```
//!
//! so that meshes that do not match overlap by as much more or less than the surfaces do.

use std::collections::BTreeMap;

use striae_contact::initial::Fit;
use striae_mesh::Vec3;
use striae_model::{ContactSurface, Initial, Model, RigidShape};

use super::{Advice, Topic};

/// Ratio of sagitta to overlap from which on it matters: this is the relative error of the
/// pressure.
const BESIDE: f64 = 0.1;
/// Angle between neighbouring facets from which on their common edge is one of the body.
const EDGE: f64 = 0.8;
/// Angle that is round-off.
const FLAT: f64 = 1e-6;

/// Warns of overlaps that are pressed out and are not large beside the sagitta.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    for (pair, fit) in model.pairs.iter().zip(fits) {
        let overlap = fit.as_ref().and_then(|fit| fit.overlap.as_ref());
        let Some(depth) = overlap.map(|overlap| overlap.depth) else {
            continue;
        };
        if pair.initial != Initial::Resolve {
            continue;
        }
        let sagittas = [&pair.a, &pair.b].map(|side| sagitta(model, side));
        let sagitta = sagittas[0].max(sagittas[1]);
        if sagitta > BESIDE * depth {
            let text = format!(
                "pair `{}`: the deepest overlap of the meshes, {depth:.3e}, is comparable to the sagitta of their facets, {sagitta:.3e}: facets are chords of curved surfaces, so where the meshes do not match the pressure is wrong by about {:.0} %. State the overlap of the surfaces as `interference` instead of `initial = \"resolve\"`, or refine the meshes around it",
                pair.name,
                100.0 * sagitta / depth
            );
            advice.warn(Topic::Fit, &pair.name, text);
        }
    }
}

/// A facet: its corners by number, their mean and the area vector.
type Flat = (Vec<usize>, Vec3, Vec3);

/// The largest sagitta of the facets of a side.
fn sagitta(model: &Model, side: &ContactSurface) -> f64 {
    let facets = facets(model, side);
    let mut first: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    let mut largest = 0.0_f64;
    for (at, (corners, middle, area)) in facets.iter().enumerate() {
        for k in 0..corners.len() {
            let (i, j) = (corners[k], corners[(k + 1) % corners.len()]);
            let Some(other) = first.insert([i.min(j), i.max(j)], at) else {
                continue;
            };
            let (_, beside, vector) = &facets[other];
            let angle = area.angle(vector);
            if angle > FLAT && angle < EDGE {
                largest = largest.max((middle - beside).norm() * angle / 8.0);
            }
        }
    }
    largest
}

fn facets(model: &Model, side: &ContactSurface) -> Vec<Flat> {
    let flat = |corners: Vec<usize>, x: &[Vec3]| {
        let mut distinct = corners;
        distinct.dedup();
        let middle = distinct.iter().map(|&node| x[node]).sum::<Vec3>() / distinct.len() as f64;
        let turn = |k: usize| {
            let [p, q] = [k, (k + 1) % distinct.len()].map(|k| x[distinct[k]] - middle);
            p.cross(&q)
        };
        let area = (0..distinct.len()).map(turn).sum::<Vec3>() * 0.5;
        (distinct, middle, area)
    };
    match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            let faces = faces.iter();
            faces
                .map(|face| {
                    let corners = mesh.face_nodes(*face).into_iter();
                    flat(corners.map(|node| node.index()).collect(), &mesh.positions)
                })
                .collect()
        }
        ContactSurface::Rigid(rigid) => match &model.rigid_surfaces[rigid.0].shape {
            RigidShape::Facets { positions, facets } => {
                let facets = facets.iter();
                facets
                    .map(|facet| {
                        let corners = facet.iter().map(|node| node.index());
                        flat(corners.collect(), positions)
                    })
                    .collect()
            }
            RigidShape::Plane { .. } | RigidShape::Bare => Vec::new(),
        },
        ContactSurface::Itself => Vec::new(),
    }
}
