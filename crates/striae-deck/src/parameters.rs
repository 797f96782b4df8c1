//! Numbers with names, `[parameters]`, and the texts `"= 2*E"` that are computed from them.
//!
//! Expressions are replaced by their values before the tables are read, so that any number
//! of a deck may be one.

use std::collections::BTreeMap;

use striae_declared::shown;
use striae_model::nearest;
use toml::de::{DeTable, DeValue};

use crate::{
    expression::{evaluated, is_expression},
    fault::FaultKind,
    faults::{FaultList, Span},
    settings::{Setting, TABLE, placed},
    value::finite,
};

/// Whole numbers up to which a value without fraction is one.
const LARGEST_WHOLE: f64 = 9e15;
/// Difference from a whole number, over it, that is round-off of an expression: `0.3/0.1`.
const ROUND_OFF: f64 = 1e-13;
/// Parameters that are computed over one another.
const LONGEST: usize = 50;

/// Kind of value given for a parameter.
enum Given {
    Value(f64),
    Expression(String),
    /// As something else, which is a fault of its own.
    Nothing,
}

/// Values of the expressions of a deck and of what is set, by their places, as TOML writes them.
pub(crate) fn computed(
    tree: &DeTable<'_>,
    settings: &[Setting],
    faults: &mut FaultList<'_>,
) -> Vec<(Span, String)> {
    let mut parameters = Parameters::of(tree, settings, faults);
    let set = placed(tree, settings, faults).into_iter();
    let mut found: Vec<(Span, String)> = set.map(|(span, value)| (span, written(value))).collect();
    for (key, value) in tree.iter() {
        if key.get_ref() != TABLE {
            compute(value, &mut parameters, &mut found, faults);
        }
    }
    let is_set = |name: &str| {
        let mut settings = settings.iter();
        settings.any(|setting| setting.parameter() == Some(name))
    };
    let given = parameters.given.iter();
    let given: Vec<(String, Span)> = given
        .filter(|(name, (_, given))| matches!(given, Given::Expression(_)) || is_set(name))
        .map(|(name, (span, _))| (name.clone(), span.clone()))
        .collect();
    for (name, span) in given {
        match parameters.value(&name) {
            Ok(value) => found.push((span, written(value))),
            Err(cause) => note(&span, cause, faults),
        }
    }
    found
}

/// Puts values in the places of expressions.
pub(crate) fn replace<'i>(tree: &mut DeTable<'i>, values: &'i [(Span, String)]) {
    for (_, value) in tree.iter_mut() {
        replace_value(value, values);
    }
}

fn replace_value<'i>(value: &mut toml::Spanned<DeValue<'i>>, values: &'i [(Span, String)]) {
    let span = value.span();
    match value.get_mut() {
        // Numbers too, as a parameter that is a number may have been set.
        DeValue::String(_) | DeValue::Integer(_) | DeValue::Float(_) => {
            let computed = values.iter().find(|(place, _)| *place == span);
            let parsed = computed.and_then(|(_, text)| DeValue::parse(text).ok());
            if let Some(parsed) = parsed {
                *value.get_mut() = parsed.into_inner();
            }
        }
        DeValue::Array(list) => list
            .iter_mut()
            .for_each(|value| replace_value(value, values)),
        DeValue::Table(table) => replace(table, values),
        _ => {}
    }
}

fn compute(
    value: &toml::Spanned<DeValue<'_>>,
    parameters: &mut Parameters,
    found: &mut Vec<(Span, String)>,
    faults: &mut FaultList<'_>,
) {
    match value.get_ref() {
        // What an expression comes to does not matter where another number is set.
        DeValue::String(_) if found.iter().any(|(place, _)| *place == value.span()) => {}
        DeValue::String(text) if is_expression(text) => {
            parameters.blamed = false;
            match parameters.expression(text) {
                Ok(number) => found.push((value.span(), written(number))),
                Err(_) if parameters.blamed => faults.excuse(value.span()),
                Err(cause) => note(&value.span(), cause, faults),
            }
        }
        DeValue::Array(list) => {
            for value in list.iter() {
                compute(value, parameters, found, faults);
            }
        }
        DeValue::Table(table) => {
            for (_, value) in table.iter() {
                compute(value, parameters, found, faults);
            }
        }
        _ => {}
    }
}

fn note(span: &Span, cause: String, faults: &mut FaultList<'_>) {
    faults.push(span, FaultKind::Expression { cause });
}

