//! Friction laws.

use super::dependence;
use crate::{
    fault::FaultKind,
    faults::{FaultList, Span},
    raw,
};
use striae_law::friction::{
    Friction, FrictionError, PressureDependence, RateDependence, SlipDependence, SlipRule,
};

/// A friction law, or `None` after its faults have been noted.
pub(crate) fn friction(
    raw: &raw::Friction,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<Friction> {
    let law = lowered(raw).and_then(|law| accepted(law, span, faults));
    let by_pressure = match &raw.by_pressure {
        Some(by_pressure) => dependence::by_pressure(&by_pressure.value)
            .and_then(|found| accepted(found, &by_pressure.span, faults)),
        None => Some(PressureDependence::default()),
    };
    let by_rate = match &raw.by_slip_rate {
        Some(by_rate) => dependence::by_rate(&by_rate.value)
            .and_then(|found| accepted(found, &by_rate.span, faults)),
        None => Some(RateDependence::default()),
    };
    let by_slip = match &raw.by_accumulated_slip {
        Some(by_slip) => dependence::by_slip(&by_slip.value)
            .and_then(|found| accepted(found, &by_slip.span, faults)),
        None => Some(SlipDependence::default()),
    };
    if let (Some(_), Some(by_rate)) = (&raw.decay, &raw.by_slip_rate) {
        let cause = "it has both `decay` and `by_slip_rate`; give one of them; a decay with more constants is `by_slip_rate = { form = \"stribeck\", .. }`";
        faults.push(
            &by_rate.span,
            FaultKind::Friction {
                cause: cause.to_owned(),
            },
        );
        return None;
    }
    let mut law = law?.with_pressure(by_pressure?).with_slip(by_slip?);
    let by_rate = by_rate?;
    if raw.by_slip_rate.is_some() {
        law = law.with_rate(by_rate);
    }
    Some(law)
}

/// The accepted value, or `None` after its fault has been noted.
fn accepted<T>(
    found: Result<T, FrictionError>,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<T> {
    let noted = |error: FrictionError| {
        let cause = error.to_string();
        faults.push(span, FaultKind::Friction { cause });
    };
    found.map_err(noted).ok()
}

/// The law with its cap and decay, or `None` where a constant could not be read.
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
