//! The table of a sweep: parameters, how each run ended, and the end of its history.

use std::path::Path;

use striae_deck::Setting;
use striae_output::{history, summary::Summary};

/// Columns of a history that the terminal shows, by the end of their names.
const SHOWN: [&str; 3] = [".x", ".y", ".z"];

/// Names of columns and rows of texts.
pub(super) struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Columns of the parameters, the ending and the warnings.
    leading: usize,
}

impl Table {
    /// Table of runs with these settings in these folders.
    pub(super) fn of<'a>(runs: impl Iterator<Item = (&'a [Setting], &'a Path)>) -> Self {
        let mut columns: Vec<String> = Vec::new();
        let mut rows = Vec::new();
        let mut leading = 0;
        for (settings, folder) in runs {
            let mut row: Vec<(String, String)> = settings
                .iter()
                .map(|setting| (setting.name().to_owned(), setting.value().to_string()))
                .collect();
            let summary = Summary::read(&folder.join("summary.json"));
            let (status, warnings) = match &summary {
                Ok(summary) => (
                    format!("{:?}", summary.status).to_lowercase(),
                    summary.warnings.len().to_string(),
                ),
                Err(_) => ("failed".to_owned(), String::new()),
            };
            row.push(("status".to_owned(), status));
            row.push(("warnings".to_owned(), warnings));
            leading = row.len();
            if let Ok(table) = history::Table::read(&folder.join("history.csv"))
                && let Some(last) = table.rows.last()
            {
                let values = table.columns.iter().zip(last);
                row.extend(values.map(|(name, value)| (name.clone(), value.to_string())));
            }
            for (name, _) in &row {
                if !columns.contains(name) {
                    columns.push(name.clone());
                }
            }
            rows.push(row);
        }
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
        all.map(|row| row.join(",") + "\n").collect()
    }

    /// The parameters and the forces of pairs, for a terminal.
    pub(super) fn text(&self) -> String {
        let is_force = |name: &str| {
            let force = name.contains("resultant_a");
            force && SHOWN.iter().any(|ending| name.ends_with(ending))
        };
        let shown: Vec<usize> = (0..self.columns.len())
            .filter(|&at| at < self.leading || is_force(&self.columns[at]))
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
