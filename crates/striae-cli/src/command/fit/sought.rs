//! The law that is sought, by its name and by a flag for each of its words.

use clap::{
    Arg, ArgMatches, Command, Error,
    builder::{PossibleValue, PossibleValuesParser},
    error::ErrorKind,
};
use striae_declared::{Form, Parameter};
use striae_law::{fit::Sought, friction::LAWS};

/// A law that measurements can give.
#[derive(Clone, Debug)]
pub struct Law(pub Sought);

impl clap::FromArgMatches for Law {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let name: &String = matches.get_one("law").expect("it is required");
        let mut sought = Sought::named(name).expect("it is one of those that can be sought");
        for parameter in words() {
            let given: Option<&String> = matches.get_one(parameter.name);
            let word = given.and_then(|given| choices(parameter).find(|(word, _)| word == given));
            if let Some((word, _)) = word {
                let law = sought.law();
                if !law.parameters.iter().any(|own| own.name == parameter.name) {
                    let flag = flag(parameter);
                    let told = format!("the law `{}` has no `--{flag}`; leave it out", law.name);
                    return Err(Error::raw(ErrorKind::ArgumentConflict, told));
                }
                sought = sought.with(parameter.name, word);
            }
        }
        Ok(Self(sought))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl clap::Args for Law {
    fn augment_args(command: Command) -> Command {
        let laws = LAWS.iter().filter(|law| law.fit.is_some());
        let laws = laws.map(|law| PossibleValue::new(law.name).help(law.summary));
        let law = Arg::new("law").long("law").required(true);
        let law = law.help("The law");
        let word = |parameter: &'static Parameter| {
            let words = choices(parameter).map(|(word, doc)| PossibleValue::new(word).help(doc));
            Arg::new(parameter.name)
                .long(flag(parameter))
                .help(parameter.told())
                .value_parser(PossibleValuesParser::new(words))
        };
        command
            .arg(law.value_parser(PossibleValuesParser::new(laws)))
            .args(words().map(word))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// Parameters of laws that take words.
fn words() -> impl Iterator<Item = &'static Parameter> {
    let laws = LAWS.iter().filter(|law| law.fit.is_some());
    let parameters = laws.flat_map(|law| law.parameters);
    parameters.filter(|parameter| matches!(parameter.form, Form::Word(_)))
}

/// Flag of a parameter.
fn flag(parameter: &Parameter) -> String {
    parameter.name.replace('_', "-")
}

/// Words of a parameter with their descriptions.
fn choices(parameter: &Parameter) -> impl Iterator<Item = (&'static str, &'static str)> {
    let words = match parameter.form {
        Form::Word(words) => words,
        _ => &[],
    };
    words.iter().copied()
}
