//! Bodies and rigid bodies that contact can only push away.
//!
//! Contact pushes and never pulls. Where all contact surfaces of a body push it the same way
//! along an axis, no node is prescribed along that axis and the loads do not push it back, no
//! quasi-static equilibrium with a contact force exists: the body flies off. The first step is
//! judged, in which nothing has been pressed together yet.
//!
//! ```text
//! d_j > mu |d - d_j e_j| for the push d = -n of every facet,  f_j >= 0  ->  pushed away along +j
//! ```
//!
//! With friction, forces lie in a cone about `d`: a block stands on a rough slope.

use striae_mesh::{Face, Mesh, NodeId, Vec3};
use striae_solve::model::{
    BodyId, ContactSurface, Freedom, LoadExtent, LoadKind, Mover, NodalForce, Pair, Procedure,
    RigidId, Step,
};

use super::{Draft, List, hold};
use crate::{fault::FaultKind, path::Path};

/// Component of a push that counts as zero.
const ACROSS: f64 = 0.17;
/// Friction over pressure at most, in multiples of the largest coefficient at rest.
const LARGEST: f64 = 3.0;

/// Notes every body, or piece of one, that can only be pushed away in the first step.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    let Some(step) = draft.steps.first().map(|of| of.step) else {
        return;
    };
    if step.procedure != Procedure::QuasiStatic {
        return;
    }
    for index in 0..draft.bodies.len() {
        if !hold::is_sprung(draft, Mover::Deformable(BodyId(index))) {
            of_body(draft, step, BodyId(index), faults);
        }
    }
    for (index, rigid) in draft.rigid_surfaces.iter().enumerate() {
        let is_sprung = hold::is_sprung(draft, Mover::Rigid(RigidId(index)));
        if rigid.part.is_some_and(|rigid| rigid.ties.is_empty()) && !is_sprung {
            of_rigid(draft, step, RigidId(index), faults);
        }
    }
}

/// Contact of one body: by pair the area vectors of its facets, outward of the body.
struct Contact<'a> {
    pairs: Vec<(&'a Pair, Vec<Vec3>)>,
}

impl Contact<'_> {
    /// Sign of the pushes along an axis where all have the same, and nothing bridges a gap.
    fn sign(&self, axis: usize) -> Option<f64> {
        let along = |v: &Vec3| -v[axis] / v.norm();
        let pushes = self.pairs.iter().flat_map(|(pair, areas)| {
            let coefficient = pair.friction.coefficient();
            let factors = [
                coefficient.by_pressure().largest_factor(),
                coefficient.by_slip().largest_factor(),
            ];
            let mu = LARGEST * coefficient.at_rest() * factors.iter().product::<f64>();
            areas.iter().map(move |area| (along(area), mu))
        });
        let mut pushes = pushes.peekable();
        let sign = pushes.peek()?.0.signum();
        let bridged = self.pairs.iter().any(|(pair, _)| pair.stabilised);
        let beyond = |(push, mu): (f64, f64)| {
            let across = (1.0 - push * push).max(0.0).sqrt();
            push * sign > ACROSS.max(mu * across)
        };
        (!bridged && pushes.all(beyond)).then_some(sign)
    }

    /// The fault that the mover is pushed along an axis, unless a force holds it.
    fn pushed(&self, mover: &str, step: &Step, axis: usize, force: f64) -> Option<FaultKind> {
        let sign = self.sign(axis)?;
        let load = force * sign;
        if load < 0.0 {
            return None;
        }
        Some(FaultKind::PushedAway {
            mover: mover.to_owned(),
            direction: format!(
                "{}{}",
                if sign > 0.0 { '+' } else { '-' },
                ["x", "y", "z"][axis]
            ),
            step: step.name.clone(),
            load,
            pairs: self
                .pairs
                .iter()
                .map(|(pair, _)| pair.name.clone())
                .collect(),
        })
    }
}

fn of_body(draft: &Draft<'_>, step: &Step, body: BodyId, faults: &mut List) {
    let of = &draft.bodies[body.0];
    // Loads that turn, vary, or act on what is exposed, have no force that is known before a run.
    let uncertain = step.loads.iter().any(|load| {
        let turns = matches!(load.kind, LoadKind::FollowerTraction(_));
        let varies = load.kind.numbers().is_none();
        load.body == body && (turns || varies || load.extent != LoadExtent::Whole)
    });
    let uncertain = uncertain || !step.fillings.is_empty();
    let uncertain = uncertain || step.forces.iter().any(|of| of.body == body && varies(of));
    let Some(mesh) = of
        .mesh
        .filter(|_| !uncertain && !hold::is_tied(draft, body))
    else {
        return;
    };
    let mut prescribed = hold::Held::new();
    hold::prescribe(&mut prescribed, step, (body, mesh));
    let pieces = mesh.pieces();
    for piece in &pieces {
        let own = |face: &Face| piece.binary_search(&mesh.face_nodes(*face)[0]).is_ok();
        let contact = contact_of(draft, body, mesh, &own);
        let held = |axis: usize| {
            let along = |(_, e): &(usize, Vec3)| e[axis].abs() > ACROSS;
            let mut held = prescribed.iter().filter(|(_, held)| held.iter().any(along));
            held.any(|(node, _)| piece.binary_search(node).is_ok())
        };
        let part = piece.len() as f64 / mesh.positions.len() as f64;
        let force = force(draft, step, (body, mesh), piece, (&own, part));
        let mover = match pieces.len() {
            1 => format!("body `{}`", of.name),
            count => format!(
                "the piece with {} of body `{}`, which is made of {count} pieces that share no nodes (merge coincident nodes in the mesh if they belong together),",
                piece[0], of.name
            ),
        };
        let axes = (0..3).filter(|axis| !held(*axis));
        let mut found = axes.filter_map(|axis| contact.pushed(&mover, step, axis, force[axis]));
        if let Some(kind) = found.next() {
            faults.push(Path::part("steps", 0), kind);
        }
    }
}

