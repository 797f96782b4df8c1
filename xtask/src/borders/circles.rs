//! Circles of imports between the files of a crate.
//!
//! Files use what others define by `use`, or by a path that begins with `crate`, `super`
//! or `self`. At every level of a crate, modules that stand side by side must form a
//! ladder: no two of them may use each other, over however many between. The rule:
//!
//! - A module is its file together with its folder. Seen from beside it is one thing, so
//!   a file in the folder of one may not use what uses the file in the folder of another.
//! - Within it, a parent and its children may use each other: children add methods to
//!   the parent's types, and the parent calls what they define.
//! - A name counts for the file that defines it, also when it is reached by the parent
//!   that re-exports it. To declare a module, or to re-export a name, is no use.
//! - Tests do not count.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
};

use super::imports::Imports;
use crate::breach::Breach;

/// Names of the modules from the root of the crate down.
type Module = Vec<String>;

/// The product files of a crate by their modules.
struct Crate {
    files: BTreeMap<Module, (String, Imports)>,
}

/// Modules side by side, and what each uses of the others, with the place of one use.
type Level<'a> = BTreeMap<&'a str, BTreeMap<&'a str, String>>;

/// Circles among the product files of a crate, each with its path within the workspace
/// and its text.
pub fn breaches(source: &Path, files: &[(PathBuf, &str)]) -> Vec<Breach> {
    let modules = files.iter().filter_map(|(path, text)| {
        let module = module(path.strip_prefix(source).ok()?)?;
        Some((module, (path.display().to_string(), Imports::of(text))))
    });
    let found = Crate {
        files: modules.collect(),
    };
    let uses = found.uses();
    let mut levels: BTreeMap<&[String], Level> = BTreeMap::new();
    for (from, to, place) in &uses {
        let common = from.iter().zip(to).take_while(|(a, b)| a == b).count();
        if let (Some(a), Some(b)) = (from.get(common), to.get(common)) {
            let level = levels.entry(&from[..common]).or_default();
            let places = level.entry(a).or_default();
            places.entry(b).or_insert_with(|| place.clone());
        }
    }
    levels.values().flat_map(circles).collect()
}

/// The module that a file below `src` holds; none for a program beside the library.
fn module(path: &Path) -> Option<Module> {
    let mut names: Module = path
        .with_extension("")
        .iter()
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    match names.last().map(String::as_str) {
        Some("mod") => {
            names.pop();
        }
        Some("lib") if names.len() == 1 => names.clear(),
        Some("main") if names.len() == 1 => return None,
        _ => {}
    }
    Some(names)
}

impl Crate {
    /// All uses of one file by another: from, to, and where.
    fn uses(&self) -> BTreeSet<(Module, Module, String)> {
        let mut uses = BTreeSet::new();
        for (module, (path, imports)) in &self.files {
            for used in imports.used() {
                if let Some(to) = self.definer(module, &used.path, 8)
                    && to != *module
                {
                    let place = format!("{path}:{}", used.line);
                    uses.insert((module.clone(), to, place));
                }
            }
        }
        uses
    }

    /// The module that defines what a path in a module leads to; none outside the crate.
    fn definer(&self, module: &[String], path: &[String], depth: usize) -> Option<Module> {
        let (mut at, mut rest) = self.start(module, path)?;
        while let [name, others @ ..] = rest {
            let mut child = at.clone();
            child.push(name.clone());
            if !self.files.contains_key(&child) {
                break;
            }
            (at, rest) = (child, others);
        }
        let (_, imports) = self.files.get(&at)?;
        match rest.first().and_then(|name| imports.exported(name)) {
            Some(further) if depth > 0 => {
                let further = further.to_vec();
                self.definer(&at, &further, depth - 1).or(Some(at))
            }
            _ => Some(at),
        }
    }

