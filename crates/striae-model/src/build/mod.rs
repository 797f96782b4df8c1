//! Models by names, as a deck writes them, in Rust.
//!
//! Bodies, sets, rigid surfaces and pairs are referred to by name; [`ModelBuilder::build`] looks
//! them up, validates the model and closes gaps as its pairs request.

mod cavity;
mod extend;
mod lookup;
mod paint;
mod pair;
mod parts;
mod spring;
mod step;
mod tie;

pub use cavity::{CavityBuilder, cavity};
pub use extend::extended;
pub use paint::{axial, circumferential, nodal, painted, radial, turned, uniform};
pub use pair::{PairBuilder, SideBuilder, itself, pair, rigid, surface};
pub use parts::{
    BodyBuilder, RigidBuilder, SectionBuilder, body, composite, plane, rigid_solid, rigid_surface,
    section, tied,
};
pub use spring::{
    SpringBuilder, SpringEndBuilder, nodes_of, point_of, reference_of, spring, spring_along,
    spring_to_point,
};
pub use step::{
    Component, Components, StepBuilder, equal_increments, shared_force, step, usual_curve,
};
pub use tie::{TieBuilder, tie};

use crate::{
    check::{Draft, DraftPair, DraftStep, Known, Named, Validate},
    fault::{Fault, Faults},
    fit::fitted,
    general::{Everything, Lowered},
    model::{Backend, Body, Cavity, Model, Pair, RigidSurface, Solver, Spring, Strategy, Tie},
    path::{Path, Segment},
};

use lookup::Names;
use step::{Prescribed, Resolved};

/// A model under construction; see [`model`].
#[derive(Clone, Debug)]
pub struct ModelBuilder {
    title: String,
    bodies: Vec<Body>,
    /// Of sections of bodies.
    faults: Vec<Fault>,
    rigid: Vec<RigidBuilder>,
    pairs: Vec<PairBuilder>,
    everything: Option<Everything>,
    ties: Vec<TieBuilder>,
    springs: Vec<SpringBuilder>,
    cavities: Vec<CavityBuilder>,
    steps: Vec<StepBuilder>,
    solver: Solver,
}

/// A model of this title, without anything in it.
pub fn model(title: impl Into<String>) -> ModelBuilder {
    ModelBuilder {
        title: title.into(),
        bodies: Vec::new(),
        faults: Vec::new(),
        rigid: Vec::new(),
        pairs: Vec::new(),
        everything: None,
        ties: Vec::new(),
        springs: Vec::new(),
        cavities: Vec::new(),
        steps: Vec::new(),
        solver: solver(),
    }
}

/// The solver where nothing else is said.
pub fn solver() -> Solver {
    Solver {
        backend: Backend::Condensed,
        strategy: Strategy::Semismooth,
        tolerance: 1e-10,
        largest_iterations: 40,
        further_iterations: 0,
    }
}

impl ModelBuilder {
    /// Adds a deformable body.
    pub fn body(mut self, body: BodyBuilder) -> Self {
        let (body, faults) = body.resolved(self.bodies.len());
        self.bodies.push(body);
        self.faults.extend(faults);
        self
    }

    /// Adds a rigid body.
    pub fn rigid(mut self, rigid: RigidBuilder) -> Self {
        self.rigid.push(rigid);
        self
    }

    /// Adds a contact pair.
    pub fn pair(mut self, pair: PairBuilder) -> Self {
        self.pairs.push(pair);
        self
    }

    /// Lets everything touch everything, itself included, besides what pairs and ties name; see
    /// [`everything`](crate::everything).
    pub fn contact(mut self, everything: Everything) -> Self {
        self.everything = Some(everything);
        self
    }

    /// Adds a tie.
    pub fn tie(mut self, tie: TieBuilder) -> Self {
        self.ties.push(tie);
        self
    }

    /// Adds springs.
    pub fn spring(mut self, spring: SpringBuilder) -> Self {
        self.springs.push(spring);
        self
    }

    /// Adds a cavity.
    pub fn cavity(mut self, cavity: CavityBuilder) -> Self {
        self.cavities.push(cavity);
        self
    }

    /// Adds a step after those before.
    pub fn step(mut self, step: StepBuilder) -> Self {
        self.steps.push(step);
        self
    }

    /// Replaces the settings of the solver.
    pub fn solver(mut self, solver: Solver) -> Self {
        self.solver = solver;
        self
    }

