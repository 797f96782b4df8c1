//! A run on several ranks that writes files, and can be stopped.

use std::{
    num::NonZeroUsize,
    path::{Path, PathBuf},
    sync::Arc,
};

use striae::{
    deck::{self, Deck},
    model::Backend,
    output::{
        Existing, OutputError,
        checkpoint::{
            Checkpoint, Index, Source, fingerprint, part_fingerprints, step_fingerprints,
        },
        recorder::Recorder,
    },
    solve::{
        drive::{self, Continue, Observer, Point, Progress},
        newton::{Increment, IterationObserver, Workspace},
        outcome::{CutBack, Ending},
        problem::Problem,
        share::Division,
        state::State,
        team::{Gathered, Team, Together},
    },
};
use striae_contact::evaluation::Evaluation;
use striae_solve::norms::Norms;

const DECK: &str = r#"
title = "A block of metal pressed on a soft one and drawn over it"

[[material]]
name = "metal"
law = "elastic-plastic"
youngs_modulus = 100
poissons_ratio = 0.3
yield_stress = 0.15
hardening_modulus = 10

[[material]]
name = "soft"
law = "linear-elastic"
youngs_modulus = 20
poissons_ratio = 0.3

[[body]]
name = "lower"
material = "soft"
mesh = { generator = "block", origin = [0, 0, 0], size = [1, 1, 0.5], divisions = [4, 4, 3] }

[[body]]
name = "upper"
material = "metal"
mesh = { generator = "block", origin = [0.2, 0.2, 0.5], size = [0.6, 0.6, 0.5], divisions = [3, 3, 3] }

[[pair]]
name = "between"
a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }
friction = { law = "coulomb", mu = 0.3 }

[[step]]
name = "press"
increments = 2
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.02 },
]

[[step]]
name = "draw"
increments = 3
displacement = [{ body = "upper", nodes = "zmax", x = 0.05, y = 0.01 }]

[output]
body_fields = [
    "displacement", "velocity", "cauchy-stress", "von-mises", "principal-stress",
    "logarithmic-strain", "strain-energy-density", "history-variables", "section",
]
probes = [
    { name = "middle", body = "upper", point = [0.45, 0.52, 0.7] },
    { name = "top", body = "upper", nodes = "zmax" },
]
sections = [{ name = "low", body = "lower", point = [0, 0, 0.2], normal = [0, 0, 1] }]
"#;

fn deck() -> Deck {
    let mut deck = deck::parse(DECK, "deck.toml", Path::new("")).unwrap();
    deck.model.solver.backend = Backend::Multifrontal;
    deck.model.solver.tolerance = 1e-11;
    deck.output.checkpoint_every = NonZeroUsize::new(1);
    deck
}

/// Writes a run, and stops it after so many increments.
struct Watch<'a> {
    problem: &'a Problem,
    deck: &'a Deck,
    folder: &'a Path,
    recorder: Recorder,
    before: State,
    last: usize,
    failure: Option<OutputError>,
    /// Called after each increment.
    after: &'a (dyn Fn(usize) + Sync),
}

impl IterationObserver for Watch<'_> {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Watch<'_> {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, progress: Progress, increment: &Increment) -> Continue {
        self.recorder.judge(self.problem, &self.before, increment);
        self.before = increment.state.clone();
        let written = self.recorder.increment(self.problem, progress, increment);
        self.failure = self.failure.take().or(written.err());
        (self.after)(progress.increment);
        match self.failure.is_some() || progress.increment >= self.last {
            true => Continue::Stop,
            false => Continue::Keep,
        }
    }

    fn point(&mut self, point: Point) {
        if self.failure.is_none() {
            self.failure = self.keep(point).err();
        }
    }

    fn cut_back(&mut self, _: Progress, _: &CutBack) -> Continue {
        self.recorder.cut_back();
        Continue::Yes
    }
}

