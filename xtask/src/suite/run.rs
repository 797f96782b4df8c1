//! Runs of a problem and what came of them.

use std::{
    fmt, fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

use serde_json::Value as Json;

use super::{
    FOLDER, Repeat, formula,
    problem::{Problem, Setting, Value},
    tables::Tables,
};
use crate::fault::Fault;

/// The longest a run may take on the clock.
const PATIENCE: Duration = Duration::from_secs(3600);

/// Results of a problem.
pub struct Outcome<'a> {
    /// The problem.
    pub problem: &'a Problem,
    /// Its runs, in its order.
    pub runs: Vec<Run<'a>>,
    /// Its values, in its order.
    pub found: Vec<Found<'a>>,
}

/// Figures of a run.
pub struct Run<'a> {
    /// Its setting.
    pub setting: &'a Setting,
    /// Reason why it stopped; `None` of one that reached its end.
    pub stopped: Option<String>,
    /// Accepted increments.
    pub increments: u64,
    /// Iterations of all of them.
    pub total: u64,
    /// The most iterations of one.
    pub largest: u64,
    /// Increments that were cut.
    pub cuts: u64,
    /// Unknowns of the last system.
    pub unknowns: u64,
    /// Kinds of warnings.
    pub warnings: Vec<String>,
    /// Seconds on the clock.
    pub seconds: f64,
}

/// A value beside the published one.
pub struct Found<'a> {
    /// The entry of the list.
    pub value: &'a Value,
    /// The program's value, or why there is none.
    pub ours: Result<f64, String>,
}

/// Agreement of a value with the published one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Agreement {
    /// Within the band.
    Within,
    /// Outside, and the list says why.
    Explained,
    /// Outside without a word.
    Unexplained,
    /// Nothing to compare with.
    Told,
}

impl Found<'_> {
    /// Ratio of the program's value to the published one; none to a published zero.
    pub fn ratio(&self) -> Option<f64> {
        let published = self.value.published.filter(|&published| published != 0.0)?;
        Some(*self.ours.as_ref().ok()? / published)
    }

    /// Agreement with the published value; the band of a published zero is absolute.
    pub fn agreement(&self) -> Agreement {
        let Some(published) = self.value.published else {
            return if self.ours.is_ok() {
                Agreement::Told
            } else {
                self.outside()
            };
        };
        let scale = if published == 0.0 {
            1.0
        } else {
            published.abs()
        };
        match self.ours {
            Ok(ours) if (ours - published).abs() <= self.value.within * scale => Agreement::Within,
            _ => self.outside(),
        }
    }

    fn outside(&self) -> Agreement {
        match self.value.off {
            Some(_) => Agreement::Explained,
            None => Agreement::Unexplained,
        }
    }
}

impl Outcome<'_> {
    /// All that is off without an explanation in the list.
    pub fn unexplained(&self) -> Vec<String> {
        let deck = &self.problem.deck;
        let stopped = self.runs.iter().filter_map(|run| {
            let reason = run
                .stopped
                .as_ref()
                .filter(|_| run.setting.stops.is_none())?;
            Some(format!("{deck} {}: {reason}", run.setting.name))
        });
        let stops = |found: &&Found<'_>| self.runs[found.value.run].stopped.is_none();
        let off = self.found.iter().filter(stops).filter_map(|found| {
            let quantity = &found.value.quantity;
            match (found.agreement(), &found.ours) {
                (Agreement::Unexplained, Ok(ours)) => {
                    Some(format!("{deck}: {quantity} is {ours:e}"))
                }
                (Agreement::Unexplained, Err(wrong)) => {
                    Some(format!("{deck}: {quantity}: {wrong}"))
                }
                _ => None,
            }
        });
        stopped.chain(off).collect()
    }
}

impl fmt::Display for Outcome<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seconds: f64 = self.runs.iter().map(|run| run.seconds).sum();
        write!(f, "{} ({seconds:.1} s)", self.problem.deck)?;
        for found in &self.found {
            match (&found.ours, found.ratio()) {
                (Ok(ours), Some(ratio)) => {
                    write!(f, "; {} {ours:.5e} ({ratio:.4})", found.value.quantity)?
                }
                (Ok(ours), None) => write!(f, "; {} {ours:.5e}", found.value.quantity)?,
                (Err(wrong), _) => write!(f, "; {}: {wrong}", found.value.quantity)?,
            }
        }
        Ok(())
    }
}

/// Runs a problem and reads its values.
///
/// # Errors
/// When the program cannot be started, or a summary cannot be read.
pub fn outcome<'a>(
    problem: &'a Problem,
    binary: &Path,
    keep: &Path,
    repeat: Repeat,
) -> Result<Outcome<'a>, Fault> {
    let mut runs = Vec::new();
    let mut tables = Vec::new();
    for (number, setting) in problem.runs.iter().enumerate() {
        let out = keep.join(format!("{}-{}", problem.deck, number + 1));
        if repeat == Repeat::Always || !out.join("summary.json").exists() {
            started(problem, setting, binary, &out)?;
        }
        let summary = fs::read_to_string(out.join("summary.json"));
        runs.push(match summary {
            Ok(text) => figures(setting, &text).map_err(Fault::Suite)?,
            Err(_) => refused(setting, &out),
        });
        tables.push(Tables::read(&out));
    }
    let found = problem.values.iter().map(|value| {
        let ours = match &tables[value.run] {
            Ok(tables) => {
                formula::value(&value.formula, &mut |name, rows| tables.number(name, rows))
            }
            Err(wrong) => Err(wrong.clone()),
        };
        let stopped = runs[value.run].stopped.is_some();
        Found {
            value,
            ours: if stopped {
                Err("the run stopped".into())
            } else {
                ours
            },
        }
    });
    let found = found.collect();
    Ok(Outcome {
        problem,
        runs,
        found,
    })
}

