//! `striae reproduce NAME`: a case of the collection beside what is known of it.

use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

use striae_output::{
    OutputError,
    expected::{Comparison, Expected, Verdict, compare, report, write_csv},
};

use striae::{Finished, Interrupt, Simulation};
use striae_cases::{
    CASES, Case, Failure as CaseFailure,
    study::{Extent, Runner, Study},
};
use striae_solve::warning::Kind;

use super::run::{Common, Strictness};
use crate::{
    failure::Failure,
    interrupt::listen,
    progress::{Progress, Verbosity},
    ranks::Voices,
};

/// Run cases with known results and compare.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("which").required(true).args(["name", "list", "all"]))]
pub struct Arguments {
    /// The case.
    name: Option<String>,
    /// List the cases.
    #[arg(long)]
    list: bool,
    /// Run all cases.
    #[arg(long)]
    all: bool,
    /// Skip the runs that take long.
    #[arg(long)]
    quick: bool,
    /// Enforcement of contact in all pairs; results are then not judged.
    #[arg(long)]
    enforcement: Option<Enforcement>,
    /// Folder for the output, with a folder for each case.
    #[arg(short, long, alias = "output", default_value = "results")]
    out: PathBuf,
    #[command(flatten)]
    common: Common,
}

/// Enforcement of contact.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Enforcement {
    /// Mean gaps and slips, one traction field for both sides.
    Weighted,
    /// The method of the paper: a field on each side, gaps and slips at nodes.
    Collocated,
}

/// Lists or runs cases.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let cases = match &arguments.name {
        Some(name) => vec![named(name)?],
        None => CASES.iter().collect(),
    };
    if arguments.list {
        return list(out);
    }
    arguments.common.start_threads(Voices::Alone)?;
    let interrupt = listen();
    let mut failed = Vec::new();
    for case in cases {
        let passed = reproduced(case, arguments, &interrupt, out)?;
        if passed == Verdict::Fail {
            failed.push(case.name);
        }
    }
    if failed.is_empty() {
        Ok(())
    } else {
        Err(Failure::Deviates(failed.join(", ")))
    }
}

/// Runs of a case, with progress.
struct Narrated<'a> {
    verbosity: Verbosity,
    interrupt: &'a Interrupt,
}

impl Runner for Narrated<'_> {
    fn run(&self, title: &str, simulation: Simulation) -> Result<Finished, striae::Error> {
        if self.verbosity != Verbosity::Quiet {
            eprintln!("{title}");
        }
        let mut progress = Progress::new(&simulation.problem().model, self.verbosity);
        let finished = simulation.until(self.interrupt).run_with(&mut progress);
        progress.finish();
        finished
    }
}

fn named(name: &str) -> Result<&'static Case, Failure> {
    let known = CASES.iter().find(|case| case.name == name);
    known.ok_or_else(|| Failure::UnknownCase {
        name: name.to_owned(),
        known: CASES
            .iter()
            .map(|case| case.name)
            .collect::<Vec<_>>()
            .join(", "),
    })
}

fn list(out: &mut dyn Write) -> Result<(), Failure> {
    let width = CASES.iter().map(|case| case.name.len()).max().unwrap_or(0);
    for case in CASES {
        writeln!(out, "{:width$}  {}", case.name, case.title)?;
    }
    Ok(())
}

