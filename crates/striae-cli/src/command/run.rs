//! `striae run DECK`: a simulation from a deck to files.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use striae::{Finished, Simulation, case_name, sensitivity::of_deck};
use striae_mesh::significant;
use striae_output::{
    Existing,
    checkpoint::FILE,
    summary::{PairSummary, Summary},
};
use striae_solve::outcome::Ending;

use crate::{
    failure::Failure,
    interrupt::listen,
    progress::{Progress, Verbosity},
    ranks::{Crew, Options, Voice, Voices},
    reporting::Reporting,
    source::Source,
};

/// Run a deck.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Folder for the output; by default results/NAME.
    #[arg(short, long, alias = "output")]
    out: Option<PathBuf>,
    /// Compute derivatives of the history with respect to a parameter of the deck, or another
    /// number by its path, such as `pair.pad.friction.mu`, and write them to
    /// sensitivity-NAME.csv; may be given again.
    #[arg(long, value_name = "NAME")]
    wrt: Vec<String>,
    /// Remove the results of an earlier run from that folder first.
    #[arg(long)]
    overwrite: bool,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    report: Reported,
    #[command(flatten)]
    ranks: Options,
}

/// Option to write a report.
#[derive(clap::Args)]
pub struct Reported {
    /// Write report.html beside the results, and update it during the run.
    #[arg(long)]
    report: bool,
}

impl Reported {
    /// The folder to report on, if a report is requested.
    pub fn of(&self, folder: &Path) -> Option<PathBuf> {
        self.report.then(|| folder.to_owned())
    }
}

/// Options of everything that runs simulations.
#[derive(clap::Args)]
pub struct Common {
    /// Number of threads; by default that of the machine, or one per rank if there are several.
    #[arg(long, value_parser = threads)]
    threads: Option<usize>,
    /// Print only errors and results.
    #[arg(long)]
    quiet: bool,
    /// Show the residual norms of every iteration.
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    /// End with exit code 1 if there are warnings.
    #[arg(long)]
    strict: bool,
}

/// Effect of warnings on the exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strictness {
    /// Nothing.
    Lenient,
    /// Warnings make it 1.
    Strict,
}

impl Common {
    /// Verbosity of the output.
    pub fn verbosity(&self) -> Verbosity {
        match (self.quiet, self.verbose) {
            (true, _) => Verbosity::Quiet,
            (_, true) => Verbosity::Iterations,
            _ => Verbosity::Normal,
        }
    }

    /// Effect of warnings on the exit code.
    pub fn strictness(&self) -> Strictness {
        if self.strict {
            Strictness::Strict
        } else {
            Strictness::Lenient
        }
    }

    /// Sets the number of threads for the whole program.
    pub fn start_threads(&self, together: Voices) -> Result<(), Failure> {
        let most = match together {
            Voices::Alone => 0,
            Voices::Several => 1,
        };
        let threads = self.threads.unwrap_or(most);
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|cause| Failure::Threads(cause.to_string()))
    }
}

/// Most threads; more than any machine serves only slow a run down.
const MOST_THREADS: usize = 1024;
/// Pairs without contact that are named.
const NAMED: usize = 8;

/// A number of threads.
fn threads(text: &str) -> Result<usize, String> {
    let threads = text.parse().ok();
    let threads = threads.filter(|threads| (1..=MOST_THREADS).contains(threads));
    threads.ok_or_else(|| format!("a number from 1 to {MOST_THREADS} is needed"))
}

/// Runs the deck and prints the result.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let crew = Crew::start(&arguments.ranks)?;
    let result = run_on(arguments, &crew, out);
    crew.ended(result)
}

fn run_on(arguments: &Arguments, crew: &Crew, out: &mut dyn Write) -> Result<(), Failure> {
    arguments.common.start_threads(crew.voices())?;
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| Path::new("results").join(case_name(&arguments.source.deck)));
    let existing = if arguments.overwrite {
        Existing::Replace
    } else {
        Existing::Keep
    };
    let (deck, settings) = (&arguments.source.deck, &arguments.source.settings.set);
    let simulation = match crew.ranks() {
        None => Simulation::open_with(deck, settings, &folder)?,
        Some(ranks) => Simulation::open_on(ranks, deck, settings, &folder)?,
    };
    let wrt = arguments.wrt.iter();
    let simulation = wrt
        .map(|name| of_deck(deck, settings, name))
        .try_fold(simulation, |simulation, by| {
            Ok::<_, striae::Error>(simulation.differentiated(by?))
        })?;
    let common = (&arguments.common, crew.voice());
    let report = arguments.report.of(&folder);
    finish(simulation.over(existing), &folder, common, report, out)
}

