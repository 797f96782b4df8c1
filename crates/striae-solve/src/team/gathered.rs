//! A solver of shared systems that gathers them.

use std::sync::Arc;

use striae_condensed::{Analysis, Factored, Method, Numbering, Partition, Tangent, TangentSolver};
use striae_sparse::{
    LinearSolver, MultifrontalLu, SolveError, SolveReport, SparseMatrix, Structure,
};

use super::Team;

/// Every rank gathers the whole system and solves it by LU: no rank needs a library for that, and
/// other solvers can be compared with it. It takes the time and memory of the whole system on every
/// rank.
#[derive(Debug)]
pub struct Gathered {
    team: Arc<dyn Team>,
    numbering: Option<Numbering>,
    solver: MultifrontalLu,
    matrix: Option<SparseMatrix>,
}

/// An entry of a matrix: row, column and value.
type Entry = (usize, usize, f64);

impl Gathered {
    /// A solver that has seen no matrix yet.
    pub fn new(team: Arc<dyn Team>) -> Self {
        Self {
            team,
            numbering: None,
            solver: MultifrontalLu::new(),
            matrix: None,
        }
    }

    /// Entries of all ranks.
    fn entries(&self, part: &Tangent, whole: &[usize]) -> Vec<Entry> {
        let mut bytes = Vec::new();
        for (row, &whole_row) in whole.iter().enumerate() {
            for (column, value) in part.row(row).filter(|entry| entry.1 != 0.0) {
                let entry = [whole_row as u64, whole[column] as u64, value.to_bits()];
                bytes.extend(entry.map(u64::to_le_bytes).concat());
            }
        }
        let all = self.team.gather(&bytes).into_iter();
        let mut entries = Vec::new();
        for numbers in all.map(|bytes| numbers(&bytes)) {
            let of_rank = numbers.chunks_exact(3);
            entries.extend(of_rank.map(|entry| {
                let [row, column] = [0, 1].map(|at| entry[at] as usize);
                (row, column, f64::from_bits(entry[2]))
            }));
        }
        entries
    }
}

impl TangentSolver for Gathered {
    fn analyse(&mut self, partition: &Partition) -> Result<Analysis, SolveError> {
        self.numbering = partition.numbering().cloned();
        self.matrix = None;
        Ok(Analysis {
            method: Method::Multifrontal,
            ..Analysis::default()
        })
    }

    fn factor(&mut self, part: &Tangent) -> Result<Factored, SolveError> {
        let numbering = self.numbering.as_ref().ok_or(SolveError::NotAnalysed)?;
        let matrix = sum(numbering.count, &self.entries(part, &numbering.whole));
        self.solver.analyse(matrix.structure())?;
        let report = self.solver.factor(&matrix)?;
        self.matrix = Some(matrix);
        Ok(Factored {
            factor_entries: report.factor_entries,
            method: Method::Multifrontal,
            ..Factored::default()
        })
    }

    fn solve_to(
        &mut self,
        _: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
        _: f64,
    ) -> Result<SolveReport, SolveError> {
        let numbering = self.numbering.as_ref().ok_or(SolveError::NotAnalysed)?;
        let matrix = self.matrix.as_ref().ok_or(SolveError::NotFactored)?;
        let mut own = vec![0.0; numbering.own.len()];
        for (&whole, value) in numbering.whole.iter().zip(rhs) {
            if numbering.own.contains(&whole) {
                own[whole - numbering.own.start] = *value;
            }
        }
        let bytes: Vec<u8> = own.iter().flat_map(|v| v.to_bits().to_le_bytes()).collect();
        let all = self.team.gather(&bytes).into_iter();
        let whole_rhs = all.flat_map(|bytes| numbers(&bytes)).map(f64::from_bits);
        let whole_rhs: Vec<f64> = whole_rhs.collect();
        let mut solution = vec![0.0; whole_rhs.len()];
        let report = self.solver.solve(matrix, &whole_rhs, &mut solution)?;
        for (x, &whole) in x.iter_mut().zip(&numbering.whole) {
            *x = solution[whole];
        }
        Ok(report)
    }

    fn forget(&mut self) {
        (self.solver, self.matrix) = (MultifrontalLu::new(), None);
    }
}

fn numbers(bytes: &[u8]) -> Vec<u64> {
    let number = |bytes: &[u8; 8]| u64::from_le_bytes(*bytes);
    bytes.as_chunks().0.iter().map(number).collect()
}

/// The sum of entries, added in their order.
fn sum(count: usize, entries: &[Entry]) -> SparseMatrix {
    let mut neighbours: Vec<Vec<u32>> = (0..count as u32).map(|row| vec![row]).collect();
    for &(row, column, _) in entries {
        neighbours[row].push(column as u32);
        neighbours[column].push(row as u32);
    }
    let mut starts = vec![0];
    for of_row in &mut neighbours {
        of_row.sort_unstable();
        of_row.dedup();
        starts.push(starts[starts.len() - 1] + of_row.len());
    }
    let offsets = (0..=count).collect();
    let structure = Structure::from_adjacency(offsets, starts, neighbours.concat());
    let mut matrix = SparseMatrix::zero(&structure);
    for &(row, column, value) in entries {
        let added = matrix.add(&[row], &[column], &[value]);
        added.expect("the pattern is that of the entries");
    }
    matrix
}
