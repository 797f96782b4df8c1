//! Decks that are run to their end.

use std::path::Path;

use striae_contact::evaluation::Evaluation;
use striae_deck::parse;
use striae_solve::{
    drive::{Continue, Observer, Progress, run},
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    state::State,
};

/// Keeps the last converged state.
#[derive(Default)]
struct Last(Option<State>);

impl IterationObserver for Last {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Last {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, _: Progress, increment: &Increment) -> Continue {
        self.0 = Some(increment.state.clone());
        Continue::Yes
    }

    fn cut_back(&mut self, _: Progress, _: &CutBack) -> Continue {
        Continue::Yes
    }
}

/// The problem of a deck and the state at its end.
pub fn last(text: &str) -> (Problem, State) {
    let model = parse(text, "deck.toml", Path::new("")).unwrap().model;
    let problem = Problem::new(model).unwrap();
    let mut observer = Last::default();
    let (_, ending) = run(&problem, State::undeformed(&problem), &mut observer);
    assert_eq!(ending, Ending::Completed, "{text}");
    (problem, observer.0.expect("a run has an increment"))
}
