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
    /// What came of it.
    pub verdict: Verdict,
}

/// All that is said of many scenes.
pub fn report(all: &[Judged]) -> String {
    let mut text = String::new();
    let tables: [(&str, fn(&Judged) -> String); 3] = [
        ("kind", |judged| judged.scene.kind.to_owned()),
        ("upper over lower modulus", |judged| {
            decade(judged.scene.ratio)
        }),
        ("friction", |judged| {
            judged.scene.pairs[0].law.name().to_owned()
        }),
    ];
    for (name, key) in tables {
        text += &table(name, all, key);
        text.push('\n');
    }
    text + &measures(all) + &iterations(all) + &reasons(all)
}

fn decade(ratio: Option<f64>) -> String {
    let Some(ratio) = ratio else {
        return "rigid".into();
    };
    let low = ratio.log10().floor().clamp(-4.0, 3.0);
    format!("1e{low:+} to 1e{:+}", low + 1.0)
}

fn table(name: &str, all: &[Judged], key: fn(&Judged) -> String) -> String {
    let mut rows: BTreeMap<String, BTreeMap<Class, usize>> = BTreeMap::new();
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
    for (name, row) in &rows {
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
    ] {
        let values = ended.iter().filter_map(|judged| {
            let value = judged.verdict.findings.told.get(name)?;
            Some((*value, judged.scene.seed))
        });
        if let Some((value, seed)) = values.max_by(|a, b| a.0.total_cmp(&b.0)) {
            writeln!(text, "| {name} (told) | | | {value:.1e} | {seed} |").expect("text grows");
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
    format!(
        "complete: {} of {}; iterations an increment: median {}, 99 % {}, largest {}; \
         scenes with increments cut: {cut}; slowest run {slowest:.0} s\n\n",
        ended.len(),
        all.len(),
        at(0.5),
        at(0.99),
        counts.last().copied().unwrap_or(0),
    )
}

/// Why scenes did not complete.
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
