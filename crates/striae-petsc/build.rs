//! Finds PETSc, if requested.

use std::{env, process::Command};

/// Oldest version that is known to do.
const OLDEST: [u32; 2] = [3, 18];
/// Advice if no PETSc is found.
const ADVICE: &str = "the feature `petsc` needs PETSc 3.18 or newer with real numbers, \
    found by pkg-config as `PETSc` or `petsc`; on Debian and Ubuntu: \
    apt-get install libpetsc-real-dev pkg-config libclang-dev. \
    Elsewhere, add the folder of PETSc.pc to PKG_CONFIG_PATH";

fn main() -> Result<(), String> {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=PKG_CONFIG_PATH");
    if env::var_os("CARGO_FEATURE_PETSC").is_none() {
        return Ok(());
    }
    let found = ["PETSc", "petsc"].into_iter().find_map(|name| {
        let version = asked(&["--modversion", name])?;
        Some((name, version))
    });
    let (name, version) = found.ok_or(ADVICE)?;
    let numbers: Vec<u32> = version
        .split('.')
        .map_while(|part| part.trim().parse().ok())
        .collect();
    if numbers.as_slice() < OLDEST.as_slice() {
        return Err(format!("PETSc {version} is too old: {ADVICE}"));
    }
    let libraries = asked(&["--libs", name]).unwrap_or_default();
    for flag in libraries.split_whitespace() {
        if let Some(folder) = flag.strip_prefix("-L") {
            println!("cargo:rustc-link-search=native={folder}");
        } else if let Some(library) = flag.strip_prefix("-l") {
            println!("cargo:rustc-link-lib={library}");
        }
    }
    Ok(())
}

/// Output of pkg-config, if it succeeds.
fn asked(arguments: &[&str]) -> Option<String> {
    let answer = Command::new("pkg-config").args(arguments).output().ok()?;
    let text = String::from_utf8(answer.stdout).ok()?;
    answer.status.success().then(|| text.trim().to_owned())
}
