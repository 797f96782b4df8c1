//! Reading of spanned TOML values into declared types, noting every fault and
//! going on after it.

use super::{
    expression::is_expression,
    fault::FaultKind,
    faults::{FaultList, Span},
    form::{Alternative, Form, Key, Need, ticked},
};
use striae_model::nearest;
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

/// A TOML value with its place in the text.
pub(crate) type Value<'i> = Spanned<DeValue<'i>>;

/// A value read, with its place in the text.
#[derive(Clone, Debug)]
pub(crate) struct At<T> {
    pub(crate) span: Span,
    pub(crate) value: T,
}

/// A type that a TOML value can be read into.
pub(crate) trait Read: Sized {
    /// The value, or `None` after its faults have been noted.
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self>;
    /// The form the value must have.
    fn form() -> Form;
}

/// A type that is read from some keys of a table.
pub(crate) trait Part: Sized {
    /// Takes its keys from the table, or `None` after faults that leave nothing to continue with.
    fn part(table: &mut TableReader<'_, '_, '_>) -> Option<Self>;
    /// The compositions the keys may have.
    fn alternatives() -> Vec<Alternative>;
}

/// Location of a value: a key of a table.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    table: String,
    key: &'static str,
    in_list: bool,
}

impl Place {
    /// The whole deck.
    pub(crate) fn root() -> Self {
        Self {
            table: String::new(),
            key: "",
            in_list: false,
        }
    }

    /// An element of the list at this place.
    pub(crate) fn element(&self) -> Self {
        Self {
            in_list: true,
            ..self.clone()
        }
    }

    /// The place as a table of its own: `[[body]]`, `[solver]`, `[[body]] mesh`.
    fn table_name(&self) -> String {
        match (self.table.as_str(), self.key) {
            (_, "") => "the deck".into(),
            ("the deck", key) if self.in_list => format!("[[{key}]]"),
            ("the deck", key) => format!("[{key}]"),
            (table, key) => format!("{table} {key}"),
        }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let element = if self.in_list { "an element of " } else { "" };
        match (self.table.as_str(), self.key) {
            (_, "") => write!(f, "the deck"),
            ("the deck", key) => write!(f, "{element}`{key}`"),
            (table, key) => write!(f, "{element}`{key}` in {table}"),
        }
    }
}

/// The keys of one table while they are being read.
pub(crate) struct TableReader<'r, 'i, 's> {
    table: &'r DeTable<'i>,
    span: Span,
    name: String,
    known: Vec<&'static str>,
    missing: Vec<(&'static str, String)>,
    pub(crate) faults: &'r mut FaultList<'s>,
}

/// Reads a whole table; keys that were not requested are faults.
pub(crate) fn read_table<T: Part>(
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
) -> Option<T> {
    read_table_as(value, place, faults, T::part)
}

