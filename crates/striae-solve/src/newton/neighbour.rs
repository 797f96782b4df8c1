//! Increments of neighbouring problems, by the tangent of one that has converged.
//!
//! A parameter `p` of a model and the state `s` before an increment enter its residual
//! `R(x; s, p)`. Two neighbours at `p - h` and `p + h` start from states `s_-`, `s_+` of their own.
//! Where the increment has come to `x`, with the tangent `K = dR/dx` there,
//!
//! ```text
//! K d = -(R(x; s_+, p + h) - R(x; s_-, p - h)) / 2,   x_- = x - d,   x_+ = x + d
//! ```
//!
//! The error of `d` is of the order `h^3`, as even powers of `h` cancel, and so does what Newton's
//! method left of the residual at `x`. No neighbour iterates: it takes kept nodes, statuses and kinds
//! of directions of friction from the increment, so that its rows are those of `K`. By its own state a
//! node on the verge of slip would change its status at `x` already, as its slip is counted from `s_-`
//! or `s_+`. So neighbours start where the motion of the increment leads from there, `x` and what
//! they differed by before it.
//!
//! The error that is left is measured by what another such correction would change, and taken away
//! by it where it is not small.

mod size;

use striae_contact::{
    complementarity::Iteration, evaluation::Evaluation, segment::Derivatives, selection::Selection,
    side::Side, unknowns::Status,
};
use striae_mesh::Vec3;
use striae_sparse::SolveError;
use striae_surface::node::SurfaceNode;

use super::{
    Increment, Workspace,
    acceptance::accepted,
    attempt::Attempt,
    correction::corrected,
    course::Course,
    failure::linear_system,
    selected::{Selected, selected_in},
};
pub(crate) use size::Size;

use crate::{
    assembly::{Assembled, Imposed, Setting, StepContext, Trial},
    outcome::CutBack,
    problem::Problem,
    rigid::Pose,
    state::State,
};

/// Parts of the residual that the first correction and the others leave. Central differences are
/// off by some 1e-9 of the first, and the others only measure and take away what it leaves.
const PARTS: [f64; 2] = [1e-9, 0.1];
/// Part of the first correction below which another one changes nothing.
const NOTHING: f64 = 1e-7;
/// Remainder where a neighbour keeps other nodes than the increment, so that nothing is known of it.
const UNLIKE: f64 = 1.0;
/// Most corrections of an increment.
const CORRECTIONS: usize = 4;

/// Converged increment with the state it started from.
pub(crate) struct Base<'a> {
    /// Its step.
    pub context: &'a StepContext<'a>,
    /// The state before it.
    pub before: &'a State,
    /// Converged increment.
    pub increment: &'a Increment,
    /// Fraction of the step at its end.
    pub fraction: f64,
}

impl Base<'_> {
    /// Positions that its motion leads to from those of a state.
    fn moved(&self, before: &State) -> Vec<Vec3> {
        let ends = self.increment.state.positions.iter();
        let starts = before.positions.iter().zip(&self.before.positions);
        let moved = ends.zip(starts);
        moved
            .map(|(end, (own, start))| end + (own - start))
            .collect()
    }

    /// Poses that its motion leads to from those of a state.
    fn turned(&self, before: &State) -> Vec<Pose> {
        let ends = self.increment.state.rigid.iter();
        let starts = before.rigid.iter().zip(&self.before.rigid);
        let turned = ends.zip(starts).map(|(end, (own, start))| {
            let [end, of_own, start] = [end, own, start].map(Pose::coordinates);
            own.moved_to(&std::array::from_fn(|at| {
                end[at] + (of_own[at] - start[at])
            }))
        });
        turned.collect()
    }
}

/// A neighbouring problem at the start of an increment.
pub(crate) struct Neighbour<'a> {
    context: &'a StepContext<'a>,
    before: &'a State,
    time: f64,
    imposed: Imposed,
    selections: Vec<Selection>,
    /// `true` if it keeps the nodes of the increment, whose tangent is then its own.
    is_like: bool,
    trial: Trial,
}

/// Two neighbours after an increment.
pub(crate) struct Moved {
    /// Their states.
    pub states: [State; 2],
    /// Nodes, by pair, that would have another status in them than in the run, with that.
    pub otherwise: [Vec<(usize, Side, SurfaceNode, Status)>; 2],
    /// Largest differences from the run in its increments so far.
    pub largest: Size,
    /// Part of these that a further correction would have changed.
    pub remainder: f64,
}

