//! Residual and tangent of the whole problem at a trial state.

mod context;
mod inertia;
mod loads;
mod measure;
mod start;
mod ties;

pub use context::{Imposed, ImposedRate, StepContext};

use inertia::Inertia;
use rayon::prelude::*;
pub use start::initial_accelerations;
use striae_contact::{
    complementarity::Iteration,
    configuration::Configuration,
    evaluation::{Evaluation, EvaluationError, evaluate},
    selection::Selection,
    term::LocalTerm,
    unknown::{Numbering, Unknown},
    unknowns::Tractions,
};
use striae_linalg::{OutsidePattern, SparseMatrix, Supervariable};
use striae_mesh::{FacetId, NodeId, Vec3};
use ties::{Slot, Tie};

use crate::{
    element::{ElementFault, ElementResponse},
    layout::Layout,
    norms::Norms,
    outcome::CutBack,
    rigid::Pose,
    state::NodalForces,
};

/// A state that is not converged.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Position of every global node.
    pub positions: Vec<Vec3>,
    /// Traction unknowns of every pair.
    pub tractions: Vec<Tractions>,
    /// Poses of the rigid bodies.
    pub rigid: Vec<Pose>,
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
    /// Stored energy.
    pub strain: f64,
    /// Contact of every pair.
    pub contacts: Vec<Evaluation>,
}

/// Why an assembly came to nothing.
#[derive(Debug)]
pub enum Fault {
    /// The trial state cannot be evaluated.
    CutBack(CutBack),
    /// Terms outside the pattern, as cliques to grow it by.
    Pattern(Vec<Vec<Supervariable>>),
}

/// Evaluates the problem at a trial state and fills the matrix.
///
/// # Errors
/// See [`Fault`].
pub fn assemble(
    context: &StepContext,
    selections: &[Selection],
    trial: &Trial,
    imposed: &Imposed,
    iteration: Iteration,
    layout: &Layout,
    matrix: &mut SparseMatrix,
) -> Result<Assembled, Fault> {
    let mut system = System::new(context, layout, matrix, trial, imposed);
    let configurations: Vec<Configuration> = (0..context.pairs.len())
        .map(|pair| {
            let configuration = context.configuration(pair, &trial.positions, &trial.rigid);
            configuration.lasting(imposed.elapsed)
        })
        .collect();
    let contacts = system.contacts(&configurations, selections, trial, iteration)?;
    if !system.outside.is_empty() {
        return Err(Fault::Pattern(system.outside));
    }
    system.loads(&configurations, trial, imposed)?;
    let strain = system.elements(trial)?;
    system.point_masses();
    system.carried(imposed);
    system.condense(imposed);
    let norms = system.norms(selections, trial, &contacts);
    system.idle(selections);
    system.prescribe(trial, imposed);
    system.prescribe_rigid(trial, imposed);
    let System {
        residual, forces, ..
    } = system;
    Ok(Assembled {
        residual,
        norms,
        forces,
        strain,
        contacts,
    })
}

struct System<'a> {
    context: &'a StepContext<'a>,
    layout: &'a Layout,
    matrix: &'a mut SparseMatrix,
    residual: Vec<f64>,
    forces: NodalForces,
    force_scale: f64,
    inertia: Inertia,
    /// Ties of all nodes; empty where nothing is tied.
    ties: Vec<Option<Tie>>,
    outside: Vec<Vec<Supervariable>>,
}

const CHUNK: usize = 512;

impl<'a> System<'a> {
    fn new(
        context: &'a StepContext<'a>,
        layout: &'a Layout,
        matrix: &'a mut SparseMatrix,
        trial: &Trial,
        imposed: &Imposed,
    ) -> Self {
        matrix.clear();
        let problem = context.problem;
        let nodes = problem.reference.len();
        let mut system = Self {
            context,
            layout,
            matrix,
            residual: vec![0.0; layout.unknowns()],
            forces: NodalForces::zero(nodes, problem.model.rigid_surfaces.len()),
            force_scale: 0.0,
            inertia: Inertia::new(trial, imposed),
            ties: Vec::new(),
            outside: Vec::new(),
        };
        system.find_ties(trial, imposed);
        system
    }
}

