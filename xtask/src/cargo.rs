//! Calls of cargo and of other programs.

use std::{
    env,
    path::{Path, PathBuf},
    process::Command,
};

use crate::fault::Fault;

/// Builds the program and says where it is.
///
/// Built with the whole workspace it shares the dependencies of the tests; alone, its own choice of
/// their features would build nearly everything again.
///
/// # Errors
/// When it cannot be built.
pub fn program() -> Result<PathBuf, Fault> {
    cargo(&PROGRAM, &[])?;
    Ok(built())
}

/// Arguments that build the program.
pub const PROGRAM: [&str; 5] = ["build", "--release", "--workspace", "--bin", "striae"];

/// Path of the program once it is built.
pub fn built() -> PathBuf {
    release().join("striae")
}

/// Folder of what is built in the release profile.
pub fn release() -> PathBuf {
    let folder = env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    folder.join("release")
}

/// Runs cargo with arguments and an environment.
///
/// # Errors
/// When it cannot be started or fails.
pub fn cargo(arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), Fault> {
    run(Path::new("cargo"), arguments, environment)
}

/// Returns the standard output of cargo, called with arguments.
///
/// # Errors
/// When it cannot be started or fails.
pub fn answer(arguments: &[&str]) -> Result<Vec<u8>, Fault> {
    let command = format!("cargo {}", arguments.join(" "));
    let output = Command::new("cargo").args(arguments).output();
    let output = output.map_err(|cause| Fault::Start {
        command: command.clone(),
        cause,
    })?;
    match output.status.success() {
        true => Ok(output.stdout),
        false => Err(Fault::Failed {
            command,
            status: output.status,
        }),
    }
}

/// Runs a program with arguments and an environment to its end.
///
/// # Errors
/// When it cannot be started or fails.
pub fn run(program: &Path, arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), Fault> {
    let command = format!("{} {}", program.display(), arguments.join(" "));
    let status = Command::new(program)
        .args(arguments)
        .envs(environment.iter().copied())
        .status()
        .map_err(|cause| Fault::Start {
            command: command.clone(),
            cause,
        })?;
    if status.success() {
        Ok(())
    } else {
        Err(Fault::Failed { command, status })
    }
}
