//! Contact of everything: surfaces that may touch, surfaces that may not, and thin bodies.
//!
//! A model that has pairs with faces at sharp edges, as contact of everything makes them, is meant
//! to be complete: surfaces without a pair are reported, as they may be forgotten.

use std::collections::{BTreeMap, BTreeSet};

use striae_contact::interference::{fibres, lengths};
use striae_mesh::{Face, NodeId, Vec3, place};
use striae_model::{Body, BodyId, ContactSurface, Freedom, Model, RigidShape, Step};
use striae_surface::topology::Surface;

use super::{Advice, Topic};

/// Parts of both skins in round-off of all.
const ALL: f64 = 1.0 - 1e-9;

/// Notes what may touch what, and warns of bodies thinner than what an increment moves.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    if model.pairs.iter().all(|pair| pair.feature_angle.is_none()) {
        return;
    }
    touching(model, advice);
    let thin = model.bodies.iter().enumerate();
    let thin = thin.filter_map(|(at, body)| Some((at, thinnest(body)?)));
    for (at, thin) in thin {
        thickness(model, BodyId(at), thin, advice);
    }
}

/// Surfaces that a body may touch which are named.
const NAMED: usize = 8;

/// A body or a rigid surface; bodies first.
type Owner = (bool, usize);

fn name(model: &Model, (is_rigid, at): Owner) -> &str {
    match is_rigid {
        false => &model.bodies[at].name,
        true => &model.rigid_surfaces[at].name,
    }
}

/// Part of the product of two skins that pairs let touch, each couple of facets once.
fn parts(model: &Model) -> BTreeMap<(Owner, Owner), f64> {
    let mut parts = BTreeMap::new();
    let skins = model
        .bodies
        .iter()
        .map(|body| body.mesh.boundary_faces().len());
    let skins: Vec<f64> = skins.map(|count| count as f64).collect();
    let side = |surface: &ContactSurface| match surface {
        ContactSurface::Deformable { body, faces } => {
            let of_skin = faces.len() as f64 / skins[body.0];
            Some(((false, body.0), of_skin))
        }
        ContactSurface::Rigid(rigid) => Some(((true, rigid.0), 1.0)),
        ContactSurface::Itself => None,
    };
    for pair in &model.pairs {
        let [Some((a, of_a)), Some((b, of_b))] = pair.surfaces().map(side) else {
            continue;
        };
        let both = match (a == b, pair.is_on_itself()) {
            // Two parts of one skin are so in both orders.
            (true, false) => 2.0 * of_a * of_b,
            _ => of_a * of_b,
        };
        *parts.entry((a.min(b), a.max(b))).or_insert(0.0) += both;
    }
    parts
}

fn touching(model: &Model, advice: &mut Advice) {
    let parts = parts(model);
    let rigid = model.rigid_surfaces.iter().enumerate();
    let rigid = rigid.filter(|(_, of)| !matches!(of.shape, RigidShape::Bare));
    let bodies: Vec<Owner> = (0..model.bodies.len()).map(|at| (false, at)).collect();
    let all: Vec<Owner> = (bodies.iter().copied())
        .chain(rigid.map(|(at, _)| (true, at)))
        .collect();
    let quoted = |owners: &[(Owner, String)]| -> String {
        let names = owners.iter().map(|(_, told)| told.clone());
        names.collect::<Vec<_>>().join(", ")
    };
    for &body in &bodies {
        let (mut may, mut may_not) = (Vec::new(), Vec::new());
        let mut is_whole = true;
        for &other in &all {
            let told = match other == body {
                true => "itself".to_owned(),
                false => format!("`{}`", name(model, other)),
            };
            let part = parts.get(&(body.min(other), body.max(other)));
            match part {
                Some(part) if *part >= ALL => may.push((other, told)),
                Some(_) => {
                    is_whole = false;
                    may.push((other, format!("{told} (in part)")));
                }
                None => {
                    is_whole = false;
                    may_not.push((other, told));
                }
            }
        }
        let name = name(model, body);
        let may_not = match may_not.is_empty() {
            true => String::new(),
            false => format!("; not {}", quoted(&may_not)),
        };
        let may = match may.as_slice() {
            [] => "nothing".to_owned(),
            all if all.len() > NAMED && is_whole => "all surfaces, itself included".to_owned(),
            some => quoted(some),
        };
        advice.note(
            Topic::Contact,
            name,
            format!("body `{name}` may touch {may}{may_not}"),
        );
    }
}