/// A number as TOML writes it: whole ones as such, since they may count something.
fn written(value: f64) -> String {
    let whole = value.round();
    let is_whole = (value - whole).abs() <= ROUND_OFF * whole.abs();
    match is_whole && whole.abs() < LARGEST_WHOLE {
        true => format!("{}", whole as i64),
        false => shown(value),
    }
}

/// The parameters of a deck.
struct Parameters {
    given: BTreeMap<String, (Span, Given)>,
    /// Values so far, so that each is computed once.
    known: BTreeMap<String, Result<f64, String>>,
    /// Parameters that are being computed, each needed by the one before.
    over: Vec<String>,
    /// A parameter without a value has been needed, which is a fault of its own.
    blamed: bool,
}

impl Parameters {
    fn of(tree: &DeTable<'_>, settings: &[Setting], faults: &mut FaultList<'_>) -> Self {
        let mut given = BTreeMap::new();
        let table = tree.get(TABLE);
        let place = table.map_or(0..0, toml::Spanned::span);
        if let Some(DeValue::Table(table)) = table.map(toml::Spanned::get_ref) {
            for (name, value) in table.iter() {
                let of = match value.get_ref() {
                    DeValue::String(text) if is_expression(text) => {
                        Given::Expression(text.to_string())
                    }
                    number => finite(number).map_or(Given::Nothing, Given::Value),
                };
                given.insert(name.get_ref().to_string(), (value.span(), of));
            }
        }
        for setting in settings {
            let Some(name) = setting.parameter() else {
                continue;
            };
            match given.get_mut(name) {
                Some((_, given)) => *given = Given::Value(setting.value()),
                None => {
                    let kind = FaultKind::UnknownParameter {
                        name: name.to_owned(),
                        known: given.keys().cloned().collect(),
                    };
                    faults.push(&place, kind);
                }
            }
        }
        Self {
            given,
            known: BTreeMap::new(),
            over: Vec::new(),
            blamed: false,
        }
    }

    fn value(&mut self, name: &str) -> Result<f64, String> {
        let value = self.found(name);
        self.blamed |= value.is_err() && self.given.contains_key(name);
        value
    }

    fn found(&mut self, name: &str) -> Result<f64, String> {
        if let Some(known) = self.known.get(name) {
            return known.clone();
        }
        let Some((_, given)) = self.given.get(name) else {
            return Err(self.unknown(name));
        };
        if let Some(first) = self.over.iter().position(|known| known == name) {
            return Err(circular(name, &self.over[first + 1..]));
        }
        if self.over.len() == LONGEST {
            return Err(format!(
                "`{name}` depends on a chain of more than {LONGEST} others"
            ));
        }
        let value = match given {
            Given::Value(value) => Ok(*value),
            Given::Nothing => Err(format!("parameter `{name}` is not a number")),
            Given::Expression(text) => {
                let text = text.clone();
                self.over.push(name.to_owned());
                let value = self.expression(&text);
                self.over.pop();
                value
            }
        };
        self.known.insert(name.to_owned(), value.clone());
        value
    }

    fn expression(&mut self, text: &str) -> Result<f64, String> {
        let text = text.trim_start().trim_start_matches('=');
        evaluated(text, &mut |name| self.value(name))
    }

    fn unknown(&self, name: &str) -> String {
        let known: Vec<String> = self.given.keys().map(|name| format!("`{name}`")).collect();
        let there = match known.len() {
            0 => "the deck has no [parameters]".to_owned(),
            _ => format!("[parameters] has {}", known.join(", ")),
        };
        let nearest = nearest(name, self.given.keys().map(String::as_str));
        let hint = match nearest {
            Some(nearest) => format!("; did you mean `{nearest}`?"),
            None if ["x", "y", "z", "t"].contains(&name) => {
                "; a function of position and time is written without the `=`".to_owned()
            }
            None => String::new(),
        };
        format!("there is no parameter `{name}`; {there}{hint}")
    }
}

/// The circle in which a parameter needs itself, over parameters that each need the next.
fn circular(name: &str, over: &[String]) -> String {
    let by_way = match over {
        [] => String::new(),
        over => {
            let over: Vec<String> = over.iter().map(|name| format!("`{name}`")).collect();
            format!(" over {}", over.join(", "))
        }
    };
    let remedy = match over {
        [] => "give it as a number",
        _ => "give one of them as a number",
    };
    format!("`{name}` is computed from itself{by_way}; {remedy}")
}
