//! What a workspace remembers between runs: it is part of a checkpoint.

use serde::{Deserialize, Serialize};
use striae_condensed::{Experience, FactoredInterior, Growth};

use super::Workspace;
use crate::{layout::Extent, newton::course::Course, problem::Problem};

/// What the linear system has grown to, which decides in which order it is eliminated, what
/// its solver has learnt, and where the last increment came from: all bear on the last bits
/// of results.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// What has traction unknowns.
    pub extent: Extent,
    /// By what the pattern has grown beyond the elements.
    pub growth: Growth,
    /// What earlier matrices have taught the solver.
    pub solver: Experience,
    /// What its older factors were made of.
    pub interior: Option<FactoredInterior>,
    /// What the last increment started from.
    pub course: Option<Course>,
}

impl Workspace {
    /// A workspace that has grown to what another had.
    #[must_use]
    pub(crate) fn recalling(mut self, problem: &Problem, memory: &Memory) -> Self {
        self.lay_out(problem, memory.extent.clone());
        if !memory.growth.is_empty() {
            self.system().grow(&memory.growth);
        }
        self.recall(memory);
        self.course.clone_from(&memory.course);
        self
    }

    /// Takes up what a solver has learnt from systems of the same pattern.
    fn recall(&mut self, memory: &Memory) {
        let Self { solver, system, .. } = self;
        let system = system.as_mut().expect("the workspace was laid out");
        // What cannot be analysed now fails again, and is reported, with the first matrix.
        let _ = system.analyse(solver);
        solver.recall(&memory.solver, memory.interior.as_ref());
    }

    /// What it has grown to and its solver has learnt.
    pub fn memory(&self) -> Memory {
        let system = self.system.as_ref();
        system.map_or_else(Memory::default, |system| {
            let (experience, interior) = self.solver.experience();
            // Factors of another pattern are of no use.
            let (solver, interior) = if system.analysed {
                (experience, interior)
            } else {
                (experience.of_other_pattern(), None)
            };
            Memory {
                extent: system.layout.extent().clone(),
                growth: system.growth.clone(),
                solver,
                interior,
                course: self.course.clone(),
            }
        })
    }
}
