//! One increment: semismooth Newton's method.
//!
//! The first iteration is linearised at the last converged state with the new
//! loads; its solution takes the prescribed displacements to their new values.
//! From then on the residual alone decides: labels of nodes at the kink of the
//! friction law may flip at round-off and are not required to rest.

use striae_contact::{
    complementarity::Iteration,
    evaluation::{Evaluation, missed_contacts},
    selection::{Role, Selection},
    traction::reinterpreted,
    unknowns::{Status, Tractions},
};
use striae_linalg::{
    Analysis, FaerLu, LinearSolver, MultifrontalLu, SolveError, SparseMatrix, Structure,
    Supervariable,
};
use striae_mesh::Vec3;

use crate::{
    assembly::{Assembled, Fault, Imposed, StepContext, Trial, assemble},
    layout::Layout,
    model::Backend,
    norms::Norms,
    outcome::{CutBack, CyclingNode},
    problem::Problem,
    state::{Energies, PairState, State},
};

/// What survives between increments to save work; it holds no results.
pub struct Workspace {
    solver: Box<dyn LinearSolver>,
    system: Option<SystemStorage>,
}

struct SystemStorage {
    layout: Layout,
    matrix: SparseMatrix,
    analysis: Analysis,
    analysed: bool,
}

/// A converged increment.
#[derive(Clone, Debug)]
pub struct Increment {
    /// The new state.
    pub state: State,
    /// Norms of every iteration; the last ones are converged.
    pub iterations: Vec<Norms>,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Predicted memory of the factorisation in bytes.
    pub peak_bytes: usize,
}

/// Told of every iteration.
pub trait IterationObserver {
    /// An iteration of Newton's method has been evaluated.
    fn iteration(&mut self, number: usize, norms: &Norms, contacts: &[Evaluation]);
}

impl Workspace {
    /// An empty workspace with the given factorisation.
    pub fn new(backend: Backend) -> Self {
        let solver: Box<dyn LinearSolver> = match backend {
            Backend::Multifrontal => Box::new(MultifrontalLu::new()),
            Backend::Faer => Box::new(FaerLu::new()),
        };
        Self {
            solver,
            system: None,
        }
    }

    /// Makes sure the layout covers all roles of the increment.
    fn prepare(&mut self, problem: &Problem, pairs: &[PairState]) {
        let known = self
            .system
            .as_ref()
            .map(|system| system.layout.extent().clone());
        let extent = known.clone().unwrap_or_default().with(pairs);
        if known.as_ref() == Some(&extent) {
            return;
        }
        let layout = Layout::new(problem, extent);
        let mut cliques: Vec<Vec<Supervariable>> = Vec::new();
        for (body, model) in problem.model.bodies.iter().enumerate() {
            for corners in &model.mesh.elements {
                let nodes = corners.map(|node| layout.supervariable(problem.node(body, node)));
                cliques.push(nodes.to_vec());
            }
        }
        cliques.extend((0..layout.offsets().len() - 1).map(|at| vec![Supervariable(at)]));
        let structure = Structure::from_cliques(layout.offsets().to_vec(), &cliques)
            .and_then(|structure| structure.with_tiers(layout.tiers()))
            .expect("the layout names its own supervariables");
        self.system = Some(SystemStorage {
            matrix: SparseMatrix::zero(&structure),
            layout,
            analysis: Analysis::default(),
            analysed: false,
        });
    }

    fn system(&mut self) -> &mut SystemStorage {
        self.system.as_mut().expect("the workspace was prepared")
    }

    fn assemble(
        &mut self,
        context: &StepContext,
        selections: &[Selection],
        trial: &Trial,
        imposed: &Imposed,
        iteration: Iteration,
    ) -> Result<Assembled, CutBack> {
        let system = self.system();
        loop {
            let assembled = assemble(
                context,
                selections,
                trial,
                imposed,
                iteration,
                &system.layout,
                &mut system.matrix,
            );
            match assembled {
                Ok(assembled) => return Ok(assembled),
                Err(Fault::CutBack(reason)) => return Err(reason),
                Err(Fault::Pattern(cliques)) => {
                    let grown = system.matrix.structure().grown(&cliques);
                    let structure = grown.expect("cliques name known supervariables");
                    system.matrix = SparseMatrix::zero(&structure);
                    system.analysed = false;
                }
            }
        }
    }

    /// Solves for the correction, `J correction = -residual`.
    fn correction(&mut self, residual: &[f64]) -> Result<Vec<f64>, SolveError> {
        let solver = &mut self.solver;
        let system = self.system.as_mut().expect("the workspace was prepared");
        if !system.analysed {
            system.analysis = solver.analyse(system.matrix.structure())?;
            system.analysed = true;
        }
        solver.factor(&system.matrix)?;
        let rhs: Vec<f64> = residual.iter().map(|r| -r).collect();
        let mut correction = vec![0.0; rhs.len()];
        solver.solve(&system.matrix, &rhs, &mut correction)?;
        Ok(correction)
    }
}

