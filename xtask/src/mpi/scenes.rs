//! Random scenes on three ranks, held against one process.
//!
//! The scenes are those of [`crate::scenes`]. One process solves with the multifrontal LU; see
//! [`super::cases`] for the reason. What it refuses ranks must refuse in the same words; what it
//! stops at, they must stop at.
//!
//! If the state of a point depends on round-off, iterations may take another way on ranks, and even
//! lead to another of several states in balance: friction that weakens has more than one. That is
//! no fault of ranks if it does the same on one process: the scene is run there again and again
//! with prescribed motions and loads that differ by `1e-12` of their size, until that is
//! [`Evidence`] enough. Such scenes are named with what was found; where there is none, ranks are
//! wrong. Before that the ranks are run again where increments are others, or nothing but
//! iterations is over the bounds, as the last digits of MUMPS differ from run to run: that excuses
//! them if a run agrees with one process.

use std::{
    fmt, fs,
    path::{Path, PathBuf},
};

use super::{
    cases::{Extent, by_multifrontal},
    differences::{Differences, FORCES},
    evidence::Evidence,
    started::{broken_off, history, start},
};
use crate::{
    fault::Fault,
    scenes::{deck_of, output::History, random::Random},
};

/// Ranks.
const RANKS: usize = 3;
/// The first seed of all, and how many there are.
const SEEDS: std::ops::Range<u64> = 81_000..81_050;
/// Seeds that take a second or two: one that is refused, one whose nodes close all at once, and
/// none that hangs on round-off.
const SHORT: [u64; 6] = [81_003, 81_004, 81_005, 81_046, 81_048, 84_033];
/// Change of loads and motions, over their size.
const CHANGE: f64 = 1e-12;
/// Largest number of changed runs: of scene 81031 one in twelve reaches another state.
const CHANGES: u64 = 120;
/// Runs on ranks that are made again first.
const RUNS: usize = 4;

/// Outcome of a scene.
enum Outcome {
    /// The exit code, and the history.
    Ran(i32, History),
    /// Message of the refusal.
    Refused(String),
}

/// Runs scenes.
///
/// # Errors
/// All that came out otherwise on ranks.
pub fn check(program: &Path, extent: Extent) -> Result<(), Fault> {
    println!("== scenes");
    let seeds: Vec<u64> = match extent {
        Extent::Short => SHORT.to_vec(),
        Extent::All => SEEDS.collect(),
    };
    let mut faults = Vec::new();
    for &seed in &seeds {
        let (kind, deck) = deck_of(seed);
        let folder = Path::new("target/mpi/scenes").join(format!("{seed}-{kind}"));
        let scene = Scene {
            program,
            deck,
            folder,
        };
        match scene.compared()? {
            Ok(words) => println!("{seed} {kind}: {words}"),
            Err(words) => {
                println!("{seed} {kind}: WRONG, {words}");
                faults.push(format!("{seed} {kind}: {words}"));
            }
        }
    }
    println!("{} scenes, {} wrong", seeds.len(), faults.len());
    match faults.is_empty() {
        true => Ok(()),
        false => Err(Fault::Mpi(faults.join("\n"))),
    }
}

/// A scene, and where its runs go.
struct Scene<'a> {
    program: &'a Path,
    deck: String,
    folder: PathBuf,
}

