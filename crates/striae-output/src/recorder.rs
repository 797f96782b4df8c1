//! Writes a run to a folder: fields, history and summary.
//!
//! ```text
//! DIR/history.csv           a row an increment
//! DIR/probes.csv            the same of places that are watched, see [`crate::Probe`]
//! DIR/bodies.pvd            fields of bodies, see [`crate::BodyField`], and named variables
//!                           of laws with a memory by element
//! DIR/contact.pvd           gap, pressure, tractions, slip, what it has done since the start,
//!                           normal, texture `s`, structural vector `a = n x s`, status,
//!                           kept, pointed; wear depth
//! DIR/rigid.pvd             rigid surfaces: displacement, texture `s`, structural vector
//! DIR/fields/*.vtu          what the collections list
//! DIR/summary.json          how the run ended
//! DIR/checkpoint.bin        where a run under way is, see [`crate::checkpoint`]
//! ```
//!
//! Bodies and rigid surfaces are also written as they are at time 0; contact is known
//! after the first increment.
//!
//! Everything is on disk after each increment.

use std::{
    path::{Path, PathBuf},
    time::Instant,
};

use striae_solve::{
    drive::Progress, newton::Increment, outcome::Ending, problem::Problem, state::State,
};

use crate::{
    FieldOutput, Output, OutputError,
    bodies::body_grid,
    checkpoint::Written,
    checksums::{Checksums, check, sum},
    folder::{Claim, Existing, remove_fields},
    history::History,
    probes::Probes,
    rigid::RigidGrid,
    row::row,
    summary::Summary,
    surfaces::write_surface,
    tally::Tally,
    vtk::{Series, Snapshot, write},
    worn::Worn,
};

/// Tables, which grow.
const TABLES: [&str; 2] = ["history.csv", "probes.csv"];

/// Time over the interval of fields that is round-off.
const ROUND_OFF: f64 = 1e-9;

