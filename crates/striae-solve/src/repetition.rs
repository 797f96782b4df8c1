//! A run, every increment of which is made again by another linear solver.
//!
//! Answers are those of the system, whichever solver is used. Two runs show that only as
//! long as no solver has to cut an increment that the other one gets through: from there
//! on their increments differ. So each increment is made again from where it began.

use striae_contact::{evaluation::Evaluation, unknowns::NodeResult};
use striae_mesh::Vec3;

use crate::{
    assembly::StepContext,
    begin::begin,
    drive::{Continue, Observer, Progress},
    newton::{Increment, IterationObserver, Workspace, advance},
    norms::{Norms, larger},
    outcome::CutBack,
    problem::Problem,
    state::State,
};
use striae_model::Backend;

/// An observer that makes every increment of a run again.
pub struct Repetition<'a> {
    problem: &'a Problem,
    workspace: Workspace,
    /// The start of the step as this solver finds it.
    start: Result<State, CutBack>,
    /// State at which the next increment starts.
    state: State,
    differences: Vec<Result<Difference, CutBack>>,
}

/// Distance between two states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Largest distance between positions of a node, over the largest distance of one
    /// from the origin.
    pub positions: f64,
    /// Largest difference of the tractions at a contact node, over the largest traction
    /// of its pair.
    pub tractions: f64,
}

impl<'a> Repetition<'a> {
    /// Of a run from `state`.
    pub fn new(problem: &'a Problem, state: &State, backend: Backend) -> Self {
        Self {
            problem,
            workspace: Workspace::new(backend),
            start: Ok(state.clone()),
            state: state.clone(),
            differences: Vec::new(),
        }
    }

    /// Results for every increment: the distance of the other solver's state from that of the run,
    /// or the reason why that solver would cut the increment.
    pub fn differences(&self) -> &[Result<Difference, CutBack>] {
        &self.differences
    }

    /// The increment that ends at `progress`, made by the other solver.
    fn again(&mut self, progress: Progress) -> Result<Increment, CutBack> {
        let start = self.start.as_ref().map_err(CutBack::clone)?;
        let context = StepContext::new(self.problem, progress.step, start);
        let Progress { fraction, time, .. } = progress;
        let (state, workspace) = (&self.state, &mut self.workspace);
        advance(&context, state, fraction, time, workspace, &mut ())
    }
}

impl IterationObserver for Repetition<'_> {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Repetition<'_> {
    fn step(&mut self, index: usize, _: &str) {
        self.start = begin(self.problem, index, &self.state, &mut self.workspace);
        if let Ok(start) = &self.start {
            self.state.clone_from(start);
        }
    }

    fn increment(&mut self, progress: Progress, increment: &Increment) -> Continue {
        let again = self.again(progress);
        let difference = again.map(|again| Difference::between(&increment.state, &again.state));
        self.differences.push(difference);
        self.state.clone_from(&increment.state);
        Continue::Yes
    }

    fn cut_back(&mut self, _: Progress, _: &CutBack) -> Continue {
        Continue::Yes
    }
}

impl Difference {
    /// The difference of `other` from `state`.
    pub fn between(state: &State, other: &State) -> Self {
        let pairs = state.pairs.iter().zip(&other.pairs).map(|(pair, other)| {
            let [a, b] = [pair, other].map(|pair| pair.nodes.iter().flatten().map(traction));
            relative(a, b)
        });
        let [a, b] = [state, other].map(|state| state.positions.iter().copied());
        Self {
            positions: relative(a, b),
            tractions: pairs.fold(0.0, larger),
        }
    }

    /// The larger one of both differences in each.
    pub fn larger(self, other: Self) -> Self {
        Self {
            positions: larger(self.positions, other.positions),
            tractions: larger(self.tractions, other.tractions),
        }
    }
}

fn traction(node: &NodeResult) -> Vec3 {
    node.tau - node.normal * node.pressure
}

/// Largest distance of corresponding vectors over the largest of the first ones.
fn relative(a: impl Iterator<Item = Vec3>, b: impl Iterator<Item = Vec3>) -> f64 {
    let (mut size, mut distance) = (0.0, 0.0);
    for (a, b) in a.zip(b) {
        size = larger(size, a.norm());
        distance = larger(distance, (a - b).norm());
    }
    if distance == 0.0 {
        0.0
    } else {
        distance / size
    }
}
