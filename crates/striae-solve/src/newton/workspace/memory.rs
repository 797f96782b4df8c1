//! Memory of a workspace between runs, stored in checkpoints.

use serde::{Deserialize, Serialize};
use striae_condensed::{Experience, FactoredInterior, Growth};

use super::Workspace;
use crate::{layout::Extent, newton::course::Course, problem::Problem};

/// Size of the linear system, which decides the order of elimination, experience of its solver, and
/// start of the last increment: all of these affect the last bits of results.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Nodes with traction unknowns.
    pub extent: Extent,
    /// By what the pattern has grown beyond the elements.
    pub growth: Growth,
    /// Experience of the solver from earlier matrices.
    pub solver: Experience,
    /// Interior that the older factors of the solver were made of.
    pub interior: Option<FactoredInterior>,
    /// Start of the last increment.
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
        let _ = system.analyse(solver.as_mut());
        solver.recall(&memory.solver, memory.interior.as_ref());
    }

    /// Size of the linear system and experience of its solver.
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
