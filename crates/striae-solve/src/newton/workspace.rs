//! The linear system of an increment, kept for the next ones.

use std::time::{Duration, Instant};

use striae_contact::{complementarity::Iteration, selection::Selection};
use striae_linalg::{
    Analysis, Automatic, FaerLu, FallBack, Interior, LinearSolver, Method, MultifrontalLu,
    SolveError, SparseMatrix, Structure, Supervariable,
};

use striae_mesh::Vec3;

use crate::{
    assembly::{Assembled, Fault, Imposed, StepContext, Trial, assemble},
    layout::Layout,
    model::Backend,
    outcome::CutBack,
    problem::Problem,
    state::PairState,
};

/// Corners `a`, `b` of an element and the components they share.
fn corner_pairs() -> impl Iterator<Item = (usize, usize, usize)> {
    (0..192).map(|at| (at / 24, at / 3 % 8, at % 3))
}

/// What survives between increments to save work; it holds no results.
pub struct Workspace {
    pub(super) solver: Box<dyn LinearSolver>,
    system: Option<SystemStorage>,
    work: LinearWork,
}

/// What the linear systems of an increment took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearWork {
    /// Factorisations of the bodies; others of contact were made on older ones.
    pub factorisations: usize,
    /// How the last one was made.
    pub method: Method,
    /// Why the condensed solver was not used in the last one, where it was asked for.
    pub fall_back: Option<FallBack>,
    /// Where the time went.
    pub times: Times,
}

/// Time on the wall clock, for profiles only.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Times {
    /// Residuals and matrices.
    pub assembly: Duration,
    /// Orderings and plans.
    pub analysis: Duration,
    /// Factorisations.
    pub factorisation: Duration,
    /// Solutions with refinement.
    pub solution: Duration,
}

pub(super) struct SystemStorage {
    pub(super) layout: Layout,
    pub(super) matrix: SparseMatrix,
    pub(super) analysis: Analysis,
    analysed: bool,
}

impl Workspace {
    /// An empty workspace with the given factorisation.
    pub fn new(backend: Backend) -> Self {
        let solver: Box<dyn LinearSolver> = match backend {
            Backend::Condensed => Box::new(Automatic::new()),
            Backend::Multifrontal => Box::new(MultifrontalLu::new()),
            Backend::Faer => Box::new(FaerLu::new()),
        };
        Self {
            solver,
            system: None,
            work: LinearWork::default(),
        }
    }

    /// Makes sure the layout covers all roles of the increment.
    pub(super) fn prepare(&mut self, problem: &Problem, pairs: &[PairState]) {
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
            .and_then(|structure| structure.with_bulk(&layout.bulk()))
            .expect("the layout names its own supervariables");
        self.system = Some(SystemStorage {
            matrix: SparseMatrix::zero(&structure),
            layout,
            analysis: Analysis::default(),
            analysed: false,
        });
    }

    pub(super) fn system(&mut self) -> &mut SystemStorage {
        self.system.as_mut().expect("the workspace was prepared")
    }

    pub(super) fn assemble(
        &mut self,
        context: &StepContext,
        selections: &[Selection],
        trial: &Trial,
        imposed: &Imposed,
        iteration: Iteration,
    ) -> Result<Assembled, CutBack> {
        let (started, assembly) = (Instant::now(), self.work.times.assembly);
        let system = self.system.as_mut().expect("the workspace was prepared");
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
            self.work.times.assembly = assembly + started.elapsed();
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

    /// Solves `M a = forces` for the components that are not prescribed.
    pub(crate) fn accelerations(
        &mut self,
        context: &StepContext,
        forces: &[Vec3],
    ) -> Result<Vec<Vec3>, SolveError> {
        let problem = context.problem;
        let SystemStorage { layout, matrix, .. } = self.system();
        let mut residual = vec![0.0; layout.unknowns()];
        matrix.clear();
        let mut add = |row: usize, column: usize, value: f64| {
            matrix
                .add(&[row], &[column], &[value])
                .expect("elements are in the pattern");
        };
        for (node, force) in forces.iter().enumerate() {
            for axis in (0..3).filter(|axis| !context.fixed[3 * node + axis]) {
                residual[layout.position(node) + axis] = -force[axis];
            }
        }
        let mut held = vec![true; residual.len()];
        for (body, model) in problem.model.bodies.iter().enumerate() {
            for (corners, element) in model.mesh.elements.iter().zip(&problem.elements[body]) {
                let mass = element.mass(model.density);
                let nodes = corners.map(|node| problem.node(body, node));
                for (a, b, axis) in corner_pairs() {
                    let free = |node: usize| !context.fixed[3 * node + axis];
                    if free(nodes[a]) && free(nodes[b]) {
                        let [row, column] = [a, b].map(|c| layout.position(nodes[c]) + axis);
                        add(row, column, mass[a][b]);
                        held[row] = false;
                    }
                }
            }
        }
        for unknown in (0..held.len()).filter(|&unknown| held[unknown]) {
            add(unknown, unknown, 1.0);
        }
        let solution = self.correction(&residual)?;
        let layout = &self.system().layout;
        let of_node = |node: usize| {
            let first = layout.position(node);
            Vec3::from_column_slice(&solution[first..first + 3])
        };
        Ok((0..forces.len()).map(of_node).collect())
    }

    /// What was done since the last call.
    pub(super) fn take_work(&mut self) -> LinearWork {
        std::mem::take(&mut self.work)
    }

    /// Solves for the correction, `J correction = -residual`.
    pub(super) fn correction(&mut self, residual: &[f64]) -> Result<Vec<f64>, SolveError> {
        let solver = &mut self.solver;
        let system = self.system.as_mut().expect("the workspace was prepared");
        let times = &mut self.work.times;
        let started = Instant::now();
        if !system.analysed {
            system.analysis = solver.analyse(system.matrix.structure())?;
            system.analysed = true;
        }
        let analysed = Instant::now();
        times.analysis += analysed - started;
        let report = solver.factor(&system.matrix)?;
        let factored = Instant::now();
        times.factorisation += factored - analysed;
        (self.work.method, self.work.fall_back) = (report.method, report.fall_back);
        let rhs: Vec<f64> = residual.iter().map(|r| -r).collect();
        let mut correction = vec![0.0; rhs.len()];
        let solved = solver.solve(&system.matrix, &rhs, &mut correction)?;
        if solved.interior == Interior::Fresh {
            self.work.factorisations += 1;
        }
        self.work.times.solution += factored.elapsed();
        Ok(correction)
    }
}
