//! Files of runs on several ranks, which are threads here, against those of a run on one.

use std::{
    fs,
    num::NonZeroUsize,
    path::{Path, PathBuf},
    sync::Arc,
};

use striae::{
    deck::{self, Deck},
    output::{
        Existing, OutputError,
        checkpoint::{
            Checkpoint, Index, Source, fingerprint, part_fingerprints, step_fingerprints,
        },
        history::Table,
        recorder::Recorder,
        vtk::{Stored, read_series},
    },
    solve::{
        drive::{self, Continue, Observer, Point, Progress},
        model::Backend,
        newton::{Increment, IterationObserver, Workspace},
        outcome::{CutBack, Ending},
        problem::Problem,
        share::Division,
        state::State,
        team::{Gathered, Team, Together},
    },
};

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

/// How far numbers may be apart, over the largest one of their kind.
const CLOSE: f64 = 1e-8;

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

impl IterationObserver for Watch<'_> {}

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

/// What becomes of a run on so many ranks, from its start or its checkpoint, up to an increment.
fn run(folder: &Path, ranks: usize, from: From, last: usize) -> Result<Ending, String> {
    run_while(folder, ranks, from, last, &|_, _| {})
}

#[derive(Clone, Copy, PartialEq)]
enum From {
    Start,
    Checkpoint,
}

/// The same, calling a function on each rank after each increment.
fn run_while(
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
        _ => Workspace::shared(Box::new(Gathered::new(Arc::clone(team)))),
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
    let finished = watch.recorder.finish(problem, &state, &ending);
    finished.map_err(|error| said(&error))?;
    Ok(ending)
}

fn assert_near(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        let away = (found - expected).abs();
        assert!(
            away <= CLOSE * size.max(1e-3),
            "{what} {at}: {found} for {expected}"
        );
    }
}

/// Fields of bodies and contact surfaces, node by node, of the last increment.
fn assert_same_fields(found: &Path, expected: &Path) {
    for name in ["bodies.pvd", "contact.pvd"] {
        let series = [found, expected].map(|folder| read_series(&folder.join(name)).unwrap());
        assert_eq!(series[0].len(), series[1].len(), "{name}");
        for (one, other) in series[0].iter().zip(&series[1]) {
            assert!((one.time - other.time).abs() < 1e-12);
            for (one, other) in one.parts.iter().zip(&other.parts) {
                assert_eq!(one.0, other.0);
                assert_same_grid(&found.join(&one.1), &expected.join(&other.1));
            }
        }
    }
}

fn assert_same_grid(found: &Path, expected: &Path) {
    let paths = [found, expected];
    let [one, other] = paths.map(|path| Stored::open(path).unwrap());
    let [x, y] = [(&one, found), (&other, expected)].map(|(stored, path)| {
        let points = stored.points(path).unwrap();
        points.concat()
    });
    assert_near(&x, &y, "points");
    assert_eq!(one.cells(found).unwrap(), other.cells(expected).unwrap());
    let [names, known] = [&one, &other].map(|stored| {
        let names = stored.names().map(|(name, _)| name.to_owned());
        names.collect::<Vec<_>>()
    });
    assert_eq!(names, known);
    for name in names {
        let values = one.array(found, &name).unwrap().unwrap();
        let wanted = other.array(expected, &name).unwrap().unwrap();
        assert_near(&values.numbers, &wanted.numbers, &name);
    }
    let memory = "equivalent_plastic_strain";
    let values = one.cell_array(found, memory).unwrap();
    let wanted = other.cell_array(expected, memory).unwrap();
    assert_eq!(values.is_some(), wanted.is_some());
    if let (Some(values), Some(wanted)) = (values, wanted) {
        assert_near(&values.numbers, &wanted.numbers, memory);
    }
}

fn assert_same_tables(found: &Path, expected: &Path) {
    for name in ["history.csv", "probes.csv", "sections.csv"] {
        let [one, other] = [found, expected].map(|folder| Table::read(&folder.join(name)).unwrap());
        assert_eq!(one.columns, other.columns);
        for column in &one.columns {
            // Iterations differ by one at most, and what is left of energies is round-off.
            if column != "iterations" {
                let values = [&one, &other].map(|table| table.column(column).unwrap());
                assert_near(&values[0], &values[1], &format!("{name}: {column}"));
            }
        }
    }
}

fn files(folder: &Path, of: impl Fn(&str) -> bool) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.filter(|name| of(name)).collect();
    names.sort();
    names
}

