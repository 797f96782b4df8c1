//! One increment: semismooth Newton's method.
//!
//! The first iteration is linearised at the last converged state with the new
//! loads; its solution takes the prescribed displacements to their new values.
//! From then on the residual alone decides: labels of nodes at the kink of the
//! friction law may flip at round-off and are not required to rest.
//!
//! Longer than other files, as an increment under way and what decides of it belong together.

mod acceptance;
mod cycling;
mod departure;
mod energy;
mod failure;
mod rest;
mod selected;
mod work;
mod workspace;

pub use work::{LinearWork, Times};
pub use workspace::{Memory, Workspace};

use striae_contact::{
    complementarity::Iteration,
    evaluation::Evaluation,
    pointed::Pierced,
    selection::Selection,
    table_1::{Corrector, Inflation},
    unknowns::{NodeResult, Tractions},
};
use striae_linalg::REDUCTION;
pub use striae_linalg::{Analysis, Experience, FactoredInterior};
use striae_mesh::Vec3;

use crate::{
    assembly::{Assembled, Imposed, Setting, StepContext, Trial},
    layout::Layout,
    model::Strategy,
    norms::Norms,
    outcome::CutBack,
    problem::Problem,
    state::{NodalForces, State},
};
use acceptance::accepted;
use cycling::History;
use departure::first_positions;
use failure::{linear_system, missed};
use rest::contact_at_rest;
use selected::{Selected, pierced, reselected, selected};
use workspace::SystemStorage;

/// A converged increment.
#[derive(Clone, Debug)]
pub struct Increment {
    /// The new state.
    pub state: State,
    /// Norms of every iteration; the last ones are converged.
    pub iterations: Vec<Norms>,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Predicted memory of the factorisation in bytes.
    pub peak_bytes: usize,
    /// What the linear systems took.
    pub work: LinearWork,
}

/// Told of every iteration.
pub trait IterationObserver {
    /// An iteration of Newton's method has been evaluated.
    fn iteration(&mut self, number: usize, norms: &Norms, contacts: &[Evaluation]);
}

/// Nobody is told.
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

/// Predicts the cost of the first linear system of a problem.
///
/// # Errors
/// Why the undeformed state cannot be evaluated.
pub fn estimate(problem: &Problem) -> Result<Estimate, CutBack> {
    let state = State::undeformed(problem);
    let context = StepContext::new(problem, 0, &state);
    let mut workspace = Workspace::new(problem.model.solver.backend);
    forces_at_start(&context, &state, &mut workspace)?;
    let structure = workspace.system().matrix.structure().clone();
    let analysis = workspace
        .solver
        .analyse(&structure)
        .and_then(|analysis| Ok((analysis, workspace.solver.estimates(&structure)?)));
    let (analysis, mut others) =
        analysis.map_err(|error| linear_system(problem, &workspace.system().layout, error))?;
    others.retain(|other| other.method != analysis.method);
    Ok(Estimate {
        unknowns: structure.unknowns(),
        analysis,
        others,
    })
}

/// Forces in `state`, with the loads at the start of the step.
///
/// # Errors
/// Why the state cannot be evaluated.
pub fn forces_at_start(
    context: &StepContext,
    state: &State,
    workspace: &mut Workspace,
) -> Result<NodalForces, CutBack> {
    let Selected {
        selections,
        tractions,
    } = selected(context, state, 0.0);
    workspace.prepare(context.problem, &selections);
    let trial = Trial {
        positions: state.positions.clone(),
        tractions,
        rigid: state.rigid.clone(),
    };
    let imposed = context.imposed(0.0);
    let setting = Setting {
        context,
        state,
        selections: &selections,
        imposed: &imposed,
    };
    let assembled = workspace.assemble(&setting, &trial, Iteration::First)?;
    Ok(assembled.forces)
}

/// Advances from `state` to the fraction `s` of the step.
///
/// # Errors
/// Why the increment has to be cut.
pub fn advance(
    context: &StepContext,
    state: &State,
    s: f64,
    time: f64,
    workspace: &mut Workspace,
    observer: &mut dyn IterationObserver,
) -> Result<Increment, CutBack> {
    let imposed = context.imposed_after(state, s, time);
    let Selected {
        selections,
        tractions,
    } = selected(context, state, s);
    workspace.prepare(context.problem, &selections);
    workspace.take_work();
    let rigid = workspace.first_poses(&imposed);
    let trial = Trial {
        positions: first_positions(context, state, &imposed, &rigid, &selections),
        tractions,
        rigid,
    };
    let mut attempt = Attempt {
        context,
        state,
        imposed: &imposed,
        selections,
        trial,
        iterations: Vec::new(),
        history: History::default(),
        inflation: Inflation::default(),
    };
    let mut assembled = workspace.assemble(&attempt.setting(), &attempt.trial, Iteration::First)?;
    for repetition in 0.. {
        assembled = attempt.converge(assembled, workspace, observer)?;
        let missed = missed(&attempt.setting(), &attempt.trial);
        let pierced = attempt.pierced(&assembled);
        if repetition == REPETITIONS {
            missed.map_or(Ok(()), Err)?;
            break;
        }
        if missed.is_none() && pierced.iter().all(Pierced::is_empty) {
            break;
        }
        let (setting, trial) = (attempt.setting(), &attempt.trial);
        let found = reselected(&setting, trial, &assembled.contacts, &pierced);
        assembled = attempt.taken_up(found, workspace)?;
    }
    let work = workspace.take_work();
    let Attempt {
        selections,
        trial,
        iterations,
        ..
    } = attempt;
    let system = workspace.system();
    Ok(Increment {
        work,
        unknowns: system.layout.unknowns(),
        peak_bytes: system.analysis.peak_bytes,
        state: accepted(
            context,
            state,
            time,
            trial,
            imposed.clone(),
            selections,
            assembled,
        ),
        iterations,
    })
}

