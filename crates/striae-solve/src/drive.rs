//! Steps and increments.
//!
//! Longer than other files, as it is the whole course of a run.

use serde::{Deserialize, Serialize};
use striae_contact::{
    interference::facing,
    side::Side,
    unknowns::{NodeResult, Status},
};

use crate::{
    assembly::StepContext,
    audit::{doubts, jump},
    begin::begin,
    freedom::{Bridged, Friction, free_motion, free_motion_in, slipping, worth_stabilising},
    newton::{Increment, IterationObserver, Memory, Workspace, advance, assembled_at},
    outcome::{CutBack, Ending, Remedy},
    problem::Problem,
    share::Share,
    stabilisation::first_increment,
    state::State,
    support::{Way, unsupported},
};
use striae_model::{Model, PairId, Procedure, initial::other_name};

/// Told of everything that happens in a run.
pub trait Observer: IterationObserver {
    /// A step begins.
    fn step(&mut self, index: usize, name: &str);
    /// An increment has converged, in a workspace that still has the factors of its last
    /// iterations; [`Observer::increment`] follows.
    fn converged(&mut self, _progress: Progress, _increment: &Increment, _workspace: &Workspace) {}
    /// An increment has converged.
    fn increment(&mut self, progress: Progress, increment: &Increment) -> Continue;
    /// A point that was requested by the response to [`Observer::increment`] or
    /// [`Observer::cut_back`], or the last one of a step that does not reach its end.
    fn point(&mut self, _point: Point) {}
    /// An increment has failed and is tried again with a smaller one.
    fn cut_back(&mut self, progress: Progress, reason: &CutBack) -> Continue;
}

/// Decision whether a run continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Continue {
    /// The run continues.
    Yes,
    /// The run continues, and the observer receives its present point.
    Keep,
    /// The run ends after this increment, and the observer receives its point.
    Stop,
}

impl Continue {
    /// Common decision of all ranks of a run: to stop if one does, to keep if one does; collective.
    fn together(self, share: &Share) -> Self {
        let own = match self {
            Self::Yes => 0.0,
            Self::Keep => 1.0,
            Self::Stop => 2.0,
        };
        // Ranks that disagreed would wait for each other for ever.
        match share.largest(own) {
            0.0 => Self::Yes,
            1.0 => Self::Keep,
            _ => Self::Stop,
        }
    }
}

/// Position of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Number of the step.
    pub step: usize,
    /// Number of the increment, over all steps, from 1.
    pub increment: usize,
    /// Fraction of the step at the end of the increment.
    pub fraction: f64,
    /// Time at the end of the increment.
    pub time: f64,
}

/// Number of times in a step that a doubted increment is repeated with a smaller one. If that does
/// not help, it is accepted with a warning.
const DOUBTS: usize = 4;

/// Iterations up to which an increment counts as easy.
const EASY: usize = 6;
const GROWTH: f64 = 1.5;
const CUT: f64 = 0.5;

/// A place in a run from which it can continue as if it had not stopped.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Point {
    /// Number of the step.
    pub step: usize,
    /// Number of increments so far.
    pub increments: usize,
    /// Fraction of the step that is done.
    pub fraction: f64,
    /// Size of the next increment.
    pub size: f64,
    /// Number of times that increments of the step have been repeated because of doubts.
    pub doubted: usize,
    /// Distance over which it looks for contact, by pair, at least; empty after an increment
    /// that has converged.
    pub search: Vec<f64>,
    /// State in which the step began.
    pub start: State,
    /// Last converged state.
    pub state: State,
    /// Size of the linear system and experience of its solver.
    pub memory: Memory,
}

/// Runs all steps from `state`.
pub fn run(problem: &Problem, state: State, observer: &mut dyn Observer) -> (State, Ending) {
    run_after(problem, 0, state, 0, observer)
}

/// Runs the steps from number `first` on, from the `state` at the end of those before,
/// which took so many `increments`.
pub fn run_after(
    problem: &Problem,
    first: usize,
    state: State,
    increments: usize,
    observer: &mut dyn Observer,
) -> (State, Ending) {
    let workspace = Workspace::new(problem.model.solver.backend);
    run_in(workspace, problem, (first, increments), state, observer)
}

/// Runs all steps in a given workspace, such as that of one of several ranks; collective there. The
/// pair holds the number of the first step and the number of increments of all earlier steps.
pub fn run_in(
    mut workspace: Workspace,
    problem: &Problem,
    (first, increments): (usize, usize),
    state: State,
    observer: &mut dyn Observer,
) -> (State, Ending) {
    run_steps(problem, first, state, increments, &mut workspace, observer)
}

