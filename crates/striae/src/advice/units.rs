//! Test of whether moduli, sizes, loads and densities can be in one system of units.
//!
//! A load `t` on a body of modulus `E` strains it by about `t/E`; strains below 1e-8 or above 1 are
//! hardly intended. Solids have moduli up to about 1.2e12 Pa, which is 1.2e6 MPa and 1.7e8 psi: a
//! modulus above 2e8 is in pascals or the like, so lengths are in metres. Waves travel at
//! `sqrt(E/rho)`, in no solid faster than 2e4 m/s = 2e7 mm/s.

use striae_mesh::{Vec3, significant};
use striae_model::{Body, BodyId, ContactSurface, LoadKind, Model, RigidId};

use super::{
    Advice, Topic,
    parts::{Part, moduli},
    shape::extent,
};

/// Strain by loads that is too small to be meant.
const NO_STRAIN: f64 = 1e-8;
/// Corresponding limit for a force divided by the square of the size, which is only an estimate.
const NO_STRAIN_BY_FORCE: f64 = 1e-11;
/// Moduli between these are in pascals.
const PASCALS: [f64; 2] = [2e8, 2e12];
/// Smallest modulus of soft matter that is in pascals.
const SOFT: f64 = 1e5;
/// Length for soft matter, beside moduli in pascals.
const LONG_SOFT: f64 = 5.0;
/// Moduli of metals in megapascals.
const METALS: [f64; 2] = [3e4, 4.5e5];
/// Extent from which on lengths beside such moduli look like millimetres.
const LONG: f64 = 20.0;
/// Speed of waves that no solid has in any usual system of units.
const FASTEST: f64 = 1e8;

/// Warns of bodies whose numbers do not go together.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    for (index, body) in model.bodies.iter().enumerate() {
        let moduli = moduli(body);
        loads(model, BodyId(index), moduli, advice);
        forces(model, BodyId(index), moduli[0], advice);
        nodal(model, BodyId(index), moduli[1], advice);
        lengths(body, moduli[1], advice);
        soft(body, moduli, advice);
        for part in Part::all(body) {
            waves(body, &part, advice);
        }
    }
}

/// Loads beside the smallest and the largest Young's modulus of a body.
fn loads(model: &Model, body: BodyId, [soft, stiff]: [f64; 2], advice: &mut Advice) {
    let loads = model.steps.iter().flat_map(|step| &step.loads);
    let largest = loads
        .filter(|load| load.body == body)
        .filter_map(|load| load.kind.numbers())
        .map(|kind| match kind {
            LoadKind::DeadTraction(t) | LoadKind::FollowerTraction(t) => t.norm(),
            LoadKind::Pressure(p) => p.abs(),
        })
        .fold(0.0, f64::max);
    let name = &model.bodies[body.0].name;
    let about = |modulus: f64| {
        let strain = largest / modulus;
        format!(
            "body `{name}`: its largest load, {largest}, over its Young's modulus, {modulus}, is a strain of {strain}",
            largest = significant(largest, 4),
            modulus = significant(modulus, 4),
            strain = significant(strain, 2)
        )
    };
    if largest > 0.0 && largest / soft < NO_STRAIN {
        advice.warn(
            Topic::Units,
            name,
            format!(
                "{}, which is hardly any; are both in one system of units, such as N, mm and MPa, or N, m and Pa?",
                about(soft)
            ),
        );
    } else if largest / stiff > 1.0 {
        let about = about(stiff);
        advice.warn(
            Topic::Units,
            name,
            format!("{about}: it would be crushed or torn; are both in one system of units?"),
        );
    }
}

/// Forces on rigid bodies that press on a body or are tied to it.
fn forces(model: &Model, body: BodyId, modulus: f64, advice: &mut Advice) {
    let motions = model.steps.iter().flat_map(|step| &step.rigid_motions);
    let forces = motions.filter(|motion| meets(model, motion.surface, body));
    let forces = forces.filter_map(|motion| motion.force.map(|force| force.norm()));
    let largest = forces.fold(0.0, f64::max);
    let Body { name, mesh, .. } = &model.bodies[body.0];
    let [low, high] = extent(mesh);
    let size = (high - low).norm();
    let strain = largest / (modulus * size * size);
    if largest > 0.0 && strain < NO_STRAIN_BY_FORCE {
        advice.warn(
            Topic::Units,
            name,
            format!(
                "body `{name}`: the largest force that drives the bodies it meets, {largest}, hardly strains a body of size {size} and Young's modulus {modulus} (by about {strain}); are they in one system of units?",
        largest = significant(largest, 4), size = significant(size, 4), modulus = significant(modulus, 4), strain = significant(strain, 2)),
        );
    }
}

