//! `cargo xtask fuzz`: searches for inputs that fail, guided by the code that they reach.
//!
//! Builds `striae-fuzz` of `crates/striae-mutants` with libFuzzer, runs every target for some
//! time, two at a time, and prints a table. Third-party crates are those of other builds; only the
//! crates of the workspace are compiled again, by `instrumented.sh`. A C++ compiler is needed.
//!
//! ```text
//! --seconds N       time of each target; 60
//! --targets NAMES   with commas; all
//! --jobs N          targets at a time; 2
//! --seed N          first random number of each search; another one each time
//! --minimise        no search: the corpus of the repository becomes the least that reaches the
//!                   same code as all inputs so far
//! ```
//!
//! ```text
//! target/fuzz/corpus/TARGET     inputs that reach code of their own, kept for the next time
//! target/fuzz/findings          inputs that fail, each with a text of what it does
//! target/fuzz/logs              the output of libFuzzer
//! ```

mod minimise;
mod run;

use std::{
    fs,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
    thread,
    time::Duration,
};

use crate::{cargo, fault::Fault};
use run::{Outcome, searched};

/// Readers of input, as `striae-mutants` names them; those that take longest to explore first.
const TARGETS: [&str; 8] = [
    "deck",
    "convert",
    "abaqus",
    "gmsh",
    "vtk",
    "stl",
    "checkpoint",
    "measurements",
];

/// Options of the command.
#[derive(Clone, Debug)]
struct Options {
    time: Duration,
    targets: Vec<String>,
    jobs: usize,
    seed: Option<u32>,
    task: Task,
}

/// Treatment of the targets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Task {
    Search,
    Minimise,
}

/// The program, its folder, and targets that share a core.
struct Place {
    program: PathBuf,
    folder: PathBuf,
    sharing: u64,
}

impl Place {
    fn of(&self, part: &str, target: &str) -> PathBuf {
        self.folder.join(part).join(target)
    }
}

/// Runs the targets.
///
/// # Errors
/// When they cannot be built or run, or an input fails.
pub fn fuzz(arguments: &[String]) -> Result<(), Fault> {
    let options = Options::read(arguments)?;
    let place = place(options.jobs)?;
    if options.task == Task::Minimise {
        let mut targets = options.targets.iter();
        return targets.try_for_each(|target| minimise::minimised(&place, target));
    }
    let outcomes = all(&place, &options)?;
    println!("{}", table(&outcomes));
    match outcomes.iter().map(|outcome| outcome.findings.len()).sum() {
        0 => Ok(()),
        count => {
            for finding in outcomes.iter().flat_map(|outcome| &outcome.findings) {
                println!("{finding}");
            }
            Err(Fault::Fuzz(count))
        }
    }
}

/// Builds the program and makes its folder, without the findings of an earlier time.
fn place(jobs: usize) -> Result<Place, Fault> {
    let unreadable = |path: &Path| {
        let path = path.to_owned();
        move |cause| Fault::Unreadable { path, cause }
    };
    let script = Path::new("crates/striae-mutants/instrumented.sh");
    let script = fs::canonicalize(script).map_err(unreadable(script))?;
    let arguments = [
        "build",
        "--release",
        "--workspace",
        "--features",
        "striae-mutants/libfuzzer",
        "--bin",
        "striae-fuzz",
    ];
    let wrapper = ("RUSTC_WORKSPACE_WRAPPER", &*script.to_string_lossy());
    cargo::cargo(&arguments, &[wrapper])?;
    let program = cargo::release().join("striae-fuzz");
    let program = fs::canonicalize(&program).map_err(unreadable(&program))?;
    let folder = PathBuf::from("target/fuzz");
    for part in ["findings", "logs", "scratch"] {
        let part = folder.join(part);
        if part.exists() {
            fs::remove_dir_all(&part).map_err(unreadable(&part))?;
        }
        fs::create_dir_all(&part).map_err(unreadable(&part))?;
    }
    let folder = fs::canonicalize(&folder).map_err(unreadable(&folder))?;
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let sharing = jobs.div_ceil(cores) as u64;
    Ok(Place {
        program,
        folder,
        sharing,
    })
}