impl System<'_> {
    fn contacts(
        &mut self,
        configurations: &[Configuration],
        selections: &[Selection],
        trial: &Trial,
        iteration: Iteration,
    ) -> Result<Vec<Evaluation>, Fault> {
        let mut contacts = Vec::with_capacity(configurations.len());
        for (pair, configuration) in configurations.iter().enumerate() {
            let evaluation = evaluate(
                configuration,
                &selections[pair],
                &trial.tractions[pair],
                &self.context.fixed_on_pair[pair],
                iteration,
            )
            .map_err(|error| Fault::CutBack(self.not_evaluated(pair, error)))?;
            let numbering = configuration.pair.numbering();
            for term in &evaluation.terms {
                self.add_term(pair, &numbering, term);
            }
            for side in 0..2 {
                for (facet, forces) in &evaluation.facets[side] {
                    self.contact_forces(pair, side, *facet, &forces.force);
                }
            }
            contacts.push(evaluation);
        }
        Ok(contacts)
    }

    fn not_evaluated(&self, pair: usize, error: EvaluationError) -> CutBack {
        let problem = self.context.problem;
        let (side, node) = match error {
            EvaluationError::Lost(lost) => (lost.side, lost.node),
            EvaluationError::Collapsed(collapsed) => (collapsed.side, collapsed.node),
        };
        let global = problem.surface_node(pair, side, node).unwrap_or(0);
        let (body, node) = problem.body_node(global);
        let pair = problem.model.pairs[pair].name.clone();
        let body = problem.model.bodies[body].name.clone();
        match error {
            EvaluationError::Lost(_) => CutBack::LostProjection { pair, body, node },
            EvaluationError::Collapsed(_) => CutBack::CollapsedTexture { pair, body, node },
        }
    }

    fn contact_forces(&mut self, pair: usize, side: usize, facet: FacetId, forces: &[Vec3; 4]) {
        let problem = self.context.problem;
        if let Some(surface) = problem.pairs[pair].contact.sides[side].surface() {
            for (corner, force) in surface.facets()[facet.index()].iter().zip(forces) {
                if let Some(node) = problem.surface_node(pair, side, *corner) {
                    self.forces.contact[node] += force;
                }
            }
        }
    }

    /// Adds a contact term; remembers its clique where it has no place.
    fn add_term(&mut self, pair: usize, numbering: &Numbering, term: &LocalTerm) {
        let global = |unknown: &u32| {
            self.layout
                .global(self.context.problem, pair, numbering.unknown(*unknown))
                .expect("terms refer to active unknowns")
        };
        let position = |unknown: &u32| match numbering.unknown(*unknown) {
            Unknown::Position { side, node, axis } => {
                let node = self.context.problem.surface_node(pair, side, node)?;
                Some((node, axis))
            }
            Unknown::Traction { .. } | Unknown::Balance { .. } => None,
        };
        let slot = |unknown: &u32| Slot {
            unknown: global(unknown).0,
            position: position(unknown),
        };
        let rows: Vec<Slot> = term.rows.iter().map(slot).collect();
        let columns: Vec<Slot> = term.columns.iter().map(slot).collect();
        let owners = || term.rows.iter().chain(&term.columns);
        let mut clique: Vec<Supervariable> = owners().map(|u| global(u).1).collect();
        for (row, residual) in rows.iter().zip(&term.residual) {
            self.residual[row.unknown] += residual;
        }
        let kept: Vec<usize> = (0..rows.len())
            .filter(|&at| !self.is_fixed(&rows[at]))
            .collect();
        let kept_rows: Vec<Slot> = kept.iter().map(|&at| rows[at]).collect();
        let block: Vec<f64> = kept
            .iter()
            .flat_map(|at| &term.tangent[at * columns.len()..(at + 1) * columns.len()])
            .copied()
            .collect();
        let structure = self.matrix.structure();
        let known = clique.iter().all(|&s| structure.is_kept(s));
        if !known || self.scatter(&kept_rows, &columns, &block).is_err() {
            clique.sort_unstable();
            clique.dedup();
            self.outside.push(clique);
        }
    }

    fn is_fixed(&self, slot: &Slot) -> bool {
        slot.position
            .is_some_and(|(node, axis)| self.context.fixed[3 * node + axis])
    }

    fn clique(&self, nodes: &[usize]) -> Vec<Supervariable> {
        let mut owners: Vec<Supervariable> = nodes.iter().map(|&node| self.owner(node)).collect();
        owners.sort_unstable();
        owners.dedup();
        owners
    }

    /// Internal forces and stiffness; returns the stored energy.
    fn elements(&mut self, trial: &Trial) -> Result<f64, Fault> {
        let problem = self.context.problem;
        let mut energy = 0.0;
        let mut scale = 0.0;
        for (body, elements) in problem.elements.iter().enumerate() {
            let model = &problem.model.bodies[body];
            let corners = &model.mesh.elements;
            for start in (0..elements.len()).step_by(CHUNK) {
                let end = (start + CHUNK).min(elements.len());
                let responses: Vec<Result<Box<ElementResponse>, _>> = (start..end)
                    .into_par_iter()
                    .with_min_len(16)
                    .map(|at| {
                        let x = corners[at].map(|n| trial.positions[problem.node(body, n)]);
                        elements[at].response(&x, &model.material).map(Box::new)
                    })
                    .collect();
                for (at, response) in (start..end).zip(responses) {
                    let response = response.map_err(|error| {
                        Fault::CutBack(CutBack::InvertedElement {
                            body: model.name.clone(),
                            element: ElementFault {
                                element: striae_mesh::ElementId::new(at),
                                error,
                            },
                        })
                    })?;
                    let mut response = response;
                    energy += response.energy;
                    let nodes = corners[at].map(|n: NodeId| problem.node(body, n));
                    let mass = (model.density > 0.0).then(|| elements[at].mass(model.density));
                    self.weigh(&nodes, mass.as_ref(), &mut response);
                    scale += response.force.iter().map(|f| f * f).sum::<f64>();
                    let mut unknowns = [0; 24];
                    for (slot, unknown) in unknowns.iter_mut().enumerate() {
                        *unknown = self.layout.position(nodes[slot / 3]) + slot % 3;
                    }
                    self.add_dense(&nodes, &unknowns, &response.force, &response.stiffness)
                        .map_err(|_| Fault::Pattern(vec![self.clique(&nodes)]))?;
                }
            }
        }
        self.force_scale = scale.sqrt();
        Ok(energy)
    }

    /// Adds a square block of position unknowns, leaving out prescribed rows.
    fn add_dense(
        &mut self,
        nodes: &[usize],
        unknowns: &[usize],
        force: &[f64],
        tangent: &[f64],
    ) -> Result<(), OutsidePattern> {
        for (unknown, force) in unknowns.iter().zip(force) {
            self.residual[*unknown] += force;
        }
        let fixed = |slot: &usize| self.context.fixed[3 * nodes[slot / 3] + slot % 3];
        let tied = nodes.iter().any(|&node| self.tie(node).is_some());
        if !tied && !(0..unknowns.len()).any(|slot| fixed(&slot)) {
            return self.matrix.add(unknowns, unknowns, tangent);
        }
        let slot = |at: usize| Slot {
            unknown: unknowns[at],
            position: Some((nodes[at / 3], at % 3)),
        };
        let kept: Vec<usize> = (0..unknowns.len()).filter(|at| !fixed(at)).collect();
        let rows: Vec<Slot> = kept.iter().map(|&at| slot(at)).collect();
        let columns: Vec<Slot> = (0..unknowns.len()).map(slot).collect();
        let width = unknowns.len();
        let block: Vec<f64> = kept
            .iter()
            .flat_map(|at| &tangent[at * width..(at + 1) * width])
            .copied()
            .collect();
        self.scatter(&rows, &columns, &block)
    }

    /// Holds traction unknowns of idle nodes and of vanished patches at zero.
    fn idle(&mut self, selections: &[Selection]) {
        for (pair, selection) in selections.iter().enumerate() {
            for side in 0..2 {
                for node in 0..selection.roles[side].len() {
                    if !selection.is_active(side, node as u32)
                        && let Some(first) = self.layout.traction(pair, side, node)
                    {
                        (first..first + 3).for_each(|unknown| self.hold(unknown, 0.0, 1.0));
                    }
                }
            }
            for patch in selection.patches.len()..self.layout.patch_count(pair) {
                let first = self.layout.balance(pair, patch);
                (first..first + 6).for_each(|unknown| self.hold(unknown, 0.0, 1.0));
            }
        }
    }

    fn prescribe(&mut self, trial: &Trial, imposed: &Imposed) {
        let shear = |node: usize| {
            let (body, _) = self.context.problem.body_node(node);
            self.context.problem.model.bodies[body]
                .material
                .lame_constants()
                .shear
        };
        let rows: Vec<(usize, f64, f64)> = imposed
            .positions
            .iter()
            .map(|(node, axis, position)| {
                let residual = trial.positions[*node][*axis] - position;
                (self.layout.position(*node) + axis, residual, shear(*node))
            })
            .collect();
        for (unknown, residual, scale) in rows {
            self.hold(unknown, residual * scale, scale);
        }
    }

    fn hold(&mut self, unknown: usize, residual: f64, scale: f64) {
        self.residual[unknown] = residual;
        self.matrix
            .add(&[unknown], &[unknown], &[scale])
            .expect("the diagonal is in the pattern");
    }
}
