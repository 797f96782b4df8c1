//! Ways in which a task fails.

use std::{io, path::PathBuf, process::ExitStatus};

use crate::breach::Breach;

/// Reason why a task failed.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// A program could not be started.
    #[error("`{command}` cannot be started: {cause}")]
    Start {
        /// The command line.
        command: String,
        /// Error of the operating system.
        cause: io::Error,
    },
    /// A program ended with a failure.
    #[error("`{command}` failed ({status})")]
    Failed {
        /// The command line.
        command: String,
        /// Exit status.
        status: ExitStatus,
    },
    /// `cargo metadata` printed something else than expected.
    #[error("the output of `cargo metadata` is not understood: {0}")]
    Metadata(String),
    /// A source file or folder cannot be read.
    #[error("{} cannot be read: {cause}", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// Error of the operating system.
        cause: io::Error,
    },
    /// The source text breaks rules of the architecture.
    #[error("{}\nbreaches: {}; ARCHITECTURE.md and CONVENTIONS.md give the reasons", lines(.0), .0.len())]
    Breaches(Vec<Breach>),
    /// An option is not understood.
    #[error("{0}")]
    Option(String),
    /// A report does not do what it should in a browser, or there is no browser.
    #[error("{0}")]
    Browser(String),
    /// The book cannot be built, or a link of it leads nowhere.
    #[error("{0}")]
    Book(String),
    /// A run did not endure what it must.
    #[error("{0}")]
    Endurance(String),
    /// There is no interpreter for the Python package.
    #[error("there is no Python 3.10 or newer that makes virtual environments")]
    NoPython,
    /// Something that ranks need is not installed.
    #[error(
        "there is no {0}; on Debian and Ubuntu: apt-get install libpetsc-real-dev pkg-config libclang-dev"
    )]
    NoMpi(&'static str),
    /// Ranks did not do what they must.
    #[error("{0}")]
    Mpi(String),
    /// The suite of other programs' problems cannot be read, or came out as nothing explains.
    #[error("{0}")]
    Suite(String),
    /// Inputs were found that fail.
    #[error("{0} inputs fail; they are in target/fuzz/findings")]
    Fuzz(usize),
    /// Scenes came out wrong.
    #[error("{count} of {of} scenes came out wrong")]
    Scenes {
        /// Number of failures.
        count: usize,
        /// Of how many.
        of: usize,
    },
}

fn lines(breaches: &[Breach]) -> String {
    let lines: Vec<String> = breaches.iter().map(Breach::to_string).collect();
    lines.join("\n")
}