/// Size of the linear systems at the start of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Predicted cost of a factorisation.
    pub analysis: Analysis,
}

/// Predicts the cost of the first linear system of a problem.
///
/// # Errors
/// Why the undeformed state cannot be evaluated.
pub fn estimate(problem: &Problem) -> Result<Estimate, CutBack> {
    let state = State::undeformed(problem);
    let context = StepContext::new(problem, 0, &state);
    let (selections, pairs) = selected(&context, &state);
    let mut workspace = Workspace::new(Backend::Multifrontal);
    workspace.prepare(problem, &pairs);
    let trial = Trial {
        positions: state.positions.clone(),
        tractions: pairs.iter().map(|pair| pair.tractions.clone()).collect(),
    };
    let imposed = context.imposed(0.0);
    workspace.assemble(&context, &selections, &trial, &imposed, Iteration::First)?;
    let structure = workspace.system().matrix.structure().clone();
    let analysis = workspace
        .solver
        .analyse(&structure)
        .map_err(|error| linear_system(problem, &workspace.system().layout, error))?;
    Ok(Estimate {
        unknowns: structure.unknowns(),
        analysis,
    })
}

/// Advances from `state` to the fraction `s` of the step.
///
/// # Errors
/// Why the increment has to be cut.
pub fn advance(
    context: &StepContext,
    state: &State,
    s: f64,
    time: f64,
    workspace: &mut Workspace,
    observer: &mut dyn IterationObserver,
) -> Result<Increment, CutBack> {
    let imposed = context.imposed(s);
    let (selections, pairs) = selected(context, state);
    workspace.prepare(context.problem, &pairs);
    let mut trial = Trial {
        positions: state.positions.clone(),
        tractions: pairs.iter().map(|pair| pair.tractions.clone()).collect(),
    };
    let solver = &context.problem.model.solver;
    let mut iterations: Vec<Norms> = Vec::new();
    let mut history = History::default();
    let mut assembled =
        workspace.assemble(context, &selections, &trial, &imposed, Iteration::First)?;
    for number in 1.. {
        let correction = workspace
            .correction(&assembled.residual)
            .map_err(|error| linear_system(context.problem, &workspace.system().layout, error))?;
        (trial, assembled) = step(
            workspace,
            context,
            &selections,
            &trial,
            &imposed,
            &correction,
        )?;
        let norms = assembled.norms;
        iterations.push(norms);
        history.push(&assembled.contacts);
        observer.iteration(number, &norms, &assembled.contacts);
        if norms.largest() <= solver.tolerance {
            break;
        }
        if !norms.largest().is_finite() || norms.force > 1e8 {
            return Err(CutBack::Diverged {
                iteration: number,
                norms,
            });
        }
        if number >= solver.largest_iterations {
            return Err(CutBack::NoConvergence {
                iterations: number,
                norms,
                cycling: history.cycling(context.problem, &selections),
            });
        }
    }
    if let Some(missed) = missed(context, &selections, &trial, &imposed) {
        return Err(missed);
    }
    let system = workspace.system();
    Ok(Increment {
        unknowns: system.layout.unknowns(),
        peak_bytes: system.analysis.peak_bytes,
        state: accepted(context, state, time, trial, imposed, selections, assembled),
        iterations,
    })
}

/// Roles in the converged state, and pair states that fit them.
fn selected(context: &StepContext, state: &State) -> (Vec<Selection>, Vec<PairState>) {
    let mut selections = Vec::with_capacity(state.pairs.len());
    let mut pairs = state.pairs.clone();
    for (pair, pair_state) in pairs.iter_mut().enumerate() {
        let configuration =
            context.configuration(pair, &state.positions, &state.rigid_displacements);
        let selection = Selection::new(&configuration, &pair_state.kinematic);
        let kinematic = selection.kinematic();
        for side in 0..2 {
            for node in 0..selection.roles[side].len() {
                let unknowns = &mut pair_state.tractions.nodes[side][node];
                if selection.roles[side][node] == Role::Idle {
                    *unknowns = [0.0; 3];
                } else if kinematic[side][node] != pair_state.kinematic[side][node] {
                    *unknowns = reinterpreted(*unknowns);
                }
            }
        }
        if pair_state.tractions.balance.len() != selection.patches.len() {
            pair_state.tractions.balance = vec![[0.0; 6]; selection.patches.len()];
        }
        pair_state.tractions.slipped = [0, 1].map(|side| {
            let results = pair_state.nodes[side].iter();
            results
                .zip(&pair_state.kinematic[side])
                .map(|(node, was)| *was && node.status == Status::Slip)
                .collect()
        });
        pair_state.kinematic = kinematic;
        pair_state.selection = Some(selection.clone());
        selections.push(selection);
    }
    (selections, pairs)
}

