//! `cargo xtask scenes`: random scenes of contact, run by the program and judged from
//! the files it writes.
//!
//! ```text
//! cargo xtask scenes [--seeds A..B] [--kind K,...] [--jobs N] [--keep FOLDER] [--binary PATH]
//!                    [--enforcement weighted|collocated] [--general]
//! ```
//!
//! A seed gives a [`scene`] by its [`kinds`], this a [`deck`]; the program [`run`]s it
//! as a child process, and [`checks`] looks at the output with means of its own: no
//! crate of striae is used here, so what is wrong there cannot hide here. Decks that
//! fail are kept with their logs, in a folder each: `FOLDER/SEED-KIND`, beside the tables
//! of all in `FOLDER/report.md`. With `--general` scenes are posed again without pairs, see
//! [`general`]. Runs that stop are counted; decks that are refused, crashes
//! and output that is silent or wrong make the task fail.

mod checks;
mod claim;
mod deck;
mod general;
mod geometry;
mod grid;
mod kinds;
mod law;
mod options;
pub mod output;
mod pieces;
pub mod random;
mod run;
mod scene;
mod step;
mod summary;
pub mod vector;
mod verdict;
pub mod vtu;

use std::{
    fs,
    path::{Path, PathBuf},
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

use crate::{cargo, fault::Fault};
use kinds::{Choice, Dialect};
use options::{Options, Posing};
use output::{History, Summary};
use run::Run;
use scene::Scene;
use summary::Judged;
use verdict::{Class, Verdict};

/// Runs scenes and prints what came of them.
///
/// # Errors
/// Wrong options, a program that does not start, a folder that cannot be written, or
/// scenes that came out wrong.
pub fn scenes(arguments: &[String]) -> Result<(), Fault> {
    let options = Options::read(arguments)?;
    let binary = match &options.binary {
        Some(binary) => binary.clone(),
        None => cargo::program()?,
    };
    let initial = run::knows(&binary, "as-meshed").map_err(|cause| Fault::Start {
        command: format!("{} schema", binary.display()),
        cause,
    })?;
    let dialect = Dialect {
        initial: if initial {
            Choice::Known
        } else {
            Choice::Unknown
        },
        enforcement: options.enforcement,
    };
    let wanted = |seed: &u64| {
        let kind = kinds::kind_of(*seed);
        options.kinds.is_empty() || options.kinds.iter().any(|wanted| wanted == kind)
    };
    let seeds: Vec<u64> = options.seeds.clone().filter(wanted).collect();
    let (judged, unposed) = all(&options, &binary, &seeds, dialect)?;
    let report = summary::report(&judged) + &summary::unposed(&unposed);
    println!("\n{report}");
    let path = options.keep.join("report.md");
    fs::write(&path, &report).map_err(|cause| Fault::Unreadable { path, cause })?;
    let bad = |judged: &&Judged| judged.verdict.class >= Class::Refused;
    match judged.iter().filter(bad).count() {
        0 => Ok(()),
        count => Err(Fault::Scenes {
            count,
            of: judged.len(),
        }),
    }
}

/// A kind of scenes, and why it was not posed as asked for.
type Unposed = (&'static str, &'static str);

/// Runs all seeds, several at a time.
fn all(
    options: &Options,
    binary: &Path,
    seeds: &[u64],
    dialect: Dialect,
) -> Result<(Vec<Judged>, Vec<Unposed>), Fault> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<Result<Judged, Fault>>> = Mutex::new(Vec::new());
    let unposed: Mutex<Vec<Unposed>> = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..options.jobs {
            scope.spawn(|| {
                while let Some(&seed) = seeds.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let scene = kinds::scene(seed, dialect);
                    let posed = match options.posing {
                        Posing::Own => Ok((scene, None)),
                        Posing::General => general::posed(&scene)
                            .map(|[general, named]| (general, Some(named)))
                            .map_err(|reason| (scene.kind, reason)),
                    };
                    match posed {
                        Ok((scene, named)) => {
                            let judged = one(&options.keep, binary, scene, named.as_ref());
                            done.lock()
                                .expect("no thread fails while it holds the list")
                                .push(judged);
                        }
                        Err(reason) => unposed
                            .lock()
                            .expect("no thread fails while it holds the list")
                            .push(reason),
                    }
                }
            });
        }
    });
    let done = done
        .into_inner()
        .expect("no thread fails while it holds the list");
    let unposed = unposed
        .into_inner()
        .expect("no thread fails while it holds the list");
    let mut judged = done.into_iter().collect::<Result<Vec<_>, _>>()?;
    judged.sort_by_key(|judged| judged.scene.seed);
    Ok((judged, unposed))
}

