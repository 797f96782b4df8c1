//! The linear system of an increment, kept for the next ones.

mod memory;
mod pattern;

pub use memory::Memory;

use std::time::Instant;

use striae_condensed::{Analysis, Growth, Numbering, Partition, Tangent, TangentSolver};
use striae_contact::{complementarity::Iteration, segment::Derivatives, selection::Selection};
use striae_sparse::{Age, SolveError, Structure};

use striae_mesh::Vec3;

use pattern::Pattern;

use super::{
    course::Course,
    linear::{automatic, solved, solved_beside, solved_with_other_contact},
    work::LinearWork,
};
use crate::{
    assembly::{
        Assembled, Background, Contact, ContactAssembled, ElementPlaces, Imposed, Setting,
        StepContext, Trial, assemble, assemble_contact, initial_accelerations,
    },
    layout::{Extent, Layout},
    outcome::CutBack,
    problem::Problem,
    rigid::Pose,
    state::{NodalForces, State},
};
use striae_model::Backend;

/// Part of the residual that is as good as nothing.
const EXACT: f64 = 1e-12;

/// Data that are kept between increments to save work; no results are among them.
pub struct Workspace {
    pub(super) solver: Box<dyn TangentSolver>,
    system: Option<SystemStorage>,
    work: LinearWork,
    /// Start of the last increment.
    pub(super) course: Option<Course>,
}

pub(super) struct SystemStorage {
    pub(super) layout: Layout,
    pub(super) partition: Partition,
    places: ElementPlaces,
    pub(super) tangent: Tangent,
    pub(super) analysis: Analysis,
    /// By what the pattern has grown beyond the elements.
    growth: Growth,
    analysed: bool,
}

impl Workspace {
    /// An empty workspace with the given factorisation.
    pub fn new(backend: Backend) -> Self {
        Self::with(Box::new(automatic(backend)))
    }

    /// An empty workspace with a solver. Where that is one of several ranks, what is done with the
    /// workspace is collective.
    pub fn with(solver: Box<dyn TangentSolver>) -> Self {
        Self {
            solver,
            system: None,
            work: LinearWork::default(),
            course: None,
        }
    }

    /// Makes sure the layout covers all roles of the increment. Solvers that failed in
    /// increments before have another try.
    pub(super) fn prepare(&mut self, problem: &Problem, selections: &[Selection]) {
        self.solver.start_afresh();
        self.extend(problem, selections);
    }

    /// Makes sure the layout covers all kept nodes.
    pub(super) fn extend(&mut self, problem: &Problem, selections: &[Selection]) {
        let known = self.extent();
        let extent = known.cloned().unwrap_or_default().with(selections);
        if known != Some(&extent) {
            self.lay_out(problem, extent);
        }
    }

    /// Makes sure the layout covers that of another workspace of the same problem.
    pub(super) fn extend_to(&mut self, problem: &Problem, other: &Self) {
        let (known, other) = (self.extent(), other.extent());
        let extent = known.cloned().unwrap_or_default();
        let extent = other.iter().fold(extent, |extent, other| extent.or(other));
        if known != Some(&extent) {
            self.lay_out(problem, extent);
        }
    }

    fn extent(&self) -> Option<&Extent> {
        self.system.as_ref().map(|system| system.layout.extent())
    }

    fn lay_out(&mut self, problem: &Problem, extent: Extent) {
        let layout = Layout::new(problem, extent);
        let Pattern { cliques, tied } = Pattern::new(problem, &layout);
        let own = "the layout names its own supervariables";
        let bulk = Structure::from_cliques(layout.offsets().to_vec(), &cliques)
            .and_then(|structure| structure.with_tiers(layout.tiers()))
            .expect(own);
        let partition = Partition::new(&bulk, &layout.bulk())
            .and_then(|partition| partition.with_points(layout.points(problem)))
            .expect(own);
        let partition = partition.tied(&tied).expect(own);
        let partition = partition.numbered(layout.numbering(problem));
        self.system = Some(SystemStorage {
            places: ElementPlaces::new(problem, &layout, partition.structure()),
            tangent: Tangent::zero(partition.structure()),
            partition,
            layout,
            analysis: Analysis::default(),
            growth: Growth::default(),
            analysed: false,
        });
    }

    pub(super) fn system(&mut self) -> &mut SystemStorage {
        self.system.as_mut().expect("the workspace was prepared")
    }

