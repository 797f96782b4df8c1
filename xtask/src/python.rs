//! `cargo xtask python`: the Python package, from its wheel to its tests.
//!
//! The tools are installed from PyPI into a virtual environment in the target folder, maturin
//! builds the wheel, and the wheel is tested as users install it: types, docstrings, wrong uses,
//! runs, whose bits are those of the program, and examples; and in a fresh environment that has
//! nothing but the wheel, on an empty path, without Rust. Where several versions of Python are at
//! hand, on the path or by pyenv, the tests run with the oldest and the newest, by the same wheel.
//! The cost of a callback is measured by `crates/striae-py/overhead.py`.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::{cargo, fault::Fault};

/// The oldest version of Python that the package supports.
const OLDEST: u32 = 10;
/// Versions that are looked for on the path: Python 3.10 to 3.19.
const NEWEST: u32 = 19;
/// Query to an interpreter: prints its version if it can make virtual environments.
const ASKED: &str = "import sys, venv, ensurepip; print(sys.version_info[1])";
/// Packages that the tests need besides the wheel: the last ones are finite-element programs to
/// which examples give contact.
const NEEDED: [&str; 10] = [
    "pytest",
    "numpy",
    "matplotlib",
    "pandas",
    "xarray",
    "meshio",
    "scipy",
    "scikit-fem",
    "felupe",
    "jax",
];

/// Builds the wheel and tests it.
///
/// # Errors
/// When there is no interpreter, or what fails.
pub fn check() -> Result<(), Fault> {
    let found = interpreters();
    let (Some(oldest), Some(newest)) = (found.first(), found.last()) else {
        return Err(Fault::NoPython);
    };
    match oldest == newest {
        true => println!("Python 3.{} is the only version here", newest.version),
        false => println!("Python 3.{} and 3.{}", oldest.version, newest.version),
    }
    let wheels = target().join("wheels");
    let main = environment(newest)?;
    pip(&main, &["maturin>=1.7,<2", "mypy", "basedpyright"])?;
    let out = wheels.display().to_string();
    // By what the other checks have built; published wheels are of the profile `dist`.
    let wheel = ["build", "--release", "--out", &out];
    run(main.join("maturin"), &wheel)?;
    cargo::program()?;
    pip(&main, &["pyvista"])?;
    test(&main, &wheels)?;
    alone(newest, &wheels)?;
    run(main.join("mypy"), &[])?;
    let interpreter = main.join("python").display().to_string();
    let here = ["--project", "pyproject.toml", "--pythonpath", &interpreter];
    run(main.join("basedpyright"), &here)?;
    if oldest != newest {
        test(&environment(oldest)?, &wheels)?;
    }
    Ok(())
}

/// Returns whether the package can be built and tested here.
pub fn is_possible() -> bool {
    !interpreters().is_empty()
}

/// An interpreter that can make virtual environments.
#[derive(PartialEq)]
struct Interpreter {
    /// The 10 of Python 3.10.
    version: u32,
    /// Its program.
    program: PathBuf,
}

/// Interpreters that are supported, from the oldest, one of each version.
fn interpreters() -> Vec<Interpreter> {
    let on_path = (OLDEST..=NEWEST).map(|version| format!("python3.{version}").into());
    let candidates = on_path.chain(["python3".into()]).chain(of_pyenv());
    let mut found: Vec<Interpreter> = candidates.filter_map(interpreter).collect();
    found.sort_by_key(|one| one.version);
    found.dedup_by_key(|one| one.version);
    found
}

/// The interpreter of a program, if it is one that is supported.
fn interpreter(program: PathBuf) -> Option<Interpreter> {
    let output = Command::new(&program).args(["-c", ASKED]).output().ok()?;
    let version = str::from_utf8(&output.stdout).ok()?.trim().parse().ok()?;
    let is_fit = output.status.success() && version >= OLDEST;
    is_fit.then_some(Interpreter { version, program })
}

/// Interpreters that pyenv has installed, on the path or not.
fn of_pyenv() -> Vec<PathBuf> {
    let root = env::var_os("PYENV_ROOT").map(PathBuf::from);
    let root = root.or_else(|| Some(PathBuf::from(env::var_os("HOME")?).join(".pyenv")));
    let versions = root.and_then(|root| fs::read_dir(root.join("versions")).ok());
    let versions = versions.into_iter().flatten().flatten();
    let mut programs: Vec<PathBuf> = versions
        .map(|version| version.path().join("bin").join("python3"))
        .collect();
    programs.sort();
    programs
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

/// Installs the wheel as users do, into a fresh environment with nothing but what it depends on,
/// and runs a model there without a path to other programs; the wheel is fit to be published.
fn alone(interpreter: &Interpreter, wheels: &Path) -> Result<(), Fault> {
    let folder = target().join("python").join("alone");
    let place = folder.display().to_string();
    let arguments = ["-m", "venv", "--clear", &place];
    run(interpreter.program.clone(), &arguments)?;
    let programs = folder.join("bin");
    let from = wheels.display().to_string();
    pip(&programs, &["--find-links", &from, "striae"])?;
    // Without the path there is no Rust and no compiler.
    let script = ["-I", "crates/striae-py/alone.py"];
    cargo::run(&programs.join("python"), &script, &[("PATH", "")])?;
    notebook(&programs)?;
    pip(&programs, &["twine"])?;
    let wheel = newest_wheel(wheels)?.display().to_string();
    run(programs.join("twine"), &["check", "--strict", &wheel])
}

/// Executes a notebook by its own kernel, as Jupyter does.
fn notebook(programs: &Path) -> Result<(), Fault> {
    pip(programs, &["matplotlib", "nbclient", "ipykernel"])?;
    let notebook = "crates/striae-py/examples/friction_rosette.ipynb";
    let arguments = ["--kernel_name=python3", notebook];
    cargo::run(
        &programs.join("jupyter-execute"),
        &arguments,
        &[("PATH", "")],
    )
}

/// The wheel that was built last.
fn newest_wheel(wheels: &Path) -> Result<PathBuf, Fault> {
    let unreadable = |cause| Fault::Unreadable {
        path: wheels.to_owned(),
        cause,
    };
    let files = fs::read_dir(wheels).map_err(unreadable)?.flatten();
    let files = files.map(|file| file.path());
    let built = files.filter(|path| path.extension().is_some_and(|end| end == "whl"));
    let time = |path: &PathBuf| fs::metadata(path).and_then(|of| of.modified()).ok();
    let none = || unreadable(std::io::ErrorKind::NotFound.into());
    built.max_by_key(time).ok_or_else(none)
}

/// Folder of the programs of a virtual environment, which is made if it is not there.
fn environment(interpreter: &Interpreter) -> Result<PathBuf, Fault> {
    let name = format!("python3.{}", interpreter.version);
    let folder = target().join("python").join(name);
    let programs = folder.join("bin");
    if !programs.join("pip").exists() {
        let place = folder.display().to_string();
        let arguments = ["-m", "venv", "--clear", &place];
        run(interpreter.program.clone(), &arguments)?;
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
    cargo::run(&program, arguments, &[])
}