/// Runs and judges a scene, beside the same one with pairs if there is one.
fn one(keep: &Path, binary: &Path, scene: Scene, named: Option<&Scene>) -> Result<Judged, Fault> {
    let folder = keep.join(format!("{:05}-{}", scene.seed, scene.kind));
    let failed = |path: &Path| {
        let path: PathBuf = path.to_owned();
        move |cause| Fault::Unreadable { path, cause }
    };
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed(&folder))?;
    }
    fs::create_dir_all(&folder).map_err(failed(&folder))?;
    let run = started(binary, &folder, &scene)?;
    let out = folder.join("out");
    let summary = Summary::read(&out.join("summary.json"));
    let beside = |name: &str, scene: &Scene| -> Result<(PathBuf, Result<History, String>), Fault> {
        let folder = folder.join(name);
        fs::create_dir_all(&folder).map_err(failed(&folder))?;
        started(binary, &folder, scene)?;
        let out = folder.join("out");
        let history = History::of_run(&out);
        Ok((out, history))
    };
    let completed = summary.as_ref().is_ok_and(Summary::is_completed);
    let reference = match &scene.reference {
        Some(reference) if completed => Some(beside("reference", reference)?.1),
        _ => None,
    };
    let history = History::of_run(&out);
    let scene = match &summary {
        Ok(summary) => general::with_found(scene, &summary.pairs),
        Err(_) => scene,
    };
    let mut findings = checks::check(&out, &scene, reference);
    if let (Some(named), Ok(history), Ok(findings)) = (named, &history, &mut findings)
        && let (folder, Ok(other)) = beside("named", named)?
    {
        let runs = [(&scene, &out, history), (named, &folder, &other)];
        let [general, named] = runs.map(|(scene, folder, history)| general::Run {
            scene,
            folder,
            history,
        });
        general::compare(findings, &general, &named);
    }
    let verdict = verdict::judge(&scene, &run, summary, findings);
    told(&scene, &verdict);
    match verdict.class {
        Class::Complete | Class::Warned => fs::remove_dir_all(&folder).map_err(failed(&folder))?,
        Class::Wrong | Class::Deep => {}
        _ => {
            let fields = out.join("fields");
            if fields.exists() {
                fs::remove_dir_all(&fields).map_err(failed(&fields))?;
            }
        }
    }
    Ok(Judged { scene, verdict })
}

/// Runs the deck of a scene in a folder.
fn started(binary: &Path, folder: &Path, scene: &Scene) -> Result<Run, Fault> {
    let deck = folder.join("deck.toml");
    fs::write(&deck, deck::text(scene)).map_err(|cause| Fault::Unreadable { path: deck, cause })?;
    let run = run::run(binary, folder).map_err(|cause| Fault::Start {
        command: binary.display().to_string(),
        cause,
    })?;
    Ok(Run {
        // The folder's name says more than the program.
        log: run.log.replace(&folder.display().to_string(), ""),
        ..run
    })
}

/// Kind of a seed's scene, and its deck.
pub fn deck_of(seed: u64) -> (&'static str, String) {
    let dialect = Dialect {
        initial: Choice::Known,
        enforcement: None,
    };
    let scene = kinds::scene(seed, dialect);
    (scene.kind, deck::text(&scene))
}

fn told(scene: &Scene, verdict: &Verdict) {
    let ratio = scene
        .ratio
        .map_or("rigid".to_owned(), |ratio| format!("{ratio:.1e}"));
    let reason: String = verdict
        .reason
        .replace('\n', " ")
        .chars()
        .take(150)
        .collect();
    println!(
        "{} {} {ratio} {}: {} in {:.1} s, {reason}",
        scene.seed,
        scene.kind,
        scene.pairs[0].law.name(),
        verdict.class.name(),
        verdict.seconds,
    );
}
