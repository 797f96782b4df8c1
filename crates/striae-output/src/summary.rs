//! The summary of a run: one JSON object for people and scripts.
//!
//! The names of the fields are the keys of the file. Lengths, forces and
//! energies are in the units of the deck; times in seconds; memory in MiB.

use std::collections::BTreeMap;
use std::path::Path;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use striae_solve::warning::Warning;

use crate::OutputError;
use striae_files::{read_text, write_atomically};

/// Summary of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the case.
    pub case: String,
    /// Version of the program.
    pub version: String,
    /// Ending of the run.
    pub status: Status,
    /// The ending in a sentence.
    pub reason: String,
    /// Accepted increments.
    pub increments: usize,
    /// Increments cut back.
    pub cutbacks: usize,
    /// Newton iterations in all accepted increments.
    pub newton_total: usize,
    /// Most Newton iterations in one increment.
    pub newton_max: usize,
    /// Median of the Newton iterations of the increments.
    pub newton_median: f64,
    /// Unknowns of the system.
    pub unknowns: usize,
    /// The linear solver.
    pub solver: SolverSummary,
    /// Time on the wall clock, s.
    pub wall_s: f64,
    /// Largest resident memory, MiB, if the system reports it.
    pub peak_rss_mib: Option<f64>,
    /// Contact pairs.
    pub pairs: Vec<PairSummary>,
    /// Ties.
    #[serde(default)]
    pub ties: Vec<TieSummary>,
    /// Reaction of every node set with prescribed displacements.
    pub reactions: BTreeMap<String, [f64; 3]>,
    /// Warnings: reasons to doubt the results.
    #[serde(default)]
    pub warnings: Vec<WarningSummary>,
}

/// Something that makes results doubtful.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WarningSummary {
    /// `mismatch`, `penetration` and so on, see `striae_solve::warning`.
    pub kind: String,
    /// The pair, if it is about one.
    pub pair: Option<String>,
    /// Worst value.
    pub value: f64,
    /// Value above which there is a warning.
    pub limit: f64,
    /// Time of the worst value.
    pub time: f64,
    /// In a sentence.
    pub text: String,
}

impl From<Warning> for WarningSummary {
    fn from(warning: Warning) -> Self {
        Self {
            kind: warning.kind.name().to_owned(),
            pair: warning.pair,
            value: warning.value,
            limit: warning.limit,
            time: warning.time,
            text: warning.text,
        }
    }
}

/// Work spent on the linear systems.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SolverSummary {
    /// Method of the last factorisation: `condensed`, `multifrontal` or `faer`.
    pub method: String,
    /// Factorisations in all accepted increments.
    pub factorisations: usize,
    /// Corrections of contact alone, on linearised bodies, in all accepted increments.
    pub contact_corrections: usize,
    /// Iterations of GMRES in all accepted increments.
    pub krylov_iterations: usize,
    /// Seconds on the clock for residuals and matrices in all accepted increments.
    pub assembly_s: f64,
    /// Seconds spent on factorisations and preconditioners.
    pub factorisation_s: f64,
    /// Seconds spent on solutions with refinement.
    pub solution_s: f64,
    /// Seconds spent on contact with linearised bodies.
    pub contact_s: f64,
    /// Accepted increments in which another solver replaced the requested one.
    pub fall_backs: usize,
    /// Reason of the last change of solver.
    pub reason: Option<String>,
}

/// Ending of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// All time was covered.
    Completed,
    /// The run stopped before its end.
    Stopped,
}

/// The last state of one contact pair.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairSummary {
    /// Name of the pair.
    pub name: String,
    /// Resultant of the contact tractions on surface `a`.
    pub resultant_a: [f64; 3],
    /// Resultant of the contact tractions on surface `b`.
    pub resultant_b: [f64; 3],
    /// Integral of the pressure over surface `a`; in self-contact over one of the walls.
    pub pressure_integral: f64,
    /// Length of the sum of both resultants over the load, of the integrals of pressure and
    /// friction.
    pub mismatch: f64,
    /// Sticking nodes.
    pub stick: usize,
    /// Slipping nodes.
    pub slip: usize,
    /// Open nodes.
    pub open: usize,
    /// Largest nodal pressure.
    pub max_pressure: f64,
    /// Energy dissipated by friction so far.
    pub dissipated: f64,
}