/// Searches with all targets, some at a time.
fn all(place: &Place, options: &Options) -> Result<Vec<Outcome>, Fault> {
    let targets = Mutex::new(options.targets.iter());
    let next = || {
        targets
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .next()
    };
    let work = || {
        let outcomes = std::iter::from_fn(next).map(|target| searched(place, target, options));
        outcomes.collect::<Result<Vec<_>, _>>()
    };
    thread::scope(|scope| {
        let jobs: Vec<_> = (0..options.jobs).map(|_| scope.spawn(work)).collect();
        let mut outcomes = Vec::new();
        for job in jobs {
            outcomes.extend(job.join().expect("programs are started without panics")?);
        }
        outcomes.sort_by_key(|outcome| TARGETS.iter().position(|of| *of == outcome.target));
        Ok(outcomes)
    })
}

fn table(outcomes: &[Outcome]) -> String {
    let head = format!(
        "{:<14}{:>8}{:>12}{:>8}{:>8}{:>8}{:>9}{:>9}{:>9}",
        "target", "s", "executions", "per s", "edges", "corpus", "longest", "MB", "findings"
    );
    let rows = outcomes.iter().map(|outcome| {
        format!(
            "{:<14}{:>8}{:>12}{:>8}{:>8}{:>8}{:>8}s{:>9}{:>9}",
            outcome.target,
            outcome.seconds,
            outcome.executions,
            outcome.executions / outcome.seconds.max(1),
            outcome.edges,
            outcome.corpus,
            outcome.longest,
            outcome.megabytes,
            outcome.findings.len()
        )
    });
    let rows: Vec<String> = std::iter::once(head).chain(rows).collect();
    rows.join("\n")
}

impl Options {
    fn read(arguments: &[String]) -> Result<Self, Fault> {
        let mut options = Self {
            time: Duration::from_secs(60),
            targets: TARGETS.map(str::to_owned).into(),
            jobs: 2,
            seed: None,
            task: Task::Search,
        };
        let mut rest = arguments.iter();
        while let Some(name) = rest.next() {
            if name == "--minimise" {
                options.task = Task::Minimise;
                continue;
            }
            let wrong = || Fault::Option(format!("`{name}` needs another value"));
            let value = rest.next().ok_or_else(wrong)?;
            match name.as_str() {
                "--seconds" => {
                    options.time = value
                        .parse()
                        .map(Duration::from_secs)
                        .map_err(|_| wrong())?;
                }
                "--targets" => {
                    options.targets = value.split(',').map(str::to_owned).collect();
                    let known = |name: &String| TARGETS.contains(&name.as_str());
                    if !options.targets.iter().all(known) {
                        return Err(wrong());
                    }
                }
                "--jobs" => {
                    let jobs = value.parse().ok().filter(|&jobs| jobs > 0);
                    options.jobs = jobs.ok_or_else(wrong)?;
                }
                "--seed" => options.seed = Some(value.parse().map_err(|_| wrong())?),
                _ => return Err(Fault::Option(format!("`{name}` is not an option of fuzz"))),
            }
        }
        Ok(options)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_read_and_unknown_targets_refused() {
        let of = |words: &[&str]| {
            Options::read(&words.iter().map(|w| w.to_string()).collect::<Vec<_>>())
        };
        let options = of(&["--seconds", "5", "--targets", "deck,stl"]).unwrap();
        assert_eq!(options.time, Duration::from_secs(5));
        assert_eq!(options.targets, ["deck", "stl"]);
        assert!(of(&["--targets", "deck,hdf"]).is_err());
        assert!(of(&["--jobs", "0"]).is_err());
        assert!(of(&["--seconds"]).is_err());
    }
}
