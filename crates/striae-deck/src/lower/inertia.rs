//! Inertia and gravity of a step.

use super::{Parts, Scope, list};
use crate::{fault::FaultKind, faults::FaultList, raw, read::At, value::vector};
use striae_mesh::Vec3;
use striae_solve::model::{Gravity, Mover, Procedure, RigidId, Step, Velocity};

const SPECTRAL_RADIUS: f64 = 0.8;

/// Whether the step has inertia.
pub(super) fn procedure(raw: &raw::Step) -> Procedure {
    match &raw.dynamics {
        None => Procedure::QuasiStatic,
        Some(dynamics) => Procedure::Dynamic {
            spectral_radius: dynamics
                .value
                .spectral_radius
                .as_ref()
                .map_or(SPECTRAL_RADIUS, |radius| radius.value.0),
        },
    }
}

/// Velocities that the step states, or `None` after faults.
pub(super) fn velocities(
    raw: &raw::Step,
    step: &str,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Vec<Velocity>> {
    let stated = list(&raw.velocity);
    let mut all: Vec<Velocity> = Vec::new();
    for velocity in stated {
        if raw.dynamics.is_none() {
            let kind = FaultKind::VelocityWithoutInertia { step: step.into() };
            faults.push(&velocity.span, kind);
        }
        let Some((body, name)) = mover(velocity, scope, faults) else {
            continue;
        };
        if all.iter().any(|other| other.body == body) {
            let what = format!("the velocity of {name}");
            let step = step.into();
            faults.push(&velocity.span, FaultKind::StatedTwice { step, what });
        }
        let part = |part: &Option<At<[_; 3]>>| {
            part.as_ref()
                .map_or_else(Vec3::zeros, |part| vector(&part.value))
        };
        all.push(Velocity {
            body,
            velocity: part(&velocity.value.vector),
            spin: part(&velocity.value.spin),
            about: part(&velocity.value.about),
        });
    }
    (all.len() == stated.len()).then_some(all)
}

/// What has a velocity, and its name.
fn mover(
    velocity: &At<raw::Velocity>,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<(Mover, String)> {
    match velocity.value.of.as_ref()? {
        raw::VelocityOf::Body(of) => {
            let body = scope.bodies.find(of.body.as_ref(), faults)?;
            let name = format!("body `{}`", scope.bodies.name(body));
            Some((Mover::Deformable(body), name))
        }
        raw::VelocityOf::Rigid(of) => {
            let name = of.rigid.as_ref()?;
            let rigid = RigidId(scope.rigid.find(name, faults)?);
            Some((
                Mover::Rigid(rigid),
                format!("rigid body `{}`", name.value.0),
            ))
        }
    }
}

/// Gravity that the step states; the outer `None` after faults.
pub(super) fn gravity(
    raw: &raw::Step,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Option<Gravity>> {
    let Some(gravity) = &raw.gravity else {
        return Some(None);
    };
    let curve = scope.curves.find(gravity.value.curve.as_ref(), faults)?;
    let acceleration = vector(&gravity.value.vector.as_ref()?.value);
    Some(Some(Gravity {
        acceleration,
        curve,
    }))
}

/// Notes every body without density in the first step that needs it.
pub(super) fn check(parts: &Parts<'_>, faults: &mut FaultList<'_>) {
    let &Parts {
        bodies,
        steps,
        written,
        ..
    } = parts;
    let needs = |step: &Step| step.gravity.is_some() || step.procedure != Procedure::QuasiStatic;
    let first = steps.iter().zip(written).find_map(|(step, at)| {
        let step = step.as_ref()?;
        needs(step).then_some((step, at))
    });
    let Some((step, at)) = first else { return };
    for body in bodies.ids().filter(|body| bodies.density(*body).is_none()) {
        let kind = FaultKind::NoDensity {
            body: bodies.name(body).into(),
            step: step.name.clone(),
        };
        faults.push(&at.span, kind);
    }
}
