//! Friction laws.

use crate::{
    fault::FaultKind,
    faults::{FaultList, Span},
    raw,
};
use striae_law::friction::{Friction, FrictionError, SlipRule};

/// A friction law, or `None` after its faults have been noted.
pub(crate) fn friction(
    raw: &raw::Friction,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<Friction> {
    lowered(raw)?
        .map_err(|error| {
            faults.push(
                span,
                FaultKind::Friction {
                    cause: error.to_string(),
                },
            )
        })
        .ok()
}

/// The friction, or `None` where a constant could not be read.
fn lowered(raw: &raw::Friction) -> Option<Result<Friction, FrictionError>> {
    let mut friction = match raw.law.as_ref()? {
        raw::FrictionLaw::Frictionless(_) => Ok(Friction::frictionless()),
        raw::FrictionLaw::Coulomb(law) => Friction::coulomb(law.mu.as_ref()?.value.0),
        raw::FrictionLaw::TwoTextures(law) => Friction::two_textures(
            law.mu.as_ref()?.value.0,
            law.c_mag.as_ref()?.value.0,
            law.c_ang.as_ref()?.value.0,
            law.c_cen.as_ref()?.value.0,
        ),
        raw::FrictionLaw::Orthotropic(law) => {
            let rule = match law.slip_rule.as_ref().map(|rule| rule.value) {
                None | Some(raw::SlipRule::Opposing) => SlipRule::Opposing,
                Some(raw::SlipRule::Associated) => SlipRule::Associated,
            };
            Friction::orthotropic(
                law.mu_along.as_ref()?.value.0,
                law.mu_across.as_ref()?.value.0,
                rule,
            )
        }
        raw::FrictionLaw::Nap(law) => Friction::nap(
            law.mu_forward.as_ref()?.value.0,
            law.mu_backward.as_ref()?.value.0,
            law.mu_lateral.as_ref()?.value.0,
        ),
        raw::FrictionLaw::Tabulated(law) => {
            let angles = law.angles.as_ref()?.value.0.iter();
            let angles: Vec<f64> = angles.map(|angle| angle.0.to_radians()).collect();
            let mu = law.mu.as_ref()?.value.0.iter();
            let mu: Vec<f64> = mu.map(|mu| mu.0).collect();
            Friction::tabulated(&angles, &mu)
        }
    };
    if let Some(cap) = &raw.shear_cap {
        friction = friction.and_then(|friction| friction.with_shear_cap(cap.value.0));
    }
    if let Some(decay) = &raw.decay {
        let ratio = decay.value.kinetic_over_static.as_ref()?.value.0;
        let rate = decay.value.slip_rate.as_ref()?.value.0;
        friction = friction.and_then(|friction| friction.with_decay(ratio, rate));
    }
    Some(friction)
}
