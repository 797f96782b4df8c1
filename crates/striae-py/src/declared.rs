//! Declared laws, textures and generators: made of values by their names, and listed for the classes and
//! functions of the package, which `declared.py` writes.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use striae::declared::{
    self, ANY, Absent, Bound, Declared, Form, Kind, POSITIVE, Set, Value, Values, magnitude, named,
    shown,
};
use striae::law::{
    bulk,
    friction::{BY_PRESSURE, BY_RATE, BY_SLIP, BY_STATE, DECAY, LAWS},
};
use striae::mesh::generate::GENERATORS;
use striae::surface::texture::TEXTURES;

use crate::fault::refused;

/// A value of a parameter.
#[derive(Clone, FromPyObject, IntoPyObject)]
pub enum Given {
    /// A whole number.
    Whole(usize),
    /// A number.
    Number(f64),
    /// A list of numbers, or the values of a table in the order of its parameters.
    Numbers(Vec<f64>),
    /// A word.
    Word(String),
    /// Several of them.
    Rows(Vec<Vec<f64>>),
    /// The values of a table by its keys.
    Table(BTreeMap<String, Given>),
    /// A list of whole numbers, which comes back as one of numbers.
    Counts(Vec<usize>),
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
    /// Count of numbers, where it is fixed.
    count: usize,
    /// Bounds of numbers, each with what a number must be.
    bounds: Vec<(&'static str, f64)>,
    /// Unit.
    unit: &'static str,
    /// Description.
    doc: &'static str,
    /// Necessity.
    is_required: bool,
    /// Necessity in decks.
    is_required_in_decks: bool,
    /// Default, if it is a value.
    value: Option<Given>,
    /// Description of another default, in which code is in ticks.
    default: String,
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
    if let Some((name, number, needed)) = magnitude::beyond(law.parameters, &found) {
        return Err(refused(name, of_magnitude(number, needed)));
    }
    law.made(&found).map_err(|error| refused(place, error))
}

/// The reason to refuse a number for its magnitude, if there is one; zero is refused elsewhere.
#[pyfunction]
pub fn beyond(number: f64, is_positive: bool) -> Option<String> {
    let bounds = if is_positive { POSITIVE } else { ANY };
    magnitude::needed(bounds, number).map(|needed| of_magnitude(number, needed))
}

fn of_magnitude(number: f64, needed: &str) -> String {
    let (found, advice) = (shown(number), magnitude::ADVICE);
    format!("it must be {needed}, but is {found}; {advice}")
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
            None if !parameter.is_required_in_programs() => {}
            None => return Err(refused(name, "it is needed")),
        }
    }
    Ok(all)
}

fn value(form: Form, given: &Given, name: &str) -> PyResult<Value> {
    if let (Form::Table(set), Given::Table(given)) = (form, given) {
        return stated_table(set, given, name).map(Value::Table);
    }
    let made: Option<Value> = match (form, given) {
        (Form::Number(_), Given::Number(number)) => Some((*number).into()),
        (Form::Whole(_), Given::Whole(number)) => Some((*number).into()),
        (Form::Several(count, _), Given::Numbers(numbers)) => {
            (numbers.len() == count).then(|| numbers.clone().into())
        }
        (Form::Direction, Given::Numbers(numbers)) => {
            (numbers.len() == 3).then(|| numbers.clone().into())
        }
        (Form::Counts(count), Given::Numbers(numbers)) => {
            let whole = numbers.iter().map(|number| *number as usize);
            (numbers.len() == count).then(|| Value::Counts(whole.collect()))
        }
        (Form::Numbers(_), Given::Numbers(numbers)) => Some(numbers.clone().into()),
        (Form::Word(words), Given::Word(word)) => {
            let word = words.iter().find(|(known, _)| known == word);
            word.map(|(word, _)| (*word).into())
        }
        (Form::Table(set), Given::Numbers(numbers)) => row(set, numbers).map(Value::Table),
        // A list without elements is read as one of numbers.
        (Form::Pairs, Given::Numbers(none)) if none.is_empty() => Some(Value::Pairs(Vec::new())),
        (Form::Tables(_), Given::Numbers(none)) if none.is_empty() => {
            Some(Value::Tables(Vec::new()))
        }
        (Form::Vectors, Given::Rows(rows)) => {
            let vectors = rows.iter().map(|row| row.as_slice().try_into().ok());
            vectors.collect::<Option<_>>().map(Value::Vectors)
        }
        (Form::Pairs, Given::Rows(rows)) => {
            let pairs = rows.iter().map(|row| row.as_slice().try_into().ok());
            pairs.collect::<Option<_>>().map(Value::Pairs)
        }
        (Form::Tables(set), Given::Rows(rows)) => {
            let all = rows.iter().map(|numbers| row(set, numbers));
            all.collect::<Option<_>>().map(Value::Tables)
        }
        _ => None,
    };
    made.ok_or_else(|| refused(name, "it has another form than the parameter"))
}

