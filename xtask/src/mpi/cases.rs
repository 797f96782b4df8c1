//! Published cases on one to four ranks, compared with the same decks on one process.
//!
//! The one process solves with the multifrontal LU: the default solver corrects contact alone
//! between iterations, which ranks do not, and would need fewer of them.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use super::{ENVIRONMENT, RANKS, differences::Differences, finished};
use crate::{fault::Fault, scenes::output::History};

/// A deck, what is replaced in it, and whether it takes minutes.
struct Case {
    deck: &'static str,
    replaced: Option<[&'static str; 2]>,
    is_long: bool,
}

const fn short(deck: &'static str) -> Case {
    Case {
        deck,
        replaced: None,
        is_long: false,
    }
}

/// Two blocks with a state of friction.
const fn with_state(friction: &'static str) -> Case {
    Case {
        deck: "two-blocks/deck",
        replaced: Some(["mu = 0.3 }", friction]),
        is_long: false,
    }
}

const CASES: [Case; 8] = [
    short("patch-frictionless/three-to-four-lower-finer"),
    short("patch-stick/three-to-four"),
    short("two-blocks/deck"),
    with_state(
        r#"mu = 0.3, by_state = { form = "ageing-law", direct_effect = 0.02, evolution_effect = 0.01, slip_rate = 0.1, slip_distance = 0.05 } }"#,
    ),
    with_state(
        r#"mu = 0.3, by_state = { form = "static-kinetic", kinetic_over_static = 0.8, slip_distance = 0.1, healing_time = 1 } }"#,
    ),
    short("hertz-mindlin/deck"),
    short("bar-impact/deck"),
    Case {
        deck: "tyre-rolling/deck",
        // As `reproduce --quick` has it.
        replaced: Some(["divisions = [4, 90, 6]", "divisions = [3, 60, 4]"]),
        is_long: true,
    },
];
/// Cases that are run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Cases that take seconds.
    Short,
    /// All.
    All,
}

/// Runs cases on all numbers of ranks.
///
/// # Errors
/// The first run that fails, or differs from that of one process.
pub fn check(program: &Path, extent: Extent) -> Result<(), Fault> {
    for case in &CASES {
        if case.is_long && extent == Extent::Short {
            continue;
        }
        println!("== {}", case.deck);
        let alone = case.alone(program)?;
        for ranks in RANKS {
            let together = case.together(program, ranks)?;
            let differences = Differences::of(&alone, &together)
                .map_err(|words| Fault::Mpi(format!("{} on {ranks} ranks: {words}", case.deck)))?;
            println!(
                "{ranks} ranks: {} increments, {differences}",
                together.len()
            );
            if !differences.are_small() {
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
        let deck = self.written("alone", &by_multifrontal(&self.text()?))?;
        self.history(Command::new(program), &deck, "alone", &[])
    }

    fn together(&self, program: &Path, ranks: usize) -> Result<History, Fault> {
        let mut command = Command::new("mpirun");
        command.arg("-n").arg(ranks.to_string()).arg(program);
        let name = format!("ranks-{ranks}");
        let deck = self.written("ranks", &self.text()?)?;
        self.history(command, &deck, &name, &["--petsc"])
    }

    /// The text of the deck.
    fn text(&self) -> Result<String, Fault> {
        let path = Path::new("cases").join(self.deck).with_extension("toml");
        let text = fs::read_to_string(&path).map_err(|cause| Fault::Unreadable { path, cause })?;
        let Some([from, to]) = self.replaced else {
            return Ok(text);
        };
        match text.contains(from) {
            true => Ok(text.replace(from, to)),
            false => Err(Fault::Mpi(format!("{} has no `{from}`", self.deck))),
        }
    }

    /// Path of a deck that is written where its runs go.
    fn written(&self, name: &str, text: &str) -> Result<PathBuf, Fault> {
        let path = self.folder().join(name).with_extension("toml");
        let written = fs::create_dir_all(self.folder()).and_then(|()| fs::write(&path, text));
        match written {
            Ok(()) => Ok(path),
            Err(cause) => {
                let words = format!("{} cannot be written: {cause}", path.display());
                Err(Fault::Mpi(words))
            }
        }
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

    /// Folder of its runs.
    fn folder(&self) -> PathBuf {
        Path::new("target/mpi").join(self.deck)
    }
}

/// A deck with another solver.
pub fn by_multifrontal(deck: &str) -> String {
    let solver = "[solver]\nbackend = \"multifrontal\"\n";
    match deck.contains("[solver]\n") {
        true => deck.replace("[solver]\n", solver),
        false => format!("{deck}\n{solver}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
