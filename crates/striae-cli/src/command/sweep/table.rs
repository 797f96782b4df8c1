//! The table of a sweep: the numbers that vary, how each run ended, and the end of its history.

use striae_files::quoted;
use striae_output::{
    history,
    summary::{Status, Summary},
};

use super::{members::Member, runs::Outcome};

/// Columns of a history that the terminal shows, by the end of their names.
const SHOWN: [&str; 3] = [".x", ".y", ".z"];
/// Column that says why a run did not complete.
const REASON: &str = "reason";

/// Names of columns and rows of texts.
pub(super) struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Columns of the numbers that vary, the ending, the increments and the warnings.
    leading: usize,
}

impl Table {
    /// Table of the runs and what came of them.
    pub(super) fn of(members: &[Member], outcomes: &[Outcome]) -> Self {
        let mut columns: Vec<String> = Vec::new();
        let mut rows = Vec::new();
        let mut leading = 0;
        for (member, outcome) in members.iter().zip(outcomes) {
            let (row, first) = row(member, outcome);
            leading = first;
            for (name, _) in &row {
                if !columns.contains(name) {
                    columns.push(name.clone());
                }
            }
            rows.push(row);
        }
        // Runs that got nowhere have no history, and the reason stays the last column.
        columns.sort_by_key(|name| name == REASON);
        let ordered = |row: Vec<(String, String)>| {
            let value = |name: &String| {
                let found = row.iter().find(|(known, _)| known == name);
                found.map_or(String::new(), |(_, value)| value.clone())
            };
            columns.iter().map(value).collect()
        };
        Self {
            rows: rows.into_iter().map(ordered).collect(),
            columns,
            leading,
        }
    }

    /// All columns, separated by commas.
    pub(super) fn csv(&self) -> String {
        let all = std::iter::once(&self.columns).chain(&self.rows);
        let line = |row: &Vec<String>| {
            let cells: Vec<String> = row.iter().map(|cell| quoted(cell)).collect();
            cells.join(",") + "\n"
        };
        all.map(line).collect()
    }

    /// The numbers that vary, the endings and the forces of pairs that have one, for a terminal.
    pub(super) fn text(&self) -> String {
        let is_force = |name: &str| {
            let force = name.contains("resultant_a");
            force && SHOWN.iter().any(|ending| name.ends_with(ending))
        };
        // Of contact of everything most pairs never touch.
        let is_felt = |at: usize| {
            let pair = self.columns[at].rsplit_once('.').map(|(pair, _)| pair);
            let component = |name: &String| name.rsplit_once('.').map(|(pair, _)| pair) == pair;
            let components = (0..self.columns.len()).filter(|&at| component(&self.columns[at]));
            let mut cells = components.flat_map(|at| self.rows.iter().map(move |row| &row[at]));
            cells.any(|cell| cell.parse::<f64>().is_ok_and(|value| value != 0.0))
        };
        let shown: Vec<usize> = (0..self.columns.len())
            .filter(|&at| at < self.leading || is_force(&self.columns[at]) && is_felt(at))
            .collect();
        let short = |at: usize, text: &str| match text.parse::<f64>() {
            Ok(value) if at >= self.leading => format!("{value:.5e}"),
            _ => text.to_owned(),
        };
        let rows: Vec<Vec<String>> = std::iter::once(&self.columns)
            .chain(&self.rows)
            .map(|row| shown.iter().map(|&at| short(at, &row[at])).collect())
            .collect();
        let width = |column: usize| rows.iter().map(|row| row[column].len()).max();
        let widths: Vec<usize> = (0..shown.len()).filter_map(width).collect();
        let line = |row: &Vec<String>| {
            let cells = row.iter().zip(&widths);
            let cells: Vec<String> = cells
                .map(|(cell, &width)| format!("{cell:>width$}"))
                .collect();
            cells.join("  ") + "\n"
        };
        rows.iter().map(line).collect()
    }
}

/// Cells of a run by the names of their columns, and how many lead.
fn row(member: &Member, outcome: &Outcome) -> (Vec<(String, String)>, usize) {
    let varied = member.varied.iter();
    let mut row: Vec<(String, String)> = varied
        .map(|setting| (setting.name().to_owned(), setting.value().to_string()))
        .collect();
    // Results in the folder of a run that has not begun, or was refused, are not its own.
    let is_own = !matches!(outcome, Outcome::Waiting) && !outcome.is_refused();
    let read = |folder: &std::path::Path| Summary::read(&folder.join("summary.json")).ok();
    let summary = is_own.then(|| read(&member.folder)).flatten();
    let reason = match (outcome, &summary) {
        (Outcome::Failed { .. }, Some(summary)) if summary.status == Status::Stopped => {
            summary.reason.clone()
        }
        (Outcome::Failed { reason, .. }, _) => reason.clone(),
        _ => String::new(),
    };
    let count = |of: fn(&Summary) -> usize| {
        let summary = summary.as_ref();
        summary.map_or(String::new(), |summary| of(summary).to_string())
    };
    for (name, cell) in [
        ("status", status(outcome, summary.as_ref()).to_owned()),
        ("increments", count(|summary| summary.increments)),
        ("warnings", count(|summary| summary.warnings.len())),
    ] {
        row.push((name.to_owned(), cell));
    }
    let leading = row.len();
    if is_own
        && let Ok(table) = history::Table::read(&member.folder.join("history.csv"))
        && let Some(last) = table.rows.last()
    {
        let values = table.columns.iter().zip(last);
        row.extend(values.map(|(name, value)| (name.clone(), value.to_string())));
    }
    row.push((REASON.to_owned(), reason));
    (row, leading)
}

fn status(outcome: &Outcome, summary: Option<&Summary>) -> &'static str {
    match (outcome, summary) {
        (Outcome::Waiting, _) => "not run",
        (Outcome::Done, _) => "completed",
        (outcome, _) if outcome.is_refused() => "refused",
        (outcome, _) if outcome.is_interrupted() => "interrupted",
        (_, Some(summary)) if summary.status == Status::Stopped => "stopped",
        _ => "failed",
    }
}
