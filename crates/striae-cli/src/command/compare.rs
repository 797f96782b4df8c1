//! `striae compare A B`: how the results of two runs differ.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use striae_output::{history::Table, summary::Summary};

use crate::failure::Failure;

/// Times over the last one that are the same.
const SAME: f64 = 1e-9;

/// Compare two runs: their endings, and their histories at the times that both have.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of the first run.
    a: PathBuf,
    /// Folder of the second run.
    b: PathBuf,
    /// End with exit code 1 if a column differs by more than this part of its largest value.
    #[arg(long, value_name = "PART")]
    within: Option<f64>,
}

/// How a column of the histories differs.
struct Difference {
    column: String,
    /// Values at the last common time.
    last: [f64; 2],
    /// Largest difference over the largest value of the column.
    largest: f64,
    /// When that is.
    time: f64,
}

/// Prints the differences, the largest first.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let folders = [&arguments.a, &arguments.b];
    let read = |folder: &Path| -> Result<(Summary, Table), Failure> {
        let summary = Summary::read(&folder.join("summary.json"))?;
        Ok((summary, Table::read(&folder.join("history.csv"))?))
    };
    let [(one, first), (other, second)] = [read(folders[0])?, read(folders[1])?];
    for (folder, summary) in folders.into_iter().zip([&one, &other]) {
        writeln!(
            out,
            "{}: {}; increments {}, cut back {}, Newton iterations {}, warnings {}",
            folder.display(),
            summary.reason,
            summary.increments,
            summary.cutbacks,
            summary.newton_total,
            summary.warnings.len()
        )?;
    }
    let (times, mut differences) = compared(&first, &second);
    writeln!(out, "times that both have: {times}")?;
    for (name, only) in [
        ("A", missing(&first, &second)),
        ("B", missing(&second, &first)),
    ] {
        if !only.is_empty() {
            writeln!(out, "only {name} has {}", only.join(", "))?;
        }
    }
    differences.sort_by(|a, b| b.largest.total_cmp(&a.largest));
    let width = differences.iter().map(|one| one.column.len()).max();
    let width = width.unwrap_or(0).max(6);
    writeln!(
        out,
        "{:<width$}  {:>13}  {:>13}  {:>10}  at time",
        "column", "last of A", "last of B", "difference"
    )?;
    for one in &differences {
        let Difference {
            column,
            last: [a, b],
            largest,
            time,
        } = one;
        writeln!(
            out,
            "{column:<width$}  {a:>13.6e}  {b:>13.6e}  {largest:>10.1e}  {time:.6}"
        )?;
    }
    let worst = differences.first().map_or(0.0, |one| one.largest);
    match arguments
        .within
        .filter(|within| worst > *within || times == 0)
    {
        Some(within) => Err(Failure::Differ { worst, within }),
        None => Ok(()),
    }
}

/// Columns that only the first table has.
fn missing(table: &Table, other: &Table) -> Vec<String> {
    let columns = table.columns.iter();
    let missing = columns.filter(|name| !other.columns.contains(name));
    missing.map(|name| format!("`{name}`")).collect()
}

/// Number of common times, and the differences of all common columns of results.
fn compared(first: &Table, second: &Table) -> (usize, Vec<Difference>) {
    let times = [first, second].map(|table| table.column("time").unwrap_or_default());
    let end = times[0].last().copied().unwrap_or(0.0).abs();
    let near = |time: f64| {
        let mut all = times[1].iter();
        all.position(|other| (other - time).abs() <= SAME * end)
    };
    let rows = times[0].iter().enumerate();
    let rows: Vec<(usize, usize)> = rows
        .filter_map(|(at, time)| Some((at, near(*time)?)))
        .collect();
    let scale = |of: &str| {
        let same = first.columns.iter().filter(|name| group(name) == of);
        let values = same.flat_map(|name| [first.column(name), second.column(name)]);
        let values = values.flatten().flatten();
        values.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let counts = ["step", "increment", "time", "iterations", "cutbacks"];
    let columns = first.columns.iter();
    let columns = columns.filter(|name| !counts.contains(&name.as_str()));
    let differences = columns.filter_map(|name| {
        let [a, b] = [first.column(name)?, second.column(name)?];
        let scale = scale(group(name));
        let part = |(i, j): &(usize, usize)| match scale > 0.0 {
            true => (a[*i] - b[*j]).abs() / scale,
            false => 0.0,
        };
        let worst = rows.iter().max_by(|x, y| part(x).total_cmp(&part(y)))?;
        let (i, j) = *rows.last()?;
        Some(Difference {
            column: name.clone(),
            last: [a[i], b[j]],
            largest: part(worst),
            time: times[0][worst.0],
        })
    });
    (rows.len(), differences.collect())
}

/// Columns that are judged by the largest value of all of them: components of a vector, so
/// that round-off across a force is no difference, and energies.
fn group(column: &str) -> &str {
    match column.rsplit_once('.') {
        _ if column.starts_with("energy.") => "energy.",
        Some((vector, "x" | "y" | "z")) => vector,
        _ => column,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(columns: &[&str], rows: &[&[f64]]) -> Table {
        Table {
            columns: columns.iter().map(|name| (*name).to_owned()).collect(),
            rows: rows.iter().map(|row| row.to_vec()).collect(),
        }
    }

    #[test]
    fn round_off_across_a_force_is_no_difference() {
        let columns = ["time", "force.x", "force.z"];
        let a = table(&columns, &[&[1.0, 1e-16, 2.0]]);
        let b = table(&columns, &[&[1.0, -3e-15, 2.0]]);
        let (_, differences) = compared(&a, &b);
        assert!(differences.iter().all(|one| one.largest < 1e-14));
    }

    #[test]
    fn histories_are_compared_at_common_times() {
        let a = table(&["time", "f", "g"], &[&[0.5, 1.0, 3.0], &[1.0, 2.0, 3.0]]);
        let b = table(&["time", "f"], &[&[0.25, 9.0], &[0.5, 1.5], &[1.0, 2.0]]);
        let (times, differences) = compared(&a, &b);
        assert_eq!(times, 2);
        let [f] = &differences[..] else {
            panic!("one common column");
        };
        assert_eq!((f.column.as_str(), f.last, f.time), ("f", [2.0, 2.0], 0.5));
        assert!((f.largest - 0.5 / 9.0).abs() < 1e-15);
        assert_eq!(missing(&a, &b), ["`g`"]);
    }
}
