//! Friction laws.

use crate::{
    fault::FaultKind,
    faults::{FaultList, Span},
    law::{Named, Stated},
    raw,
    read::At,
};
use striae_law::friction::Friction;

/// A friction law, or `None` after its faults have been noted.
pub(crate) fn friction(
    raw: &raw::Friction,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<Friction> {
    let law = raw.law.as_ref().and_then(|law| law.made(span));
    let law = law.and_then(|law| {
        let law = law.and_then(|law| match &raw.shear_cap {
            Some(cap) => {
                let capped = law.with_shear_cap(cap.value.0);
                capped.map_err(|error| (error, cap.span.clone()))
            }
            None => Ok(law),
        });
        accepted(law, faults)
    });
    let decay = match &raw.decay {
        Some(decay) => made(&decay.value.0, &decay.span, faults).map(Some),
        None => Some(None),
    };
    let by_pressure = dependence(&raw.by_pressure, faults);
    let by_rate = dependence(&raw.by_slip_rate, faults);
    let by_slip = dependence(&raw.by_accumulated_slip, faults);
    let by_state = dependence(&raw.by_state, faults);
    if let (Some(_), Some(by_rate)) = (&raw.decay, &raw.by_slip_rate) {
        let cause = "it has both `decay` and `by_slip_rate`; give one of them; a decay with more \
                     constants is `by_slip_rate = { form = \"stribeck\", .. }`";
        let cause = cause.to_owned();
        faults.push(&by_rate.span, FaultKind::Friction { cause });
        return None;
    }
    let of_rate = [
        raw.decay.as_ref().map(|_| "decay"),
        raw.by_slip_rate.as_ref().map(|_| "by_slip_rate"),
    ];
    if let (Some(key), Some(at)) = (of_rate.into_iter().flatten().next(), &raw.by_state) {
        let cause = format!(
            "it has both `{key}` and `by_state`, which both say how friction goes with the slip \
             rate; give one of them"
        );
        faults.push(&at.span, FaultKind::Friction { cause });
        return None;
    }
    let mut law = law?;
    if let Some(by_pressure) = by_pressure? {
        law = law.with_pressure(by_pressure);
    }
    if let Some(by_rate) = decay?.or(by_rate?) {
        law = law.with_rate(by_rate);
    }
    if let Some(by_slip) = by_slip? {
        law = law.with_slip(by_slip);
    }
    if let Some(by_state) = by_state? {
        law = law.with_state(by_state);
    }
    Some(law)
}

/// A dependence, if there is one.
fn dependence<L: Named>(
    raw: &Option<At<Stated<L>>>,
    faults: &mut FaultList<'_>,
) -> Option<Option<L>> {
    match raw {
        Some(at) => made(&at.value, &at.span, faults).map(Some),
        None => Some(None),
    }
}

fn made<L: Named>(raw: &Stated<L>, span: &Span, faults: &mut FaultList<'_>) -> Option<L> {
    accepted(raw.made(span)?, faults)
}

/// The accepted value, or `None` after its fault has been noted.
fn accepted<T>(found: Result<T, (impl ToString, Span)>, faults: &mut FaultList<'_>) -> Option<T> {
    let noted = |(error, span)| {
        let cause = ToString::to_string(&error);
        faults.push(&span, FaultKind::Friction { cause });
    };
    found.map_err(noted).ok()
}
