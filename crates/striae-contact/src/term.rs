//! Local terms: rows of the residual with their derivatives.
//!
//! A kernel evaluates its rows on dual numbers whose lanes are intermediate
//! quantities (positions, normals, nodal tractions). The chain rule through the
//! intermediate quantities to the unknowns is applied here.

use num_dual::{Derivative, DualSVec64};
use striae_mesh::Vec3;

/// Some rows of the residual and their derivatives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LocalTerm {
    /// Pair-local unknowns whose equations the rows belong to.
    pub rows: Vec<u32>,
    /// What the rows state.
    pub fields: Vec<Field>,
    /// Residual of each row.
    pub residual: Vec<f64>,
    /// Pair-local unknowns the rows depend on, ascending.
    pub columns: Vec<u32>,
    /// `d residual / d unknown`, row-major.
    pub tangent: Vec<f64>,
}

/// What a row states, and the scale of its residual where it has one of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Field {
    /// Equilibrium of forces at a node.
    Momentum,
    /// No gap; the scale is the local facet size.
    Gap(f64),
    /// No slip; the scale is the local facet size.
    Stick(f64),
    /// Equality of stresses: an open node, the slip law, balance with the other side.
    Traction,
    /// Balance of resultants of a patch.
    Resultant,
    /// A quantity without unit.
    Number,
}

/// A row: the equation it belongs to, what it states, its residual and its
/// gradient over the lanes.
pub type Row<const N: usize> = (u32, Field, f64, [f64; N]);

/// Derivatives of a vector: `(unknown, d vector / d unknown)`.
pub type Jacobian = Vec<(u32, Vec3)>;

/// Where the lanes of a dual number come from.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// Consecutive unknowns.
    Unknowns {
        /// The first of them.
        first: u32,
        /// How many, one lane each.
        count: usize,
    },
    /// An intermediate vector, three lanes.
    Vector(&'a Jacobian),
    /// Lanes that stay constant.
    Constant(usize),
}

/// The sources of all lanes in order.
#[derive(Clone, Debug, Default)]
pub struct Lanes<'a>(Vec<Source<'a>>);

impl<'a> Lanes<'a> {
    /// Appends a source.
    pub fn push(&mut self, source: Source<'a>) {
        self.0.push(source);
    }

    /// Unknowns that any lane depends on, ascending.
    pub fn columns(&self) -> Vec<u32> {
        let mut columns = Vec::with_capacity(96);
        for source in &self.0 {
            match source {
                Source::Unknowns { first, count } => {
                    columns.extend(*first..*first + *count as u32);
                }
                Source::Vector(jacobian) => columns.extend(jacobian.iter().map(|entry| entry.0)),
                Source::Constant(_) => {}
            }
        }
        columns.sort_unstable();
        columns.dedup();
        columns
    }

    /// Adds the row with the gradient `lane_gradient` over the lanes to `row`,
    /// which runs over `columns`.
    pub fn chain(&self, lane_gradient: &[f64], columns: &[u32], row: &mut [f64]) {
        let position = |unknown: u32| columns.partition_point(|column| *column < unknown);
        let mut lane = 0;
        for source in &self.0 {
            match source {
                Source::Unknowns { first, count } => {
                    let start = position(*first);
                    for offset in 0..*count {
                        row[start + offset] += lane_gradient[lane + offset];
                    }
                    lane += count;
                }
                Source::Vector(jacobian) => {
                    let g = Vec3::from_column_slice(&lane_gradient[lane..lane + 3]);
                    if g != Vec3::zeros() {
                        for (unknown, derivative) in jacobian.iter() {
                            row[position(*unknown)] += g.dot(derivative);
                        }
                    }
                    lane += 3;
                }
                Source::Constant(count) => lane += count,
            }
        }
    }
}

impl LocalTerm {
    /// A term from rows over lanes.
    pub fn from_lanes<const N: usize>(lanes: &Lanes, rows: &[Row<N>]) -> Self {
        let columns = lanes.columns();
        let mut tangent = vec![0.0; rows.len() * columns.len()];
        for (row, (_, _, _, gradient)) in tangent.chunks_mut(columns.len().max(1)).zip(rows) {
            lanes.chain(gradient, &columns, row);
        }
        Self {
            rows: rows.iter().map(|row| row.0).collect(),
            fields: rows.iter().map(|row| row.1).collect(),
            residual: rows.iter().map(|row| row.2).collect(),
            columns,
            tangent,
        }
    }
}

/// The derivatives of a dual vector as a Jacobian over unknowns.
pub fn jacobian<const N: usize>(
    lanes: &Lanes,
    vector: &nalgebra::Vector3<DualSVec64<N>>,
) -> Jacobian {
    let columns = lanes.columns();
    let mut rows = [(); 3].map(|()| vec![0.0; columns.len()]);
    for (axis, row) in rows.iter_mut().enumerate() {
        lanes.chain(&gradient(&vector[axis]), &columns, row);
    }
    columns
        .iter()
        .enumerate()
        .map(|(at, &column)| (column, Vec3::new(rows[0][at], rows[1][at], rows[2][at])))
        .collect()
}

/// A dual number that is the lane `lane`.
pub fn variable<const N: usize>(value: f64, lane: usize) -> DualSVec64<N> {
    DualSVec64::from_re(value).derivative(lane)
}

/// A dual vector over three lanes.
pub fn variable3<const N: usize>(value: &Vec3, lane: usize) -> nalgebra::Vector3<DualSVec64<N>> {
    nalgebra::Vector3::from_fn(|axis, _| variable(value[axis], lane + axis))
}

/// Four dual vectors over twelve lanes.
pub fn variables3<const N: usize>(
    values: &[Vec3; 4],
    lane: usize,
) -> [nalgebra::Vector3<DualSVec64<N>>; 4] {
    std::array::from_fn(|corner| variable3(&values[corner], lane + 3 * corner))
}

/// Gradient over the lanes.
pub fn gradient<const N: usize>(number: &DualSVec64<N>) -> [f64; N] {
    match &number.eps {
        Derivative(Some(eps)) => eps.data.0[0],
        Derivative(None) => [0.0; N],
    }
}
