//! Content of a results folder: names and bytes, and whether files are complete.

use std::{
    collections::BTreeMap,
    fs, io,
    path::{Path, PathBuf},
};

use serde_json::Value;

/// Returns whether an entry of `summary.json` differs from run to run.
fn is_own(name: &str) -> bool {
    name.ends_with("_s") || name == "peak_rss_mib"
}

/// All files below a folder with their bytes.
pub fn files(folder: &Path) -> io::Result<BTreeMap<PathBuf, Vec<u8>>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(within) = folders.pop() {
        for entry in fs::read_dir(&within)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap_or(&path).to_owned();
                let bytes = fs::read(&path)?;
                files.insert(name, comparable(&path, bytes));
            }
        }
    }
    Ok(files)
}

/// The bytes of a file, without what differs from run to run.
fn comparable(path: &Path, bytes: Vec<u8>) -> Vec<u8> {
    if !path.ends_with("summary.json") {
        return bytes;
    }
    match serde_json::from_slice::<Value>(&bytes) {
        Ok(Value::Object(mut summary)) => {
            summary.retain(|name, _| !is_own(name));
            if let Some(Value::Object(solver)) = summary.get_mut("solver") {
                solver.retain(|name, _| !is_own(name));
            }
            Value::Object(summary).to_string().into_bytes()
        }
        _ => bytes,
    }
}

/// In what two folders differ.
pub fn differences(
    found: &BTreeMap<PathBuf, Vec<u8>>,
    expected: &BTreeMap<PathBuf, Vec<u8>>,
) -> Vec<String> {
    let missing = expected.keys().filter(|name| !found.contains_key(*name));
    let missing = missing.map(|name| format!("{} is missing", name.display()));
    let wrong = found.iter().filter_map(|(name, bytes)| {
        let name = name.display();
        match expected.get(Path::new(&name.to_string())) {
            None => Some(format!("{name} is left over")),
            Some(right) if right != bytes => Some(format!("{name} differs")),
            Some(_) => None,
        }
    });
    missing.chain(wrong).collect()
}

/// Broken files in the folder of a run that was killed: each file that a collection names must
/// exist and be complete, and so must each row of the history except the last.
pub fn broken(files: &BTreeMap<PathBuf, Vec<u8>>) -> Vec<String> {
    let mut broken = Vec::new();
    for (name, bytes) in files {
        let text = String::from_utf8_lossy(bytes);
        let end = name.extension().unwrap_or_default().to_string_lossy();
        match &*end {
            "pvd" => {
                let named = text.split("file=\"").skip(1);
                let named = named.filter_map(|rest| rest.split('"').next());
                let lost = named.filter(|file| !files.contains_key(Path::new(file)));
                broken.extend(lost.map(|file| format!("{} names {file}", name.display())));
            }
            "vtu" if !text.trim_end().ends_with("</VTKFile>") => {
                broken.push(format!("{} has no end", name.display()));
            }
            "csv" => {
                let cells: Vec<usize> = text.lines().map(|row| row.split(',').count()).collect();
                let whole = cells
                    .len()
                    .saturating_sub(usize::from(!text.ends_with('\n')));
                if cells[..whole].windows(2).any(|two| two[0] != two[1]) {
                    broken.push(format!("{} has broken rows", name.display()));
                }
            }
            _ => {}
        }
    }
    broken
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(files: &[(&str, &str)]) -> BTreeMap<PathBuf, Vec<u8>> {
        let own = |(name, text): &(&str, &str)| (PathBuf::from(name), text.as_bytes().to_vec());
        files.iter().map(own).collect()
    }

    #[test]
    fn differences_are_named() {
        let expected = folder(&[("a", "1"), ("b", "2"), ("c", "3")]);
        let found = folder(&[("b", "2"), ("c", "4"), ("d", "5")]);
        assert_eq!(
            differences(&found, &expected),
            ["a is missing", "c differs", "d is left over"]
        );
        assert!(differences(&expected, &expected).is_empty());
    }

    #[test]
    fn what_is_broken_is_told_but_a_last_row_may_be_cut() {
        let whole = folder(&[
            ("bodies.pvd", "<DataSet file=\"fields/a.vtu\"/>"),
            ("fields/a.vtu", "<VTKFile>\n</VTKFile>\n"),
            ("history.csv", "a,b\n1,2\n3"),
        ]);
        assert!(broken(&whole).is_empty());
        let cut = folder(&[
            ("bodies.pvd", "<DataSet file=\"fields/b.vtu\"/>"),
            ("fields/a.vtu", "<VTKFile>\n"),
            ("history.csv", "a,b\n1\n3,4\n"),
        ]);
        assert_eq!(broken(&cut).len(), 3);
    }

    #[test]
    fn times_of_a_summary_do_not_count() {
        let text = |wall: &str| format!("{{\"wall_s\": {wall}, \"status\": \"completed\"}}");
        let read = |wall| comparable(Path::new("summary.json"), text(wall).into_bytes());
        assert_eq!(read("1.5"), read("2.5"));
    }
}
