//! Options of `cargo xtask scenes`.

use std::{ops::Range, path::PathBuf};

use crate::fault::Fault;

use super::kinds;

/// Options of the command.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Seeds.
    pub seeds: Range<u64>,
    /// The only kinds to run; all where there are none.
    pub kinds: Vec<String>,
    /// Scenes at a time.
    pub jobs: usize,
    /// Folder for the decks that fail.
    pub keep: PathBuf,
    /// The program; built if absent.
    pub binary: Option<PathBuf>,
    /// Method of contact; the program's default if absent.
    pub enforcement: Option<&'static str>,
    /// Statement of what may touch.
    pub posing: Posing,
}

/// Statement of what may touch in all scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Posing {
    /// As they are.
    Own,
    /// Without pairs, beside a run with pairs.
    General,
}

/// Methods of contact.
const METHODS: [&str; 2] = ["weighted", "collocated"];

impl Options {
    /// Reads the arguments.
    ///
    /// # Errors
    /// An option that is not known or has no good value.
    pub fn read(arguments: &[String]) -> Result<Self, Fault> {
        let mut options = Self {
            seeds: kinds::FIRST_OF_ALL..kinds::FIRST_OF_ALL + 90,
            kinds: Vec::new(),
            jobs: 2,
            keep: PathBuf::from("target/scenes"),
            binary: None,
            enforcement: None,
            posing: Posing::Own,
        };
        let mut rest = arguments.iter();
        while let Some(name) = rest.next() {
            if name == "--general" {
                options.posing = Posing::General;
                continue;
            }
            let wrong = || Fault::Option(format!("`{name}` needs another value"));
            let value = rest.next().ok_or_else(wrong)?;
            match name.as_str() {
                "--seeds" => options.seeds = range(value).ok_or_else(wrong)?,
                "--kind"
                    if value
                        .split(',')
                        .all(|kind| kinds::names().any(|k| k == kind)) =>
                {
                    options.kinds = value.split(',').map(str::to_owned).collect();
                }
                "--jobs" => {
                    let jobs = value.parse().ok().filter(|&jobs| jobs > 0);
                    options.jobs = jobs.ok_or_else(wrong)?;
                }
                "--keep" => options.keep = value.into(),
                "--binary" => options.binary = Some(value.into()),
                "--enforcement" => {
                    let method = METHODS.into_iter().find(|method| method == value);
                    options.enforcement = Some(method.ok_or_else(wrong)?);
                }
                "--kind" => {
                    let names: Vec<&str> = kinds::names().collect();
                    return Err(Fault::Option(format!("kinds are {}", names.join(", "))));
                }
                _ => return Err(Fault::Option(format!("there is no option `{name}`"))),
            }
        }
        let never = options.kinds.iter().find(|kind| {
            let of = kinds::seeds_of(kind);
            options.seeds.start >= of.end || options.seeds.end <= of.start
        });
        if let Some(kind) = never {
            let Range { start, end } = kinds::seeds_of(kind);
            let until = if end == u64::MAX {
                "on".into()
            } else {
                format!("to {}", end - 1)
            };
            return Err(Fault::Option(format!(
                "scenes of the kind `{kind}` have seeds from {start} {until}"
            )));
        }
        Ok(options)
    }
}

/// `A..B`, or one seed.
fn range(text: &str) -> Option<Range<u64>> {
    match text.split_once("..") {
        Some((from, to)) => Some(from.parse().ok()?..to.parse().ok()?),
        None => text.parse().ok().map(|seed: u64| seed..seed + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_read() {
        let read = |text: &str| {
            let arguments: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
            Options::read(&arguments)
        };
        assert_eq!(read("").unwrap().posing, Posing::Own);
        assert_eq!(read("--general").unwrap().posing, Posing::General);
        let options = read("--general --seeds 3..9 --kind press --jobs 1").unwrap();
        assert_eq!((options.seeds, options.jobs), (3..9, 1));
        assert_eq!(options.kinds, ["press"]);
        assert_eq!(read("--seeds 7").unwrap().seeds, 7..8);
        for wrong in [
            "--seeds",
            "--seeds x",
            "--jobs 0",
            "--kind none",
            "--seeds 0..90 --kind pile",
            "--seeds 100000..100100 --kind bag",
            "--seeds 200000..200100 --kind pile",
            "--fast 1",
        ] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
