//! One increment: semismooth Newton's method.
//!
//! The first iteration is linearised at the last converged state with the new
//! loads, or where the increment before leads to, see [`Course`]; its solution takes the
//! prescribed displacements to their new values.
//! From then on the residual alone decides: labels of nodes at the kink of the
//! friction law may flip at round-off and are not required to rest.

mod acceptance;
mod attempt;
mod chord;
mod correction;
mod course;
mod cycling;
mod departure;
mod energy;
mod failure;
mod flight;
mod linear;
pub(crate) mod neighbour;
mod passage;
mod release;
mod rest;
mod rule;
mod selected;
mod work;
mod workspace;

pub use attempt::Acceptance;
pub use course::Course;
pub use work::{LinearWork, Times};
pub use workspace::{Memory, Workspace};

pub use striae_condensed::{Analysis, Experience, FactoredInterior, TangentSolver};
use striae_contact::{
    complementarity::Iteration, evaluation::Evaluation, interference::Interference,
    segment::Derivatives, selection::Selection,
};

use crate::{
    assembly::{Assembled, Setting, StepContext, Trial},
    audit::Doubt,
    norms::Norms,
    outcome::CutBack,
    problem::Problem,
    skin::BodyOverlap,
    state::State,
};
use acceptance::accepted;
use attempt::Attempt;
use failure::linear_system;
use linear::automatic;
use selected::{Selected, selected};

/// A converged increment.
#[derive(Clone, Debug)]
pub struct Increment {
    /// The new state.
    pub state: State,
    /// Its step, and whether it ends there.
    pub in_step: InStep,
    /// Norms of every iteration; the last ones are converged.
    pub iterations: Vec<Norms>,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Predicted memory of the factorisation in bytes.
    pub peak_bytes: usize,
    /// Work spent on the linear systems.
    pub work: LinearWork,
    /// Interferences that arose in the increment, deeper than
    /// [`SHARE`](striae_contact::interference::SHARE) of the facet size, by pair.
    pub interferences: Vec<Vec<Interference>>,
    /// Overlaps of bodies that no pair detects, deeper than that.
    pub overlaps: Vec<BodyOverlap>,
    /// Traction fields of all pairs.
    pub selections: Vec<Selection>,
    /// `true` if these were chosen again in the course of the iterations.
    pub has_reselected: bool,
    /// Criterion by which the increment was accepted.
    pub acceptance: Acceptance,
    /// Reasons to doubt the increment, as far as it has been audited.
    pub doubts: Vec<Doubt>,
}

/// Step of an increment, and its end within it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InStep {
    /// Number of the step.
    pub step: usize,
    /// End of the increment.
    pub reach: Reach,
}

/// End of an increment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Within its step.
    Within,
    /// End of its step.
    End,
}

impl InStep {
    /// An increment up to the fraction `s` of a step, which is 1 at its end.
    pub fn up_to(step: usize, s: f64) -> Self {
        let reach = match s < 1.0 {
            true => Reach::Within,
            false => Reach::End,
        };
        Self { step, reach }
    }
}

/// Told of every iteration.
pub trait IterationObserver {
    /// An iteration of Newton's method has been evaluated.
    fn iteration(&mut self, number: usize, norms: &Norms, contacts: &[Evaluation]);
}

/// An observer that ignores everything.
impl IterationObserver for () {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

/// Size of the linear systems at the start of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Predicted cost of a factorisation.
    pub analysis: Analysis,
    /// Predicted costs by methods that are taken where that one fails or costs more.
    pub others: Vec<Analysis>,
}

/// Predicts the cost of the first linear system of a problem that is on one rank.
///
/// # Errors
/// Returns why the undeformed state cannot be evaluated.
pub fn estimate(problem: &Problem) -> Result<Estimate, CutBack> {
    let state = State::undeformed(problem);
    let context = StepContext::new(problem, 0, &state);
    let mut workspace = Workspace::new(problem.model.solver.backend);
    assembled_at_start(&context, &state, &mut workspace)?;
    let system = workspace.system();
    let mut solver = automatic(problem.model.solver.backend);
    let partition = &system.partition;
    let analysis = solver
        .analyse(partition)
        .and_then(|analysis| Ok((analysis, solver.estimates(partition)?)));
    let (analysis, mut others) =
        analysis.map_err(|error| linear_system(problem, system.numbers(), error))?;
    others.retain(|other| other.method != analysis.method);
    Ok(Estimate {
        unknowns: partition.unknowns(),
        analysis,
        others,
    })
}

/// Forces and energies in `state`, with the loads at the start of the step.
///
/// # Errors
/// Returns why the state cannot be evaluated.
pub(crate) fn assembled_at_start(
    context: &StepContext,
    state: &State,
    workspace: &mut Workspace,
) -> Result<Assembled, CutBack> {
    assembled_at(context, state, 0.0, workspace)
}

/// Forces and energies in `state`, with the loads at the fraction `s` of the step.
///
/// # Errors
/// Returns why the state cannot be evaluated.
pub(crate) fn assembled_at(
    context: &StepContext,
    state: &State,
    s: f64,
    workspace: &mut Workspace,
) -> Result<Assembled, CutBack> {
    let imposed = context.imposed(s);
    let Selected {
        selections,
        tractions,
    } = selected(context, state, s, &imposed);
    workspace.prepare(context.problem, &selections);
    let trial = Trial {
        positions: state.positions.clone(),
        tractions,
        rigid: state.rigid.clone(),
        pressures: state.pressures.clone(),
    };
    let setting = Setting {
        context,
        state,
        selections: &selections,
        imposed: &imposed,
    };
    workspace.assemble(&setting, &trial, Iteration::First, Derivatives::First)
}

/// Advances from `state` to the fraction `s` of the step.
///
/// # Errors
/// Returns why the increment has to be cut.
pub fn advance(
    context: &StepContext,
    state: &State,
    s: f64,
    time: f64,
    workspace: &mut Workspace,
    observer: &mut dyn IterationObserver,
) -> Result<Increment, CutBack> {
    let imposed = context.imposed_after(state, s, time);
    let course = workspace.course.take();
    let course = course.filter(|course| course.leads_on(context, state));
    let mut attempt = Attempt::new(context, state, &imposed, s, workspace);
    if let Some(course) = &course {
        attempt.follow(course, time);
    }
    let mut assembled = attempt.solved(workspace, observer);
    if assembled.is_err() && attempt.follows() {
        attempt = attempt.anew(s, workspace);
        assembled = attempt.solved(workspace, observer);
    }
    let assembled = assembled?;
    let Attempt {
        selections,
        trial,
        mut given_up,
        iterations,
        interferences,
        overlaps,
        acceptance,
        origin,
        ..
    } = attempt;
    given_up.extend(iterations);
    // With inertia, accelerations jump where contact changes.
    let before = course.filter(|_| imposed.motion.is_none());
    workspace.course = Some(Course::new(context.index, state, time, before));
    let work = workspace.take_work();
    let system = workspace.system();
    let (unknowns, peak_bytes) = (system.unknowns(), system.analysis.cost.peak_bytes);
    Ok(Increment {
        work,
        unknowns,
        peak_bytes,
        interferences,
        overlaps,
        acceptance,
        doubts: Vec::new(),
        in_step: InStep::up_to(context.index, s),
        state: accepted(
            context,
            state,
            time,
            trial,
            imposed.clone(),
            &selections,
            assembled,
        ),
        selections,
        has_reselected: origin.has_reselected(),
        iterations: given_up,
    })
}