const HALVINGS: usize = 4;

/// Applies a correction, halved while it turns elements inside out.
fn step(
    workspace: &mut Workspace,
    context: &StepContext,
    selections: &[Selection],
    trial: &Trial,
    imposed: &Imposed,
    correction: &[f64],
) -> Result<(Trial, Assembled), CutBack> {
    let mut factor = 1.0;
    for _ in 0..HALVINGS {
        let next = corrected(workspace.system(), trial, correction, factor);
        match workspace.assemble(context, selections, &next, imposed, Iteration::Later) {
            Ok(assembled) => return Ok((next, assembled)),
            Err(CutBack::InvertedElement { .. } | CutBack::LostProjection { .. }) => factor *= 0.5,
            Err(other) => return Err(other),
        }
    }
    let next = corrected(workspace.system(), trial, correction, factor);
    let assembled = workspace.assemble(context, selections, &next, imposed, Iteration::Later)?;
    Ok((next, assembled))
}

fn corrected(system: &SystemStorage, trial: &Trial, correction: &[f64], factor: f64) -> Trial {
    let layout = &system.layout;
    let mut next = trial.clone();
    for (node, position) in next.positions.iter_mut().enumerate() {
        let first = layout.position(node);
        *position += Vec3::from_column_slice(&correction[first..first + 3]) * factor;
    }
    for (pair, tractions) in next.tractions.iter_mut().enumerate() {
        add_tractions(layout, pair, tractions, correction, factor);
    }
    next
}

fn add_tractions(
    layout: &Layout,
    pair: usize,
    tractions: &mut Tractions,
    correction: &[f64],
    factor: f64,
) {
    for side in 0..2 {
        for (node, unknowns) in tractions.nodes[side].iter_mut().enumerate() {
            if let Some(first) = layout.traction(pair, side, node) {
                for (component, unknown) in unknowns.iter_mut().enumerate() {
                    *unknown += factor * correction[first + component];
                }
            }
        }
    }
    for (patch, unknowns) in tractions.balance.iter_mut().enumerate() {
        let first = layout.balance(pair, patch);
        for (component, unknown) in unknowns.iter_mut().enumerate() {
            *unknown += factor * correction[first + component];
        }
    }
}

fn missed(
    context: &StepContext,
    selections: &[Selection],
    trial: &Trial,
    imposed: &Imposed,
) -> Option<CutBack> {
    let problem = context.problem;
    for (pair, selection) in selections.iter().enumerate() {
        let configuration = context.configuration(pair, &trial.positions, &imposed.rigid);
        let missed = missed_contacts(&configuration, selection);
        if let Some(&(side, node)) = missed.first() {
            let global = problem.surface_node(pair, side, node)?;
            let (body, node) = problem.body_node(global);
            return Some(CutBack::MissedContact {
                pair: problem.model.pairs[pair].name.clone(),
                body: problem.model.bodies[body].name.clone(),
                node,
                count: missed.len(),
            });
        }
    }
    None
}

fn linear_system(problem: &Problem, layout: &Layout, error: SolveError) -> CutBack {
    let place = match &error {
        SolveError::Singular { unknown, .. } => place(problem, layout, *unknown),
        _ => "linear system".to_owned(),
    };
    CutBack::LinearSystem { place, error }
}

/// Words for a global unknown.
fn place(problem: &Problem, layout: &Layout, unknown: usize) -> String {
    let at = layout
        .offsets()
        .partition_point(|&offset| offset <= unknown)
        - 1;
    if at >= problem.reference.len() {
        return "the balance of a contact patch is not determined".to_owned();
    }
    let (body, node) = problem.body_node(at);
    let name = &problem.model.bodies[body].name;
    match unknown - layout.position(at) {
        component @ 0..3 => {
            let axis = ["x", "y", "z"][component];
            format!("body `{name}` is not held: {node} is free to move in {axis}")
        }
        _ => format!("the contact traction at {node} of body `{name}` is not determined"),
    }
}

/// Status of all kinematic nodes in every iteration.
#[derive(Default)]
struct History(Vec<Vec<[Vec<Status>; 2]>>);

impl History {
    fn push(&mut self, contacts: &[Evaluation]) {
        let statuses = |evaluation: &Evaluation| {
            evaluation
                .nodes
                .each_ref()
                .map(|side| side.iter().map(|node| node.status).collect())
        };
        self.0.push(contacts.iter().map(statuses).collect());
    }

