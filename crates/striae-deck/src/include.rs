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
    /// The deck and the files by way of which it is included, each with its name in messages.
    over: Vec<(PathBuf, String)>,
}

/// Texts of all files that a text includes, behind blanks that put their spans after those
/// of what comes before; `deck` is the file of the text, if it has one.
pub(crate) fn texts(
    text: &str,
    base: &Path,
    deck: Option<&Path>,
    faults: &mut FaultList<'_>,
) -> Vec<String> {
    let mut found = Vec::new();
    let mut known: Vec<PathBuf> = Vec::new();
    let deck = deck.map(|path| (identity(path), path.display().to_string()));
    let mut wanted = named(text, base, &Vec::from_iter(deck));
    while let Some(one) = wanted.pop() {
        let full = identity(&one.path);
        let read = match refusal(&full, &one.over, &known) {
            Some(cause) => Err(cause),
            None => content(&one.path),
        };
        match read {
            Ok(text) => {
                let shown = one.path.display().to_string();
                let start = faults.include(shown.clone(), text.clone());
                let padded = " ".repeat(start) + &text;
                let mut over = one.over;
                over.push((full.clone(), shown));
                wanted.extend(named(&padded, one.path.parent().unwrap_or(base), &over));
                known.push(full);
                found.push(padded);
            }
            Err(cause) => faults.push(
                &one.span,
                FaultKind::Include {
                    file: one.name,
                    cause,
                },
            ),
        }
    }
    found
}

/// Reason not to include a file, if there is one.
fn refusal(full: &Path, over: &[(PathBuf, String)], known: &[PathBuf]) -> Option<String> {
    if let Some(at) = over.iter().position(|(path, _)| path == full) {
        let between = over[at + 1..].iter().map(|(_, name)| format!("`{name}`"));
        let between: Vec<String> = between.collect();
        return Some(match between.is_empty() {
            true => "it includes itself".to_owned(),
            false => format!("it includes itself by way of {}", between.join(", ")),
        });
    }
    match known.iter().any(|path| path == full) {
        true => Some("it is already included".to_owned()),
        false if known.len() == MOST => Some(format!("{MOST} files are already included")),
        false => None,
    }
}

/// Canonical path, equal for all paths to one file.
fn identity(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}

/// The text of a file.
fn content(path: &Path) -> Result<String, String> {
    let bytes = striae_meshfile::content(path).map_err(|cause| cause.to_string())?;
    String::from_utf8(bytes).map_err(|_| "it is not valid UTF-8; save it as text in UTF-8".into())
}

/// Files that a text includes, the first one last; `over` are the files on the way to the text.
fn named(text: &str, base: &Path, over: &[(PathBuf, String)]) -> Vec<Wanted> {
    let (tree, _) = DeTable::parse_recoverable(text);
    let one = |value: &Spanned<DeValue<'_>>| match value.get_ref() {
        DeValue::String(name) => Some(Wanted {
            span: value.span(),
            name: name.to_string(),
            path: base.join(&**name),
            over: over.to_vec(),
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
