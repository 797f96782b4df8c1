//! Keys of the parameters of laws, for the reader, the schema and the reference.

use striae_declared::{self as declared, Declared, Kind, Parameter, Set};

use super::Named;
use crate::{
    Laws,
    form::{Alternative, Form, Key, Need},
    read::combined,
};

/// Returns the compositions of each law, with the key of its name first, if it has one.
pub(super) fn of_each<L: Named>(laws: &Laws) -> Vec<Alternative> {
    let composed = |law: &&'static Declared<L>| {
        let mut all = of_law(law);
        if let Some(tag) = L::TAG {
            let name = key(tag, L::DOC, Form::Words(vec![(law.name, "")]));
            all.iter_mut()
                .for_each(|one| one.keys.insert(0, name.clone()));
        }
        all
    };
    L::declared(laws).iter().flat_map(composed).collect()
}

/// Returns the compositions of a law, with its description.
pub(super) fn of_law<L: Kind>(law: &Declared<L>) -> Vec<Alternative> {
    let described = |mut one: Alternative| {
        one.doc = spaced(law.summary, &one.doc);
        one
    };
    compositions(law.parameters)
        .into_iter()
        .map(described)
        .collect()
}

/// Returns a key that is required.
pub(super) fn key(name: &'static str, doc: &str, form: Form) -> Key {
    Key {
        name,
        doc: doc.to_owned(),
        need: Need::Required,
        form,
    }
}

/// Returns the compositions of the keys of parameters, with the descriptions of the sets in them.
pub(super) fn compositions(parameters: &[Parameter]) -> Vec<Alternative> {
    let none = vec![Alternative::new(&[])];
    parameters.iter().fold(none, |all, parameter| {
        combined(&all, &of_parameter(parameter))
    })
}

fn of_parameter(parameter: &Parameter) -> Vec<Alternative> {
    if let declared::Form::OneOf(sets) = parameter.form {
        return sets.iter().flat_map(of_set).collect();
    }
    let need = match parameter.is_required() {
        true => Need::Required,
        false => Need::Optional,
    };
    let key = Key {
        name: parameter.name,
        doc: parameter.told(),
        need,
        form: form(parameter.form),
    };
    vec![Alternative {
        doc: String::new(),
        keys: vec![key],
    }]
}

/// Returns the compositions of a set.
pub(super) fn of_set(set: &Set) -> Vec<Alternative> {
    let described = |mut one: Alternative| {
        one.doc = spaced(set.doc, &one.doc);
        one
    };
    compositions(set.parameters)
        .into_iter()
        .map(described)
        .collect()
}

fn spaced(one: &str, other: &str) -> String {
    format!("{one} {other}").trim().to_owned()
}

/// Returns the form of a value in decks.
pub(super) fn form(of: declared::Form) -> Form {
    let list = |of| Form::List(Box::new(of), None);
    let several = |of, count| Form::List(Box::new(of), Some(count));
    match of {
        declared::Form::Number(bounds) => Form::Number(bounds),
        declared::Form::Numbers(bounds) => list(Form::Number(bounds)),
        declared::Form::Several(count, bounds) => several(Form::Number(bounds), count),
        declared::Form::Direction => several(Form::Number(declared::ANY), 3),
        declared::Form::Whole(least) => Form::Whole(least),
        declared::Form::Counts(count) => several(Form::Whole(1), count),
        declared::Form::Word(words) => Form::Words(words.to_vec()),
        declared::Form::Vectors => list(several(Form::Number(declared::ANY), 3)),
        declared::Form::Pairs => list(several(Form::Number(declared::ANY), 2)),
        declared::Form::Table(set) => Form::Table(of_set(set)),
        declared::Form::Tables(set) => list(Form::Table(of_set(set))),
        declared::Form::OneOf(sets) => Form::Table(sets.iter().flat_map(of_set).collect()),
    }
}
