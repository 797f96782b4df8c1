//! Residual and tangent of the whole problem at a trial state.

mod context;
mod inertia;
mod loads;
mod measure;

pub use context::{Imposed, ImposedRate, StepContext};

use inertia::Inertia;
use rayon::prelude::*;
use striae_contact::{
    complementarity::Iteration,
    configuration::Configuration,
    evaluation::{Evaluation, EvaluationError, evaluate},
    selection::Selection,
    term::LocalTerm,
    unknown::Numbering,
    unknowns::Tractions,
};
use striae_linalg::{OutsidePattern, SparseMatrix, Supervariable};
use striae_mesh::{FacetId, NodeId, Vec3};

use crate::{
    element::{ElementFault, ElementResponse},
    layout::Layout,
    norms::Norms,
    outcome::CutBack,
    state::NodalForces,
};

/// A state that is not converged.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Position of every global node.
    pub positions: Vec<Vec3>,
    /// Traction unknowns of every pair.
    pub tractions: Vec<Tractions>,
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
    matrix.clear();
    let mut system = System {
        context,
        layout,
        matrix,
        residual: vec![0.0; layout.unknowns()],
        forces: NodalForces::zero(context.problem.reference.len()),
        force_scale: 0.0,
        inertia: Inertia::new(trial, imposed),
        outside: Vec::new(),
    };
    let configurations: Vec<Configuration> = (0..context.pairs.len())
        .map(|pair| {
            let rigid = &imposed.rigid;
            let configuration = context.configuration(pair, &trial.positions, rigid);
            configuration.lasting(imposed.elapsed)
        })
        .collect();
    let contacts = system.contacts(&configurations, selections, trial, iteration)?;
    if !system.outside.is_empty() {
        return Err(Fault::Pattern(system.outside));
    }
    system.loads(&configurations, trial, imposed)?;
    let strain = system.elements(trial)?;
    system.carried(imposed);
    let norms = system.norms(selections, trial, &contacts);
    system.idle(selections);
    system.prescribe(trial, imposed);
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
    outside: Vec<Vec<Supervariable>>,
}

const CHUNK: usize = 512;

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
        let rows: Vec<(usize, Supervariable)> = term.rows.iter().map(global).collect();
        let columns: Vec<(usize, Supervariable)> = term.columns.iter().map(global).collect();
        for (row, residual) in rows.iter().zip(&term.residual) {
            self.residual[row.0] += residual;
        }
        let kept: Vec<usize> = (0..rows.len())
            .filter(|&at| !self.is_fixed(rows[at]))
            .collect();
        let kept_rows: Vec<usize> = kept.iter().map(|&at| rows[at].0).collect();
        let kept_columns: Vec<usize> = columns.iter().map(|column| column.0).collect();
        let block: Vec<f64> = kept
            .iter()
            .flat_map(|at| &term.tangent[at * columns.len()..(at + 1) * columns.len()])
            .copied()
            .collect();
        let mut clique: Vec<Supervariable> =
            rows.iter().chain(&columns).map(|entry| entry.1).collect();
        let structure = self.matrix.structure();
        let known = clique.iter().all(|&s| structure.is_kept(s));
        if !known || self.matrix.add(&kept_rows, &kept_columns, &block).is_err() {
            clique.sort_unstable();
            clique.dedup();
            self.outside.push(clique);
        }
    }

    fn is_fixed(&self, (unknown, supervariable): (usize, Supervariable)) -> bool {
        let node = supervariable.0;
        node < self.context.problem.reference.len()
            && unknown < self.layout.position(node) + 3
            && self.context.fixed[3 * node + unknown - self.layout.position(node)]
    }

    fn clique(&self, nodes: &[usize]) -> Vec<Supervariable> {
        nodes
            .iter()
            .map(|&node| self.layout.supervariable(node))
            .collect()
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
        if !(0..unknowns.len()).any(|slot| fixed(&slot)) {
            return self.matrix.add(unknowns, unknowns, tangent);
        }
        let kept: Vec<usize> = (0..unknowns.len()).filter(|slot| !fixed(slot)).collect();
        let rows: Vec<usize> = kept.iter().map(|&slot| unknowns[slot]).collect();
        let width = unknowns.len();
        let block: Vec<f64> = kept
            .iter()
            .flat_map(|slot| &tangent[slot * width..(slot + 1) * width])
            .copied()
            .collect();
        self.matrix.add(&rows, unknowns, &block)
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
