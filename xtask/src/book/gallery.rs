//! The gallery: every case with a picture of its run, a figure, and its results beside known
//! values.
//!
//! ```text
//! striae reproduce CASE -> results -> striae picture -> docs/book/gallery/CASE.png
//!                                  -> figure         -> docs/book/gallery/CASE.svg
//!                                  -> quantities.csv -> docs/book/gallery/CASE.csv
//! kept CSV of all cases -> docs/book/gallery/README.md
//! ```
//!
//! The gallery is kept in the repository, so the book has all pictures without a run.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use super::{
    exhibits::{EXHIBITS, Exhibit},
    run,
};
use crate::fault::Fault;

/// Folder of the gallery.
const FOLDER: &str = "docs/book/gallery";

/// Address of the cases for readers; the book does not contain them.
const CASES: &str = "https://github.com/striae/striae/tree/main/cases";

/// Quantities of a case that are shown; the others are in the file.
const SHOWN: usize = 8;

/// Part of the cases that is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Cases as `striae reproduce --quick` runs them.
    Quick,
    /// Everything, for hours.
    All,
}

/// Runs all cases into a folder.
///
/// # Errors
/// When a case cannot be run or does not give what is known of it.
pub fn reproduce(program: &Path, extent: Extent, results: &Path) -> Result<(), Fault> {
    for exhibit in &EXHIBITS {
        let mut command = Command::new(program);
        command
            .args(["reproduce", exhibit.case, "--out"])
            .arg(results);
        if extent == Extent::Quick {
            command.arg("--quick");
        }
        run(&mut command)?;
    }
    Ok(())
}

/// Makes pictures, figures and tables of the cases whose results are in a folder, and the
/// page of all.
///
/// # Errors
/// When a picture cannot be made or a file not be read or written.
pub fn make(program: &Path, results: &Path) -> Result<(), Fault> {
    fs::create_dir_all(FOLDER).map_err(unreadable(Path::new(FOLDER)))?;
    for exhibit in &EXHIBITS {
        let folder = results.join(exhibit.case);
        if !folder.join("quantities.csv").exists() {
            println!("{}: not run, its picture stays", exhibit.case);
            continue;
        }
        copy(&folder.join("quantities.csv"), &kept(exhibit, "csv"))?;
        if let Some(name) = exhibit.figure {
            copy(&folder.join(format!("{name}.svg")), &kept(exhibit, "svg"))?;
        }
        if let Some(of) = exhibit.run {
            let mut picture = Command::new(program);
            picture.arg("picture").arg(folder.join(of));
            picture
                .args(exhibit.options)
                .args(["--width", "720", "--out"]);
            run(picture.arg(kept(exhibit, "png")))?;
        }
    }
    let path = Path::new(FOLDER).join("README.md");
    fs::write(&path, page()?).map_err(unreadable(&path))
}

/// The page from what is kept.
fn page() -> Result<String, Fault> {
    let mut page = String::from(
        "# Gallery\n\nEvery case that `striae reproduce` knows, with a picture of its run and \
         what came out beside what is known of it. `cargo xtask book --run` runs the cases \
         (with `--all` in full, which takes hours), draws the pictures with `striae picture` \
         and rewrites this page.\n",
    );
    for exhibit in &EXHIBITS {
        page += &section(exhibit)?;
    }
    Ok(page)
}

/// A case on the page.
fn section(exhibit: &Exhibit) -> Result<String, Fault> {
    let case = exhibit.case;
    let mut text = format!("\n## {case}\n\n{}\n", exhibit.caption);
    for (end, what) in [("png", "picture"), ("svg", "figure")] {
        if kept(exhibit, end).exists() {
            text += &format!("\n![{case}: {what}]({case}.{end})\n");
        }
    }
    let path = kept(exhibit, "csv");
    if path.exists() {
        let table = fs::read_to_string(&path).map_err(unreadable(&path))?;
        text += &values(exhibit, &table)?;
    }
    text += &format!("\nThe case: [cases/{case}]({CASES}/{case}).\n");
    Ok(text)
}

