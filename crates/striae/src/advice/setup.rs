//! Steps beside the bodies they act on: displacements beside sizes, waves beside durations,
//! driving forces on coordinates that are held.

pub(super) mod prescribed;

use striae_mesh::significant;
use striae_model::{
    Body, BodyId, ContactSurface, Freedom, Model, Pair, Procedure, RigidMotion, RigidShape, Step,
};

use super::{
    Advice, Topic,
    parts::Part,
    shape::{box_of, extent},
};

/// Displacement over the size of a body that is worth a note, and a warning.
const LARGE: [f64; 2] = [2.0, 10.0];
/// Slide over the length of both sides of a pair that is hardly meant.
const FAR: f64 = 3.0;
/// Length of a plane over that of a body on it.
const UNBOUNDED: f64 = 30.0;
/// Component of a normal along an axis.
const ALONG: f64 = 0.7;
/// Names of the coordinates of a rigid body.
const COORDINATES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Notes requests of steps that their bodies can hardly fulfil.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    for (index, body) in model.bodies.iter().enumerate() {
        displacements(model, BodyId(index), body, advice);
        slides(model, BodyId(index), body, advice);
        for step in &model.steps {
            waves(body, step, advice);
        }
    }
    held(model, advice);
}

fn displacements(model: &Model, id: BodyId, body: &Body, advice: &mut Advice) {
    let crossing = crossing(model, id, body);
    let steps = model.steps.iter();
    let prescribed = steps.flat_map(|step| step.displacements.iter().map(move |of| (step, of)));
    let own = prescribed.filter(|(_, of)| of.body == id);
    let largest = own
        .flat_map(|(step, of)| {
            let way = of.way(&body.mesh);
            let components = (0..3).filter(move |axis| crossing[*axis]);
            components.map(move |axis| (step, way[axis].abs()))
        })
        .max_by(|(_, a), (_, b)| a.total_cmp(b));
    let [low, high] = extent(&body.mesh);
    let size = (high - low).max();
    let Some((step, displacement)) = largest.filter(|(_, way)| *way > LARGE[0] * size) else {
        return;
    };
    let name = &body.name;
    let text = format!(
        "body `{name}` is {size} long, and step `{}` displaces nodes of it by {displacement}, {} times as much",
        step.name,
        significant(displacement / size, 2),
        size = significant(size, 4),
        displacement = significant(displacement, 4)
    );
    match displacement > LARGE[1] * size {
        true => advice.warn(
            Topic::Units,
            name,
            format!("{text}; are the mesh and the displacements in one unit of length?"),
        ),
        false => advice.note(Topic::Units, name, text),
    }
}

/// Displacements along contact surfaces that go far beyond both sides of all pairs.
fn slides(model: &Model, id: BodyId, body: &Body, advice: &mut Advice) {
    let crossing = crossing(model, id, body);
    let own = extent(&body.mesh);
    let lengths = |axis: usize| {
        let sides = model.pairs.iter().map(Pair::surfaces);
        let is = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body, .. } if *body == id);
        let others = sides.filter_map(move |[a, b]| match (is(a), is(b)) {
            (true, _) => Some(b),
            (_, true) => Some(a),
            _ => None,
        });
        let own = (own[1] - own[0])[axis];
        let others = others.map(move |other| length(model, other, axis).unwrap_or(UNBOUNDED * own));
        own + others.fold(0.0, f64::max)
    };
    let steps = model.steps.iter();
    let prescribed = steps.flat_map(|step| step.displacements.iter().map(move |of| (step, of)));
    let far = prescribed
        .filter(|(_, of)| of.body == id)
        .find_map(|(step, of)| {
            let way = of.way(&body.mesh);
            let mut axes = (0..3).filter(|axis| !crossing[*axis]);
            let axis = axes.find(|axis| way[*axis].abs() > FAR * lengths(*axis))?;
            Some((step, axis, way[axis].abs()))
        });
    if let Some((step, axis, way)) = far {
        let name = &body.name;
        let text = format!(
            "body `{name}` is {} long along {}, and step `{}` slides nodes of it by {} along it, far beyond what it touches; are the mesh and the displacements in one unit of length?",
            significant((own[1] - own[0])[axis], 4),
            COORDINATES[axis],
            step.name,
            significant(way, 4)
        );
        advice.warn(Topic::Units, name, text);
    }
}

/// Extent of a side along an axis; `None` of a plane.
fn length(model: &Model, side: &ContactSurface, axis: usize) -> Option<f64> {
    let [low, high] = match side {
        ContactSurface::Itself => return Some(0.0),
        ContactSurface::Deformable { body, .. } => extent(&model.bodies[body.0].mesh),
        ContactSurface::Rigid(rigid) => match &model.rigid_surfaces[rigid.0].shape {
            RigidShape::Facets { positions, .. } => box_of(positions),
            RigidShape::Plane { .. } | RigidShape::Bare => return None,
        },
    };
    Some((high - low)[axis])
}

