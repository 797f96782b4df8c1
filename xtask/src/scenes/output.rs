//! Output of a run: history, summary and fields, read like the files of any program.

use std::{collections::HashMap, fs, path::Path};

use super::{scene::Scene, vector::Vector, vtu::Grid};

/// The table of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    columns: HashMap<String, usize>,
    rows: Vec<Vec<f64>>,
    /// Pairs that never touched, which have no columns: their numbers are zero.
    untouched: Vec<String>,
}

impl History {
    /// Reads a table of numbers with a line of names.
    ///
    /// # Errors
    /// Returns the fault of the table, in words.
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = fs::read_to_string(path).map_err(|cause| cause.to_string())?;
        Self::of(&text)
    }

    /// Reads the history of a run in a folder.
    ///
    /// # Errors
    /// Returns the fault of the table, in words.
    pub fn of_run(folder: &Path) -> Result<Self, String> {
        let mut table = Self::read(&folder.join("history.csv"))?;
        // A run that was killed has no summary, and nothing of it is judged by pairs.
        let summary = Summary::read(&folder.join("summary.json")).unwrap_or_default();
        table.untouched = summary.pairs;
        let touched = |pair: &String| table.columns.contains_key(&format!("pair.{pair}.mismatch"));
        table.untouched.retain(|pair| !touched(pair));
        Ok(table)
    }

    /// Reads the text of a table.
    ///
    /// # Errors
    /// Returns the fault of the table, in words.
    pub fn of(text: &str) -> Result<Self, String> {
        let mut lines = text.lines();
        let names = lines.next().unwrap_or_default().split(',').enumerate();
        let columns: HashMap<String, usize> = names.map(|(i, n)| (n.to_owned(), i)).collect();
        let number = |cell: &str| {
            cell.parse::<f64>()
                .map_err(|_| format!("`{cell}` is not a number"))
        };
        let row = |line: &str| {
            line.split(',')
                .map(number)
                .collect::<Result<Vec<f64>, String>>()
        };
        let rows = lines.map(row).collect::<Result<Vec<_>, _>>()?;
        match rows.iter().find(|row| row.len() != columns.len()) {
            Some(row) => Err(format!(
                "a row has {} cells of {}",
                row.len(),
                columns.len()
            )),
            None => Ok(Self {
                columns,
                rows,
                untouched: Vec::new(),
            }),
        }
    }

    /// Number of increments.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Names of the columns, in no order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.keys().map(String::as_str)
    }

    fn is_of_untouched(&self, column: &str) -> bool {
        let of_pair = |pair: &String| {
            let column = column
                .strip_prefix("pair.")
                .and_then(|rest| rest.strip_prefix(pair.as_str()));
            column.is_some_and(|rest| rest.starts_with('.'))
        };
        self.untouched.iter().any(of_pair)
    }

    /// A number, if the table has the row and the column.
    pub fn number(&self, row: usize, name: &str) -> Option<f64> {
        let numbers = self.rows.get(row)?;
        match self.columns.get(name) {
            Some(column) => numbers.get(*column).copied(),
            None => self.is_of_untouched(name).then_some(0.0),
        }
    }

    /// A vector, if the table has its columns.
    pub fn vector(&self, row: usize, name: &str) -> Option<Vector> {
        let [x, y, z] = ["x", "y", "z"].map(|axis| self.number(row, &format!("{name}.{axis}")));
        Some([x?, y?, z?])
    }

    /// All numbers of a column.
    pub fn column(&self, name: &str) -> Vec<f64> {
        (0..self.len())
            .filter_map(|row| self.number(row, name))
            .collect()
    }
}

/// The fields after an increment.
pub struct Fields {
    /// Of every body.
    pub bodies: HashMap<&'static str, Grid>,
    /// Of every pair, side by side; `None` of a rigid side.
    pub pairs: Vec<[Option<Grid>; 2]>,
}

