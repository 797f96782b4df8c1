//! The page of the suite and its tables.

use std::fmt::Write;

use super::run::{Agreement, Found, Outcome, Run};

/// Address of the decks for readers; the book does not contain them.
const DECKS: &str = "https://github.com/striae/striae/tree/main/cases/foreign";

/// The page of the book.
pub fn page(outcomes: &[Outcome<'_>]) -> String {
    let runs = || outcomes.iter().flat_map(|outcome| &outcome.runs);
    let values = || outcomes.iter().flat_map(|outcome| &outcome.found);
    let of = |agreement| {
        values()
            .filter(|found| found.agreement() == agreement)
            .count()
    };
    let compared = values()
        .filter(|found| found.value.published.is_some())
        .count();
    let stopped = runs().filter(|run| run.stopped.is_some()).count();
    let cut = runs().filter(|run| run.cuts > 0).count();
    format!(
        "# A suite without tuning\n\n\
         {} problems that other programs publish, remade from their descriptions. No deck has a \
         setting of the solver, of contact or of integration in time: no penalty, no stabilisation, \
         no tolerance, no search distance. Meshes are those a user would choose at first. \
         **Increments:** as many as the publication takes where it says so; else the default of \
         ten a step, and in dynamic steps and long slides a number that the deck states with its \
         reason.\n\n\
         {} runs: {stopped} stopped, {cut} had increments that were cut. {compared} values are \
         compared: {} are within the band that the discretisation explains, {} are off and \
         explained below, {} are off without an explanation.\n\n\
         `cargo xtask suite` runs the [decks]({DECKS}), on one thread each, and writes \
         this page; seconds are those of the machine it was written on, with others at work.\n\n\
         ## Values\n\n{}\n\
         `other programs` are means or results of programs, `closed form` formulas that the \
         publication compares with or that hold for it. The band is over the published value.\n\n\
         ## Runs\n\n{}\n{}\n## Sources\n\n{}",
        outcomes.len(),
        runs().count(),
        of(Agreement::Within),
        of(Agreement::Explained),
        of(Agreement::Unexplained),
        table(outcomes),
        effort(outcomes),
        off(outcomes),
        sources(outcomes),
    )
}

/// Values beside the published ones.
pub fn table(outcomes: &[Outcome<'_>]) -> String {
    let mut text = "| problem | quantity | published | from | striae | ratio | band | |\n\
                    | --- | --- | --- | --- | --- | --- | --- | --- |\n"
        .to_owned();
    for outcome in outcomes {
        for found in &outcome.found {
            let run = &outcome.runs[found.value.run].setting.name;
            let run = if run.is_empty() {
                String::new()
            } else {
                format!(", {run}")
            };
            let value = found.value;
            let published = value.published.map_or("-".into(), digits);
            let ours = found.ours.as_ref().map_or("-".into(), |&ours| digits(ours));
            let ratio = found
                .ratio()
                .map_or("-".into(), |ratio| format!("{ratio:.4}"));
            let band = value.published.map_or("-".into(), |_| percent(value));
            let _ = writeln!(
                text,
                "| {}{run} | {} | {published} | {} | {ours} | {ratio} | {band} | {} |",
                outcome.problem.deck,
                value.quantity,
                value.from,
                verdict(found),
            );
        }
    }
    text
}

/// Iterations, cuts, warnings and time of all runs.
fn effort(outcomes: &[Outcome<'_>]) -> String {
    let mut text =
        "| problem | run | unknowns | increments | iterations | largest | cuts | warnings | s |\n\
                    | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n"
            .to_owned();
    for outcome in outcomes {
        for run in &outcome.runs {
            let Run {
                setting,
                unknowns,
                increments,
                total,
                largest,
                cuts,
                warnings,
                seconds,
                ..
            } = run;
            let ended = if run.stopped.is_some() {
                ", **stopped**"
            } else {
                ""
            };
            let _ = writeln!(
                text,
                "| {}{ended} | {} | {unknowns} | {increments} | {total} | {largest} | {cuts} | {} | {seconds:.1} |",
                outcome.problem.deck,
                setting.name,
                warnings.join(", "),
            );
        }
    }
    text
}

/// All that is off, with what the list says about it.
fn off(outcomes: &[Outcome<'_>]) -> String {
    let mut text = String::from("## What is off\n\n");
    for outcome in outcomes {
        let deck = &outcome.problem.deck;
        for run in outcome.runs.iter().filter(|run| run.stopped.is_some()) {
            let reason = run.stopped.as_deref().unwrap_or_default();
            let why = run.setting.stops.as_deref().unwrap_or("Not explained.");
            let name = if run.setting.name.is_empty() {
                String::new()
            } else {
                format!(" ({})", run.setting.name)
            };
            let _ = writeln!(text, "- **{deck}**{name} stops: \"{reason}\". {why}");
        }
        for found in &outcome.found {
            let stopped = outcome.runs[found.value.run].stopped.is_some();
            if stopped
                || !matches!(
                    found.agreement(),
                    Agreement::Explained | Agreement::Unexplained
                )
            {
                continue;
            }
            let why = found.value.off.as_deref().unwrap_or("Not explained.");
            let by = found.ratio().map_or(String::new(), |ratio| {
                format!(" by {:+.1} %", 100.0 * (ratio - 1.0))
            });
            let _ = writeln!(
                text,
                "- **{deck}**: {} is off{by}. {why}",
                found.value.quantity
            );
        }
    }
    text
}

/// Titles, sources and remarks.
fn sources(outcomes: &[Outcome<'_>]) -> String {
    let mut text = String::new();
    for outcome in outcomes {
        let problem = outcome.problem;
        let source = match &problem.url {
            Some(url) => format!("[{}]({url})", problem.source),
            None => problem.source.clone(),
        };
        let remark = problem
            .remark
            .as_ref()
            .map_or(String::new(), |remark| format!(" {remark}"));
        let Outcome { problem, .. } = outcome;
        let _ = writeln!(
            text,
            "- **{}**: {}. {}: {source}.{remark}",
            problem.deck, problem.title, problem.by
        );
    }
    text
}

fn verdict(found: &Found<'_>) -> &'static str {
    match found.agreement() {
        Agreement::Within => "within",
        Agreement::Explained | Agreement::Unexplained => "**off**",
        Agreement::Told => "told",
    }
}

fn percent(value: &super::problem::Value) -> String {
    match value.published {
        Some(0.0) => digits(value.within),
        _ => format!("{} %", (1e4 * value.within).round() / 100.0),
    }
}

/// Five digits, with an exponent where the number is small or large.
fn digits(number: f64) -> String {
    let size = number.abs();
    if size == 0.0 {
        "0".into()
    } else if (1e-3..1e6).contains(&size) {
        let places = (4 - size.log10().floor() as i32).max(0) as usize;
        format!("{number:.places$}")
    } else {
        format!("{number:.4e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_five_digits() {
        assert_eq!(digits(0.0), "0");
        assert_eq!(digits(-3585.37), "-3585.4");
        assert_eq!(digits(2.86e-5), "2.8600e-5");
        assert_eq!(digits(0.412371), "0.41237");
        assert_eq!(digits(1e7), "1.0000e7");
    }
}
