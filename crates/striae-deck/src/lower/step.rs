//! Steps: increments and what each step states.

use super::{
    Listed, Scope, actuation, cavity, condition, friction, inertia, list,
    place::{ConditionSpans, StepSpans},
    rigid,
};
use crate::{fault::FaultKind, faults::FaultList, names::Names, raw, read::At};
use striae_law::friction::Friction;
use striae_model::{Increments, Known, PairId, Step, equal_increments};

const INITIAL: f64 = 0.1;
const SMALLEST_OVER_INITIAL: f64 = 1e-3;
/// Increments of a step that are admitted: at a hundred in a second, more than a day of time.
const MOST_INCREMENTS: f64 = 1e7;

/// A step as far as it is known, and where its parts are written.
pub(super) struct LoweredStep {
    pub(super) step: Step,
    pub(super) known: Known,
    /// Completeness of the displacement conditions.
    pub(super) displacements: Known,
    pub(super) spans: StepSpans,
}

/// The steps.
pub(super) fn steps(
    raw: &[At<raw::Step>],
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Vec<LoweredStep> {
    Names::new(
        "step",
        raw.iter().map(|step| step.value.name.as_ref()),
        faults,
    );
    let mut history = condition::History::default();
    raw.iter()
        .map(|step| lower_step(step, scope, &mut history, faults))
        .collect()
}

fn lower_step(
    at: &At<raw::Step>,
    scope: &Scope<'_>,
    history: &mut condition::History,
    faults: &mut FaultList<'_>,
) -> LoweredStep {
    let raw = &at.value;
    let name = raw.name.as_ref().map_or("", |name| &name.value.0);
    let releases = condition::releases(list(&raw.release), scope, history, faults);
    let displacements = condition::displacements(list(&raw.displacement), scope, history, faults);
    let loads = condition::loads(raw, scope, faults);
    let forces = condition::forces(list(&raw.force), scope, faults);
    let actuations = actuation::actuations(raw, scope, faults);
    let fillings = cavity::fillings(list(&raw.cavity), scope, faults);
    let velocities = inertia::velocities(raw, name, scope, faults);
    let gravity = inertia::gravity(raw, scope, faults);
    let rigid_motions = rigid::motions(list(&raw.rigid), scope, faults);
    let frictions = frictions(list(&raw.friction), scope, faults);
    let whole = releases.whole()
        && displacements.whole()
        && loads.whole()
        && forces.whole()
        && actuations.whole()
        && fillings.whole()
        && velocities.whole()
        && gravity.is_some()
        && rigid_motions.whole()
        && frictions.whole();
    let increments = raw.increments.as_ref();
    if let Some(increments) = increments {
        check_number(increments, name, faults);
    }
    LoweredStep {
        known: known(whole),
        displacements: known(displacements.whole()),
        spans: StepSpans {
            whole: at.span.clone(),
            increments: increments.map_or(at.span.clone(), |raw| raw.span.clone()),
            conditions: ConditionSpans::from([
                ("releases", releases.spans),
                ("displacements", displacements.spans),
                ("loads", loads.spans),
                ("forces", forces.spans),
                ("actuations", actuations.spans),
                ("fillings", fillings.spans),
                ("velocities", velocities.spans),
                ("rigid_motions", rigid_motions.spans),
                ("frictions", frictions.spans),
            ]),
        },
        step: Step {
            name: name.into(),
            duration: raw
                .duration
                .as_ref()
                .map_or(1.0, |duration| duration.value.0),
            procedure: inertia::procedure(raw),
            increments: increments.map_or(equal_increments(10), |raw| sizes(&raw.value)),
            velocities: velocities.items,
            gravity: gravity.flatten(),
            displacements: displacements.items,
            releases: releases.items,
            loads: loads.items,
            forces: forces.items,
            actuations: actuations.items,
            fillings: fillings.items,
            rigid_motions: rigid_motions.items,
            frictions: frictions.items,
        },
    }
}

/// Notes increments of which there would be more than a run can make.
fn check_number(raw: &At<raw::Increments>, step: &str, faults: &mut FaultList<'_>) {
    // Rounded, as the limit itself is admitted.
    if (1.0 / sizes(&raw.value).largest).round() > MOST_INCREMENTS {
        let kind = FaultKind::Increments {
            step: step.to_owned(),
            most: MOST_INCREMENTS,
        };
        faults.push(&raw.span, kind);
    }
}

fn known(whole: bool) -> Known {
    if whole { Known::Whole } else { Known::InPart }
}

fn sizes(raw: &raw::Increments) -> Increments {
    let sizes = match raw {
        raw::Increments::Number(number) => return equal_increments(number.0),
        raw::Increments::Sizes(sizes) => sizes,
    };
    let largest = sizes.largest.as_ref().map(|largest| largest.value.0);
    let initial = sizes
        .initial
        .as_ref()
        .map_or(INITIAL.min(largest.unwrap_or(1.0)), |initial| {
            initial.value.0
        });
    Increments {
        initial,
        smallest: sizes
            .smallest
            .as_ref()
            .map_or(initial * SMALLEST_OVER_INITIAL, |smallest| smallest.value.0),
        largest: largest.unwrap_or(initial),
    }
}

fn frictions(
    raw: &[At<raw::FrictionChange>],
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Listed<(PairId, Friction)> {
    Listed::new(raw, |change| {
        let pair = change
            .value
            .pair
            .as_ref()
            .and_then(|name| scope.pair_names.find(name, faults))
            .map(PairId);
        let friction = change
            .value
            .friction
            .as_ref()
            .and_then(|friction| friction::friction(friction, &change.span, faults));
        Some((pair?, friction?))
    })
}
