//! What came of a scene, in one word.

use super::{
    checks::Findings,
    output::Summary,
    run::Run,
    scene::{Scene, Start},
};

/// Classes of outcomes, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Ran to its end, and all checks hold.
    Complete,
    /// The same, with warnings of the program.
    Warned,
    /// Stopped for a reason that physics has, or refused what cannot be.
    Named,
    /// Stopped otherwise.
    Stopped,
    /// The deck was refused: a fault of the generator.
    Refused,
    /// The program crashed or took too long.
    Crashed,
    /// Ended well, but computed nothing or missed contact.
    Silent,
    /// Ended well with output that is wrong.
    Wrong,
}

impl Class {
    /// All classes.
    pub const ALL: [Self; 8] = [
        Self::Complete,
        Self::Warned,
        Self::Named,
        Self::Stopped,
        Self::Refused,
        Self::Crashed,
        Self::Silent,
        Self::Wrong,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Warned => "warned",
            Self::Named => "named",
            Self::Stopped => "stopped",
            Self::Refused => "refused",
            Self::Crashed => "crashed",
            Self::Silent => "silent",
            Self::Wrong => "wrong",
        }
    }
}

/// What came of a scene.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Class.
    pub class: Class,
    /// Why, in a line.
    pub reason: String,
    /// What the checks found, of whatever was written.
    pub findings: Findings,
    /// Increments that were cut.
    pub cutbacks: usize,
    /// Seconds.
    pub seconds: f64,
}

/// Words of reasons that physics has.
const PHYSICAL: [&str; 9] = [
    "no equilibrium",
    "limit of friction",
    "lets go",
    "inverted",
    "turned inside out",
    "Jacobian",
    "is not held",
    "overlap",
    "penetrat",
];

/// Judges a run by what it wrote.
pub fn judge(
    scene: &Scene,
    run: &Run,
    summary: Result<Summary, String>,
    findings: Result<Findings, String>,
) -> Verdict {
    let verdict = |class, reason: String, findings: Findings, cutbacks| Verdict {
        class,
        reason,
        findings,
        cutbacks,
        seconds: run.seconds,
    };
    let last = run.log.lines().rev().find(|line| !line.trim().is_empty());
    let last = last.unwrap_or("nothing was printed").trim().to_owned();
    let Some(status) = run.status else {
        return verdict(
            Class::Crashed,
            "took too long".into(),
            Findings::default(),
            0,
        );
    };
    match status.code() {
        Some(0) => {}
        Some(2) if run.log.contains("not held") || overlaps_named(scene, &run.log) => {
            return verdict(Class::Named, last, Findings::default(), 0);
        }
        Some(2) => return verdict(Class::Refused, run.log.clone(), Findings::default(), 0),
        Some(1) => {
            let Ok(summary) = summary else {
                return verdict(Class::Refused, run.log.clone(), Findings::default(), 0);
            };
            let physical = PHYSICAL.iter().any(|word| summary.reason.contains(word));
            let class = if physical {
                Class::Named
            } else {
                Class::Stopped
            };
            let found = findings.unwrap_or_default();
            return verdict(class, summary.reason, found, summary.cutbacks);
        }
        _ => return verdict(Class::Crashed, last, Findings::default(), 0),
    }
    let (summary, findings) = match (summary, findings) {
        (Ok(summary), Ok(findings)) => (summary, findings),
        (Err(wrong), _) | (_, Err(wrong)) => {
            return verdict(Class::Silent, wrong, Findings::default(), 0);
        }
    };
    let class = completed(&findings, &summary, &run.log);
    let failed = findings.failed();
    let failures: Vec<String> = failed
        .map(|(name, worst)| format!("{name} {:.1e}: {}", worst.measure, worst.place))
        .collect();
    let reason = if failures.is_empty() {
        summary.reason.clone()
    } else {
        failures.join("; ")
    };
    verdict(class, reason, findings, summary.cutbacks)
}

/// The class of a run that ended well.
fn completed(findings: &Findings, summary: &Summary, log: &str) -> Class {
    let failed: Vec<&str> = findings.failed().map(|(name, _)| name).collect();
    // Contact below what the mesh resolves, which the depth check bounds and the run tells.
    if failed == ["contact"] && log.contains("contact does not feel it") {
        return Class::Warned;
    }
    if findings.iterations.is_empty() || failed == ["contact"] {
        Class::Silent
    } else if !failed.is_empty() || summary.status != "completed" {
        Class::Wrong
    } else if log
        .lines()
        .any(|line| line.trim_start().starts_with("warning"))
    {
        Class::Warned
    } else {
        Class::Complete
    }
}

fn overlaps_named(scene: &Scene, log: &str) -> bool {
    let words = ["overlap", "penetrat", "inside"];
    matches!(scene.start, Start::Overlapping(_)) && words.iter().any(|word| log.contains(word))
}
