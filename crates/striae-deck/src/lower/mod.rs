//! From the tables of a deck to the model: names become ids, sets their
//! members, defaults their values; what contradicts itself is refused.

mod actuation;
mod admissible;
mod body;
pub(crate) mod cards;
mod cavity;
mod condition;
mod contact;
mod curve;
mod everything;
mod fibres;
mod formulation;
mod friction;
mod function;
mod inertia;
mod listed;
mod material;
mod materials;
mod mesh;
mod named;
mod nodal;
mod nonzero;
mod output;
mod place;
mod rigid;
mod sections;
mod sets;
mod spring;
mod step;
mod surfaces;
mod texture;

use super::{
    Deck,
    fault::FaultKind,
    faults::{FaultList, Faults, Span},
    names::Names,
    raw,
    read::At,
    value::Text,
};
use body::Bodies;
use contact::LoweredPair;
pub(super) use friction::friction;
use listed::Listed;
use place::Places;
use std::path::Path;
use step::LoweredStep;
use striae_declared::shown;
use striae_model::{
    Backend, Cavity, Draft, DraftPair, DraftStep, Fault, FaultKind as ModelFault, Known, Lowered,
    Model, Named, RigidSurface, Solver, Spring, Strategy, Tie, fitted, whole_faults,
};

/// Parts that the rest of a deck refers to by name.
struct Scope<'r> {
    bodies: &'r Bodies,
    rigid: &'r Names,
    pair_names: &'r Names,
    cavity_names: &'r Names,
    curves: &'r curve::Curves,
    parameters: &'r function::Parameters,
}

/// The deck, or `None` after its faults have been noted.
pub(super) fn deck(raw: &raw::Simulation, base: &Path, faults: &mut FaultList<'_>) -> Option<Deck> {
    // Where the first stage found faults, what seems to be missing may be there.
    let known = if faults.is_empty() {
        Known::Whole
    } else {
        Known::InPart
    };
    let parts = parts(raw, base, known, faults);
    let places = Places {
        steps: parts.steps.iter().map(|step| step.spans.clone()).collect(),
        origins: parts
            .lowered
            .iter()
            .flat_map(|of| of.origins.clone())
            .collect(),
    };
    note(parts.draft(raw, known).faults(), raw, &places, faults);
    nothing_missing(raw, faults);
    if !faults.is_empty() {
        return None;
    }
    let output = output::output(raw.output.as_ref(), &parts.bodies, faults);
    if !faults.is_empty() {
        return None;
    }
    let notes = stated(raw).chain(parts.bodies.notes()).collect();
    let model = parts.model(raw)?;
    note(whole_faults(&model, &[]), raw, &places, faults);
    if !faults.is_empty() {
        return None;
    }
    let fitted = fitted(model).map_err(|found| note(found, raw, &places, faults));
    Some(Deck {
        model: fitted.ok()?,
        output,
        wrt: differentiated(raw),
        notes,
        places: named::places(raw, faults),
        together: together(raw, faults),
    })
}

/// Names of the numbers that a run is differentiated by.
fn differentiated(raw: &raw::Simulation) -> Vec<String> {
    let names = raw.sensitivity.iter().flat_map(|at| at.value.names());
    names.map(|name| name.value.0.clone()).collect()
}

/// Notes on the parameters and on included files.
fn stated(raw: &raw::Simulation) -> impl Iterator<Item = String> {
    let listed = |what: &str, all: Vec<String>| {
        (!all.is_empty()).then(|| format!("{what}: {}", all.join(", ")))
    };
    let numbers = raw.parameters.iter().flat_map(|at| &at.value.0);
    let numbers = numbers.map(|(name, value)| format!("{name} = {}", shown(*value)));
    let files = raw.include.iter().flat_map(|at| &at.value.0);
    let files = files.map(|file| format!("`{}`", file.0));
    let notes = [
        listed("parameters", numbers.collect()),
        listed("included", files.collect()),
    ];
    notes.into_iter().flatten()
}

