//! Local terms: rows of the residual with their derivatives.
//!
//! A kernel differentiates its rows by intermediate quantities, its lanes
//! (positions, normals, nodal tractions), by hand or with dual numbers. The chain
//! rule through the lanes to the unknowns is applied here, for all rows at once:
//! gradients are stored as `gradient[lane][row]`.

use nalgebra::{Matrix3, Vector3};
use num_dual::{Derivative, DualSVec64};
use striae_mesh::Vec3;

pub use crate::unknown::{Gradient, Jacobian};

use crate::places::Places;

/// Some rows of the residual and their derivatives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LocalTerm {
    /// Pair-local unknowns whose equations the rows belong to.
    pub rows: Vec<u32>,
    /// Equations stated by the rows.
    pub fields: Vec<Field>,
    /// Residual of each row.
    pub residual: Vec<f64>,
    /// Pair-local unknowns the rows depend on, ascending, in whole triples.
    pub columns: Vec<u32>,
    /// `d residual / d unknown`, row-major.
    pub tangent: Vec<f64>,
}

/// Equation stated by a row, and the scale of its residual if it has one of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Field {
    /// Equilibrium of forces at a node.
    Momentum,
    /// No gap; the scale is the local facet size.
    Gap(f64),
    /// No slip; the scale is the local facet size.
    Stick(f64),
    /// Equality of stresses: an open node, the slip law.
    Traction,
}

/// A row: the equation it belongs to, what it states and its residual.
pub type Row = (u32, Field, f64);

