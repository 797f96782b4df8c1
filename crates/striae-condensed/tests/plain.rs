//! The automatic choice on matrices that are all bulk: what holds for the solvers it
//! chooses from.

#[path = "../../striae-sparse/tests/solvers/problems.rs"]
mod problems;
#[path = "../../striae-sparse/tests/solvers/refusals.rs"]
mod refusals;

use striae_condensed::{Automatic, Choice, Partition, Tangent, TangentSolver};
use striae_sparse::{
    Cost, FactorReport, LinearOperator, LinearSolver, SolveError, SolveReport, SparseMatrix,
    Structure,
};

/// The automatic choice as a solver of plain matrices.
struct Plain {
    solver: Automatic,
    structure: Option<Structure>,
}

impl Plain {
    /// An operator on the analysed pattern as a tangent: its products with unit vectors are its
    /// columns.
    fn tangent(&self, operator: &dyn LinearOperator) -> Result<Tangent, SolveError> {
        let structure = self.structure.as_ref().ok_or(SolveError::NotAnalysed)?;
        let mut matrix = SparseMatrix::zero(structure);
        let n = operator.unknowns();
        let (mut unit, mut product) = (vec![0.0; n], vec![0.0; n]);
        for column in 0..n {
            unit[column] = 1.0;
            operator.multiply(&unit, &mut product);
            unit[column] = 0.0;
            for (row, &a) in product.iter().enumerate().filter(|(_, a)| **a != 0.0) {
                matrix.add(&[row], &[column], &[a]).unwrap();
            }
        }
        Ok(Tangent::from(matrix))
    }
}

impl LinearSolver for Plain {
    fn analyse(&mut self, structure: &Structure) -> Result<Cost, SolveError> {
        self.structure = Some(structure.clone());
        let analysis = self.solver.analyse(&Partition::from(structure))?;
        Ok(analysis.cost)
    }

    fn factor(&mut self, matrix: &SparseMatrix) -> Result<FactorReport, SolveError> {
        let factored = self.solver.factor(&Tangent::from(matrix.clone()))?;
        Ok(FactorReport {
            factor_entries: factored.factor_entries,
            ..FactorReport::default()
        })
    }

    fn solve(
        &mut self,
        matrix: &dyn LinearOperator,
        rhs: &[f64],
        x: &mut [f64],
    ) -> Result<SolveReport, SolveError> {
        let tangent = self.tangent(matrix)?;
        self.solver.solve(&tangent, rhs, x)
    }
}

fn solvers() -> [(&'static str, Box<dyn LinearSolver>); 1] {
    let plain = Plain {
        solver: Automatic::new(Choice::ByCost),
        structure: None,
    };
    [("automatic", Box::new(plain))]
}
