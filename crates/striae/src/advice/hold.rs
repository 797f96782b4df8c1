//! Restraint of each body in the first step: prescribed nodes, ties, springs, contact.
//!
//! Rigid motions that prescribed nodes leave free must be stopped by contact. A pair that touches
//! stops all motions that its friction and normals resist, whatever its size; an open pair stops
//! none unless it is stabilised. In later steps contact may have closed. Bodies that hold each
//! other are also looked at together.

mod together;

use striae_contact::initial::Fit;
use striae_law::friction::Law;
use striae_mesh::{Mesh, Vec3};
use striae_model::{
    Body, BodyId, ContactSurface, Model, Mover, PairId, Procedure, RigidMotions, Step,
    initial::opposed,
};

use super::{Advice, Topic};

/// Ratio of the gap to the element size that counts as zero.
const TOUCHING: f64 = 1e-6;

/// Notes what holds every body, and warns of those that nothing holds at first.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    let Some(step) = model.steps.first() else {
        return;
    };
    for (index, body) in model.bodies.iter().enumerate() {
        let id = BodyId(index);
        if let Some(rigid) = model
            .rigid_surfaces
            .iter()
            .find(|rigid| rigid.ties.iter().any(|(tied, _)| *tied == id))
        {
            let text = format!("body `{}` is tied to `{}`", body.name, rigid.name);
            advice.note(Topic::Hold, &body.name, text);
            continue;
        }
        if let Some(tie) = model.ties.iter().find(|tie| tie.joins(id)) {
            let text = format!(
                "body `{}` is glued to another one by tie `{}`",
                body.name, tie.name
            );
            advice.note(Topic::Hold, &body.name, text);
            continue;
        }
        let mut springs = model.springs.iter();
        if let Some(spring) = springs.find(|of| of.holds(Mover::Deformable(id))) {
            let text = format!("body `{}` is held by spring `{}`", body.name, spring.name);
            advice.note(Topic::Hold, &body.name, text);
            continue;
        }
        let mut motions = prescribed(&body.mesh, step, id);
        match motions.left() {
            0 => {
                let text = format!("body `{}` is restrained by its prescribed nodes", body.name);
                advice.note(Topic::Hold, &body.name, text);
            }
            _ => by_contact(model, fits, (id, body), &mut motions, advice),
        }
    }
    together::look(model, fits, step, advice);
}

fn prescribed(mesh: &Mesh, step: &Step, body: BodyId) -> RigidMotions {
    let mut motions = RigidMotions::of(mesh);
    stop_prescribed(mesh, step, body, &mut motions);
    motions
}

/// Stops what prescribed nodes of a body stop.
fn stop_prescribed(mesh: &Mesh, step: &Step, body: BodyId, motions: &mut RigidMotions) {
    let conditions = step.displacements.iter().filter(|of| of.body == body);
    for condition in conditions {
        for node in &condition.nodes {
            let x = &mesh.positions[node.index()];
            let directions = condition.axes.directions(x).into_iter();
            for (direction, target) in directions.zip(&condition.components) {
                if let (Some(direction), Some(_)) = (direction, target) {
                    motions.stop(x, &direction);
                }
            }
        }
    }
}

/// Returns whether a pair touches at the start, or is stabilised until it does.
fn holds(model: &Model, fits: &[Option<Fit>], pair: usize, mesh: &Mesh) -> bool {
    let fit = fits[pair].as_ref();
    fit.is_some_and(|fit| touches(fit, mesh)) || model.pairs[pair].stabilised
}

/// Returns whether a pair of a body of this mesh touches at the start.
pub(super) fn touches(fit: &Fit, mesh: &Mesh) -> bool {
    fit.distance <= TOUCHING * mesh.characteristic_size() || fit.overlap.is_some()
}

fn names(model: &Model, pairs: &[usize]) -> String {
    let names = pairs
        .iter()
        .map(|&at| format!("`{}`", model.pairs[at].name));
    names.collect::<Vec<_>>().join(", ")
}

/// Cause and remedy of motions that contact leaves.
fn cause(model: &Model, [closed, open]: [&[usize]; 2], subject: [&str; 2], left: &str) -> String {
    let [it, it_is] = subject;
    let list = |pairs: &[usize]| names(model, pairs);
    let why = match (closed, open) {
        ([], []) => "no contact restrains this".to_owned(),
        (_, []) => format!(
            "the contact of {} leaves {it} free {left}, as it is frictionless",
            list(closed)
        ),
        ([], _) => format!("nothing restrains {it} before {} closes", list(open)),
        _ => format!(
            "with the contact of {} {it_is} free {left} before {} closes",
            list(closed),
            list(open)
        ),
    };
    let remedy = match open {
        [] => "prescribe these motions",
        _ => {
            "prescribe these motions, start with the surfaces in contact, or set `stabilise = true` in the pair"
        }
    };
    format!("{why}; {remedy}")
}

fn by_contact(
    model: &Model,
    fits: &[Option<Fit>],
    (id, body): (BodyId, &Body),
    motions: &mut RigidMotions,
    advice: &mut Advice,
) {
    let name = &body.name;
    let is = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body: of, .. } if *of == id);
    let pairs = model.pairs.iter().enumerate();
    // Contact of a body with itself holds it nowhere.
    let pairs = pairs.filter(|(_, pair)| (is(&pair.a) || is(&pair.b)) && !pair.is_within_a_body());
    let pairs: Vec<usize> = pairs.map(|(index, _)| index).collect();
    let left = motions.words();
    let text = format!("prescribed nodes leave body `{name}` free to move {left}");
    if model.steps[0].procedure != Procedure::QuasiStatic {
        let text = format!("{text}; its inertia resists");
        advice.note(Topic::Hold, name, text);
        return;
    }
    let (closed, open): (Vec<usize>, Vec<usize>) = pairs
        .iter()
        .partition(|at| holds(model, fits, **at, &body.mesh));
    for &pair in &closed {
        stop_by(model, PairId(pair), id, motions);
    }
    if motions.left() == 0 {
        let closed = names(model, &closed);
        let text = format!("{text}; contact of {closed} must restrain it");
        advice.note(Topic::Hold, name, text);
        return;
    }
    let left = motions.words();
    let cause = cause(model, [&closed, &open], ["it", "it is"], &left);
    advice.warn(Topic::Hold, name, format!("{text}, and {cause}"));
}

/// Stops what closed contact of a pair stops.
fn stop_by(model: &Model, pair: PairId, body: BodyId, motions: &mut RigidMotions) {
    let pair = &model.pairs[pair.0];
    let mesh = &model.bodies[body.0].mesh;
    let first = model.steps.first();
    let changes = first.into_iter().flat_map(|step| &step.frictions);
    let mut changed = changes.filter(|(of, _)| model.pairs[of.0].name == pair.name);
    let friction = changed
        .next()
        .map_or(&pair.friction, |(_, friction)| friction);
    let is_rough =
        !matches!(friction.law(), Law::Frictionless) && friction.coefficient().at_rest() > 0.0;
    for (side, faces) in [&pair.a, &pair.b].into_iter().zip(opposed(model, pair)) {
        let ContactSurface::Deformable { body: of, .. } = side else {
            continue;
        };
        for face in faces.into_iter().filter(|_| *of == body) {
            let normal = mesh.area_vector(face).normalize();
            for x in mesh.face_positions(face) {
                match is_rough || pair.stabilised {
                    true => (0..3).for_each(|axis| motions.stop(&x, &Vec3::ith(axis, 1.0))),
                    false => motions.stop(&x, &normal),
                }
            }
        }
    }
}