#[test]
fn pieces_are_together_what_one_rank_writes() {
    let [alone, shared] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let (alone, shared) = (alone.path(), shared.path());
    assert_eq!(run(alone, 1, From::Start, 9), Ok(Ending::Completed));
    assert!(files(&alone.join("fields"), |name| name.ends_with(".pvtu")).is_empty());
    for ranks in [2, 3] {
        assert_eq!(run(shared, ranks, From::Start, 9), Ok(Ending::Completed));
        assert_same_fields(shared, alone);
        assert_same_tables(shared, alone);
        let pieces = files(&shared.join("fields"), |name| {
            name.starts_with("lower-00002")
        });
        assert!(pieces.len() > 2, "{pieces:?}");
    }
}

#[test]
fn runs_go_on_on_as_many_ranks_as_there_are() {
    let alone = tempfile::tempdir().unwrap();
    let alone = alone.path();
    run(alone, 1, From::Start, 9).unwrap();
    for ranks in [[3, 2], [3, 1], [1, 2], [2, 2]] {
        let shared = tempfile::tempdir().unwrap();
        let shared = shared.path();
        let ending = run(shared, ranks[0], From::Start, 3).unwrap();
        assert!(matches!(ending, Ending::Interrupted { .. }), "{ending}");
        let pieces = files(shared, |name| name.starts_with("checkpoint-"));
        let expected = if ranks[0] == 1 { 0 } else { ranks[0] };
        assert_eq!(pieces.len(), expected, "{pieces:?}");
        assert_eq!(Index::read(shared).unwrap().ranks(), ranks[0]);
        let ending = run(shared, ranks[1], From::Checkpoint, 9);
        assert_eq!(ending, Ok(Ending::Completed), "{ranks:?}");
        assert_same_fields(shared, alone);
        assert_same_tables(shared, alone);
        let pieces = files(shared, |name| name.starts_with("checkpoint-"));
        let expected = if ranks[1] == 1 { 0 } else { ranks[1] };
        assert_eq!(pieces.len(), expected, "{pieces:?}");
    }
}

#[test]
fn what_one_rank_cannot_write_ends_all_and_leaves_the_old_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let blocked = |rank: usize, increment: usize| {
        // The name of the next piece of rank 1 is taken by a folder that is not empty.
        if rank == 1 && increment == 2 {
            let next = folder.join("checkpoint-2.1.bin").join("taken");
            fs::create_dir_all(next).unwrap();
        }
    };
    let end = run_while(folder, 3, From::Start, 9, &blocked);
    let error = end.unwrap_err();
    assert!(error.starts_with("rank 1: cannot write"), "{error}");
    let whole = Checkpoint::read(folder).unwrap();
    assert_eq!(whole.point.increments, 1);
    let left = files(folder, |name| name.starts_with("checkpoint-"));
    let set = [0, 1, 2].map(|rank| format!("checkpoint-1.{rank}.bin"));
    assert_eq!(
        left,
        [&set[..], &["checkpoint-2.1.bin".to_owned()]].concat()
    );
}

#[test]
fn pieces_of_fields_that_cannot_be_written_end_all() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let blocked = |rank: usize, increment: usize| {
        if rank == 2 && increment == 1 {
            let next = folder.join("fields/lower-00002.2.vtu/taken");
            fs::create_dir_all(next).unwrap();
            let next = folder.join("fields/upper-00002.2.vtu/taken");
            fs::create_dir_all(next).unwrap();
        }
    };
    let error = run_while(folder, 3, From::Start, 9, &blocked).unwrap_err();
    assert!(error.starts_with("rank 2: cannot write"), "{error}");
    assert_eq!(Checkpoint::read(folder).unwrap().point.increments, 1);
}

#[test]
fn pieces_that_are_missing_or_damaged_are_named_by_all() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    run(folder, 2, From::Start, 2).unwrap();
    let pieces = files(folder, |name| name.starts_with("checkpoint-"));
    let piece = folder.join(&pieces[1]);
    let mut bytes = fs::read(&piece).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&piece, bytes).unwrap();
    for ranks in [1, 2] {
        let error = run(folder, ranks, From::Checkpoint, 9).unwrap_err();
        assert!(
            error.contains(&pieces[1]) && error.contains("damaged"),
            "{error}"
        );
    }
    fs::remove_file(&piece).unwrap();
    for ranks in [1, 3] {
        let error = run(folder, ranks, From::Checkpoint, 9).unwrap_err();
        assert!(error.contains(&pieces[1]), "{error}");
    }
}