    /// Kinematic nodes whose status changed within the last iterations.
    fn cycling(&self, problem: &Problem, selections: &[Selection]) -> Vec<CyclingNode> {
        const WINDOW: usize = 6;
        let last = &self.0[self.0.len().saturating_sub(WINDOW)..];
        let mut cycling = Vec::new();
        for (pair, selection) in selections.iter().enumerate() {
            for side in 0..2 {
                for (node, role) in selection.roles[side].iter().enumerate() {
                    let statuses: Vec<Status> = last
                        .iter()
                        .map(|contacts| contacts[pair][side][node])
                        .collect();
                    let changes = statuses.windows(2).any(|pair| pair[0] != pair[1]);
                    let kinematic = matches!(role, Role::Kinematic(_));
                    if let Some(global) = problem.surface_node(pair, side, node as u32)
                        && kinematic
                        && changes
                    {
                        let (body, node) = problem.body_node(global);
                        cycling.push(CyclingNode {
                            pair: problem.model.pairs[pair].name.clone(),
                            body: problem.model.bodies[body].name.clone(),
                            node,
                            history: statuses.iter().map(letter).collect(),
                        });
                    }
                }
            }
        }
        cycling
    }
}

fn letter(status: &Status) -> char {
    match status {
        Status::Open => 'o',
        Status::Stick => 's',
        Status::Slip => 'S',
    }
}

fn accepted(
    context: &StepContext,
    state: &State,
    time: f64,
    trial: Trial,
    imposed: Imposed,
    selections: Vec<Selection>,
    assembled: Assembled,
) -> State {
    let energies = energies(context.problem, state, &trial, &imposed, &assembled);
    let pairs = trial
        .tractions
        .into_iter()
        .zip(selections)
        .zip(assembled.contacts)
        .zip(&state.pairs)
        .map(|(((tractions, selection), evaluation), before)| PairState {
            dissipated: before.dissipated + dissipation(&selection, &evaluation),
            kinematic: selection.kinematic(),
            selection: Some(selection),
            tractions,
            nodes: evaluation.nodes,
            facets: evaluation.facets,
        })
        .collect();
    State {
        time,
        positions: trial.positions,
        rigid_displacements: imposed.rigid,
        pairs,
        forces: assembled.forces,
        energies,
    }
}

/// Frictional work of an increment from the kinematic nodes, each of whose
/// contributions `-tau . du` is not negative, scaled from the pressure they
/// carry to the whole normal force.
fn dissipation(selection: &Selection, evaluation: &Evaluation) -> f64 {
    let mut work = 0.0;
    let mut carried = 0.0;
    let mut whole = 0.0;
    let sides = evaluation
        .facets
        .iter()
        .filter(|side| !side.is_empty())
        .count();
    for side in 0..2 {
        let areas = &evaluation.nodal_areas[side];
        whole += evaluation.facets[side]
            .iter()
            .map(|(_, f)| f.pressure)
            .sum::<f64>();
        for (node, role) in selection.roles[side].iter().enumerate() {
            if matches!(role, Role::Kinematic(_)) {
                let result = &evaluation.nodes[side][node];
                work -= areas[node] * result.tau.dot(&result.slip);
                carried += areas[node] * result.pressure;
            }
        }
    }
    if carried > 0.0 {
        work * whole / (carried * sides as f64)
    } else {
        0.0
    }
}

/// Energies by the trapezoidal rule over the increment.
fn energies(
    problem: &Problem,
    state: &State,
    trial: &Trial,
    imposed: &Imposed,
    assembled: &Assembled,
) -> Energies {
    let (before, after) = (&state.forces, &assembled.forces);
    let mut external = 0.0;
    let mut contact = 0.0;
    for node in 0..problem.reference.len() {
        let motion = trial.positions[node] - state.positions[node];
        let mean = |a: &[Vec3], b: &[Vec3]| (a[node] + b[node]) * 0.5;
        external += motion.dot(&mean(&before.applied, &after.applied));
        external += motion.dot(&mean(&before.reaction, &after.reaction));
        contact -= motion.dot(&mean(&before.contact, &after.contact));
    }
    for (pair, geometry) in problem.pairs.iter().enumerate() {
        if let Some(rigid) = geometry.rigid {
            let motion = imposed.rigid[rigid] - state.rigid_displacements[rigid];
            let sum = |facets: &[(striae_mesh::FacetId, striae_contact::field::FacetForces)]| {
                facets.iter().flat_map(|(_, f)| f.force).sum::<Vec3>()
            };
            let force = (sum(&state.pairs[pair].facets[0])
                + sum(&assembled.contacts[pair].facets[0]))
                * 0.5;
            external += motion.dot(&force);
            contact += motion.dot(&force);
        }
    }
    Energies {
        strain: assembled.strain,
        external: state.energies.external + external,
        contact: state.energies.contact + contact,
    }
}
