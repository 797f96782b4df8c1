//! The JSON schema and the reference of the deck, from its declarations.

use super::{
    Laws,
    form::{Alternative, Form, Key, Need},
    raw::Simulation,
    read::{Part, Read},
};
use serde_json::{Map, Value, json};
use striae_declared::Bound;

/// Texts that are expressions.
const EXPRESSION: &str = r"^\s*=";

/// The JSON schema (draft 2020-12) that editors complete and check decks with.
pub fn json_schema(laws: &Laws) -> Value {
    let mut schema = form_schema(&with_laws(&Simulation::form(), laws));
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("A deck of striae");
    schema
}

/// The reference of all keys in Markdown.
pub fn reference(laws: &Laws) -> String {
    let whole = Simulation::alternatives();
    let whole = whole.iter().flat_map(|one| composed(one, laws)).collect();
    let mut text = String::from("# Reference of the deck\n");
    let mut waiting: Vec<Section> = vec![(String::new(), whole)];
    let mut written: Vec<Section> = Vec::new();
    while !waiting.is_empty() {
        let (title, alternatives) = waiting.remove(0);
        if !title.is_empty() {
            text += &format!("\n## `{title}`\n");
        }
        if let Some((twin, _)) = written.iter().find(|(_, known)| *known == alternatives) {
            text += &format!("\nAs `{twin}`.\n");
            continue;
        }
        let mut inner = Vec::new();
        for one in &alternatives {
            text += &format!("\n{}\n", one.doc);
            text += &key_table(one, &title, &mut inner);
        }
        written.push((title, alternatives));
        inner.append(&mut waiting);
        waiting = inner;
    }
    text
}

/// The form with the keys of all laws where one may be named.
fn with_laws(form: &Form, laws: &Laws) -> Form {
    match form {
        Form::Table(alternatives) => {
            let all = alternatives.iter().flat_map(|one| composed(one, laws));
            Form::Table(all.collect())
        }
        Form::List(of, length) => Form::List(Box::new(with_laws(of, laws)), *length),
        Form::Any(forms) => Form::Any(forms.iter().map(|one| with_laws(one, laws)).collect()),
        form => form.clone(),
    }
}

/// The compositions of a table, one for each law where one may be named.
fn composed(alternative: &Alternative, laws: &Laws) -> Vec<Alternative> {
    let mut whole = alternative.clone();
    for key in &mut whole.keys {
        key.form = with_laws(&key.form, laws);
    }
    let mut named = whole.keys.iter().enumerate();
    let named = named.find_map(|(at, key)| match key.form {
        Form::Law(open) => Some((at, open)),
        _ => None,
    });
    let Some((at, open)) = named else {
        return vec![whole];
    };
    let of_law = |law: Alternative| {
        let mut keys = whole.keys.clone();
        keys.splice(at..=at, law.keys);
        let doc = format!("{} {}", whole.doc, law.doc).trim().to_owned();
        Alternative { doc, keys }
    };
    open.alternatives(laws).into_iter().map(of_law).collect()
}

/// Title and contents of a section of the reference.
type Section = (String, Vec<Alternative>);

fn key_table(alternative: &Alternative, parent: &str, sections: &mut Vec<Section>) -> String {
    if alternative.keys.is_empty() {
        return String::new();
    }
    let mut text = String::from("\n| key | value | meaning |\n| --- | --- | --- |\n");
    for key in &alternative.keys {
        let need = if key.need == Need::Optional {
            " (optional)"
        } else {
            ""
        };
        text += &format!(
            "| `{}`{need} | {} | {} |\n",
            key.name,
            value_text(&key.form),
            meaning(key)
        );
        subtables(key, parent, sections);
    }
    text
}

/// Sections for the tables a key holds.
fn subtables(key: &Key, parent: &str, sections: &mut Vec<Section>) {
    let (form, listed) = match &key.form {
        Form::List(of, _) => (of.as_ref(), true),
        Form::Any(forms) => match forms.iter().find(|form| matches!(form, Form::Table(_))) {
            Some(form) => (form, false),
            None => return,
        },
        form => (form, false),
    };
    if let Form::Table(alternatives) = form {
        let title = match (parent, listed) {
            ("", true) => format!("[[{}]]", key.name),
            ("", false) => format!("[{}]", key.name),
            _ => format!("{parent} {}", key.name),
        };
        if !sections.iter().any(|(known, _)| *known == title) {
            sections.push((title, alternatives.clone()));
        }
    }
}

fn value_text(form: &Form) -> String {
    match form {
        Form::Words(words) if words.len() == 1 => format!("`\"{}\"`", words[0].0),
        form => form.expected(),
    }
}

fn meaning(key: &Key) -> String {
    let words = match &key.form {
        Form::Words(words) if words.len() > 1 => words,
        _ => return key.doc.clone(),
    };
    let words: Vec<String> = words
        .iter()
        .map(|(word, doc)| format!("`{word}`: {}", doc.trim().trim_end_matches('.')))
        .collect();
    format!("{} {}.", key.doc, words.join("; "))
}

fn form_schema(form: &Form) -> Value {
    match form {
        Form::Text => json!({ "type": "string", "pattern": r"\S" }),
        Form::Truth => json!({ "type": "boolean" }),
        Form::Number(bounds) => {
            let mut schema = json!({ "type": ["number", "string"], "pattern": EXPRESSION });
            for bound in *bounds {
                let (word, limit) = match bound {
                    Bound::Above(limit) => ("exclusiveMinimum", limit),
                    Bound::AtLeast(limit) => ("minimum", limit),
                    Bound::Below(limit) => ("exclusiveMaximum", limit),
                    Bound::AtMost(limit) => ("maximum", limit),
                };
                schema[word] = json!(limit);
            }
            schema
        }
        Form::Whole(least) => {
            json!({ "type": ["integer", "string"], "pattern": EXPRESSION, "minimum": least })
        }
        Form::Varying => json!({ "type": ["number", "string"], "pattern": r"\S" }),
        Form::NamedNumbers => {
            json!({ "type": "object", "additionalProperties": { "type": ["number", "string"] } })
        }
        Form::Law(_) => Value::Null,
        Form::Words(words) => {
            json!({ "enum": words.iter().map(|(word, _)| *word).collect::<Vec<_>>() })
        }
        Form::List(of, None) => json!({ "type": "array", "items": form_schema(of) }),
        Form::List(of, Some(length)) => {
            json!({ "type": "array", "items": form_schema(of), "minItems": length, "maxItems": length })
        }
        Form::Table(alternatives) => match &alternatives[..] {
            [one] => table_schema(one),
            several => json!({ "oneOf": several.iter().map(table_schema).collect::<Vec<_>>() }),
        },
        Form::Any(forms) => json!({ "anyOf": forms.iter().map(form_schema).collect::<Vec<_>>() }),
    }
}

fn table_schema(alternative: &Alternative) -> Value {
    let properties: Map<String, Value> = alternative
        .keys
        .iter()
        .map(|key| {
            let mut schema = form_schema(&key.form);
            schema["description"] = json!(key.doc);
            (key.name.to_owned(), schema)
        })
        .collect();
    json!({
        "type": "object",
        "description": alternative.doc,
        "properties": properties,
        "required": alternative.required().collect::<Vec<_>>(),
        "additionalProperties": false,
    })
}