/// Computed values beside known ones, from the table of a case.
fn values(exhibit: &Exhibit, table: &str) -> Result<String, Fault> {
    let case = exhibit.case;
    let rows: Vec<Vec<String>> = table.lines().skip(1).map(cells).collect();
    let mut text =
        String::from("\n| quantity | computed | known | source |\n| --- | --- | --- | --- |\n");
    for row in rows.iter().take(SHOWN) {
        let [quantity, unit, computed, least, largest, _, _, source, _] = &row[..] else {
            return Err(Fault::Book(format!("{case}: {row:?}")));
        };
        let computed = format!("{} {unit}", round(computed));
        let known = range(least, largest);
        text += &format!(
            "| `{quantity}` | {} | {known} | {source} |\n",
            computed.trim_end()
        );
    }
    if rows.len() > SHOWN {
        let more = rows.len() - SHOWN;
        text += &format!("\n{more} more are in [the table]({case}.csv).\n");
    }
    let run = rows.first().and_then(|row| row.last());
    if let Some(what) = run.and_then(|run| run.strip_prefix("quick: ")) {
        text += &format!(
            "\nPicture, figure and values are of a quick run: {what}. The ranges hold for it, too; \
             `striae reproduce {case}` runs all.\n"
        );
    }
    Ok(text)
}

/// The cells of a line, some of which stand in quotes.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for letter in line.chars() {
        match letter {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            // What a table of Markdown would take for the end of a cell.
            '|' => cells.last_mut().expect("there is one").push_str("\\|"),
            other => cells.last_mut().expect("there is one").push(other),
        }
    }
    cells
}

/// Range of a value, in words.
fn range(least: &str, largest: &str) -> String {
    match (least, largest) {
        ("-inf", most) => format!("at most {}", round(most)),
        (least, "inf") => format!("at least {}", round(least)),
        (least, largest) => format!("{} to {}", round(least), round(largest)),
    }
}

/// A number with five digits.
fn round(text: &str) -> String {
    let Ok(number) = text.parse::<f64>() else {
        return text.to_owned();
    };
    let size = number.abs();
    if number == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{number:.2e}");
    }
    let decimals = (4 - size.log10().floor() as i32).max(0) as usize;
    let text = format!("{number:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn kept(exhibit: &Exhibit, end: &str) -> PathBuf {
    Path::new(FOLDER).join(format!("{}.{end}", exhibit.case))
}

fn copy(from: &Path, to: &Path) -> Result<(), Fault> {
    fs::copy(from, to).map(|_| ()).map_err(unreadable(from))
}

fn unreadable(path: &Path) -> impl Fn(std::io::Error) -> Fault {
    let path = path.to_owned();
    move |cause| Fault::Unreadable {
        path: path.clone(),
        cause,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decks of `cargo xtask suite`, which has a page of its own.
    const FOREIGN: &str = "foreign";

    #[test]
    fn numbers_and_ranges_read_well() {
        let found = ["15514.744714", "0.30000001", "1.2e-11", "0", "1e7", "2"].map(round);
        assert_eq!(found, ["15515", "0.3", "1.20e-11", "0", "1.00e7", "2"]);
        assert_eq!(range("-inf", "0.01"), "at most 0.01");
        assert_eq!(range("1", "2.5"), "1 to 2.5");
    }

    #[test]
    fn commas_in_quotes_are_no_ends_of_cells() {
        assert_eq!(cells("a,\"b, c\",|d|"), ["a", "b, c", "\\|d\\|"]);
    }

    #[test]
    fn every_case_is_in_the_gallery_with_a_picture() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        for entry in fs::read_dir(root.join("cases")).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            if name == FOREIGN {
                continue;
            }
            let exhibit = EXHIBITS.iter().find(|exhibit| exhibit.case == name);
            let exhibit = exhibit.unwrap_or_else(|| panic!("{name} is not in the gallery"));
            let picture = if exhibit.run.is_some() { "png" } else { "svg" };
            assert!(
                root.join(kept(exhibit, picture)).exists(),
                "{name} has no picture"
            );
        }
    }
}