    /// Evaluates a trial state with contact in an iteration; the pattern grows as contact needs it.
    pub(super) fn assemble(
        &mut self,
        setting: &Setting,
        trial: &Trial,
        iteration: Iteration,
        derivatives: Derivatives,
    ) -> Result<Assembled, CutBack> {
        self.assemble_with(Contact::Evaluated(iteration), setting, trial, derivatives)
    }

    /// Assembles the system with contact from the given source.
    pub(super) fn assemble_with(
        &mut self,
        contact: Contact,
        setting: &Setting,
        trial: &Trial,
        derivatives: Derivatives,
    ) -> Result<Assembled, CutBack> {
        let started = Instant::now();
        let Self { system, solver, .. } = self;
        let system = system.as_mut().expect("the workspace was prepared");
        let parts = (&mut system.partition, &system.places, &mut system.tangent);
        let assembled = assemble(setting, trial, contact, derivatives, &system.layout, parts);
        if let Ok(Assembled { growth, .. }) = &assembled
            && !growth.is_empty()
        {
            system.has_grown(growth, solver.as_mut());
        }
        self.work.times.assembly += started.elapsed();
        let of_contact = assembled.as_ref().map(|assembled| assembled.contact_time);
        self.work.times.pairs += of_contact.unwrap_or_default();
        assembled
    }

    /// Returns whether contact can be corrected on linearised bodies.
    pub(super) fn corrects_contact(&self) -> bool {
        let system = self.system.as_ref();
        let is_plain = |layout: &Layout| layout.moves_no_body() && !layout.has_cavities();
        self.solver.has_interior() && system.is_some_and(|system| is_plain(&system.layout))
    }

    /// Evaluates contact on linearised bodies, see [`assemble_contact`].
    pub(super) fn assemble_contact(
        &mut self,
        setting: &Setting,
        background: &Background,
        moved: (&Trial, &[f64]),
        iteration: Iteration,
    ) -> Result<Option<ContactAssembled>, CutBack> {
        let started = Instant::now();
        let system = self.system.as_mut().expect("the workspace was prepared");
        let (layout, parts) = (&system.layout, (&system.partition, &mut system.tangent));
        let assembled = assemble_contact(setting, background, moved, iteration, layout, parts);
        self.work.times.contact += started.elapsed();
        assembled
    }

    /// Correction on linearised bodies; `None` if the solver has no factors for that,
    /// or none that are regular: the next iteration sees to it.
    pub(super) fn contact_correction(&mut self, residual: &[f64]) -> Option<Vec<f64>> {
        let started = Instant::now();
        let system = self.system.as_ref().expect("the workspace was prepared");
        let solver = self.solver.as_mut();
        let correction = solved_with_other_contact(solver, &system.tangent, residual);
        self.work.times.contact += started.elapsed();
        self.work.contact_corrections += usize::from(correction.is_some());
        correction
    }

    /// Poses to start iterating from: at the last converged state where they are
    /// unknowns, else where they are driven to.
    pub(super) fn first_poses(&mut self, imposed: &Imposed) -> Vec<Pose> {
        self.poses_at(imposed, &imposed.before)
    }

    /// Poses of rigid bodies: those given where they are unknowns, else where they are driven to.
    pub(super) fn poses_at(&mut self, imposed: &Imposed, poses: &[Pose]) -> Vec<Pose> {
        let layout = &self.system().layout;
        let bodies = imposed.before.iter().zip(&imposed.rigid).enumerate();
        bodies
            .map(|(rigid, (before, targets))| match layout.rigid(rigid) {
                Some(_) => before.moved_to(&poses[rigid].coordinates()),
                None => {
                    let present = before.coordinates();
                    before.moved_to(&std::array::from_fn(|at| {
                        targets[at].unwrap_or(present[at])
                    }))
                }
            })
            .collect()
    }

    /// Accelerations in `state` and the forces that hold tied nodes, see
    /// [`initial_accelerations`].
    pub(crate) fn accelerations(
        &mut self,
        context: &StepContext,
        state: &State,
        imposed: &Imposed,
        velocities: &[Vec3],
        forces: &NodalForces,
    ) -> Result<(Vec<Vec3>, Vec<Vec3>), CutBack> {
        let trial = Trial {
            positions: state.positions.clone(),
            tractions: Vec::new(),
            rigid: state.rigid.clone(),
            pressures: state.pressures.clone(),
        };
        let Self { solver, system, .. } = self;
        let system = system.as_mut().expect("the workspace was prepared");
        let solver = solver.as_mut();
        system.analyse(solver).map_err(without_mass)?;
        solver.forget();
        let solve = |tangent: &Tangent, residual: &[f64]| {
            solver.factor(tangent).map_err(without_mass)?;
            let solved = solved(solver, tangent, residual, EXACT);
            solver.forget();
            let (solution, _) = solved.map_err(without_mass)?;
            Ok(solution)
        };
        initial_accelerations(
            context,
            &trial,
            imposed,
            velocities,
            forces,
            &system.layout,
            &mut system.tangent,
            solve,
        )
    }

