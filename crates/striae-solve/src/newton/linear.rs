//! Solver of the linear systems: a user-defined one, or one of all ranks together.

use striae_condensed::{
    Analysis, Automatic, Choice, Experience, Factored, FactoredInterior, Numbering, Partition,
    SharedSolver, Tangent,
};
use striae_sparse::{SolveError, SolveReport};

use striae_model::Backend;

/// The solver that a backend is, which chooses among others.
pub(super) fn automatic(backend: Backend) -> Automatic {
    Automatic::new(match backend {
        Backend::Condensed => Choice::ByCost,
        Backend::Iterative => Choice::Iterative,
        Backend::Multifrontal | Backend::Mumps => Choice::Multifrontal,
        Backend::Faer => Choice::Faer,
    })
}

/// The solver.
pub(super) enum Linear {
    /// Of a rank that is alone.
    Alone(Box<Automatic>),
    /// Of ranks with a part of the system each. All of its functions are collective.
    Shared(Box<dyn SharedSolver>),
}

impl Linear {
    /// Creates a solver of this process.
    pub(super) fn new(backend: Backend) -> Self {
        Self::Alone(Box::new(automatic(backend)))
    }

    /// Gives what has failed another try.
    pub(super) fn start_afresh(&mut self) {
        if let Self::Alone(solver) = self {
            solver.start_afresh();
        }
    }

    /// Takes up a pattern; `numbering` is that of a shared system.
    pub(super) fn analyse(
        &mut self,
        partition: &Partition,
        numbering: Option<&Numbering>,
    ) -> Result<Analysis, SolveError> {
        match self {
            Self::Alone(solver) => solver.analyse(partition),
            Self::Shared(solver) => {
                let numbering = numbering.expect("unknowns of shared systems are numbered");
                solver.analyse(partition, numbering)
            }
        }
    }

    /// Factors a tangent, on a thread of the pool, as all linear algebra of this process does: it
    /// need not be woken then.
    pub(super) fn factor(&mut self, tangent: &Tangent) -> Result<Factored, SolveError> {
        match self {
            Self::Alone(solver) => rayon::scope(|_| solver.factor(tangent)),
            Self::Shared(solver) => solver.factor(tangent),
        }
    }

    /// The solution of `tangent correction = -residual` with a factored tangent.
    pub(super) fn solved(
        &mut self,
        tangent: &Tangent,
        residual: &[f64],
        part: f64,
    ) -> Result<(Vec<f64>, SolveReport), SolveError> {
        let rhs: Vec<f64> = residual.iter().map(|r| -r).collect();
        let mut correction = vec![0.0; rhs.len()];
        let report = match self {
            Self::Alone(solver) => {
                rayon::scope(|_| solver.solve_to(tangent, &rhs, &mut correction, part))
            }
            Self::Shared(solver) => solver.solve(tangent, &rhs, &mut correction, part),
        };
        Ok((correction, report?))
    }

    /// The solution for a tangent close to the one that was factored, up to a part of the residual,
    /// without a change for later ones; `None` where the factors do not serve.
    pub(super) fn solved_beside(
        &self,
        tangent: &Tangent,
        residual: &[f64],
        part: f64,
    ) -> Result<Option<Vec<f64>>, SolveError> {
        let Self::Alone(solver) = self else {
            return Ok(None);
        };
        let rhs: Vec<f64> = residual.iter().map(|r| -r).collect();
        let mut correction = vec![0.0; rhs.len()];
        let solved = rayon::scope(|_| solver.solve_beside(tangent, &rhs, &mut correction, part))?;
        Ok(solved.map(|_| correction))
    }

    /// The solution with another contact on older factors of the bodies; `None` where there are
    /// none.
    pub(super) fn solved_with_other_contact(
        &mut self,
        tangent: &Tangent,
        residual: &[f64],
    ) -> Option<Vec<f64>> {
        let Self::Alone(solver) = self else {
            return None;
        };
        let rhs: Vec<f64> = residual.iter().map(|r| -r).collect();
        let correction = rayon::scope(|_| solver.solve_other_contact(tangent, &rhs));
        correction.ok().flatten()
    }

    /// Forgets factors.
    pub(super) fn forget(&mut self) {
        match self {
            Self::Alone(solver) => solver.forget(),
            Self::Shared(solver) => solver.forget(),
        }
    }

    /// Returns whether there are factors of the bodies with which contact alone can be corrected.
    pub(super) fn has_interior(&self) -> bool {
        matches!(self, Self::Alone(solver) if solver.has_interior())
    }

    /// Experience from earlier matrices, and the interior that the older factors were made of.
    pub(super) fn experience(&self) -> (Experience, Option<FactoredInterior>) {
        match self {
            Self::Alone(solver) => (solver.experience().clone(), solver.factored_interior()),
            Self::Shared(_) => (Experience::default(), None),
        }
    }

    /// Takes up what a solver has learnt from systems of the same pattern.
    pub(super) fn recall(&mut self, experience: &Experience, interior: Option<&FactoredInterior>) {
        if let Self::Alone(solver) = self {
            solver.recall(experience, interior);
        }
    }
}
