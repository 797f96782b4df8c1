//! The schema and the reference that are checked in are those of the reader.

mod deck;

use deck::{
    BASE,
    schema::{Verdict, verdict},
};
use striae_deck::{Laws, json_schema, reference};

#[test]
fn the_schema_in_docs_is_up_to_date() {
    let schema = serde_json::to_string_pretty(&json_schema(&Laws::default())).unwrap() + "\n";
    let written = include_str!("../../../docs/deck.schema.json");
    assert!(
        schema == written,
        "run: striae schema > docs/deck.schema.json"
    );
}

#[test]
fn the_reference_in_docs_is_up_to_date() {
    let written = include_str!("../../../docs/deck-reference.md");
    assert!(
        reference(&Laws::default()) == written,
        "run: striae schema --format markdown > docs/deck-reference.md"
    );
}

#[test]
fn the_schema_accepts_a_good_deck() {
    assert_eq!(verdict(BASE), Verdict::Accepted);
}

#[test]
fn every_key_of_the_schema_is_in_the_reference_with_its_meaning() {
    let reference = reference(&Laws::default());
    let mut keys = Vec::new();
    collect(&json_schema(&Laws::default()), &mut keys);
    assert!(keys.len() > 100, "{}", keys.len());
    for (key, meaning) in keys {
        assert!(!meaning.trim().is_empty(), "`{key}` has no meaning");
        let row = format!("| `{key}`");
        let found = reference
            .lines()
            .any(|line| line.starts_with(&row) && line.contains(&meaning));
        assert!(found, "`{key}`: {meaning}");
    }
}

fn collect(schema: &serde_json::Value, keys: &mut Vec<(String, String)>) {
    if let Some(properties) = schema
        .get("properties")
        .and_then(|properties| properties.as_object())
    {
        for (key, value) in properties {
            keys.push((
                key.clone(),
                value["description"].as_str().unwrap_or("").to_owned(),
            ));
        }
    }
    match schema {
        serde_json::Value::Object(table) => table.values().for_each(|value| collect(value, keys)),
        serde_json::Value::Array(list) => list.iter().for_each(|value| collect(value, keys)),
        _ => {}
    }
}
