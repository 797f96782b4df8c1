//! A validator for the part of JSON schema that the deck's schema uses.

use serde_json::Value;

/// Verdict of the schema on a deck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The deck matches the schema.
    Accepted,
    /// The deck does not match the schema, or is not even TOML.
    Refused,
}

/// Verdict of the schema on a deck.
pub fn verdict(text: &str) -> Verdict {
    match toml::from_str::<Value>(text) {
        Ok(deck)
            if fits(
                &deck,
                &striae_deck::json_schema(&striae_deck::Laws::default()),
            ) =>
        {
            Verdict::Accepted
        }
        _ => Verdict::Refused,
    }
}

fn fits(value: &Value, schema: &Value) -> bool {
    let keywords = schema.as_object().expect("a schema is an object");
    keywords
        .iter()
        .all(|(keyword, argument)| match keyword.as_str() {
            "$schema" | "title" | "description" => true,
            "type" => match argument.as_array() {
                Some(types) => (types.iter()).any(|one| has_type(value, one.as_str().unwrap())),
                None => has_type(value, argument.as_str().expect("one type")),
            },
            "enum" => argument.as_array().expect("a list").contains(value),
            "pattern" if argument == r"\S" => {
                value.as_str().is_none_or(|text| !text.trim().is_empty())
            }
            "pattern" if argument == r"^\s*=" => value
                .as_str()
                .is_none_or(|text| text.trim_start().starts_with('=')),
            "minimum" => number(value, |value| value >= argument.as_f64().unwrap()),
            "maximum" => number(value, |value| value <= argument.as_f64().unwrap()),
            "exclusiveMinimum" => number(value, |value| value > argument.as_f64().unwrap()),
            "exclusiveMaximum" => number(value, |value| value < argument.as_f64().unwrap()),
            "items" => value
                .as_array()
                .is_none_or(|list| list.iter().all(|item| fits(item, argument))),
            "minItems" => value
                .as_array()
                .is_none_or(|list| list.len() as u64 >= argument.as_u64().unwrap()),
            "maxItems" => value
                .as_array()
                .is_none_or(|list| list.len() as u64 <= argument.as_u64().unwrap()),
            "required" => value.as_object().is_none_or(|table| {
                argument
                    .as_array()
                    .unwrap()
                    .iter()
                    .all(|key| table.contains_key(key.as_str().unwrap()))
            }),
            "properties" => value.as_object().is_none_or(|table| {
                table
                    .iter()
                    .all(|(key, value)| argument.get(key).is_none_or(|schema| fits(value, schema)))
            }),
            "additionalProperties" => value.as_object().is_none_or(|table| {
                let known = |key: &str| schema.get("properties").and_then(|of| of.get(key));
                table.iter().all(|(key, value)| {
                    known(key).is_some() || argument.is_object() && fits(value, argument)
                })
            }),
            "oneOf" => {
                argument
                    .as_array()
                    .unwrap()
                    .iter()
                    .filter(|schema| fits(value, schema))
                    .count()
                    == 1
            }
            "anyOf" => argument
                .as_array()
                .unwrap()
                .iter()
                .any(|schema| fits(value, schema)),
            other => panic!("the schema uses `{other}`"),
        })
}

fn has_type(value: &Value, name: &str) -> bool {
    match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_i64() || value.is_u64(),
        other => panic!("the schema uses the type `{other}`"),
    }
}

fn number(value: &Value, holds: impl Fn(f64) -> bool) -> bool {
    value.as_f64().is_none_or(holds)
}
