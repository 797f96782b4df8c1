//! Plain values: texts, numbers within bounds, lists.
//!
//! Longer than other files, as it is the one list of plain values.

use super::{
    expression::is_expression,
    fault::FaultKind,
    faults::FaultList,
    form::Form,
    read::{At, Place, Read, TableReader, Value, described, read_table_as, unexpected},
};
use std::slice;
use striae_declared::{Bound, magnitude, shown};
use striae_mesh::Vec3;
use striae_model::nearest;
use toml::de::DeValue;

/// A name, or another text of one line that is not empty.
///
/// Tables of results have names in their first line, so that a line break would part it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Text(pub(crate) String);

impl Read for Text {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        let Prose(text) = Prose::read(value, place, faults)?;
        if text.contains(char::is_control) {
            let kind = FaultKind::Unexpected {
                place: place.to_string(),
                expected: "one line of printable characters".to_owned(),
                found: described(value.get_ref()),
            };
            faults.push(&value.span(), kind);
            return None;
        }
        Some(Self(text))
    }

    fn form() -> Form {
        Form::Text
    }
}

/// A text of any number of lines that is not empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Prose(pub(crate) String);

impl Read for Prose {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::String(text) if !text.trim().is_empty() => Some(Self(text.to_string())),
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        Form::Text
    }
}

/// `true` or `false`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Truth(pub(crate) bool);

impl Read for Truth {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::Boolean(truth) => Some(Self(*truth)),
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        Form::Truth
    }
}

macro_rules! number {
    ($(#[doc = $doc:literal] $name:ident [$($bound:expr),*])+) => { $(
        #[doc = $doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) struct $name(pub(crate) f64);

        impl $name {
            const BOUNDS: &'static [Bound] = &[$($bound),*];
        }

        impl Read for $name {
            fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
                number(value, place, faults, Self::BOUNDS).map(Self)
            }

            fn form() -> Form {
                Form::Number(Self::BOUNDS)
            }
        }
    )+ };
}

number! {
    /// Any finite number.
    Number []
    /// A number greater than zero.
    Positive [Bound::Above(0.0)]
    /// A number of at least zero.
    NonNegative [Bound::AtLeast(0.0)]
    /// A part of a whole, which may be nothing.
    Portion [Bound::AtLeast(0.0), Bound::AtMost(1.0)]
    /// A part of a whole.
    Fraction [Bound::Above(0.0), Bound::AtMost(1.0)]
    /// An angle in degrees up to that of a half turn.
    HalfTurn [Bound::AtLeast(0.0), Bound::AtMost(180.0)]
    /// An angle in degrees above zero, up to that of a half turn.
    Angle [Bound::Above(0.0), Bound::AtMost(180.0)]
}

/// A number, or the text of a function of position and time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Varying {
    Number(f64),
    Function(String),
}

impl Read for Varying {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::String(text) if !text.trim().is_empty() && !is_expression(text) => {
                Some(Self::Function(text.to_string()))
            }
            found => match finite(found) {
                Some(_) => number(value, place, faults, &[]).map(Self::Number),
                None => unexpected(value, place, faults, &Self::form()),
            },
        }
    }

    fn form() -> Form {
        Form::Varying
    }
}

/// A whole number of at least `LEAST`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Whole<const LEAST: usize>(pub(crate) usize);

/// A number of things of which there is at least one.
pub(crate) type Count = Whole<1>;

impl<const LEAST: usize> Read for Whole<LEAST> {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        whole(value, place, faults, LEAST).map(Self)
    }

    fn form() -> Form {
        Form::Whole(LEAST)
    }
}

impl<T: Read, const N: usize> Read for [T; N] {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        let list: Vec<At<T>> = match value.get_ref() {
            DeValue::Array(array) if array.len() == N => elements(array, place, faults),
            _ => return unexpected(value, place, faults, &Self::form()),
        };
        let list: Vec<T> = list.into_iter().map(|element| element.value).collect();
        list.try_into().ok()
    }

    fn form() -> Form {
        Form::List(Box::new(T::form()), Some(N))
    }
}

/// A list that is of no use if one of its elements cannot be read.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct All<T>(pub(crate) Vec<T>);

impl<T: Read> Read for All<T> {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        let DeValue::Array(array) = value.get_ref() else {
            return unexpected(value, place, faults, &Self::form());
        };
        let list: Vec<At<T>> = elements(array, place, faults);
        let all = list.len() == array.len();
        all.then(|| Self(list.into_iter().map(|element| element.value).collect()))
    }

    fn form() -> Form {
        Form::List(Box::new(T::form()), None)
    }
}

impl<T: Read> Read for Vec<At<T>> {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::Array(array) => Some(elements(array, place, faults)),
            // The table is read all the same, as if it were the only one of the list.
            DeValue::Table(_) if matches!(T::form(), Form::Table(_)) => {
                unexpected::<Self>(value, place, faults, &Self::form());
                Some(elements(slice::from_ref(value), place, faults))
            }
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        Form::List(Box::new(T::form()), None)
    }
}

/// Numbers by names of the author.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NamedNumbers(pub(crate) Vec<(String, f64)>);

