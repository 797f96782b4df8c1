//! Multifrontal LU for unsymmetric values on a symmetric pattern.
//!
//! Nested dissection of the graph of supervariables, an assembly tree of dense
//! fronts, threshold pivoting inside the fronts with delayed pivots (Duff &
//! Reid, doi:10.1137/0905045), equilibration, refinement. A leaf whose own
//! block is singular, such as a part held only by multipliers of another part,
//! is handled by delaying its pivots. Runs on the current rayon pool; the
//! result does not depend on the number of threads.

use crate::{
    equilibration::Equilibration,
    error::SolveError,
    front::{FrontFactor, System},
    matrix::SparseMatrix,
    numeric::Numeric,
    ordering,
    products::LinearOperator,
    refinement,
    singularity::{self, Factors, TransposedFactors},
    solver::{Cost, FactorReport, LinearSolver, SolveReport},
    structure::Structure,
    substitution,
    tree::AssemblyTree,
};

/// Magnitude of the smallest pivot below which the matrix may be singular.
const SUSPICIOUS: f64 = 1e-6;

/// Multifrontal LU with delayed pivots.
#[derive(Debug, Default)]
pub struct MultifrontalLu {
    symbolic: Option<Symbolic>,
    scaling: Equilibration,
    numeric: Numeric<FrontFactor>,
    state: State,
}

#[derive(Debug)]
struct Symbolic {
    structure: Structure,
    tree: AssemblyTree,
}

/// State of the numeric factorisation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    #[default]
    Empty,
    Factored,
}

impl MultifrontalLu {
    /// A solver that has seen no matrix yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// `x := A^-1 x` with the present factors, without refinement; nothing without factors.
    pub fn substitute(&self, x: &mut [f64]) {
        if let Some(symbolic) = &self.symbolic {
            self.scaling.scale_rows(x);
            substitution::solve(&symbolic.tree, &self.numeric, x);
            self.scaling.scale_columns(x);
        }
    }
}

impl LinearSolver for MultifrontalLu {
    fn analyse(&mut self, structure: &Structure) -> Result<Cost, SolveError> {
        *self = Self::default();
        let order = ordering::order(structure, structure.tiers())?;
        let tree = AssemblyTree::new(structure, structure.tiers(), &order, 0);
        let cost = Cost {
            factor_entries: tree.entries(),
            flops: tree.flops(),
            peak_bytes: size_of::<f64>() * (tree.entries() + tree.stack()),
        };
        self.symbolic = Some(Symbolic {
            structure: structure.clone(),
            tree,
        });
        Ok(cost)
    }

    fn factor(&mut self, matrix: &SparseMatrix) -> Result<FactorReport, SolveError> {
        self.state = State::Empty;
        let symbolic = self.symbolic.as_ref().ok_or(SolveError::NotAnalysed)?;
        if !symbolic.structure.same_as(matrix.structure()) {
            return Err(SolveError::NotAnalysed);
        }
        self.scaling = Equilibration::of(matrix)?;
        let system = System {
            tree: &symbolic.tree,
            matrix,
            scaling: &self.scaling,
        };
        self.numeric.factor(&system);
        let fronts = &self.numeric.fronts;
        let report = FactorReport {
            factor_entries: fronts.iter().map(|front| front.entries()).sum(),
            delayed_pivots: fronts.iter().map(|front| front.delayed()).sum(),
            perturbed_pivots: fronts.iter().map(|front| front.replaced).sum(),
        };
        let smallest = fronts
            .iter()
            .map(|front| front.smallest)
            .fold(f64::INFINITY, f64::min);
        if report.perturbed_pivots > 0 || smallest < SUSPICIOUS {
            let factors = Substitution {
                tree: &symbolic.tree,
                numeric: &self.numeric,
            };
            singularity::check_regular(matrix, &self.scaling, &factors)?;
        }
        self.state = State::Factored;
        Ok(report)
    }

    fn solve(
        &mut self,
        matrix: &dyn LinearOperator,
        rhs: &[f64],
        x: &mut [f64],
    ) -> Result<SolveReport, SolveError> {
        match (&self.symbolic, self.state) {
            (Some(symbolic), State::Factored) => {
                let factors = Substitution {
                    tree: &symbolic.tree,
                    numeric: &self.numeric,
                };
                refinement::solve(matrix, &self.scaling, &factors, rhs, x)
            }
            _ => Err(SolveError::NotFactored),
        }
    }
}

struct Substitution<'a> {
    tree: &'a AssemblyTree,
    numeric: &'a Numeric<FrontFactor>,
}

impl Factors for Substitution<'_> {
    fn solve_in_place(&self, x: &mut [f64]) {
        substitution::solve(self.tree, self.numeric, x);
    }
}

impl TransposedFactors for Substitution<'_> {
    fn solve_transposed_in_place(&self, x: &mut [f64]) {
        substitution::solve_transposed(self.tree, self.numeric, x);
    }
}
