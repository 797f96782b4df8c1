//! Surfaces that continue smoothly beyond the facets of a pair.
//!
//! If a facet of the pair and a neighbour outside it make an angle of less than 40 degrees at their
//! common edge, contact can roll or spread over the edge, onto facets that no pair knows. It does
//! where the body turns, or where the other side comes that far.

mod spread;

use std::collections::{BTreeMap, BTreeSet};

use striae_mesh::{Face, Mesh, NodeId, Vec3, place};
use striae_model::{BodyId, ContactSurface, Freedom, Model, RigidId, RigidShape, Step};

use super::{Advice, Topic, resolution::approach};

/// Cosine between the normals of facets that continue smoothly.
const SMOOTH: f64 = 0.77;
/// Angle about which a body does not roll.
const SMALL: f64 = 0.05;

/// Warns of contact that reaches such edges.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    for pair in &model.pairs {
        for (side, other) in [(&pair.a, &pair.b), (&pair.b, &pair.a)] {
            let ContactSurface::Deformable { body, faces } = side else {
                continue;
            };
            let mesh = &model.bodies[body.0].mesh;
            let others = in_pairs(model, *body);
            let rim = rim(mesh, faces, &others);
            let Some(first) = rim.first() else { continue };
            let steps = model.steps.iter();
            let mut found = steps.filter_map(|step| {
                reached(model, (*body, faces), other, step, &rim).map(|how| (step, how))
            });
            if let Some((step, how)) = found.next() {
                let x = mesh.positions[first.index()];
                let body = &model.bodies[body.0].name;
                let text = format!(
                    "pair `{}`: in step `{}` {how}, and the surface of `{body}` continues smoothly beyond the facets of the pair, as at {}; facets outside it are not in contact: add the neighbours to the facets of the pair",
                    pair.name,
                    step.name,
                    place(&x)
                );
                advice.warn(Topic::Fit, &pair.name, text);
            }
        }
    }
}

/// Faces of a body that are in some pair or tie.
fn in_pairs(model: &Model, body: BodyId) -> BTreeSet<Face> {
    let pairs = model.pairs.iter().flat_map(|pair| [&pair.a, &pair.b]);
    let ties = model.ties.iter().flat_map(|tie| [&tie.a, &tie.b]);
    let faces = pairs.chain(ties).filter_map(|side| match side {
        ContactSurface::Deformable { body: of, faces } if *of == body => Some(faces),
        _ => None,
    });
    faces.flatten().copied().collect()
}

/// Nodes of edges between faces of a side and smooth neighbours that are in no pair.
fn rim(mesh: &Mesh, faces: &[Face], in_pairs: &BTreeSet<Face>) -> Vec<NodeId> {
    let own: BTreeSet<Face> = faces.iter().copied().collect();
    let mut inside: BTreeMap<[NodeId; 2], Face> = BTreeMap::new();
    for face in faces {
        inside.extend(edges(mesh, *face).map(|edge| (edge, *face)));
    }
    let mut rim = BTreeSet::new();
    let outside = mesh.boundary_faces();
    let outside = outside
        .into_iter()
        .filter(|face| !own.contains(face) && !in_pairs.contains(face));
    for face in outside {
        for edge in edges(mesh, face) {
            let Some(neighbour) = inside.get(&edge) else {
                continue;
            };
            let normals = [face, *neighbour].map(|face| mesh.area_vector(face).normalize());
            if normals[0].dot(&normals[1]) > SMOOTH {
                rim.extend(edge);
            }
        }
    }
    rim.into_iter().collect()
}

/// Edges of a face by their nodes; a triangle repeats its last corner.
fn edges(mesh: &Mesh, face: Face) -> impl Iterator<Item = [NodeId; 2]> {
    let nodes = mesh.face_nodes(face);
    let edges = (0..4).map(move |at| [nodes[at], nodes[(at + 1) % 4]]);
    let edges = edges.filter(|[from, to]| from != to);
    edges.map(|[from, to]| [from.min(to), from.max(to)])
}

/// Returns how contact reaches the rim in a step.
fn reached(
    model: &Model,
    (body, faces): (BodyId, &[Face]),
    other: &ContactSurface,
    step: &Step,
    rim: &[NodeId],
) -> Option<String> {
    let mesh = &model.bodies[body.0].mesh;
    if let Some(angle) = rolls(model, body, faces, step) {
        let name = &model.bodies[body.0].name;
        return Some(format!(
            "`{name}` rotates by {:.0} degrees",
            angle.to_degrees()
        ));
    }
    let name = match other {
        ContactSurface::Rigid(rigid) => &model.rigid_surfaces[rigid.0].name,
        ContactSurface::Deformable { body, .. } => &model.bodies[body.0].name,
        ContactSurface::Itself => return None,
    };
    let reached = match plane(model, other) {
        Some((rigid, point, n)) => {
            let way = approach(step, (body, mesh), rigid, &n);
            let near = |node: &NodeId| (mesh.positions[node.index()] - point).dot(&n) < way;
            way > 0.0 && rim.iter().any(near)
        }
        None => spread::reaches(model, (body, faces), other, step, rim),
    };
    reached.then(|| format!("contact with `{name}` spreads that far"))
}

/// A plane with a point and the normal of it, if a side is one.
fn plane(model: &Model, side: &ContactSurface) -> Option<(RigidId, Vec3, Vec3)> {
    let ContactSurface::Rigid(rigid) = side else {
        return None;
    };
    match &model.rigid_surfaces[rigid.0].shape {
        RigidShape::Plane { point, normal } => Some((*rigid, *point, normal.normalize())),
        RigidShape::Facets { .. } | RigidShape::Bare => None,
    }
}

/// Angle by which a rigid body that a body is tied to turns, other than about the normal of
/// its contact surface.
fn rolls(model: &Model, body: BodyId, faces: &[Face], step: &Step) -> Option<f64> {
    let mesh = &model.bodies[body.0].mesh;
    let sum: Vec3 = faces.iter().map(|face| mesh.area_vector(*face)).sum();
    let n = sum.try_normalize(0.0).unwrap_or_else(Vec3::zeros);
    let motions = step.rigid_motions.iter().filter(|motion| {
        let ties = &model.rigid_surfaces[motion.surface.0].ties;
        ties.iter().any(|(tied, _)| *tied == body)
    });
    let turns = motions.map(|motion| {
        let turn = |axis: usize| match motion.coordinates[axis + 3] {
            Freedom::To(angle) => angle,
            Freedom::AsBefore | Freedom::Free => 0.0,
        };
        let turn = Vec3::new(turn(0), turn(1), turn(2));
        (turn - n * turn.dot(&n)).norm()
    });
    turns.filter(|angle| *angle > SMALL).max_by(f64::total_cmp)
}
