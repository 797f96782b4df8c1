//! Tables of chosen places and cuts, which grow by a row an increment.

use std::path::Path;

use striae_solve::{drive::Progress, problem::Problem, state::State};

use crate::{Output, OutputError, probes::Probes, sections::Sections};

/// Names of the files.
pub(crate) const FILES: [&str; 2] = ["probes.csv", "sections.csv"];

/// Probes and sections, with their files.
pub(crate) struct Watched {
    probes: Option<Probes>,
    sections: Option<Sections>,
}

impl Watched {
    /// Finds everything that is requested, and continues the files after so many rows.
    ///
    /// # Errors
    /// Returns what is missing, or an error if there are no such rows.
    pub(crate) fn open(
        folder: &Path,
        problem: &Problem,
        output: &Output,
        rows: usize,
    ) -> Result<Self, OutputError> {
        let [probes, sections] = FILES.map(|name| folder.join(name));
        let Output {
            probes: places,
            sections: cuts,
            ..
        } = output;
        Ok(Self {
            probes: (!places.is_empty())
                .then(|| Probes::open(probes, problem, places, rows))
                .transpose()?,
            sections: (!cuts.is_empty())
                .then(|| Sections::open(sections, problem, cuts, rows))
                .transpose()?,
        })
    }

    /// Writes the rows of an increment.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub(crate) fn append(
        &mut self,
        problem: &Problem,
        progress: Progress,
        state: &State,
    ) -> Result<(), OutputError> {
        if let Some(probes) = &mut self.probes {
            probes.append(problem, progress, state)?;
        }
        if let Some(sections) = &mut self.sections {
            sections.append(problem, progress, state)?;
        }
        Ok(())
    }
}
