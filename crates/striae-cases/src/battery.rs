//! Many runs of one deck with other values, and the tables of what they gave.

use striae_contact::side::Side;
use striae_deck::Deck;
use striae_solve::outcome::Ending;

use super::study::{Run, Study};
use crate::failure::Failure;

/// Runs of the first pair of a deck.
pub struct Battery {
    /// Area over which the force gives the mean pressure.
    area: f64,
    trials: Vec<Trial>,
}

/// One of them.
pub struct Trial {
    group: String,
    name: String,
    /// `true` if it completed without a cut.
    whole: bool,
    iterations: usize,
    mismatch: f64,
    smallest_pressure: f64,
    /// Normal force at the end.
    pub force: f64,
    /// Its relative error beside a better one, if there is one.
    pub error: Option<f64>,
}

impl Battery {
    /// No runs yet.
    pub fn new(area: f64) -> Self {
        Self {
            area,
            trials: Vec::new(),
        }
    }

    /// Runs a deck; a run that stops is a result too.
    pub fn run(
        &mut self,
        study: &mut Study,
        group: &str,
        name: &str,
        deck: Deck,
    ) -> Result<&mut Trial, Failure> {
        let run = study.run_to_limit(name, deck)?;
        let summary = run.finished.summary.clone();
        let completed = matches!(run.finished.ending, Ending::Completed);
        let force = normal_force(&run);
        self.trials.push(Trial {
            group: group.to_owned(),
            name: name.to_owned(),
            whole: completed && summary.cutbacks == 0,
            iterations: summary.newton_max,
            mismatch: run.largest("pair.interface.mismatch"),
            smallest_pressure: smallest_pressure(&run) * self.area / force,
            force,
            error: None,
        });
        study.summaries.push((name.to_owned(), summary));
        let last = self.trials.len() - 1;
        Ok(&mut self.trials[last])
    }

    /// Notes what holds of all runs.
    pub fn measure(&self, study: &mut Study) {
        let all = Line::of("all", self.trials.iter());
        study.measured("incomplete", (all.runs - all.whole) as f64);
        study.measured("mismatch", all.mismatch);
        study.measured("smallest_pressure", all.smallest_pressure);
        if let Some([median, largest]) = all.error {
            study.measured("force.median", median);
            study.measured("force.largest", largest);
        }
    }

    /// Writes a line for every group to `table.md` and one for every run to `table.csv`.
    pub fn write(&self, study: &Study) -> Result<(), Failure> {
        let mut groups: Vec<&str> = Vec::new();
        for trial in &self.trials {
            if !groups.contains(&trial.group.as_str()) {
                groups.push(&trial.group);
            }
        }
        let mut table = HEAD.to_owned();
        for group in groups {
            let of_group = self.trials.iter().filter(|trial| trial.group == group);
            table += &Line::of(group, of_group).text();
        }
        table += &Line::of("all", self.trials.iter()).text();
        study.write("table.md", &table)?;
        let mut rows =
            "group,run,whole,iterations,mismatch,smallest_pressure,force,error\n".to_owned();
        for trial in &self.trials {
            rows += &trial.row();
        }
        study.write("table.csv", &rows)
    }
}

/// Head of the table.
const HEAD: &str = "\
| | complete | iterations median / largest | mismatch | force error median / largest | smallest pressure / mean |
| --- | --- | --- | --- | --- | --- |
";

impl Trial {
    fn row(&self) -> String {
        let error = self.error.map_or_else(String::new, |e| format!("{e:e}"));
        format!(
            "{},{},{},{},{:e},{:e},{:e},{error}\n",
            self.group,
            self.name,
            self.whole,
            self.iterations,
            self.mismatch,
            self.smallest_pressure,
            self.force,
        )
    }
}

/// Statistics of a group of runs.
struct Line<'a> {
    name: &'a str,
    runs: usize,
    whole: usize,
    iterations: [f64; 2],
    mismatch: f64,
    smallest_pressure: f64,
    error: Option<[f64; 2]>,
}

impl<'a> Line<'a> {
    fn of<'b>(name: &'a str, trials: impl Iterator<Item = &'b Trial>) -> Self {
        let trials: Vec<&Trial> = trials.collect();
        let values = |of: &dyn Fn(&Trial) -> f64| trials.iter().map(|t| of(t)).collect();
        let errors: Option<Vec<f64>> = trials.iter().map(|t| Some(t.error?.abs())).collect();
        let mismatch: Vec<f64> = values(&|t| t.mismatch);
        let pressure: Vec<f64> = values(&|t| -t.smallest_pressure);
        Self {
            name,
            runs: trials.len(),
            whole: trials.iter().filter(|trial| trial.whole).count(),
            iterations: median_and_largest(values(&|t| t.iterations as f64)),
            mismatch: median_and_largest(mismatch)[1],
            smallest_pressure: -median_and_largest(pressure)[1],
            error: errors.map(median_and_largest),
        }
    }

    fn text(&self) -> String {
        let error = self.error.map_or_else(String::new, |[median, largest]| {
            format!("{median:.3} / {largest:.3}")
        });
        let [median, largest] = self.iterations;
        format!(
            "| {} | {} of {} | {median} / {largest} | {:.0e} | {error} | {:.1e} |\n",
            self.name, self.whole, self.runs, self.mismatch, self.smallest_pressure,
        )
    }
}

/// NaN counts as the largest.
fn median_and_largest(mut values: Vec<f64>) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    let largest = values.last().copied().unwrap_or(f64::NAN);
    let middle = values.len() / 2;
    let median = match values.len() {
        0 => f64::NAN,
        count if count % 2 == 1 => values[middle],
        _ => 0.5 * (values[middle - 1] + values[middle]),
    };
    [median, largest]
}

/// Force on side `b` across the interface at the end.
pub fn normal_force(run: &Run) -> f64 {
    let column = run.column("pair.interface.resultant_b.z");
    column.last().copied().unwrap_or(f64::NAN)
}

/// Smallest pressure of the kept nodes at the end.
fn smallest_pressure(run: &Run) -> f64 {
    let pair = &run.finished.state.pairs[0];
    let nodes = Side::BOTH
        .into_iter()
        .flat_map(|side| pair.nodes[side].iter().zip(&pair.kept[side]));
    let kept = nodes.filter(|(_, kept)| **kept);
    kept.map(|(node, _)| node.pressure)
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_an_even_number_of_runs_is_a_mean() {
        assert_eq!(median_and_largest(vec![4.0, 1.0, 2.0, 5.0]), [3.0, 5.0]);
        assert_eq!(median_and_largest(vec![4.0, 1.0, 2.0]), [2.0, 4.0]);
        assert!(median_and_largest(vec![1.0, f64::NAN])[1].is_nan());
    }
}
