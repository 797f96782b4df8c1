//! Numbers and functions of position and time.

use std::collections::BTreeMap;

use striae_model::{Function, Value};

use crate::{
    fault::FaultKind,
    faults::{FaultList, Span},
    raw,
    read::At,
    value::Varying,
};

/// Numbers that functions may name.
pub(super) struct Parameters(BTreeMap<String, f64>);

impl Parameters {
    /// The parameters of a deck.
    pub(super) fn of(raw: &raw::Simulation) -> Self {
        let numbers = raw.parameters.iter().flat_map(|at| &at.value.0);
        Self(
            numbers
                .map(|(name, value)| (name.clone(), *value))
                .collect(),
        )
    }

    /// The value that is stated.
    pub(super) fn value(
        &self,
        raw: &Varying,
        span: &Span,
        faults: &mut FaultList<'_>,
    ) -> Option<Value> {
        match raw {
            Varying::Number(number) => Some(Value::Number(*number)),
            Varying::Function(text) => self.function(text, span, faults).map(Value::Function),
        }
    }

    /// Values of which one is missing where its component is not stated.
    pub(super) fn components(
        &self,
        raw: [&Option<At<Varying>>; 3],
        faults: &mut FaultList<'_>,
    ) -> Option<[Option<Value>; 3]> {
        let mut whole = true;
        let components = raw.map(|stated| {
            let stated = stated.as_ref()?;
            let value = self.value(&stated.value, &stated.span, faults);
            whole &= value.is_some();
            value
        });
        whole.then_some(components)
    }

    /// The vector that is stated.
    pub(super) fn vector(
        &self,
        raw: &At<[Varying; 3]>,
        faults: &mut FaultList<'_>,
    ) -> Option<[Value; 3]> {
        let values = raw.value.each_ref();
        let [x, y, z] = values.map(|value| self.value(value, &raw.span, faults));
        Some([x?, y?, z?])
    }

    /// The function that a text says.
    pub(super) fn function(
        &self,
        text: &str,
        span: &Span,
        faults: &mut FaultList<'_>,
    ) -> Option<Function> {
        let function = Function::with_names(text, &mut |name| match self.0.get(name) {
            Some(value) => Ok(*value),
            None => Err(self.unknown(name)),
        });
        // A parameter with the name of a variable has been taken for it.
        let is_both =
            |name: &&str| self.0.contains_key(*name) && words(text).any(|word| word == *name);
        if let Some(name) = ["x", "y", "z", "t"].into_iter().find(is_both) {
            let kind = FaultKind::Ambiguous {
                name: name.to_owned(),
                text: text.to_owned(),
            };
            faults.push(span, kind);
            return None;
        }
        function.map_err(|fault| faults.push(span, fault)).ok()
    }

    fn unknown(&self, name: &str) -> String {
        let known: Vec<String> = self.0.keys().map(|name| format!("`{name}`")).collect();
        match known.len() {
            0 => format!("there is no `{name}`"),
            _ => format!(
                "there is no `{name}`; [parameters] has {}",
                known.join(", ")
            ),
        }
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|letter: char| !letter.is_alphanumeric() && letter != '_')
}
