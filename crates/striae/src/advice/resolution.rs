//! Curved surfaces that meet a plane with few nodes.
//!
//! In the first step a body comes closer to a rigid plane by what is prescribed along the
//! normal `n`. Nodes of its side that are no farther than that can touch:
//!
//! ```text
//! (x - p) . n <= way
//! ```
//!
//! Of a flat face these are all nodes or none; of a curved one they span the contact, over
//! whose radius pressures need about five elements. Contact of other surfaces is as wide as
//! [`width`] finds.

mod width;

pub(super) use width::of_side;

use std::collections::BTreeSet;

use striae_contact::initial::Fit;

use striae_mesh::{Mesh, NodeId, Vec3};
use striae_model::{
    BodyId, ContactSurface, Freedom, Model, Pair, RigidId, RigidShape, Step, initial::opposed,
};

use super::{Advice, Topic};

/// Nodes of a circle with five elements over its diameter.
const FEW: usize = 20;

/// Notes contact of curved surfaces with planes that few nodes resolve.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    let Some(step) = model.steps.first() else {
        return;
    };
    for (pair, fit) in model.pairs.iter().zip(fits) {
        if let Some(fit) = fit {
            width::look(model, pair, step, fit, advice);
        }
        if let Some((touching, all)) = nodes(model, pair, step)
            && touching < FEW
            && 2 * touching < all
        {
            let name = &pair.name;
            advice.note(
                Topic::Fit,
                name,
                format!(
                    "pair `{name}`: in step `{}` about {touching} of {all} nodes touch the plane; pressures of a curved contact need about five elements over its radius, forces three",
                    step.name
                ),
            );
        }
    }
}

/// Number of nodes of a side that can touch a plane, and number of all its nodes.
fn nodes(model: &Model, pair: &Pair, step: &Step) -> Option<(usize, usize)> {
    let (ContactSurface::Deformable { body, .. }, ContactSurface::Rigid(rigid)) =
        (&pair.a, &pair.b)
    else {
        return None;
    };
    let RigidShape::Plane { point, normal } = &model.rigid_surfaces[rigid.0].shape else {
        return None;
    };
    let n = normal.normalize();
    let mesh = &model.bodies[body.0].mesh;
    let way = approach(step, (*body, mesh), *rigid, &n);
    let [faces, _] = opposed(model, pair);
    let nodes = faces.iter().flat_map(|face| mesh.face_nodes(*face));
    let nodes: BTreeSet<NodeId> = nodes.collect();
    let near = |node: &&NodeId| (mesh.positions[node.index()] - point).dot(&n) <= way;
    (way > 0.0).then(|| (nodes.iter().filter(near).count(), nodes.len()))
}

/// Motion of a body towards a plane of normal `n` that moves itself.
pub(super) fn approach(
    step: &Step,
    (body, mesh): (BodyId, &Mesh),
    rigid: RigidId,
    n: &Vec3,
) -> f64 {
    let own = step.displacements.iter().filter(|of| of.body == body);
    let own = own.map(|of| -of.way(mesh).dot(n));
    let motions = step.rigid_motions.iter();
    let motions = motions.filter(|motion| motion.surface == rigid);
    let its = motions.map(|motion| {
        let along = |axis: usize| match motion.coordinates[axis] {
            Freedom::To(target) => target,
            Freedom::AsBefore | Freedom::Free => 0.0,
        };
        Vec3::new(along(0), along(1), along(2)).dot(n)
    });
    own.fold(0.0, f64::max) + its.fold(0.0, f64::max)
}
