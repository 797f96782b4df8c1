//! `cargo xtask python`: the Python package, from its wheel to its tests.
//!
//! A virtual environment in the target folder takes the tools from PyPI, maturin builds the
//! wheel, and the wheel is tested as users have it: types, docstrings, wrong uses, runs and
//! examples. Where several versions of Python are at hand, the tests run with the oldest and
//! the newest, by the same wheel.

use std::{
    env,
    path::{Path, PathBuf},
    process::Command,
};

use crate::fault::Fault;

/// Names of interpreters that the package supports, from the oldest.
const INTERPRETERS: [&str; 7] = [
    "python3.10",
    "python3.11",
    "python3.12",
    "python3.13",
    "python3.14",
    "python3.15",
    "python3",
];
/// What is asked of an interpreter.
const FIT: &str = "import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 10))";
/// What the tests need besides the wheel.
const NEEDED: [&str; 5] = ["pytest", "numpy", "matplotlib", "pandas", "meshio"];

/// Builds the wheel and tests it.
///
/// # Errors
/// When there is no interpreter, or what fails.
pub fn check() -> Result<(), Fault> {
    let fit = interpreters();
    let (Some(oldest), Some(newest)) = (fit.first(), fit.last()) else {
        return Err(Fault::NoPython);
    };
    let wheels = target().join("wheels");
    let main = environment(newest)?;
    pip(&main, &["maturin>=1.7,<2", "mypy", "basedpyright"])?;
    let out = wheels.display().to_string();
    run(main.join("maturin"), &["build", "--release", "--out", &out])?;
    test(&main, &wheels)?;
    run(main.join("mypy"), &[])?;
    let interpreter = main.join("python").display().to_string();
    let here = ["--project", "pyproject.toml", "--pythonpath", &interpreter];
    run(main.join("basedpyright"), &here)?;
    if oldest != newest {
        test(&environment(oldest)?, &wheels)?;
    }
    Ok(())
}

/// Whether the package can be built and tested here.
pub fn is_possible() -> bool {
    !interpreters().is_empty()
}

/// Interpreters that can make virtual environments, from the oldest; `python3` only where
/// there is no other.
fn interpreters() -> Vec<&'static str> {
    let is_fit = |name: &&str| {
        let output = Command::new(name).args(["-c", FIT]).output();
        output.is_ok_and(|output| output.status.success())
    };
    let mut fit: Vec<&str> = INTERPRETERS.into_iter().filter(is_fit).collect();
    if fit.len() > 1 {
        fit.retain(|name| *name != "python3");
    }
    fit
}

/// Installs the wheel and runs the tests.
fn test(programs: &Path, wheels: &Path) -> Result<(), Fault> {
    pip(programs, &NEEDED)?;
    let from = wheels.display().to_string();
    let wheel = [
        "install",
        "--quiet",
        "--no-index",
        "--no-deps",
        "--force-reinstall",
    ];
    let place = ["--find-links", from.as_str(), "striae"];
    run(programs.join("pip"), &[&wheel[..], &place].concat())?;
    run(programs.join("pytest"), &["--quiet"])
}

/// Folder of the programs of a virtual environment, which is made if it is not there.
fn environment(interpreter: &str) -> Result<PathBuf, Fault> {
    let folder = target().join("python").join(interpreter);
    let programs = folder.join("bin");
    if !programs.join("pip").exists() {
        let place = folder.display().to_string();
        run(interpreter.into(), &["-m", "venv", "--clear", &place])?;
    }
    Ok(programs)
}

fn pip(programs: &Path, packages: &[&str]) -> Result<(), Fault> {
    run(
        programs.join("pip"),
        &[&["install", "--quiet"], packages].concat(),
    )
}

fn target() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from)
}

fn run(program: PathBuf, arguments: &[&str]) -> Result<(), Fault> {
    let command = format!("{} {}", program.display(), arguments.join(" "));
    let status = Command::new(program).args(arguments).status();
    let status = status.map_err(|cause| Fault::Start {
        command: command.clone(),
        cause,
    })?;
    if status.success() {
        Ok(())
    } else {
        Err(Fault::Failed { command, status })
    }
}