    /// The model, ready to be simulated.
    ///
    /// # Errors
    /// All faults: unknown names, everything [`Validate`] finds, meshes that overlap.
    pub fn build(self) -> Result<Model, Faults> {
        let mut faults = self.faults.clone();
        let rigid_names: Vec<&str> = self.rigid.iter().map(RigidBuilder::name).collect();
        let named: Vec<&str> = self.pairs.iter().map(PairBuilder::name).collect();
        let names = Names::new(&self.bodies, rigid_names.clone(), named.clone());
        let rigid: Vec<Option<RigidSurface>> = (self.rigid.iter().enumerate())
            .map(|(index, rigid)| rigid.resolved(index, &names, &mut faults))
            .collect();
        let pairs: Vec<Option<Pair>> = (self.pairs.iter().enumerate())
            .map(|(index, pair)| pair.resolved(index, &names, &mut faults))
            .collect();
        let ties: Vec<Option<Tie>> = (self.ties.iter().enumerate())
            .map(|(index, tie)| tie.resolved(index, &names, &mut faults))
            .collect();
        let springs: Vec<Option<Spring>> = (self.springs.iter().enumerate())
            .map(|(index, spring)| spring.resolved(index, (&names, &rigid), &mut faults))
            .collect();
        let cavities: Vec<Option<Cavity>> = (self.cavities.iter().enumerate())
            .map(|(index, cavity)| cavity.resolved(index, &names, &mut faults))
            .collect();
        let lowered = match &self.everything {
            None => Some(Lowered::default()),
            Some(everything) => {
                let draft = self.draft((&rigid, &pairs), (&ties, &springs), &[]);
                everything.lowered(&draft, &mut faults)
            }
        };
        // Where pairs are not known, no name of a pair is judged.
        let of_lowered = lowered.iter().flat_map(|of| &of.pairs);
        let all = named.iter().copied();
        let all = all.chain(of_lowered.map(|pair| pair.name.as_str()));
        let mut names = Names::new(&self.bodies, rigid_names, all.collect());
        names.cavities = self.cavities.iter().map(CavityBuilder::name).collect();
        if lowered.is_none() {
            names = names.with_other_pairs();
        }
        let mut prescribed = Prescribed::default();
        let steps: Vec<Resolved> = (self.steps.iter().enumerate())
            .map(|(index, step)| step.resolved(index, &names, &mut prescribed, &mut faults))
            .collect();
        if !faults.is_empty() {
            let mut draft = self.draft((&rigid, &pairs), (&ties, &springs), &steps);
            match &lowered {
                Some(lowered) => draft.extend(&lowered.pairs),
                None => draft.known = Known::InPart,
            }
            let found = draft.faults().into_iter();
            faults.extend(found.map(|fault| placed(fault, 0, &steps)));
            return Err(Faults(faults));
        }
        let model = Model {
            title: self.title,
            bodies: self.bodies,
            rigid_surfaces: rigid.into_iter().flatten().collect(),
            pairs: (pairs.into_iter().flatten())
                .chain(lowered.into_iter().flat_map(|of| of.pairs))
                .collect(),
            ties: ties.into_iter().flatten().collect(),
            springs: springs.into_iter().flatten().collect(),
            cavities: cavities.into_iter().flatten().collect(),
            steps: steps.into_iter().map(|resolved| resolved.step).collect(),
            solver: self.solver,
        };
        fitted(model.checked()?).map_err(Faults)
    }

    /// Draft of the model if some names are unknown.
    fn draft<'a>(
        &'a self,
        (rigid, pairs): (&'a [Option<RigidSurface>], &'a [Option<Pair>]),
        (ties, springs): (&'a [Option<Tie>], &'a [Option<Spring>]),
        steps: &'a [Resolved],
    ) -> Draft<'a> {
        let rigid = self.rigid.iter().zip(rigid).map(|(of, part)| Named {
            name: of.name(),
            part: part.as_ref(),
        });
        let pairs = self.pairs.iter().zip(pairs).map(|(of, pair)| DraftPair {
            name: of.name(),
            pair: pair.as_ref(),
            known: Known::Whole,
            is_named: true,
        });
        let ties = self.ties.iter().zip(ties).map(|(of, tie)| Named {
            name: of.name(),
            part: tie.as_ref(),
        });
        let springs = self.springs.iter().zip(springs).map(|(of, part)| Named {
            name: of.name(),
            part: part.as_ref(),
        });
        let steps = steps.iter().map(|resolved| DraftStep {
            step: &resolved.step,
            known: resolved.known,
            displacements: resolved.displacements(),
        });
        Draft {
            bodies: Draft::bodies(&self.bodies),
            rigid_surfaces: rigid.collect(),
            pairs: pairs.collect(),
            ties: ties.collect(),
            springs: springs.collect(),
            steps: steps.collect(),
            known: Known::Whole,
        }
    }
}

/// The fault with the position that its condition has in the builder, where others
/// before it are missing; the builder's steps count from `first`.
fn placed(fault: Fault, first: usize, steps: &[Resolved]) -> Fault {
    let path = match *fault.path.segments() {
        [
            Segment::Field("steps"),
            Segment::Index(step),
            Segment::Field(list),
            Segment::Index(index),
            ..,
        ] if step >= first => {
            let index = steps[step - first].position(list, index);
            Path::part("steps", step).field(list).index(index)
        }
        _ => fault.path,
    };
    Fault { path, ..fault }
}