    /// Work done since the last call, which is then reset.
    pub(super) fn take_work(&mut self) -> LinearWork {
        std::mem::take(&mut self.work)
    }

    /// Solves for the correction, `J correction = -residual`, up to a part of the residual.
    pub(super) fn correction(
        &mut self,
        residual: &[f64],
        part: f64,
    ) -> Result<Vec<f64>, SolveError> {
        self.factor()?;
        let (correction, age) = self.solution(residual, part)?;
        self.work.factorisations += usize::from(age == Age::Fresh);
        Ok(correction)
    }

    /// Factors the tangent.
    pub(super) fn factor(&mut self) -> Result<(), SolveError> {
        let solver = self.solver.as_mut();
        let system = self.system.as_mut().expect("the workspace was prepared");
        let times = &mut self.work.times;
        let started = Instant::now();
        system.analyse(solver)?;
        let analysed = Instant::now();
        times.analysis += analysed - started;
        let report = solver.factor(&system.tangent)?;
        times.factorisation += analysed.elapsed();
        (self.work.method, self.work.fall_back) = (report.method, report.fall_back);
        Ok(())
    }

    /// Solves for a correction with the matrix and the factors of the last one.
    pub(super) fn chord_correction(
        &mut self,
        residual: &[f64],
        part: f64,
    ) -> Result<Vec<f64>, SolveError> {
        self.solution(residual, part)
            .map(|(correction, _)| correction)
    }

    /// Solves for a correction with the matrix of this workspace and the factors of another one,
    /// which stay as they are; `None` where they do not serve.
    pub(super) fn correction_beside(
        &self,
        other: &Self,
        residual: &[f64],
        part: f64,
    ) -> Result<Option<Vec<f64>>, SolveError> {
        let system = self.system.as_ref().expect("the workspace was prepared");
        match other.extent() == Some(system.layout.extent()) {
            true => solved_beside(other.solver.as_ref(), &system.tangent, residual, part),
            false => Ok(None),
        }
    }

    fn solution(&mut self, residual: &[f64], part: f64) -> Result<(Vec<f64>, Age), SolveError> {
        let started = Instant::now();
        let system = self.system.as_ref().expect("the workspace was prepared");
        let solver = self.solver.as_mut();
        let (correction, report) = solved(solver, &system.tangent, residual, part)?;
        self.work.krylov_iterations += report.krylov_iterations;
        self.work.times.solution += started.elapsed();
        Ok((correction, report.age))
    }
}

impl SystemStorage {
    /// Unknowns of all ranks.
    pub(super) fn unknowns(&self) -> usize {
        let numbering = self.partition.numbering();
        numbering.map_or(self.layout.unknowns(), |numbering| numbering.count)
    }

    /// Numbers of the unknowns, and those in the system of all ranks.
    pub(super) fn numbers(&self) -> (&Layout, Option<&Numbering>) {
        (&self.layout, self.partition.numbering())
    }

    /// Lets a solver take up the pattern, unless it has.
    fn analyse(&mut self, solver: &mut dyn TangentSolver) -> Result<(), SolveError> {
        if !self.analysed {
            self.analysis = solver.analyse(&self.partition)?;
            self.analysed = true;
        }
        Ok(())
    }

    /// Grows the pattern of contact.
    fn grow(&mut self, growth: &Growth) {
        let grown = self.partition.grown(growth);
        self.partition = grown.expect("cliques name known supervariables");
        self.growth.extend(growth.clone());
        self.analysed = false;
    }

    /// The pattern of contact has grown. A solver prepared for the older one is prepared for the
    /// new one now, so that its kept data do not depend on the time of the next request.
    fn has_grown(&mut self, growth: &Growth, solver: &mut dyn TangentSolver) {
        self.growth.extend(growth.clone());
        if std::mem::take(&mut self.analysed) {
            // What cannot be analysed now fails again, and is reported, with the next matrix.
            let _ = self.analyse(solver);
        }
    }
}

fn without_mass(error: SolveError) -> CutBack {
    CutBack::LinearSystem {
        place: "mass at the start of the step".to_owned(),
        error,
    }
}
