//! Steps: increments and what each step states.

use super::{Read, Scope, condition, friction, inertia, list, rigid, texture};
use crate::{fault::FaultKind, faults::FaultList, names::Names, raw, read::At};
use striae_law::friction::Friction;
use striae_solve::model::{Increments, Pair, PairId, Step};

const INITIAL: f64 = 0.1;
const SMALLEST_OVER_INITIAL: f64 = 1e-3;

/// The steps; `None` for the faulty ones.
pub(super) fn steps(
    raw: &[At<raw::Step>],
    scope: &Scope<'_>,
    read: Read,
    faults: &mut FaultList<'_>,
) -> Vec<Option<Step>> {
    Names::new(
        "step",
        raw.iter().map(|step| step.value.name.as_ref()),
        faults,
    );
    let mut history = condition::History::new(read);
    raw.iter()
        .map(|step| lower_step(&step.value, scope, &mut history, faults))
        .collect()
}

fn lower_step(
    raw: &raw::Step,
    scope: &Scope<'_>,
    history: &mut condition::History,
    faults: &mut FaultList<'_>,
) -> Option<Step> {
    let name = raw.name.as_ref().map_or("", |name| &name.value.0);
    let increments = match raw.increments.as_ref() {
        Some(raw) => increments(&raw.value, name, raw, faults),
        None => equal(10),
    };
    let releases = condition::releases(list(&raw.release), name, scope, history, faults);
    let displacements =
        condition::displacements(list(&raw.displacement), name, scope, history, faults);
    let loads = condition::loads(raw, name, scope, faults);
    let velocities = inertia::velocities(raw, name, scope, faults);
    let gravity = inertia::gravity(raw, scope, faults);
    let rigid_motions = rigid::motions(list(&raw.rigid), name, scope, faults);
    let frictions = frictions(list(&raw.friction), name, scope, faults);
    Some(Step {
        name: name.into(),
        duration: raw
            .duration
            .as_ref()
            .map_or(1.0, |duration| duration.value.0),
        procedure: inertia::procedure(raw),
        increments,
        velocities: velocities?,
        gravity: gravity?,
        displacements: displacements?,
        releases: releases?,
        loads: loads?,
        rigid_motions: rigid_motions?,
        frictions: frictions?,
    })
}

fn equal(number: usize) -> Increments {
    let size = 1.0 / number as f64;
    Increments {
        initial: size,
        smallest: size * SMALLEST_OVER_INITIAL,
        largest: size,
    }
}

fn increments(
    raw: &raw::Increments,
    step: &str,
    at: &At<raw::Increments>,
    faults: &mut FaultList<'_>,
) -> Increments {
    let sizes = match raw {
        raw::Increments::Number(number) => return equal(number.0),
        raw::Increments::Sizes(sizes) => sizes,
    };
    let largest = sizes.largest.as_ref().map(|largest| largest.value.0);
    let initial = sizes
        .initial
        .as_ref()
        .map_or(INITIAL.min(largest.unwrap_or(1.0)), |initial| {
            initial.value.0
        });
    let largest = largest.unwrap_or(initial);
    let smallest = sizes
        .smallest
        .as_ref()
        .map_or(initial * SMALLEST_OVER_INITIAL, |smallest| smallest.value.0);
    if !(smallest <= initial && initial <= largest) {
        faults.push(
            &at.span,
            FaultKind::IncrementOrder {
                step: step.into(),
                smallest,
                initial,
                largest,
            },
        );
    }
    Increments {
        initial,
        smallest,
        largest,
    }
}

fn frictions(
    raw: &[At<raw::FrictionChange>],
    step: &str,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Vec<(PairId, Friction)>> {
    let mut changes: Vec<(PairId, Friction)> = Vec::new();
    for change in raw {
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
        let (Some(pair), Some(friction)) = (pair, friction) else {
            continue;
        };
        if changes.iter().any(|(other, _)| *other == pair) {
            let what = format!(
                "the friction of pair `{}`",
                change.value.pair.as_ref()?.value.0
            );
            faults.push(
                &change.span,
                FaultKind::StatedTwice {
                    step: step.into(),
                    what,
                },
            );
        }
        if let Some(Pair { name, textures, .. }) = &scope.pairs[pair.0] {
            texture::check_friction(name, &friction, textures, &change.span, faults);
        }
        changes.push((pair, friction));
    }
    (changes.len() == raw.len()).then_some(changes)
}
