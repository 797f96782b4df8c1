//! Nodes that a converged increment leaves too deep, see [`striae_contact::lift`].

use striae_contact::{
    interference::Interference,
    lift::{Remedy, remedy},
    pointed::Pierced,
};

use super::{Attempt, IterationObserver, flown, later, missed, passage, reselected};
use crate::{assembly::Assembled, newton::workspace::Workspace, outcome::CutBack};

/// How often rows are lifted in an increment.
const REPETITIONS: usize = 3;

/// Iterations that each time may take.
const ITERATIONS: usize = 12;

impl Attempt<'_> {
    /// Solves again with rows lifted where nodes are too deep. What does not come to an end is
    /// left as it was, and the depth is warned of.
    pub(super) fn lifted(
        &mut self,
        mut assembled: Assembled,
        workspace: &mut Workspace,
        observer: &mut dyn IterationObserver,
    ) -> Assembled {
        for _ in 0..REPETITIONS {
            let remedies = self.remedies(&assembled);
            if remedies.iter().all(Option::is_none) {
                break;
            }
            let iterations = self.iterations.len();
            let before = (self.selections.clone(), self.trial.clone());
            self.lift(remedies, &assembled, workspace);
            self.limit = self.limit.min(iterations + ITERATIONS);
            let found = self.converged_again(workspace, observer);
            self.limit = self.context.problem.model.solver.largest_iterations;
            let Ok((next, interferences)) = found else {
                (self.selections, self.trial) = before;
                self.given_up.extend(self.iterations.drain(iterations..));
                break;
            };
            assembled = next;
            self.interferences = interferences;
        }
        assembled
    }

    /// What holds nodes that are too deep, by pair.
    fn remedies(&self, assembled: &Assembled) -> Vec<Option<Remedy>> {
        let pairs = self.selections.iter().zip(&assembled.contacts).enumerate();
        pairs
            .map(|(pair, (selection, contact))| {
                let (positions, rigid) = (&self.trial.positions, &self.trial.rigid);
                let latest = self.context.configuration(pair, positions, rigid);
                remedy(&latest, selection, &contact.nodes)
            })
            .collect()
    }

    fn lift(
        &mut self,
        remedies: Vec<Option<Remedy>>,
        assembled: &Assembled,
        workspace: &mut Workspace,
    ) {
        let required = remedies.iter().map(|remedy| Pierced {
            unfelt: remedy.iter().flat_map(|r| r.required.clone()).collect(),
            ..Pierced::default()
        });
        let required: Vec<Pierced> = required.collect();
        if !required.iter().all(Pierced::is_empty) {
            let contacts = &assembled.contacts;
            let found = reselected(&self.setting(), &self.trial, contacts, &required);
            self.selections = found.selections;
            self.trial.tractions = found.tractions;
            workspace.extend(self.context.problem, &self.selections);
        }
        for (selection, remedy) in self.selections.iter_mut().zip(remedies) {
            if let Some(remedy) = remedy {
                selection.lifts = remedy.lifts;
            }
        }
    }

    /// Iterates with other rows; what misses contact then has failed.
    fn converged_again(
        &mut self,
        workspace: &mut Workspace,
        observer: &mut dyn IterationObserver,
    ) -> Result<(Assembled, Vec<Vec<Interference>>), CutBack> {
        let strategy = self.context.problem.model.solver.strategy;
        let iteration = later(strategy, self.inflation, self.iterations.len() + 1);
        let assembled = self.assembled(workspace, iteration)?;
        let assembled = self.converge(assembled, workspace, observer)?;
        flown(&self.setting(), &self.trial).map_or(Ok(()), Err)?;
        missed(&self.setting(), &self.trial).map_or(Ok(()), Err)?;
        let interferences = passage(&self.setting(), &self.trial, &assembled.contacts)?;
        Ok((assembled, interferences))
    }
}
