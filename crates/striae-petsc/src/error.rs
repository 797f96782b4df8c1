//! Errors of MPI and PETSc.

use striae_solve::team::Team;
use striae_sparse::SolveError;
use thiserror::Error;

/// Libraries that fail.
const LIBRARIES: [&str; 3] = ["PETSc", "MUMPS", "METIS"];

/// A fault of MPI or PETSc.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum Error {
    /// MPI is in use by something else.
    #[error("MPI has been started before")]
    Started,
    /// MPI does not let several threads call it, not even one after the other.
    #[error("this MPI can only be called by the main thread")]
    Threads,
    /// PETSc was built with other kinds of numbers.
    #[error(
        "PETSc was built with {scalar} bytes a scalar, {real} a real number and {index} an index; 8, 8 and 4 are needed"
    )]
    Kinds {
        /// Bytes of a scalar.
        scalar: usize,
        /// Bytes of a real number.
        real: usize,
        /// Bytes of an index.
        index: usize,
    },
    /// A function of PETSc failed.
    #[error("PETSc failed with code {code}: {message}")]
    Petsc {
        /// Its error code.
        code: i32,
        /// Text of the error.
        message: String,
    },
}

impl From<Error> for SolveError {
    fn from(error: Error) -> Self {
        let code = match error {
            Error::Petsc { code, .. } => code,
            _ => 0,
        };
        Self::Library {
            library: "PETSc",
            code,
        }
    }
}

/// Result that all ranks agree on: the first error in the order of the ranks, if any.
pub(crate) fn agreed<T>(team: &dyn Team, own: Result<T, SolveError>) -> Result<T, SolveError> {
    let words = own.as_ref().err().map_or([0.0; 3], words);
    let bytes: Vec<u8> = words.into_iter().flat_map(f64::to_le_bytes).collect();
    let all = team.gather(&bytes);
    let read = |bytes: &Vec<u8>| {
        let words = bytes
            .as_chunks()
            .0
            .iter()
            .map(|&word| f64::from_le_bytes(word));
        error(&words.collect::<Vec<f64>>())
    };
    match (all.iter().find_map(read), own) {
        (Some(first), _) => Err(first),
        (None, own) => own,
    }
}

/// An error as numbers.
fn words(error: &SolveError) -> [f64; 3] {
    match *error {
        SolveError::NotAnalysed => [1.0, 0.0, 0.0],
        SolveError::NotFactored => [2.0, 0.0, 0.0],
        SolveError::Length { found, expected } => [3.0, found as f64, expected as f64],
        SolveError::NotFinite { row } => [4.0, row as f64, 0.0],
        SolveError::Singular { unknown, equation } => [5.0, unknown as f64, equation as f64],
        SolveError::NotPositiveDefinite { unknown, pivot } => [6.0, unknown as f64, pivot],
        SolveError::TooLarge { bytes } => [7.0, bytes as f64, 0.0],
        SolveError::Inaccurate { backward_error } => [8.0, backward_error, 0.0],
        SolveError::Library { library, code } => {
            let which = LIBRARIES.iter().position(|known| *known == library);
            [9.0, which.unwrap_or(0) as f64, f64::from(code)]
        }
    }
}

/// The error of numbers, if it is one.
fn error(words: &[f64]) -> Option<SolveError> {
    let &[kind, a, b] = words else {
        return None;
    };
    Some(match kind as u32 {
        1 => SolveError::NotAnalysed,
        2 => SolveError::NotFactored,
        3 => SolveError::Length {
            found: a as usize,
            expected: b as usize,
        },
        4 => SolveError::NotFinite { row: a as usize },
        5 => SolveError::Singular {
            unknown: a as usize,
            equation: b as usize,
        },
        6 => SolveError::NotPositiveDefinite {
            unknown: a as usize,
            pivot: b,
        },
        7 => SolveError::TooLarge { bytes: a as usize },
        8 => SolveError::Inaccurate { backward_error: a },
        9 => SolveError::Library {
            library: LIBRARIES[a as usize],
            code: b as i32,
        },
        _ => return None,
    })
}