impl Fields {
    /// Reads the fields after an increment, which counts from 1; `None` if there are none.
    ///
    /// # Errors
    /// Returns the fault of a file, in words.
    pub fn read(folder: &Path, scene: &Scene, increment: usize) -> Result<Option<Self>, String> {
        let path = |name: &str| folder.join(format!("fields/{name}-{increment:05}.vtu"));
        let mut bodies = HashMap::new();
        for body in &scene.bodies {
            let path = path(body.name);
            if !path.exists() {
                return Ok(None);
            }
            bodies.insert(body.name, Grid::read(&path)?);
        }
        let mut pairs = Vec::new();
        for pair in &scene.pairs {
            let mut sides = [None, None];
            for (side, grid) in pair.sides.iter().zip(&mut sides) {
                let path = path(&format!("contact-{}-{}", pair.name, side.owner));
                // Pairs whose sides are out of reach have no files.
                if side.facets.is_some() && path.exists() {
                    *grid = Some(Grid::read(&path)?);
                }
            }
            pairs.push(sides);
        }
        Ok(Some(Self { bodies, pairs }))
    }
}

/// Ending, as stated by a summary.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// `completed` or another word.
    pub status: String,
    /// The ending in a sentence.
    pub reason: String,
    /// Increments that were cut.
    pub cutbacks: usize,
    /// Largest depth over the local facet size that it warns of; zero if it does not.
    pub depth: f64,
    /// Names of all pairs that the deck came down to.
    pub pairs: Vec<String>,
}

impl Summary {
    /// True if the run reached its end.
    pub fn is_completed(&self) -> bool {
        self.status == "completed"
    }

    /// Reads a summary.
    ///
    /// # Errors
    /// Returns the fault of the summary, in words.
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = fs::read_to_string(path).map_err(|cause| cause.to_string())?;
        let value: serde_json::Value =
            serde_json::from_str(&text).map_err(|cause| cause.to_string())?;
        let word = |value: &serde_json::Value, key: &str| {
            value[key].as_str().unwrap_or_default().to_owned()
        };
        let pairs = value["pairs"].as_array().into_iter().flatten();
        Ok(Self {
            status: word(&value, "status"),
            reason: word(&value, "reason"),
            cutbacks: value["cutbacks"].as_u64().unwrap_or(0) as usize,
            depth: penetration(&value),
            pairs: pairs.map(|pair| word(pair, "name")).collect(),
        })
    }
}

/// The largest depth that is warned of.
fn penetration(summary: &serde_json::Value) -> f64 {
    let warnings = summary["warnings"].as_array().into_iter().flatten();
    warnings
        .filter(|warning| warning["kind"] == "penetration")
        .filter_map(|warning| warning["value"].as_f64())
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_that_never_touched_have_zeros_and_unknown_ones_nothing() {
        let mut history = History::of("time,pair.a-b.mismatch\n0.5,0.25\n").unwrap();
        history.untouched = vec!["a-c".to_owned()];
        assert_eq!(history.number(0, "pair.a-b.mismatch"), Some(0.25));
        assert_eq!(history.number(0, "pair.a-c.area"), Some(0.0));
        assert_eq!(history.vector(0, "pair.a-c.resultant_a"), Some([0.0; 3]));
        assert_eq!(history.number(0, "pair.a-b.area"), None);
        assert_eq!(history.number(0, "pair.a-cd.area"), None);
        assert_eq!(history.number(1, "pair.a-c.area"), None);
    }

    #[test]
    fn the_largest_depth_that_is_warned_of_is_read() {
        let of = |text: &str| penetration(&serde_json::from_str(text).unwrap());
        let warnings = r#"{"warnings": [
            {"kind": "penetration", "value": 0.12},
            {"kind": "moment", "value": 0.4},
            {"kind": "penetration", "value": 0.17}
        ]}"#;
        assert_eq!(of(warnings), 0.17);
        assert_eq!(of(r#"{"warnings": []}"#), 0.0);
        assert_eq!(of("{}"), 0.0);
    }

    #[test]
    fn histories_are_read_by_name() {
        let history = History::of("time,f.x,f.y,f.z\n0.5,1,2,3\n1.0,-1e-3,0,4\n").unwrap();
        assert_eq!(history.len(), 2);
        assert_eq!(history.vector(1, "f"), Some([-1e-3, 0.0, 4.0]));
        assert_eq!(history.column("time"), [0.5, 1.0]);
        assert_eq!(history.number(0, "energy"), None);
        assert!(History::of("a,b\n1\n").is_err());
        assert!(History::of("a,b\n1,x\n").is_err());
    }
}
