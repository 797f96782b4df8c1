//! Writes a run to a folder: fields, history and summary.
//!
//! ```text
//! DIR/history.csv           a row an increment
//! DIR/bodies.pvd            displacement, velocity in dynamic steps, Cauchy stress, von Mises stress,
//!                           named variables of laws with a memory by element
//! DIR/contact.pvd           gap, pressure, tractions, slip, normal, texture `s`,
//!                           structural vector `a = n x s`, status, kept, pointed
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

use striae_contact::unknowns::{NodeResult, Status as ContactStatus};
use striae_mesh::{NodeId, Vec3};
use striae_solve::{
    drive::Progress, newton::Increment, outcome::Ending, problem::Problem, state::State,
};

use crate::{
    FieldOutput, Output, OutputError,
    bodies::body_grid,
    checkpoint::Written,
    folder::{Claim, Existing, remove_fields},
    history::History,
    rigid::RigidGrid,
    row::row,
    summary::Summary,
    tally::Tally,
    vtk::{Array, Cells, Grid, Series, Snapshot, Values, write},
};

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
        })
    }

    /// What is on disk, for a checkpoint.
    pub fn written(&self) -> Written {
        let tally = &self.tally;
        Written {
            iterations: tally.iterations.clone(),
            cut_backs: tally.cut_backs,
            unknowns: tally.unknowns,
            solver: tally.solver.clone(),
            fields: self.written,
            seconds: self.seconds(),
            series: [&self.bodies, &self.contact, &self.rigid]
                .map(|series| series.snapshots().to_vec()),
            judgement: tally.judgement.clone(),
        }
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
        self.write_rigid(problem, state, 0)
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
        match self.output.fields {
            FieldOutput::Every(every) if progress.increment.is_multiple_of(every.get()) => {
                self.write_fields(problem, &increment.state)
            }
            FieldOutput::Every(_) | FieldOutput::Last => Ok(()),
        }
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
        self.write_contact(problem, state, count)
    }

    fn write_bodies(
        &mut self,
        problem: &Problem,
        state: &State,
        count: usize,
    ) -> Result<(), OutputError> {
        let mut parts = Vec::new();
        for (body, model) in problem.model.bodies.iter().enumerate() {
            let file = PathBuf::from(format!("fields/{}-{count:05}.vtu", model.name));
            write(&self.folder.join(&file), &body_grid(problem, state, body))?;
            parts.push((model.name.clone(), file));
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
                write_surface(&self.folder.join(&file), problem, state, pair, side)?;
                parts.push((name, file));
            }
        }
        if parts.is_empty() {
            return Ok(());
        }
        self.contact.append(Snapshot { time, parts })
    }
}

fn write_surface(
    path: &Path,
    problem: &Problem,
    state: &State,
    pair: usize,
    side: usize,
) -> Result<(), OutputError> {
    let geometry = &problem.pairs[pair];
    let Some(surface) = geometry.contact.sides[side].surface() else {
        return Ok(());
    };
    let global = |node: usize| problem.surface_node(pair, side, node as u32);
    let count = surface.nodes().len();
    let points: Vec<Vec3> = (0..count)
        .filter_map(global)
        .map(|n| state.positions[n])
        .collect();
    let quads: Vec<[NodeId; 4]> = surface
        .facets()
        .iter()
        .map(|corners| corners.map(NodeId))
        .collect();
    let nodes = &state.pairs[pair].nodes[side];
    let scalars = |f: fn(&NodeResult) -> f64| Values::Scalars(nodes.iter().map(f).collect());
    let vectors = |f: fn(&NodeResult) -> Vec3| Values::Vectors(nodes.iter().map(f).collect());
    let status = nodes.iter().map(|node| match node.status {
        ContactStatus::Open => 0,
        ContactStatus::Stick => 1,
        ContactStatus::Slip => 2,
    });
    // Points of a rigid side lodge with nodes of side `a`.
    let lodged = &state.pairs[pair].points;
    let lodges = |node: usize| side == 0 && lodged.get(node).is_some_and(Option::is_some);
    let own = state.pairs[pair].pointed[side].iter().enumerate();
    let pointed = own.map(|(node, own)| u8::from(*own) + 2 * u8::from(lodges(node)));
    let codes = |nodes: &[bool]| Values::Codes(nodes.iter().copied().map(u8::from).collect());
    let kept = &state.pairs[pair].kept;
    let grid = Grid {
        points: &points,
        cells: Cells::Quadrilaterals(&quads),
        point_arrays: vec![
            Array::new("gap", scalars(|node| node.gap)),
            Array::new("pressure", scalars(|node| node.pressure)),
            Array::new(
                "traction",
                vectors(|node| node.tau - node.normal * node.pressure),
            ),
            Array::new("friction_traction", vectors(|node| node.tau)),
            Array::new("mean_pressure", scalars(NodeResult::mean_pressure)),
            Array::new("mean_traction", vectors(|node| node.mean)),
            Array::new("slip", vectors(|node| node.slip)),
            Array::new("normal", vectors(|node| node.normal)),
            Array::new("texture", vectors(|node| node.texture)),
            Array::new(
                "structural_vector",
                vectors(|node| node.normal.cross(&node.texture)),
            ),
            Array::new("status", Values::Codes(status.collect())),
            Array::new("kept", codes(&kept[side])),
            Array::new("pointed", Values::Codes(pointed.collect())),
        ],
        cell_arrays: Vec::new(),
        time: state.time,
    };
    write(path, &grid)
}
