//! Force and moment through plane cuts of bodies, a row an increment, see
//! [`striae_solve::section`].
//!
//! Columns are `NAME.force.x`, ..., `NAME.normal_force`, `NAME.shear_force`,
//! `NAME.moment.x`, ..., `NAME.centre.x`, ..., `NAME.area`.

use std::path::PathBuf;

use striae_mesh::Mesh;
use striae_solve::{
    drive::Progress,
    problem::Problem,
    section::{Section as Cut, SectionError},
    state::State,
};

use crate::{
    OutputError, Section,
    history::History,
    ranks::{agreed, on_first},
    row::add_vector,
};

/// Sections of a problem and their file.
pub(crate) struct Sections {
    cuts: Vec<(String, usize, Cut)>,
    /// Of rank 0.
    file: Option<History>,
}

/// The cut of a mesh that a section is.
///
/// # Errors
/// When its plane does not divide the mesh.
pub fn cut(mesh: &Mesh, section: &Section) -> Result<Cut, SectionError> {
    Cut::new(mesh, &section.point, &section.normal)
}

impl Sections {
    /// Makes all cuts, and continues their file after so many rows.
    ///
    /// # Errors
    /// Returns the fault of the first cut, or an error if there are no such rows.
    pub(crate) fn open(
        path: PathBuf,
        problem: &Problem,
        sections: &[Section],
        rows: usize,
    ) -> Result<Self, OutputError> {
        let cuts = sections.iter().map(|section| placed(problem, section));
        let cuts = cuts.collect::<Result<_, String>>();
        let cuts = cuts.map_err(|cause| OutputError::Content {
            path: path.clone(),
            cause,
        })?;
        let file = on_first(&problem.share, || History::after(path, rows))?;
        Ok(Self { cuts, file })
    }

    /// Writes the row of an increment; collective.
    pub(crate) fn append(
        &mut self,
        problem: &Problem,
        progress: Progress,
        state: &State,
    ) -> Result<(), OutputError> {
        let mut row = vec![
            ("increment".to_owned(), progress.increment as f64),
            ("time".to_owned(), state.time),
        ];
        for (name, body, cut) in &self.cuts {
            let report = cut.report(problem, state, *body);
            add_vector(&mut row, &format!("{name}.force"), &report.force);
            row.push((format!("{name}.normal_force"), report.normal_force()));
            row.push((format!("{name}.shear_force"), report.shear_force()));
            add_vector(&mut row, &format!("{name}.moment"), &report.moment);
            add_vector(&mut row, &format!("{name}.centre"), &report.centre);
            row.push((format!("{name}.area"), report.area));
        }
        let named: Vec<(&str, f64)> = row.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        let appended = self
            .file
            .as_mut()
            .map_or(Ok(()), |file| file.append(&named));
        agreed(&problem.share, appended)
    }
}

fn placed(problem: &Problem, section: &Section) -> Result<(String, usize, Cut), String> {
    let Section { name, body, .. } = section;
    let bodies = &problem.model.bodies;
    let place = bodies.iter().position(|known| known.name == *body);
    let place =
        place.ok_or_else(|| format!("there is no body `{body}`, which section `{name}` cuts"))?;
    let cut = Cut::of(problem, place, &section.point, &section.normal);
    let cut = cut.map_err(|cause| format!("section `{name}`: {cause}"))?;
    Ok((name.clone(), place, cut))
}
