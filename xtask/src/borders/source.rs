//! Rules that the text of the sources has to keep.
//!
//! | rule | where |
//! | --- | --- |
//! | files are touched by the crates of input and output only ([`FILE_CRATES`]) | other libraries |
//! | nothing prints | libraries |
//! | no `unwrap`, `panic!`, `todo!`, `dbg!` | all product code |
//! | no unsafe code | everywhere but the bindings to METIS and PETSc |
//! | no word of contact, bodies or friction, not even in a comment | `striae-sparse` |
//! | at most 400 lines, or module docs with a line `//! Longer than other files, ...` | every file |

use std::path::{Component, Path};

use super::text::product_lines;
use crate::breach::Breach;

/// Place of a source file in the workspace.
pub struct Place {
    path: String,
    layer: Layer,
    code: Code,
    /// `true` if its crate is general and must not name what it serves here.
    is_general: bool,
}

/// Access of a crate to the outside world.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Layer {
    /// Neither touches files nor prints.
    Pure,
    /// Touches files.
    Files,
    /// Touches files and prints.
    Program,
}

/// Purpose of a file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Code {
    /// The library or the program.
    Product,
    /// Tests, examples and benchmarks.
    Test,
}

impl Place {
    /// A file of a crate, by its path within the workspace.
    pub fn new(package: &str, path: &Path, code: Code) -> Self {
        Self {
            path: path.display().to_string(),
            layer: match package {
                // Build scripts speak to cargo by printing.
                _ if path.ends_with("build.rs") => Layer::Program,
                "striae-cli" | "striae-bench" | "striae-mutants" | "xtask" => Layer::Program,
                name if FILE_CRATES.contains(&name) => Layer::Files,
                _ => Layer::Pure,
            },
            code,
            is_general: package == "striae-sparse",
        }
    }

    fn breach(&self, line: usize, wrong: impl Into<String>) -> Breach {
        Breach {
            place: format!("{}:{line}", self.path),
            wrong: wrong.into(),
        }
    }
}

impl Code {
    /// Purpose of a file, from its folder (`tests` or the like) or its crate.
    pub fn of(package: &str, path: &Path) -> Self {
        const FOLDERS: [&str; 3] = ["tests", "examples", "benches"];
        let in_folder = |component: Component| {
            FOLDERS
                .map(|name| Component::Normal(name.as_ref()))
                .contains(&component)
        };
        if package == "striae-verify" || path.components().any(in_folder) {
            Self::Test
        } else {
            Self::Product
        }
    }
}

/// Crates that read or write files.
const FILE_CRATES: [&str; 7] = [
    "striae-cases",
    "striae-deck",
    "striae-figure",
    "striae-files",
    "striae-meshfile",
    "striae-output",
    "striae-report",
];
const FILES: [&str; 4] = ["std::fs", "std::io", "File::open", "File::create"];
const PRINTS: [&str; 4] = ["println!", "print!", "io::stdout", "io::stderr"];
const PANICS: [&str; 5] = [".unwrap()", "panic!(", "todo!(", "unimplemented!(", "dbg!("];
const UNSAFE: [&str; 4] = ["unsafe {", "unsafe fn", "unsafe impl", "allow(unsafe_code)"];
/// A file and a folder that may have unsafe code.
const BINDINGS: [&str; 2] = [
    "crates/striae-sparse/src/metis.rs",
    "crates/striae-petsc/src/binding/",
];
/// Words that a general crate does not know, in singular and plural.
const FOREIGN: [&str; 6] = [
    "contact",
    "contacts",
    "body",
    "bodies",
    "friction",
    "frictions",
];
const LONG: usize = 400;
const REASON: &str = "//! Longer than other files, ";

/// Rules that a file breaks.
pub fn breaches(place: &Place, text: &str) -> Vec<Breach> {
    // This file spells out what it looks for.
    if place.path.ends_with("xtask/src/borders/source.rs") {
        return Vec::new();
    }
    let mut found = Vec::new();
    found.extend(too_long(place, text));
    if place.is_general {
        found.extend(foreign_words(place, text));
    }
    for (number, line) in product_lines(text) {
        for wrong in wrongs(place, line) {
            found.push(place.breach(number, wrong));
        }
    }
    found
}

