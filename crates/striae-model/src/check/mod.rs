//! Validation of a model: every fault there is, with its path.
//!
//! A [`Draft`] is a model of which parts may be missing, as a deck has when some of
//! its tables are faulty: what is known is checked all the same, and what can only be
//! judged as a whole is left out. A whole model is checked by [`Validate::faults`].

mod actuations;
mod cavities;
mod conditions;
mod extents;
mod facets;
mod functions;
mod hold;
mod inertia;
mod into;
mod numbers;
mod pairs;
mod pieces;
mod prescribed;
mod pushed;
mod references;
mod rigid;
mod sections;
mod springs;
mod steps;
mod ties;
mod triangles;

pub use numbers::misshapen;
pub(crate) use numbers::of_everything;

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    fault::{Fault, FaultKind, Faults},
    model::{Body, BodySection, Model, Pair, RigidSurface, Spring, Step, Tie},
    path::Path,
};
use striae_law::bulk::Material;
use striae_mesh::Mesh;

/// Completeness of a part of a draft.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// Everything is known.
    Whole,
    /// Something is missing, so that what seems to be absent may be there.
    InPart,
}

/// A part with its name; `None` where it has faults already.
#[derive(Clone, Copy, Debug)]
pub struct Named<'a, T> {
    /// Its name.
    pub name: &'a str,
    /// The part.
    pub part: Option<&'a T>,
}

/// Known parts of a body.
#[derive(Clone, Copy, Debug)]
pub struct DraftBody<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its mesh.
    pub mesh: Option<&'a Mesh>,
    /// Its own material, if it is known.
    pub material: Option<&'a Material>,
    /// Its sections, as far as they are known.
    pub sections: &'a [BodySection],
    /// Density of its own material; zero if there is none, `None` where no element is of it.
    pub density: Option<f64>,
}

/// A pair and whether its friction is known; without it only its sides are judged.
#[derive(Clone, Copy, Debug)]
pub struct DraftPair<'a> {
    /// Its name.
    pub name: &'a str,
    /// The pair; `None` where its sides have faults already.
    pub pair: Option<&'a Pair>,
    /// Completeness of the body.
    pub known: Known,
    /// Is a pair of its own, not of contact of everything.
    pub is_named: bool,
}

/// A step and whether all that it states is in it.
#[derive(Clone, Copy, Debug)]
pub struct DraftStep<'a> {
    /// The step.
    pub step: &'a Step,
    /// Completeness of the part.
    pub known: Known,
    /// Completeness of its displacement conditions.
    pub displacements: Known,
}

/// A model of which parts may be missing. All ids must be those of parts.
#[derive(Clone, Debug)]
pub struct Draft<'a> {
    /// Deformable bodies.
    pub bodies: Vec<DraftBody<'a>>,
    /// Rigid surfaces.
    pub rigid_surfaces: Vec<Named<'a, RigidSurface>>,
    /// Contact pairs.
    pub pairs: Vec<DraftPair<'a>>,
    /// Ties.
    pub ties: Vec<Named<'a, Tie>>,
    /// Springs.
    pub springs: Vec<Named<'a, Spring>>,
    /// Steps.
    pub steps: Vec<DraftStep<'a>>,
    /// Completeness of everything else.
    pub known: Known,
}

/// Models that find their own faults.
pub trait Validate: Sized {
    /// Every fault of the model; none if it can be simulated. Gaps and overlaps of
    /// the meshes are judged by [`crate::fitted`].
    fn faults(&self) -> Vec<Fault>;

    /// The model, if it has no faults.
    ///
    /// # Errors
    /// All faults.
    fn checked(self) -> Result<Self, Faults> {
        let faults = self.faults();
        if faults.is_empty() {
            Ok(self)
        } else {
            Err(Faults(faults))
        }
    }
}

impl Validate for Model {
    fn faults(&self) -> Vec<Fault> {
        let mut faults = references::faults(self);
        // Ids of what is not there cannot be followed.
        if faults.is_empty() {
            faults = Draft::of(self).faults();
            faults.extend(numbers::faults(self));
            faults.extend(whole_faults(self, &faults));
        }
        faults
    }
}

/// Faults that only a whole model shows: of cavities, and, if there are no others, of bodies that
/// contact can only push away and surfaces that are moved into a plane.
pub fn whole_faults(model: &Model, others: &[Fault]) -> Vec<Fault> {
    let of_cavities = cavities::faults(model);
    match others.is_empty() && of_cavities.is_empty() {
        true => [pushed::faults(model), into::faults(model)].concat(),
        false => of_cavities,
    }
}

