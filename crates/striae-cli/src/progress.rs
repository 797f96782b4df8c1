//! Progress of a run: a live line in a terminal, plain lines in a pipe.
//!
//! Everything goes to the standard error, so that results can be piped.

use std::io::{IsTerminal, Write};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use striae::{Converged, Next, Observer};
use striae_contact::{evaluation::Evaluation, unknowns::Status};
use striae_model::Model;
use striae_solve::{drive::Progress as Position, norms::Norms, outcome::CutBack};

use crate::forecast::{Forecast, clock};

/// Verbosity of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verbosity {
    /// Nothing but errors.
    Quiet,
    /// A line an increment.
    Normal,
    /// Also residual norms by field in every iteration.
    Iterations,
}

/// Display of progress.
pub struct Progress {
    verbosity: Verbosity,
    bar: Option<ProgressBar>,
    steps: Vec<(String, f64)>,
    counts: [usize; 3],
    forecast: Forecast,
}

const RESOLUTION: f64 = 1000.0;

impl Progress {
    /// Progress over the steps of a model.
    pub fn new(model: &Model, verbosity: Verbosity) -> Self {
        let live = verbosity != Verbosity::Quiet && std::io::stderr().is_terminal();
        let length = RESOLUTION as u64 * model.steps.len() as u64;
        let bar = live.then(|| {
            let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{bar:24} {percent:>3}% {elapsed}  {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self {
            verbosity,
            bar,
            steps: model
                .steps
                .iter()
                .map(|step| (step.name.clone(), step.duration))
                .collect(),
            counts: [0; 3],
            forecast: Forecast::new(model),
        }
    }

    /// Takes the live line away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    fn line(&self, text: &str) {
        match &self.bar {
            Some(bar) => bar.println(text),
            // A terminal that is gone does not end the run.
            None => drop(writeln!(std::io::stderr(), "{text}")),
        }
    }
}

impl Observer for Progress {
    fn iteration(&mut self, number: usize, norms: &Norms, contacts: &[Evaluation]) {
        let nodes = || {
            contacts
                .iter()
                .flat_map(|contact| contact.nodes.iter().flatten())
        };
        let count = |status| nodes().filter(|node| node.status == status).count();
        self.counts = [
            count(Status::Stick),
            count(Status::Slip),
            count(Status::Open),
        ];
        if self.verbosity == Verbosity::Iterations {
            self.line(&format!("    iteration {number:2}  {norms}"));
        }
        if let Some(bar) = &self.bar {
            bar.tick();
        }
    }

    fn increment(&mut self, converged: &Converged<'_>) -> Next {
        let Converged {
            progress: position,
            increment,
            ..
        } = *converged;
        let (name, _) = &self.steps[position.step];
        let [stick, slip, open] = self.counts;
        let iterations = match increment.iterations.len() {
            1 => "1 iteration".to_owned(),
            count => format!("{count} iterations"),
        };
        let text = format!(
            "{name} {}/{}  t = {:.4}  {iterations}  stick {stick} slip {slip} open {open}  left {}",
            position.step + 1,
            self.steps.len(),
            position.time,
            clock(self.forecast.left(position)),
        );
        if let Some(reason) = increment.work.fall_back
            && self.verbosity == Verbosity::Iterations
        {
            self.line(&format!("    solver {}: {reason}", increment.work.method));
        }
        if let Some(bar) = &self.bar {
            let done = (position.step as f64 + position.fraction) * RESOLUTION;
            bar.set_position(done as u64);
            bar.set_message(text);
        } else if self.verbosity != Verbosity::Quiet {
            let _ = writeln!(std::io::stderr(), "{:5}  {text}", position.increment);
        }
        Next::Continue
    }

    fn cut_back(&mut self, position: Position, reason: &CutBack) -> Next {
        if self.verbosity != Verbosity::Quiet {
            self.line(&format!(
                "       cut back at t = {:.4}: {reason}",
                position.time
            ));
        }
        Next::Continue
    }
}
