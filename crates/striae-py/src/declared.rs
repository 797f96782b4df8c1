//! Declared laws: made of values by their names, and listed for the classes of the package,
//! which `declared.py` writes.

use pyo3::prelude::*;
use striae::law::{
    declared::{Absent, Declared, Form, Kind, Parameter, Value, Values, named},
    friction::{BY_PRESSURE, BY_RATE, BY_SLIP, BY_STATE, DECAY, LAWS},
};

use crate::fault::refused;

/// A value of a parameter.
#[derive(Clone, FromPyObject, IntoPyObject)]
pub enum Given {
    /// A number.
    Number(f64),
    /// A list of numbers.
    Numbers(Vec<f64>),
    /// A word.
    Word(String),
}

/// Name, form, words with their descriptions, unit, description, and default: whether there is
/// one, and the number or word if it is one.
type Told = (
    &'static str,
    &'static str,
    Vec<(&'static str, &'static str)>,
    &'static str,
    &'static str,
    (bool, Option<Given>, String),
);

/// Name, description, whether measurements give its constants, and parameters.
type Law = (&'static str, &'static str, bool, Vec<Told>);

/// Makes the law of a list that has a name; `place` is what faults call it.
pub fn made<L: Kind>(
    laws: &[&'static Declared<L>],
    name: &str,
    place: &str,
    values: &[(String, Given)],
) -> PyResult<L> {
    let law = named(laws, name).ok_or_else(|| refused(place, "there is no such law"))?;
    let mut found = Values::default();
    for parameter in law.parameters {
        let given = values.iter().find(|(name, _)| name == parameter.name);
        match (given, parameter.form) {
            (Some((_, Given::Number(number))), Form::Number(_)) => {
                found = found.with(parameter.name, *number);
            }
            (Some((_, Given::Numbers(numbers))), Form::Numbers(_)) => {
                found = found.with(parameter.name, numbers.clone());
            }
            (Some((_, Given::Word(word))), Form::Word(words)) => {
                let word = words.iter().find(|(known, _)| known == word);
                let (word, _) = word.ok_or_else(|| refused(parameter.name, "no such word"))?;
                found = found.with(parameter.name, *word);
            }
            (None, _) if !parameter.is_required() => {}
            _ => return Err(refused(parameter.name, "it is needed")),
        }
    }
    law.made(&found).map_err(|error| refused(place, error))
}

/// Values by their names, in their order.
pub fn given(values: &Values) -> Vec<(&'static str, Given)> {
    let values = values.iter();
    values
        .map(|(name, value)| (name, Given::from(value)))
        .collect()
}

impl From<&Value> for Given {
    fn from(value: &Value) -> Self {
        match value {
            Value::Number(number) => Self::Number(*number),
            Value::Numbers(numbers) => Self::Numbers(numbers.clone()),
            Value::Word(word) => Self::Word((*word).to_owned()),
        }
    }
}

/// Declared laws by their kinds: `law`, the keys of dependences in decks, and `decay`.
#[pyfunction]
pub fn declared_laws() -> Vec<(&'static str, Vec<Law>)> {
    vec![
        ("law", listed(LAWS)),
        ("by_pressure", listed(BY_PRESSURE)),
        ("by_slip_rate", listed(BY_RATE)),
        ("by_accumulated_slip", listed(BY_SLIP)),
        ("by_state", listed(BY_STATE)),
        ("decay", listed(&[&DECAY])),
    ]
}

fn listed<L: Kind>(laws: &[&'static Declared<L>]) -> Vec<Law> {
    let law = |law: &&'static Declared<L>| {
        let parameters = law.parameters.iter().map(told).collect();
        (law.name, law.summary, law.fit.is_some(), parameters)
    };
    laws.iter().map(law).collect()
}

fn told(parameter: &Parameter) -> Told {
    let (form, words) = match parameter.form {
        Form::Number(_) => ("number", Vec::new()),
        Form::Numbers(_) => ("numbers", Vec::new()),
        Form::Word(words) => ("word", words.to_vec()),
    };
    let (value, text) = match parameter.absent {
        Absent::Refused | Absent::Nothing => (None, String::new()),
        Absent::Number(number) => (Some(Given::Number(number)), String::new()),
        Absent::Word(word) => (Some(Given::Word(word.to_owned())), String::new()),
        Absent::Computed(text, _) => (None, text.to_owned()),
    };
    let default = (!parameter.is_required(), value, text);
    let Parameter {
        name, unit, doc, ..
    } = *parameter;
    (name, form, words, unit, doc, default)
}
