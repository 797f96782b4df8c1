//! Published cases on one to four ranks, held against the same decks on one process.
//!
//! The one process solves with the multifrontal LU: the default solver corrects contact alone
//! between iterations, which ranks do not, and would need fewer of them.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use super::{ENVIRONMENT, RANKS, finished};
use crate::{cargo, fault::Fault, scenes::output::History};

/// A deck, and whether it takes minutes.
struct Case {
    deck: &'static str,
    is_long: bool,
}

const fn short(deck: &'static str) -> Case {
    let is_long = false;
    Case { deck, is_long }
}

const CASES: [Case; 6] = [
    short("patch-frictionless/three-to-four-lower-finer"),
    short("patch-stick/three-to-four"),
    short("two-blocks/deck"),
    short("hertz-mindlin/deck"),
    short("bar-impact/deck"),
    Case {
        deck: "tyre-rolling/deck",
        is_long: true,
    },
];
/// Largest difference of a resultant or reaction, over the largest of them.
const FORCES: f64 = 1e-8;
/// Largest difference of the iterations of an increment.
const ITERATIONS: f64 = 1.0;

/// Which cases are run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Those that take seconds.
    Short,
    /// All.
    All,
}

/// Runs cases on all numbers of ranks.
///
/// # Errors
/// The first run that fails, or differs from that of one process.
pub fn check(extent: Extent) -> Result<(), Fault> {
    let build = ["build", "--release", "-p", "striae-cli"];
    cargo::cargo(&[&build[..], &["--features", "petsc"]].concat(), &[])?;
    let program = cargo::built();
    for case in &CASES {
        if case.is_long && extent == Extent::Short {
            continue;
        }
        println!("== {}", case.deck);
        let alone = case.alone(&program)?;
        for ranks in RANKS {
            let together = case.together(&program, ranks)?;
            let differences = Differences::of(&alone, &together)
                .map_err(|words| Fault::Mpi(format!("{} on {ranks} ranks: {words}", case.deck)))?;
            let Differences { forces, iterations } = differences;
            println!(
                "{ranks} ranks: {} increments, forces differ by {forces:.1e}, iterations by {iterations}",
                together.len()
            );
            if forces > FORCES || iterations > ITERATIONS {
                let words = format!("{} differs on {ranks} ranks", case.deck);
                return Err(Fault::Mpi(words));
            }
        }
    }
    Ok(())
}

impl Case {
    /// The history of one process with the multifrontal LU.
    fn alone(&self, program: &Path) -> Result<History, Fault> {
        let deck = self.folder().join("deck.toml");
        let path = self.path();
        let text = fs::read_to_string(&path).map_err(|cause| Fault::Unreadable { path, cause })?;
        fs::create_dir_all(self.folder())
            .and_then(|()| fs::write(&deck, by_multifrontal(&text)))
            .map_err(|cause| {
                Fault::Mpi(format!("{} cannot be written: {cause}", deck.display()))
            })?;
        self.history(Command::new(program), &deck, "alone", &[])
    }

    fn together(&self, program: &Path, ranks: usize) -> Result<History, Fault> {
        let mut command = Command::new("mpirun");
        command.arg("-n").arg(ranks.to_string()).arg(program);
        let name = format!("ranks-{ranks}");
        self.history(command, &self.path(), &name, &["--petsc"])
    }

    fn history(
        &self,
        mut command: Command,
        deck: &Path,
        name: &str,
        options: &[&str],
    ) -> Result<History, Fault> {
        let results = self.folder().join(name);
        command.arg("run").arg(deck).arg("--out").arg(&results);
        command.args(["--overwrite", "--quiet"]).args(options);
        finished(command.envs(ENVIRONMENT))?;
        let path = results.join("history.csv");
        History::read(&path).map_err(|words| Fault::Mpi(format!("{}: {words}", path.display())))
    }

    /// Where its deck is.
    fn path(&self) -> PathBuf {
        Path::new("cases").join(self.deck).with_extension("toml")
    }

    /// Where its runs go.
    fn folder(&self) -> PathBuf {
        Path::new("target/mpi").join(self.deck)
    }
}

/// A deck with another solver.
fn by_multifrontal(deck: &str) -> String {
    let solver = "[solver]\nbackend = \"multifrontal\"\n";
    match deck.contains("[solver]\n") {
        true => deck.replace("[solver]\n", solver),
        false => format!("{deck}\n{solver}"),
    }
}

/// How much two histories differ.
struct Differences {
    /// Of resultants and reactions, over the largest of them.
    forces: f64,
    /// Of the iterations of an increment.
    iterations: f64,
}

impl Differences {
    /// # Errors
    /// Where the histories have other columns or another number of rows.
    fn of(alone: &History, together: &History) -> Result<Self, String> {
        let is_force = |name: &&str| name.contains(".resultant_") || name.starts_with("reaction.");
        let mut differences = Self {
            forces: 0.0,
            iterations: largest(alone, together, "iterations")?.1,
        };
        let mut size: f64 = 0.0;
        for name in alone.names().filter(is_force) {
            let (value, difference) = largest(alone, together, name)?;
            size = size.max(value);
            differences.forces = differences.forces.max(difference);
        }
        if size == 0.0 {
            return Err("the history has no forces".into());
        }
        differences.forces /= size;
        Ok(differences)
    }
}

/// The largest value and the largest difference of a column.
fn largest(alone: &History, together: &History, name: &str) -> Result<(f64, f64), String> {
    let [a, b] = [alone, together].map(|history| history.column(name));
    if a.is_empty() || a.len() != b.len() {
        return Err(format!("{} rows of `{name}` for {}", b.len(), a.len()));
    }
    let value = a.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    if a.iter().chain(&b).any(|number| !number.is_finite()) {
        return Err(format!("`{name}` is not finite"));
    }
    let differences = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
    Ok((value, differences.fold(0.0, f64::max)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history(rows: &str) -> History {
        let names = "iterations,pair.a.resultant_a.x,reaction.b.y";
        History::of(&format!("{names}\n{rows}")).unwrap()
    }

    #[test]
    fn forces_are_compared_over_the_largest() {
        let alone = history("3,1,-4\n4,2,0\n");
        let differences = Differences::of(&alone, &history("3,1.5,-4\n6,2,0\n")).unwrap();
        assert_eq!(differences.forces, 0.125);
        assert_eq!(differences.iterations, 2.0);
    }

    #[test]
    fn runs_that_ended_elsewhere_differ() {
        let alone = history("3,1,-4\n4,2,0\n");
        assert!(Differences::of(&alone, &history("3,1,-4\n")).is_err());
        for rows in [
            "3,NaN,-4\n4,2,0\n",
            "3,1,-4\n4,NaN,0\n",
            "3,inf,-4\n4,2,0\n",
        ] {
            assert!(Differences::of(&alone, &history(rows)).is_err(), "{rows}");
        }
        assert!(Differences::of(&history("3,0,0\n"), &history("3,0,0\n")).is_err());
    }

    #[test]
    fn the_solver_of_a_deck_is_another() {
        let with = by_multifrontal("[solver]\ntolerance = 1e-9\n");
        assert_eq!(
            with,
            "[solver]\nbackend = \"multifrontal\"\ntolerance = 1e-9\n"
        );
        assert!(by_multifrontal("title = \"a\"").ends_with("backend = \"multifrontal\"\n"));
    }
}
