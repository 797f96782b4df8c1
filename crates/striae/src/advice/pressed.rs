//! Bodies that a step would press to nothing, and pairs that it moves apart.
//!
//! A body of height `h` along the normal `n` of its contact surface, whose nodes are moved by
//! `u` against a surface at a distance `g`, is left with
//!
//! ```text
//! h - (u . n - g)
//! ```
//!
//! Loads beside what is prescribed strain a body by about their sum over its cross section and
//! modulus; where the sides go apart by far more than that, they stay apart.

use striae_contact::initial::Fit;
use striae_mesh::{NodeId, Vec3, significant};
use striae_model::{
    Body, BodyId, Cavity, ContactSurface, Freedom, LoadKind, Model, Pair, Procedure, RigidId, Step,
};

use super::{
    Advice, Topic,
    fit::area_vectors,
    parts::{Part, moduli},
};

/// Length of the sum of area vectors over the area from which on a surface has a normal.
const NORMAL: f64 = 0.7;
/// Part of the height by which pressing is worth a note, and a warning.
const PRESSED: [f64; 2] = [0.5, 1.0];
/// Part of the extent of a body over which nodes are prescribed that press it.
const SPREAD: f64 = 0.5;
/// Ratio of the motion to the height that counts as zero.
const NO_WAY: f64 = 1e-9;
/// Deformation under loads, as bending and thin places may have, over that of a bar.
const SOFTER: f64 = 10.0;

/// Notes bodies that lose much of their height.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    for (pair, fit) in model.pairs.iter().zip(fits) {
        let ways: Vec<Way> = model
            .steps
            .iter()
            .filter_map(|step| Way::of(model, pair, step))
            .collect();
        let Some(fit) = fit else { continue };
        pressed(pair, fit, &ways, advice);
        apart(model, pair, &ways, advice);
    }
}

/// Approach of the sides of a pair in a step.
struct Way<'m> {
    step: &'m Step,
    /// Names of the two sides.
    names: [&'m str; 2],
    /// Way towards each other along the normal.
    towards: f64,
    /// Height that can be pressed.
    height: f64,
    /// Largest deformation of the bodies towards each other by loads.
    give: f64,
}

/// Motion along a direction.
#[derive(Clone, Copy)]
struct Motion {
    prescribed: f64,
    give: f64,
}

impl<'m> Way<'m> {
    fn of(model: &'m Model, pair: &Pair, step: &'m Step) -> Option<Self> {
        let ContactSurface::Deformable { body, .. } = &pair.a else {
            return None;
        };
        let vectors = area_vectors(model, &pair.a);
        let sum: Vec3 = vectors.iter().sum();
        let area: f64 = vectors.iter().map(Vec3::norm).sum();
        if area.is_nan() || sum.norm() <= NORMAL * area {
            return None;
        }
        let n = sum.normalize();
        let (own, other) = (of_body(model, *body, step, &n), &pair.b);
        let (own, mut height) = (own?, height(model, *body, &n));
        let (opposite, name) = if let ContactSurface::Deformable { body, .. } = other {
            height += self::height(model, *body, &n);
            let name = &model.bodies[body.0].name;
            (of_body(model, *body, step, &n)?, name)
        } else if let ContactSurface::Rigid(rigid) = other {
            let name = &model.rigid_surfaces[rigid.0].name;
            let prescribed = of_rigid(step, *rigid, &n)?;
            let give = 0.0;
            (Motion { prescribed, give }, name)
        } else {
            return None;
        };
        Some(Self {
            step,
            names: [&model.bodies[body.0].name, name],
            towards: own.prescribed - opposite.prescribed,
            height,
            give: own.give + opposite.give,
        })
    }
}

/// Extent of a body along a direction.
fn height(model: &Model, body: BodyId, n: &Vec3) -> f64 {
    let positions = model.bodies[body.0].mesh.positions.iter();
    let along = positions.map(|x| x.dot(n));
    let [low, high] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
        [low.min(at), high.max(at)]
    });
    high - low
}

/// The farthest that prescribed nodes of a body go along a direction; `None` where ties, inertia,
/// a cavity or, without such nodes, loads may move the body as well.
fn of_body(model: &Model, body: BodyId, step: &Step, n: &Vec3) -> Option<Motion> {
    let tied = model.ties.iter().any(|tie| tie.joins(body));
    let rigid = model.rigid_surfaces.iter();
    let tied = tied
        || rigid
            .flat_map(|rigid| &rigid.ties)
            .any(|(of, _)| *of == body);
    let in_cavity = |of: &Cavity| of.parts.iter().any(|(of, _)| *of == body);
    let filled = model.cavities.iter().any(in_cavity);
    let give = give(model, body, step, n)?;
    if tied || filled || step.procedure != Procedure::QuasiStatic {
        return None;
    }
    let conditions = step.displacements.iter().filter(|of| of.body == body);
    let conditions = conditions.filter(|of| spreads(model, body, &of.nodes, n));
    let along = |axis: usize| n[axis].abs() > NORMAL;
    let ways = conditions.filter_map(|of| {
        if !of.axes.are_global() {
            return Some(of.way(&model.bodies[body.0].mesh).dot(n));
        }
        let axis = (0..3).find(|axis| along(*axis) && of.components[*axis].is_some())?;
        Some(of.numbers()[axis]? * n[axis])
    });
    let farthest = ways.max_by(|a, b| a.abs().total_cmp(&b.abs()));
    let prescribed = farthest.or((give == 0.0).then_some(0.0))?;
    Some(Motion { prescribed, give })
}