impl<'a> Neighbour<'a> {
    /// A neighbour whose step has the same fraction, at its own time.
    ///
    /// # Errors
    /// Why its own iterations fail, where the traction fields of the increment depend on those.
    pub(crate) fn new(
        base: &Base,
        context: &'a StepContext<'a>,
        before: &'a State,
        course: Option<Course>,
        workspace: &mut Workspace,
    ) -> Result<Self, CutBack> {
        let step = &context.problem.model.steps[context.index];
        let time = context.start.time + base.fraction * step.duration;
        let imposed = context.imposed_after(before, base.fraction, time);
        let after = &base.increment.state.pairs;
        let Selected {
            mut selections,
            mut tractions,
        } = selected_in(context, before, (base.fraction, &imposed), Some(after));
        if base.increment.has_reselected {
            let place = (context, before, &imposed);
            selections = iterated(place, base.fraction, time, course, workspace)?;
        }
        let mut is_like = true;
        for (selection, of_base) in selections.iter_mut().zip(&base.increment.selections) {
            is_like &= selection.take_freedoms_like(of_base);
        }
        for (tractions, after) in tractions.iter_mut().zip(after) {
            tractions.nodes.clone_from(&after.tractions.nodes);
            tractions.settle(&after.nodes);
        }
        workspace.extend(context.problem, &selections);
        let mut trial = Trial {
            positions: base.moved(before),
            rigid: workspace.poses_at(&imposed, &base.turned(before)),
            pressures: base.increment.state.pressures.clone(),
            tractions,
        };
        trial.place_tied(context.problem);
        Ok(Self {
            context,
            before,
            time,
            imposed,
            selections,
            is_like,
            trial,
        })
    }

    fn setting(&self) -> Setting<'_> {
        Setting {
            context: self.context,
            state: self.before,
            selections: &self.selections,
            imposed: &self.imposed,
        }
    }

    fn assembled(&self, workspace: &mut Workspace) -> Result<Assembled, CutBack> {
        let (setting, iteration) = (self.setting(), Iteration::Given);
        workspace.assemble(&setting, &self.trial, iteration, Derivatives::None)
    }
}

/// Traction fields that a neighbour's own iterations choose.
fn iterated<'a>(
    (context, before, imposed): (&'a StepContext<'a>, &'a State, &'a Imposed),
    s: f64,
    time: f64,
    course: Option<Course>,
    workspace: &mut Workspace,
) -> Result<Vec<Selection>, CutBack> {
    let course = course.filter(|course| course.leads_on(context, before));
    let mut attempt = Attempt::new(context, before, imposed, s, workspace);
    if let Some(course) = &course {
        attempt.follow(course, time);
    }
    let mut solved = attempt.solved(workspace, &mut ());
    if solved.is_err() && attempt.follows() {
        attempt = attempt.anew(s, workspace);
        solved = attempt.solved(workspace, &mut ());
    }
    solved?;
    Ok(attempt.selections)
}

/// Tangent at the end of an increment, by which its neighbours are moved.
pub(crate) struct Linearised<'a> {
    problem: &'a Problem,
    workspace: &'a mut Workspace,
    /// The workspace of the run, while the factors of its last iterations serve.
    run: Option<&'a Workspace>,
}

/// Evaluates the tangent at the end of an increment that `run` has come to.
///
/// # Errors
/// Why it cannot be.
pub(crate) fn linearise<'a>(
    base: &Base<'a>,
    run: &'a Workspace,
    workspace: &'a mut Workspace,
) -> Result<Linearised<'a>, CutBack> {
    let (context, increment) = (base.context, base.increment);
    let state = &increment.state;
    let imposed = context.imposed_after(base.before, base.fraction, state.time);
    workspace.extend_to(context.problem, run);
    workspace.prepare(context.problem, &increment.selections);
    let of_pairs = state.pairs.iter().zip(&base.before.pairs);
    let tractions = of_pairs.map(|(after, before)| {
        let mut tractions = after.tractions.clone();
        // The rows of the increment saw slip and state up to its start.
        tractions
            .accumulated
            .clone_from(&before.tractions.accumulated);
        tractions.states.clone_from(&before.tractions.states);
        tractions.factors.clone_from(&before.tractions.factors);
        tractions.settle(&after.nodes);
        tractions
    });
    let trial = Trial {
        positions: state.positions.clone(),
        tractions: tractions.collect(),
        rigid: state.rigid.clone(),
        pressures: state.pressures.clone(),
    };
    let setting = Setting {
        context,
        state: base.before,
        selections: &increment.selections,
        imposed: &imposed,
    };
    workspace.assemble(&setting, &trial, Iteration::Given, Derivatives::First)?;
    Ok(Linearised {
        problem: context.problem,
        workspace,
        run: Some(run),
    })
}