/// Runs a deck on one thread, with its printed text in `log.txt` of the folder.
fn started(problem: &Problem, setting: &Setting, binary: &Path, out: &Path) -> Result<(), Fault> {
    let unwritable = |path: &Path| {
        let path: PathBuf = path.to_owned();
        move |cause| Fault::Unreadable { path, cause }
    };
    fs::create_dir_all(out).map_err(unwritable(out))?;
    let log = out.with_extension("log");
    let file = fs::File::create(&log).map_err(unwritable(&log))?;
    let error = file.try_clone().map_err(unwritable(&log))?;
    let mut command = Command::new(binary);
    command.arg("run");
    command.arg(Path::new(FOLDER).join(format!("{}.toml", problem.deck)));
    command
        .args(["--threads", "1", "--overwrite", "--out"])
        .arg(out);
    for parameter in &setting.set {
        command.args(["--set", parameter]);
    }
    let start = |cause| Fault::Start {
        command: format!("{} run {}", binary.display(), problem.deck),
        cause,
    };
    let started = Instant::now();
    let mut child = command
        .stdin(Stdio::null())
        .stdout(file)
        .stderr(error)
        .spawn()
        .map_err(start)?;
    while child.try_wait().map_err(start)?.is_none() {
        if started.elapsed() > PATIENCE {
            child.kill().map_err(start)?;
            child.wait().map_err(start)?;
        }
        sleep(Duration::from_millis(20));
    }
    Ok(())
}

/// Figures of a summary.
fn figures<'a>(setting: &'a Setting, text: &str) -> Result<Run<'a>, String> {
    let summary: Json =
        serde_json::from_str(text).map_err(|wrong| format!("summary.json: {wrong}"))?;
    let count = |key: &str| summary[key].as_u64().unwrap_or_default();
    let reason = summary["reason"].as_str().unwrap_or_default();
    let warnings = summary["warnings"].as_array().into_iter().flatten();
    let mut warnings: Vec<String> = warnings
        .filter_map(|warning| warning["kind"].as_str().map(str::to_owned))
        .collect();
    warnings.sort();
    warnings.dedup();
    Ok(Run {
        setting,
        stopped: (summary["status"] != "completed").then(|| reason.to_owned()),
        increments: count("increments"),
        total: count("newton_total"),
        largest: count("newton_max"),
        cuts: count("cutbacks"),
        unknowns: count("unknowns"),
        warnings,
        seconds: summary["wall_s"].as_f64().unwrap_or_default(),
    })
}

/// A run that wrote no summary, with the last line it printed.
fn refused<'a>(setting: &'a Setting, out: &Path) -> Run<'a> {
    let log = fs::read_to_string(out.with_extension("log")).unwrap_or_default();
    let reason = log.lines().rev().find(|line| !line.trim().is_empty());
    Run {
        setting,
        stopped: Some(reason.unwrap_or("the run wrote nothing").to_owned()),
        increments: 0,
        total: 0,
        largest: 0,
        cuts: 0,
        unknowns: 0,
        warnings: Vec::new(),
        seconds: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(value: &Value, ours: f64) -> Agreement {
        Found {
            value,
            ours: Ok(ours),
        }
        .agreement()
    }

    #[test]
    fn values_agree_within_their_band() {
        let mut value = Value {
            run: 0,
            quantity: "force".into(),
            formula: "1".into(),
            published: Some(-2.0),
            from: "closed form".into(),
            within: 0.01,
            off: None,
        };
        assert_eq!(found(&value, -2.019), Agreement::Within);
        assert_eq!(found(&value, -2.021), Agreement::Unexplained);
        value.off = Some("coarse".into());
        assert_eq!(found(&value, 2.0), Agreement::Explained);
        value.published = Some(0.0);
        assert_eq!(found(&value, 0.009), Agreement::Within);
        value.published = None;
        assert_eq!(found(&value, 7.0), Agreement::Told);
    }

    #[test]
    fn figures_are_those_of_the_summary() {
        let setting = Setting::default();
        let text = r#"{"status": "stopped", "reason": "too far", "increments": 3, "newton_total": 12,
            "newton_max": 7, "cutbacks": 2, "unknowns": 90, "wall_s": 1.5,
            "warnings": [{"kind": "moment"}, {"kind": "coarse"}, {"kind": "moment"}]}"#;
        let run = figures(&setting, text).unwrap();
        assert_eq!(run.stopped.as_deref(), Some("too far"));
        assert_eq!(
            [run.increments, run.total, run.largest, run.cuts],
            [3, 12, 7, 2]
        );
        assert_eq!(run.warnings, ["coarse", "moment"]);
    }
}