/// Continues from a point of an earlier run, with results identical to the last bit.
pub fn resume(problem: &Problem, point: Point, observer: &mut dyn Observer) -> (State, Ending) {
    let workspace = Workspace::new(problem.model.solver.backend);
    resume_in(workspace, problem, point, observer)
}

/// Resumes a run in a given workspace, such as that of one of several ranks; collective there.
pub fn resume_in(
    workspace: Workspace,
    problem: &Problem,
    point: Point,
    observer: &mut dyn Observer,
) -> (State, Ending) {
    let mut workspace = workspace.recalling(problem, &point.memory);
    let context = StepContext::new(problem, point.step, &point.start);
    let mut progress = Division {
        count: point.increments,
        done: point.fraction,
        size: point.size,
        doubted: point.doubted,
        search: point.search,
    };
    let mut state = point.state;
    observer.step(point.step, &problem.model.steps[point.step].name);
    match run_step(
        &context,
        &mut state,
        &mut progress,
        &mut workspace,
        observer,
    ) {
        Some(ending) => (state, ending),
        None => {
            let (next, count) = (point.step + 1, progress.count);
            run_steps(problem, next, state, count, &mut workspace, observer)
        }
    }
}

/// Progress of the division of a step into increments.
struct Division {
    count: usize,
    done: f64,
    size: f64,
    /// Number of times that increments have been repeated because of doubts.
    doubted: usize,
    /// Distance over which the next attempt looks for contact, by pair, at least.
    search: Vec<f64>,
}

impl Division {
    /// An increment up to a fraction of the step has converged.
    fn converged(&mut self, fraction: f64, increment: &Increment, largest: f64) {
        self.count += 1;
        self.done = fraction;
        // The larger search distance was for the motion of one increment, and costs time.
        self.search.clear();
        // Corrections of contact alone are not among these iterations.
        if increment.iterations.len() <= EASY {
            self.size = (self.size * GROWTH).min(largest);
        }
    }

    /// The point that a step has reached in `state`.
    fn point(&self, context: &StepContext, state: &State, workspace: &Workspace) -> Point {
        Point {
            step: context.index,
            increments: self.count,
            fraction: self.done,
            size: self.size,
            doubted: self.doubted,
            search: self.search.clone(),
            start: context.start.clone(),
            state: state.clone(),
            memory: workspace.memory(),
        }
    }

    /// An increment with what it is doubted for; collective.
    ///
    /// # Errors
    /// A jump; and the first doubt, as long as a smaller increment is worth a try.
    fn doubted(
        &mut self,
        context: &StepContext,
        before: &State,
        mut increment: Increment,
        fraction: f64,
    ) -> Result<Increment, CutBack> {
        let problem = context.problem;
        if let Some(jump) = jump(context, before, &increment.state) {
            return Err(jump.cut_back(problem));
        }
        increment.doubts = doubts(problem, before, &increment.state);
        let smaller = (fraction - self.done) * CUT;
        // A doubt is no failure: rather than end the run, the increment is accepted with a warning.
        let may_be_cut = smaller >= problem.model.steps[context.index].increments.smallest;
        match increment.doubts.first() {
            Some(doubt) if may_be_cut && self.doubted < DOUBTS => {
                self.doubted += 1;
                Err(doubt.cut_back(problem))
            }
            _ => Ok(increment),
        }
    }
}

/// After bodies have gone through each other, the next attempt looks for contact from
/// the start on over the distance that they went.
pub(crate) fn look_farther(problem: &Problem, search: &mut Vec<f64>, reason: &CutBack) {
    let CutBack::Passage { pair, way, .. } = reason else {
        return;
    };
    search.resize(problem.pairs.len(), 0.0);
    for (known, search) in problem.pairs.iter().zip(search) {
        if known.contact.name == *pair {
            // The pair missed contact over this distance, so the next attempt has to look that far.
            *search = search.max(*way);
        }
    }
}

fn run_steps(
    problem: &Problem,
    first: usize,
    mut state: State,
    mut count: usize,
    workspace: &mut Workspace,
    observer: &mut dyn Observer,
) -> (State, Ending) {
    for index in first..problem.model.steps.len() {
        observer.step(index, &problem.model.steps[index].name);
        let start = match begin(problem, index, &state, workspace) {
            Ok(start) => start,
            Err(reason) => {
                let step = problem.model.steps[index].name.clone();
                let time = state.time;
                return (state, Ending::Stopped { step, time, reason });
            }
        };
        state.clone_from(&start);
        let context = StepContext::new(problem, index, &start);
        let mut division = Division {
            count,
            done: 0.0,
            size: first_increment(&problem.model, index),
            doubted: 0,
            search: Vec::new(),
        };
        let ending = run_step(&context, &mut state, &mut division, workspace, observer);
        if let Some(ending) = ending {
            return (state, ending);
        }
        count = division.count;
    }
    (state, Ending::Completed)
}