/// How often an increment is solved again with nodes that it turned out to need.
const REPETITIONS: usize = 3;

/// An increment under way.
struct Attempt<'a> {
    context: &'a StepContext<'a>,
    state: &'a State,
    imposed: &'a Imposed,
    selections: Vec<Selection>,
    trial: Trial,
    iterations: Vec<Norms>,
    history: History,
    inflation: Inflation,
}

impl Attempt<'_> {
    fn setting(&self) -> Setting<'_> {
        Setting {
            context: self.context,
            state: self.state,
            selections: &self.selections,
            imposed: self.imposed,
        }
    }

    /// Iterates until the residual is small.
    fn converge(
        &mut self,
        mut assembled: Assembled,
        workspace: &mut Workspace,
        observer: &mut dyn IterationObserver,
    ) -> Result<Assembled, CutBack> {
        let solver = &self.context.problem.model.solver;
        let mut further = solver.further_iterations;
        loop {
            let before = self.iterations.last().map(Norms::largest);
            let number = self.iterations.len() + 1;
            let iteration = later(solver.strategy, self.inflation, number);
            let taken;
            (assembled, taken) = self.iterate(&assembled, before, iteration, workspace)?;
            if let Some(selected) = self.refreshed(number, &assembled) {
                assembled = self.taken_up(selected, workspace)?;
            }
            let norms = assembled.norms;
            self.iterations.push(norms);
            self.history.push(&assembled.contacts);
            observer.iteration(number, &norms, &assembled.contacts);
            // A part of a correction leaves prescribed displacements on their way.
            let settled = taken == Taken::Whole && is_final(iteration);
            if norms.largest() <= solver.tolerance && settled {
                if further == 0 {
                    return Ok(assembled);
                }
                further -= 1;
            }
            self.inflation = self.inflation.after(norms.gap);
            self.judge(number, &norms)?;
        }
    }

    /// One correction.
    fn iterate(
        &mut self,
        assembled: &Assembled,
        before: Option<f64>,
        iteration: Iteration,
        workspace: &mut Workspace,
    ) -> Result<(Assembled, Taken), CutBack> {
        let context = self.context;
        let tolerance = context.problem.model.solver.tolerance;
        let correction = workspace
            .correction(&assembled.residual, part(before, tolerance))
            .map_err(|error| linear_system(context.problem, &workspace.system().layout, error))?;
        let at_rest = match iteration {
            Iteration::Later { .. } => {
                let at = (&self.trial, assembled);
                contact_at_rest(workspace, &self.setting(), at, &correction, before)
            }
            Iteration::First | Iteration::Corrected(_) => None,
        };
        if let Some((trial, assembled)) = at_rest {
            self.trial = trial;
            return Ok((assembled, Taken::Whole));
        }
        labelled(&mut self.trial, &assembled.contacts);
        let (trial, assembled, taken) = step(
            workspace,
            &self.setting(),
            &self.trial,
            iteration,
            &correction,
        )?;
        self.trial = trial;
        Ok((assembled, taken))
    }

    /// The traction field with what the first iteration shows to come into contact.
    fn refreshed(&self, number: usize, assembled: &Assembled) -> Option<Selected> {
        if number > 1 {
            return None;
        }
        let pierced = self.pierced(assembled);
        let comes = missed(&self.setting(), &self.trial).is_some();
        (comes || !pierced.iter().all(Pierced::is_empty)).then(|| {
            let setting = self.setting();
            reselected(&setting, &self.trial, &assembled.contacts, &pierced)
        })
    }

    /// What pierces the other side, by pair.
    fn pierced(&self, assembled: &Assembled) -> Vec<Pierced> {
        let contacts = &assembled.contacts;
        pierced(self.context, &self.selections, &self.trial, contacts)
    }

    /// Goes on with another traction field.
    fn taken_up(
        &mut self,
        selected: Selected,
        workspace: &mut Workspace,
    ) -> Result<Assembled, CutBack> {
        self.selections = selected.selections;
        self.trial.tractions = selected.tractions;
        workspace.extend(self.context.problem, &self.selections);
        let strategy = self.context.problem.model.solver.strategy;
        let iteration = later(strategy, self.inflation, self.iterations.len() + 1);
        workspace.assemble(&self.setting(), &self.trial, iteration)
    }

    /// Whether to go on.
    fn judge(&self, number: usize, norms: &Norms) -> Result<(), CutBack> {
        if !norms.largest().is_finite() || norms.force > 1e8 {
            return Err(CutBack::Diverged {
                iteration: number,
                norms: *norms,
            });
        }
        if number >= self.context.problem.model.solver.largest_iterations {
            return Err(CutBack::NoConvergence {
                iterations: number,
                norms: *norms,
                cycling: self.history.cycling(self.context.problem, &self.selections),
            });
        }
        Ok(())
    }
}

