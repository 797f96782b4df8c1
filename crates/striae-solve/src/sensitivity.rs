//! Derivatives of a run by parameters of its model.
//!
//! Beside the run at `p` go two neighbours of it, at `p - h` and `p + h`, for each parameter:
//!
//! ```text
//! df/dp = (f(s_+; p + h) - f(s_-; p - h)) / 2h + O(h^2)
//! ```
//!
//! for whatever is computed from a state `s`: a position, a force, an energy, a column of the
//! history. A parameter is any number that a model follows from: a coefficient of friction, a
//! modulus, the end of a curve, a place of nodes.
//!
//! Neighbours are no runs of their own. They follow the run increment by increment by one
//! correction with its tangent, see `newton/neighbour.rs`, in its increments, with its kept nodes
//! and their statuses.
//! States `s_-` and `s_+` take along all that an increment hands on to the next one: positions,
//! velocities, tractions, internal variables, energies. So the derivative is that of the discrete
//! equations, implicit differentiation with the converged tangent, and no history is kept.
//!
//! At a kink, such as a node between stick and slip or open and closed, the derivative is
//! one-sided, that of the branch of the run: by themselves the neighbours would take different ones,
//! see [`Kink`].

use std::{collections::BTreeMap, sync::Arc};

use striae_contact::{side::Side, unknowns::Status};
use striae_element::Formulation;
use striae_surface::node::SurfaceNode;

use crate::{
    assembly::StepContext,
    begin::begin,
    drive::{Progress, look_farther},
    newton::{
        Course, Increment, Workspace,
        neighbour::{Base, Moved, Neighbour, Size, linearise, moved},
    },
    outcome::CutBack,
    problem::Problem,
    state::State,
};
use striae_model::{Body, Procedure};

/// A parameter of a model.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// `h`.
    pub step: f64,
    /// The problems at `p - h` and `p + h`.
    pub problems: [Arc<Problem>; 2],
}

/// Neighbours of a run for every parameter.
pub struct Sensitivities {
    problem: Arc<Problem>,
    workspace: Workspace,
    /// State at the start of the step.
    start: State,
    /// State at the end of the last increment.
    before: State,
    /// Distance over which the run looks for contact, by pair, at least.
    search: Vec<f64>,
    neighbours: Vec<Neighbours>,
}

/// The two neighbours of a run for a parameter.
#[derive(Clone, Debug)]
pub struct Neighbours {
    /// The parameter.
    pub parameter: Parameter,
    /// Their states.
    pub states: [State; 2],
    /// Largest change that a further correction of an increment would have made, over the largest
    /// differences of the neighbours until then.
    pub remainder: f64,
    /// Nodes that have been at a kink.
    pub kinks: Vec<Kink>,
    starts: [State; 2],
    courses: [Option<Course>; 2],
    largest: Size,
}

/// A node at which the neighbours of a run would take different branches in an increment.
#[derive(Clone, Debug, PartialEq)]
pub struct Kink {
    /// Number of the pair.
    pub pair: usize,
    /// Side of the node.
    pub side: Side,
    /// The node.
    pub node: SurfaceNode,
    /// Time at the end of the increment.
    pub time: f64,
    /// Status that it would have at `p - h` and at `p + h`.
    pub statuses: [Status; 2],
}

/// A parameter that changes more than numbers.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{parameter}` changes {what} of the model; a derivative takes models with the same parts, elements and increments"
)]
pub struct Unlike {
    /// Its name.
    pub parameter: String,
    /// Part of the model that it changes.
    pub what: &'static str,
}

impl Sensitivities {
    /// Neighbours of a run that begins undeformed.
    ///
    /// # Errors
    /// When a parameter changes more than numbers.
    pub fn new(problem: &Arc<Problem>, parameters: Vec<Parameter>) -> Result<Self, Unlike> {
        let state = State::undeformed(problem);
        for parameter in &parameters {
            for neighbour in &parameter.problems {
                if let Some(what) = unlike(problem, neighbour) {
                    let parameter = parameter.name.clone();
                    return Err(Unlike { parameter, what });
                }
            }
        }
        Ok(Self {
            workspace: Workspace::new(problem.model.solver.backend),
            problem: Arc::clone(problem),
            start: state.clone(),
            before: state,
            search: Vec::new(),
            neighbours: parameters.into_iter().map(Neighbours::new).collect(),
        })
    }

    /// Neighbours by parameter.
    pub fn neighbours(&self) -> &[Neighbours] {
        &self.neighbours
    }

    /// Begins a step.
    ///
    /// # Errors
    /// Why a neighbour cannot begin it.
    pub fn step(&mut self, index: usize) -> Result<(), CutBack> {
        let workspace = &mut self.workspace;
        self.start = begin(&self.problem, index, &self.before, workspace)?;
        self.before.clone_from(&self.start);
        for of in &mut self.neighbours {
            for (at, problem) in of.parameter.problems.iter().enumerate() {
                of.starts[at] = begin(problem, index, &of.states[at], workspace)?;
                of.states[at].clone_from(&of.starts[at]);
                of.courses[at] = None;
            }
        }
        Ok(())
    }

    /// Notes that an increment was cut.
    pub fn cut_back(&mut self, reason: &CutBack) {
        look_farther(&self.problem, &mut self.search, reason);
    }

