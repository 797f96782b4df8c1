//! Calls of cargo.

use std::{env, path::PathBuf, process::Command};

use crate::fault::Fault;

/// Builds the program and says where it is.
///
/// # Errors
/// When it cannot be built.
pub fn program() -> Result<PathBuf, Fault> {
    cargo(&["build", "--release", "-p", "striae-cli"], &[])?;
    Ok(built())
}

/// Path of the program once it is built.
pub fn built() -> PathBuf {
    let folder = env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    folder.join("release").join("striae")
}

/// Runs cargo with arguments and an environment.
///
/// # Errors
/// When it cannot be started or fails.
pub fn cargo(arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), Fault> {
    let command = format!("cargo {}", arguments.join(" "));
    let status = Command::new("cargo")
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
