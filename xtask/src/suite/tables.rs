//! Tables of a run: its history, probes and sections by one name each.

use std::path::Path;

use super::formula::Rows;
use crate::scenes::output::History;

/// Tables of a run, whose rows are its increments.
pub struct Tables {
    history: History,
    others: Vec<History>,
}

impl Tables {
    /// Reads the tables of a folder; probes and sections may be absent.
    ///
    /// # Errors
    /// Returns the fault of a table, in words.
    pub fn read(folder: &Path) -> Result<Self, String> {
        let history = History::read(&folder.join("history.csv"))?;
        let others = ["probes.csv", "sections.csv"];
        let others = others.into_iter().map(|name| folder.join(name));
        let others = others.filter(|path| path.exists());
        let others = others
            .map(|path| History::read(&path))
            .collect::<Result<_, _>>()?;
        Ok(Self { history, others })
    }

    /// A number of a column.
    pub fn number(&self, name: &str, rows: Rows) -> Option<f64> {
        let tables = std::iter::once(&self.history).chain(&self.others);
        let mut columns = tables.map(|table| table.column(name));
        let column = columns.find(|column| !column.is_empty())?;
        match rows {
            Rows::Last(None) => column.last().copied(),
            Rows::Last(step) => self.of_step(&column, step).last().copied(),
            Rows::Largest => column.into_iter().reduce(f64::max),
            Rows::Smallest => column.into_iter().reduce(f64::min),
            Rows::Total => Some(column.iter().sum()),
            Rows::Mean(step) => {
                let column = self.of_step(&column, step);
                (!column.is_empty()).then(|| column.iter().sum::<f64>() / column.len() as f64)
            }
        }
    }

    fn of_step(&self, column: &[f64], step: Option<usize>) -> Vec<f64> {
        let steps = self.history.column("step");
        let rows = column.iter().zip(steps);
        let wanted = |of: f64| step.is_none_or(|step| of == step as f64);
        rows.filter(|(_, of)| wanted(*of))
            .map(|(number, _)| *number)
            .collect()
    }
}
