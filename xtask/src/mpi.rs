//! `cargo xtask mpi [--all]`: tests of the feature `petsc`, on one to four ranks.
//!
//! They are programs, not functions: `mpirun -n N` runs each as cargo's runner, so that
//! arguments and exit codes are those of `cargo test`. A test is a row of [`TESTS`]. Then
//! published [`cases`] are run on ranks and held against one process; with `--all` those that
//! take minutes, too.

mod cases;

use std::{
    process::{Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use crate::fault::Fault;
use cases::Extent;

/// A test target that runs under `mpirun`.
struct Test {
    package: &'static str,
    target: &'static str,
    features: &'static str,
}

const TESTS: [Test; 1] = [Test {
    package: "striae-petsc",
    target: "ranks",
    features: "petsc",
}];
/// Numbers of ranks.
const RANKS: [usize; 4] = [1, 2, 3, 4];
/// Ranks of which one panics.
const PANICKING: usize = 3;
/// How long the others may take to end.
const PATIENCE: Duration = Duration::from_secs(30);
/// Lets Open MPI run more ranks than there are cores, and as root; others do not look.
const ENVIRONMENT: [(&str, &str); 4] = [
    ("OMPI_MCA_rmaps_base_oversubscribe", "1"),
    ("OMPI_ALLOW_RUN_AS_ROOT", "1"),
    ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
    ("RAYON_NUM_THREADS", "1"),
];

/// Builds the tests and runs them.
///
/// # Errors
/// What is missing, or the first test that fails.
pub fn check(options: &[String]) -> Result<(), Fault> {
    let extent = match options {
        [] => Extent::Short,
        [all] if all == "--all" => Extent::All,
        _ => return Err(Fault::Option("usage: cargo xtask mpi [--all]".into())),
    };
    missing()?;
    for test in &TESTS {
        // Built once, so that the time of a run is that of the tests.
        finished(&mut test.command(&["--no-run"]))?;
        for ranks in RANKS {
            println!("== {} on {ranks} ranks", test.target);
            finished(&mut test.run(ranks, &[]))?;
        }
    }
    println!("== a rank that panics");
    ends_all(TESTS[0].run(PANICKING, &["panic"]))?;
    cases::check(extent)
}

/// What the tests need and is not here.
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
            .args(["test", "--release", "--package", self.package])
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
