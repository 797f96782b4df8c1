//! `striae run DECK`: a simulation from a deck to files.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use striae_deck::{self as deck, Deck};
use striae_output::{
    checkpoint::{Source, fingerprint},
    summary::Summary,
};
use striae_solve::outcome::Ending;

use crate::{
    failure::Failure,
    progress::Verbosity,
    simulation::{Interrupt, Simulation, simulate_file},
};

/// Run a deck.
#[derive(clap::Args)]
pub struct Arguments {
    /// The deck.
    deck: PathBuf,
    /// Folder for the output; by default results/NAME.
    #[arg(long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    common: Common,
}

/// Options of everything that runs simulations.
#[derive(clap::Args)]
pub struct Common {
    /// Number of threads; by default that of the machine.
    #[arg(long)]
    threads: Option<std::num::NonZeroUsize>,
    /// Say nothing but errors and results.
    #[arg(long)]
    quiet: bool,
    /// Show the residual norms of every iteration.
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    /// End with exit code 1 if there are warnings.
    #[arg(long)]
    strict: bool,
}

/// What warnings do to the exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strictness {
    /// Nothing.
    Lenient,
    /// They make it 1.
    Strict,
}

impl Common {
    /// How much is said.
    pub fn verbosity(&self) -> Verbosity {
        match (self.quiet, self.verbose) {
            (true, _) => Verbosity::Quiet,
            (_, true) => Verbosity::Iterations,
            _ => Verbosity::Normal,
        }
    }

    /// What warnings do.
    pub fn strictness(&self) -> Strictness {
        if self.strict {
            Strictness::Strict
        } else {
            Strictness::Lenient
        }
    }

    /// Sets the number of threads for the whole program.
    pub fn start_threads(&self) -> Result<(), Failure> {
        let threads = self.threads.map_or(0, std::num::NonZeroUsize::get);
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|cause| Failure::Threads(cause.to_string()))
    }
}

/// Runs the deck and prints what came of it.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    arguments.common.start_threads()?;
    let deck = deck::read(&arguments.deck)?;
    let case = case_name(&arguments.deck);
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| Path::new("results").join(&case));
    let verbosity = arguments.common.verbosity();
    let source = source(&arguments.deck, case, &deck);
    let simulation = simulate_file(deck, source, &folder, verbosity, &Interrupt::listen())?;
    concluded(simulation, &folder, arguments.common.strictness(), out)
}

/// The deck of a run, for its checkpoints.
fn source(path: &Path, case: String, deck: &Deck) -> Source {
    Source {
        case,
        path: std::path::absolute(path).unwrap_or_else(|_| path.to_owned()),
        fingerprint: fingerprint(&deck.model, deck.output),
    }
}

/// Prints what came of a run.
pub fn concluded(
    simulation: Simulation,
    folder: &Path,
    strictness: Strictness,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let warnings = &simulation.summary.warnings;
    warn(&simulation.summary);
    write!(out, "{}", told(&simulation.summary))?;
    writeln!(out, "output in {}", folder.display())?;
    match simulation.ending {
        Ending::Completed if strictness == Strictness::Strict && !warnings.is_empty() => {
            Err(Failure::Warned(warnings.len()))
        }
        Ending::Completed => Ok(()),
        Ending::Interrupted { time } => Err(Failure::Interrupted {
            time,
            folder: folder.to_owned(),
        }),
        ending @ Ending::Stopped { .. } => Err(Failure::Ended(Box::new(ending))),
    }
}

/// Warnings of a run, on the standard error.
pub fn warn(summary: &Summary) {
    for warning in &summary.warnings {
        eprintln!("warning: {}", warning.text);
    }
}

/// The folder of a `deck.toml`, otherwise the name of the file.
pub fn case_name(deck: &Path) -> String {
    let stem = deck
        .file_stem()
        .map(|name| name.to_string_lossy().into_owned());
    let full = std::path::absolute(deck).unwrap_or_else(|_| deck.to_owned());
    let parent = full
        .parent()
        .and_then(Path::file_name)
        .map(|name| name.to_string_lossy().into_owned());
    match (stem.as_deref(), parent) {
        (Some("deck"), Some(parent)) => parent,
        _ => stem.unwrap_or_else(|| "run".to_owned()),
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
    for pair in &summary.pairs {
        let [x, y, z] = pair.resultant_a;
        lines.push(format!(
            "pair `{}`: force on a ({x:.6e}, {y:.6e}, {z:.6e}), mismatch {:.1e}; stick {}, slip {}, open {}; dissipated {:.6e}",
            pair.name, pair.mismatch, pair.stick, pair.slip, pair.open, pair.dissipated
        ));
    }
    lines.join("\n") + "\n"
}
