//! The part of a source file that is product code.
//!
//! Comments do not count, nor does what follows `#[cfg(test)]` on a module with
//! a body: such a module is the last item of its file. `#[cfg(test)] mod NAME;`
//! makes another file a test.

use std::path::{Path, PathBuf};

/// Lines of product code with their numbers, from 1, without comments.
pub fn product_lines(text: &str) -> Vec<(usize, &str)> {
    let lines: Vec<&str> = text.lines().collect();
    let tests = (0..lines.len()).find(|&at| opens_tests(&lines[at..]));
    lines[..tests.unwrap_or(lines.len())]
        .iter()
        .enumerate()
        .map(|(index, line)| (index + 1, without_comment(line)))
        .filter(|(_, line)| !line.trim().is_empty())
        .collect()
}

/// Files that a source file declares to be tests.
pub fn test_files(path: &Path, text: &str) -> Vec<PathBuf> {
    let own_folder = ["mod", "lib", "main"]
        .iter()
        .any(|stem| path.file_stem().is_some_and(|name| name == *stem));
    let folder = if own_folder {
        path.with_file_name("")
    } else {
        path.with_extension("")
    };
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    lines
        .windows(2)
        .filter(|pair| pair[0] == "#[cfg(test)]")
        .filter_map(|pair| pair[1].strip_prefix("mod ")?.strip_suffix(';'))
        .map(|name| folder.join(name).with_extension("rs"))
        .collect()
}

fn opens_tests(lines: &[&str]) -> bool {
    lines[0].trim() == "#[cfg(test)]"
        && lines.get(1).is_some_and(|next| {
            next.trim_start().starts_with("mod ") && next.trim_end().ends_with('{')
        })
}

/// The line up to `//`, unless that stands in a text such as an address.
fn without_comment(line: &str) -> &str {
    let comment = line
        .match_indices("//")
        .find(|(at, _)| line[..*at].matches('"').count().is_multiple_of(2));
    comment.map_or(line, |(at, _)| &line[..at])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_inline_tests_do_not_count() {
        let text = "//! Docs.\nfn a() {} // why\n\n#[cfg(test)]\nmod tests {\n    fn b() {}\n}\n";
        assert_eq!(product_lines(text), [(2, "fn a() {} ")]);
    }

    #[test]
    fn tests_in_another_file_end_nothing() {
        let text = "#[cfg(test)]\nmod tests;\nfn a() {}\n";
        assert_eq!(product_lines(text).len(), 3);
    }

    #[test]
    fn declared_test_files_stand_beside_or_below() {
        let text = "#[cfg(test)]\nmod decode;\nmod grid;\n";
        let files = |path: &str| test_files(Path::new(path), text);
        assert_eq!(
            files("src/vtk/mod.rs"),
            [PathBuf::from("src/vtk/decode.rs")]
        );
        assert_eq!(
            files("src/graph.rs"),
            [PathBuf::from("src/graph/decode.rs")]
        );
    }

    #[test]
    fn addresses_in_texts_are_no_comments() {
        let text = "let a = \"https://example.org\"; // see\n";
        assert_eq!(
            product_lines(text),
            [(1, "let a = \"https://example.org\"; ")]
        );
    }
}