/// Faults of the deck if it is run without ranks.
fn together(raw: &raw::Simulation, faults: &FaultList<'_>) -> Option<Box<Faults>> {
    let backend = raw.solver.as_ref()?.value.backend.as_ref()?;
    match backend.value {
        raw::Backend::Mumps => Some(Box::new(faults.only(&backend.span, FaultKind::Together))),
        _ => None,
    }
}

/// The parts of a model; those with faults are missing.
struct Parts {
    bodies: Bodies,
    rigid: Vec<Option<RigidSurface>>,
    pairs: Vec<LoweredPair>,
    ties: Vec<Option<Tie>>,
    springs: Vec<Option<Spring>>,
    cavities: Vec<Option<Cavity>>,
    /// Pairs of contact of everything, none if it is not requested; `None` after faults.
    lowered: Option<Lowered>,
    steps: Vec<LoweredStep>,
}

fn parts(raw: &raw::Simulation, base: &Path, known: Known, faults: &mut FaultList<'_>) -> Parts {
    let materials = materials::Materials::new(list(&raw.material), faults);
    let bodies = Bodies::new(list(&raw.body), &materials, base, faults);
    let names = list(&raw.rigid).iter().map(|at| at.value.name.as_ref());
    let rigid_names = Names::new("rigid surface", names, faults);
    let rigid = rigid::bodies(list(&raw.rigid), &bodies, base, faults);
    let names = list(&raw.pair).iter().map(|at| at.value.name.as_ref());
    let mut pair_names = Names::new("pair", names, faults);
    let surfaces = surfaces::Surfaces {
        bodies: &bodies,
        rigid_names: &rigid_names,
        rigid: &rigid,
        written: raw,
        base,
    };
    let parameters = function::Parameters::of(raw);
    let curves = curve::Curves::new(list(&raw.curve), base, &parameters, faults);
    let pairs = contact::pairs(list(&raw.pair), &surfaces, &curves, faults);
    let names = list(&raw.tie).iter().map(|at| at.value.name.as_ref());
    Names::new("tie", names, faults);
    let ties = contact::ties(list(&raw.tie), &surfaces, faults);
    let springs = spring::springs(list(&raw.spring), &surfaces, faults);
    let (cavity_names, cavities) = cavity::cavities(list(&raw.cavity), &bodies, faults);
    let joints = (&ties[..], &springs[..]);
    let draft = drafted(raw, (&bodies, &rigid, &pairs), joints, known);
    let lowered = everything::lowered(raw, &draft, &surfaces, faults);
    match &lowered {
        Some(lowered) => {
            let pairs = lowered.pairs.iter();
            pair_names.extend(pairs.map(|pair| Some(pair.name.clone())));
        }
        None => pair_names.extend([None]),
    }
    let scope = Scope {
        bodies: &bodies,
        rigid: &rigid_names,
        pair_names: &pair_names,
        cavity_names: &cavity_names,
        curves: &curves,
        parameters: &parameters,
    };
    let steps = step::steps(list(&raw.step), &scope, faults);
    Parts {
        bodies,
        rigid,
        pairs,
        ties,
        springs,
        cavities,
        lowered,
        steps,
    }
}

