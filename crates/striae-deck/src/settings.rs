//! Numbers that are set from outside the deck: parameters, `E=2e6`, and any number that the
//! deck states, by its path, `material.rubber.youngs_modulus=2e6`.
//!
//! A path has keys of tables, names of what lists hold, and positions, from 0, where what they
//! hold has no names: `step.press.displacement.0.z`. Only numbers that the deck states can be
//! set, so that a misspelt path is a fault and no new key.

use std::{fmt, str::FromStr};

use striae_declared::shown;
use striae_model::nearest;
use toml::de::{DeTable, DeValue};

use crate::{
    expression::{evaluated, is_expression},
    fault::FaultKind,
    faults::{FaultList, Span},
    read::{Value, described},
    value::finite,
};

/// Name of the table of parameters.
pub(crate) const TABLE: &str = "parameters";

/// A number of a deck that is set from outside: `E=2e6`.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    name: String,
    value: f64,
}

impl Setting {
    /// A parameter, or the path of a number, and its value.
    pub fn new(name: impl Into<String>, value: f64) -> Self {
        let name = name.into();
        Self { name, value }
    }

    /// Name of the parameter, or path of the number.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its value.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// The parameter that is set, unless it is another number.
    pub(crate) fn parameter(&self) -> Option<&str> {
        let table = self.name.strip_prefix(TABLE);
        match table.and_then(|rest| rest.strip_prefix('.')) {
            Some(name) => Some(name),
            None => (!self.name.contains('.')).then_some(&self.name),
        }
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value } = self;
        write!(f, "{name}={}", shown(*value))
    }
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((name, value)) = text.split_once('=') else {
            return Err(format!(
                "expected NAME=VALUE, such as `E=2e6`, found `{text}`"
            ));
        };
        let no_name = |name: &str| Err(format!("`{name}` does not refer to a number here"));
        let found = evaluated(value, &mut |name| no_name(name))
            .map_err(|cause| format!("`{value}` is not a number: {cause}"))?;
        Ok(Self::new(name.trim(), found))
    }
}

/// Places of the numbers that are set by their paths, and their values; the last setting of a
/// number counts.
pub(crate) fn placed(
    tree: &DeTable<'_>,
    settings: &[Setting],
    faults: &mut FaultList<'_>,
) -> Vec<(Span, f64)> {
    let mut found: Vec<(Span, f64)> = Vec::new();
    for setting in settings {
        if setting.parameter().is_some() {
            continue;
        }
        if let Some(span) = at(tree, &setting.name, faults) {
            found.retain(|(place, _)| *place != span);
            found.push((span, setting.value));
        }
    }
    found
}

/// A note of the numbers that are set by paths; none where there are none.
pub(crate) fn note(settings: &[Setting]) -> Option<String> {
    let paths = settings.iter();
    let paths: Vec<String> = paths
        .filter(|setting| setting.parameter().is_none())
        .map(|Setting { name, value }| format!("{name} = {}", shown(*value)))
        .collect();
    (!paths.is_empty()).then(|| format!("set: {}", paths.join(", ")))
}

/// A path that leads to no number.
struct Missing {
    span: Span,
    kind: FaultKind,
}

/// Value of a parameter, or of the number at a path, in tables without expressions; a missing
/// number is a fault, at the place that names it if there is one.
pub(crate) fn number(
    tree: &DeTable<'_>,
    name: &str,
    named_at: Option<&Span>,
    faults: &mut FaultList<'_>,
) -> Option<f64> {
    let path = match Setting::new(name, 0.0).parameter() {
        Some(parameter) => format!("{TABLE}.{parameter}"),
        None => name.to_owned(),
    };
    match found(tree, &path) {
        Ok(value) => finite(value.get_ref()),
        Err(missing) => {
            faults.push(named_at.unwrap_or(&missing.span), missing.kind);
            None
        }
    }
}

/// Location of the number at a path; a missing number is a fault.
fn at(tree: &DeTable<'_>, path: &str, faults: &mut FaultList<'_>) -> Option<Span> {
    match found(tree, path) {
        Ok(value) => Some(value.span()),
        Err(missing) => {
            faults.push(&missing.span, missing.kind);
            None
        }
    }
}

/// Number at a path.
///
/// # Errors
/// The first part of the path that leads nowhere or to something else, with its place.
fn found<'t, 'i>(tree: &'t DeTable<'i>, path: &str) -> Result<&'t Value<'i>, Box<Missing>> {
    let mut parts = keys(tree);
    let mut span = 0..0;
    let mut rest = path;
    loop {
        // A name may have dots itself, so the longest one that fits counts.
        let fitting = parts.iter().filter_map(|(name, value)| {
            let after = rest.strip_prefix(name.as_str())?;
            let after = match after {
                "" => after,
                _ => after.strip_prefix('.')?,
            };
            Some((*value, after))
        });
        let Some((value, after)) = fitting.min_by_key(|(_, after)| after.len()) else {
            let known: Vec<String> = parts.into_iter().map(|(name, _)| name).collect();
            let kind = unknown(path, rest, known);
            return Err(Box::new(Missing { span, kind }));
        };
        span = value.span();
        if after.is_empty() {
            if is_number(value.get_ref()) {
                return Ok(value);
            }
            let kind = no_number(path, value);
            return Err(Box::new(Missing { span, kind }));
        }
        parts = held(value);
        rest = after;
    }
}

fn is_number(value: &DeValue<'_>) -> bool {
    match value {
        DeValue::String(text) => is_expression(text),
        value => finite(value).is_some(),
    }
}

fn unknown(path: &str, rest: &str, known: Vec<String>) -> FaultKind {
    let done = &path[..path.len() - rest.len()];
    let word = rest.split('.').next().unwrap_or(rest);
    FaultKind::UnknownPath {
        path: path.to_owned(),
        place: match done.trim_end_matches('.') {
            "" => "the deck".to_owned(),
            place => format!("`{place}`"),
        },
        nearest: nearest(word, known.iter().map(String::as_str)),
        known,
    }
}

fn no_number(path: &str, value: &Value<'_>) -> FaultKind {
    let known = held(value).into_iter().map(|(name, _)| name);
    FaultKind::NoNumber {
        path: path.to_owned(),
        found: described(value.get_ref()),
        known: known.collect(),
    }
}

fn keys<'t, 'i>(table: &'t DeTable<'i>) -> Vec<(String, &'t Value<'i>)> {
    let keys = table.iter();
    keys.map(|(key, value)| (key.get_ref().to_string(), value))
        .collect()
}

/// Values of a table or a list: by keys, by names, or by positions where there are no names.
fn held<'t, 'i>(value: &'t Value<'i>) -> Vec<(String, &'t Value<'i>)> {
    match value.get_ref() {
        DeValue::Table(table) => keys(table),
        DeValue::Array(list) => {
            let all = list.iter().enumerate();
            all.map(|(position, value)| {
                let name = named(value).unwrap_or_else(|| position.to_string());
                (name, value)
            })
            .collect()
        }
        _ => Vec::new(),
    }
}

fn named(value: &Value<'_>) -> Option<String> {
    let DeValue::Table(table) = value.get_ref() else {
        return None;
    };
    match table.get("name")?.get_ref() {
        DeValue::String(name) => Some(name.to_string()),
        _ => None,
    }
}
