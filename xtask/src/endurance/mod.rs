//! `cargo xtask endurance`: what becomes of a run that is killed, interrupted, short of
//! disk, beside another one, or whose files are damaged.
//!
//! | trial | what must hold |
//! | --- | --- |
//! | killed (`kill -9`) at 100 moments | what is there is whole; resumed, or begun anew where there is no checkpoint yet, the run writes the files of one that was left alone |
//! | SIGTERM at 20 moments | exit code 130, a sentence, a checkpoint; resumed, the same files |
//! | a full disk, and a limit on the size of files | exit code 1 and the name of a file; with room again, the same files |
//! | two runs in one folder | the second is refused with exit code 2, the first writes the same files |
//! | damaged files | `resume` is refused with exit code 2 and the name of the file |
//!
//! "The same files" are all names in the folder and all bytes, but for the wall time and
//! the memory in `summary.json`. Moments are spread evenly over the time that a run takes.
//!
//! Options: `--binary PATH` (another program), `--kills N`, `--terms N`. It takes some minutes.
//! Unix only, as it sends signals; a full disk needs the right to mount one, and is skipped without
//! that right.

mod damage;
pub mod disk;
mod folder;
mod trials;

use std::{fs, path::PathBuf, time::Instant};

use crate::{cargo, fault::Fault};
use trials::Trials;

/// Trials to make, and how many.
struct Options {
    binary: Option<PathBuf>,
    kills: u32,
    terms: u32,
}

/// Runs all trials and says how they came out.
///
/// # Errors
/// When the program cannot be had, or a trial came out wrong.
pub fn endurance(arguments: &[String]) -> Result<(), Fault> {
    let options = Options::of(arguments)?;
    let started = Instant::now();
    let program = options.binary.map_or_else(cargo::program, Ok)?;
    let refused = |cause| Fault::Endurance(format!("target/endurance: {cause}"));
    let root = PathBuf::from("target/endurance");
    if root.exists() {
        fs::remove_dir_all(&root).map_err(refused)?;
    }
    fs::create_dir_all(&root).map_err(refused)?;
    let program = fs::canonicalize(program).map_err(refused)?;
    let root = fs::canonicalize(&root).map_err(refused)?;
    let mut trials = Trials::new(program, root)?;
    trials.killed(options.kills)?;
    trials.interrupted(options.terms)?;
    trials.short_of_disk()?;
    trials.beside_another()?;
    trials.damaged()?;
    println!("{:.0} s", started.elapsed().as_secs_f64());
    trials.verdict()
}

impl Options {
    fn of(arguments: &[String]) -> Result<Self, Fault> {
        let mut options = Self {
            binary: None,
            kills: 100,
            terms: 20,
        };
        let mut rest = arguments.iter();
        while let Some(name) = rest.next() {
            let wrong = || {
                Fault::Option(format!(
                    "`{name}` is not understood; see xtask/src/endurance/mod.rs"
                ))
            };
            let value = rest.next().ok_or_else(wrong)?;
            let number = || value.parse().map_err(|_| wrong());
            match name.as_str() {
                "--binary" => options.binary = Some(value.into()),
                "--kills" => options.kills = number()?,
                "--terms" => options.terms = number()?,
                _ => return Err(wrong()),
            }
        }
        Ok(options)
    }
}
