//! Ways in which the program fails, and their exit codes.

use std::{io, path::PathBuf, process::ExitCode};
use striae::{measurements::MeasurementFaults, mesh_file::MeshFileError};
use striae_deck::Faults;
use striae_figure::FigureError;
use striae_law::fit::FitError;
use striae_output::{OutputError, checkpoint::CheckpointError};
use striae_report::ReportError;
use striae_solve::{outcome::Ending, problem::ProblemError};

use crate::shell::word;

/// Exit code of an interrupted program: 128 and the number of the signal, as shells have it.
pub const INTERRUPTED: u8 = 130;
/// Exit code of a request that is not possible.
pub const IMPOSSIBLE: u8 = 2;

/// Reason why the program did not do what was requested.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The deck is faulty.
    #[error("{0}")]
    Deck(#[from] Faults),
    /// Constants of a law on the command line are faulty.
    #[error("{0}")]
    Constants(String),
    /// A model is faulty.
    #[error("{0}")]
    Model(Box<striae::Error>),
    /// A folder that would be written exists.
    #[error("{} already exists; choose another name", .0.display())]
    Exists(PathBuf),
    /// A file or folder cannot be written.
    #[error("{} cannot be written: {cause}", path.display())]
    Unwritable {
        /// The file or folder.
        path: PathBuf,
        /// Error of the operating system.
        cause: io::Error,
    },
    /// A run cannot be taken up again.
    #[error("{0}")]
    Checkpoint(#[from] CheckpointError),
    /// A run was interrupted, and a checkpoint is there to continue from.
    #[error(
        "interrupted at time {time:.6}; continue with `striae resume {}`",
        word(folder)
    )]
    Interrupted {
        /// Time of the last converged state.
        time: f64,
        /// Its folder.
        folder: PathBuf,
    },
    /// The model cannot be solved.
    #[error("{0}")]
    Problem(#[from] ProblemError),
    /// A model has faults that have been printed.
    #[error("this deck cannot be run: {}", faulty(*.0))]
    Impossible(usize),
    /// The run did not reach its end.
    #[error("{0}")]
    Ended(Box<Ending>),
    /// The run completed with warnings.
    #[error("{}", warned(*.0))]
    Warned(usize),
    /// Runs of a sweep that failed.
    #[error("{0}")]
    Sweep(String),
    /// A sweep that was interrupted.
    #[error("{0}")]
    Halted(String),
    /// Numbers cannot vary as requested.
    #[error("{0}")]
    Variation(String),
    /// Two runs differ.
    #[error("the runs differ: {0}")]
    Differ(String),
    /// There is no case of this name.
    #[error("unknown case `{name}`; known cases are {known}")]
    UnknownCase {
        /// Requested name.
        name: String,
        /// All names.
        known: String,
    },
    /// Cases did not give what is known of them.
    #[error("outside the tolerances: {0}")]
    Deviates(String),
    /// Results cannot be written.
    #[error("{0}")]
    Results(#[from] OutputError),
    /// Results that the request names cannot be read.
    #[error("{0}")]
    Given(OutputError),
    /// A figure cannot be drawn or written.
    #[error("{0}")]
    Figure(#[from] FigureError),
    /// There is no report.
    #[error("{0}")]
    Report(#[from] ReportError),
    /// A file of measurements is faulty.
    #[error("{0}")]
    Measurements(#[from] MeasurementFaults),
    /// A mesh file is faulty.
    #[error("{0}")]
    Mesh(#[from] MeshFileError),
    /// Measurements give no law.
    #[error("{0}")]
    Fit(#[from] FitError),
    /// MPI or PETSc does not start.
    #[cfg_attr(
        not(feature = "petsc"),
        allow(dead_code, reason = "only ranks fail so")
    )]
    #[error("{0}")]
    Petsc(String),
    /// PETSc is requested, but not built in.
    #[cfg(not(feature = "petsc"))]
    #[error("this program was built without PETSc; build it with `--features petsc`")]
    NoPetsc,
    /// Another rank reports it.
    #[cfg_attr(
        not(feature = "petsc"),
        allow(dead_code, reason = "only ranks fail so")
    )]
    #[error("{0}")]
    Told(Box<Failure>),
    /// The threads cannot be started.
    #[error("the threads cannot be started: {0}")]
    Threads(String),
    /// The standard output cannot be written.
    #[error("the output cannot be written: {0}")]
    Output(#[from] io::Error),
}

fn faulty(count: usize) -> String {
    match count {
        1 => "it has a fault".into(),
        count => format!("it has {count} faults"),
    }
}

fn warned(count: usize) -> String {
    match count {
        1 => "1 warning, which `--strict` forbids".into(),
        count => format!("{count} warnings, which `--strict` forbids"),
    }
}

impl From<striae::Error> for Failure {
    fn from(error: striae::Error) -> Self {
        match error {
            striae::Error::Deck(faults) => Self::Deck(faults),
            striae::Error::Problem(error) => Self::Problem(error),
            striae::Error::Checkpoint(error) => Self::Checkpoint(error),
            striae::Error::Output(error) => Self::Results(error),
            striae::Error::Figure(error) => Self::Figure(error),
            striae::Error::File(error) => Self::Results(error.into()),
            other => Self::Model(Box::new(other)),
        }
    }
}

impl From<striae_cases::Failure> for Failure {
    fn from(failure: striae_cases::Failure) -> Self {
        match failure {
            striae_cases::Failure::Simulation(error) => error.into(),
            striae_cases::Failure::Ended(ending) => Self::Ended(ending),
            striae_cases::Failure::Unwritable { path, cause } => Self::Unwritable { path, cause },
            striae_cases::Failure::Figure(error) => Self::Figure(error),
        }
    }
}

impl Failure {
    /// Returns whether another rank reports it.
    pub fn is_told(&self) -> bool {
        matches!(self, Self::Told(_))
    }

    /// Returns whether nobody reads the program's output any more, as after `| head`.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Output(cause) if cause.kind() == io::ErrorKind::BrokenPipe)
    }

    /// The exit code: 2 for bad input, 130 for an interrupt, 1 for everything else.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Self::Told(failure) => failure.exit_code(),
            // What another rank says is no fault of the model.
            Self::Model(error) if matches!(**error, striae::Error::Elsewhere { .. }) => {
                ExitCode::from(1)
            }
            #[cfg(not(feature = "petsc"))]
            Self::NoPetsc => ExitCode::from(IMPOSSIBLE),
            Self::Deck(_)
            | Self::Constants(_)
            | Self::Model(_)
            | Self::Exists(_)
            | Self::Checkpoint(_)
            | Self::Problem(_)
            | Self::Measurements(_)
            | Self::Mesh(_)
            | Self::Fit(_)
            | Self::Given(_)
            | Self::Report(
                ReportError::Nothing(_)
                | ReportError::Field { .. }
                | ReportError::Component { .. }
                | ReportError::Animation(_)
                | ReportError::Still(_)
                | ReportError::Time(..)
                | ReportError::Magnification(..)
                | ReportError::Name { .. }
                | ReportError::View,
            )
            | Self::Results(
                OutputError::Occupied(_) | OutputError::InUse(_) | OutputError::GoneOn(_),
            )
            | Self::Impossible(_)
            | Self::Variation(_)
            | Self::UnknownCase { .. } => ExitCode::from(IMPOSSIBLE),
            Self::Interrupted { .. } | Self::Halted(_) => ExitCode::from(INTERRUPTED),
            Self::Ended(ending) if matches!(**ending, Ending::Interrupted { .. }) => {
                ExitCode::from(INTERRUPTED)
            }
            Self::Unwritable { .. }
            | Self::Ended(_)
            | Self::Sweep(_)
            | Self::Differ(_)
            | Self::Warned(_)
            | Self::Deviates(_)
            | Self::Results(_)
            | Self::Figure(_)
            | Self::Report(_)
            | Self::Threads(_)
            | Self::Petsc(_)
            | Self::Output(_) => ExitCode::from(1),
        }
    }
}
