//! `cargo xtask mpi [--all] [PART ...]`: the feature `petsc`, on one to four ranks.
//!
//! | part | what it does |
//! | --- | --- |
//! | `lints` | lints of what the feature adds |
//! | `tests` | tests of the crate, see [`TESTS`] |
//! | `cases` | published [`cases`] on ranks against one process |
//! | `endings` | runs that are killed, cannot go on, have no room or get a signal, see [`endings`] |
//! | `scenes` | random scenes on three ranks against one process, see [`scenes`] |
//!
//! Without a part it does all; `--all` adds what takes minutes. Tests are programs, not
//! functions: `mpirun -n N` runs each as cargo's runner, so that arguments and exit codes are
//! those of `cargo test`.

mod cases;
mod differences;
mod endings;
mod evidence;
mod scenes;
mod started;

use std::{
    process::{Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use crate::{cargo, fault::Fault};
use cases::Extent;

/// A test target that runs under `mpirun`.
struct Test {
    target: &'static str,
    features: &'static str,
}

/// In the profile of `cargo xtask check`, whose types it finds built.
const LINTS: [&str; 9] = [
    "clippy",
    "--release",
    "--workspace",
    "--all-targets",
    "--features",
    "striae-petsc/petsc,striae-cli/petsc",
    "--",
    "--deny",
    "warnings",
];
const TESTS: [Test; 1] = [Test {
    target: "petsc-ranks",
    features: "striae-petsc/petsc",
}];
/// Numbers of ranks.
const RANKS: [usize; 4] = [1, 2, 3, 4];
/// Ranks of which one panics.
const PANICKING: usize = 3;
/// Time allowed for the others to end.
const PATIENCE: Duration = Duration::from_secs(30);
/// Lets Open MPI run more ranks than there are cores, and as root; others do not look.
const ENVIRONMENT: [(&str, &str); 4] = [
    ("OMPI_MCA_rmaps_base_oversubscribe", "1"),
    ("OMPI_ALLOW_RUN_AS_ROOT", "1"),
    ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
    ("RAYON_NUM_THREADS", "1"),
];

/// Part of the checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Lints,
    Tests,
    Cases,
    Endings,
    Scenes,
}

impl Part {
    const ALL: [(&str, Self); 5] = [
        ("lints", Self::Lints),
        ("tests", Self::Tests),
        ("cases", Self::Cases),
        ("endings", Self::Endings),
        ("scenes", Self::Scenes),
    ];

    /// Returns whether the part runs the program.
    fn is_of_program(self) -> bool {
        !matches!(self, Self::Lints | Self::Tests)
    }
}

/// Builds the tests and the program and runs the requested parts, or all.
///
/// # Errors
/// Returns what is missing, or the first test that fails.
pub fn check(options: &[String]) -> Result<(), Fault> {
    let (extent, parts) = asked(options)?;
    missing()?;
    if parts.contains(&Part::Lints) {
        cargo::cargo(&LINTS, &[])?;
    }
    if parts.contains(&Part::Tests) {
        tests()?;
    }
    if !parts.iter().any(|part| part.is_of_program()) {
        return Ok(());
    }
    let features = ["--features", "striae-cli/petsc"];
    cargo::cargo(&[&cargo::PROGRAM[..], &features].concat(), &[])?;
    let program = cargo::built();
    for part in parts {
        let started = Instant::now();
        match part {
            Part::Lints | Part::Tests => continue,
            Part::Cases => cases::check(&program, extent)?,
            Part::Endings => endings::check(&program, extent)?,
            Part::Scenes => scenes::check(&program, extent)?,
        }
        println!("{:.0} s", started.elapsed().as_secs_f64());
    }
    Ok(())
}

/// Extent and parts that are requested.
fn asked(options: &[String]) -> Result<(Extent, Vec<Part>), Fault> {
    let (mut extent, mut parts) = (Extent::Short, Vec::new());
    for option in options {
        let mut known = Part::ALL.into_iter();
        match known.find(|(name, _)| name == option) {
            Some((_, part)) => parts.push(part),
            None if option == "--all" => extent = Extent::All,
            None => {
                let parts = Part::ALL.map(|(name, _)| format!("[{name}]")).join(" ");
                return Err(Fault::Option(format!(
                    "usage: cargo xtask mpi [--all] {parts}"
                )));
            }
        }
    }
    if parts.is_empty() {
        parts = Part::ALL.map(|(_, part)| part).to_vec();
    }
    Ok((extent, parts))
}

/// The tests on all numbers of ranks.
fn tests() -> Result<(), Fault> {
    for test in &TESTS {
        // Built once, so that the time of a run is that of the tests.
        finished(&mut test.command(&["--no-run"]))?;
        for ranks in RANKS {
            println!("== {} on {ranks} ranks", test.target);
            finished(&mut test.run(ranks, &[]))?;
        }
    }
    println!("== a rank that panics");
    ends_all(TESTS[0].run(PANICKING, &["panic"]))
}

/// Checks that everything the tests need is installed.
fn missing() -> Result<(), Fault> {
    let answers = |program: &str, arguments: &[&str]| {
        let mut command = Command::new(program);
        command.args(arguments).stdout(Stdio::null());
        command
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success())
    };
    let has_petsc = ["PETSc", "petsc"]
        .iter()
        .any(|name| answers("pkg-config", &["--atleast-version=3.18", name]));
    match (answers("mpirun", &["--version"]), has_petsc) {
        (false, _) => Err(Fault::NoMpi("mpirun")),
        (_, false) => Err(Fault::NoMpi("PETSc 3.18 or newer (by pkg-config)")),
        (true, true) => Ok(()),
    }
}

impl Test {
    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new("cargo");
        command
            .args(["test", "--release", "--workspace"])
            .args(["--features", self.features, "--test", self.target])
            .args(arguments)
            .envs(ENVIRONMENT);
        command
    }

    /// With `mpirun` as cargo's runner.
    fn run(&self, ranks: usize, arguments: &[&str]) -> Command {
        let runner = format!("target.'cfg(all())'.runner=['mpirun', '-n', '{ranks}']");
        let mut command = self.command(&["--quiet", "--config", &runner, "--"]);
        command.args(arguments);
        command
    }
}

/// Waits for a command to end well.
fn finished(command: &mut Command) -> Result<(), Fault> {
    let status = command.status().map_err(|cause| Fault::Start {
        command: words(command),
        cause,
    })?;
    match status.success() {
        true => Ok(()),
        false => Err(Fault::Failed {
            command: words(command),
            status,
        }),
    }
}

/// Waits for a command to fail, and not for long.
fn ends_all(mut command: Command) -> Result<(), Fault> {
    command.stderr(Stdio::null()).stdout(Stdio::null());
    let name = words(&command);
    let start = |cause| Fault::Start {
        command: name.clone(),
        cause,
    };
    let started = Instant::now();
    let mut child = command.spawn().map_err(start)?;
    loop {
        match child.try_wait().map_err(start)? {
            Some(status) if !status.success() => return Ok(()),
            Some(_) => return Err(Fault::Mpi("a rank panicked, and the run ended well".into())),
            None if started.elapsed() > PATIENCE => {
                // The other ranks end with mpirun, which ends with its parent.
                child.kill().map_err(start)?;
                return Err(Fault::Mpi("a rank panicked, and the others went on".into()));
            }
            None => thread::sleep(Duration::from_millis(100)),
        }
    }
}

fn words(command: &Command) -> String {
    let all = [command.get_program()]
        .into_iter()
        .chain(command.get_args());
    let all: Vec<_> = all.map(|word| word.to_string_lossy()).collect();
    all.join(" ")
}
