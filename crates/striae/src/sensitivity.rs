//! Derivatives of a run by parameters of its model, see [`striae_solve::sensitivity`].

use std::{path::Path, sync::Arc};

use striae_deck::{Laws, Reader, Setting};
use striae_model::{Model, Validate};
use striae_output::{
    OutputError,
    checkpoint::model_fingerprint,
    history::{COUNTS, History, Table},
    listed, state_row,
    summary::WarningSummary,
};
use striae_solve::{
    drive::Progress,
    newton::{Increment, Workspace},
    outcome::CutBack,
    problem::Problem,
    sensitivity::{Kink, Neighbours, Parameter, Sensitivities},
};

use crate::{error::Error, results::Results};

/// Step of a parameter over its value: errors of the order of its square, and those of round-off
/// over it, are about 1e-9 of a derivative.
const STEP: f64 = 1e-5;
/// Uncertainty of a derivative, as part of the largest until then, above which there is a warning.
const UNCERTAIN: f64 = 1e-5;

/// Columns before the derivatives.
const HEAD: [&str; 3] = ["increment", "step", "time"];

/// Derivatives of a run by a parameter.
#[derive(Clone, Debug)]
pub struct Sensitivity {
    /// Derivatives of the columns of the history that follow from the state, in their order, after
    /// `increment`, `step` and `time` themselves.
    pub history: Table,
    /// Time at which they end before the run, and why.
    pub ended: Option<(f64, CutBack)>,
    neighbours: Neighbours,
}

impl Sensitivity {
    /// Name of the parameter.
    pub fn parameter(&self) -> &str {
        &self.neighbours.parameter.name
    }

    /// Derivative of a quantity at the end of the run, to the second order of the parameter's step.
    pub fn derivative(&self, quantity: impl Fn(&Results<'_>) -> f64) -> f64 {
        let of = |problem: &Problem, state: &_| quantity(&Results::new(problem, state));
        self.neighbours.derivative(of)
    }

    /// The two neighbours of the run at its end, for derivatives of other quantities.
    pub fn neighbours(&self) -> &Neighbours {
        &self.neighbours
    }

    /// Nodes at which derivatives are one-sided.
    pub fn kinks(&self) -> &[Kink] {
        &self.neighbours.kinks
    }
}

/// A parameter with the value that a run has, and the models on both sides of it.
///
/// # Errors
/// Faults of these models, and what `model` returns.
pub fn parameter<E: Into<Error>>(
    name: impl Into<String>,
    value: f64,
    model: impl Fn(f64) -> Result<Model, E>,
) -> Result<Parameter, Error> {
    let step = step(value);
    let model = |value| model(value).map_err(E::into);
    between(name, step, [model(value - step)?, model(value + step)?])
}

/// A parameter of a step `h`, with the models at `p - h` and `p + h`.
///
/// # Errors
/// Faults of the models.
pub fn between(
    name: impl Into<String>,
    step: f64,
    [less, more]: [Model; 2],
) -> Result<Parameter, Error> {
    let problem = |model: Model| -> Result<Arc<Problem>, Error> {
        Ok(Arc::new(Problem::new(model.checked()?)?))
    };
    Ok(Parameter {
        name: name.into(),
        step,
        problems: [problem(less)?, problem(more)?],
    })
}

/// A parameter of a deck in a file, or another number of it by its path, such as
/// `pair.pad.friction.mu`.
///
/// # Errors
/// Faults of the deck, and where it has no such number.
pub fn of_deck(deck: &Path, settings: &[Setting], name: &str) -> Result<Parameter, Error> {
    let names = [name.to_owned()];
    let laws = Laws::default();
    let value = Reader::new(&laws, settings).numbers(deck, &names)?[0];
    parameter(name, value, |value| {
        let moved = Setting::new(name, value);
        let settings = [settings, &[moved]].concat();
        Ok::<_, Error>(striae_deck::read_with(deck, &settings)?.model)
    })
}

/// The step of a parameter: of about 1e-5 of its value, or 1e-5 where that is zero, such that
/// value and step add up without round-off.
pub fn step(value: f64) -> f64 {
    let wanted = match value == 0.0 {
        true => STEP,
        false => STEP * value.abs(),
    };
    (value + wanted) - value
}

/// Neighbours of a run and the tables of its derivatives.
pub(crate) struct Followed {
    sensitivities: Sensitivities,
    tables: Vec<Table>,
    files: Option<Vec<History>>,
    ended: Option<(f64, CutBack)>,
}

impl Followed {
    /// Neighbours of a run that begins, whose derivatives are written to a folder if one is given.
    pub(crate) fn new(
        sensitivities: Sensitivities,
        folder: Option<&Path>,
    ) -> Result<Self, OutputError> {
        let files = folder.map(|folder| {
            let neighbours = sensitivities.neighbours().iter();
            let names = neighbours.map(|of| file_name(&of.parameter.name));
            names
                .map(|name| History::create(folder.join(name)))
                .collect()
        });
        Ok(Self {
            tables: vec![Table::default(); sensitivities.neighbours().len()],
            files: files.transpose()?,
            sensitivities,
            ended: None,
        })
    }

    pub(crate) fn step(&mut self, index: usize, time: f64) {
        if self.ended.is_none() {
            let begun = self.sensitivities.step(index);
            self.ended = begun.err().map(|reason| (time, reason));
        }
    }

    pub(crate) fn cut_back(&mut self, reason: &CutBack) {
        self.sensitivities.cut_back(reason);
    }

