//! Residual and tangent of the whole problem at a trial state.
//!
//! Longer than other files, as all phases of an assembly are in one place.

mod agreement;
mod blocks;
mod cavities;
mod contacts;
mod context;
mod elements;
mod followers;
mod inertia;
mod linearised;
mod loads;
mod measure;
mod places;
mod scatter;
mod springs;
mod stabilisation;
mod start;
mod terms;
mod ties;
mod trial;

pub use crate::dynamics::ImposedRate;
pub use context::{Imposed, StepContext};
pub use elements::OfBodies;

use agreement::agreed;
use inertia::Inertia;
pub use linearised::{Background, ContactAssembled, assemble_contact};
pub use places::ElementPlaces;
use scatter::Scratch;
pub(crate) use start::initial_accelerations;
use std::{
    sync::Arc,
    time::{Duration, Instant},
};
use striae_condensed::{Growth, Partition, Tangent};
use striae_contact::{
    complementarity::Iteration, configuration::Configuration, evaluation::Evaluation,
    segment::Derivatives, selection::Selection, side::Side,
};
use striae_mesh::Vec3;
use striae_sparse::{PlacedBlock, SparseMatrix};
use striae_surface::node::SurfaceNode;
use terms::Triple;
use ties::{Moving, Tie};
pub use trial::Trial;

use crate::{
    layout::Layout,
    norms::Norms,
    outcome::CutBack,
    state::{NodalForces, State},
};
use striae_model::node::GlobalNode;

/// Data that stay constant during the iterations of an increment.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'a> {
    /// Data that stay constant within the step.
    pub context: &'a StepContext<'a>,
    /// The last converged state.
    pub state: &'a State,
    /// Roles of every pair.
    pub selections: &'a [Selection],
    /// Values imposed at the end of the increment.
    pub imposed: &'a Imposed,
}

/// Source of contact at a trial state.
#[derive(Debug)]
pub enum Contact {
    /// Contact is evaluated.
    Evaluated(Iteration),
    /// Contact has been evaluated at exactly this state.
    Known(Vec<Evaluation>),
}

/// Residual and results at a trial state.
#[derive(Clone, Debug)]
pub struct Assembled {
    /// Residual of every unknown; of prescribed components the present position
    /// minus the prescribed one.
    pub residual: Vec<f64>,
    /// Norms by field.
    pub norms: Norms,
    /// Nodal forces.
    pub forces: NodalForces,
    /// Energies, losses and internal variables of the bodies.
    pub bodies: OfBodies,
    /// Contact of every pair.
    pub contacts: Vec<Evaluation>,
    /// Derivatives requested; with them, the matrix is that of this state.
    pub derivatives: Derivatives,
    /// All but contact.
    pub background: Background,
    /// By what the pattern of contact has grown.
    pub growth: Growth,
    /// Time that contact took on the clock, most of it beside the bodies; for profiles only.
    pub contact_time: Duration,
}

/// Evaluates the problem at a trial state and fills the tangent; without derivatives the tangent
/// stays unchanged. The partition grows if contact has new couplings.
///
/// # Errors
/// Returns why the trial state cannot be evaluated.
pub fn assemble(
    setting: &Setting,
    trial: &Trial,
    contact: Contact,
    derivatives: Derivatives,
    layout: &Layout,
    (partition, places, tangent): (&mut Partition, &ElementPlaces, &mut Tangent),
) -> Result<Assembled, CutBack> {
    let whole = (partition, places, tangent);
    let phases = || in_phases(setting, trial, contact, derivatives, layout, whole);
    if setting.context.problem.share.is_alone() {
        // On a thread of the pool, as from others each parallel part would have to wake one.
        rayon::scope(|_| phases())
    } else {
        // No thread of the pool may wait for other ranks.
        phases()
    }
}

