//! Files that a deck includes: `include = ["materials.toml", "steps.toml"]`.
//!
//! Contents of an included file count as if they stood in the deck: lists such as
//! `[[material]]` go before those of the deck, keys of tables such as `[parameters]` are joined, and where
//! both state the same key, the deck counts. Paths of included files are relative to the file
//! that names them, all other paths to the deck.

use std::path::{Path, PathBuf};

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use crate::{
    fault::FaultKind,
    faults::{FaultList, Span},
};

/// The key.
const KEY: &str = "include";
/// Files that a deck includes at most, those of included files counted.
const MOST: usize = 100;

/// An included file that is still to be read.
struct Wanted {
    span: Span,
    name: String,
    path: PathBuf,
}

/// Texts of all files that a text includes, behind blanks that put their spans after those
/// of what comes before.
pub(crate) fn texts(text: &str, base: &Path, faults: &mut FaultList<'_>) -> Vec<String> {
    let mut found = Vec::new();
    let mut known: Vec<PathBuf> = Vec::new();
    let mut wanted = named(text, base);
    while let Some(Wanted { span, name, path }) = wanted.pop() {
        let full = path.canonicalize().unwrap_or_else(|_| path.clone());
        let refused = match known.contains(&full) {
            true => Some("it is already included".to_owned()),
            false if known.len() == MOST => Some(format!("{MOST} files are already included")),
            false => None,
        };
        let read = match refused {
            Some(cause) => Err(cause),
            None => std::fs::read_to_string(&path).map_err(|cause| cause.to_string()),
        };
        match read {
            Ok(text) => {
                let start = faults.include(path.display().to_string(), text.clone());
                let padded = " ".repeat(start) + &text;
                wanted.extend(named(&padded, path.parent().unwrap_or(base)));
                known.push(full);
                found.push(padded);
            }
            Err(cause) => faults.push(&span, FaultKind::Include { file: name, cause }),
        }
    }
    found
}

/// Files that a text includes, the first one last.
fn named(text: &str, base: &Path) -> Vec<Wanted> {
    let (tree, _) = DeTable::parse_recoverable(text);
    let one = |value: &Spanned<DeValue<'_>>| match value.get_ref() {
        DeValue::String(name) => Some(Wanted {
            span: value.span(),
            name: name.to_string(),
            path: base.join(&**name),
        }),
        _ => None,
    };
    let mut files: Vec<Wanted> = match tree.get_ref().get(KEY) {
        Some(value) => match value.get_ref() {
            DeValue::Array(list) => list.iter().filter_map(one).collect(),
            _ => one(value).into_iter().collect(),
        },
        None => Vec::new(),
    };
    files.reverse();
    files
}

/// Puts what an included file states before what the deck states.
pub(crate) fn merge<'i>(deck: &mut DeTable<'i>, included: DeTable<'i>) {
    for (key, value) in included {
        if key.get_ref() == KEY {
            continue;
        }
        match deck.get_mut(key.get_ref().as_ref()) {
            None => {
                deck.insert(key, value);
            }
            Some(own) => join(own.get_mut(), value.into_inner()),
        }
    }
}

fn join<'i>(own: &mut DeValue<'i>, included: DeValue<'i>) {
    match (own, included) {
        (DeValue::Array(own), DeValue::Array(included)) => {
            *own = included.into_iter().chain(own.iter().cloned()).collect();
        }
        (DeValue::Table(own), DeValue::Table(included)) => {
            for (key, value) in included {
                if !own.contains_key(key.get_ref().as_ref()) {
                    own.insert(key, value);
                }
            }
        }
        _ => {}
    }
}