/// Runs a case, prints and writes its results. A run that stops is a failed
/// case, not the end of the program.
fn reproduced(
    case: &Case,
    arguments: &Arguments,
    interrupt: &Interrupt,
    out: &mut dyn Write,
) -> Result<Verdict, Failure> {
    let folder = arguments.out.join(case.name);
    let extent = if arguments.quick {
        Extent::Quick
    } else {
        Extent::Full
    };
    let runner = Narrated {
        verbosity: arguments.common.verbosity(),
        interrupt,
    };
    let mut study = Study::new(case.name, extent, folder.clone(), &runner);
    study.enforcement = arguments.enforcement.map(|enforcement| match enforcement {
        Enforcement::Weighted => striae_model::Enforcement::Weighted,
        Enforcement::Collocated => striae_model::Enforcement::Collocated,
    });
    let ran = (case.run)(&mut study);
    if let Err(failure) = &ran
        && (study.was_interrupted() || !matches!(failure, CaseFailure::Ended(_)))
    {
        return Ok(ran.map(|()| Verdict::Fail)?);
    }
    let comparisons = compared(case, &mut study)?;
    write_text(&folder.join("README.md"), case.readme)?;
    let said = match (extent, case.quick) {
        (Extent::Quick, Some(what)) => format!("quick: {what}"),
        _ => "full".to_owned(),
    };
    write_csv(&folder.join("quantities.csv"), &comparisons, &said)?;
    writeln!(out, "\n{}: {}\n", case.name, case.title)?;
    writeln!(out, "{}", report(&comparisons))?;
    if study.enforcement.is_some() {
        writeln!(
            out,
            "No verdict: expected values hold for the enforcement of the decks only.\n"
        )?;
    }
    writeln!(out, "{}", runs(&study))?;
    if let Err(failure) = &ran {
        writeln!(out, "{failure}")?;
    }
    writeln!(out, "output in {}", folder.display())?;
    let mut passed = comparisons.iter().all(|c| c.verdict == Verdict::Pass);
    let strictness = arguments.common.strictness();
    passed &= warned(&study, out)? == Warned::No || strictness == Strictness::Lenient;
    let is_judged = study.enforcement.is_none();
    Ok(if ran.is_ok() && (passed || !is_judged) {
        Verdict::Pass
    } else {
        Verdict::Fail
    })
}

/// Presence of warnings.
#[derive(PartialEq)]
enum Warned {
    Yes,
    No,
}

/// Prints the warnings of all runs; that collocated forces are not in balance is a note.
fn warned(study: &Study, out: &mut dyn Write) -> Result<Warned, Failure> {
    let balance = [Kind::Mismatch, Kind::Moment].map(Kind::name);
    let mut warned = Warned::No;
    for (deck, summary) in &study.summaries {
        for warning in &summary.warnings {
            if study.collocated.contains(deck) && balance.contains(&warning.kind.as_str()) {
                writeln!(
                    out,
                    "note: {deck}: {}; the collocated method does not balance them",
                    warning.text
                )?;
                continue;
            }
            writeln!(out, "warning: {deck}: {}", warning.text)?;
            warned = Warned::Yes;
        }
    }
    Ok(warned)
}

/// Comparisons of measured with known values, without those that this extent omits.
fn compared(case: &Case, study: &mut Study) -> Result<Vec<Comparison>, Failure> {
    let mut expected = Expected::parse(case.expected).map_err(|cause| OutputError::Content {
        path: Path::new(case.name).join("expected.toml"),
        cause,
    })?;
    let left_out = &study.left_out;
    let kept = |name: &String| !left_out.contains(&name.as_str());
    expected.quantities.retain(|quantity| kept(&quantity.name));
    let worst = |of: fn(&striae_output::summary::Summary) -> f64| {
        let values = study.summaries.iter().map(|(_, summary)| of(summary));
        values.reduce(f64::max)
    };
    let newton = [
        ("newton.median", worst(|summary| summary.newton_median)),
        ("newton.max", worst(|summary| summary.newton_max as f64)),
        ("cutbacks", worst(|summary| summary.cutbacks as f64)),
    ];
    for (name, value) in newton {
        study.quantities.extend(value.map(|v| (name.to_owned(), v)));
    }
    let measured = &study.quantities;
    Ok(compare(&expected, |name| {
        let found = measured.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| *value)
    }))
}

/// Statistics of Newton's method, a line a deck.
fn runs(study: &Study) -> String {
    if study.summaries.is_empty() {
        return String::new();
    }
    let names = study.summaries.iter().map(|(name, _)| name.len());
    let width = names.max().unwrap_or(0).max("deck".len());
    let mut text = format!(
        "{:width$} | unknowns | increments | Newton median | max | cut back |      s\n",
        "deck"
    );
    text += &format!(
        "{}-+----------+------------+---------------+-----+----------+-------\n",
        "-".repeat(width)
    );
    for (name, summary) in &study.summaries {
        text += &format!(
            "{name:width$} | {:8} | {:10} | {:13} | {:3} | {:8} | {:6.1}\n",
            summary.unknowns,
            summary.increments,
            summary.newton_median,
            summary.newton_max,
            summary.cutbacks,
            summary.wall_s,
        );
    }
    text
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    fs::write(path, text).map_err(|cause| Failure::Unwritable {
        path: path.to_owned(),
        cause,
    })
}