fn in_phases(
    setting: &Setting,
    trial: &Trial,
    contact: Contact,
    derivatives: Derivatives,
    layout: &Layout,
    (partition, places, tangent): (&mut Partition, &ElementPlaces, &mut Tangent),
) -> Result<Assembled, CutBack> {
    let (imposed, share) = (setting.imposed, &setting.context.problem.share);
    let Tangent {
        bodies,
        contact: contact_rows,
    } = tangent;
    let mut system = System::new(setting.context, layout, bodies, trial, imposed);
    system.derivatives = derivatives;
    let configurations = configurations(setting, trial);
    for (pair, configuration) in configurations.iter().enumerate() {
        system.find_triples(pair, configuration);
    }
    system.share_out_contact(setting);
    let added = std::mem::take(&mut system.added);
    // Bodies are added while contact is evaluated.
    let (evaluated, bodies) = rayon::scope(|_| {
        rayon::join(
            || timed(|| contact.evaluated(&configurations, setting, trial, derivatives, &added)),
            || system.bodies(&configurations, setting, trial, places),
        )
    });
    let (contacts, evaluation_time) = evaluated;
    system.added = added;
    let found = contacts.and_then(|contacts| Ok((contacts, bodies?)));
    let (mut contacts, mut bodies) = agreed(setting.context.problem, found)?;
    if !share.is_alone() {
        system.sum_at_nodes();
        system.beside_elements(imposed);
    }
    let background = match derivatives {
        Derivatives::First if share.is_alone() => system.background(),
        Derivatives::First | Derivatives::None => Background::default(),
    };
    let (growth, adding_time) = timed(|| {
        system.add_contacts(&contacts);
        system.stabilise(trial, imposed);
        match derivatives {
            Derivatives::First => system.gather(&contacts, partition, contact_rows),
            Derivatives::None => Growth::default(),
        }
    });
    system.pass_on();
    system.condense(imposed);
    let norms = system.norms(trial, &contacts);
    contacts.iter_mut().for_each(Evaluation::forget_derivatives);
    [bodies.strain, bodies.dissipated] = share.sums([bodies.strain, bodies.dissipated]);
    system.turn_rows();
    system.idle(setting.selections);
    system.prescribe(trial, imposed);
    system.prescribe_rigid(trial, imposed);
    let System {
        residual, forces, ..
    } = system;
    Ok(Assembled {
        residual,
        norms,
        forces,
        bodies,
        contacts,
        derivatives,
        background,
        growth,
        contact_time: evaluation_time + adding_time,
    })
}

/// Configurations of all pairs.
fn configurations<'a>(setting: &Setting<'a>, trial: &'a Trial) -> Vec<Configuration<'a>> {
    let pairs = 0..setting.context.pairs.len();
    pairs
        .map(|pair| {
            let context = setting.context;
            let configuration = context.configuration(pair, &trial.positions, &trial.rigid);
            configuration
                .lasting(setting.imposed.elapsed)
                .at_time(setting.imposed.time)
        })
        .collect()
}

struct System<'a> {
    context: &'a StepContext<'a>,
    layout: &'a Layout,
    /// The part of the bodies in the tangent.
    matrix: &'a mut SparseMatrix,
    /// Derivatives requested; with them, the tangent is filled in.
    derivatives: Derivatives,
    /// `true` if the bodies are linearised elsewhere, so that their part remains unchanged.
    is_linearised: bool,
    /// Couplings of contact, except for terms that already are blocks.
    blocks: Vec<PlacedBlock<'static>>,
    residual: Vec<f64>,
    forces: NodalForces,
    /// Of the forces in all elements.
    square_of_forces: f64,
    /// Largest error of the volume of a cavity, over the volume at rest.
    volumes: f64,
    inertia: Arc<Inertia>,
    /// Ties of all nodes; empty where nothing is tied.
    ties: Vec<Option<Tie>>,
    positions: &'a [Vec3],
    /// Rigid bodies whose coordinates are unknowns.
    moving: Vec<Option<Moving>>,
    /// Longest arm of contact forces on every rigid body.
    longest_push: Vec<f64>,
    /// Unknowns of every pair.
    triples: Vec<Vec<Option<Triple>>>,
    /// Nodes of every pair whose rows of contact this rank adds to the tangent, by side; `None`
    /// where it adds those that it owns.
    added: Vec<Option<[Vec<bool>; 2]>>,
    scratch: Scratch,
}

impl<'a> System<'a> {
    fn new(
        context: &'a StepContext<'a>,
        layout: &'a Layout,
        matrix: &'a mut SparseMatrix,
        trial: &'a Trial,
        imposed: &Imposed,
    ) -> Self {
        let problem = context.problem;
        let nodes = problem.reference.len();
        let mut system = Self {
            context,
            layout,
            matrix,
            derivatives: Derivatives::First,
            is_linearised: false,
            blocks: Vec::new(),
            residual: vec![0.0; layout.unknowns()],
            forces: NodalForces::zero(nodes, problem.model.rigid_surfaces.len()),
            square_of_forces: 0.0,
            volumes: 0.0,
            inertia: Arc::new(Inertia::new(&problem.ties, trial, imposed)),
            ties: Vec::new(),
            positions: &trial.positions,
            moving: Vec::new(),
            longest_push: vec![0.0; problem.model.rigid_surfaces.len()],
            triples: Vec::new(),
            added: Vec::new(),
            scratch: Scratch::default(),
        };
        system.find_ties(trial, imposed);
        system
    }
}

