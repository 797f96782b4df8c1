//! Inertia and gravity of a step.

use super::{Listed, Scope, list};
use crate::{faults::FaultList, raw, read::At, value::vector};
use striae_mesh::Vec3;
use striae_model::{FaultKind as ModelFault, Gravity, Mover, Procedure, RigidId, Velocity};

const SPECTRAL_RADIUS: f64 = 0.8;

/// Procedure of the step: with or without inertia.
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

/// Velocities that the step states.
pub(super) fn velocities(
    raw: &raw::Step,
    step: &str,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Listed<Velocity> {
    Listed::new(list(&raw.velocity), |velocity| {
        let Some(body) = mover(velocity, scope, faults) else {
            if raw.dynamics.is_none() {
                let step = step.into();
                faults.push(&velocity.span, ModelFault::VelocityWithoutInertia { step });
            }
            return None;
        };
        let part = |part: &Option<At<[_; 3]>>| {
            part.as_ref()
                .map_or_else(Vec3::zeros, |part| vector(&part.value))
        };
        Some(Velocity {
            body,
            velocity: part(&velocity.value.vector),
            spin: part(&velocity.value.spin),
            about: part(&velocity.value.about),
        })
    })
}

/// Part that a velocity is given to.
fn mover(
    velocity: &At<raw::Velocity>,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Mover> {
    match velocity.value.of.as_ref()? {
        raw::VelocityOf::Body(of) => {
            let body = scope.bodies.find(of.body.as_ref(), faults)?;
            Some(Mover::Deformable(body))
        }
        raw::VelocityOf::Rigid(of) => {
            let rigid = scope.rigid.find(of.rigid.as_ref()?, faults)?;
            Some(Mover::Rigid(RigidId(rigid)))
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
