//! Sparse LU of the `faer` crate (supernodal, column ordering COLAMD): an
//! independent check of the other solvers and enough for small problems.

use crate::{
    equilibration::Equilibration,
    error::SolveError,
    matrix::SparseMatrix,
    multifrontal::MultifrontalLu,
    products::LinearOperator,
    refinement,
    singularity::{self, Factors, TransposedFactors},
    solver::{Cost, FactorReport, LinearSolver, SolveReport},
    structure::Structure,
};
use faer::{
    Conj,
    linalg::solvers::SolveCore,
    mat::MatMut,
    sparse::{SparseColMatRef, SymbolicSparseColMat, linalg::solvers},
};

/// faer's sparse LU behind the common interface.
#[derive(Default)]
pub struct FaerLu {
    analysis: Option<Symbolic>,
    factors: Option<Numeric>,
}

struct Symbolic {
    structure: Structure,
    /// Pattern by rows, which is that of the transposed matrix by columns.
    pattern: SymbolicSparseColMat<usize>,
    symbolic: solvers::SymbolicLu<usize>,
}

struct Numeric {
    scaling: Equilibration,
    transposed: solvers::Lu<usize, f64>,
}

impl FaerLu {
    /// A solver that has seen no matrix yet.
    pub fn new() -> Self {
        Self::default()
    }
}

impl LinearSolver for FaerLu {
    fn analyse(&mut self, structure: &Structure) -> Result<Cost, SolveError> {
        self.factors = None;
        self.analysis = None;
        let pattern = pattern(structure);
        let symbolic =
            solvers::SymbolicLu::try_new(pattern.as_ref()).map_err(|_| SolveError::Library {
                library: "faer",
                code: 0,
            })?;
        self.analysis = Some(Symbolic {
            structure: structure.clone(),
            pattern,
            symbolic,
        });
        Ok(Cost::default())
    }

    fn factor(&mut self, matrix: &SparseMatrix) -> Result<FactorReport, SolveError> {
        self.factors = None;
        let analysis = self.analysis.as_ref().ok_or(SolveError::NotAnalysed)?;
        if !analysis.structure.same_as(matrix.structure()) {
            return Err(SolveError::NotAnalysed);
        }
        let scaling = Equilibration::of(matrix)?;
        self.factors = Some(factor_regular(analysis, matrix, scaling)?);
        Ok(FactorReport::default())
    }

    fn solve(
        &mut self,
        matrix: &dyn LinearOperator,
        rhs: &[f64],
        x: &mut [f64],
    ) -> Result<SolveReport, SolveError> {
        let factors = self.factors.as_ref().ok_or(SolveError::NotFactored)?;
        refinement::solve(matrix, &factors.scaling, factors, rhs, x)
    }
}

impl Numeric {
    fn are_finite(&self) -> bool {
        let mut probe = vec![1.0; self.scaling.rows.len()];
        self.solve_in_place(&mut probe);
        probe.iter().all(|x| x.is_finite())
    }
}

impl Factors for Numeric {
    fn solve_in_place(&self, x: &mut [f64]) {
        let rows = x.len();
        let x = MatMut::from_column_major_slice_mut(x, rows, 1);
        self.transposed
            .solve_transpose_in_place_with_conj(Conj::No, x);
    }
}

impl TransposedFactors for Numeric {
    fn solve_transposed_in_place(&self, x: &mut [f64]) {
        let rows = x.len();
        let x = MatMut::from_column_major_slice_mut(x, rows, 1);
        self.transposed.solve_in_place_with_conj(Conj::No, x);
    }
}

/// Factors of a regular matrix, or the error that names the undetermined unknown.
///
/// faer divides by zero pivots and is left without usable factors; the null
/// vector is then found by the multifrontal solver, which replaces them.
fn factor_regular(
    analysis: &Symbolic,
    matrix: &SparseMatrix,
    scaling: Equilibration,
) -> Result<Numeric, SolveError> {
    let mut scaled = matrix.clone();
    scaled.scale(&scaling.rows, &scaling.columns);
    let values = SparseColMatRef::new(analysis.pattern.as_ref(), scaled.values());
    let symbolic = analysis.symbolic.clone();
    if let Ok(transposed) = solvers::Lu::try_new_with_symbolic(symbolic, values) {
        let factors = Numeric {
            scaling,
            transposed,
        };
        if factors.are_finite() {
            singularity::check_regular(matrix, &factors.scaling, &factors)?;
            return Ok(factors);
        }
    }
    let mut other = MultifrontalLu::new();
    other.analyse(matrix.structure())?;
    other.factor(matrix)?;
    Err(SolveError::Library {
        library: "faer",
        code: 0,
    })
}

/// Columns of the transposed matrix.
fn pattern(structure: &Structure) -> SymbolicSparseColMat<usize> {
    let n = structure.unknowns();
    let mut starts = vec![0];
    let mut columns = Vec::with_capacity(structure.entries());
    for i in 0..structure.supervariables() {
        for _ in structure.group(i) {
            columns.extend(structure.row_columns(i));
            starts.push(columns.len());
        }
    }
    SymbolicSparseColMat::new_checked(n, n, starts, None, columns)
}
