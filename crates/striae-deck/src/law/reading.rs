//! Parameters of a law as read from a table.

use striae_declared::{ANY, Bound, Declared, Form, Kind, Parameter, Value, Values};

use super::compositions::{form, of_set};
use crate::{
    faults::{FaultList, Span},
    read::{self, Place, Read, TableReader, read_table_as, unexpected},
    value::{All, Number, number, numbers, tables, whole, word},
};
use striae_model::FaultKind as ModelFault;
use toml::de::DeValue;

/// A law by its name, with the values of its parameters but after faults.
#[derive(Clone, Debug)]
pub(crate) struct Stated<L: Kind> {
    law: &'static Declared<L>,
    values: Option<Values>,
    places: Vec<(&'static str, Span)>,
}

impl<L: Kind> Stated<L> {
    /// Reads the parameters of a law.
    pub(crate) fn read(law: &'static Declared<L>, reader: &mut TableReader<'_, '_, '_>) -> Self {
        let mut places = Vec::new();
        Self {
            law,
            values: values(law.parameters, reader, &mut places),
            places,
        }
    }

    /// Returns the law, or its refusal with the place of the value at fault, else that of the
    /// table; nothing where values could not be read.
    pub(crate) fn made(&self, table: &Span) -> Option<Result<L, (L::Refusal, Span)>> {
        let made = self.law.made(self.values.as_ref()?);
        Some(made.map_err(|refusal| {
            let name = L::refused(&refusal);
            let mut places = self.places.iter();
            let place = places.find(|(known, _)| Some(*known) == name);
            let place = place.map_or(table, |(_, place)| place).clone();
            (refusal, place)
        }))
    }
}

/// Returns the values of parameters and notes their places; nothing after a fault.
fn values(
    parameters: &[Parameter],
    reader: &mut TableReader<'_, '_, '_>,
    places: &mut Vec<(&'static str, Span)>,
) -> Option<Values> {
    // All are read, so that all faults are noted.
    let read: Vec<Option<Values>> = parameters
        .iter()
        .map(|parameter| value(parameter, reader, places))
        .collect();
    let read = read.into_iter().collect::<Option<Vec<_>>>()?;
    let none = Values::default();
    Some(read.into_iter().fold(none, Values::followed_by))
}

/// Returns the value of a parameter, or those of the set that is given; none where it is absent
/// and need not be given, nothing after a fault.
fn value(
    parameter: &Parameter,
    reader: &mut TableReader<'_, '_, '_>,
    places: &mut Vec<(&'static str, Span)>,
) -> Option<Values> {
    if let Form::OneOf(sets) = parameter.form {
        let set = match sets {
            [only] => only,
            _ => {
                let groups: Vec<_> = sets.iter().map(of_set).collect();
                &sets[reader.choose(&groups)?]
            }
        };
        return values(set.parameters, reader, places);
    }
    let read = |value: &read::Value<'_>, place: &Place, faults: &mut FaultList<'_>| {
        read_as(parameter.form, value, place, faults)
    };
    let given = reader.has(parameter.name);
    let found = match parameter.is_required() {
        true => reader.required_as(parameter.name, &form(parameter.form).expected(), read),
        false => reader.optional_as(parameter.name, read),
    };
    match found {
        Some(at) => {
            places.push((parameter.name, at.span));
            Some(Values::default().with(parameter.name, at.value))
        }
        None if given || parameter.is_required() => None,
        None => Some(Values::default()),
    }
}

fn read_as(
    of: Form,
    value: &read::Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
) -> Option<Value> {
    let table = |parameters: &'static [Parameter]| {
        move |reader: &mut TableReader<'_, '_, '_>| values(parameters, reader, &mut Vec::new())
    };
    Some(match of {
        Form::Number(bounds) => number(value, place, faults, bounds)?.into(),
        Form::Numbers(bounds) => numbers(value, place, faults, bounds)?.into(),
        Form::Several(..) | Form::Direction | Form::Whole(_) | Form::Counts(_) => {
            counted(of, value, place, faults)?
        }
        Form::Word(words) => {
            let names: Vec<&'static str> = words.iter().map(|(name, _)| *name).collect();
            names[word(value, place, faults, &names)?].into()
        }
        Form::Vectors => {
            let vectors = All::<[Number; 3]>::read(value, place, faults)?.0;
            let vectors = vectors
                .into_iter()
                .map(|vector| vector.map(|number| number.0));
            vectors.collect::<Vec<_>>().into()
        }
        Form::Pairs => {
            let pairs = All::<[Number; 2]>::read(value, place, faults)?
                .0
                .into_iter();
            let pairs = pairs.map(|pair| pair.map(|number| number.0));
            pairs.collect::<Vec<_>>().into()
        }
        Form::Table(set) => read_table_as(value, place, faults, table(set.parameters))?.into(),
        Form::Tables(set) => tables(value, place, faults, &form(of), table(set.parameters))?.into(),
        Form::OneOf(_) => return None,
    })
}

/// Returns a whole number, or as many numbers as stated.
fn counted(
    of: Form,
    value: &read::Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
) -> Option<Value> {
    let numbers = |count: usize, bounds: &'static [Bound], faults: &mut FaultList<'_>| {
        several(count, of, value, place, faults, |value, place, faults| {
            number(value, place, faults, bounds)
        })
    };
    Some(match of {
        Form::Several(count, bounds) => numbers(count, bounds, faults)?.into(),
        Form::Direction => {
            let direction = numbers(3, ANY, faults)?;
            if direction.iter().all(|component| *component == 0.0) {
                let place = place.to_string();
                faults.push(&value.span(), ModelFault::ZeroVector { place });
                return None;
            }
            direction.into()
        }
        Form::Whole(least) => whole(value, place, faults, least)?.into(),
        Form::Counts(count) => {
            let counts = several(count, of, value, place, faults, |value, place, faults| {
                whole(value, place, faults, 1)
            });
            counts?.as_slice().into()
        }
        _ => return None,
    })
}

/// Returns so many elements of a list; nothing after a fault of any.
fn several<T>(
    count: usize,
    of: Form,
    value: &read::Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    read: impl Fn(&read::Value<'_>, &Place, &mut FaultList<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    let array = match value.get_ref() {
        DeValue::Array(array) if array.len() == count => array,
        _ => return unexpected(value, place, faults, &form(of)),
    };
    let place = place.element();
    // All are read, so that all faults are noted.
    let all = array.iter().map(|value| read(value, &place, faults));
    all.collect::<Vec<_>>().into_iter().collect()
}