fn run_step(
    context: &StepContext,
    state: &mut State,
    division: &mut Division,
    workspace: &mut Workspace,
    observer: &mut dyn Observer,
) -> Option<Ending> {
    let step = &context.problem.model.steps[context.index];
    while division.done < 1.0 {
        let fraction = target(division.done, division.size);
        let progress = Progress {
            step: context.index,
            increment: division.count + 1,
            fraction,
            time: context.start.time + fraction * step.duration,
        };
        let attempted = attempted(context, state, progress, division, (workspace, observer));
        let attempted = attempted.and_then(|made| division.doubted(context, state, made, fraction));
        let next = match attempted {
            Ok(increment) => {
                observer.converged(progress, &increment, workspace);
                let next = observer.increment(progress, &increment);
                division.converged(fraction, &increment, step.increments.largest);
                *state = increment.state;
                next
            }
            Err(reason) => {
                // A body without restraint explains the failure better than a residual does.
                let reason = free(context, state).unwrap_or(reason);
                let size = (fraction - division.done) * CUT;
                let helps = reason.remedy() == Remedy::SmallerIncrement;
                let ends = !helps || size < step.increments.smallest;
                if ends {
                    // Before this attempt, so that who goes on from there makes it again.
                    observer.point(division.point(context, state, workspace));
                }
                let next = observer.cut_back(progress, &reason);
                if ends {
                    let reached = [division.done, fraction];
                    return Some(stopped(context, state, reached, workspace, reason));
                }
                look_farther(context.problem, &mut division.search, &reason);
                division.size = size;
                next
            }
        };
        let next = next.together(&context.problem.share);
        if next != Continue::Yes {
            observer.point(division.point(context, state, workspace));
        }
        if next == Continue::Stop {
            return Some(Ending::Interrupted { time: state.time });
        }
    }
    None
}

/// An increment to the target of a step.
fn attempted(
    context: &StepContext,
    state: &State,
    progress: Progress,
    division: &Division,
    (workspace, observer): (&mut Workspace, &mut dyn Observer),
) -> Result<Increment, CutBack> {
    let Progress { fraction, time, .. } = progress;
    if let Some(reason) = not_bridged(context, state, fraction) {
        return Err(reason);
    }
    if division.search.is_empty() {
        return advance(context, state, fraction, time, workspace, observer);
    }
    let context = context.looking(&division.search);
    advance(&context, state, fraction, time, workspace, observer)
}

/// The end of a run in which no increment beyond `state` is possible, nor one to the fraction
/// `wanted` of the step; collective.
fn stopped(
    context: &StepContext,
    state: &State,
    [reached, wanted]: [f64; 2],
    workspace: &mut Workspace,
    reason: CutBack,
) -> Ending {
    let limit = || at_limit(context, state, reached);
    let found = match reason {
        CutBack::NotBridged { .. }
        | CutBack::Overlap { .. }
        | CutBack::Crossing { .. }
        | CutBack::Free { .. }
        | CutBack::Factor { .. } => None,
        CutBack::Released { .. } => limit(),
        _ => {
            let mut unheld =
                |ways: &[(f64, Way)]| unheld(context, state, (reached, ways), workspace);
            // Loads at the end of the step tell nothing of a body that slides before.
            unheld(&[(wanted, Way::Tips), (1.0, Way::Tips)])
                .or_else(limit)
                .or_else(|| unheld(&[(wanted, Way::Slides)]))
        }
    };
    Ending::Stopped {
        step: context.problem.model.steps[context.index].name.clone(),
        time: state.time,
        reason: found.unwrap_or(reason),
    }
}

/// The body that contact does not hold, if that is why there is no equilibrium beyond `state`, in
/// one of some ways, each with the loads at a fraction of the step. Collective.
fn unheld(
    context: &StepContext,
    state: &State,
    (reached, ways): (f64, &[(f64, Way)]),
    workspace: &mut Workspace,
) -> Option<CutBack> {
    let model = &context.problem.model;
    if model.steps[context.index].procedure != Procedure::QuasiStatic {
        return None;
    }
    let found = ways.iter().find_map(|&(s, way)| {
        let found = assembled_at(context, state, s, workspace).ok()?;
        unsupported(context, state, &found.forces.applied, way)
    })?;
    let pair = &context.problem.pairs[found.pair];
    let own = if pair.bodies[0] == Some(found.body) {
        Side::A
    } else {
        Side::B
    };
    let body = model.bodies[found.body].name.clone();
    let other = other_name(model, PairId(found.pair), own).to_owned();
    let pair = context.pairs[found.pair].name.clone();
    Some(match found.way {
        Way::Tips => CutBack::Tips {
            body,
            other,
            pair,
            reached,
        },
        Way::Slides => CutBack::Slides {
            body,
            other,
            pair,
            largest: context.plan.frictions[found.pair].largest_coefficient(),
            reached,
        },
    })
}