impl Watch<'_> {
    fn keep(&self, point: Point) -> Result<(), OutputError> {
        let (model, output) = (&self.deck.model, &self.deck.output);
        let checkpoint = Checkpoint {
            source: Source {
                case: "case".to_owned(),
                path: PathBuf::from("deck.toml"),
                settings: Vec::new(),
                fields: None,
                fingerprint: fingerprint(model, output),
                parts: part_fingerprints(model),
                steps: step_fingerprints(model),
            },
            written: self.recorder.written()?,
            point,
        };
        checkpoint.write_shared(self.folder, self.problem)
    }
}

/// Ending of a run on so many ranks, from its start or its checkpoint, up to an increment.
pub fn run(folder: &Path, ranks: usize, from: From, last: usize) -> Result<Ending, String> {
    run_while(folder, ranks, from, last, &|_, _| {})
}

#[derive(Clone, Copy, PartialEq)]
pub enum From {
    Start,
    Checkpoint,
}

/// Runs like [`run`], calling a function on each rank after each increment.
pub fn run_while(
    folder: &Path,
    ranks: usize,
    from: From,
    last: usize,
    after: &(dyn Fn(usize, usize) + Sync),
) -> Result<Ending, String> {
    let deck = deck();
    let division = Division::new(&deck.model, ranks).unwrap();
    let ends = Together::run(ranks, |team| {
        let model = deck.model.clone();
        let problem = Problem::shared(model, &division, Arc::clone(&team)).unwrap();
        on_rank(&problem, &deck, folder, &team, (from, last), after)
    });
    for end in &ends {
        assert_eq!(end.is_ok(), ends[0].is_ok(), "ranks end alike: {ends:?}");
    }
    ends.into_iter().next().unwrap()
}

fn on_rank(
    problem: &Problem,
    deck: &Deck,
    folder: &Path,
    team: &Arc<dyn Team>,
    (from, last): (From, usize),
    after: &(dyn Fn(usize, usize) + Sync),
) -> Result<Ending, String> {
    let workspace = match team.size() {
        1 => Workspace::new(Backend::Multifrontal),
        _ => Workspace::with(Box::new(Gathered::new(Arc::clone(team)))),
    };
    let (share, output) = (&problem.share, deck.output.clone());
    let said = |error: &dyn std::fmt::Display| error.to_string();
    let rank = team.rank();
    let after = |increment| after(rank, increment);
    let watch = |recorder, before| Watch {
        problem,
        deck,
        folder,
        recorder,
        before,
        last,
        failure: None,
        after: &after,
    };
    let (watch, state, ending) = match from {
        From::Start => {
            let start = State::undeformed(problem);
            let recorder = Recorder::shared(share, folder, "case", output, Existing::Replace);
            let mut recorder = recorder.map_err(|error| said(&error))?;
            let started = recorder.start(problem, &start);
            started.map_err(|error| said(&error))?;
            let mut watch = watch(recorder, start.clone());
            let (state, ending) = drive::run_in(workspace, problem, (0, 0), start, &mut watch);
            (watch, state, ending)
        }
        From::Checkpoint => {
            let index = Index::read(folder).map_err(|error| said(&error))?;
            index.source().check(&deck.model, &deck.output).unwrap();
            let checkpoint = index.held(problem).map_err(|error| said(&error))?;
            let written = &checkpoint.written;
            let recorder = Recorder::resume_shared(share, folder, "case", output, written);
            let recorder = recorder.map_err(|error| said(&error))?;
            let point = checkpoint.point;
            let mut watch = watch(recorder, point.state.clone());
            let (state, ending) = drive::resume_in(workspace, problem, point, &mut watch);
            (watch, state, ending)
        }
    };
    if let Some(failure) = watch.failure {
        return Err(failure.to_string());
    }
    let mut watch = watch;
    let finished = watch.recorder.finish(problem, &state, &ending, Vec::new());
    finished.map_err(|error| said(&error))?;
    Ok(ending)
}
