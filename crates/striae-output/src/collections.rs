//! Collections of the fields of bodies, contact surfaces, rigid surfaces and ties, and the
//! files that they list.

use std::path::{Path, PathBuf};

use striae_contact::{side::Side, unknowns::NodeResult};
use striae_solve::{
    interference::configuration, problem::Problem, report::tie_tractions, state::State,
};

use crate::{
    Output, OutputError,
    bodies::body_grid,
    checksums::{Checksums, sum},
    parts::{Parts, file},
    pieces::write_pieces,
    ranks::on_first,
    rigid::RigidGrid,
    surfaces::{Wanted, write_surface},
    tied::write_tied,
    vtk::{Series, Snapshot, write},
    worn::Worn,
};

/// The collections of a run.
pub(crate) struct Collections {
    folder: PathBuf,
    bodies: Series,
    contact: Series,
    rigid: Series,
    ties: Series,
    /// Rigid surfaces at rest, once they are needed.
    rigid_grids: Option<Vec<RigidGrid>>,
    /// Checksums of the files.
    sums: Checksums,
}

/// Contact quantities that are written besides the state.
pub(crate) struct Contact<'a> {
    /// Results at the nodes, by pair and side.
    pub nodes: &'a [&'a [Vec<NodeResult>; 2]],
    /// Sums over slip.
    pub worn: &'a Worn,
    /// Time of the last increment.
    pub elapsed: f64,
}

impl Collections {
    /// Collections that continue what has been written: bodies, contact, rigid surfaces, ties.
    pub(crate) fn resumed(folder: &Path, series: &[Vec<Snapshot>; 4], sums: Checksums) -> Self {
        let [bodies, contact, rigid, ties] = series.clone();
        Self {
            folder: folder.to_owned(),
            bodies: Series::resumed(folder.join("bodies.pvd"), bodies),
            contact: Series::resumed(folder.join("contact.pvd"), contact),
            rigid: Series::resumed(folder.join("rigid.pvd"), rigid),
            ties: Series::resumed(folder.join("ties.pvd"), ties),
            rigid_grids: None,
            sums,
        }
    }

    /// Snapshots written so far: bodies, contact, rigid surfaces, ties.
    pub(crate) fn snapshots(&self) -> [&[Snapshot]; 4] {
        [&self.bodies, &self.contact, &self.rigid, &self.ties].map(Series::snapshots)
    }

    /// Checksums of the files.
    pub(crate) fn sums(&self) -> &Checksums {
        &self.sums
    }

    /// Notes checksums of the fields that were written last.
    pub(crate) fn sum_up(&mut self) -> Result<(), OutputError> {
        let last = self.snapshots().map(<[Snapshot]>::last);
        let last = last.into_iter().flatten();
        let files = last.flat_map(|last| last.parts.iter().map(|(_, file)| file.clone()));
        for file in files.collect::<Vec<_>>() {
            let noted = sum(&self.folder, &file)?;
            if !self.sums.contains(&noted) {
                self.sums.push(noted);
            }
        }
        Ok(())
    }

    /// Writes the requested bodies, after so many increments; collective, as ranks write their
    /// pieces.
    pub(crate) fn write_bodies(
        &mut self,
        problem: &Problem,
        state: &State,
        count: usize,
        output: &Output,
    ) -> Result<(), OutputError> {
        let mut parts = Vec::new();
        let names = Parts::new(problem).bodies;
        let chosen = output.bodies.as_ref();
        for (body, model) in problem.model.bodies.iter().enumerate() {
            if chosen.is_some_and(|chosen| !chosen.contains(&model.name)) {
                continue;
            }
            let file = match problem.share.is_alone() {
                true => {
                    let file = file(&names[body], count);
                    let grid = body_grid(problem, state, body, &output.body_fields);
                    write(&self.folder.join(&file), &grid)?;
                    file
                }
                false => {
                    let place = (body, names[body].as_str(), count);
                    let fields = &output.body_fields;
                    let written = write_pieces(&self.folder, (problem, state), place, fields);
                    let (file, sums) = written?;
                    self.sums.extend(sums);
                    file
                }
            };
            parts.push((model.name.clone(), file));
        }
        if parts.is_empty() {
            return Ok(());
        }
        let time = state.time;
        on_first(&problem.share, || {
            self.bodies.append(Snapshot { time, parts })
        })?;
        Ok(())
    }

    /// Writes the rigid surfaces.
    pub(crate) fn write_rigid(
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
        let named = Parts::new(problem);
        let written = grids
            .iter()
            .map(|rigid| rigid.write(&self.folder, (problem, &named), state, count));
        let (time, parts) = (state.time, written.collect::<Result<_, _>>()?);
        self.rigid.append(Snapshot { time, parts })
    }

    /// Writes the contact surfaces.
    pub(crate) fn write_contact(
        &mut self,
        problem: &Problem,
        state: &State,
        count: usize,
        output: &Output,
        contact: &Contact,
    ) -> Result<(), OutputError> {
        let time = state.time;
        let mut parts = Vec::new();
        let names = Parts::new(problem).contact;
        let pairs = 0..problem.pairs.len();
        for pair in pairs.filter(|&pair| meets(problem, state, pair, contact)) {
            for side in Side::BOTH {
                let Some(body) = problem.pairs[pair].bodies[side] else {
                    continue;
                };
                let pair_name = &problem.model.pairs[pair].name;
                let name = format!("{pair_name}-{}", problem.model.bodies[body].name);
                let file = file(&names[pair][side], count);
                let nodes = contact.nodes[pair];
                let worn = contact.worn.of(pair, side, nodes[side].len());
                let wanted = Wanted {
                    fields: &output.contact_fields,
                    wear: output.wear_coefficient,
                    worn: &worn,
                    nodes,
                    elapsed: contact.elapsed,
                };
                let path = self.folder.join(&file);
                write_surface(&path, problem, state, (pair, side), &wanted)?;
                parts.push((name, file));
            }
        }
        if parts.is_empty() {
            return Ok(());
        }
        self.contact.append(Snapshot { time, parts })
    }

    /// Writes both sides of all ties.
    pub(crate) fn write_ties(
        &mut self,
        problem: &Problem,
        state: &State,
        count: usize,
    ) -> Result<(), OutputError> {
        let time = state.time;
        let mut parts = Vec::new();
        let names = Parts::new(problem).ties;
        for (tie, joint) in problem.ties.joints.iter().enumerate() {
            let tractions = tie_tractions(problem, state, tie);
            for (side, tractions) in Side::BOTH.into_iter().zip(&tractions) {
                let body = &problem.model.bodies[joint.bodies[side]].name;
                let file = file(&names[tie][side], count);
                let path = self.folder.join(&file);
                write_tied(&path, problem, state, (tie, side), tractions)?;
                parts.push((format!("{}-{body}", problem.model.ties[tie].name), file));
            }
        }
        if parts.is_empty() {
            return Ok(());
        }
        self.ties.append(Snapshot { time, parts })
    }
}

/// Returns whether facets of a pair face each other, or something has slipped: contact of
/// everything has pairs of bodies that never meet.
fn meets(problem: &Problem, state: &State, pair: usize, contact: &Contact) -> bool {
    let faces = match contact.elapsed > 0.0 {
        true => state.pairs[pair]
            .facets
            .iter()
            .any(|facets| !facets.is_empty()),
        // Before the first increment nobody has looked for facets yet.
        false => !configuration(problem, pair, state.into()).is_apart(0.0),
    };
    faces || contact.worn.has_slipped(pair)
}
