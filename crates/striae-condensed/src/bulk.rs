//! Bodies: connected parts of the bulk, each with a matrix of its own.

use crate::partition::Partition;
use striae_sparse::{
    Cost, Equilibration, Precision, SchurCholesky, SolveError, SparseMatrix, Structure,
    Supervariable,
};

/// A connected part of the bulk and the factors of its interior.
#[derive(Debug)]
pub(crate) struct Body {
    /// Matrix that was factored last: the body's part of the scaled matrix, without the entries
    /// between kept unknowns, which are left to the interface.
    own: SparseMatrix,
    /// Global supervariable of each of its own.
    members: Vec<u32>,
    /// Global edge of each edge.
    edges: Vec<u32>,
    /// Global unknown of each unknown.
    pub(crate) unknowns: Vec<u32>,
    pub(crate) schur: SchurCholesky,
}

impl Body {
    /// All bodies of a structure.
    pub(crate) fn all(partition: &Partition) -> Result<Vec<Self>, SolveError> {
        let parts = partition.bodies();
        let mut local = vec![0; partition.supervariables()];
        let body = |members: Vec<u32>| Self::new(partition, members, &mut local);
        parts.into_iter().map(body).collect()
    }

    fn new(
        partition: &Partition,
        members: Vec<u32>,
        local: &mut [u32],
    ) -> Result<Self, SolveError> {
        for (k, &i) in members.iter().enumerate() {
            local[i as usize] = k as u32;
        }
        let (mut offsets, mut starts) = (vec![0], vec![0]);
        let (mut neighbours, mut edges, mut unknowns) = (Vec::new(), Vec::new(), Vec::new());
        for &i in &members {
            unknowns.extend(partition.bulk_group(i as usize).map(|u| u as u32));
            offsets.push(unknowns.len());
            for edge in partition.edges(i as usize) {
                if partition.is_bulk_edge(edge) {
                    neighbours.push(local[partition.target(edge)]);
                    edges.push(edge as u32);
                }
            }
            starts.push(neighbours.len());
        }
        let kept: Vec<Supervariable> = (0..members.len())
            .filter(|&k| partition.is_kept(Supervariable(members[k] as usize)))
            .map(Supervariable)
            .collect();
        let own = Structure::from_adjacency(offsets, starts, neighbours);
        let schur = SchurCholesky::analyse(&own, &kept)?;
        Ok(Self {
            own: SparseMatrix::zero(&own),
            members,
            edges,
            unknowns,
            schur,
        })
    }

    /// Predicted cost of factoring the interior.
    pub(crate) fn cost(&self, precision: Precision) -> Cost {
        let own = self.schur.cost(precision);
        Cost {
            peak_bytes: own.peak_bytes + size_of_val(self.own.values()),
            ..own
        }
    }

    /// Factors the interior of the scaled matrix, without prescribed unknowns.
    pub(crate) fn factor(
        &mut self,
        (full, matrix): (&Partition, &SparseMatrix),
        scaling: &Equilibration,
        prescribed: &[bool],
        precision: Precision,
    ) -> Result<(), SolveError> {
        self.extract((full, matrix), scaling, prescribed);
        self.factor_own(precision)
    }

    /// Values of the matrix that was factored last.
    pub(crate) fn values(&self) -> &[f64] {
        self.own.values()
    }

    /// Factors what another one has factored.
    pub(crate) fn factor_again(
        &mut self,
        values: &[f64],
        precision: Precision,
    ) -> Result<(), SolveError> {
        let (expected, found) = (self.own.values().len(), values.len());
        if expected != found {
            return Err(SolveError::Length { found, expected });
        }
        self.own.values_mut().copy_from_slice(values);
        self.factor_own(precision)
    }

    fn factor_own(&mut self, precision: Precision) -> Result<(), SolveError> {
        let named = |error: SolveError| match error {
            SolveError::NotPositiveDefinite { unknown, pivot } => SolveError::NotPositiveDefinite {
                unknown: self.unknowns[unknown] as usize,
                pivot,
            },
            other => other,
        };
        self.schur.factor(&self.own, precision).map_err(named)
    }

    /// Copies the body's part of the matrix.
    fn extract(
        &mut self,
        (full, matrix): (&Partition, &SparseMatrix),
        scaling: &Equilibration,
        prescribed: &[bool],
    ) {
        let structure = self.own.structure().clone();
        self.own.clear();
        let own = self.own.values_mut();
        let kept = |i: u32| full.is_kept(Supervariable(i as usize));
        for (k, &i) in self.members.iter().enumerate() {
            for edge in structure.edges(k) {
                let j = self.members[structure.target(edge)];
                if kept(i) && kept(j) {
                    continue;
                }
                let from = full.column(self.edges[edge] as usize);
                let columns = full.bulk_group(j as usize);
                for (a, row) in full.bulk_group(i as usize).enumerate() {
                    let source = &matrix.values()[full.row(i as usize, a).start + from..];
                    let target = structure.row(k, a).start + structure.column(edge);
                    for (b, column) in columns.clone().enumerate() {
                        if row == column || !prescribed[row] && !prescribed[column] {
                            let scale = scaling.rows[row] * scaling.columns[column];
                            own[target + b] = scale * source[b];
                        }
                    }
                }
            }
        }
    }
}