impl Read for NamedNumbers {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        let DeValue::Table(table) = value.get_ref() else {
            return unexpected(value, place, faults, &Self::form());
        };
        let mut numbers = Vec::new();
        for (name, value) in table.iter() {
            let letters = || name.get_ref().chars();
            let is_name = letters().all(|c| c.is_alphanumeric() || c == '_')
                && letters().next().is_some_and(|c| !c.is_numeric());
            if !is_name || name.get_ref() == "pi" {
                let name_is = name.get_ref().to_string();
                faults.push(&name.span(), FaultKind::ParameterName { name: name_is });
            }
            match finite(value.get_ref()) {
                Some(number) => numbers.push((name.get_ref().to_string(), number)),
                // An expression without a value is a fault already.
                None if faults.within(&value.span()) => {}
                None => {
                    let kind = FaultKind::Unexpected {
                        place: format!("parameter `{}`", name.get_ref()),
                        expected: "a number or an expression such as \"= 2*E\"".to_owned(),
                        found: described(value.get_ref()),
                    };
                    faults.push(&value.span(), kind);
                }
            }
        }
        Some(Self(numbers))
    }

    fn form() -> Form {
        Form::NamedNumbers
    }
}

/// A text or a list of texts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OneOrMore(pub(crate) Vec<Text>);

impl Read for OneOrMore {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::Array(_) => All::read(value, place, faults).map(|all| Self(all.0)),
            DeValue::String(text) if !text.trim().is_empty() => {
                Some(Self(vec![Text(text.to_string())]))
            }
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        Form::Any(vec![Text::form(), All::<Text>::form()])
    }
}

/// A whole number of at least a least one.
pub(crate) fn whole(
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    least: usize,
) -> Option<usize> {
    let found = match value.get_ref() {
        DeValue::Integer(integer) => usize::from_str_radix(integer.as_str(), integer.radix()).ok(),
        _ => None,
    };
    match found {
        Some(number) if number >= least => Some(number),
        _ => unexpected(value, place, faults, &Form::Whole(least)),
    }
}

/// A number within bounds.
pub(crate) fn number(
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    bounds: &'static [Bound],
) -> Option<f64> {
    match finite(value.get_ref()) {
        Some(number) if bounds.iter().all(|bound| bound.admits(number)) => {
            within_reach(number, value, place, faults, bounds)
        }
        _ => unexpected(value, place, faults, &Form::Number(bounds)),
    }
}

/// A number, unless its magnitude is one that cannot be computed with.
fn within_reach(
    number: f64,
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    bounds: &[Bound],
) -> Option<f64> {
    let Some(needed) = magnitude::needed(bounds, number) else {
        return Some(number);
    };
    let kind = FaultKind::Unexpected {
        place: place.to_string(),
        expected: needed.to_owned(),
        found: format!("{}; {}", shown(number), magnitude::ADVICE),
    };
    faults.push(&value.span(), kind);
    None
}

/// A list of numbers within bounds.
pub(crate) fn numbers(
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    bounds: &'static [Bound],
) -> Option<Vec<f64>> {
    let DeValue::Array(array) = value.get_ref() else {
        let form = Form::List(Box::new(Form::Number(bounds)), None);
        return unexpected(value, place, faults, &form);
    };
    let place = place.element();
    // All are read, so that all faults are noted.
    let all = array
        .iter()
        .map(|value| number(value, &place, faults, bounds));
    all.collect::<Vec<_>>().into_iter().collect()
}

/// The tables of a list, by a function that takes the keys of one.
pub(crate) fn tables<T>(
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    form: &Form,
    read: impl Fn(&mut TableReader<'_, '_, '_>) -> Option<T>,
) -> Option<Vec<T>> {
    let listed = match value.get_ref() {
        DeValue::Array(array) => &array[..],
        // The table is read all the same, as if it were the only one of the list.
        DeValue::Table(_) => {
            unexpected::<()>(value, place, faults, form);
            slice::from_ref(value)
        }
        _ => return unexpected(value, place, faults, form),
    };
    let place = place.element();
    // All are read, so that all faults are noted.
    let all = listed
        .iter()
        .map(|value| read_table_as(value, &place, faults, &read));
    all.collect::<Vec<_>>().into_iter().collect()
}

/// A vector from its three components.
pub(crate) fn vector(components: &[Number; 3]) -> Vec3 {
    Vec3::new(components[0].0, components[1].0, components[2].0)
}

/// Position of the text in the list of words allowed.
pub(crate) fn word(
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    allowed: &[&'static str],
) -> Option<usize> {
    let DeValue::String(found) = value.get_ref() else {
        let form = Form::Words(allowed.iter().map(|word| (*word, "")).collect());
        return unexpected(value, place, faults, &form);
    };
    let position = allowed.iter().position(|word| word == found);
    if position.is_none() {
        let kind = FaultKind::UnknownWord {
            place: place.to_string(),
            found: found.to_string(),
            allowed: allowed.iter().map(|word| (*word).into()).collect(),
            nearest: nearest(found, allowed.iter().copied()),
        };
        faults.push(&value.span(), kind);
    }
    position
}

fn elements<T: Read>(array: &[Value<'_>], place: &Place, faults: &mut FaultList<'_>) -> Vec<At<T>> {
    let place = place.element();
    array
        .iter()
        .filter_map(|value| {
            Some(At {
                span: value.span(),
                value: T::read(value, &place, faults)?,
            })
        })
        .collect()
}

/// The number that a value is, if it is a finite one.
pub(crate) fn finite(value: &DeValue<'_>) -> Option<f64> {
    let number = match value {
        DeValue::Integer(integer) => {
            i128::from_str_radix(integer.as_str(), integer.radix()).ok()? as f64
        }
        DeValue::Float(float) => float.as_str().parse().ok()?,
        _ => return None,
    };
    number.is_finite().then_some(number)
}