/// Reads a whole table by a function that takes its keys.
pub(crate) fn read_table_as<T>(
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    read: impl FnOnce(&mut TableReader<'_, '_, '_>) -> Option<T>,
) -> Option<T> {
    let DeValue::Table(table) = value.get_ref() else {
        return unexpected(value, place, faults, &Form::Table(Vec::new()));
    };
    read_keys(table, value.span(), place, faults, read)
}

/// Reads the keys of a table that has already been found to be one.
pub(crate) fn read_keys<T>(
    table: &DeTable<'_>,
    span: Span,
    place: &Place,
    faults: &mut FaultList<'_>,
    read: impl FnOnce(&mut TableReader<'_, '_, '_>) -> Option<T>,
) -> Option<T> {
    let name = place.table_name();
    let mut reader = TableReader {
        table,
        span,
        name,
        known: Vec::new(),
        missing: Vec::new(),
        faults,
    };
    let found = read(&mut reader);
    reader.finish();
    found
}

/// Notes that a value has not the form it must have.
pub(crate) fn unexpected<T>(
    value: &Value<'_>,
    place: &Place,
    faults: &mut FaultList<'_>,
    form: &Form,
) -> Option<T> {
    // An expression without a value is a fault already.
    let failed = matches!(value.get_ref(), DeValue::String(text) if is_expression(text));
    if failed && faults.within(&value.span()) {
        return None;
    }
    let kind = FaultKind::Unexpected {
        place: place.to_string(),
        expected: form.expected(),
        found: described(value.get_ref()) + &remedy(value.get_ref(), place, form),
    };
    faults.push(&value.span(), kind);
    None
}

impl TableReader<'_, '_, '_> {
    /// Location of the table.
    pub(crate) fn span(&self) -> Span {
        self.span.clone()
    }

    /// The place of a key as written in the deck, where it is present.
    pub(crate) fn key_span(&self, key: &str) -> Option<Span> {
        self.table.get_key_value(key).map(|(key, _)| key.span())
    }

    /// The value of a key that may be absent.
    pub(crate) fn optional<T: Read>(&mut self, key: &'static str) -> Option<At<T>> {
        self.optional_as(key, T::read)
    }

    /// The value of a key that may be absent, by a function that reads it.
    pub(crate) fn optional_as<T>(
        &mut self,
        key: &'static str,
        read: impl FnOnce(&Value<'_>, &Place, &mut FaultList<'_>) -> Option<T>,
    ) -> Option<At<T>> {
        self.known.push(key);
        let value = self.table.get(key)?;
        let place = Place {
            table: self.name.clone(),
            key,
            in_list: false,
        };
        let found = read(value, &place, self.faults)?;
        Some(At {
            span: value.span(),
            value: found,
        })
    }

    /// The value of a key that must be present.
    pub(crate) fn required<T: Read>(&mut self, key: &'static str) -> Option<At<T>> {
        self.required_as(key, &T::form().expected(), T::read)
    }

    /// The value of a key that must be present, by a function that reads it.
    pub(crate) fn required_as<T>(
        &mut self,
        key: &'static str,
        expected: &str,
        read: impl FnOnce(&Value<'_>, &Place, &mut FaultList<'_>) -> Option<T>,
    ) -> Option<At<T>> {
        if !self.has(key) {
            self.missing.push((key, expected.to_owned()));
        }
        self.optional_as(key, read)
    }

    /// Returns whether a key is present.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// Finds nothing wrong with any key of these alternatives, as it is not known which applies.
    pub(crate) fn tolerate(&mut self, alternatives: &[Alternative]) {
        self.known.extend(key_names(alternatives));
    }

    /// Group of keys that is present, out of several exclusive ones.
    pub(crate) fn choose(&mut self, groups: &[Vec<Alternative>]) -> Option<usize> {
        let present: Vec<(usize, &str)> = groups
            .iter()
            .enumerate()
            .filter_map(|(index, _)| Some((index, self.first_present(groups, index)?)))
            .collect();
        let choices = || groups.iter().map(|group| leading(group)).collect();
        let kind = match present[..] {
            [(index, _)] => return Some(index),
            [] => FaultKind::NoneOf {
                place: self.name.clone(),
                choices: choices(),
            },
            [(_, first), (_, second), ..] => FaultKind::Exclusive {
                first: first.into(),
                second: second.into(),
                place: self.name.clone(),
                choices: choices(),
            },
        };
        let span = present
            .get(1)
            .and_then(|(_, key)| self.key_span(key))
            .unwrap_or(self.span());
        self.faults.push(&span, kind);
        groups.iter().for_each(|group| self.tolerate(group));
        None
    }

    /// The first key present that belongs to this group alone.
    fn first_present(&self, groups: &[Vec<Alternative>], index: usize) -> Option<&'static str> {
        let others = groups
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != index);
        let shared: Vec<&str> = others.flat_map(|(_, group)| key_names(group)).collect();
        key_names(&groups[index]).find(|key| self.has(key) && !shared.contains(key))
    }

    /// Notes unknown keys, and missing ones that none of those is a misspelling of.
    fn finish(mut self) {
        let unknown = self
            .table
            .keys()
            .filter(|key| !self.known.contains(&key.get_ref().as_ref()));
        let mut known: Vec<String> = self.known.iter().map(|key| (*key).to_owned()).collect();
        known.sort_unstable();
        known.dedup();
        for key in unknown {
            let nearest = nearest(key.get_ref(), self.known.iter().copied());
            self.missing
                .retain(|(missing, _)| nearest.as_deref() != Some(missing));
            let (key_name, place) = (key.get_ref().to_string(), self.name.clone());
            self.faults.push(
                &key.span(),
                FaultKind::UnknownKey {
                    key: key_name,
                    place,
                    nearest,
                    known: known.clone(),
                },
            );
        }
        for (key, expected) in self.missing {
            let place = self.name.clone();
            self.faults.push(
                &self.span,
                FaultKind::MissingKey {
                    key: key.into(),
                    place,
                    expected,
                },
            );
        }
    }
}

/// The key of a table declaration.
pub(crate) fn key<T: Read>(name: &'static str, doc: &[&str], need: Need) -> Key {
    Key {
        name,
        doc: super::form::joined(doc),
        need,
        form: T::form(),
    }
}

/// Every composition of `outer` extended by every one of `inner`.
pub(crate) fn combined(outer: &[Alternative], inner: &[Alternative]) -> Vec<Alternative> {
    let mut all = Vec::new();
    for one in outer {
        for other in inner {
            let doc = match inner {
                [_] if !one.doc.is_empty() => one.doc.clone(),
                _ => format!("{} {}", one.doc, other.doc).trim().to_owned(),
            };
            let keys = one.keys.iter().chain(&other.keys).cloned().collect();
            all.push(Alternative { doc, keys });
        }
    }
    all
}

/// All keys of a group, some more than once.
fn key_names(group: &[Alternative]) -> impl Iterator<Item = &'static str> {
    group
        .iter()
        .flat_map(|one| one.keys.iter().map(|key| key.name))
}

/// The keys that every alternative of a group requires: its name in messages.
fn leading(group: &[Alternative]) -> String {
    let Some((first, rest)) = group.split_first() else {
        return String::new();
    };
    let common = first.required().filter(|key| {
        rest.iter()
            .all(|one| one.required().any(|other| other == *key))
    });
    let common: Vec<&str> = common.collect();
    ticked(common).replace(", ", " and ")
}

/// Remedy for a table where a list of tables is expected.
fn remedy(value: &DeValue<'_>, place: &Place, form: &Form) -> String {
    match (value, form) {
        (DeValue::Table(_), Form::List(of, _)) if matches!(**of, Form::Table(_)) => {
            if place.table == "the deck" {
                format!("; begin it with [[{}]]", place.key)
            } else {
                "; put it into brackets, [{ ... }]".into()
            }
        }
        _ => String::new(),
    }
}

pub(crate) fn described(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) if text.is_empty() => "an empty text".into(),
        DeValue::String(text) => format!("the text {text:?}"),
        DeValue::Integer(number) => number.to_string(),
        DeValue::Float(number) => number.to_string(),
        DeValue::Boolean(truth) => truth.to_string(),
        DeValue::Datetime(date) => format!("the date {date}"),
        DeValue::Array(list) => format!("a list of {}", list.len()),
        DeValue::Table(_) => "a table".into(),
    }
}