/// Estimate from above of the deformation of a body by the loads of the steps up to one; `None`
/// where they are not known.
fn give(model: &Model, body: BodyId, step: &Step, n: &Vec3) -> Option<f64> {
    let Body { mesh, .. } = &model.bodies[body.0];
    let steps = || {
        let last = model
            .steps
            .iter()
            .position(|other| std::ptr::eq(other, step));
        model.steps.iter().take(last.map_or(0, |last| last + 1))
    };
    let mut force = 0.0;
    for load in steps()
        .flat_map(|step| &step.loads)
        .filter(|of| of.body == body)
    {
        let size = match load.kind.numbers()? {
            LoadKind::DeadTraction(t) | LoadKind::FollowerTraction(t) => t.norm(),
            LoadKind::Pressure(p) => p.abs(),
        };
        let areas = load.faces.iter().map(|face| mesh.area_vector(*face).norm());
        force += size * areas.sum::<f64>();
    }
    for of in steps()
        .flat_map(|step| &step.forces)
        .filter(|of| of.body == body)
    {
        let [x, y, z] = [0, 1, 2].map(|axis| of.force[axis].number());
        force += Vec3::new(x?, y?, z?).norm() * of.nodes.len() as f64;
    }
    let parts = Part::all(&model.bodies[body.0]).into_iter();
    let density = parts.map(|part| part.density);
    let weight = density.fold(0.0, f64::max) * mesh.volume();
    let gravity = steps().filter_map(|step| step.gravity.as_ref());
    force += gravity.map(|of| of.acceleration.norm()).fold(0.0, f64::max) * weight;
    let height = height(model, body, n);
    let section = mesh.volume() / height;
    let [soft, _] = moduli(&model.bodies[body.0]);
    Some(SOFTER * force * height / (section * soft))
}

/// True where nodes extend over much of a body across a direction; what is held at its ends is
/// bent, not pressed.
fn spreads(model: &Model, body: BodyId, nodes: &[NodeId], n: &Vec3) -> bool {
    let positions = &model.bodies[body.0].mesh.positions;
    let mut across = (0..3).filter(|axis| n[*axis].abs() <= NORMAL);
    across.all(|axis| {
        let extent = |all: &mut dyn Iterator<Item = &Vec3>| {
            let start = [f64::INFINITY, f64::NEG_INFINITY];
            let [low, high] = all.fold(start, |[low, high], x| {
                [low.min(x[axis]), high.max(x[axis])]
            });
            high - low
        };
        let own = extent(&mut nodes.iter().map(|node| &positions[node.index()]));
        own >= SPREAD * extent(&mut positions.iter())
    })
}

/// Returns the way of a rigid surface along a direction; `None` where it is free or turns.
fn of_rigid(step: &Step, rigid: RigidId, n: &Vec3) -> Option<f64> {
    let mut way = Vec3::zeros();
    for motion in step.rigid_motions.iter().filter(|of| of.surface == rigid) {
        for (at, coordinate) in motion.coordinates.iter().enumerate() {
            match coordinate {
                Freedom::AsBefore => {}
                Freedom::To(target) if at < 3 => way[at] = *target,
                Freedom::To(angle) if *angle == 0.0 => {}
                Freedom::To(_) | Freedom::Free => return None,
            }
        }
    }
    Some(way.dot(n))
}

fn pressed(pair: &Pair, fit: &Fit, ways: &[Way], advice: &mut Advice) {
    let gap = fit
        .gap
        .as_ref()
        .map_or(fit.distance, |gap| gap.gap)
        .max(0.0);
    let share = |way: &Way| (way.towards - gap) / way.height;
    let unloaded = ways.iter().filter(|way| way.give == 0.0);
    let Some(way) = unloaded.max_by(|a, b| share(a).total_cmp(&share(b))) else {
        return;
    };
    let [a, b] = way.names;
    let is_told = advice.warnings.iter().any(|warning| {
        let name = warning.name.as_deref();
        warning.topic == Topic::Units && (name == Some(a) || name == Some(b))
    });
    if is_told {
        return;
    }
    let text = format!(
        "pair `{}`: step `{}` moves `{a}` and `{b}` by {} towards each other, from a gap of {gap}, and the material pressed between them is {} high",
        pair.name,
        way.step.name,
        significant(way.towards, 4),
        significant(way.height, 4),
        gap = significant(gap, 4)
    );
    if share(way) >= PRESSED[1] {
        let text = format!(
            "{text}: it would be crushed completely; reduce the displacement, and compare the units of mesh and displacements"
        );
        advice.warn(Topic::Units, &pair.name, text);
    } else if share(way) > PRESSED[0] {
        advice.note(Topic::Fit, &pair.name, text);
    }
}

/// Warns of sides that all steps only move apart.
fn apart(model: &Model, pair: &Pair, ways: &[Way], advice: &mut Advice) {
    let none = |way: &Way| NO_WAY * way.height;
    let never = ways.iter().all(|way| way.towards + way.give <= none(way));
    let leaves = ways.iter().find(|way| way.towards + way.give < -none(way));
    let meant = pair.interference.is_some() || model.steps.len() > ways.len();
    let is_told = advice.warns_of(&pair.name, &[Topic::NeverMeets, Topic::Facing]);
    if let Some(way) = leaves.filter(|_| never && !meant && !is_told) {
        let [a, b] = way.names;
        let text = format!(
            "pair `{}`: step `{}` moves `{a}` and `{b}` apart by {}, and no step moves them together, so their contact has no force; is the sign of the displacement right?",
            pair.name,
            way.step.name,
            significant(-way.towards, 4)
        );
        advice.warn(Topic::NeverMeets, &pair.name, text);
    }
}
