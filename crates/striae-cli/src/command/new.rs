//! `striae new NAME`: a commented deck to start from.

use crate::{failure::Failure, shell::word};
use std::{
    fs,
    io::{self, Write},
    path::PathBuf,
};

/// Schema by which editors complete and check the deck; its first line names it.
const SCHEMA: &str = "deck.schema.json";

/// Write NAME/deck.toml, a commented deck to start from.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder to be made; it must not exist.
    name: PathBuf,
    /// Model that the deck begins with.
    #[arg(long, value_enum, default_value = "blocks")]
    template: Template,
}

/// Decks to start from; each runs as it is, within seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Template {
    /// Two blocks, pressed and slid.
    Blocks,
    /// A grooved pad on a grooved floor.
    Pad,
    /// A tyre that rolls over a grooved road.
    Tyre,
    /// A worm that crawls by its scales.
    Crawler,
    /// An O-ring on a ground counterface.
    Seal,
    /// A finger that strokes a nap.
    Finger,
}

impl Template {
    fn deck(self) -> &'static str {
        match self {
            Self::Blocks => include_str!("new/blocks.toml"),
            Self::Pad => include_str!("new/pad.toml"),
            Self::Tyre => include_str!("new/tyre.toml"),
            Self::Crawler => include_str!("new/crawler.toml"),
            Self::Seal => include_str!("new/seal.toml"),
            Self::Finger => include_str!("new/finger.toml"),
        }
    }
}

/// Makes the folder and its deck.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let folder = &arguments.name;
    let unwritable = |path: &PathBuf, cause| Failure::Unwritable {
        path: path.clone(),
        cause,
    };
    if let Some(parent) = folder.parent() {
        fs::create_dir_all(parent).map_err(|cause| unwritable(folder, cause))?;
    }
    fs::create_dir(folder).map_err(|cause| match cause.kind() {
        io::ErrorKind::AlreadyExists => Failure::Exists(folder.clone()),
        _ => unwritable(folder, cause),
    })?;
    let deck = folder.join("deck.toml");
    fs::write(&deck, arguments.template.deck()).map_err(|cause| unwritable(&deck, cause))?;
    let schema = folder.join(SCHEMA);
    let text = format!(
        "{:#}\n",
        striae_deck::json_schema(&striae_deck::Laws::default())
    );
    fs::write(&schema, text).map_err(|cause| unwritable(&schema, cause))?;
    let path = deck.display();
    let next = word(&deck);
    writeln!(out, "wrote {path}\nnext: striae check {next}")?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use clap::ValueEnum;
    use striae::Simulation;
    use striae_solve::outcome::Ending;

    use super::*;
    use crate::command::check;

    #[test]
    fn the_new_deck_passes_the_check_and_is_not_overwritten() {
        let scratch = tempfile::tempdir().unwrap();
        let name = scratch.path().join("group").join("blocks");
        let arguments = Arguments {
            name: name.clone(),
            template: Template::Blocks,
        };
        let mut out = Vec::new();
        run(&arguments, &mut out).unwrap();
        let deck = name.join("deck.toml");
        let first = format!("#:schema ./{SCHEMA}");
        let text = fs::read_to_string(&deck).unwrap();
        assert_eq!(text.lines().next(), Some(first.as_str()));
        assert!(name.join(SCHEMA).exists());
        let checked = check::Arguments {
            source: deck.clone().into(),
            json: false,
        };
        check::run(&checked, &mut out).unwrap();
        let said = String::from_utf8(out).unwrap();
        assert!(said.contains("Two blocks, pressed and slid"), "{said}");

        fs::write(&deck, "changed").unwrap();
        assert!(
            matches!(run(&arguments, &mut Vec::new()), Err(Failure::Exists(path)) if path == name)
        );
        assert_eq!(fs::read_to_string(&deck).unwrap(), "changed");
    }

    /// Each template is read without a fault, runs to its end and leaves nothing to be warned of.
    #[test]
    fn all_templates_run_without_a_warning() {
        let scratch = tempfile::tempdir().unwrap();
        for template in Template::value_variants() {
            let name = scratch.path().join(format!("{template:?}"));
            let arguments = Arguments {
                name: name.clone(),
                template: *template,
            };
            let mut out = Vec::new();
            run(&arguments, &mut out).unwrap();
            let deck = name.join("deck.toml");
            let checked = check::Arguments {
                source: deck.clone().into(),
                json: false,
            };
            check::run(&checked, &mut out).unwrap();
            let said = String::from_utf8(out).unwrap();
            assert!(said.contains("no faults, no warnings"), "{said}");
            let outcome = Simulation::open(&deck, name.join("results")).unwrap().run();
            let outcome = outcome.unwrap();
            assert_eq!(outcome.ending, Ending::Completed, "{template:?}");
            let summary = outcome.summary;
            assert!(summary.warnings.is_empty(), "{:?}", summary.warnings);
            assert_eq!(summary.cutbacks, 0, "{template:?}");
        }
    }
}
