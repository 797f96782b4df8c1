//! Flags with the constants of declared laws.

use clap::{Arg, ArgGroup, ArgMatches, Command, Error};
use striae_declared::Declared;
use striae_law::{friction::Friction, friction::LAWS};

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
