//! The default solver: condensed where that works and pays, multifrontal LU otherwise.
//!
//! What it falls back on is decided by counts and signs alone, so the same
//! matrices are always solved in the same way: when the interface is so large
//! that its dense algebra costs more than the LU, when the interior is not
//! positive definite, when the contact system is singular (the LU then names
//! the unknown), or when refinement does not reach an accurate answer.

use crate::{
    condensed::Condensed,
    error::SolveError,
    matrix::SparseMatrix,
    multifrontal::MultifrontalLu,
    solver::{Analysis, FactorReport, FallBack, LinearSolver, Method, SolveReport},
    structure::Structure,
};

/// Bulk unknowns of the interface up to which dense algebra is taken without comparing costs.
const SMALL_INTERFACE: usize = 3000;
/// Largest dense matrix, in bytes.
const LARGEST_DENSE: usize = 6 << 30;
/// Factorisations by LU after a failure before the condensed solver is tried again.
const PATIENCE: usize = 8;

/// Chooses between the condensed solver and the multifrontal LU.
#[derive(Debug, Default)]
pub struct Automatic {
    structure: Option<Structure>,
    condensed: Option<Condensed>,
    multifrontal: Option<MultifrontalLu>,
    fall_back: Option<FallBack>,
    patience: usize,
    factored: Option<Method>,
}

impl Automatic {
    /// A solver that has seen no matrix yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Factors with the LU, which is analysed when first needed.
    fn factor_multifrontal(&mut self, matrix: &SparseMatrix) -> Result<FactorReport, SolveError> {
        let structure = self.structure.as_ref().ok_or(SolveError::NotAnalysed)?;
        if self.multifrontal.is_none() {
            let mut solver = MultifrontalLu::new();
            solver.analyse(structure)?;
            self.multifrontal = Some(solver);
        }
        let solver = self.multifrontal.as_mut().ok_or(SolveError::NotAnalysed)?;
        let report = solver.factor(matrix)?;
        self.factored = Some(Method::Multifrontal);
        Ok(FactorReport {
            fall_back: self.fall_back,
            ..report
        })
    }

    fn fall_back(
        &mut self,
        reason: FallBack,
        matrix: &SparseMatrix,
    ) -> Result<FactorReport, SolveError> {
        (self.fall_back, self.patience) = (Some(reason), PATIENCE);
        self.factor_multifrontal(matrix)
    }
}

impl LinearSolver for Automatic {
    fn analyse(&mut self, structure: &Structure) -> Result<Analysis, SolveError> {
        *self = Self::default();
        self.structure = Some(structure.clone());
        let condensed = Condensed::analyse(structure)?;
        let analysis = condensed.analysis();
        let order = condensed.interface();
        if order > SMALL_INTERFACE {
            let mut solver = MultifrontalLu::new();
            let other = solver.analyse(structure)?;
            if size_of::<f64>() * order * order > LARGEST_DENSE || analysis.flops > other.flops {
                self.multifrontal = Some(solver);
                self.fall_back = Some(FallBack::LargeInterface { unknowns: order });
                return Ok(other);
            }
        }
        self.condensed = Some(condensed);
        Ok(analysis)
    }

    fn factor(&mut self, matrix: &SparseMatrix) -> Result<FactorReport, SolveError> {
        self.factored = None;
        let Some(condensed) = self.condensed.as_mut().filter(|_| self.patience == 0) else {
            self.patience = self.patience.saturating_sub(1);
            return self.factor_multifrontal(matrix);
        };
        match condensed.factor(matrix) {
            Ok(report) => {
                (self.fall_back, self.factored) = (None, Some(Method::Condensed));
                // The LU would only hold memory now.
                self.multifrontal = None;
                Ok(report)
            }
            Err(SolveError::NotPositiveDefinite { unknown, .. }) => {
                self.fall_back(FallBack::IndefiniteInterior { unknown }, matrix)
            }
            Err(SolveError::Singular { .. }) => self.fall_back(FallBack::SingularContact, matrix),
            Err(other) => Err(other),
        }
    }

    fn solve(
        &mut self,
        matrix: &SparseMatrix,
        rhs: &[f64],
        x: &mut [f64],
    ) -> Result<SolveReport, SolveError> {
        if self.factored == Some(Method::Condensed) {
            let condensed = self.condensed.as_ref().ok_or(SolveError::NotFactored)?;
            match condensed.solve(matrix, rhs, x) {
                Err(SolveError::Inaccurate { backward_error }) => {
                    self.fall_back(FallBack::Inaccurate { backward_error }, matrix)?;
                }
                other => return other,
            }
        }
        match (self.multifrontal.as_mut(), self.factored) {
            (Some(solver), Some(_)) => solver.solve(matrix, rhs, x),
            _ => Err(SolveError::NotFactored),
        }
    }
}