/// Writes the output of one run.
pub struct Recorder {
    _claim: Claim,
    folder: PathBuf,
    case: String,
    output: Output,
    /// Seconds spent before a restart.
    spent: f64,
    history: History,
    bodies: Series,
    contact: Series,
    rigid: Series,
    /// Rigid surfaces at rest, once they are needed.
    rigid_grids: Option<Vec<RigidGrid>>,
    started: Instant,
    tally: Tally,
    written: Option<usize>,
    worn: Worn,
    /// Places that are watched, once they are found.
    probes: Option<Probes>,
    /// Checksums of the files of fields.
    sums: Checksums,
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
        Ok(Self {
            _claim: Claim::new(folder, existing)?,
            history: History::create(folder.join("history.csv"))?,
            bodies: Series::new(folder.join("bodies.pvd")),
            contact: Series::new(folder.join("contact.pvd")),
            rigid: Series::new(folder.join("rigid.pvd")),
            rigid_grids: None,
            folder: folder.to_owned(),
            case: case.to_owned(),
            output,
            spent: 0.0,
            started: Instant::now(),
            tally: Tally::default(),
            written: None,
            worn: Worn::default(),
            probes: None,
            sums: Checksums::new(),
        })
    }

    /// Goes on where an earlier recorder was at a checkpoint.
    ///
    /// # Errors
    /// When the output is not there, or cannot be written.
    pub fn resume(
        folder: &Path,
        case: &str,
        output: Output,
        written: &Written,
    ) -> Result<Self, OutputError> {
        let claim = Claim::of(folder)?;
        check(folder, &written.sums)?;
        let fields = written.sums.iter();
        let fields = fields.filter(|(name, _)| !TABLES.contains(&name.as_str()));
        let rows = written.iterations.len();
        if written.fields != Some(rows) {
            remove_fields(&folder.join("fields"), rows)?;
        }
        let [bodies, contact, rigid] = &written.series;
        Ok(Self {
            _claim: claim,
            history: History::resume(folder.join("history.csv"), rows)?,
            bodies: Series::resumed(folder.join("bodies.pvd"), bodies.clone()),
            contact: Series::resumed(folder.join("contact.pvd"), contact.clone()),
            rigid: Series::resumed(folder.join("rigid.pvd"), rigid.clone()),
            rigid_grids: None,
            folder: folder.to_owned(),
            case: case.to_owned(),
            output,
            spent: written.seconds,
            started: Instant::now(),
            tally: Tally {
                iterations: written.iterations.clone(),
                cut_backs: written.cut_backs,
                unknowns: written.unknowns,
                solver: written.solver.clone(),
                judgement: written.judgement.clone(),
            },
            written: written.fields,
            worn: written.worn.clone(),
            probes: None,
            sums: fields.cloned().collect(),
        })
    }

    /// What is on disk, for a checkpoint.
    ///
    /// # Errors
    /// When a file cannot be read back.
    pub fn written(&self) -> Result<Written, OutputError> {
        let tally = &self.tally;
        let mut sums = self.sums.clone();
        for name in TABLES
            .into_iter()
            .filter(|name| self.folder.join(name).exists())
        {
            sums.push(sum(&self.folder, Path::new(name))?);
        }
        Ok(Written {
            iterations: tally.iterations.clone(),
            cut_backs: tally.cut_backs,
            unknowns: tally.unknowns,
            solver: tally.solver.clone(),
            fields: self.written,
            seconds: self.seconds(),
            series: [&self.bodies, &self.contact, &self.rigid]
                .map(|series| series.snapshots().to_vec()),
            judgement: tally.judgement.clone(),
            worn: self.worn.clone(),
            sums,
        })
    }

    /// Notes checksums of the fields that were written last.
    fn sum_up(&mut self) -> Result<(), OutputError> {
        for series in [&self.bodies, &self.contact, &self.rigid] {
            for (_, file) in series
                .snapshots()
                .last()
                .into_iter()
                .flat_map(|last| &last.parts)
            {
                let noted = sum(&self.folder, file)?;
                if !self.sums.contains(&noted) {
                    self.sums.push(noted);
                }
            }
        }
        Ok(())
    }

    /// Whether a checkpoint is due after so many increments.
    pub fn keeps(&self, increment: usize) -> bool {
        let every = self.output.checkpoint_every;
        every.is_some_and(|every| increment.is_multiple_of(every.get()))
    }

    fn seconds(&self) -> f64 {
        self.spent + self.started.elapsed().as_secs_f64()
    }

    /// Judges a converged increment by what it came from.
    pub fn judge(&mut self, problem: &Problem, before: &State, increment: &Increment) {
        self.tally.judge(problem, before, increment);
    }

    /// Notes an increment that was cut.
    pub fn cut_back(&mut self) {
        self.tally.cut_backs += 1;
    }

    /// Writes bodies and rigid surfaces as a run finds them, unless only its end is wanted.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn start(&mut self, problem: &Problem, state: &State) -> Result<(), OutputError> {
        if self.output.fields == FieldOutput::Last {
            return Ok(());
        }
        self.written = Some(0);
        self.write_bodies(problem, state, 0)?;
        self.write_rigid(problem, state, 0)?;
        self.sum_up()
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
        let row = row(problem, progress, increment, self.tally.cut_backs);
        let named: Vec<(&str, f64)> = row.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        self.history.append(&named)?;
        self.worn.add(&increment.state);
        self.watch(problem, progress, &increment.state)?;
        let is_due = match self.output.fields {
            FieldOutput::Every(every) => progress.increment.is_multiple_of(every.get()),
            FieldOutput::Interval(interval) => self.has_passed(interval, increment.state.time),
            FieldOutput::Last => false,
        };
        match is_due {
            true => self.write_fields(problem, &increment.state),
            false => Ok(()),
        }
    }

    /// Whether a multiple of the interval lies between the last fields and now.
    fn has_passed(&self, interval: f64, time: f64) -> bool {
        let series = [&self.bodies, &self.contact, &self.rigid];
        let last = series
            .into_iter()
            .flat_map(|series| series.snapshots().last());
        let last = last.map(|snapshot| snapshot.time).fold(0.0, f64::max);
        let multiples = |time: f64| (time / interval * (1.0 + ROUND_OFF)).floor();
        multiples(time) > multiples(last)
    }

    /// Writes the row of all probes.
    fn watch(
        &mut self,
        problem: &Problem,
        progress: Progress,
        state: &State,
    ) -> Result<(), OutputError> {
        if self.output.probes.is_empty() {
            return Ok(());
        }
        let before = self.tally.iterations.len() - 1;
        let file = match &mut self.probes {
            Some(known) => known,
            none => none.insert(Probes::open(
                self.folder.join("probes.csv"),
                problem,
                &self.output.probes,
                before,
            )?),
        };
        file.append(problem, progress, state)
    }

    /// Writes the last fields, if they are not there, and the summary.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn finish(
        &mut self,
        problem: &Problem,
        state: &State,
        ending: &Ending,
    ) -> Result<Summary, OutputError> {
        let count = self.tally.iterations.len();
        if count > 0 && self.written != Some(count) {
            self.write_fields(problem, state)?;
        }
        let (case, seconds) = (&self.case, self.seconds());
        let summary = self.tally.summary(case, problem, state, ending, seconds);
        summary.write(&self.folder.join("summary.json"))?;
        Ok(summary)
    }

    fn write_fields(&mut self, problem: &Problem, state: &State) -> Result<(), OutputError> {
        let count = self.tally.iterations.len();
        self.written = Some(count);
        self.write_bodies(problem, state, count)?;
        self.write_rigid(problem, state, count)?;
        self.write_contact(problem, state, count)?;
        self.sum_up()
    }

    fn write_bodies(
        &mut self,
        problem: &Problem,
        state: &State,
        count: usize,
    ) -> Result<(), OutputError> {
        let mut parts = Vec::new();
        let chosen = self.output.bodies.as_ref();
        for (body, model) in problem.model.bodies.iter().enumerate() {
            if chosen.is_some_and(|chosen| !chosen.contains(&model.name)) {
                continue;
            }
            let file = PathBuf::from(format!("fields/{}-{count:05}.vtu", model.name));
            let grid = body_grid(problem, state, body, &self.output.body_fields);
            write(&self.folder.join(&file), &grid)?;
            parts.push((model.name.clone(), file));
        }
        if parts.is_empty() {
            return Ok(());
        }
        let time = state.time;
        self.bodies.append(Snapshot { time, parts })
    }

    fn write_rigid(
        &mut self,
        problem: &Problem,
        state: &State,
        count: usize,
    ) -> Result<(), OutputError> {
        let grids = self
            .rigid_grids
            .get_or_insert_with(|| RigidGrid::all(problem));
        if grids.is_empty() {
            return Ok(());
        }
        let written = grids
            .iter()
            .map(|rigid| rigid.write(&self.folder, problem, state, count));
        let (time, parts) = (state.time, written.collect::<Result<_, _>>()?);
        self.rigid.append(Snapshot { time, parts })
    }

    fn write_contact(
        &mut self,
        problem: &Problem,
        state: &State,
        count: usize,
    ) -> Result<(), OutputError> {
        let time = state.time;
        let mut parts = Vec::new();
        for pair in 0..problem.pairs.len() {
            for side in 0..2 {
                let Some(body) = problem.pairs[pair].bodies[side] else {
                    continue;
                };
                let pair_name = &problem.model.pairs[pair].name;
                let name = format!("{pair_name}-{}", problem.model.bodies[body].name);
                let file = PathBuf::from(format!("fields/contact-{name}-{count:05}.vtu"));
                let nodes = state.pairs[pair].nodes[side].len();
                let worn = self.worn.of(pair, side, nodes);
                let wear = (&worn[..], self.output.wear_coefficient);
                write_surface(&self.folder.join(&file), problem, state, pair, side, wear)?;
                parts.push((name, file));
            }
        }
        if parts.is_empty() {
            return Ok(());
        }
        self.contact.append(Snapshot { time, parts })
    }
}
