//! Writes a run to a folder: fields, history and summary.
//!
//! ```text
//! DIR/history.csv           a row an increment
//! DIR/probes.csv            the same of places that are watched, see [`crate::Probe`]
//! DIR/sections.csv          forces through cuts, see [`crate::Section`]
//! DIR/bodies.pvd            fields of bodies, see [`crate::BodyField`], and named variables
//!                           of laws with a memory by element
//! DIR/contact.pvd           fields of contact surfaces, see [`crate::ContactField`], and wear
//! DIR/rigid.pvd             rigid surfaces: displacement, texture `s`, structural vector
//! DIR/ties.pvd              tied surfaces: tractions
//! DIR/fields/*.vtu          what the collections list; on several ranks `.pvtu` files of bodies,
//!                           which name a `.vtu` piece of every rank
//! DIR/summary.json          how the run ended
//! DIR/checkpoint.bin        where a run under way is, see [`crate::checkpoint`]
//! ```
//!
//! All are also written at time 0; gaps, normals and textures of contact are known then.
//!
//! Everything is on disk after each increment.
//!
//! Of a run on several ranks all of them have a recorder, whose functions are collective. Each
//! writes its pieces of the bodies, rank 0 all else, and what fails on one fails on all.

use std::{
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use striae_contact::unknowns::NodeResult;
use striae_solve::{
    drive::Progress, newton::Increment, outcome::Ending, problem::Problem, report::surfaces,
    share::Share, state::State,
};

use crate::{
    FieldOutput, Output, OutputError,
    checkpoint::{Index, Written},
    checksums::{Checksums, check, sum},
    collections::{Collections, Contact},
    folder::{Claim, Existing, remove_fields},
    history::{History, Table},
    kept::{HISTORY, continued},
    ranks::{agreed, from_first, is_first, on_first},
    row::{before_touch, row},
    summary::{Summary, WarningSummary},
    tally::Tally,
    vtk::Snapshot,
    watched::{FILES, Watched},
    worn::Worn,
};

/// Tables, which grow.
const TABLES: [&str; 3] = [HISTORY, FILES[0], FILES[1]];

/// Longest time between checkpoints but for that of an increment: what a run loses that is killed.
const KEPT: Duration = Duration::from_secs(60);

/// Time over the interval of fields that is round-off.
const ROUND_OFF: f64 = 1e-9;

/// Writes the output of one run.
pub struct Recorder {
    share: Share,
    /// Of rank 0.
    _claim: Option<Claim>,
    folder: PathBuf,
    case: String,
    output: Output,
    /// Seconds spent before a restart.
    spent: f64,
    /// Of rank 0.
    history: Option<History>,
    /// Columns of the history.
    columns: Vec<String>,
    fields: Collections,
    started: Instant,
    /// Time of the last checkpoint, or of the start of the run.
    kept: Instant,
    tally: Tally,
    written: Option<usize>,
    worn: Worn,
    /// Places and cuts that are watched, once they are found.
    watched: Option<Watched>,
    /// Time of the last increment.
    elapsed: f64,
}

impl Recorder {
    /// Makes the folder and an empty history.
    ///
    /// # Errors
    /// When a file cannot be written, or the folder belongs to other results or another run.
    pub fn create(
        folder: &Path,
        case: &str,
        output: Output,
        existing: Existing,
    ) -> Result<Self, OutputError> {
        Self::shared(&Share::alone(), folder, case, output, existing)
    }

    /// Starts a recorder for one of several ranks.
    ///
    /// # Errors
    /// If a file cannot be written, or the folder belongs to other results or another run.
    pub fn shared(
        share: &Share,
        folder: &Path,
        case: &str,
        output: Output,
        existing: Existing,
    ) -> Result<Self, OutputError> {
        Ok(Self {
            share: share.clone(),
            _claim: on_first(share, || Claim::new(folder, existing))?,
            history: on_first(share, || History::create(folder.join(HISTORY)))?,
            columns: Vec::new(),
            fields: Collections::resumed(folder, &Default::default(), Checksums::new()),
            folder: folder.to_owned(),
            case: case.to_owned(),
            output,
            spent: 0.0,
            started: Instant::now(),
            kept: Instant::now(),
            tally: Tally::default(),
            written: None,
            worn: Worn::default(),
            watched: None,
            elapsed: 0.0,
        })
    }

    /// Continues where an earlier recorder was at a checkpoint.
    ///
    /// # Errors
    /// When the output is not there, or cannot be written.
    pub fn resume(
        folder: &Path,
        case: &str,
        output: Output,
        written: &Written,
    ) -> Result<Self, OutputError> {
        Self::resume_shared(&Share::alone(), folder, case, output, written)
    }

    /// Resumes a recorder for one of several ranks.
    ///
    /// # Errors
    /// If the output is missing or cannot be written.
    pub fn resume_shared(
        share: &Share,
        folder: &Path,
        case: &str,
        output: Output,
        written: &Written,
    ) -> Result<Self, OutputError> {
        let claim = on_first(share, || Claim::awaited(folder))?;
        on_first(share, || match Index::read(folder) {
            Ok(index) if index.written().iterations == written.iterations => Ok(()),
            _ => Err(OutputError::GoneOn(folder.to_owned())),
        })?;
        let sums = written.sums.iter().filter(|(name, _)| name != HISTORY);
        on_first(share, || check(folder, sums))?;
        let fields = written.sums.iter();
        let fields = fields.filter(|(name, _)| !TABLES.contains(&name.as_str()));
        let rows = written.iterations.len();
        if written.fields != Some(rows) {
            on_first(share, || remove_fields(&folder.join("fields"), rows))?;
        }
        Ok(Self {
            share: share.clone(),
            _claim: claim,
            history: on_first(share, || continued(folder, written))?,
            columns: written.columns.clone(),
            fields: Collections::resumed(folder, &written.series, fields.cloned().collect()),
            folder: folder.to_owned(),
            case: case.to_owned(),
            output,
            spent: written.seconds,
            started: Instant::now(),
            kept: Instant::now(),
            tally: Tally {
                iterations: written.iterations.clone(),
                cut_backs: written.cut_backs,
                unknowns: written.unknowns,
                solver: written.solver.clone(),
                judgement: written.judgement.clone(),
            },
            written: written.fields,
            worn: written.worn.clone(),
            watched: None,
            elapsed: written.elapsed,
        })
    }

    /// Record of what is on disk, for a checkpoint: nothing on ranks other than the first.
    ///
    /// # Errors
    /// If a file cannot be read back.
    pub fn written(&self) -> Result<Written, OutputError> {
        let written = on_first(&self.share, || self.written_here())?;
        Ok(written.unwrap_or_default())
    }

    fn written_here(&self) -> Result<Written, OutputError> {
        let tally = &self.tally;
        let mut sums = self.fields.sums().clone();
        for name in TABLES
            .into_iter()
            .filter(|name| self.folder.join(name).exists())
        {
            sums.push(sum(&self.folder, Path::new(name))?);
        }
        Ok(Written {
            iterations: tally.iterations.clone(),
            columns: self.columns.clone(),
            cut_backs: tally.cut_backs,
            unknowns: tally.unknowns,
            solver: tally.solver.clone(),
            fields: self.written,
            seconds: self.seconds(),
            series: self.fields.snapshots().map(<[Snapshot]>::to_vec),
            judgement: tally.judgement.clone(),
            worn: self.worn.clone(),
            elapsed: self.elapsed,
            sums,
        })
    }

    /// Returns whether a checkpoint is due after so many increments; ranks may disagree, as each
    /// has its own clock.
    pub fn keeps(&self, increment: usize) -> bool {
        let is_late = || self.kept.elapsed() >= KEPT;
        let every = self.output.checkpoint_every;
        every.is_some_and(|every| increment.is_multiple_of(every.get()) || is_late())
    }

    /// True where checkpoints are kept in the course of the run.
    pub fn keeps_any(&self) -> bool {
        self.output.checkpoint_every.is_some()
    }

    /// A checkpoint has been written.
    pub fn kept(&mut self) {
        self.kept = Instant::now();
    }

    fn seconds(&self) -> f64 {
        self.spent + self.started.elapsed().as_secs_f64()
    }

    /// Judges a converged increment by what it came from.
    pub fn judge(&mut self, problem: &Problem, before: &State, increment: &Increment) {
        self.elapsed = increment.state.time - before.time;
        self.tally.judge(problem, before, increment);
    }

    /// Notes an increment that was cut.
    pub fn cut_back(&mut self) {
        self.tally.cut_backs += 1;
    }

    /// Writes fields as a run finds them, unless only its end is wanted.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn start(&mut self, problem: &Problem, state: &State) -> Result<(), OutputError> {
        if self.output.fields == FieldOutput::Last {
            return Ok(());
        }
        self.written = Some(0);
        let found = surfaces(problem, state);
        self.write(problem, state, 0, &found.iter().collect::<Vec<_>>())
    }

    /// Writes a converged increment.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn increment(
        &mut self,
        problem: &Problem,
        progress: Progress,
        increment: &Increment,
    ) -> Result<(), OutputError> {
        self.tally.increment(increment);
        let cut_backs = self.tally.cut_backs;
        let row = row(problem, progress, increment, cut_backs, &self.columns);
        let named: Vec<(&str, f64)> = row.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        let appended = match &mut self.history {
            Some(file) => file.append_wider(&named, |column| before_touch(&row, column)),
            None => Ok(()),
        };
        agreed(&self.share, appended)?;
        self.columns = row.into_iter().map(|(name, _)| name).collect();
        self.worn.add(&increment.state);
        self.watch(problem, progress, &increment.state)?;
        let is_due = match self.output.fields {
            FieldOutput::Every(every) => progress.increment.is_multiple_of(every.get()),
            FieldOutput::Interval(interval) => self.has_passed(interval, increment.state.time),
            FieldOutput::Last => false,
        };
        // Rank 0 knows what has been written.
        match self.share.any(is_first(&self.share) && is_due) {
            true => self.write_fields(problem, &increment.state),
            false => Ok(()),
        }
    }

    /// Returns whether a multiple of the interval lies between the last fields and now.
    fn has_passed(&self, interval: f64, time: f64) -> bool {
        let series = self.fields.snapshots().into_iter();
        let last = series.filter_map(<[Snapshot]>::last);
        let last = last.map(|snapshot| snapshot.time).fold(0.0, f64::max);
        let multiples = |time: f64| (time / interval * (1.0 + ROUND_OFF)).floor();
        multiples(time) > multiples(last)
    }

    /// Writes the rows of all that is watched.
    fn watch(
        &mut self,
        problem: &Problem,
        progress: Progress,
        state: &State,
    ) -> Result<(), OutputError> {
        let before = self.tally.iterations.len() - 1;
        let watched = match &mut self.watched {
            Some(known) => known,
            none => none.insert(Watched::open(&self.folder, problem, &self.output, before)?),
        };
        watched.append(problem, progress, state)
    }

    /// Writes the last fields, if they are not there, and the summary with further warnings.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn finish(
        &mut self,
        problem: &Problem,
        state: &State,
        ending: &Ending,
        further: Vec<WarningSummary>,
    ) -> Result<Summary, OutputError> {
        let count = self.tally.iterations.len();
        if count > 0 && self.written != Some(count) {
            self.write_fields(problem, state)?;
        }
        let (case, seconds) = (&self.case, self.seconds());
        let tally = &self.tally;
        let summary = tally.summary(case, problem, state, ending, seconds, further);
        let file = self.folder.join("summary.json");
        on_first(&self.share, || summary.write(&file))?;
        Ok(summary)
    }

    /// The history so far, on all ranks.
    ///
    /// # Errors
    /// When it cannot be read back.
    pub fn table(&self) -> Result<Table, OutputError> {
        let file = self.folder.join(HISTORY);
        let read = || Table::read(&file).map(|table| (table.columns, table.rows));
        let (columns, rows) = from_first(&self.share, read)?;
        Ok(Table { columns, rows })
    }

    fn write_fields(&mut self, problem: &Problem, state: &State) -> Result<(), OutputError> {
        let count = self.tally.iterations.len();
        self.written = Some(count);
        let nodes = state.pairs.iter().map(|pair| &pair.nodes);
        self.write(problem, state, count, &nodes.collect::<Vec<_>>())
    }

    /// Writes all fields, with results at contact nodes by pair and side.
    fn write(
        &mut self,
        problem: &Problem,
        state: &State,
        count: usize,
        nodes: &[&[Vec<NodeResult>; 2]],
    ) -> Result<(), OutputError> {
        let fields = &mut self.fields;
        fields.write_bodies(problem, state, count, &self.output)?;
        let contact = Contact {
            nodes,
            worn: &self.worn,
            elapsed: self.elapsed,
        };
        let written = on_first(&self.share, || {
            fields.write_rigid(problem, state, count)?;
            fields.write_contact(problem, state, count, &self.output, &contact)?;
            fields.write_ties(problem, state, count)?;
            fields.sum_up()
        });
        written.map(|_| ())
    }
}