/// The last state of one tie.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TieSummary {
    /// Name of the tie.
    pub name: String,
    /// Force on surface `a`.
    pub force_a: [f64; 3],
    /// Force on surface `b`.
    pub force_b: [f64; 3],
    /// Length of the sum of both forces over the sum of the lengths of nodal forces.
    pub mismatch: f64,
    /// Length of the sum of both moments over the same times the root of the area.
    pub moment_mismatch: f64,
    /// Reference area that is tied.
    pub area: f64,
    /// Distance that nodes were moved, before anything else, to their places on the other surface.
    pub moved: f64,
}

impl Summary {
    /// Writes the summary, whole or not at all. Numbers that are not finite
    /// become `null`, which [`Summary::read`] refuses.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let text = serde_json::to_string_pretty(self).map_err(|cause| content(path, &cause))?;
        write_atomically(path, (text + "\n").as_bytes())?;
        Ok(())
    }

    /// Reads a summary back.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        serde_json::from_str(&read_text(path)?).map_err(|cause| content(path, &cause))
    }
}

fn content(path: &Path, cause: &serde_json::Error) -> OutputError {
    OutputError::Content {
        path: path.to_owned(),
        cause: cause.to_string(),
    }
}

/// Total, largest and median number of iterations, given those of every increment.
pub fn newton_counts(iterations: &[usize]) -> (usize, usize, f64) {
    let mut sorted = iterations.to_vec();
    sorted.sort_unstable();
    let middle = sorted.len() / 2;
    let median = match (sorted.len(), sorted.len() % 2) {
        (0, _) => 0.0,
        (_, 1) => sorted[middle] as f64,
        _ => (sorted[middle - 1] + sorted[middle]) as f64 / 2.0,
    };
    (
        sorted.iter().sum(),
        sorted.last().copied().unwrap_or(0),
        median,
    )
}

/// Length of `a + b` over that of the longer of the two, 0 where both vanish:
/// how far the resultants on the two sides are from balance.
pub fn resultant_mismatch(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (a, b) = (Vector3::from(a), Vector3::from(b));
    let longer = a.norm().max(b.norm());
    if longer > 0.0 {
        (a + b).norm() / longer
    } else {
        0.0
    }
}

/// Largest resident memory of this process so far, MiB; known on Linux only
/// (`VmHWM` of `/proc/self/status`).
pub fn peak_rss_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    peak_of(&status)
}