fn wrongs(place: &Place, line: &str) -> Vec<&'static str> {
    let has = |words: &[&str]| words.iter().any(|word| line.contains(word));
    let mut wrongs = Vec::new();
    let is_binding = BINDINGS.iter().any(|path| place.path.starts_with(path));
    if !is_binding && has(&UNSAFE) {
        wrongs.push("unsafe code outside the bindings to METIS and PETSc");
    }
    if place.code == Code::Test {
        return wrongs;
    }
    if has(&PANICS) {
        wrongs.push("product code must not panic; use an error, or `expect` for an invariant");
    }
    if place.layer == Layer::Pure && has(&FILES) {
        wrongs.push("only the crates of input and output touch files");
    }
    if place.layer != Layer::Program && has(&PRINTS) {
        wrongs.push("nothing below the program prints");
    }
    wrongs
}

fn foreign_words(place: &Place, text: &str) -> Vec<Breach> {
    let is_foreign = |word: &str| FOREIGN.contains(&word.to_lowercase().as_str());
    let lines = text.lines().zip(1..);
    let found = lines.flat_map(|(line, number)| {
        let words = line.split(|c: char| !c.is_alphabetic());
        words
            .filter(|word| is_foreign(word))
            .map(move |word| (number, word))
    });
    found
        .map(|(number, word)| place.breach(number, format!("`{word}` in a general crate")))
        .collect()
}

fn too_long(place: &Place, text: &str) -> Option<Breach> {
    let count = text.lines().count();
    let excused = text.lines().any(|line| line.starts_with(REASON));
    (count > LONG && !excused).then(|| {
        let wrong = format!("{count} lines; split it or give a line `{REASON}...`");
        place.breach(count, wrong)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(package: &str, path: &str, text: &str) -> Vec<String> {
        let path = Path::new(path);
        let place = Place::new(package, path, Code::of(package, path));
        let breaches = breaches(&place, text);
        breaches.iter().map(Breach::to_string).collect()
    }

    #[test]
    fn only_input_output_and_the_program_touch_files() {
        let text = "use std::fs::read;\n";
        let pure = found("striae-mesh", "crates/striae-mesh/src/mesh.rs", text);
        assert_eq!(
            pure,
            ["crates/striae-mesh/src/mesh.rs:1: only the crates of input and output touch files"]
        );
        assert!(found("striae-output", "crates/striae-output/src/lib.rs", text).is_empty());
        assert!(found("striae-cli", "crates/striae-cli/src/main.rs", text).is_empty());
        assert!(found("striae-mesh", "crates/striae-mesh/tests/files.rs", text).is_empty());
    }

    #[test]
    fn only_the_program_prints() {
        let text = "fn f() {\n    eprintln!(\"here\");\n}\n";
        assert_eq!(
            found("striae-output", "crates/striae-output/src/a.rs", text).len(),
            1
        );
        assert!(found("striae-cli", "crates/striae-cli/src/a.rs", text).is_empty());
    }

    #[test]
    fn product_code_does_not_panic_but_tests_may() {
        let text = "fn f() {\n    g().unwrap();\n}\n";
        assert_eq!(
            found("striae-cli", "crates/striae-cli/src/a.rs", text).len(),
            1
        );
        let tests = "crates/striae-law/src/friction/tests/laws.rs";
        assert!(found("striae-law", tests, text).is_empty());
    }

    #[test]
    fn unsafe_code_stays_in_the_bindings() {
        let text = "#![allow(unsafe_code)]\nfn f() {\n    unsafe { g() }\n}\n";
        assert!(found("striae-sparse", BINDINGS[0], text).is_empty());
        let ffi = "crates/striae-petsc/src/binding/ffi.rs";
        assert!(found("striae-petsc", ffi, text).is_empty());
        let elsewhere = found("striae-sparse", "crates/striae-sparse/tests/a.rs", text);
        assert_eq!(elsewhere.len(), 2);
    }

    #[test]
    fn general_crates_know_no_words_of_mechanics() {
        let text = "//! Factors of bodies.\nfn of_contact() {} // nobody\nstruct Contact;\n";
        let path = "crates/striae-sparse/src/a.rs";
        let words = ["1: `bodies`", "2: `contact`", "3: `Contact`"];
        let expected = words.map(|word| format!("{path}:{word} in a general crate"));
        assert_eq!(found("striae-sparse", path, text), expected);
        assert!(found("striae-condensed", path, text).is_empty());
    }

    #[test]
    fn long_files_owe_a_reason() {
        let path = "crates/striae-law/src/a.rs";
        let line = "const A: f64 = 1.0;\n";
        assert!(found("striae-law", path, &line.repeat(LONG)).is_empty());
        assert_eq!(found("striae-law", path, &line.repeat(LONG + 1)).len(), 1);
        let excused = format!("{REASON}as it is one table.\n{}", line.repeat(LONG));
        assert!(found("striae-law", path, &excused).is_empty());
    }
}
