//! Declared laws: made of values by their names, and listed for the classes of the package,
//! which `declared.py` writes.

use pyo3::prelude::*;
use striae::declared::{self, Absent, Bound, Declared, Form, Kind, Set, Value, Values, named};
use striae::law::{
    bulk,
    friction::{BY_PRESSURE, BY_RATE, BY_SLIP, BY_STATE, DECAY, LAWS},
};

use crate::fault::refused;

/// A value of a parameter.
#[derive(Clone, FromPyObject, IntoPyObject)]
pub enum Given {
    /// A number.
    Number(f64),
    /// A list of numbers, or the values of a table in the order of its parameters.
    Numbers(Vec<f64>),
    /// A word.
    Word(String),
    /// Several of them.
    Rows(Vec<Vec<f64>>),
}

/// A parameter of a declared law.
#[pyclass(frozen, get_all, module = "striae._striae")]
#[derive(Clone)]
pub struct Parameter {
    /// Name in decks.
    name: &'static str,
    /// Name of the form.
    form: &'static str,
    /// Words with their descriptions.
    words: Vec<(&'static str, &'static str)>,
    /// Bounds of numbers, each with what a number must be.
    bounds: Vec<(&'static str, f64)>,
    /// Unit.
    unit: &'static str,
    /// Description.
    doc: &'static str,
    /// Necessity.
    is_required: bool,
    /// Default, if it is a number or a word.
    value: Option<Given>,
    /// Description of another default.
    default: &'static str,
    /// Sets of further parameters with their descriptions.
    sets: Vec<(&'static str, Vec<Parameter>)>,
}

/// Name, description, whether measurements give its constants, and parameters.
type Law = (&'static str, &'static str, bool, Vec<Parameter>);

/// Makes the law of a list that has a name; `place` is what faults call it.
pub fn made<L: Kind>(
    laws: &[&'static Declared<L>],
    name: &str,
    place: &str,
    values: &[(String, Given)],
) -> PyResult<L> {
    let law = named(laws, name).ok_or_else(|| refused(place, "there is no such law"))?;
    let found = found(law.parameters, place, values)?;
    law.made(&found).map_err(|error| refused(place, error))
}

fn found(
    parameters: &[declared::Parameter],
    place: &str,
    values: &[(String, Given)],
) -> PyResult<Values> {
    let given = |wanted: &str| values.iter().find(|(name, _)| name == wanted);
    let mut all = Values::default();
    for parameter in parameters {
        let name = parameter.name;
        if let Form::OneOf(sets) = parameter.form {
            let set = Set::chosen(sets, |name| given(name).is_some());
            let set = set.map_err(|choice| refused(place, choice))?;
            all = all.followed_by(found(set.parameters, place, values)?);
            continue;
        }
        match given(name) {
            Some((_, given)) => all = all.with(name, value(parameter.form, given, name)?),
            None if !parameter.is_required() => {}
            None => return Err(refused(name, "it is needed")),
        }
    }
    Ok(all)
}

fn value(form: Form, given: &Given, name: &str) -> PyResult<Value> {
    let table = |set: &Set, row: &[f64]| {
        let names = set.parameters.iter().map(|parameter| parameter.name);
        let values = names.zip(row).map(|(name, value)| (name, (*value).into()));
        let fits = row.len() == set.parameters.len();
        fits.then(|| values.collect::<Values>())
    };
    let made: Option<Value> = match (form, given) {
        (Form::Number(_), Given::Number(number)) => Some((*number).into()),
        (Form::Numbers(_), Given::Numbers(numbers)) => Some(numbers.clone().into()),
        (Form::Word(words), Given::Word(word)) => {
            let word = words.iter().find(|(known, _)| known == word);
            word.map(|(word, _)| (*word).into())
        }
        (Form::Table(set), Given::Numbers(row)) => table(set, row).map(Value::Table),
        // A list without elements is read as one of numbers.
        (Form::Pairs, Given::Numbers(none)) if none.is_empty() => Some(Value::Pairs(Vec::new())),
        (Form::Tables(_), Given::Numbers(none)) if none.is_empty() => {
            Some(Value::Tables(Vec::new()))
        }
        (Form::Pairs, Given::Rows(rows)) => {
            let pairs = rows.iter().map(|row| row.as_slice().try_into().ok());
            pairs.collect::<Option<_>>().map(Value::Pairs)
        }
        (Form::Tables(set), Given::Rows(rows)) => {
            let all = rows.iter().map(|row| table(set, row));
            all.collect::<Option<_>>().map(Value::Tables)
        }
        _ => None,
    };
    made.ok_or_else(|| refused(name, "it has another form than the parameter of the law"))
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
        let row = |values: &Values| {
            let numbers = values.iter().filter_map(|(_, value)| match value {
                Value::Number(number) => Some(*number),
                _ => None,
            });
            numbers.collect::<Vec<_>>()
        };
        match value {
            Value::Number(number) => Self::Number(*number),
            Value::Numbers(numbers) => Self::Numbers(numbers.clone()),
            Value::Word(word) => Self::Word((*word).to_owned()),
            Value::Pairs(pairs) => Self::Rows(pairs.iter().map(|pair| pair.to_vec()).collect()),
            Value::Table(values) => Self::Numbers(row(values)),
            Value::Tables(all) => Self::Rows(all.iter().map(row).collect()),
        }
    }
}

/// Declared laws by their kinds: `material`, `law` of friction, the keys of dependences in decks,
/// and `decay`.
#[pyfunction]
pub fn declared_laws() -> Vec<(&'static str, Vec<Law>)> {
    vec![
        ("material", listed(bulk::LAWS)),
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

fn told(parameter: &declared::Parameter) -> Parameter {
    let of_set = |set: &Set| (set.doc, set.parameters.iter().map(told).collect());
    let (form, words, sets) = match parameter.form {
        Form::Number(_) => ("number", Vec::new(), Vec::new()),
        Form::Numbers(_) => ("numbers", Vec::new(), Vec::new()),
        Form::Word(words) => ("word", words.to_vec(), Vec::new()),
        Form::Pairs => ("pairs", Vec::new(), Vec::new()),
        Form::Table(set) => ("table", Vec::new(), vec![of_set(set)]),
        Form::Tables(set) => ("tables", Vec::new(), vec![of_set(set)]),
        Form::OneOf(sets) => ("one_of", Vec::new(), sets.iter().map(of_set).collect()),
    };
    let (value, default) = match parameter.absent {
        Absent::Refused | Absent::Nothing => (None, ""),
        Absent::Number(number) => (Some(Given::Number(number)), ""),
        Absent::Word(word) => (Some(Given::Word(word.to_owned())), ""),
        Absent::Computed(text, _) => (None, text),
    };
    let bounds = match parameter.form {
        Form::Number(bounds) | Form::Numbers(bounds) => bounds,
        _ => &[],
    };
    let bounds = bounds.iter().map(|bound| match *bound {
        Bound::Above(limit) => ("greater than", limit),
        Bound::AtLeast(limit) => ("at least", limit),
        Bound::Below(limit) => ("less than", limit),
        Bound::AtMost(limit) => ("at most", limit),
    });
    let declared::Parameter {
        name, unit, doc, ..
    } = *parameter;
    Parameter {
        name,
        form,
        words,
        bounds: bounds.collect(),
        unit,
        doc,
        is_required: parameter.is_required(),
        value,
        default,
        sets,
    }
}
