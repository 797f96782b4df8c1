//! An increment in progress: corrections until the residual is small.

mod ending;

pub use ending::Acceptance;

use striae_contact::{
    complementarity::Iteration, interference::Interference, segment::Derivatives,
    selection::Selection, table_1::Inflation,
};

use super::{
    IterationObserver,
    chord::{Chord, share_to_go, wanted},
    correction::{Taken, labelled, step},
    course::Course,
    cycling::History,
    departure::first_positions,
    failure::{linear_system, missed},
    flight::flown,
    passage::{overlap, passage},
    release::{closed, released},
    rest::contact_at_rest,
    rule::{Ladder, is_final, later, part},
    selected::{Origin, Selected, selected},
    workspace::Workspace,
};
use crate::{
    assembly::{Assembled, Imposed, Setting, StepContext, Trial},
    norms::Norms,
    outcome::CutBack,
    skin::BodyOverlap,
    state::State,
};

/// Number of times that an increment is solved again with additional nodes that it turned out to
/// need.
const REPETITIONS: usize = 3;

/// An increment in progress.
pub(super) struct Attempt<'a> {
    context: &'a StepContext<'a>,
    state: &'a State,
    imposed: &'a Imposed,
    /// Traction fields of all pairs.
    pub(super) selections: Vec<Selection>,
    /// Origin of these fields.
    pub(super) origin: Origin,
    /// The latest state.
    pub(super) trial: Trial,
    /// Norms of iterations from where the increment before leads to, if they failed.
    pub(super) given_up: Vec<Norms>,
    /// Norms of all iterations since.
    pub(super) iterations: Vec<Norms>,
    history: History,
    inflation: Inflation,
    /// Iterations of the present problem.
    ladder: Ladder,
    /// Interferences, by pair; empty before the end.
    pub(super) interferences: Vec<Vec<Interference>>,
    /// Overlaps of bodies that no pair detects.
    pub(super) overlaps: Vec<BodyOverlap>,
    /// Criterion by which the latest state is accepted, at the end.
    pub(super) acceptance: Acceptance,
    /// Pairs that are closed in the latest state.
    closed: Vec<bool>,
    /// Rules of the first iteration.
    first: Iteration,
    /// The tangent there is.
    chord: Chord,
}

impl<'a> Attempt<'a> {
    /// The increment from `state` to what is imposed, at the fraction `s` of the step.
    pub(super) fn new(
        context: &'a StepContext<'a>,
        state: &'a State,
        imposed: &'a Imposed,
        s: f64,
        workspace: &mut Workspace,
    ) -> Self {
        let Selected {
            selections,
            tractions,
        } = selected(context, state, s, imposed);
        workspace.prepare(context.problem, &selections);
        // Work of an attempt that failed is not that of this one.
        workspace.take_work();
        let rigid = workspace.first_poses(imposed);
        let trial = Trial {
            positions: first_positions(context, state, imposed, &rigid, &selections),
            tractions,
            rigid,
            pressures: state.pressures.clone(),
        };
        Self {
            context,
            state,
            imposed,
            selections,
            origin: Origin::default(),
            trial,
            given_up: Vec::new(),
            iterations: Vec::new(),
            history: History::default(),
            inflation: Inflation::default(),
            ladder: Ladder::default(),
            interferences: Vec::new(),
            overlaps: Vec::new(),
            acceptance: Acceptance::default(),
            // Until contact has been evaluated nothing is known to have opened.
            closed: vec![true; context.pairs.len()],
            first: Iteration::First,
            chord: Chord::default(),
        }
    }

    /// The increment from the beginning, without what the one before leads to.
    pub(super) fn anew(self, s: f64, workspace: &mut Workspace) -> Self {
        Self {
            given_up: [self.given_up, self.iterations].concat(),
            ..Self::new(self.context, self.state, self.imposed, s, workspace)
        }
    }

    /// Returns whether the attempt started from the extrapolation of the previous increment.
    pub(super) fn follows(&self) -> bool {
        self.first != Iteration::First
    }

    /// Starts where the increment before leads to at a time, unless bodies leave each other;
    /// collective.
    pub(super) fn follow(&mut self, course: &Course, time: f64) {
        let leave = self.trial.positions != self.state.positions;
        // Bodies that separate start from moved positions; extrapolating as well would move them
        // twice. All ranks have to decide alike.
        if !self.context.problem.share.any(leave) {
            course.follow(self.context, self.state, time, &mut self.trial);
            self.first = Iteration::LATER;
        }
    }
}