fn contact_of<'a>(
    draft: &Draft<'a>,
    body: BodyId,
    mesh: &Mesh,
    own: &dyn Fn(&Face) -> bool,
) -> Contact<'a> {
    let areas = |side: &ContactSurface| -> Vec<Vec3> {
        match side {
            ContactSurface::Deformable { body: of, faces } if *of == body => {
                let faces = faces.iter().filter(|face| own(face));
                faces.map(|face| mesh.area_vector(*face)).collect()
            }
            _ => Vec::new(),
        }
    };
    let pairs = draft.pairs.iter().filter_map(|pair| pair.pair);
    // A body does not push itself anywhere.
    let pairs = pairs.filter(|pair| !pair.is_within_a_body());
    let pairs = pairs.map(|pair| (pair, [areas(&pair.a), areas(&pair.b)].concat()));
    Contact {
        pairs: pairs.filter(|(_, areas)| !areas.is_empty()).collect(),
    }
}

fn varies(force: &NodalForce) -> bool {
    force
        .force
        .iter()
        .any(|component| component.number().is_none())
}

/// Force of loads and gravity on a part of a body at the end of the step.
fn force(
    draft: &Draft<'_>,
    step: &Step,
    (body, mesh): (BodyId, &Mesh),
    piece: &[NodeId],
    (own, part): (&dyn Fn(&Face) -> bool, f64),
) -> Vec3 {
    let mut force = Vec3::zeros();
    for of in step.forces.iter().filter(|of| of.body == body) {
        let nodes = of
            .nodes
            .iter()
            .filter(|node| piece.binary_search(node).is_ok());
        let each = of.force.map(|component| component.number().unwrap_or(0.0));
        force += each * nodes.count() as f64;
    }
    for load in step.loads.iter().filter(|load| load.body == body) {
        for face in load.faces.iter().filter(|face| own(face)) {
            let area = mesh.area_vector(*face);
            force += match load.kind.numbers() {
                Some(LoadKind::DeadTraction(t) | LoadKind::FollowerTraction(t)) => t * area.norm(),
                Some(LoadKind::Pressure(pressure)) => area * -pressure,
                None => Vec3::zeros(),
            };
        }
    }
    if let Some(gravity) = &step.gravity {
        let of = &draft.bodies[body.0];
        let sections = of.sections.iter().map(|section| section.density);
        let density = of.density.into_iter().chain(sections).fold(0.0, f64::max);
        force += gravity.acceleration * density * mesh.volume() * part;
    }
    force
}

fn of_rigid(draft: &Draft<'_>, step: &Step, rigid: RigidId, faults: &mut List) {
    let mut motions = step.rigid_motions.iter();
    let Some(motion) = motions.find(|motion| motion.surface == rigid) else {
        return;
    };
    let contact = contact_on(draft, rigid);
    let mover = format!("rigid body `{}`", draft.rigid_surfaces[rigid.0].name);
    let mass = draft.rigid_surfaces[rigid.0].part.and_then(|of| of.inertia);
    let weight = step.gravity.as_ref().zip(mass);
    let weight = weight.map_or(Vec3::zeros(), |(gravity, inertia)| {
        gravity.acceleration * inertia.mass
    });
    let force = motion.force.unwrap_or_else(Vec3::zeros) + weight;
    let free = (0..3).filter(|axis| motion.coordinates[*axis] == Freedom::Free);
    let mut found = free.filter_map(|axis| contact.pushed(&mover, step, axis, force[axis]));
    if let Some(kind) = found.next() {
        faults.push(Path::part("steps", 0), kind);
    }
}

/// Contact on a rigid body, by the opposite of the area vectors of what touches it.
fn contact_on<'a>(draft: &Draft<'a>, rigid: RigidId) -> Contact<'a> {
    let is = |side: &ContactSurface| matches!(side, ContactSurface::Rigid(of) if *of == rigid);
    let opposite = |side: &ContactSurface| -> Vec<Vec3> {
        let ContactSurface::Deformable { body, faces } = side else {
            return Vec::new();
        };
        let Some(mesh) = draft.bodies[body.0].mesh else {
            return Vec::new();
        };
        faces.iter().map(|face| -mesh.area_vector(*face)).collect()
    };
    let pairs = draft.pairs.iter().filter_map(|pair| pair.pair);
    let pairs = pairs.filter_map(|pair| match (is(&pair.a), is(&pair.b)) {
        (true, _) => Some((pair, opposite(&pair.b))),
        (_, true) => Some((pair, opposite(&pair.a))),
        _ => None,
    });
    Contact {
        pairs: pairs.collect(),
    }
}
