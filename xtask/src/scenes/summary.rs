//! The table of many scenes.

use std::{collections::BTreeMap, fmt::Write};

use super::{
    checks::NAMES,
    scene::Scene,
    verdict::{Class, Verdict},
};

/// A scene with what came of it.
pub struct Judged {
    /// The scene.
    pub scene: Scene,
    /// Verdict on the scene.
    pub verdict: Verdict,
}

/// All that is said of many scenes.
pub fn report(all: &[Judged]) -> String {
    let mut text = String::new();
    let tables: [(&str, Sorted); 3] = [
        ("kind", |judged| (0, judged.scene.kind.to_owned())),
        ("upper over lower modulus", |judged| {
            decade(judged.scene.ratio)
        }),
        ("friction", |judged| {
            (0, judged.scene.pairs[0].law.name().to_owned())
        }),
    ];
    for (name, key) in tables {
        text += &table(name, all, key);
        text.push('\n');
    }
    text + &causes(all) + &measures(all) + &iterations(all) + &reasons(all)
}

/// Kinds that were not posed as asked for, with the reason; nothing without any.
pub fn unposed(all: &[(&str, &str)]) -> String {
    let mut counts: BTreeMap<&(&str, &str), usize> = BTreeMap::new();
    for one in all {
        *counts.entry(one).or_default() += 1;
    }
    let rows = counts.iter().map(|((kind, reason), count)| {
        format!("not posed without pairs: {count} of kind {kind}, which {reason}\n")
    });
    rows.collect()
}

/// Place and name of a row.
type Key = (i32, String);

/// The row of a scene.
type Sorted = fn(&Judged) -> Key;

fn decade(ratio: Option<f64>) -> Key {
    let Some(ratio) = ratio else {
        return (i32::MAX, "rigid".into());
    };
    let low = ratio.log10().floor().clamp(-4.0, 3.0) as i32;
    (low, format!("1e{low} to 1e{}", low + 1))
}

fn table(name: &str, all: &[Judged], key: Sorted) -> String {
    let mut rows: BTreeMap<Key, BTreeMap<Class, usize>> = BTreeMap::new();
    for judged in all {
        *rows
            .entry(key(judged))
            .or_default()
            .entry(judged.verdict.class)
            .or_default() += 1;
    }
    let mut text = format!("| {name} | scenes |");
    for class in Class::ALL {
        write!(text, " {} |", class.name()).expect("text grows");
    }
    text += "\n| --- |";
    text += &" ---: |".repeat(Class::ALL.len() + 1);
    text.push('\n');
    let mut total: BTreeMap<Class, usize> = BTreeMap::new();
    for ((_, name), row) in &rows {
        text += &line(name, row);
        for (class, count) in row {
            *total.entry(*class).or_default() += count;
        }
    }
    text + &line("**all**", &total)
}

fn line(name: &str, row: &BTreeMap<Class, usize>) -> String {
    let mut text = format!("| {name} | {} |", row.values().sum::<usize>());
    for class in Class::ALL {
        let count = row.get(&class).map_or(String::new(), usize::to_string);
        write!(text, " {count} |").expect("text grows");
    }
    text + "\n"
}

/// Texts of endings, and what they are told as.
const CAUSES: [(&str, &str); 12] = [
    ("no equilibrium", "no equilibrium"),
    ("limit of friction", "limit of friction"),
    ("nothing else restrains", "patch released"),
    ("is not restrained", "a body is not held"),
    (
        "balance of a contact patch",
        "the balance of a patch is not determined",
    ),
    ("not determined", "an unknown is not determined"),
    ("no longer sees", "a node lost the other surface"),
    (
        "no tangential part any more",
        "a texture lost its direction",
    ),
    ("undetected", "contact was missed"),
    ("inside out", "an element was turned inside out"),
    ("the residual grew", "the residual grew"),
    ("no convergence", "no convergence"),
];

/// Reasons why runs did not complete, by cause.
fn causes(all: &[Judged]) -> String {
    let stopped = all.iter().filter(|judged| {
        matches!(
            judged.verdict.class,
            Class::Stopped | Class::Named | Class::Crashed
        )
    });
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for judged in stopped {
        *counts.entry(cause(&judged.verdict.reason)).or_default() += 1;
    }
    let rows = counts
        .iter()
        .map(|(cause, count)| format!("| {cause} | {count} |\n"));
    format!(
        "| cause | runs |\n| --- | ---: |\n{}\n",
        rows.collect::<String>()
    )
}

fn cause(reason: &str) -> String {
    let found = CAUSES.iter().find(|(words, _)| reason.contains(words));
    let cause = found.map_or("other", |(_, cause)| cause);
    if cause == "no convergence" {
        return format!("no convergence of {}", unconverged(reason));
    }
    cause.to_owned()
}