impl Attempt<'_> {
    /// Iterates until nothing is missed, or says why there is no end.
    pub(super) fn solved(
        &mut self,
        workspace: &mut Workspace,
        observer: &mut dyn IterationObserver,
    ) -> Result<Assembled, CutBack> {
        let found = self.complete(workspace, observer);
        found.map_err(|reason| {
            let released = released(self.context, self.state, &self.closed, &reason);
            released.unwrap_or(reason)
        })
    }

    /// Iterates, again where nodes turn out to be needed, until nothing is missed.
    fn complete(
        &mut self,
        workspace: &mut Workspace,
        observer: &mut dyn IterationObserver,
    ) -> Result<Assembled, CutBack> {
        let mut assembled = self.assembled(workspace, self.first)?;
        for repetition in 0.. {
            assembled = self.converge(assembled, workspace, observer)?;
            flown(&self.setting(), &self.trial).map_or(Ok(()), Err)?;
            let Some(found) = self.others(&assembled, true) else {
                break;
            };
            // Selections could alternate for ever between two sets of nodes.
            if repetition == REPETITIONS {
                match missed(&self.setting(), &self.trial) {
                    Some(reason) => return Err(reason),
                    None => break,
                }
            }
            assembled = self.taken_up(found, workspace)?;
        }
        // Only at the end: trial states on the way may pass through each other without harm.
        self.interferences = passage(&self.setting(), &self.trial, &assembled.contacts)?;
        self.overlaps = overlap(&self.setting(), &self.trial)?;
        Ok(assembled)
    }

    fn setting(&self) -> Setting<'_> {
        Setting {
            context: self.context,
            state: self.state,
            selections: &self.selections,
            imposed: self.imposed,
        }
    }

    /// Iterates until the residual is small.
    fn converge(
        &mut self,
        mut assembled: Assembled,
        workspace: &mut Workspace,
        observer: &mut dyn IterationObserver,
    ) -> Result<Assembled, CutBack> {
        let solver = &self.context.problem.model.solver;
        let mut further = solver.further_iterations;
        loop {
            self.closed = closed(&assembled.contacts);
            let before = self.iterations.last().map(Norms::largest);
            let number = self.iterations.len() + 1;
            let iteration = self.next_iteration();
            if !self.has_tangent(&assembled) {
                assembled = self.assembled(workspace, iteration)?;
            }
            let (next, taken) = self.iterate(&assembled, before, iteration, workspace)?;
            assembled = next;
            // Statuses are known with derivatives only, without which a state is not the last.
            if assembled.norms.largest() <= solver.tolerance && !self.is_sure(&assembled) {
                assembled = self.assembled(workspace, iteration)?;
            }
            if let Some(selected) = self.refreshed(number, &assembled) {
                assembled = self.taken_up(selected, workspace)?;
            }
            let norms = assembled.norms;
            self.iterations.push(norms);
            self.history.push(&assembled.contacts);
            observer.iteration(number, &norms, &assembled.contacts);
            // A part of a correction leaves prescribed displacements on their way.
            let settled = taken == Taken::Whole
                && is_final(iteration)
                && self.is_sure(&assembled)
                && self.obeys_laws(&assembled);
            if norms.largest() <= solver.tolerance && settled {
                if further == 0 {
                    self.acceptance = Acceptance::Converged;
                    return Ok(assembled);
                }
                // Further iterations are requested where solvers are compared beyond the tolerance.
                further -= 1;
            }
            if settled && self.jumps() {
                let residual = norms.largest();
                self.acceptance = Acceptance::AtJump { residual };
                return Ok(assembled);
            }
            self.inflation = self.inflation.after(norms.gap);
            self.closed = closed(&assembled.contacts);
            self.judge(number, &norms)?;
        }
    }

    /// One correction.
    fn iterate(
        &mut self,
        assembled: &Assembled,
        before: Option<f64>,
        iteration: Iteration,
        workspace: &mut Workspace,
    ) -> Result<(Assembled, Taken), CutBack> {
        let context = self.context;
        let tolerance = context.problem.model.solver.tolerance;
        let (residual, part) = (&assembled.residual, part(self.norm(assembled), tolerance));
        self.chord.corrects(assembled);
        let correction = match assembled.derivatives {
            Derivatives::First => workspace.correction(residual, part),
            // The matrix still holds an older tangent, and its factors serve.
            Derivatives::None => workspace.chord_correction(residual, part),
        };
        let correction = correction
            .map_err(|error| linear_system(context.problem, workspace.system().numbers(), error))?;
        let derivatives = self.wanted(assembled, iteration);
        let at_rest = match iteration {
            // Late corrections are cheap already, and the first iteration of a step linearises
            // closed contact.
            Iteration::Later(_) if derivatives == Derivatives::First => {
                let at = (&self.trial, assembled);
                contact_at_rest(workspace, &self.setting(), at, &correction, before)?
            }
            Iteration::First | Iteration::Later(_) | Iteration::Corrected(_) | Iteration::Given => {
                None
            }
        };
        if let Some((trial, assembled)) = at_rest {
            self.trial = trial;
            return Ok((assembled, Taken::Whole));
        }
        labelled(&mut self.trial, &assembled.contacts);
        let (trial, assembled, taken) = step(
            workspace,
            &self.setting(),
            &self.trial,
            (iteration, derivatives),
            &correction,
        )?;
        self.trial = trial;
        Ok((assembled, taken))
    }

    /// The latest state with derivatives.
    fn assembled(
        &self,
        workspace: &mut Workspace,
        iteration: Iteration,
    ) -> Result<Assembled, CutBack> {
        let setting = self.setting();
        workspace.assemble(&setting, &self.trial, iteration, Derivatives::First)
    }

    /// Returns whether the matrix can be used for a correction from the latest state.
    fn has_tangent(&self, assembled: &Assembled) -> bool {
        let tolerance = self.context.problem.model.solver.tolerance;
        assembled.derivatives == Derivatives::First || self.chord.serves(assembled, tolerance)
    }

    /// Returns whether the rows come from an evaluation with derivatives; only these change the
    /// status of nodes.
    fn is_sure(&self, assembled: &Assembled) -> bool {
        assembled.derivatives == Derivatives::First || self.chord.holds(assembled)
    }

    /// Derivatives needed of the state that a correction from the latest one leads to.
    fn wanted(&self, assembled: &Assembled, iteration: Iteration) -> Derivatives {
        let solver = &self.context.problem.model.solver;
        let is_plain = matches!(iteration, Iteration::Later(_));
        if !is_plain || solver.further_iterations > 0 {
            return Derivatives::First;
        }
        wanted(self.norm(assembled).unwrap_or(f64::INFINITY))
    }

    /// Norm of the latest state, with what prescribed positions have still to go; `None` where
    /// the increment does not start from where the one before leads.
    fn norm(&self, assembled: &Assembled) -> Option<f64> {
        let norm = assembled.norms.largest();
        match (self.iterations.is_empty(), self.follows()) {
            (true, true) => {
                let to_go = share_to_go(self.context, &self.trial, self.state, self.imposed);
                // After an extrapolated start the residual can be small although prescribed nodes
                // still have to move.
                Some(norm.max(to_go))
            }
            (true, false) => None,
            (false, _) => Some(norm),
        }
    }

    /// The traction field with what the first iteration shows to come into contact.
    fn refreshed(&mut self, number: usize, assembled: &Assembled) -> Option<Selected> {
        if number > 1 {
            return None;
        }
        self.others(assembled, false)
    }

    /// The fields that the latest state asks for, unless they are those it has.
    fn others(&mut self, assembled: &Assembled, is_converged: bool) -> Option<Selected> {
        let setting = Setting {
            context: self.context,
            state: self.state,
            selections: &self.selections,
            imposed: self.imposed,
        };
        let contacts = &assembled.contacts;
        self.origin
            .others(&setting, &self.trial, contacts, is_converged)
    }

    /// Goes on with another traction field.
    fn taken_up(
        &mut self,
        selected: Selected,
        workspace: &mut Workspace,
    ) -> Result<Assembled, CutBack> {
        let before = std::mem::replace(&mut self.selections, selected.selections);
        self.origin.replaced(before);
        self.trial.tractions = selected.tractions;
        workspace.extend(self.context.problem, &self.selections);
        // New unknowns are a new problem: its iterations deserve the usual weights first.
        self.ladder.restart(self.iterations.len());
        self.assembled(workspace, self.next_iteration())
    }

    /// Rules of the next iteration, unless it is the first one.
    fn next_iteration(&self) -> Iteration {
        let strategy = self.context.problem.model.solver.strategy;
        let number = self.ladder.next(self.iterations.len());
        later(strategy, self.inflation, number)
    }
}