    /// Follows an increment and takes down its derivatives.
    pub(crate) fn increment(
        &mut self,
        progress: Progress,
        increment: &Increment,
        run: &Workspace,
    ) -> Result<(), OutputError> {
        if self.ended.is_some() {
            return Ok(());
        }
        if let Err(reason) = self.sensitivities.increment(progress, increment, run) {
            self.ended = Some((progress.time, reason));
            return Ok(());
        }
        let neighbours = self.sensitivities.neighbours().iter();
        for (at, (of, table)) in neighbours.zip(&mut self.tables).enumerate() {
            // Those of the history, though a neighbour may touch more or less.
            let listed = listed(&of.parameter.problems[0], &increment.state, &table.columns);
            let row = derivatives(progress, of, &listed);
            let named: Vec<(&str, f64)> = row.iter().map(|(n, v)| (n.as_str(), *v)).collect();
            if let Some(files) = &mut self.files {
                files[at].append_wider(&named, |_| 0.0)?;
            }
            let (columns, values): (Vec<&str>, _) = named.into_iter().unzip();
            table.widen(&columns, |_| 0.0);
            table.rows.push(values);
        }
        Ok(())
    }

    /// Reasons to distrust the derivatives.
    pub(crate) fn warnings(&self) -> Vec<WarningSummary> {
        let neighbours = self.sensitivities.neighbours();
        let ended = self.ended.iter().map(|(time, reason)| WarningSummary {
            kind: "sensitivity".to_owned(),
            pair: None,
            value: *time,
            limit: 0.0,
            time: *time,
            text: format!("derivatives of the run end before time {time}: {reason}"),
        });
        let of_each = neighbours.iter().zip(&self.tables);
        let of_each =
            of_each.flat_map(|(of, table)| [unused(of, table), kinked(of), uncertain(of)]);
        ended.chain(of_each.flatten()).collect()
    }

    pub(crate) fn finish(self) -> Vec<Sensitivity> {
        let neighbours = self.sensitivities.neighbours().to_vec().into_iter();
        let found = neighbours.zip(self.tables);
        found
            .map(|(neighbours, history)| Sensitivity {
                history,
                ended: self.ended.clone(),
                neighbours,
            })
            .collect()
    }
}

/// Name of the file of the derivatives by a parameter.
fn file_name(parameter: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "._-".contains(c);
    let name = parameter.chars().map(|c| if plain(c) { c } else { '_' });
    format!("sensitivity-{}.csv", name.collect::<String>())
}

/// The row of derivatives after an increment, of pairs that are listed.
fn derivatives(progress: Progress, of: &Neighbours, listed: &[bool]) -> Vec<(String, f64)> {
    let rows = [0, 1].map(|at| state_row(&of.parameter.problems[at], &of.states[at], listed));
    let counts = |name: &str| {
        let last = name.rsplit('.').next();
        last.is_some_and(|last| COUNTS.contains(&last))
    };
    let [less, more] = rows;
    let head = [
        progress.increment as f64,
        (progress.step + 1) as f64,
        progress.time,
    ];
    let head = HEAD.map(str::to_owned).into_iter().zip(head);
    let rest = less.into_iter().zip(more);
    let rest = rest.filter(|((name, _), _)| !counts(name));
    let rest =
        rest.map(|((name, less), (_, more))| (name, (more - less) / (2.0 * of.parameter.step)));
    head.chain(rest).collect()
}

/// The warning that a model does not depend on a parameter.
fn unused(of: &Neighbours, table: &Table) -> Option<WarningSummary> {
    let Parameter { name, problems, .. } = &of.parameter;
    let head = HEAD.len();
    let mut derivatives = table.rows.iter().flat_map(|row| &row[head..]);
    // What a law of one's own contains is no part of the fingerprint.
    let is_zero = derivatives.all(|derivative| *derivative == 0.0);
    let [less, more] = problems.each_ref().map(|problem| &problem.model);
    let is_unused = is_zero && model_fingerprint(less) == model_fingerprint(more);
    is_unused.then(|| WarningSummary {
        kind: "sensitivity".to_owned(),
        pair: None,
        value: 0.0,
        limit: 0.0,
        time: of.states[0].time,
        text: format!(
            "derivatives by `{name}` are all zero, as the model does not depend on it; name a number that the model uses"
        ),
    })
}

/// The warning of kinks.
fn kinked(of: &Neighbours) -> Option<WarningSummary> {
    let first = of.kinks.first()?;
    let Parameter { name, problems, .. } = &of.parameter;
    let pair = &problems[0].model.pairs[first.pair].name;
    let [less, more] = first
        .statuses
        .map(|status| format!("{status:?}").to_lowercase());
    Some(WarningSummary {
        kind: "kink".to_owned(),
        pair: Some(pair.clone()),
        value: of.kinks.len() as f64,
        limit: 0.0,
        time: first.time,
        text: format!(
            "derivatives by `{name}` are one-sided: contact node {} on side {} of pair `{pair}` is at a kink at time {}, {less} below the value and {more} above{}",
            first.node.index(),
            first.side,
            first.time,
            match of.kinks.len() {
                1 => String::new(),
                count => format!(", and {} more in the run", count - 1),
            }
        ),
    })
}

/// The warning of an uncertain derivative.
fn uncertain(of: &Neighbours) -> Option<WarningSummary> {
    let uncertain = of.remainder > UNCERTAIN;
    uncertain.then(|| WarningSummary {
        kind: "sensitivity".to_owned(),
        pair: None,
        value: of.remainder,
        limit: UNCERTAIN,
        time: of.states[0].time,
        text: format!(
            "derivatives by `{}` are uncertain by {:.0e} of their size in one increment at least, where the tangent changes within the step {:.1e} of the parameter",
            of.parameter.name, of.remainder, of.parameter.step
        ),
    })
}