impl Linearised<'_> {
    /// Solves for a correction, up to a part of the residual.
    ///
    /// GMRES makes up for what the factors of the run, of an iteration shortly before, differ by.
    fn correction(&mut self, residual: &[f64], part: f64) -> Result<Vec<f64>, CutBack> {
        let solved = self.solved(residual, part);
        solved.map_err(|error| unsolved(self.problem, self.workspace, error))
    }

    fn solved(&mut self, residual: &[f64], part: f64) -> Result<Vec<f64>, SolveError> {
        if let Some(run) = self.run {
            let beside = self.workspace.correction_beside(run, residual, part)?;
            if let Some(correction) = beside {
                return Ok(correction);
            }
            self.run = None;
            self.workspace.factor()?;
        }
        self.workspace.chord_correction(residual, part)
    }
}

fn unsolved(problem: &Problem, workspace: &mut Workspace, error: SolveError) -> CutBack {
    linear_system(problem, workspace.system().numbers(), error)
}

/// Residuals of two neighbours.
fn both(two: &[Neighbour; 2], workspace: &mut Workspace) -> Result<[Assembled; 2], CutBack> {
    Ok([two[0].assembled(workspace)?, two[1].assembled(workspace)?])
}

/// Moves two neighbours to the end of an increment with its tangent, after they have differed by
/// `largest` at most so far.
///
/// # Errors
/// Why a state of theirs cannot be evaluated.
pub(crate) fn moved(
    base: &Base,
    mut two: [Neighbour; 2],
    mut largest: Size,
    linearised: &mut Linearised,
) -> Result<Moved, CutBack> {
    let problem = base.context.problem;
    let mut assembled = both(&two, linearised.workspace)?;
    let ends = &base.increment.state;
    let carried = two
        .each_ref()
        .map(|of| Size::between(&of.trial.positions, &ends.positions));
    let carried = carried[0].max(&carried[1]);
    let round_off = Size::round_off(ends);
    let (mut first, mut part): (Option<Size>, f64) = (None, f64::INFINITY);
    let mut last = Size::default();
    for number in 0..CORRECTIONS {
        let [less, more] = assembled.each_ref().map(|assembled| &assembled.residual);
        let half: Vec<f64> = more
            .iter()
            .zip(less)
            .map(|(more, less)| 0.5 * (more - less))
            .collect();
        let correction = linearised.correction(&half, PARTS[number.min(1)])?;
        let workspace = &mut *linearised.workspace;
        last = Size::of(&correction, problem, &workspace.system().layout);
        let first = first.get_or_insert_with(|| last.max(&carried));
        let before = std::mem::replace(&mut part, last.over(&first.max(&round_off)));
        // Corrections that do not fall are round-off, or the tangent is not that of both neighbours,
        // and would lead away from them.
        if part <= NOTHING || part >= before {
            break;
        }
        for (neighbour, factor) in two.iter_mut().zip([-1.0, 1.0]) {
            let system = workspace.system();
            let (setting, trial) = (neighbour.setting(), &neighbour.trial);
            neighbour.trial = corrected(&setting, system, trial, &correction, factor);
        }
        assembled = both(&two, workspace)?;
    }
    largest = first.map_or(largest, |first| largest.max(&first));
    let differences = largest.beyond(&round_off);
    let mut remainder = last.over(&differences);
    if two.iter().any(|neighbour| !neighbour.is_like) {
        remainder = remainder.max(UNLIKE);
    }
    let otherwise = assembled.each_ref().map(|assembled| {
        let contacts = assembled.contacts.iter().enumerate();
        let of_pair = |(pair, contact): (usize, &Evaluation)| {
            let nodes = contact.otherwise.iter();
            let nodes = nodes.map(|&(side, node, status)| (pair, side, node, status));
            nodes.collect::<Vec<_>>()
        };
        contacts.flat_map(of_pair).collect()
    });
    let mut states = two
        .into_iter()
        .zip(assembled)
        .map(|(neighbour, assembled)| {
            let Neighbour {
                context,
                before,
                time,
                imposed,
                selections,
                trial,
                ..
            } = neighbour;
            accepted(
                context,
                before,
                time,
                trial,
                imposed,
                &selections,
                assembled,
            )
        });
    let states = [states.next(), states.next()].map(|state| state.expect("there are two"));
    Ok(Moved {
        states,
        otherwise,
        largest,
        remainder,
    })
}