/// Forces at nodes beside the largest section that a body can have.
fn nodal(model: &Model, body: BodyId, stiff: f64, advice: &mut Advice) {
    let forces = model.steps.iter().flat_map(|step| &step.forces);
    let forces = forces.filter(|force| force.body == body).map(|force| {
        let each = [0, 1, 2].map(|axis| force.force[axis].number().unwrap_or(0.0));
        Vec3::from(each).norm() * force.nodes.len() as f64
    });
    let largest = forces.fold(0.0, f64::max);
    let Body { name, mesh, .. } = &model.bodies[body.0];
    let [low, high] = extent(mesh);
    let [x, y, z]: [f64; 3] = (high - low).into();
    let section = (x * y).max(y * z).max(z * x);
    let strain = largest / (section * stiff);
    if strain > 1.0 {
        advice.warn(
            Topic::Units,
            name,
            format!(
                "body `{name}`: its largest force at nodes, {largest}, over its largest section, {section}, and its Young's modulus, {stiff}, is a strain of {strain}: it would be crushed or torn; are they in one system of units?",
        largest = significant(largest, 4), section = significant(section, 4), stiff = significant(stiff, 4), strain = significant(strain, 2)),
        );
    }
}

fn meets(model: &Model, rigid: RigidId, body: BodyId) -> bool {
    let is_body = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body: of, .. } if *of == body);
    let is_rigid =
        |side: &ContactSurface| matches!(side, ContactSurface::Rigid(of) if *of == rigid);
    let mut pairs = model.pairs.iter();
    let mut ties = model.rigid_surfaces[rigid.0].ties.iter();
    pairs.any(|pair| is_body(&pair.a) && is_rigid(&pair.b)) || ties.any(|(of, _)| *of == body)
}

fn lengths(body: &Body, modulus: f64, advice: &mut Advice) {
    let [low, high] = extent(&body.mesh);
    let longest = (high - low).max();
    let name = &body.name;
    if modulus > PASCALS[0] && modulus < PASCALS[1] && longest >= LONG {
        advice.warn(
            Topic::Units,
            name,
            format!(
                "body `{name}`: a Young's modulus of {modulus} must be in pascals, so lengths are in metres, and it would be {longest} m long; with lengths in mm, moduli and pressures are in MPa",
        modulus = significant(modulus, 4), longest = significant(longest, 4)),
        );
    }
}

/// Bodies of soft matter, whose modulus in pascals looks like one in megapascals.
fn soft(body: &Body, [least, most]: [f64; 2], advice: &mut Advice) {
    let [low, high] = extent(&body.mesh);
    let longest = (high - low).max();
    let name = &body.name;
    // Metals in MPa lie between, and are long in mm.
    let is_metal = METALS[0] <= least && most <= METALS[1];
    if SOFT <= least && most < PASCALS[0] && longest >= LONG_SOFT && !is_metal {
        advice.note(
            Topic::Units,
            name,
            format!(
                "body `{name}`: if its Young's modulus of {most} is in pascals, lengths are in metres, and it is {longest} m long; with lengths in mm, moduli and pressures are in MPa",
        most = significant(most, 4), longest = significant(longest, 4)),
        );
    }
}

fn waves(body: &Body, part: &Part, advice: &mut Advice) {
    let (about, name) = (&part.name, &body.name);
    let (modulus, density) = (part.youngs_modulus(), part.density);
    let speed = (modulus / density).sqrt();
    if density > 0.0 && speed > FASTEST {
        advice.warn(
            Topic::Units,
            name,
            format!(
                "{about}: with Young's modulus {modulus} and density {density} waves would travel at {speed}, faster than in any solid; with N, mm and s densities are in t/mm^3 and moduli in MPa",
        modulus = significant(modulus, 4), density = significant(density, 4), speed = significant(speed, 2)),
        );
    }
}