/// The field that did not converge, and whether it came near.
///
/// Of `... iterations (force: force 1.8e-10  gap 0.0e0 ...)`, the field is `force` and
/// its norm the number after its name.
fn unconverged(reason: &str) -> String {
    const NEAR: f64 = 1e-8;
    let norms = reason.split_once('(').map_or("", |(_, norms)| norms);
    let Some((field, norms)) = norms.split_once(':') else {
        return "a field".into();
    };
    let mut words = norms.split([' ', ')']).filter(|word| !word.is_empty());
    let norm = words.find(|&word| word == field).and_then(|_| words.next());
    let norm: Option<f64> = norm.and_then(|norm| norm.parse().ok());
    let near = norm.is_some_and(|norm| norm < NEAR);
    format!(
        "{field}, {}",
        if near { "below 1e-8" } else { "above 1e-8" }
    )
}

/// The worst of each check over the runs that ended well.
fn measures(all: &[Judged]) -> String {
    let ended = |judged: &&Judged| {
        !matches!(
            judged.verdict.class,
            Class::Stopped | Class::Named | Class::Refused | Class::Crashed
        )
    };
    let ended: Vec<&Judged> = all.iter().filter(ended).collect();
    let mut text = String::from(
        "| check | failed | worst measure that holds | worst measure | seed |\n| --- | ---: | ---: | ---: | ---: |\n",
    );
    for name in NAMES {
        let found = ended.iter().filter_map(|judged| {
            let worst = judged.verdict.findings.worst.get(name)?;
            Some((worst.measure, judged.scene.seed))
        });
        let found: Vec<(f64, u64)> = found.collect();
        let failed = found.iter().filter(|found| found.0 > 1.0).count();
        let holds = found
            .iter()
            .map(|found| found.0)
            .filter(|&m| m <= 1.0)
            .fold(0.0, f64::max);
        let worst = found.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0));
        let (worst, seed) = worst.unwrap_or((0.0, 0));
        writeln!(
            text,
            "| {name} | {failed} | {holds:.1e} | {worst:.1e} | {seed} |"
        )
        .expect("text grows");
    }
    for name in [
        "contact energy",
        "depth over own facets",
        "depth through other faces",
        "beside pairs, same facets",
        "beside pairs, other facets",
    ] {
        let values = ended.iter().filter_map(|judged| {
            let value = judged.verdict.findings.told.get(name)?;
            Some((*value, judged.scene.seed))
        });
        let count = values.clone().count();
        if let Some((value, seed)) = values.max_by(|a, b| a.0.total_cmp(&b.0)) {
            writeln!(
                text,
                "| {name} (told, {count}) | | | {value:.1e} | {seed} |"
            )
            .expect("text grows");
        }
    }
    text + "\n"
}

fn iterations(all: &[Judged]) -> String {
    let ended = all
        .iter()
        .filter(|j| matches!(j.verdict.class, Class::Complete | Class::Warned));
    let ended: Vec<&Judged> = ended.collect();
    let mut counts: Vec<usize> = ended
        .iter()
        .flat_map(|judged| &judged.verdict.findings.iterations)
        .copied()
        .collect();
    counts.sort_unstable();
    let at = |share: f64| {
        let index = (share * counts.len() as f64) as usize;
        counts
            .get(index.min(counts.len().saturating_sub(1)))
            .copied()
            .unwrap_or(0)
    };
    let cut = ended
        .iter()
        .filter(|judged| judged.verdict.cutbacks > 0)
        .count();
    let slowest = all
        .iter()
        .map(|judged| judged.verdict.seconds)
        .fold(0.0, f64::max);
    let touched = ended.iter().filter(|j| j.verdict.findings.touched).count();
    let share = 100.0 * cut as f64 / ended.len().max(1) as f64;
    format!(
        "complete: {} of {}, with deformable surfaces that touched: {touched}; iterations an increment: median {} (target 4), 99 % {} (target 12), \
         largest {}; scenes with increments cut: {cut}, {share:.1} % (target 3 %); \
         slowest run {slowest:.0} s\n\n",
        ended.len(),
        all.len(),
        at(0.5),
        at(0.99),
        counts.last().copied().unwrap_or(0),
    )
}

/// Reasons why scenes did not complete.
fn reasons(all: &[Judged]) -> String {
    let mut text = String::new();
    for judged in all {
        if matches!(judged.verdict.class, Class::Complete | Class::Warned) {
            continue;
        }
        let reason = judged.verdict.reason.replace('\n', " ");
        let reason: String = reason.chars().take(240).collect();
        writeln!(
            text,
            "{} {} {}: {reason}",
            judged.scene.seed,
            judged.scene.kind,
            judged.verdict.class.name(),
        )
        .expect("text grows");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn causes_are_told_apart() {
        let reason = "step `press` stopped at time 0.1: no convergence in 20 iterations \
                      (force: force 1.8e-10  gap 0.0e0  stick 0.0e0)";
        assert_eq!(cause(reason), "no convergence of force, below 1e-8");
        let reason = reason.replace("(force: force 1.8e-10", "(gap: force 1e-12");
        assert_eq!(cause(&reason), "no convergence of gap, below 1e-8");
        assert_eq!(cause("killed"), "other");
    }

    #[test]
    fn decades_are_those_of_the_ratio() {
        assert_eq!(decade(Some(0.5)).1, "1e-1 to 1e0");
        assert_eq!(decade(Some(1e4)).1, "1e3 to 1e4");
        assert_eq!(decade(None).1, "rigid");
    }
}