impl Scene<'_> {
    /// Outcome of the scene, or the differences between ranks.
    fn compared(&self) -> Result<Result<String, String>, Fault> {
        let alone = self.alone("alone", &self.deck)?;
        let together = self.run("ranks", &self.deck, RANKS)?;
        Ok(match (&alone, &together) {
            (Outcome::Refused(alone), Outcome::Refused(together)) => {
                match together.contains(alone) {
                    true => Ok(format!("refused alike: {}", shortened(alone))),
                    false => Err(format!("refused otherwise: {alone}\n{together}")),
                }
            }
            (Outcome::Ran(one, alone), Outcome::Ran(other, together)) => {
                let differences = Differences::of(alone, together);
                let codes = format!("exit code {one}, {} increments", alone.len());
                match differences {
                    Ok(found) if one == other && found.are_small() => {
                        Ok(format!("{codes}, {found}"))
                    }
                    found => self.excused((alone, together), (*one, *other), found)?,
                }
            }
            _ => Err(format!("{alone} on one process, {together} on ranks")),
        })
    }

    /// Differences of the ranks in another run of the deck, if small: bits of MUMPS differ from run
    /// to run.
    fn again(&self, alone: &History, code: i32) -> Result<Option<Differences>, Fault> {
        for _ in 0..RUNS {
            let Outcome::Ran(other, together) = self.run("again", &self.deck, RANKS)? else {
                continue;
            };
            if let Ok(found) = Differences::of(alone, &together)
                && found.are_small()
                && other == code
            {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    /// Returns whether the ranks differ among themselves, or one process from itself, by as much.
    fn excused(
        &self,
        (alone, together): (&History, &History),
        (one, other): (i32, i32),
        found: Result<Differences, String>,
    ) -> Result<Result<String, String>, Fault> {
        let said = match &found {
            Ok(found) => format!("exit codes {one} and {other}, {found}"),
            Err(words) => format!("exit codes {one} and {other}, {words}"),
        };
        // Forces over the bound in the same increments are not excused so.
        let may_be_again = match &found {
            Ok(found) => found.forces <= FORCES,
            Err(_) => true,
        };
        if may_be_again
            && one == other
            && let Some(again) = self.again(alone, one)?
        {
            return Ok(Ok(format!(
                "{said}; HANGS ON ROUND-OFF: the same ranks again: {again}"
            )));
        }
        let mut evidence = Evidence::new(alone, together);
        for number in 0..CHANGES {
            let deck = changed(&self.deck, number);
            let Outcome::Ran(code, history) = self.alone("changed", &deck)? else {
                continue;
            };
            if let Some(words) = evidence.with(&history, code == other) {
                return Ok(Ok(format!(
                    "{said}; HANGS ON ROUND-OFF: one process with loads changed by {CHANGE:.0e}, \
                     change {number}: {words}"
                )));
            }
        }
        let words = format!("{said}, which no change of loads by {CHANGE:.0e} does alone");
        Ok(Err(words))
    }

    fn alone(&self, name: &str, deck: &str) -> Result<Outcome, Fault> {
        self.run(name, &by_multifrontal(deck), 0)
    }

    /// Runs a deck on so many ranks, or without `mpirun` on none.
    fn run(&self, name: &str, deck: &str, ranks: usize) -> Result<Outcome, Fault> {
        let folder = self.folder.join(name);
        fs::create_dir_all(&folder).map_err(broken_off)?;
        let path = folder.join("deck.toml");
        fs::write(&path, deck).map_err(broken_off)?;
        let path = path.to_string_lossy();
        let arguments = ["run", &path, "--threads", "1", "--quiet", "--overwrite"];
        let arguments = [&arguments[..], &["--out"]].concat();
        let results = folder.join("results");
        let log = folder.join("log.txt");
        let ended = start((self.program, ranks), &arguments, &results, &log)?.ended()?;
        match ended.code {
            Some(code @ (0 | 1)) => Ok(Outcome::Ran(code, history(&results)?)),
            Some(2) => Ok(Outcome::Refused(ended.words.replace(&*path, ""))),
            code => Err(Fault::Mpi(format!(
                "{}: exit code {code:?}\n{}",
                folder.display(),
                ended.words
            ))),
        }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ran(code, history) => {
                write!(f, "exit code {code} after {} increments", history.len())
            }
            Self::Refused(words) => write!(f, "refused: {words}"),
        }
    }
}

/// A deck whose steps have other numbers with a point, by a little.
fn changed(deck: &str, number: u64) -> String {
    let at = deck.find("[[step]]").unwrap_or(deck.len());
    let (before, steps) = deck.split_at(at);
    let mut random = Random::new(number);
    let mut text = before.to_owned();
    let is_number = |c: char| c.is_ascii_digit() || "+-.e".contains(c);
    let mut rest = steps;
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|c| is_number(c) != is_number(first));
        let (word, after) = rest.split_at(end.unwrap_or(rest.len()));
        match word.parse::<f64>() {
            Ok(value) if word.contains('.') => {
                let value = value * (1.0 + CHANGE * random.between(-1.0, 1.0));
                text += &format!("{value:?}");
            }
            _ => text += word,
        }
        rest = after;
    }
    text
}

/// The first words.
fn shortened(words: &str) -> String {
    let line = words.lines().next().unwrap_or_default();
    line.chars().take(120).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_steps_are_changed_by_a_little() {
        let deck = "size = 1.5\n[[step]]\nname = \"press\"\nincrements = 4\nx = -2.5e-1, y = 0\n";
        let other = changed(deck, 3);
        assert_ne!(deck, other);
        assert_eq!(other, changed(deck, 3));
        let (head, rest) = other.split_once("x = ").unwrap();
        assert_eq!(head, deck.split_once("x = ").unwrap().0);
        let value: f64 = rest.split_once(',').unwrap().0.parse().unwrap();
        assert!(value != -0.25 && (value + 0.25).abs() <= 0.25 * 1.01 * CHANGE);
    }
}