impl<'a> Draft<'a> {
    /// A whole model.
    pub fn of(model: &'a Model) -> Self {
        let rigid = model.rigid_surfaces.iter().map(|rigid| Named {
            name: &rigid.name,
            part: Some(rigid),
        });
        let ties = model.ties.iter().map(|tie| Named {
            name: &tie.name,
            part: Some(tie),
        });
        let springs = model.springs.iter().map(|spring| Named {
            name: &spring.name,
            part: Some(spring),
        });
        let steps = model.steps.iter().map(|step| DraftStep {
            step,
            known: Known::Whole,
            displacements: Known::Whole,
        });
        let mut draft = Self {
            bodies: Self::bodies(&model.bodies),
            rigid_surfaces: rigid.collect(),
            pairs: Vec::new(),
            ties: ties.collect(),
            springs: springs.collect(),
            steps: steps.collect(),
            known: Known::Whole,
        };
        draft.add(&model.pairs, true);
        draft
    }

    /// Whole bodies.
    pub fn bodies(bodies: &'a [Body]) -> Vec<DraftBody<'a>> {
        let bodies = bodies.iter().map(|body| DraftBody {
            name: &body.name,
            mesh: Some(&body.mesh),
            material: Some(&body.material),
            sections: &body.sections,
            density: body.used_sections().contains(&0).then_some(body.density),
        });
        bodies.collect()
    }

    /// Adds the pairs of contact of everything.
    pub fn extend(&mut self, pairs: &'a [Pair]) {
        self.add(pairs, false);
    }

    fn add(&mut self, pairs: &'a [Pair], is_named: bool) {
        self.pairs.extend(pairs.iter().map(|pair| DraftPair {
            name: &pair.name,
            pair: Some(pair),
            known: Known::Whole,
            is_named,
        }));
    }

    /// Every fault of what is known.
    pub fn faults(&self) -> Vec<Fault> {
        let mut faults = List::default();
        self.nothing(&mut faults);
        self.names(&mut faults);
        let impossible = pairs::check(self, &mut faults);
        ties::check(self, &mut faults);
        springs::check(self, &mut faults);
        let partial = steps::check(self, &impossible, &mut faults);
        triangles::check(self, &mut faults);
        extents::check(self, &mut faults);
        if faults.0.is_empty() {
            facets::check(self, &mut faults);
        }
        sections::check(self, &mut faults);
        if self.known == Known::Whole {
            if impossible.is_empty() && partial.is_empty() {
                hold::check(self, &mut faults);
                pieces::check(self, &mut faults);
            }
            prescribed::check(self, &impossible, &partial, &mut faults);
            rigid::check(self, &impossible, &partial, &mut faults);
            inertia::check(self, &partial, &mut faults);
            pairs::check_stabilised(self, &impossible, &partial, &mut faults);
        }
        faults.0
    }

    fn nothing(&self, faults: &mut List) {
        let mut empty = |list, what, need| {
            faults.push(Path::of(list), FaultKind::Nothing { what, need });
        };
        if self.bodies.is_empty() {
            empty("bodies", "body", "there is nothing to simulate");
        }
        if self.steps.is_empty() {
            empty("steps", "step", "there is nothing to do");
        }
    }

    fn names(&self, faults: &mut List) {
        let bodies = self.bodies.iter().map(|body| body.name);
        distinct("body", "bodies", bodies, faults);
        let rigid = self.rigid_surfaces.iter().map(|rigid| rigid.name);
        distinct("rigid surface", "rigid_surfaces", rigid, faults);
        distinct(
            "pair",
            "pairs",
            self.pairs.iter().map(|pair| pair.name),
            faults,
        );
        let ties = self.ties.iter().map(|tie| tie.name);
        distinct("tie", "ties", ties, faults);
        let springs = self.springs.iter().map(|spring| spring.name);
        distinct("spring", "springs", springs, faults);
        let steps = self.steps.iter().map(|step| step.step.name.as_str());
        distinct("step", "steps", steps, faults);
    }
}

fn distinct<'n>(
    kind: &'static str,
    list: &'static str,
    names: impl Iterator<Item = &'n str>,
    faults: &mut List,
) {
    let mut first = BTreeMap::new();
    for (index, name) in names.enumerate() {
        let earlier = *first.entry(name).or_insert(index);
        if earlier < index {
            let kind = FaultKind::DuplicateName {
                kind,
                name: name.to_owned(),
                first: Path::part(list, earlier),
            };
            faults.push(Path::part(list, index).field("name"), kind);
        }
    }
}

/// Faults found so far.
#[derive(Default)]
struct List(Vec<Fault>);

impl List {
    fn push(&mut self, path: Path, kind: FaultKind) {
        self.0.push(Fault { path, kind });
    }
}

/// Positions of parts that cannot be judged further.
type Positions = BTreeSet<usize>;
