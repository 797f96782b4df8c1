//! Laws that must hold in the output of any run, whatever the program reports.
//!
//! | check | bound |
//! | --- | --- |
//! | `resultants` | forces of the two sides of a pair balance to 1e-8 |
//! | `balance` | reactions, loads and contact of a body balance to 1e-6, without inertia |
//! | `law` | friction at nodes with an own row is inside the law to 1e-6 |
//! | `tension` | no pressure below -1e-8 of the largest |
//! | `gap` | no gap below -1e-6 facets at nodes with an own row |
//! | `product` | where there is pressure there is no gap above that |
//! | `dissipation` | never falls, to 1e-9 of the largest energy |
//! | `energy` | the balance of energies closes to 1e-6 of the largest |
//! | `depth` | no node, and no corner of a rigid facet, deeper inside than a tenth of a facet |
//! | `crossing` | where all touches all, no facets cross deeper than 0.3 of their size, see [`crossing`] |
//! | `ending` | a completed run reached the end of all steps |
//! | `contact` | pairs carry force at the end of steps that press, none where they are apart |
//! | `work` | friction gives no node with an own row work: `tau . du <= 1e-4 p h`, see [`work`] |
//! | `closed form` | forces and places that a kind of scene has a formula for, see [`claims`] |
//! | `sliding` | friction over pressure where all slides is that of the law to 1 % |
//! | `refined` | forces are those of a finer mesh, of what the scene is a half of, or of other cells |
//! | `stands` | what has to stay where it is stays, and what is pushed gets there |
//! | `pairs` | without pairs forces are those with pairs to 1e-8, where the same facets meet |
//!
//! Forces and energies below [`round_off`] count as zero: if nothing is pressed, round-off would be
//! compared with round-off.
//!
//! A measure is a value over its bound: at most 1 is good.

mod balance;
mod claims;
mod crossing;
pub mod depth;
mod fields;
mod round_off;
pub mod sizes;
mod table;
mod work;

use std::{collections::BTreeMap, path::Path};

use super::{
    output::{Fields, History},
    scene::{Scene, Start, Statement},
};

/// Names of the checks, in the order of the table.
pub const NAMES: [&str; 18] = [
    "ending",
    "contact",
    "resultants",
    "balance",
    "law",
    "tension",
    "gap",
    "product",
    "dissipation",
    "energy",
    "depth",
    "crossing",
    "work",
    "closed form",
    "sliding",
    "refined",
    "stands",
    "pairs",
];

/// Worst finding of a check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Worst {
    /// Value over the bound.
    pub measure: f64,
    /// Place.
    pub place: String,
}

/// Findings of all checks in one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// The worst of each check.
    pub worst: BTreeMap<&'static str, Worst>,
    /// Numbers to report without a bound.
    pub told: BTreeMap<&'static str, f64>,
    /// Iterations of the increments.
    pub iterations: Vec<usize>,
    /// Set where deformable surfaces pressed on each other at some time.
    pub touched: bool,
}

impl Findings {
    /// Notes a measure of a check; `NaN` is worse than all.
    pub fn note(&mut self, check: &'static str, measure: f64, place: impl FnOnce() -> String) {
        let measure = if measure.is_nan() {
            f64::INFINITY
        } else {
            measure
        };
        let worst = self.worst.entry(check).or_default();
        if measure > worst.measure || worst.place.is_empty() {
            *worst = Worst {
                measure,
                place: place(),
            };
        }
    }

    /// Notes a number that has no bound, if it is the largest so far.
    pub fn tell(&mut self, name: &'static str, value: f64) {
        let entry = self.told.entry(name).or_insert(value);
        *entry = entry.max(value);
    }

    /// Checks that failed.
    pub fn failed(&self) -> impl Iterator<Item = (&'static str, &Worst)> {
        let broken = |entry: &(&'static str, &Worst)| entry.1.measure > 1.0;
        self.worst
            .iter()
            .map(|(name, worst)| (*name, worst))
            .filter(broken)
    }
}

/// Facets that cross in the fields.
#[cfg(test)]
pub fn crossings(fields: &Fields) -> Findings {
    let mut findings = Findings::default();
    crossing::check(&mut findings, fields, 0);
    findings
}
/// Checks the output of a run; if it stopped, the output written until then.
///
/// # Errors
/// Returns the fault of a file, in words.
pub fn check(
    folder: &Path,
    scene: &Scene,
    reference: Option<Result<History, String>>,
) -> Result<Findings, String> {
    let history = History::of_run(folder)?;
    let mut findings = Findings::default();
    table::check(&mut findings, scene, &history);
    let mut read = 0;
    for increment in 1..=history.len() {
        let Some(fields) = Fields::read(folder, scene, increment)? else {
            continue;
        };
        read += 1;
        fields::check(&mut findings, scene, &fields, increment);
        table::fields(&mut findings, scene, (&history, increment), &fields);
        // Overlaps of meshes that the first step presses out are meant until it ends.
        let fading = scene.start == Start::Overlapping(Some("resolve"))
            && history.number(increment - 1, "step") == Some(1.0)
            && history.number(increment, "step") == Some(1.0);
        if !fading {
            depth::check(&mut findings, scene, &history, &fields, increment);
            if matches!(scene.statement, Statement::All(_)) {
                crossing::check(&mut findings, &fields, increment);
            }
        }
    }
    let reference = reference.transpose();
    let reference = reference.map_err(|wrong| format!("of the reference: {wrong}"))?;
    let output = claims::Output {
        folder,
        scene,
        history: &history,
        reference: reference.as_ref(),
    };
    claims::check(&mut findings, &output);
    if read == 0 && history.len() > 0 {
        return Err("there are no fields".into());
    }
    Ok(findings)
}