/// Parts that are known besides the steps and contact of everything.
fn drafted<'a>(
    raw: &'a raw::Simulation,
    (bodies, rigid, pairs): (&'a Bodies, &'a [Option<RigidSurface>], &'a [LoweredPair]),
    (ties, springs): (&'a [Option<Tie>], &'a [Option<Spring>]),
    known: Known,
) -> Draft<'a> {
    let rigid = list(&raw.rigid).iter().zip(rigid);
    let rigid = rigid.map(|(raw, part)| Named {
        name: name(&raw.value.name),
        part: part.as_ref(),
    });
    let pairs = list(&raw.pair).iter().zip(pairs);
    let pairs = pairs.map(|(raw, lowered)| DraftPair {
        name: name(&raw.value.name),
        pair: lowered.pair.as_ref(),
        known: lowered.known,
        is_named: true,
    });
    let ties = list(&raw.tie).iter().zip(ties);
    let ties = ties.map(|(raw, part)| Named {
        name: name(&raw.value.name),
        part: part.as_ref(),
    });
    let springs = list(&raw.spring).iter().zip(springs);
    let springs = springs.map(|(raw, part)| Named {
        name: name(&raw.value.name),
        part: part.as_ref(),
    });
    Draft {
        bodies: bodies.drafts(),
        rigid_surfaces: rigid.collect(),
        pairs: pairs.collect(),
        ties: ties.collect(),
        springs: springs.collect(),
        steps: Vec::new(),
        known,
    }
}

impl Parts {
    /// Known parts of the model.
    fn draft<'a>(&'a self, raw: &'a raw::Simulation, known: Known) -> Draft<'a> {
        let known = match self.lowered {
            Some(_) => known,
            None => Known::InPart,
        };
        let parts = (&self.bodies, &self.rigid[..], &self.pairs[..]);
        let mut draft = drafted(raw, parts, (&self.ties, &self.springs), known);
        if let Some(lowered) = &self.lowered {
            draft.extend(&lowered.pairs);
        }
        draft
            .steps
            .extend(self.steps.iter().map(|lowered| DraftStep {
                step: &lowered.step,
                known: lowered.known,
                displacements: lowered.displacements,
            }));
        draft
    }

    /// The model, if nothing is missing.
    fn model(self, raw: &raw::Simulation) -> Option<Model> {
        Some(Model {
            title: raw.title.as_ref()?.value.0.clone(),
            bodies: self.bodies.finished()?,
            rigid_surfaces: whole(self.rigid)?,
            pairs: self
                .pairs
                .into_iter()
                .map(|lowered| lowered.pair)
                .chain(self.lowered?.pairs.into_iter().map(Some))
                .collect::<Option<_>>()?,
            ties: whole(self.ties)?,
            springs: whole(self.springs)?,
            cavities: whole(self.cavities)?,
            steps: self.steps.into_iter().map(|lowered| lowered.step).collect(),
            solver: solver(raw.solver.as_ref().map(|solver| &solver.value)),
        })
    }
}

/// Notes faults of the model where the deck states what is wrong.
fn note(found: Vec<Fault>, raw: &raw::Simulation, places: &Places, faults: &mut FaultList<'_>) {
    for Fault { path, kind } in found {
        let kind = match kind {
            // The deck notes them itself, in its own words.
            ModelFault::DuplicateName { .. } | ModelFault::Nothing { .. } => continue,
            ModelFault::NotPrescribed {
                step,
                body,
                component,
                set,
            } => ModelFault::NotPrescribed {
                set: place::released_set(&path, raw, places).unwrap_or(set),
                step,
                body,
                component,
            },
            kind => kind,
        };
        faults.push(&place::span(&path, raw, places), kind);
    }
}

/// A name, empty if there is none that can be read.
fn name(name: &Option<At<Text>>) -> &str {
    name.as_ref().map_or("", |name| &name.value.0)
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
    let default = striae_model::solver();
    Solver {
        backend: match backend.map(|backend| backend.value) {
            None => default.backend,
            Some(raw::Backend::Condensed) => Backend::Condensed,
            Some(raw::Backend::Multifrontal) => Backend::Multifrontal,
            Some(raw::Backend::Faer) => Backend::Faer,
            Some(raw::Backend::Iterative) => Backend::Iterative,
            Some(raw::Backend::Mumps) => Backend::Mumps,
        },
        strategy: strategy(raw),
        tolerance: tolerance.map_or(default.tolerance, |tolerance| tolerance.value.0),
        largest_iterations: iterations.map_or(default.largest_iterations, |at| at.value.0),
        ..default
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
