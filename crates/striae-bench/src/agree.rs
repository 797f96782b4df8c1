//! Answers of the default solver beside those of the multifrontal LU, increment by increment.

use serde_json::{Value, json};
use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
    time::Instant,
};
use striae_contact::evaluation::Evaluation;
use striae_deck as deck;
use striae_model::{Backend, Model};
use striae_solve::{
    drive::{Continue, Observer, Progress, run},
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::CutBack,
    problem::Problem,
    repetition::{Difference, Repetition},
    state::State,
};

/// Largest difference that is round-off.
const ROUND_OFF: f64 = 1e-9;
/// Displacements beyond which the LU is not asked.
const MOST: usize = 100_000;
/// Folder of the decks if none are named.
const FOLDER: &str = "cases";

/// Runs decks, named or in folders, and makes each of their increments again.
///
/// # Errors
/// When a deck cannot be read.
pub fn all(places: &[String]) -> Result<Vec<Value>, Box<dyn Error>> {
    let mut paths = Vec::new();
    match places {
        [] => decks(Path::new(FOLDER), &mut paths)?,
        some => some
            .iter()
            .try_for_each(|place| decks(Path::new(place), &mut paths))?,
    }
    let results = paths.iter().map(|path| one(path));
    let results: Result<Vec<_>, _> = results.collect();
    Ok(results?.into_iter().flatten().collect())
}

/// Checks that all answers agree.
///
/// # Errors
/// If some do not.
pub fn verdict(results: &[Value]) -> Result<(), Box<dyn Error>> {
    let apart = results.iter().filter(|result| result["agrees"] == false);
    match apart.count() {
        0 => Ok(()),
        count => Err(format!("answers of {count} decks differ by more than {ROUND_OFF:e}").into()),
    }
}

/// A deck, or those in a folder and the folders in it.
fn decks(place: &Path, paths: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    let unread = |error| format!("{}: {error}", place.display());
    if !place.is_dir() {
        paths.push(place.to_owned());
        return Ok(());
    }
    let entries = fs::read_dir(place).map_err(unread)?;
    let entries: Result<Vec<PathBuf>, _> = entries.map(|entry| Ok(entry?.path())).collect();
    let mut entries = entries.map_err(unread)?;
    entries.sort();
    for entry in entries {
        if entry.is_dir() || is_deck(&entry) {
            decks(&entry, paths)?;
        }
    }
    Ok(())
}

/// Beside decks there are tables of friction and of expected values.
fn is_deck(path: &Path) -> bool {
    let named = |name: &str| path.file_name().is_some_and(|own| own == name);
    let friction = || fs::read_to_string(path).is_ok_and(|text| deck::friction(&text, "").is_ok());
    path.extension().is_some_and(|end| end == "toml") && !named("expected.toml") && !friction()
}

/// Comparison for one deck; `None` if it is too large.
///
/// Answers are accurate to the tolerance of Newton's method. If they differ by more than round-off,
/// both solvers make a further iteration in every increment: any difference left is one of the
/// solvers.
fn one(path: &Path) -> Result<Option<Value>, Box<dyn Error>> {
    let name = path.display().to_string();
    let mut model = deck::read(path)?.model;
    model.solver.backend = Backend::Condensed;
    let nodes = model.bodies.iter().map(|body| body.mesh.positions.len());
    let displacements = 3 * nodes.sum::<usize>();
    if displacements > MOST {
        println!("{name}: {displacements} displacements are too many for the LU, left out");
        return Ok(None);
    }
    let mut made = compared(&name, model.clone())?;
    if made["agrees"] == false {
        model.solver.further_iterations = 1;
        let further = compared(&format!("{name}, a further iteration"), model)?;
        made["agrees"] = further["agrees"].clone();
        made["further"] = further;
    }
    Ok(Some(made))
}

/// Runs a model and makes its increments again.
fn compared(name: &str, model: Model) -> Result<Value, Box<dyn Error>> {
    let started = Instant::now();
    let problem = Problem::new(model)?;
    let start = State::undeformed(&problem);
    let mut log = Log {
        repetition: Repetition::new(&problem, &start, Backend::Multifrontal),
        unknowns: 0,
        fall_backs: 0,
    };
    let (_, ending) = run(&problem, start, &mut log);
    let made = log.repetition.differences();
    let compared = made.iter().flatten().count();
    let each = made.iter().flatten().copied();
    let largest = each.fold(Difference::default(), Difference::larger);
    let Difference {
        positions,
        tractions,
    } = largest;
    let agrees = compared > 0 && positions <= ROUND_OFF && tractions <= ROUND_OFF;
    let seconds = started.elapsed().as_secs_f64();
    println!(
        "{name}: {} unknowns, {} increments ({} by a fall-back), {compared} compared, positions {positions:.1e}, tractions {tractions:.1e}, {seconds:.1} s, {ending}",
        log.unknowns,
        made.len(),
        log.fall_backs,
    );
    Ok(json!({
        "deck": name, "unknowns": log.unknowns, "increments": made.len(),
        "fall_backs": log.fall_backs, "compared": compared, "ending": ending.to_string(),
        "positions": positions, "tractions": tractions, "agrees": agrees, "run_s": seconds,
    }))
}

/// Makes increments again and says on the way what comes of them.
struct Log<'a> {
    repetition: Repetition<'a>,
    unknowns: usize,
    /// Increments in which the condensed solver was not used.
    fall_backs: usize,
}

impl IterationObserver for Log<'_> {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Log<'_> {
    fn step(&mut self, index: usize, name: &str) {
        self.repetition.step(index, name);
    }

    fn increment(&mut self, progress: Progress, increment: &Increment) -> Continue {
        let next = self.repetition.increment(progress, increment);
        self.unknowns = self.unknowns.max(increment.unknowns);
        self.fall_backs += usize::from(increment.work.fall_back.is_some());
        let place = format!("increment {} at {:.4}", progress.increment, progress.time);
        match self.repetition.differences().last() {
            Some(Ok(Difference {
                positions,
                tractions,
            })) => {
                eprintln!("{place}: positions {positions:.1e}, tractions {tractions:.1e}");
            }
            Some(Err(reason)) => eprintln!("{place}: not compared, {reason}"),
            None => {}
        }
        next
    }

    fn cut_back(&mut self, progress: Progress, reason: &CutBack) -> Continue {
        self.repetition.cut_back(progress, reason)
    }
}