/// Runs, and prints the result if this rank prints.
pub fn finish(
    simulation: Simulation,
    folder: &Path,
    (common, voice): (&Common, Voice),
    report: Option<PathBuf>,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let strictness = common.strictness();
    match voice {
        Voice::First => {
            let finished = watched(simulation, common.verbosity(), report)?;
            concluded(finished, folder, strictness, out)
        }
        Voice::Silent => {
            let finished = watched(simulation, Verbosity::Quiet, None)?;
            ended(finished, folder, strictness)
        }
    }
}

/// Runs with progress, stops at an interrupt, and makes the report of a folder if one is given.
pub fn watched(
    simulation: Simulation,
    verbosity: Verbosity,
    report: Option<PathBuf>,
) -> Result<Finished, Failure> {
    let mut progress = Progress::new(&simulation.problem().model, verbosity);
    let mut reporting = Reporting::new(&mut progress, report.clone());
    let finished = simulation.until(&listen()).run_with(&mut reporting);
    progress.finish();
    let finished = finished?;
    if let Some(folder) = report {
        striae_report::write(&folder, &folder.join(striae_report::FILE))?;
    }
    Ok(finished)
}

/// Prints the result of a run.
pub fn concluded(
    finished: Finished,
    folder: &Path,
    strictness: Strictness,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    warn(&finished.summary);
    write!(out, "{}", told(&finished.summary))?;
    writeln!(out, "output in {}", folder.display())?;
    ended(finished, folder, strictness)
}

/// Result of a finished run.
fn ended(finished: Finished, folder: &Path, strictness: Strictness) -> Result<(), Failure> {
    let warnings = &finished.summary.warnings;
    match finished.ending {
        Ending::Completed if strictness == Strictness::Strict && !warnings.is_empty() => {
            Err(Failure::Warned(warnings.len()))
        }
        Ending::Completed => Ok(()),
        Ending::Interrupted { time } if folder.join(FILE).exists() => Err(Failure::Interrupted {
            time,
            folder: folder.to_owned(),
        }),
        ending @ (Ending::Stopped { .. } | Ending::Interrupted { .. }) => {
            Err(Failure::Ended(Box::new(ending)))
        }
    }
}

/// Warnings of a run, on the standard error.
pub fn warn(summary: &Summary) {
    for warning in &summary.warnings {
        let _ = writeln!(std::io::stderr(), "warning: {}", warning.text);
    }
}

/// A few lines on how a run went.
pub fn told(summary: &Summary) -> String {
    let mut lines = vec![format!(
        "{}: {} increments, {} cut back; Newton iterations median {} largest {}; {} unknowns; {:.1} s",
        summary.reason,
        summary.increments,
        summary.cutbacks,
        summary.newton_median,
        summary.newton_max,
        summary.unknowns,
        summary.wall_s,
    )];
    let of = |value: f64| significant(value, 7);
    // Contact of everything has pairs of all that may touch.
    let touches = |pair: &&PairSummary| pair.pressure_integral > 0.0 || pair.dissipated != 0.0;
    let (touching, apart): (Vec<_>, Vec<_>) = summary.pairs.iter().partition(touches);
    for pair in touching {
        let [x, y, z] = pair.resultant_a;
        // Forces of self-contact, and around a press fit, cancel.
        let resultant = x.hypot(y).hypot(z);
        let force = match resultant < 1e-6 * pair.pressure_integral {
            true => format!("pressed together by {}", of(pair.pressure_integral)),
            false => format!("force on a ({}, {}, {})", of(x), of(y), of(z)),
        };
        lines.push(format!(
            "pair `{}`: {force}, mismatch {:.1e}; stick {}, slip {}, open {}; dissipated {}",
            pair.name,
            pair.mismatch,
            pair.stick,
            pair.slip,
            pair.open,
            of(pair.dissipated)
        ));
    }
    if !apart.is_empty() {
        let names = apart.iter().take(NAMED);
        let mut names: Vec<String> = names.map(|pair| format!("`{}`", pair.name)).collect();
        if apart.len() > NAMED {
            names.push(format!("and {} more pairs", apart.len() - NAMED));
        }
        lines.push(format!("without contact: {}", names.join(", ")));
    }
    lines.join("\n") + "\n"
}
