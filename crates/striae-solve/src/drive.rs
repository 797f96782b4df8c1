//! Steps and increments.

use crate::{
    assembly::StepContext,
    dynamics::begin,
    newton::{Increment, IterationObserver, Workspace, advance},
    outcome::{CutBack, Ending},
    problem::Problem,
    state::State,
};

/// Told of everything that happens in a run.
pub trait Observer: IterationObserver {
    /// A step begins.
    fn step(&mut self, index: usize, name: &str);
    /// An increment has converged.
    fn increment(&mut self, progress: Progress, increment: &Increment) -> Continue;
    /// An increment has failed and is tried again with a smaller one.
    fn cut_back(&mut self, progress: Progress, reason: &CutBack);
}

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Continue {
    /// It does.
    Yes,
    /// It ends after this increment.
    Stop,
}

/// Where a run is.
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

/// Iterations up to which an increment counts as easy.
const EASY: usize = 6;
const GROWTH: f64 = 1.5;
const CUT: f64 = 0.5;

/// Runs all steps from `state`.
pub fn run(problem: &Problem, state: State, observer: &mut dyn Observer) -> (State, Ending) {
    let mut workspace = Workspace::new(problem.model.solver.backend);
    let mut state = state;
    let mut count = 0;
    for index in 0..problem.model.steps.len() {
        observer.step(index, &problem.model.steps[index].name);
        let start = match begin(problem, index, &state, &mut workspace) {
            Ok(start) => start,
            Err(reason) => {
                let step = problem.model.steps[index].name.clone();
                let time = state.time;
                return (state, Ending::Stopped { step, time, reason });
            }
        };
        state.clone_from(&start);
        let context = StepContext::new(problem, index, &start);
        let ending = run_step(&context, &mut state, &mut count, &mut workspace, observer);
        if let Some(ending) = ending {
            return (state, ending);
        }
    }
    (state, Ending::Completed)
}

fn run_step(
    context: &StepContext,
    state: &mut State,
    count: &mut usize,
    workspace: &mut Workspace,
    observer: &mut dyn Observer,
) -> Option<Ending> {
    let step = &context.problem.model.steps[context.index];
    let mut size = step.increments.initial.min(step.increments.largest);
    let mut done = 0.0;
    while done < 1.0 {
        let fraction = target(done, size);
        let progress = Progress {
            step: context.index,
            increment: *count + 1,
            fraction,
            time: context.start.time + fraction * step.duration,
        };
        match advance(context, state, fraction, progress.time, workspace, observer) {
            Ok(increment) => {
                *count += 1;
                done = fraction;
                if increment.iterations.len() <= EASY {
                    size = (size * GROWTH).min(step.increments.largest);
                }
                let next = observer.increment(progress, &increment);
                *state = increment.state;
                if next == Continue::Stop {
                    return Some(Ending::Interrupted { time: state.time });
                }
            }
            Err(reason) => {
                observer.cut_back(progress, &reason);
                size = (fraction - done) * CUT;
                if size < step.increments.smallest {
                    return Some(Ending::Stopped {
                        step: step.name.clone(),
                        time: state.time,
                        reason,
                    });
                }
            }
        }
    }
    None
}

/// End of an increment of about the given size; the last one takes what is left.
fn target(done: f64, size: f64) -> f64 {
    let end = done + size;
    if end > 1.0 - 1e-9 {
        1.0
    } else {
        // Increments of a whole number a step end at the same fractions whatever the sum's round-off.
        let rounded = (end * 1e12).round() / 1e12;
        rounded.max(done + 0.5 * size)
    }
}
