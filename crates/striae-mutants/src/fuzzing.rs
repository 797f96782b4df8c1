//! A target under libFuzzer: its seeds, its mutants, and what becomes of findings.
//!
//! ```text
//! FOLDER/seeds/TARGET/      files that libFuzzer begins with
//! FOLDER/words/TARGET       its dictionary
//! FOLDER/findings/TARGET-KIND-HASH        an input that fails
//! FOLDER/findings/TARGET-KIND-HASH.txt    what it does
//! ```
//!
//! An input that fails is kept, unless another one fails in the same words, and the search goes
//! on. Only what ends the process, a hang, a full stack or too much memory, ends it.

use std::{
    env, fs, io,
    path::PathBuf,
    time::{Duration, Instant},
};

use crate::{
    dictionary::dictionary,
    judge::{Depth, Finding, Judge, Kind},
    mutation::{Form, mutated},
    random::Random,
    target::{Sample, Target, regressions},
    trial::{Mutants, seal},
    usage::processor_time,
};

/// Environment variable with the name of the target.
pub const TARGET: &str = "STRIAE_FUZZ_TARGET";
/// Environment variable with the folder.
pub const FOLDER: &str = "STRIAE_FUZZ_FOLDER";

/// Processor time after which an input hangs: 10 s of a program that does not count what it
/// reaches.
const SECONDS: u64 = 25;
/// Inputs of which one is run, and not only checked.
const RUN: u32 = 4;

/// A target with what it needs.
#[derive(Debug)]
pub struct Fuzzing {
    target: Target,
    judge: Judge,
    seeds: Vec<Sample>,
    findings: PathBuf,
}

impl Fuzzing {
    /// The target and the folder that the environment names, with its seeds and words written.
    ///
    /// # Errors
    /// When the environment names none, or files cannot be written.
    pub fn new() -> io::Result<Self> {
        let variable = |name| env::var(name).map_err(|_| io::Error::other(format!("no {name}")));
        let name = variable(TARGET)?;
        let target = Target::ALL.into_iter().find(|target| target.name() == name);
        let target = target.ok_or_else(|| io::Error::other(format!("no target `{name}`")))?;
        let folder = PathBuf::from(variable(FOLDER)?);
        let judge = Judge::new()?;
        let mut seeds = Mutants::new(vec![target], judge.folder())
            .samples(target)
            .to_vec();
        let failed = regressions().into_iter().filter(|(of, _)| *of == target);
        seeds.extend(failed.map(|(_, sample)| sample));
        let files = folder.join("seeds").join(&name);
        fs::create_dir_all(&files)?;
        for (number, seed) in seeds.iter().enumerate() {
            fs::write(files.join(format!("{number}-{}", seed.name)), &seed.bytes)?;
        }
        fs::create_dir_all(folder.join("words"))?;
        let words = dictionary(target, &seeds);
        fs::write(folder.join("words").join(&name), words)?;
        let findings = folder.join("findings");
        fs::create_dir_all(&findings)?;
        Ok(Self {
            target,
            judge,
            seeds,
            findings,
        })
    }

    /// Reads an input; keeps it if it fails.
    ///
    /// # Errors
    /// The failure.
    pub fn tried(&self, bytes: &[u8]) -> Result<(), Finding> {
        // The content decides, so that an input does the same whenever it is tried.
        let depth = match crc32fast::hash(bytes).is_multiple_of(RUN) {
            true => Depth::Run,
            false => Depth::Check,
        };
        let sample = self.target.sample(bytes);
        let begun = (Instant::now(), used());
        let judged = self.judge.judge(self.target, &sample, depth).map(drop);
        let limit = Duration::from_secs(SECONDS);
        // The clock is cheaper to read than the table of the process.
        let slow = begun.0.elapsed() > limit && used().saturating_sub(begun.1) > limit;
        let judged = match slow {
            true => Err(Finding {
                kind: Kind::Slow,
                text: format!("takes more than {SECONDS} s"),
            }),
            false => judged,
        };
        if let Err(finding) = &judged {
            self.keep(&sample, finding);
        }
        judged
    }

    /// A mutant of `bytes`, by the generator of mutants.
    pub fn mutated(&self, bytes: &[u8], random: &mut Random) -> Vec<u8> {
        let other = random.pick(&self.seeds);
        mutated(bytes, &other.bytes, Form::of(bytes), random)
    }

    /// Completes a mutant: a checkpoint with a wrong checksum is not looked at any further.
    pub fn complete(&self, bytes: &mut [u8]) {
        if self.target == Target::Checkpoint {
            seal(bytes);
        }
    }

    fn keep(&self, sample: &Sample, finding: &Finding) {
        let kind = format!("{:?}", finding.kind).to_lowercase();
        let hash = crc32fast::hash(shape(finding).as_bytes());
        let name = format!("{}-{kind}-{hash:08x}", self.target.name());
        let told = self.findings.join(format!("{name}.txt"));
        if !told.exists() {
            let kept = fs::write(self.findings.join(name), &sample.bytes);
            let kept = kept.and_then(|()| fs::write(told, &finding.text));
            kept.expect("a file in the folder of findings");
        }
    }
}

/// The place of a panic, or the words of a message without names and numbers.
fn shape(finding: &Finding) -> String {
    let mut words = finding.text.split_whitespace();
    match finding.kind {
        Kind::Panic => words
            .find(|word| word.contains(".rs:"))
            .unwrap_or_default()
            .into(),
        _ => words
            .filter(|word| {
                word.chars()
                    .all(|c| c.is_alphabetic() || c.is_ascii_punctuation())
            })
            .filter(|word| !word.contains(['`', '"', '/']))
            .collect::<Vec<_>>()
            .join(" "),
    }
}

fn used() -> Duration {
    processor_time(std::process::id()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_that_differ_in_names_and_numbers_have_one_shape() {
        let of = |kind, text: &str| {
            shape(&Finding {
                kind,
                text: text.into(),
            })
        };
        let first = of(Kind::NoPlace, "body `a` has 3 nodes");
        assert_eq!(first, of(Kind::NoPlace, "body `b` has 17 nodes"));
        assert_ne!(first, of(Kind::NoPlace, "body `b` has 17 elements"));
        let panic = of(Kind::Panic, "panicked at src/a.rs:3:4: index 5");
        assert_eq!(panic, of(Kind::Panic, "panicked at src/a.rs:3:4: index 6"));
        assert_ne!(panic, of(Kind::Panic, "panicked at src/a.rs:8:4: index 5"));
    }
}
