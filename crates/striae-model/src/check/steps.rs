//! Checks of what each step states: increments, loads, velocities, motions and friction.

use crate::{
    fault::FaultKind,
    model::{Load, LoadKind, Moment, Mover, Procedure, Step},
    path::Path,
};

use super::{Draft, Known, List, Positions, actuations, conditions, functions, pairs};

/// Notes faults within steps; returns those that are not whole.
pub(super) fn check(draft: &Draft<'_>, impossible: &Positions, faults: &mut List) -> Positions {
    let mut partial = Positions::new();
    let mut history = conditions::History::new(draft);
    let mut time = 0.0;
    let mut reached = actuations::Reached::default();
    for (index, of) in draft.steps.iter().enumerate() {
        let (step, path) = (of.step, Path::part("steps", index));
        increments(step, &path, faults);
        conditions::releases(draft, step, &path, &mut history, faults);
        let known = conditions::displacements(draft, of, &path, &mut history, faults);
        loads(draft, step, &path, faults);
        forces(draft, step, &path, faults);
        let start = Moment {
            time,
            ..Moment::start(step.duration)
        };
        time = start.later(1.0).time;
        actuations::check(draft, (step, start), &path, &mut reached, faults);
        functions::of_step(draft, (step, start), &path, faults);
        velocities(draft, step, &path, faults);
        rigid_motions(draft, step, &path, faults);
        frictions(draft, step, impossible, &path, faults);
        if known == Known::InPart || of.known == Known::InPart {
            partial.insert(index);
        }
    }
    partial
}

fn increments(step: &Step, path: &Path, faults: &mut List) {
    let sizes = step.increments;
    if !(sizes.smallest <= sizes.initial && sizes.initial <= sizes.largest) {
        let kind = FaultKind::IncrementOrder {
            step: step.name.clone(),
            smallest: sizes.smallest,
            initial: sizes.initial,
            largest: sizes.largest,
        };
        faults.push(path.clone().field("increments"), kind);
    }
}

fn twice(step: &Step, what: String) -> FaultKind {
    FaultKind::StatedTwice {
        step: step.name.clone(),
        what,
    }
}

fn loads(draft: &Draft<'_>, step: &Step, path: &Path, faults: &mut List) {
    for (index, load) in step.loads.iter().enumerate() {
        let same = |other: &&Load| {
            other.body == load.body && other.set == load.set && other.kind.is_like(&load.kind)
        };
        if step.loads[..index].iter().any(|other| same(&other)) {
            let kind = match load.kind {
                LoadKind::DeadTraction(_) => "dead traction",
                LoadKind::FollowerTraction(_) => "follower traction",
                LoadKind::Pressure(_) => "pressure",
            };
            let (set, body) = (&load.set, draft.bodies[load.body.0].name);
            let what = format!("the {kind} on `{set}` of body `{body}`");
            faults.push(path.clone().field("loads").index(index), twice(step, what));
        }
    }
}

fn forces(draft: &Draft<'_>, step: &Step, path: &Path, faults: &mut List) {
    for (index, force) in step.forces.iter().enumerate() {
        let mut earlier = step.forces[..index].iter();
        if earlier.any(|other| other.body == force.body && other.set == force.set) {
            let (set, body) = (&force.set, draft.bodies[force.body.0].name);
            let what = format!("the force at `{set}` of body `{body}`");
            faults.push(path.clone().field("forces").index(index), twice(step, what));
        }
    }
}

fn velocities(draft: &Draft<'_>, step: &Step, path: &Path, faults: &mut List) {
    for (index, velocity) in step.velocities.iter().enumerate() {
        let path = path.clone().field("velocities").index(index);
        if step.procedure == Procedure::QuasiStatic {
            let step = step.name.clone();
            faults.push(path.clone(), FaultKind::VelocityWithoutInertia { step });
        }
        let mut earlier = step.velocities[..index].iter();
        if earlier.any(|other| other.body == velocity.body) {
            let name = match velocity.body {
                Mover::Deformable(body) => format!("body `{}`", draft.bodies[body.0].name),
                Mover::Rigid(rigid) => {
                    format!("rigid body `{}`", draft.rigid_surfaces[rigid.0].name)
                }
            };
            faults.push(path, twice(step, format!("the velocity of {name}")));
        }
    }
}

fn rigid_motions(draft: &Draft<'_>, step: &Step, path: &Path, faults: &mut List) {
    for (index, motion) in step.rigid_motions.iter().enumerate() {
        let mut earlier = step.rigid_motions[..index].iter();
        if earlier.any(|other| other.surface == motion.surface) {
            let name = draft.rigid_surfaces[motion.surface.0].name;
            let what = format!("the motion of rigid body `{name}`");
            let path = path.clone().field("rigid_motions").index(index);
            faults.push(path, twice(step, what));
        }
    }
}

fn frictions(
    draft: &Draft<'_>,
    step: &Step,
    impossible: &Positions,
    path: &Path,
    faults: &mut List,
) {
    for (index, (pair, friction)) in step.frictions.iter().enumerate() {
        let path = path.clone().field("frictions").index(index);
        let named = &draft.pairs[pair.0];
        let mut earlier = step.frictions[..index].iter();
        if earlier.any(|(other, _)| other == pair) {
            let what = format!("the friction of pair `{}`", named.name);
            faults.push(path.clone(), twice(step, what));
        }
        if !impossible.contains(&pair.0)
            && let Some(kind) = pairs::textures(named, friction)
        {
            faults.push(path, kind);
        }
    }
}
