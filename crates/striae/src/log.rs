//! Output of a run: files and checkpoints, or values in memory only.

use std::{path::PathBuf, time::Instant};

use striae_output::{
    Existing, Output, OutputError, Tally, before_touch,
    checkpoint::{Checkpoint, CheckpointError, Source, Written},
    history::Table,
    recorder::Recorder,
    row,
    summary::{Summary, WarningSummary},
};
use striae_solve::{
    drive::{Point, Progress},
    newton::{Increment, Memory as Grown},
    outcome::Ending,
    problem::Problem,
    share::Share,
    state::State,
};

/// Target of a recorded run, and whether it can be resumed from there.
#[derive(Clone, Debug)]
pub(crate) struct Recording {
    /// Folder of the output.
    pub(crate) folder: PathBuf,
    /// Name of the case.
    pub(crate) case: String,
    /// The deck, for checkpoints; without it there are none.
    pub(crate) source: Option<Source>,
    /// Treatment of existing results.
    pub(crate) existing: Existing,
}

/// Takes down what happens.
pub(crate) enum Log {
    Memory(Box<Memory>),
    Files(Box<Files>),
}

/// Values of a run that writes no files.
pub(crate) struct Memory {
    started: Instant,
    tally: Tally,
    history: Table,
}

/// Files of a run.
pub(crate) struct Files {
    recorder: Recorder,
    recording: Recording,
}

impl Log {
    /// The log of a run that begins.
    pub(crate) fn new(
        share: &Share,
        recording: Option<Recording>,
        output: Output,
    ) -> Result<Self, OutputError> {
        let Some(recording) = recording else {
            return Ok(Self::Memory(Box::new(Memory {
                started: Instant::now(),
                tally: Tally::default(),
                history: Table {
                    columns: Vec::new(),
                    rows: Vec::new(),
                },
            })));
        };
        let recorder = Recorder::shared(
            share,
            &recording.folder,
            &recording.case,
            output,
            recording.existing,
        )?;
        Ok(Self::Files(Box::new(Files {
            recorder,
            recording,
        })))
    }

    /// The log of a run that is resumed.
    pub(crate) fn resumed(
        share: &Share,
        recording: Recording,
        output: Output,
        written: &Written,
    ) -> Result<Self, CheckpointError> {
        let Recording { folder, case, .. } = &recording;
        let recorder = Recorder::resume_shared(share, folder, case, output, written)?;
        Ok(Self::Files(Box::new(Files {
            recorder,
            recording,
        })))
    }

    /// Takes down the state in which a run begins.
    pub(crate) fn start(&mut self, problem: &Problem, state: &State) -> Result<(), OutputError> {
        match self {
            Self::Memory(_) => Ok(()),
            Self::Files(files) => files.recorder.start(problem, state),
        }
    }

    /// Writes the checkpoint of the start, so that a run that is killed before its first
    /// increment has one, where there are any.
    pub(crate) fn begin(&mut self, problem: &Problem, point: Point) -> Result<(), OutputError> {
        let keeps = match self {
            Self::Memory(_) => false,
            Self::Files(files) => files.recorder.keeps_any(),
        };
        match keeps {
            true => self.point(problem, point),
            false => Ok(()),
        }
    }

    /// Returns whether a checkpoint is due.
    pub(crate) fn keeps(&self, increment: usize) -> bool {
        match self {
            Self::Memory(_) => false,
            Self::Files(files) => {
                files.recording.source.is_some() && files.recorder.keeps(increment)
            }
        }
    }

    /// Judges a converged increment by the state before it.
    pub(crate) fn judge(&mut self, problem: &Problem, before: &State, increment: &Increment) {
        match self {
            Self::Memory(memory) => memory.tally.judge(problem, before, increment),
            Self::Files(files) => files.recorder.judge(problem, before, increment),
        }
    }

    /// Takes down a converged increment.
    pub(crate) fn increment(
        &mut self,
        problem: &Problem,
        progress: Progress,
        increment: &Increment,
    ) -> Result<(), OutputError> {
        match self {
            Self::Memory(memory) => {
                memory.increment(problem, progress, increment);
                Ok(())
            }
            Self::Files(files) => files.recorder.increment(problem, progress, increment),
        }
    }

    /// Counts an increment that was cut.
    pub(crate) fn cut_back(&mut self) {
        match self {
            Self::Memory(memory) => memory.tally.cut_backs += 1,
            Self::Files(files) => files.recorder.cut_back(),
        }
    }

    /// Writes a checkpoint, where there are any.
    pub(crate) fn point(&mut self, problem: &Problem, point: Point) -> Result<(), OutputError> {
        let Self::Files(files) = self else {
            return Ok(());
        };
        let Some(source) = files.recording.source.clone() else {
            return Ok(());
        };
        let checkpoint = Checkpoint {
            source,
            written: files.recorder.written()?,
            point,
        };
        checkpoint.write_shared(&files.recording.folder, problem)?;
        files.recorder.kept();
        Ok(())
    }

    /// Writes the checkpoint of the end of a run, from which it can continue with other steps, if
    /// there are any.
    pub(crate) fn end(
        &self,
        problem: &Problem,
        increments: usize,
        state: &State,
    ) -> Result<(), OutputError> {
        let Self::Files(files) = self else {
            return Ok(());
        };
        let (Some(source), Some(step)) = (
            files.recording.source.clone(),
            problem.model.steps.len().checked_sub(1),
        ) else {
            return Ok(());
        };
        let checkpoint = Checkpoint {
            source,
            written: Written::default(),
            point: Point {
                step,
                increments,
                fraction: 1.0,
                size: 1.0,
                doubted: 0,
                search: Vec::new(),
                start: state.clone(),
                state: state.clone(),
                memory: Grown::default(),
            },
        };
        checkpoint.write_end(&files.recording.folder, problem)
    }

    /// Summary, with further warnings, and history of a run that has ended.
    pub(crate) fn finish(
        self,
        problem: &Problem,
        state: &State,
        ending: &Ending,
        further: Vec<WarningSummary>,
    ) -> Result<(Summary, Table), OutputError> {
        match self {
            Self::Memory(memory) => {
                let seconds = memory.started.elapsed().as_secs_f64();
                let case = &problem.model.title;
                let tally = memory.tally;
                let summary = tally.summary(case, problem, state, ending, seconds, further);
                Ok((summary, memory.history))
            }
            Self::Files(files) => {
                let Files {
                    mut recorder,
                    recording,
                } = *files;
                let summary = recorder.finish(problem, state, ending, further)?;
                if *ending == Ending::Completed {
                    Checkpoint::remove_shared(&recording.folder, &problem.share)?;
                }
                Ok((summary, recorder.table()?))
            }
        }
    }
}

impl Memory {
    fn increment(&mut self, problem: &Problem, progress: Progress, increment: &Increment) {
        self.tally.increment(increment);
        let (history, cut_backs) = (&mut self.history, self.tally.cut_backs);
        let row = row(problem, progress, increment, cut_backs, &history.columns);
        let columns: Vec<&str> = row.iter().map(|(name, _)| name.as_str()).collect();
        history.widen(&columns, |column| before_touch(&row, column));
        history
            .rows
            .push(row.iter().map(|(_, value)| *value).collect());
    }
}