    /// The module that a path starts from, and what is left of the path.
    fn start<'p>(&self, module: &[String], path: &'p [String]) -> Option<(Module, &'p [String])> {
        let (first, others) = path.split_first()?;
        match first.as_str() {
            "crate" => Some((Module::new(), others)),
            "self" => Some((module.to_vec(), others)),
            "super" => {
                let (mut at, mut rest) = (module.to_vec(), path);
                while rest.first().is_some_and(|name| name == "super") {
                    at.pop()?;
                    rest = &rest[1..];
                }
                Some((at, rest))
            }
            _ => {
                let child = [module, std::slice::from_ref(first)].concat();
                let is_child = self.files.contains_key(&child);
                is_child.then(|| (module.to_vec(), path))
            }
        }
    }
}

/// The shortest circle through every module that is on one, each circle once.
fn circles(level: &Level) -> Vec<Breach> {
    let mut seen = BTreeSet::new();
    let mut breaches = Vec::new();
    for start in level.keys() {
        let Some(circle) = shortest(level, start) else {
            continue;
        };
        if circle.iter().any(|name| seen.contains(name)) {
            continue;
        }
        let uses = circle.iter().zip(circle.iter().cycle().skip(1));
        let uses = uses.map(|(a, b)| format!("{a} uses {b} ({})", level[a][b]));
        breaches.push(Breach {
            place: format!("circle of {} modules", circle.len()),
            wrong: uses.collect::<Vec<_>>().join(", "),
        });
        seen.extend(circle);
    }
    breaches
}

/// The shortest way from a module back to it.
fn shortest<'a>(level: &Level<'a>, start: &'a str) -> Option<Vec<&'a str>> {
    let mut ways: Vec<Vec<&str>> = vec![vec![start]];
    let mut reached = BTreeSet::new();
    let mut next = 0;
    while let Some(way) = ways.get(next).cloned() {
        next += 1;
        let last = way.last().copied()?;
        for &to in level.get(last).into_iter().flat_map(BTreeMap::keys) {
            if to == start {
                return Some(way);
            }
            if reached.insert(to) {
                ways.push([way.as_slice(), &[to]].concat());
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let files: Vec<(PathBuf, &str)> = files
            .iter()
            .map(|(name, text)| (Path::new("c/src").join(name), *text))
            .collect();
        let breaches = breaches(Path::new("c/src"), &files);
        breaches.iter().map(Breach::to_string).collect()
    }

    #[test]
    fn two_files_that_use_each_other_are_refused() {
        let files = [
            ("lib.rs", "mod a;\nmod b;\n"),
            ("a.rs", "use crate::b::B;\npub struct A(B);\n"),
            ("b.rs", "pub struct B;\nfn f(_: &super::a::A) {}\n"),
        ];
        let expected = "circle of 2 modules: a uses b (c/src/a.rs:1), b uses a (c/src/b.rs:2)";
        assert_eq!(found(&files), [expected]);
        assert!(found(&files[..2]).is_empty());
    }

    #[test]
    fn folders_count_as_one_and_parents_and_children_may_use_each_other() {
        let files = [
            ("lib.rs", "mod a;\nmod b;\npub use b::B;\n"),
            ("a.rs", "mod part;\nuse part::Part;\npub struct A(Part);\n"),
            (
                "a/part.rs",
                "use super::A;\nuse crate::B;\npub struct Part;\n",
            ),
            ("b.rs", "pub struct B;\n"),
        ];
        assert!(found(&files).is_empty());
        let mut both = files;
        both[3].1 = "pub struct B;\nuse crate::a::A;\n";
        let expected = "circle of 2 modules: a uses b (c/src/a/part.rs:2), b uses a (c/src/b.rs:2)";
        assert_eq!(found(&both), [expected]);
    }

    #[test]
    fn a_name_counts_for_the_file_that_defines_it() {
        // What `b` takes from its parent is defined beside it, in `c`, which uses `b` not.
        let files = [
            ("lib.rs", "mod p;\n"),
            ("p.rs", "mod b;\nmod c;\npub use c::{C, D as E};\n"),
            ("p/b.rs", "use super::{C, E};\n"),
            ("p/c.rs", "pub struct C;\npub struct D;\n"),
        ];
        assert!(found(&files).is_empty());
        let mut back = files;
        back[3].1 = "use super::b;\npub struct C;\n";
        assert_eq!(found(&back).len(), 1);
    }
}
