//! Errors of simulations.

use striae_deck::Faults;
use striae_figure::FigureError;
use striae_files::FileError;
use striae_law::{
    bulk::{InadmissibleHyperelastic, InadmissibleModuli},
    friction::FrictionError,
};
use striae_mesh::MeshError;
use striae_meshfile::MeshFileError;
use striae_output::{OutputError, checkpoint::CheckpointError};
use striae_solve::{problem::ProblemError, sensitivity::Unlike};

/// Reason why a simulation could not be made or run. A run that stops for a physical reason is not
/// an error, but an ending.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The deck is faulty.
    #[error(transparent)]
    Deck(#[from] Faults),
    /// The model is faulty.
    #[error(transparent)]
    Model(#[from] striae_model::Faults),
    /// The model cannot be solved.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// The machine has not the memory.
    #[error(
        "not enough memory: {unknowns} unknowns take about {:.1} GB, but only {:.1} GB are available; set `backend = \"iterative\"` unless it is set already, or use a coarser mesh or a larger machine",
        needed / 1e9, available / 1e9
    )]
    Memory {
        /// Unknowns of a linear system.
        unknowns: usize,
        /// Bytes that it takes, by formula.
        needed: f64,
        /// Bytes that there are.
        available: f64,
    },
    /// The solver is not among those of a run on one rank.
    #[error(
        "`backend = \"mumps\"` needs PETSc: build with `--features petsc` and run with `--petsc` or under `mpirun`; `backend = \"multifrontal\"` is a direct solver that needs neither"
    )]
    NotTogether,
    /// The model cannot be divided among ranks.
    #[error("the model cannot be divided among ranks: {0}")]
    Division(String),
    /// Another rank failed.
    #[error("rank {rank}: {cause}")]
    Elsewhere {
        /// Number of the rank.
        rank: usize,
        /// Message of the cause.
        cause: String,
    },
    /// A run cannot be taken up again.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// Further steps begin where a run has ended, not in the middle of its steps.
    #[error("only a completed run can be continued with further steps; this one was stopped")]
    NotCompleted,
    /// A derivative is asked for by something that is no number of the model.
    #[error(transparent)]
    Unlike(#[from] Unlike),
    /// Derivatives are asked for of a run that does not begin at rest on one rank.
    #[error(
        "derivatives, of `[sensitivity]` or `--wrt`, are computed of runs that begin undeformed, in one process"
    )]
    NotFromTheStart,
    /// Results cannot be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A figure cannot be drawn or written.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A file cannot be copied to the results.
    #[error(transparent)]
    File(#[from] FileError),
    /// A mesh cannot be generated.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A mesh cannot be read.
    #[error(transparent)]
    MeshFile(Box<MeshFileError>),
    /// Constants of a friction law are refused.
    #[error(transparent)]
    Friction(#[from] FrictionError),
    /// Elastic constants are refused.
    #[error(transparent)]
    Moduli(#[from] InadmissibleModuli),
    /// Constants of rubber are refused.
    #[error(transparent)]
    Rubber(#[from] InadmissibleHyperelastic),
}

impl From<MeshFileError> for Error {
    fn from(error: MeshFileError) -> Self {
        Self::MeshFile(Box::new(error))
    }
}