fn peak_of(status: &str) -> Option<f64> {
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes / 1024.0)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn summary() -> Summary {
        Summary {
            case: "two-blocks".into(),
            version: "0.1.0".into(),
            status: Status::Completed,
            reason: "The end time was reached.".into(),
            increments: 20,
            cutbacks: 1,
            newton_total: 85,
            newton_max: 7,
            newton_median: 4.5,
            unknowns: 1234,
            solver: SolverSummary {
                method: "condensed".into(),
                factorisations: 80,
                contact_corrections: 12,
                krylov_iterations: 7,
                assembly_s: 1.5,
                factorisation_s: 2.5,
                solution_s: 0.5,
                contact_s: 0.25,
                fall_backs: 0,
                reason: None,
            },
            wall_s: 0.75,
            peak_rss_mib: None,
            pairs: vec![PairSummary {
                name: "interface".into(),
                resultant_a: [0.1, 0.0, 15_712.0],
                resultant_b: [-0.1, 0.0, -15_712.0],
                pressure_integral: 15_720.0,
                mismatch: 1e-13,
                stick: 3,
                slip: 2,
                open: 1,
                max_pressure: 4e5,
                dissipated: 12.5,
            }],
            ties: vec![TieSummary {
                name: "glue".into(),
                force_a: [0.0, 0.0, 2.0],
                force_b: [0.0, 0.0, -2.0],
                mismatch: 1e-16,
                moment_mismatch: 1e-15,
                area: 1.0,
                moved: 0.0,
            }],
            reactions: [("BOTTOM".to_owned(), [0.1, 0.2, 0.3])].into(),
            warnings: vec![WarningSummary {
                kind: "tension".into(),
                pair: Some("interface".into()),
                value: 0.25,
                limit: 1e-6,
                time: 0.5,
                text: "pair `interface`: contact pulls".into(),
            }],
        }
    }

    #[test]
    fn the_file_has_exactly_the_agreed_keys() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("summary.json");
        summary().write(&path).unwrap();
        let found: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let expected = json!({
            "case": "two-blocks", "version": "0.1.0", "status": "completed",
            "reason": "The end time was reached.", "increments": 20, "cutbacks": 1,
            "newton_total": 85, "newton_max": 7, "newton_median": 4.5, "unknowns": 1234,
            "solver": {
                "method": "condensed", "factorisations": 80, "contact_corrections": 12,
                "krylov_iterations": 7,
                "assembly_s": 1.5, "factorisation_s": 2.5, "solution_s": 0.5, "contact_s": 0.25,
                "fall_backs": 0, "reason": null
            },
            "wall_s": 0.75, "peak_rss_mib": null,
            "pairs": [{
                "name": "interface", "resultant_a": [0.1, 0.0, 15_712.0],
                "resultant_b": [-0.1, 0.0, -15_712.0], "pressure_integral": 15_720.0,
                "mismatch": 1e-13, "stick": 3,
                "slip": 2, "open": 1, "max_pressure": 4e5, "dissipated": 12.5
            }],
            "ties": [{
                "name": "glue", "force_a": [0.0, 0.0, 2.0], "force_b": [0.0, 0.0, -2.0],
                "mismatch": 1e-16, "moment_mismatch": 1e-15, "area": 1.0, "moved": 0.0
            }],
            "reactions": { "BOTTOM": [0.1, 0.2, 0.3] },
            "warnings": [{
                "kind": "tension", "pair": "interface", "value": 0.25, "limit": 1e-6,
                "time": 0.5, "text": "pair `interface`: contact pulls"
            }]
        });
        assert_eq!(found, expected);
        assert_eq!(Summary::read(&path).unwrap(), summary());
    }

    #[test]
    fn iterations_are_counted() {
        assert_eq!(newton_counts(&[]), (0, 0, 0.0));
        assert_eq!(newton_counts(&[5]), (5, 5, 5.0));
        assert_eq!(newton_counts(&[9, 3, 4]), (16, 9, 4.0));
        assert_eq!(newton_counts(&[9, 3, 4, 6]), (22, 9, 5.0));
    }

    #[test]
    fn balanced_resultants_do_not_mismatch() {
        assert_eq!(resultant_mismatch([1.0, -2.0, 3.0], [-1.0, 2.0, -3.0]), 0.0);
        assert_eq!(resultant_mismatch([0.0; 3], [0.0; 3]), 0.0);
        assert_eq!(resultant_mismatch([0.0, 0.0, 2.0], [0.0; 3]), 1.0);
        assert_eq!(resultant_mismatch([3.0, 4.0, 0.0], [0.0, -4.0, 0.0]), 0.6);
    }

    #[test]
    fn peak_memory_is_read_in_mebibytes() {
        let status = "VmPeak:\t  9999 kB\nVmHWM:\t    2560 kB\nVmRSS:\t 1 kB\n";
        assert_eq!(peak_of(status), Some(2.5));
        assert_eq!(peak_of("VmRSS: 1 kB"), None);
        if cfg!(target_os = "linux") {
            assert!(peak_rss_mib().unwrap() > 1.0);
        }
    }
}