/// Axes along which a body is pressed or pulled; along contact surfaces it may slide far.
fn crossing(model: &Model, id: BodyId, body: &Body) -> [bool; 3] {
    let sides = model.pairs.iter().flat_map(|pair| [&pair.a, &pair.b]);
    let faces = sides.filter_map(|side| match side {
        ContactSurface::Deformable { body, faces } if *body == id => Some(faces),
        _ => None,
    });
    let mut normals = faces
        .flatten()
        .map(|face| body.mesh.area_vector(*face).normalize())
        .peekable();
    let free = normals.peek().is_none();
    normals.fold([free; 3], |crossing, normal| {
        [0, 1, 2].map(|axis| crossing[axis] || normal[axis].abs() > ALONG)
    })
}

/// Waves that do not get through one element in a whole step.
fn waves(body: &Body, step: &Step, advice: &mut Advice) {
    if step.procedure == Procedure::QuasiStatic {
        return;
    }
    let longest = body.mesh.quality().longest_edge;
    for part in Part::all(body) {
        let speed = (part.youngs_modulus() / part.density).sqrt();
        let way = speed * step.duration;
        if part.density > 0.0 && way < longest {
            advice.warn(
                Topic::Units,
                &body.name,
                format!(
                    "{}: with Young's modulus {} and density {} waves travel at {speed}, and in the {} of step `{}` they cover {way}, less than an element of {longest}; are densities, moduli and times in one system of units, such as t/mm^3, MPa and s?",
                    part.name,
                    significant(part.youngs_modulus(), 4),
                    significant(part.density, 4),
                    step.duration,
                    step.name,
        speed = significant(speed, 2), way = significant(way, 2), longest = significant(longest, 2)),
            );
        }
    }
}

/// Forces and torques on coordinates of rigid bodies that are not free, of the same step or of an
/// earlier one, whose loads go on.
fn held(model: &Model, advice: &mut Advice) {
    let mut free = vec![[false; 6]; model.rigid_surfaces.len()];
    let mut loads = vec![[0.0; 6]; model.rigid_surfaces.len()];
    for step in &model.steps {
        for motion in &step.rigid_motions {
            let at = motion.surface.0;
            let (free, loads) = (&mut free[at], &mut loads[at]);
            let was_free = *free;
            for (coordinate, free) in motion.coordinates.iter().zip(free.iter_mut()) {
                match coordinate {
                    Freedom::Free => *free = true,
                    Freedom::To(_) => *free = false,
                    Freedom::AsBefore => {}
                }
            }
            let stated = drive(motion, loads);
            let is_idle = |at: &usize| !free[*at] && loads[*at] != 0.0;
            let name = &model.rigid_surfaces[at].name;
            let idle = (0..6).filter(is_idle).filter(|at| stated[*at]);
            if let Some([along, remedy]) = listed(idle) {
                advice.warn(
                    Topic::Hold,
                    name,
                    format!(
                        "step `{}` drives `{name}` along {along}, where it is held, so this has no effect; add `free = [{remedy}]`",
                        step.name
                    ),
                );
            }
            let idle = (0..6).filter(is_idle).filter(|at| !stated[*at]);
            if let Some([along, remedy]) = listed(idle.filter(|at| was_free[*at])) {
                advice.warn(
                    Topic::Hold,
                    name,
                    format!(
                        "step `{}` holds `{name}` along {along}, where the load of an earlier step goes on and now has no effect; add `free = [{remedy}]`, or end the load with `force` or `torque`",
                        step.name
                    ),
                );
            }
        }
    }
}

/// Coordinates in a sentence and in a list of a deck; `None` if there are none.
fn listed(coordinates: impl Iterator<Item = usize>) -> Option<[String; 2]> {
    let words: Vec<&str> = coordinates.map(|at| COORDINATES[at]).collect();
    let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    (!words.is_empty()).then(|| [words.join(" and "), quoted.join(", ")])
}

/// Sets the loads that a step states, and returns on which coordinates it states one.
fn drive(motion: &RigidMotion, loads: &mut [f64; 6]) -> [bool; 6] {
    let stated = [motion.force, motion.torque];
    for (loads, stated) in loads.chunks_mut(3).zip(stated) {
        if let Some(stated) = stated {
            loads.copy_from_slice(stated.as_slice());
        }
    }
    std::array::from_fn(|at| stated[at / 3].is_some())
}