/// Source of lanes.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// Consecutive unknowns from the first of a triple on.
    Unknowns {
        /// The first of them.
        first: u32,
        /// Number of lanes.
        count: usize,
    },
    /// An intermediate vector, three lanes.
    Vector(&'a Jacobian),
    /// An intermediate scalar, one lane.
    Scalar(&'a Gradient),
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

    /// First unknowns of the triples that any lane depends on, ascending.
    pub fn triples(&self) -> Vec<u32> {
        let mut triples: Vec<u32> = Vec::with_capacity(64);
        let mut places = Places::none();
        let mut add = |first: u32| {
            if places.find(first, triples.len()) == triples.len() {
                triples.push(first);
            }
        };
        for source in &self.0 {
            match source {
                Source::Unknowns { first, count } => {
                    (*first..*first + *count as u32)
                        .step_by(3)
                        .for_each(&mut add);
                }
                Source::Vector(jacobian) => jacobian.iter().for_each(|entry| add(entry.0)),
                Source::Scalar(gradient) => gradient.iter().for_each(|entry| add(entry.0)),
                Source::Constant(_) => {}
            }
        }
        triples.sort_unstable();
        triples
    }

    /// Derivatives of rows by the unknowns of `triples`, column by column.
    pub(crate) fn chained<const R: usize>(
        &self,
        gradient: &[[f64; R]],
        triples: &[u32],
    ) -> Vec<[f64; R]> {
        let mut columns = vec![[0.0; R]; 3 * triples.len()];
        let mut places = Places::of(triples.iter().copied());
        let mut position = |first: u32| 3 * places.find(first, triples.len());
        let mut lane = 0;
        for source in &self.0 {
            match source {
                Source::Unknowns { first, count } => {
                    for offset in 0..*count {
                        let at = position(first + (offset - offset % 3) as u32) + offset % 3;
                        let slopes = columns[at].iter_mut().zip(&gradient[lane + offset]);
                        slopes.for_each(|(slope, by_lane)| *slope += by_lane);
                    }
                    lane += count;
                }
                Source::Vector(jacobian) => {
                    let [x, y, z] = [0, 1, 2].map(|axis| &gradient[lane + axis]);
                    if [x, y, z].iter().any(|by_lane| **by_lane != [0.0; R]) {
                        for (first, block) in jacobian.iter() {
                            let at = position(*first);
                            for (column, [b_x, b_y, b_z]) in
                                columns[at..].iter_mut().zip(block.data.0)
                            {
                                for row in 0..R {
                                    column[row] += x[row] * b_x + y[row] * b_y + z[row] * b_z;
                                }
                            }
                        }
                    }
                    lane += 3;
                }
                Source::Scalar(slopes) => {
                    for (first, slope) in slopes.iter() {
                        let at = position(*first);
                        for (column, slope) in columns[at..].iter_mut().zip(slope) {
                            let rows = column.iter_mut().zip(&gradient[lane]);
                            rows.for_each(|(row, by_lane)| *row += by_lane * slope);
                        }
                    }
                    lane += 1;
                }
                Source::Constant(count) => lane += count,
            }
        }
        columns
    }

    /// Derivatives of a vector by the unknowns.
    pub fn jacobian(&self, gradient: &[[f64; 3]]) -> Jacobian {
        let triples = self.triples();
        let columns = self.chained(gradient, &triples);
        let blocks = columns.chunks_exact(3).map(|block| {
            Matrix3::from_columns(&[block[0].into(), block[1].into(), block[2].into()])
        });
        triples.iter().copied().zip(blocks).collect()
    }
}

impl LocalTerm {
    /// A term from rows and their gradients over lanes.
    pub(crate) fn from_lanes<const R: usize>(
        lanes: &Lanes,
        rows: &[Row; R],
        gradient: &[[f64; R]],
    ) -> Self {
        let triples = lanes.triples();
        let columns = lanes.chained(gradient, &triples);
        Self::from_columns(rows, &triples, &columns)
    }

    /// A term from rows and their derivatives by the unknowns of `triples`.
    pub fn from_columns<const R: usize>(
        rows: &[Row],
        triples: &[u32],
        columns: &[[f64; R]],
    ) -> Self {
        let mut tangent = Vec::with_capacity(rows.len() * columns.len());
        for row in 0..rows.len() {
            tangent.extend(columns.iter().map(|column| column[row]));
        }
        Self {
            rows: rows.iter().map(|row| row.0).collect(),
            fields: rows.iter().map(|row| row.1).collect(),
            residual: rows.iter().map(|row| row.2).collect(),
            columns: triples.iter().flat_map(|first| *first..first + 3).collect(),
            tangent,
        }
    }
}

/// Adds the derivative of three rows by a vector on the lanes from `lane` on.
pub fn add_block(gradient: &mut [[f64; 3]], lane: usize, block: &Matrix3<f64>) {
    for (by_lane, column) in gradient[lane..].iter_mut().zip(block.data.0) {
        for row in 0..3 {
            by_lane[row] += column[row];
        }
    }
}

/// Gradients of dual numbers over the lanes, lane by lane.
pub(crate) fn by_lane<const R: usize, const N: usize>(rows: &[DualSVec64<N>; R]) -> [[f64; R]; N] {
    let gradients = rows.each_ref().map(gradient);
    std::array::from_fn(|lane| std::array::from_fn(|row| gradients[row][lane]))
}

/// A dual vector by its values and its gradients over the lanes.
pub fn parts<const N: usize>(vector: &Vector3<DualSVec64<N>>) -> (Vec3, [[f64; 3]; N]) {
    let value = vector.map(|component| component.re);
    (value, by_lane(&[vector.x, vector.y, vector.z]))
}

/// A dual number that is the lane `lane`.
pub fn variable<const N: usize>(value: f64, lane: usize) -> DualSVec64<N> {
    DualSVec64::from_re(value).derivative(lane)
}

/// A dual vector over three lanes.
pub(crate) fn variable3<const N: usize>(
    value: &Vec3,
    lane: usize,
) -> nalgebra::Vector3<DualSVec64<N>> {
    nalgebra::Vector3::from_fn(|axis, _| variable(value[axis], lane + axis))
}

/// Four dual vectors over twelve lanes.
pub(crate) fn variables3<const N: usize>(
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
