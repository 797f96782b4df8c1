//! The ranks of a program that was started by `mpirun`, in a build with the feature `petsc`.
//!
//! All ranks run the same program. The first one speaks for all; others are silent unless
//! they fail alone, when they end all ranks.

use std::sync::Arc;

use crate::failure::Failure;

/// Voice of a rank: only the first one prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Voice {
    /// The first rank, or one that is alone.
    First,
    /// Another one speaks.
    #[cfg_attr(not(feature = "petsc"), allow(dead_code, reason = "there is one rank"))]
    Silent,
}

/// Number of ranks that could print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Voices {
    /// None but this program.
    Alone,
    /// Ranks of MPI.
    Several,
}

impl Crew {
    /// Returns whether there are several ranks.
    pub fn voices(&self) -> Voices {
        match self.ranks() {
            None => Voices::Alone,
            Some(_) => Voices::Several,
        }
    }
}

/// Options of runs on several ranks.
#[derive(clap::Args)]
pub struct Options {
    /// Solve with PETSc even on a single rank; needs a build with the feature `petsc`.
    #[arg(long)]
    petsc: bool,
    /// Options for PETSc, such as "-striae_ksp_monitor"; they follow those of the variable PETSC_OPTIONS.
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true)]
    petsc_options: Option<String>,
}

#[cfg(feature = "petsc")]
pub use together::Crew;

#[cfg(not(feature = "petsc"))]
pub use alone::Crew;

#[cfg(feature = "petsc")]
mod together {
    use std::{env, io::Write, process, thread, time::Duration};

    use striae::{
        Ranks,
        model::Backend,
        solve::{newton::TangentSolver, team::Team},
    };
    use striae_petsc::{Choice, PetscSolver};

    use super::{Arc, Failure, Options, Voice};

    /// Time that a rank that failed waits for the others before it ends them.
    const PATIENCE: Duration = Duration::from_secs(5);
    /// Variables by which a process recognises that it is one of several.
    const STARTED: [&str; 3] = ["OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"];

    /// The ranks, if there are several or PETSc is requested.
    #[derive(Clone, Debug)]
    pub struct Crew(Option<striae_petsc::Ranks>);

    /// Ranks with the solvers of PETSc.
    #[derive(Debug)]
    struct Petsc(striae_petsc::Ranks);

    impl Ranks for Petsc {
        fn team(&self) -> Arc<dyn Team> {
            Arc::new(self.0.clone())
        }

        fn solver(&self, backend: Backend) -> Box<dyn TangentSolver> {
            let choice = match backend {
                Backend::Condensed => Choice::ByCost,
                Backend::Iterative => Choice::Iterative,
                Backend::Mumps | Backend::Multifrontal | Backend::Faer => Choice::Mumps,
            };
            Box::new(PetscSolver::new(&self.0, choice))
        }
    }

    impl Crew {
        /// Starts MPI and PETSc if requested.
        pub fn start(options: &Options) -> Result<Self, Failure> {
            let several = STARTED.iter().any(|name| env::var_os(name).is_some());
            if !several && !options.petsc && options.petsc_options.is_none() {
                return Ok(Self(None));
            }
            let words = options.petsc_options.as_deref().unwrap_or_default();
            let words: Vec<&str> = words.split_whitespace().collect();
            let ranks = striae_petsc::Ranks::start(&words);
            let ranks = ranks.map_err(|cause| Failure::Petsc(cause.to_string()))?;
            Ok(Self(Some(ranks)))
        }

        /// The ranks, if there are any.
        pub fn ranks(&self) -> Option<Arc<dyn Ranks>> {
            let ranks = self.0.clone()?;
            Some(Arc::new(Petsc(ranks)))
        }

        /// Returns whether this rank prints.
        pub fn voice(&self) -> Voice {
            match &self.0 {
                Some(ranks) if ranks.rank() > 0 => Voice::Silent,
                _ => Voice::First,
            }
        }

        /// Ends a command: the first rank reports a failure of all ranks. A rank that fails alone
        /// reports it and ends the others, which would wait for it.
        pub fn ended(self, result: Result<(), Failure>) -> Result<(), Failure> {
            let (Err(failure), Some(ranks)) = (&result, &self.0) else {
                return result;
            };
            let said = format!("rank {}: {failure}\n", ranks.rank());
            thread::spawn(move || {
                thread::sleep(PATIENCE);
                let _ = std::io::stderr().write_all(said.as_bytes());
                // MPI ends all ranks where one ends without leaving it.
                process::abort();
            });
            ranks.gather(&[]);
            if self.voice() == Voice::First && !failure.is_told() && !failure.is_broken_pipe() {
                let _ = std::io::stderr().write_all(format!("{failure}\n").as_bytes());
            }
            // The others stay until it is told: MPI ends all ranks once one has ended by a failure.
            ranks.gather(&[]);
            result.map_err(|failure| Failure::Told(Box::new(failure)))
        }
    }
}

#[cfg(not(feature = "petsc"))]
mod alone {
    use striae::Ranks;

    use super::{Arc, Failure, Options, Voice};

    /// A program without MPI.
    #[derive(Clone, Debug)]
    pub struct Crew;

    impl Crew {
        /// Takes the options.
        pub fn start(options: &Options) -> Result<Self, Failure> {
            match options.petsc || options.petsc_options.is_some() {
                true => Err(Failure::NoPetsc),
                false => Ok(Self),
            }
        }

        /// None.
        pub fn ranks(&self) -> Option<Arc<dyn Ranks>> {
            None
        }

        /// The only rank prints.
        pub fn voice(&self) -> Voice {
            Voice::First
        }

        /// Ends a command.
        pub fn ended(self, result: Result<(), Failure>) -> Result<(), Failure> {
            result
        }
    }
}