/// Result of some work, and the time it took.
fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let started = Instant::now();
    let result = work();
    (result, started.elapsed())
}

impl System<'_> {
    /// Elements, loads, springs and cavities, and on a rank that is alone everything but contact.
    fn bodies(
        &mut self,
        configurations: &[Configuration],
        setting: &Setting,
        trial: &Trial,
        places: &ElementPlaces,
    ) -> Result<OfBodies, CutBack> {
        let imposed = setting.imposed;
        let mut bodies = self.elements(places, trial, setting.state, imposed)?;
        self.loads(configurations, trial, imposed)?;
        self.springs(trial, setting.state, imposed, &mut bodies)?;
        self.cavities(trial, imposed)?;
        if self.context.problem.share.is_alone() {
            self.beside_elements(imposed);
        }
        Ok(bodies)
    }

    /// Contributions of the bodies other than elements and loads, which every rank that holds a
    /// node knows.
    fn beside_elements(&mut self, imposed: &Imposed) {
        self.point_masses();
        self.carried(imposed);
        self.pass_on();
        self.hold_followers();
    }

    /// Gives all ranks that hold a node the whole of what elements and loads add up to there;
    /// collective.
    fn sum_at_nodes(&mut self) {
        let problem = self.context.problem;
        let mut residual = self.position_rows();
        let forces = &mut self.forces;
        problem.share.sum_at_nodes(&mut [
            &mut residual,
            &mut forces.internal,
            &mut forces.applied,
            &mut forces.inertia,
        ]);
        self.put_position_rows(&residual);
    }

    /// Holds traction unknowns of nodes that are not kept any more at zero.
    fn idle(&mut self, selections: &[Selection]) {
        for (pair, selection) in selections.iter().enumerate() {
            for side in Side::BOTH {
                for node in SurfaceNode::all(selection.nodes(side)) {
                    if !selection.is_kept(side, node)
                        && let Some(first) = self.layout.traction(pair, side, node)
                    {
                        (first..first + 3).for_each(|unknown| self.hold(unknown, 0.0, 1.0));
                    }
                }
            }
        }
    }

    /// Takes the rows of nodes with axes of their own along these.
    fn turn_rows(&mut self) {
        for (node, frame) in self.context.turned.frames() {
            let first = self.layout.position(node);
            let rows = &mut self.residual[first..first + 3];
            let along = frame.axes().tr_mul(&Vec3::from_column_slice(rows));
            rows.copy_from_slice(along.as_slice());
        }
    }

    fn prescribe(&mut self, trial: &Trial, imposed: &Imposed) {
        let shear = |node: GlobalNode| {
            let (body, _) = self.context.problem.body_node(node);
            self.context.problem.compositions[body].stiffest_shear()
        };
        let rows: Vec<(usize, f64, f64)> = imposed
            .positions
            .iter()
            .map(|(node, axis, position)| {
                let residual = self.context.along(*node, *axis, &trial.positions[*node]) - position;
                (self.layout.position(*node) + axis, residual, shear(*node))
            })
            .collect();
        for (unknown, residual, scale) in rows {
            self.hold(unknown, residual * scale, scale);
        }
    }

    fn hold(&mut self, unknown: usize, residual: f64, scale: f64) {
        self.residual[unknown] = residual;
        let fills = self.derivatives == Derivatives::First && !self.is_linearised;
        if fills && self.owns(unknown) {
            self.matrix.add_to_diagonal(unknown, scale);
        }
    }

    /// Returns whether this rank adds a row known to all ranks to the tangent.
    fn owns(&self, unknown: usize) -> bool {
        let problem = self.context.problem;
        problem.share.is_alone()
            || self
                .layout
                .is_own(problem, self.matrix.structure().owner(unknown))
    }

    /// Residuals of the positions of all nodes.
    fn position_rows(&self) -> Vec<Vec3> {
        let rows = |node: GlobalNode| {
            let first = self.layout.position(node);
            Vec3::from_column_slice(&self.residual[first..first + 3])
        };
        self.context.problem.global_nodes().map(rows).collect()
    }

    fn put_position_rows(&mut self, rows: &[Vec3]) {
        for (node, row) in self.context.problem.global_nodes().zip(rows) {
            let first = self.layout.position(node);
            self.residual[first..first + 3].copy_from_slice(row.as_slice());
        }
    }
}