/// The motion that nothing holds, if that is why there is no equilibrium beyond `state`.
fn free(context: &StepContext, state: &State) -> Option<CutBack> {
    let step = &context.problem.model.steps[context.index];
    if step.procedure != Procedure::QuasiStatic {
        return None;
    }
    let motion = free_motion_in(context, state, Bridged::Stabilised)?;
    let stabilise = worth_stabilising(context, state, &motion);
    Some(CutBack::Free {
        motion: Box::new(motion),
        stabilise: stabilise.map(|pair| context.pairs[pair].name.clone()),
    })
}

/// The motion that nothing holds any more at the end `s = 1` of a step with stabilised pairs.
fn not_bridged(context: &StepContext, state: &State, s: f64) -> Option<CutBack> {
    let stabilised = context.stabilisation.iter().any(|c| *c > 0.0);
    if s < 1.0 || !stabilised {
        return None;
    }
    let motion = free_motion_in(context, state, Bridged::None)?;
    let (pair, gap) = widest(context, state)?;
    Some(CutBack::NotBridged {
        pair: context.pairs[pair].name.clone(),
        motion: Box::new(motion),
        gap,
    })
}

/// The stabilised pair that is farthest apart, and how far.
fn widest(context: &StepContext, state: &State) -> Option<(usize, f64)> {
    let pairs = context.stabilisation.iter().enumerate();
    let gaps = pairs.filter(|(_, c)| **c > 0.0).map(|(pair, _)| {
        let configuration = context.configuration(pair, &state.positions, &state.rigid);
        let gaps = facing(&configuration).into_iter().map(|node| node.gap);
        let closed = state.pairs[pair].nodes.iter().flatten();
        let touches = closed.into_iter().any(|node| node.status != Status::Open);
        let gap = gaps.fold(f64::INFINITY, f64::min);
        (pair, if touches { 0.0 } else { gap })
    });
    gaps.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The limit of friction, if that is why there is no equilibrium beyond `state`: all nodes
/// of a pair slip, and but for friction a body is free.
fn at_limit(context: &StepContext, state: &State, reached: f64) -> Option<CutBack> {
    let contacts: Vec<_> = state.pairs.iter().map(|pair| &pair.nodes).collect();
    let slipping = slipping(contacts.iter().copied());
    let pair = slipping.iter().position(|slips| *slips)?;
    let motion = free_motion(context, state.into(), &contacts, Friction::Reserve)?;
    Some(CutBack::FrictionLimit {
        pair: context.pairs[pair].name.clone(),
        sticking: count(contacts[pair], Status::Stick),
        motion: Box::new(motion),
        reached,
    })
}

fn count(nodes: &[Vec<NodeResult>; 2], status: Status) -> usize {
    let nodes = nodes.iter().flatten();
    nodes.filter(|node| node.status == status).count()
}

/// Returns the fewest increments that a step takes: those of a run in which all are easy.
pub fn fewest_increments(model: &Model, step: usize) -> f64 {
    let largest = model.steps[step].increments.largest;
    let mut size = first_increment(model, step);
    let (mut done, mut count) = (0.0, 0.0);
    while done < 1.0 && size < largest {
        done = target(done, size);
        size = (size * GROWTH).min(largest);
        count += 1.0;
    }
    // A quotient of round numbers is one more only by its round-off.
    count + ((1.0 - done) / largest - 1e-9).ceil()
}

/// End of an increment of about the given size; the last one takes what is left.
fn target(done: f64, size: f64) -> f64 {
    let end = done + size;
    // What the rounding below adds up to in thousands of increments is no increment of its own.
    if end > 1.0 - f64::max(1e-9, 1e-3 * size) {
        1.0
    } else {
        // Increments of a whole number a step end at the same fractions whatever the sum's round-off.
        let rounded = (end * 1e12).round() / 1e12;
        rounded.max(done + 0.5 * size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_increments_are_as_many_as_stated() {
        for count in [1, 3, 7, 1000, 12_000, 30_000] {
            let size = 1.0 / f64::from(count);
            let mut done = 0.0;
            let mut made = 0;
            while done < 1.0 {
                done = target(done, size);
                made += 1;
            }
            assert_eq!(made, count);
        }
    }
}
