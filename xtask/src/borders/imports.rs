//! Imports of a source file from other files: its `use` items and paths.

use super::text::product_lines;

/// Imports and re-exports of a file.
pub struct Imports {
    items: Vec<Item>,
    paths: Vec<Used>,
}

/// A name that a file takes from elsewhere.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Used {
    /// Path that it leads to.
    pub path: Vec<String>,
    /// Line, from 1.
    pub line: usize,
}

/// One name of a `use` item.
struct Item {
    used: Used,
    /// The name it has here.
    name: String,
    /// `true` if the file's own code names it.
    is_own: bool,
}

impl Imports {
    /// From the text of a file.
    pub fn of(text: &str) -> Self {
        let (mut items, mut paths, mut code) = (Vec::new(), Vec::new(), String::new());
        let mut lines = product_lines(text).into_iter();
        while let Some((line, text)) = lines.next() {
            let Some((is_public, tree)) = use_tree(text) else {
                paths.extend(paths_in(text).into_iter().map(|path| Used { path, line }));
                code.push_str(text);
                code.push('\n');
                continue;
            };
            let mut tree = tree.to_owned();
            while !tree.contains(';') {
                let Some((_, more)) = lines.next() else { break };
                tree.push_str(more.trim());
            }
            let tree = tree.split(';').next().unwrap_or_default();
            for (path, name) in leaves(tree) {
                let used = Used { path, line };
                items.push((used, name, is_public));
            }
        }
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let words: std::collections::BTreeSet<&str> = code.split(|c: char| !is_word(c)).collect();
        let items = items.into_iter().map(|(used, name, is_public)| Item {
            is_own: !is_public || words.contains(name.as_str()),
            used,
            name,
        });
        Self {
            items: items.collect(),
            paths,
        }
    }

    /// All that the file's own code uses.
    pub fn used(&self) -> impl Iterator<Item = &Used> {
        let items = self.items.iter().filter(|item| item.is_own);
        items.map(|item| &item.used).chain(&self.paths)
    }

    /// Path of a name that the file has from elsewhere.
    pub fn exported(&self, name: &str) -> Option<&[String]> {
        let item = self.items.iter().find(|item| item.name == name)?;
        Some(&item.used.path)
    }
}

/// Tree that follows `use`, and whether the names are re-exported.
fn use_tree(line: &str) -> Option<(bool, &str)> {
    let line = line.trim_start();
    if let Some(tree) = line.strip_prefix("use ") {
        return Some((false, tree));
    }
    let rest = line.strip_prefix("pub")?;
    let rest = match rest.strip_prefix('(') {
        Some(scope) => scope.split_once(')')?.1,
        None => rest,
    };
    Some((true, rest.trim_start().strip_prefix("use ")?))
}

/// Paths of all names in a tree, and the names they get.
fn leaves(tree: &str) -> Vec<(Vec<String>, String)> {
    let tree = tree.trim();
    let Some((stem, group)) = tree.split_once('{') else {
        let (path, alias) = match tree.split_once(" as ") {
            Some((path, alias)) => (path, Some(alias.trim())),
            None => (tree, None),
        };
        let mut path: Vec<String> = path.split("::").map(|name| name.trim().into()).collect();
        if path
            .last()
            .is_some_and(|name| name == "self" || name == "*")
            && path.len() > 1
        {
            path.pop();
        }
        let name = alias
            .or(path.last().map(String::as_str))
            .unwrap_or_default();
        return vec![(path.clone(), name.into())];
    };
    let group = group.rsplit_once('}').map_or(group, |(inner, _)| inner);
    let branches = branches(group).into_iter().filter(|b| !b.trim().is_empty());
    branches
        .flat_map(|branch| leaves(&format!("{stem}{}", branch.trim())))
        .collect()
}

/// Parts between the commas that are in no inner braces.
fn branches(group: &str) -> Vec<&str> {
    let (mut depth, mut begin, mut parts) = (0, 0, Vec::new());
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&group[begin..at]);
                begin = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&group[begin..]);
    parts
}

/// Paths in a line of code that begin with `crate`, `super` or `self`.
fn paths_in(line: &str) -> Vec<Vec<String>> {
    let in_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words = line.split(|c: char| !in_path(c));
    words
        .filter(|word| {
            ["crate::", "super::", "self::"]
                .iter()
                .any(|s| word.starts_with(s))
        })
        .map(|word| {
            word.split("::")
                .filter(|s| !s.is_empty())
                .map(Into::into)
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_are_taken_apart() {
        let text =
            "use crate::{\n    a::{self, B as C},\n    d::*,\n};\nfn f() { super::g::h(1) }\n";
        let imports = Imports::of(text);
        let used: Vec<String> = imports.used().map(|used| used.path.join("::")).collect();
        assert_eq!(used, ["crate::a", "crate::a::B", "crate::d", "super::g::h"]);
        assert_eq!(imports.exported("C").unwrap().join("::"), "crate::a::B");
        assert_eq!(
            imports.used().map(|used| used.line).collect::<Vec<_>>(),
            [1, 1, 1, 5]
        );
    }

    #[test]
    fn a_name_that_is_only_passed_on_is_not_used() {
        let imports = Imports::of("pub use a::A;\npub(crate) use b::B;\nfn f(_: B) {}\n");
        let used: Vec<String> = imports.used().map(|used| used.path.join("::")).collect();
        assert_eq!(used, ["b::B"]);
    }
}