/// What an iteration after the first one goes by.
fn later(strategy: Strategy, inflation: Inflation, number: usize) -> Iteration {
    match strategy {
        Strategy::Semismooth => Iteration::Later {
            slip_weight: slip_weight(number),
        },
        Strategy::Table1 { stick_tolerance } => Iteration::Corrected(Corrector {
            stick_tolerance,
            inflation,
        }),
    }
}

/// `r_t` over its default. Cycles of first contact do not end with smaller increments, but
/// with another `r_t`, first a smaller and then a larger one.
fn slip_weight(number: usize) -> f64 {
    match number {
        0..=13 => 1.0,
        14..=26 => 0.03,
        _ => 10.0,
    }
}

/// Whether the friction of an iteration is the true one.
fn is_final(iteration: Iteration) -> bool {
    match iteration {
        Iteration::First | Iteration::Later { .. } => true,
        Iteration::Corrected(corrector) => corrector.inflation.is_over(),
    }
}

/// Largest part of the residual that a correction leaves.
const LARGEST_PART: f64 = 1e-3;

/// Part of the residual that a correction may leave, after which the norm is about as
/// small as bodies that are not linear let it be.
fn part(norm: Option<f64>, tolerance: f64) -> f64 {
    norm.map_or(REDUCTION, |norm| {
        (0.01 * norm).max(0.1 * tolerance / norm).min(LARGEST_PART)
    })
}

/// Gives the nodes of a trial state the status they have been found to have.
fn labelled(trial: &mut Trial, contacts: &[Evaluation]) {
    let side = |nodes: &Vec<NodeResult>| nodes.iter().map(|node| node.status).collect();
    for (tractions, contact) in trial.tractions.iter_mut().zip(contacts) {
        tractions.statuses = contact.nodes.each_ref().map(side);
    }
}

/// Smallest part of a correction that is tried.
const SMALLEST_PART: f64 = 1.0 / 16.0;

/// How much of a correction was applied.
#[derive(Clone, Copy, PartialEq)]
enum Taken {
    Whole,
    Part,
}

/// Applies a correction, halved while it turns elements inside out.
fn step(
    workspace: &mut Workspace,
    setting: &Setting,
    trial: &Trial,
    iteration: Iteration,
    correction: &[f64],
) -> Result<(Trial, Assembled, Taken), CutBack> {
    let (mut factor, mut taken) = (1.0, Taken::Whole);
    loop {
        let next = corrected(setting, workspace.system(), trial, correction, factor);
        match workspace.assemble(setting, &next, iteration) {
            Ok(assembled) => return Ok((next, assembled, taken)),
            Err(CutBack::InvertedElement { .. }) if factor > SMALLEST_PART => {
                (factor, taken) = (0.5 * factor, Taken::Part);
            }
            Err(other) => return Err(other),
        }
    }
}

fn corrected(
    setting: &Setting,
    system: &SystemStorage,
    trial: &Trial,
    correction: &[f64],
    factor: f64,
) -> Trial {
    let layout = &system.layout;
    let problem = setting.context.problem;
    let mut next = trial.clone();
    for (rigid, pose) in next.rigid.iter_mut().enumerate() {
        if let Some(first) = layout.rigid(rigid) {
            let present = pose.coordinates();
            let moved = std::array::from_fn(|at| present[at] + factor * correction[first + at]);
            *pose = setting.imposed.before[rigid].moved_to(&moved);
        }
    }
    for (node, position) in next.positions.iter_mut().enumerate() {
        if let Some(rigid) = problem.tie_of[node] {
            let reference = &problem.model.rigid_surfaces[rigid].reference;
            let placement = next.rigid[rigid].placement(reference);
            *position = placement.point(&problem.reference[node]);
            continue;
        }
        let first = layout.position(node);
        *position += Vec3::from_column_slice(&correction[first..first + 3]) * factor;
    }
    for (pair, tractions) in next.tractions.iter_mut().enumerate() {
        add_tractions(layout, pair, tractions, correction, factor);
    }
    next
}

fn add_tractions(
    layout: &Layout,
    pair: usize,
    tractions: &mut Tractions,
    correction: &[f64],
    factor: f64,
) {
    for side in 0..2 {
        for (node, unknowns) in tractions.nodes[side].iter_mut().enumerate() {
            if let Some(first) = layout.traction(pair, side, node) {
                for (component, unknown) in unknowns.iter_mut().enumerate() {
                    *unknown += factor * correction[first + component];
                }
            }
        }
    }
}
