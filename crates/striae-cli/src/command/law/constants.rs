//! Flags with the constants of declared laws.

use clap::{Arg, ArgGroup, ArgMatches, Command, Error};
use striae_deck::{FaultKind, Faults};
use striae_declared::Declared;
use striae_law::{friction::Friction, friction::LAWS};

use crate::failure::Failure;

/// Name of the outermost table in faults.
const ROOT: &str = "the deck";

/// A friction in the words of a deck, without a deck: the name of a law, and its constants.
pub struct Constants(pub Option<(&'static str, String)>);

impl clap::FromArgMatches for Constants {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let given = |law: &'static Declared<Friction>| {
            let constants: &String = matches.get_one(law.name)?;
            Some((law.name, constants.clone()))
        };
        Ok(Self(laws().find_map(given)))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl clap::Args for Constants {
    fn augment_args(command: Command) -> Command {
        let flag = |law: &'static Declared<Friction>| {
            let keys: Vec<String> = law
                .parameters
                .iter()
                .map(|parameter| format!("`{}`", parameter.name))
                .collect();
            Arg::new(law.name)
                .long(law.name)
                .value_name("KEY=VALUE,..")
                .help(format!("{} Keys: {}", law.summary, keys.join(", ")))
        };
        let names = laws().map(|law| law.name);
        let group = ArgGroup::new("constants").args(names);
        command
            .args(laws().map(flag))
            .group(group.conflicts_with("deck"))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// Laws that have constants.
fn laws() -> impl Iterator<Item = &'static Declared<Friction>> {
    let laws = LAWS.iter().copied();
    laws.filter(|law| !law.parameters.is_empty())
}

/// The friction of a law with constants `key=value,..`.
pub(super) fn friction(law: &str, constants: &str) -> Result<Friction, Failure> {
    let option = format!("--{law}");
    striae_deck::friction(&in_deck_words(law, constants), &option)
        .map_err(|faults| Failure::Constants(of_option(&option, &faults)))
}

/// `key=value,..` as keys of a `friction` table, numbers and words as TOML wants them;
/// a value in brackets or braces is a list or a table and stays as it is.
fn in_deck_words(law: &str, constants: &str) -> String {
    let mut inside = 0;
    let between = |character: char| {
        inside += match character {
            '[' | '{' => 1,
            ']' | '}' => -1,
            _ => 0,
        };
        character == ',' && inside == 0
    };
    let constants = constants.split(between);
    let constants = constants.filter(|one| !one.trim().is_empty());
    let line = |one: &str| match one.split_once('=') {
        Some((key, value)) => match (key.trim(), value.trim(), value.trim().parse::<f64>()) {
            // TOML has `nan` in small letters.
            (key, _, Ok(number)) => format!("{key} = {}\n", format!("{number:?}").to_lowercase()),
            (key, list, _) if list.starts_with(['[', '{']) => format!("{key} = {list}\n"),
            (key, word, _) => format!("{key} = {word:?}\n"),
        },
        None => format!("{one}\n"),
    };
    format!("law = {law:?}\n") + &constants.map(line).collect::<String>()
}

/// Faults of constants in the words of their option, as there is no deck.
fn of_option(option: &str, faults: &Faults) -> String {
    let told = faults.iter().map(|fault| match &fault.kind {
        FaultKind::MissingKey {
            key,
            place,
            expected,
        } if place == ROOT => {
            format!("{option}: `{key}` is missing; add `{key}=VALUE`, {expected}")
        }
        FaultKind::UnknownKey {
            key,
            place,
            nearest,
            known,
        } if place == ROOT => {
            let known: Vec<String> = known.iter().map(|key| format!("`{key}`")).collect();
            let hint = match nearest {
                Some(nearest) => format!("did you mean `{nearest}`?"),
                None => format!("known constants are {}", known.join(", ")),
            };
            format!("{option}: unknown constant `{key}`; {hint}")
        }
        FaultKind::Syntax { message } => {
            format!("{option}: {message}; it is given as KEY=VALUE,KEY=VALUE")
        }
        kind => format!("{option}: {kind}"),
    });
    told.collect::<Vec<_>>().join("\n")
}