/// The values of a table, one after the other in the order of its parameters.
fn row(set: &Set, numbers: &[f64]) -> Option<Values> {
    let mut left = numbers;
    let mut values = Values::default();
    for parameter in set.parameters {
        let count = match parameter.form {
            Form::Several(count, _) => count,
            Form::Direction => 3,
            _ => 1,
        };
        let (own, others) = left.split_at_checked(count)?;
        left = others;
        values = match parameter.form {
            Form::Several(..) | Form::Direction => values.with(parameter.name, own),
            _ => values.with(parameter.name, own[0]),
        };
    }
    left.is_empty().then_some(values)
}

/// The values of a table by its keys.
fn stated_table(set: &Set, given: &BTreeMap<String, Given>, name: &str) -> PyResult<Values> {
    let known = keys(set.parameters);
    if let Some(unknown) = given.keys().find(|key| !known.contains(&key.as_str())) {
        let known = known.join("`, `");
        let told = format!("its keys are `{known}`, but there is `{unknown}`");
        return Err(refused(name, told));
    }
    let given = given
        .iter()
        .map(|(key, value)| (key.clone(), value.clone()));
    found(set.parameters, name, &given.collect::<Vec<_>>())
}

fn keys(parameters: &[declared::Parameter]) -> Vec<&'static str> {
    let each = parameters
        .iter()
        .flat_map(|parameter| match parameter.form {
            Form::OneOf(sets) => sets.iter().flat_map(|set| keys(set.parameters)).collect(),
            _ => vec![parameter.name],
        });
    each.collect()
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
            let numbers = values.iter().flat_map(|(_, value)| match value {
                Value::Number(number) => vec![*number],
                Value::Numbers(numbers) => numbers.clone(),
                _ => Vec::new(),
            });
            numbers.collect::<Vec<_>>()
        };
        match value {
            Value::Number(number) => Self::Number(*number),
            Value::Whole(number) => Self::Whole(*number),
            Value::Counts(counts) => Self::Counts(counts.clone()),
            Value::Numbers(numbers) => Self::Numbers(numbers.clone()),
            Value::Word(word) => Self::Word((*word).to_owned()),
            Value::Pairs(pairs) => Self::Rows(pairs.iter().map(|pair| pair.to_vec()).collect()),
            Value::Vectors(vectors) => {
                Self::Rows(vectors.iter().map(|vector| vector.to_vec()).collect())
            }
            Value::Table(values) => Self::Numbers(row(values)),
            Value::Tables(all) => Self::Rows(all.iter().map(row).collect()),
        }
    }
}

/// All that is declared, by its kind: `generator`, `texture`, `material`, `law` of friction, the keys of
/// dependences in decks, and `decay`.
#[pyfunction]
pub fn declarations() -> Vec<(&'static str, Vec<Law>)> {
    vec![
        ("generator", listed(GENERATORS)),
        ("texture", listed(TEXTURES)),
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
        Form::Several(..) => ("several", Vec::new(), Vec::new()),
        Form::Direction => ("direction", Vec::new(), Vec::new()),
        Form::Vectors => ("vectors", Vec::new(), Vec::new()),
        Form::Whole(_) => ("whole", Vec::new(), Vec::new()),
        Form::Counts(_) => ("counts", Vec::new(), Vec::new()),
        Form::Pairs => ("pairs", Vec::new(), Vec::new()),
        Form::Table(set) => ("table", Vec::new(), vec![of_set(set)]),
        Form::Tables(set) => ("tables", Vec::new(), vec![of_set(set)]),
        Form::OneOf(sets) => ("one_of", Vec::new(), sets.iter().map(of_set).collect()),
    };
    let (value, default) = default_of(parameter.absent);
    let (count, bounds) = match parameter.form {
        Form::Number(bounds) | Form::Numbers(bounds) => (0, bounds),
        Form::Several(count, bounds) => (count, bounds),
        Form::Direction => (3, ANY),
        Form::Counts(count) => (count, ANY),
        _ => (0, ANY),
    };
    let bounds = bounds.iter().map(|bound| match *bound {
        Bound::Above(limit) => ("greater than", limit),
        Bound::AtLeast(limit) => ("at least", limit),
        Bound::Below(limit) => ("less than", limit),
        Bound::AtMost(limit) => ("at most", limit),
    });
    let bounds = match parameter.form {
        Form::Whole(least) => vec![("at least", least as f64)],
        _ => bounds.collect(),
    };
    let declared::Parameter {
        name, unit, doc, ..
    } = *parameter;
    Parameter {
        name,
        form,
        words,
        count,
        bounds,
        unit,
        doc,
        is_required: parameter.is_required_in_programs(),
        is_required_in_decks: parameter.is_required(),
        value,
        default,
        sets,
    }
}

/// The default as a value, else in words.
fn default_of(absent: Absent) -> (Option<Given>, String) {
    let value = match absent {
        Absent::Number(number) => Given::Number(number),
        Absent::Numbers(numbers) => Given::Numbers(numbers.to_vec()),
        Absent::Whole(number) => Given::Whole(number),
        Absent::Counts(counts) => Given::Counts(counts.to_vec()),
        Absent::Word(word) => Given::Word(word.to_owned()),
        Absent::InPrograms(absent) => return default_of(*absent),
        Absent::Refused | Absent::Nothing => return (None, String::new()),
        Absent::Computed(..) | Absent::Otherwise(_) => {
            return (None, absent.told().unwrap_or_default());
        }
    };
    (Some(value), String::new())
}
