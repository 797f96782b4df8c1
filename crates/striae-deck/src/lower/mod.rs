//! From the tables of a deck to the model: names become ids, sets their
//! members, defaults their values; what contradicts itself is refused.

mod body;
mod condition;
mod contact;
mod curve;
mod friction;
mod generator;
mod hold;
mod inertia;
mod initial;
mod mesh;
mod nodal;
mod rigid;
mod sets;
mod step;
mod texture;

use super::{
    Deck,
    fault::FaultKind,
    faults::{FaultList, Span},
    names::Names,
    raw,
    read::At,
};
use body::Bodies;
pub(super) use friction::friction;
use std::{num::NonZeroUsize, path::Path};
use striae_output::{FieldOutput, Output};
use striae_solve::model::{Backend, Model, Pair, RigidSurface, Solver, Step, Strategy};

/// What the parts of a deck refer to by name.
struct Scope<'r> {
    bodies: &'r Bodies,
    rigid: &'r Names,
    pair_names: &'r Names,
    pairs: &'r [Option<Pair>],
    curves: &'r curve::Curves,
}

/// How the first stage went.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Read {
    /// Without faults.
    Whole,
    /// With faults, so that what seems to be missing may be there.
    InPart,
}

/// The deck, or `None` after its faults have been noted.
pub(super) fn deck(raw: &raw::Simulation, base: &Path, faults: &mut FaultList<'_>) -> Option<Deck> {
    let read = if faults.is_empty() {
        Read::Whole
    } else {
        Read::InPart
    };
    let materials = body::Materials::new(list(&raw.material), faults);
    let bodies = Bodies::new(list(&raw.body), &materials, base, faults);
    let rigid_names = Names::new(
        "rigid surface",
        list(&raw.rigid)
            .iter()
            .map(|rigid| rigid.value.name.as_ref()),
        faults,
    );
    let rigid_surfaces = rigid::bodies(list(&raw.rigid), &bodies, base, faults);
    let pair_names = Names::new(
        "pair",
        list(&raw.pair).iter().map(|pair| pair.value.name.as_ref()),
        faults,
    );
    let surfaces = contact::Surfaces {
        bodies: &bodies,
        rigid_names: &rigid_names,
        rigid: &rigid_surfaces,
        read,
        written: raw,
        base,
    };
    let pairs = contact::pairs(list(&raw.pair), &surfaces, faults);
    let curves = curve::Curves::new(list(&raw.curve), faults);
    let scope = Scope {
        bodies: &bodies,
        rigid: &rigid_names,
        pair_names: &pair_names,
        pairs: &pairs,
        curves: &curves,
    };
    let steps = step::steps(list(&raw.step), &scope, read, faults);
    if read == Read::Whole {
        let parts = Parts {
            bodies: &bodies,
            rigid: &rigid_surfaces,
            pairs: &pairs,
            steps: &steps,
            written: list(&raw.step),
        };
        hold::check(&parts, faults);
        rigid::check(&parts, faults);
        inertia::check(&parts, faults);
        contact::check(list(&raw.pair), &pairs, &steps, faults);
    }
    nothing_missing(raw, faults);

    let model = Model {
        title: raw.title.as_ref()?.value.0.clone(),
        bodies: bodies.finished()?,
        rigid_surfaces: whole(rigid_surfaces)?,
        pairs: whole(pairs)?,
        steps: whole(steps)?,
        solver: solver(raw.solver.as_ref().map(|solver| &solver.value)),
    };
    let model = if faults.is_empty() {
        initial::fitted(model, list(&raw.pair), faults)?
    } else {
        model
    };
    Some(Deck {
        model,
        output: output(raw.output.as_ref().map(|output| &output.value)),
    })
}

/// Parts of a model that have to fit together; those with faults are missing.
struct Parts<'a> {
    bodies: &'a Bodies,
    rigid: &'a [Option<RigidSurface>],
    pairs: &'a [Option<Pair>],
    steps: &'a [Option<Step>],
    written: &'a [At<raw::Step>],
}

/// The elements of a list that may be absent.
fn list<T>(list: &Option<At<Vec<At<T>>>>) -> &[At<T>] {
    list.as_ref().map_or(&[], |list| &list.value)
}

/// All of a list or nothing.
fn whole<T>(list: Vec<Option<T>>) -> Option<Vec<T>> {
    list.into_iter().collect()
}

fn nothing_missing(raw: &raw::Simulation, faults: &mut FaultList<'_>) {
    const START: Span = 0..0;
    if list(&raw.body).is_empty() {
        faults.push(
            &START,
            FaultKind::Nothing {
                key: "body",
                need: "there is nothing to simulate",
            },
        );
    }
    if list(&raw.step).is_empty() {
        faults.push(
            &START,
            FaultKind::Nothing {
                key: "step",
                need: "there is nothing to do",
            },
        );
    }
}

fn solver(raw: Option<&raw::SolverSettings>) -> Solver {
    let backend = raw.and_then(|raw| raw.backend.as_ref());
    let tolerance = raw.and_then(|raw| raw.tolerance.as_ref());
    let iterations = raw.and_then(|raw| raw.largest_iterations.as_ref());
    Solver {
        backend: match backend.map(|backend| backend.value) {
            None | Some(raw::Backend::Condensed) => Backend::Condensed,
            Some(raw::Backend::Multifrontal) => Backend::Multifrontal,
            Some(raw::Backend::Faer) => Backend::Faer,
            Some(raw::Backend::Iterative) => Backend::Iterative,
        },
        strategy: strategy(raw),
        tolerance: tolerance.map_or(1e-10, |tolerance| tolerance.value.0),
        largest_iterations: iterations.map_or(40, |iterations| iterations.value.0),
        further_iterations: 0,
    }
}

fn strategy(raw: Option<&raw::SolverSettings>) -> Strategy {
    match raw.and_then(|raw| raw.strategy.as_ref()) {
        Some(At {
            value: raw::Strategy::Table1(raw),
            ..
        }) => Strategy::Table1 {
            stick_tolerance: raw
                .stick_tolerance
                .as_ref()
                .map_or(0.01, |share| share.value.0),
        },
        Some(_) | None => Strategy::Semismooth,
    }
}

fn output(raw: Option<&raw::OutputSettings>) -> Output {
    let every = raw
        .and_then(|raw| raw.fields_every.as_ref())
        .map_or(1, |every| every.value.0);
    let checkpoint_every = raw
        .and_then(|raw| raw.checkpoint_every.as_ref())
        .map_or(10, |every| every.value.0);
    Output {
        fields: NonZeroUsize::new(every).map_or(FieldOutput::Last, FieldOutput::Every),
        checkpoint_every: NonZeroUsize::new(checkpoint_every),
    }
}