    /// Moves the neighbours to the end of an increment of the run, whose workspace lends its
    /// factors.
    ///
    /// # Errors
    /// Why one of them cannot follow.
    pub fn increment(
        &mut self,
        progress: Progress,
        increment: &Increment,
        run: &Workspace,
    ) -> Result<(), CutBack> {
        let search = std::mem::take(&mut self.search);
        let context = StepContext::new(&self.problem, progress.step, &self.start);
        let base = Base {
            context: &context.looking(&search),
            before: &self.before,
            increment,
            fraction: progress.fraction,
        };
        let contexts: Vec<[StepContext; 2]> = self
            .neighbours
            .iter()
            .map(|of| {
                [0, 1].map(|at| {
                    let (problem, start) = (&of.parameter.problems[at], &of.starts[at]);
                    StepContext::new(problem, progress.step, start).looking(&search)
                })
            })
            .collect();
        // Their own iterations, where they make any, take other matrices than the tangent.
        let mut set_out = Vec::with_capacity(self.neighbours.len());
        for (of, contexts) in self.neighbours.iter().zip(&contexts) {
            let mut neighbour = |at: usize| {
                let course = of.courses[at].clone();
                Neighbour::new(
                    &base,
                    &contexts[at],
                    &of.states[at],
                    course,
                    &mut self.workspace,
                )
            };
            set_out.push([neighbour(0)?, neighbour(1)?]);
        }
        let mut linearised = linearise(&base, run, &mut self.workspace)?;
        let mut arrived = Vec::with_capacity(self.neighbours.len());
        for (of, two) in self.neighbours.iter().zip(set_out) {
            arrived.push(moved(&base, two, of.largest, &mut linearised)?);
        }
        for (of, moved) in self.neighbours.iter_mut().zip(arrived) {
            of.arrive(progress.step, moved);
        }
        self.before.clone_from(&increment.state);
        Ok(())
    }
}

impl Neighbours {
    fn new(parameter: Parameter) -> Self {
        let states = parameter.problems.each_ref();
        let states = states.map(|problem| State::undeformed(problem));
        Self {
            parameter,
            starts: states.clone(),
            states,
            courses: [None, None],
            largest: Size::default(),
            remainder: 0.0,
            kinks: Vec::new(),
        }
    }

    /// Derivative of a quantity by the parameter.
    pub fn derivative(&self, quantity: impl Fn(&Problem, &State) -> f64) -> f64 {
        let [less, more] = [0, 1].map(|at| {
            let problem = &self.parameter.problems[at];
            quantity(problem, &self.states[at])
        });
        (more - less) / (2.0 * self.parameter.step)
    }

    fn arrive(&mut self, step: usize, moved: Moved) {
        let Moved {
            states,
            otherwise,
            largest,
            remainder,
        } = moved;
        for (at, after) in states.iter().enumerate() {
            let before = &self.states[at];
            let procedure = &self.parameter.problems[at].model.steps[step].procedure;
            let has_inertia = *procedure != Procedure::QuasiStatic;
            let last = self.courses[at].take().filter(|_| !has_inertia);
            self.courses[at] = Some(Course::new(step, before, after.time, last));
        }
        self.kinks.extend(kinks(&states, &otherwise));
        self.states = states;
        self.largest = largest;
        self.remainder = self.remainder.max(remainder);
    }
}

/// Nodes that would have different statuses in two states.
fn kinks(
    states: &[State; 2],
    otherwise: &[Vec<(usize, Side, SurfaceNode, Status)>; 2],
) -> Vec<Kink> {
    let mut found: BTreeMap<(usize, Side, SurfaceNode), [Status; 2]> = BTreeMap::new();
    for (at, nodes) in otherwise.iter().enumerate() {
        for &(pair, side, node, status) in nodes {
            let given = states[at].pairs[pair].nodes[side][node].status;
            found.entry((pair, side, node)).or_insert([given; 2])[at] = status;
        }
    }
    let time = 0.5 * (states[0].time + states[1].time);
    let kink = |((pair, side, node), statuses): (_, [Status; 2])| Kink {
        pair,
        side,
        node,
        time,
        statuses,
    };
    let different = found
        .into_iter()
        .filter(|(_, statuses)| statuses[0] != statuses[1]);
    different.map(kink).collect()
}

/// Part of a problem that differs from another one in more than numbers.
fn unlike(problem: &Problem, other: &Problem) -> Option<&'static str> {
    let names = |problem: &Problem| -> [Vec<String>; 4] {
        let model = &problem.model;
        [
            model.bodies.iter().map(|body| body.name.clone()).collect(),
            model.pairs.iter().map(|pair| pair.name.clone()).collect(),
            model
                .rigid_surfaces
                .iter()
                .map(|rigid| rigid.name.clone())
                .collect(),
            model.steps.iter().map(|step| step.name.clone()).collect(),
        ]
    };
    let kinds = ["bodies", "contact pairs", "rigid surfaces", "steps"];
    let named = names(problem).into_iter().zip(names(other)).zip(kinds);
    let named = named
        .filter(|((own, others), _)| own != others)
        .map(|(_, kind)| kind);
    let bodies = || problem.model.bodies.iter().zip(&other.model.bodies);
    let formulations = |body: &Body| -> Vec<Formulation> {
        let sections = 0..=body.sections.len();
        sections
            .map(|section| body.formulation_of(section))
            .collect()
    };
    let has_other_cells =
        bodies().any(|(own, other)| !own.mesh.elements().eq(other.mesh.elements()));
    let has_other_formulation =
        || bodies().any(|(own, other)| formulations(own) != formulations(other));
    let mut steps = problem.model.steps.iter().zip(&other.model.steps);
    // Neighbours follow the run in its increments.
    let mut has_other_increments = || steps.any(|(own, other)| own.increments != other.increments);
    match named.into_iter().next() {
        Some(kind) => Some(kind),
        None if has_other_cells => Some("the elements"),
        None if has_other_formulation() => Some("the formulation of elements"),
        None if has_other_increments() => Some("the increments"),
        None => None,
    }
}