/// Place where a body is thinnest relative to the size of its facets.
#[derive(Clone, Copy)]
struct Thin {
    thickness: f64,
    size: f64,
    at: Vec3,
}

fn thinnest(body: &Body) -> Option<Thin> {
    let mesh = &body.mesh;
    let faces: Vec<Face> = mesh.boundary_faces();
    let facets: Vec<[NodeId; 4]> = faces.iter().map(|face| mesh.face_nodes(*face)).collect();
    let skin = Surface::new(&facets);
    let place = |node: NodeId| mesh.positions[node.index()];
    let x: Vec<Vec3> = skin.nodes().iter().map(|node| place(*node)).collect();
    let through = fibres(&skin, &x, &skin, &x);
    let thickness = lengths(&skin, &x, &through, place);
    let all = faces
        .iter()
        .zip(thickness)
        .filter(|(_, found)| found.is_finite());
    let all = all.map(|(face, thickness)| Thin {
        thickness,
        size: mesh.area_vector(*face).norm().sqrt(),
        at: mesh.face_positions(*face).iter().sum::<Vec3>() / 4.0,
    });
    let share = |thin: &Thin| thin.thickness / thin.size;
    all.min_by(|one, other| share(one).total_cmp(&share(other)))
}

fn thickness(model: &Model, body: BodyId, thin: Thin, advice: &mut Advice) {
    let name = &model.bodies[body.0].name;
    let Thin {
        thickness,
        size,
        at,
    } = thin;
    let most = 0.5 * thickness;
    let text = format!(
        "body `{name}` is {thickness:.3} thick where facets are {size:.3} wide, at {}: increments must move its layers by less than {most:.3}",
        place(&at)
    );
    let moved = model.steps.iter().map(|step| (step, moved(model, step)));
    let farthest = moved.max_by(|(_, one), (_, other)| one.total_cmp(other));
    match farthest {
        Some((step, moved)) if moved > most => advice.warn(
            Topic::Contact,
            name,
            format!(
                "{text}, and those of step `{}` prescribe up to {moved:.3}; take more increments",
                step.name
            ),
        ),
        _ => advice.note(Topic::Contact, name, text),
    }
}

/// Distance that the largest increment of a step moves prescribed nodes.
fn moved(model: &Model, step: &Step) -> f64 {
    let own = step.displacements.iter().map(|of| {
        let before = previous(model, step, of.body, &of.nodes);
        let change = [0, 1, 2].map(|axis| of.numbers()[axis].map_or(0.0, |to| to - before[axis]));
        // Components in other axes have the same length.
        Vec3::from(change).norm()
    });
    let rigid = step.rigid_motions.iter().map(|motion| {
        let before = earlier(model, step).flat_map(|step| &step.rigid_motions);
        let before = before
            .filter(|other| other.surface == motion.surface)
            .last();
        let change = |axis: usize| match motion.coordinates[axis] {
            Freedom::To(target) => {
                let before = before.map(|other| other.coordinates[axis]);
                match before {
                    Some(Freedom::To(before)) => target - before,
                    _ => target,
                }
            }
            Freedom::AsBefore | Freedom::Free => 0.0,
        };
        Vec3::new(change(0), change(1), change(2)).norm()
    });
    let velocities = step.velocities.iter();
    let velocities = velocities.map(|of| of.velocity.norm() * step.duration);
    let farthest = own.chain(rigid).chain(velocities).fold(0.0, f64::max);
    farthest * step.increments.largest
}

fn earlier<'m>(model: &'m Model, step: &Step) -> impl Iterator<Item = &'m Step> {
    let name = step.name.clone();
    model
        .steps
        .iter()
        .take_while(move |other| other.name != name)
}

/// Places that earlier steps have taken nodes to.
fn previous(model: &Model, step: &Step, body: BodyId, nodes: &[NodeId]) -> [f64; 3] {
    let of: BTreeSet<&NodeId> = nodes.iter().collect();
    let mut reached = [0.0; 3];
    for condition in earlier(model, step).flat_map(|step| &step.displacements) {
        if condition.body == body && condition.nodes.iter().any(|node| of.contains(node)) {
            for (axis, target) in condition.numbers().iter().enumerate() {
                reached[axis] = target.unwrap_or(reached[axis]);
            }
        }
    }
    reached
}
