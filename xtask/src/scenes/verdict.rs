//! Verdict on a scene, in one word.

use super::{
    checks::{Findings, depth::DEPTH},
    output::Summary,
    run::Run,
    scene::{Ending, Scene, Start},
};

/// Classes of outcomes, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Ran to its end, and all checks hold.
    Complete,
    /// Ran to its end with warnings of the program, and all checks hold.
    Warned,
    /// Ran to its end with a depth beyond its bound, which the program itself tells, see
    /// [`is_told`]; all other checks hold.
    Deep,
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
    pub const ALL: [Self; 9] = [
        Self::Complete,
        Self::Warned,
        Self::Deep,
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
            Self::Deep => "deep",
            Self::Named => "named",
            Self::Stopped => "stopped",
            Self::Refused => "refused",
            Self::Crashed => "crashed",
            Self::Silent => "silent",
            Self::Wrong => "wrong",
        }
    }
}

/// Verdict on a scene.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Class.
    pub class: Class,
    /// Reason, in one line.
    pub reason: String,
    /// Findings of the checks, from whatever was written.
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
    "nothing else restrains",
    "inverted",
    "turned inside out",
    "Jacobian",
    "is not restrained",
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
        Some(2) if run.log.contains("not restrained") || overlaps_named(scene, &run.log) => {
            return verdict(Class::Named, last, Findings::default(), 0);
        }
        Some(2) => return verdict(Class::Refused, run.log.clone(), Findings::default(), 0),
        Some(1) => {
            let Ok(summary) = summary else {
                return verdict(Class::Refused, run.log.clone(), Findings::default(), 0);
            };
            let of_words = |words: &[&str]| words.iter().any(|word| summary.reason.contains(word));
            let physical = match scene.ending {
                Ending::Open => of_words(&PHYSICAL),
                Ending::Completes => false,
                Ending::Stops(words) => of_words(words),
            };
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
    if let Ending::Stops(words) = scene.ending {
        let reason = format!("was to end with one of {words:?}");
        return verdict(Class::Wrong, reason, findings, summary.cutbacks);
    }
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

/// Share of the depth found that the program has to tell: it measures along other directions
/// and over sizes of its own.
const TOLD: f64 = 0.9;

/// Depth over the size of a facet that is wrong whatever is told: that of facets which are
/// turned by 45 degrees, see [`is_told`].
const TOO_DEEP: f64 = std::f64::consts::FRAC_PI_4 / 3.0;

/// Returns whether depth is the only check that fails, and the program itself reports it.
///
/// Weighted rows control the mean gap over the facets around a node. At the edge of a face whose
/// facets are rotated against the other side by the angle `t`, the outermost nodes are inside by `h
/// t/3` where the mean is zero, that is, by a tenth of `h` from 17 degrees on. This is the
/// resolution of such rows on the mesh, so the program must report it, with its amount.
fn is_told(findings: &Findings, summary: &Summary) -> bool {
    let failed: Vec<(&str, f64)> = findings
        .failed()
        .map(|(name, worst)| (name, DEPTH * worst.measure))
        .collect();
    match failed[..] {
        [("depth", found)] => found <= TOO_DEEP && summary.depth >= TOLD * found,
        _ => false,
    }
}

/// The class of a run that ended well.
fn completed(findings: &Findings, summary: &Summary, log: &str) -> Class {
    let failed: Vec<&str> = findings.failed().map(|(name, _)| name).collect();
    // Contact below what the mesh resolves, which the depth check bounds and the run tells.
    if failed == ["contact"] && log.contains("unnoticed by contact") {
        return Class::Warned;
    }
    if is_told(findings, summary) && summary.status == "completed" {
        return Class::Deep;
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

#[cfg(test)]
mod tests {
    use super::*;

    fn class(depth: f64, told: f64, further: Option<&'static str>) -> Class {
        let mut findings = Findings::default();
        findings.iterations.push(3);
        findings.note("depth", depth / DEPTH, String::new);
        if let Some(check) = further {
            findings.note(check, 2.0, String::new);
        }
        let summary = Summary {
            status: "completed".into(),
            depth: told,
            ..Summary::default()
        };
        completed(&findings, &summary, "")
    }

    #[test]
    fn a_depth_is_wrong_unless_the_program_tells_it() {
        assert_eq!(class(0.09, 0.0, None), Class::Complete);
        assert_eq!(class(0.15, 0.0, None), Class::Wrong);
        assert_eq!(class(0.15, 0.11, None), Class::Wrong);
        assert_eq!(class(0.15, 0.14, None), Class::Deep);
        assert_eq!(class(0.3, 0.3, None), Class::Wrong);
        assert_eq!(class(0.15, 0.15, Some("energy")), Class::Wrong);
    }
}
