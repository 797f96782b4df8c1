//! `striae compare A B`: how the results of two runs differ.
//!
//! Histories are compared at the times that both have, so that runs with other increments can be
//! compared too. A difference counts beside the largest value of its column in either run.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use striae_output::{history::Table, summary::Summary};

use crate::failure::Failure;

/// Times over the last one that are the same.
const SAME: f64 = 1e-9;
/// Least scale of a column over the largest value of all columns that hold the same.
const ROUND_OFF: f64 = 1e-9;

/// Compare two runs: their endings and warnings, and their histories at common times.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of the first run.
    a: PathBuf,
    /// Folder of the second run.
    b: PathBuf,
    /// Difference allowed in a column, relative to its largest value; beyond it, the exit code is 1.
    #[arg(long, alias = "within", value_name = "PART", default_value = "1e-6", value_parser = part)]
    tolerance: f64,
}

/// Difference of a column of the histories.
struct Difference {
    column: String,
    /// Values at the last common time.
    last: [f64; 2],
    /// Largest difference.
    absolute: f64,
    /// Ratio to the largest value of the column.
    relative: f64,
    /// Time of the largest difference.
    time: f64,
}

/// Prints the differences, the largest first.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let folders = [&arguments.a, &arguments.b];
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
    for (name, warnings) in [("A", warned(&one, &other)), ("B", warned(&other, &one))] {
        for warning in warnings {
            writeln!(out, "warning only in {name}: {warning}")?;
        }
    }
    let (times, mut differences) = compared(&first, &second);
    writeln!(out, "common times: {times}")?;
    for (name, only) in [
        ("A", missing(&first, &second)),
        ("B", missing(&second, &first)),
    ] {
        if !only.is_empty() {
            writeln!(out, "only {name} has {}", only.join(", "))?;
        }
    }
    differences.sort_by(|a, b| b.relative.total_cmp(&a.relative));
    write!(out, "{}", listed(&differences))?;
    let verdict = match differences.first() {
        _ if one.status != other.status => Some("only one of them completed".to_owned()),
        _ if times == 0 => Some("they have no common time".to_owned()),
        // What is no number does not agree either.
        Some(worst) if worst.relative > arguments.tolerance || worst.relative.is_nan() => {
            Some(format!(
                "`{}` by {:.1e} of its largest value, but only {:e} is allowed",
                worst.column, worst.relative, arguments.tolerance
            ))
        }
        _ => None,
    };
    match verdict {
        Some(words) => Err(Failure::Differ(words)),
        None => Ok(()),
    }
}

/// Summary and history of a run.
fn read(folder: &Path) -> Result<(Summary, Table), Failure> {
    let summary = Summary::read(&folder.join("summary.json")).map_err(Failure::Given)?;
    let history = Table::read(&folder.join("history.csv")).map_err(Failure::Given)?;
    Ok((summary, history))
}

/// Warnings of a run that another one has not, of the same kind about the same pair.
fn warned<'s>(summary: &'s Summary, other: &Summary) -> Vec<&'s str> {
    let warnings = summary.warnings.iter();
    let only = warnings.filter(|warning| {
        let mut others = other.warnings.iter();
        !others.any(|other| (&other.kind, &other.pair) == (&warning.kind, &warning.pair))
    });
    only.map(|warning| warning.text.as_str()).collect()
}

fn listed(differences: &[Difference]) -> String {
    let width = differences.iter().map(|one| one.column.len()).max();
    let width = width.unwrap_or(0).max(6);
    let mut text = format!(
        "{:<width$}  {:>13}  {:>13}  {:>10}  {:>10}  at time\n",
        "column", "last of A", "last of B", "largest", "relative"
    );
    for one in differences {
        let Difference {
            column,
            last: [a, b],
            absolute,
            relative,
            time,
        } = one;
        text += &format!(
            "{column:<width$}  {a:>13.6e}  {b:>13.6e}  {absolute:>10.1e}  {relative:>10.1e}  {time:.6}\n"
        );
    }
    text
}

/// A part of a whole, or none of it.
fn part(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok();
    let number = number.filter(|number| *number >= 0.0);
    number.ok_or_else(|| "a number of at least 0 is needed, such as 1e-6".to_owned())
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
    let largest = |is_meant: &dyn Fn(&str) -> bool| {
        let same = first.columns.iter().filter(|name| is_meant(name));
        let values = same.flat_map(|name| [first.column(name), second.column(name)]);
        let values = values.flatten().flatten();
        values.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let scale = |name: &str| {
        if name.ends_with("mismatch") {
            // A ratio itself.
            return 1.0;
        }
        let own = largest(&|other| group(other) == group(name));
        let of_kind = largest(&|other| kind(other) == kind(name));
        own.max(ROUND_OFF * of_kind)
    };
    let counts = ["step", "increment", "time", "iterations", "cutbacks"];
    let columns = first.columns.iter();
    let columns = columns.filter(|name| !counts.contains(&name.as_str()));
    let differences = columns.filter_map(|name| {
        let [a, b] = [first.column(name)?, second.column(name)?];
        let scale = scale(name);
        let difference = |(i, j): &(usize, usize)| (a[*i] - b[*j]).abs();
        let worst = rows
            .iter()
            .max_by(|x, y| difference(x).total_cmp(&difference(y)))?;
        let (i, j) = *rows.last()?;
        let absolute = difference(worst);
        Some(Difference {
            column: name.clone(),
            last: [a[i], b[j]],
            absolute,
            relative: match absolute == 0.0 {
                true => 0.0,
                false => absolute / scale,
            },
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

/// Columns of all parts of the model that hold the same: `reaction` of `reaction.block.zmin.x`.
fn kind(column: &str) -> (&str, &str) {
    let group = group(column);
    let (first, rest) = group.split_once('.').unwrap_or((group, ""));
    let last = rest.rsplit_once('.').map_or("", |(_, last)| last);
    match first {
        // Names of parts stand at the end.
        "reaction" | "velocity" => (first, ""),
        _ => (first, last),
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
        assert!(differences.iter().all(|one| one.relative < 1e-14));
    }

    #[test]
    fn what_is_round_off_beside_other_parts_is_no_difference() {
        let columns = [
            "time",
            "reaction.a.x",
            "reaction.b.top.z",
            "pair.p.mismatch",
            "pair.p.gap",
        ];
        let a = table(&columns, &[&[1.0, 1e-16, 5.0, 1e-16, 1e-5]]);
        let b = table(&columns, &[&[1.0, -3e-16, 5.0, 3e-16, 2e-5]]);
        let (_, differences) = compared(&a, &b);
        let differs = differences.iter().filter(|one| one.relative > 1e-6);
        let differs: Vec<&str> = differs.map(|one| one.column.as_str()).collect();
        assert_eq!(differs, ["pair.p.gap"]);
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
        assert!((f.relative - 0.5 / 9.0).abs() < 1e-15);
        assert_eq!(f.absolute, 0.5);
        assert_eq!(missing(&a, &b), ["`g`"]);
    }

    #[test]
    fn what_is_no_number_differs() {
        let a = table(&["time", "f"], &[&[0.5, 1.0], &[1.0, f64::NAN]]);
        let b = table(&["time", "f"], &[&[0.5, 1.0], &[1.0, 2.0]]);
        let (_, differences) = compared(&a, &b);
        assert!(differences[0].relative.is_nan());
        assert!(part("nan").is_err() && part("-1").is_err() && part("0") == Ok(0.0));
    }
}
