//! Laws as sums of parameters times vectors at readings.

use std::f64::consts::TAU;

use nalgebra::{DVector, Matrix2xX, Vector2};

use super::{ConstantName, Reading, Sought};
use crate::friction::{Basis, Direction, Friction, FrictionError, Meaning};
use striae_declared::{Form, Value, Values, degrees};

/// Difference below which two angles of a table are the same (radians).
const SAME: f64 = 1e-6;
/// A direction without symmetry.
const ANY: Direction = Direction {
    theta: 1.0,
    slip: 1.0,
};

/// A law that is sought, and the angles of its table.
pub(super) struct Shape<'s> {
    sought: &'s Sought,
    /// Angles of the table, ascending within a turn from 0.
    angles: Vec<f64>,
    /// Number of the angle of each reading.
    nodes: Vec<usize>,
}

impl<'s> Shape<'s> {
    pub(super) fn new(sought: &'s Sought, readings: &[Reading]) -> Self {
        let (angles, nodes) = match sought.basis {
            Basis::Table { .. } => table(readings),
            Basis::Sum(_) => (Vec::new(), vec![0; readings.len()]),
        };
        Self {
            sought,
            angles,
            nodes,
        }
    }

    /// Returns how many parameters there are.
    pub(super) fn count(&self) -> usize {
        match self.sought.basis {
            Basis::Sum(sum) => sum.constants.len(),
            Basis::Table { .. } => self.angles.len(),
        }
    }

    /// Returns whether friction across slip bears on the parameters.
    pub(super) fn knows_across(&self) -> bool {
        match self.sought.basis {
            Basis::Sum(sum) => {
                let q = vec![1.0; sum.constants.len()];
                let vectors = (sum.vectors)(ANY, &q, &self.sought.words);
                vectors.iter().any(|w| ANY.d().perp(w) != 0.0)
            }
            Basis::Table { .. } => false,
        }
    }

    /// Returns the vectors `w_k` in a direction, for a reading where there is a table.
    pub(super) fn basis(
        &self,
        reading: usize,
        direction: Direction,
        q: &DVector<f64>,
    ) -> Vec<Vector2<f64>> {
        match self.sought.basis {
            Basis::Sum(sum) => (sum.vectors)(direction, q.as_slice(), &self.sought.words),
            Basis::Table { .. } => {
                let mut vectors = Matrix2xX::zeros(self.angles.len());
                vectors.set_column(self.nodes[reading], &direction.d());
                vectors.column_iter().map(|w| w.into_owned()).collect()
            }
        }
    }

    /// Returns where dissipation is looked at: number of a reading, and direction.
    pub(super) fn judged(&self) -> Vec<(usize, Direction)> {
        match self.sought.basis {
            Basis::Sum(sum) => {
                let judged = (sum.judged)().into_iter();
                judged.map(|direction| (0, direction)).collect()
            }
            Basis::Table { .. } => {
                let first = |node| self.nodes.iter().position(|other| *other == node);
                let reading = |node| first(node).expect("each angle is that of a reading");
                let angles = self.angles.iter().enumerate();
                let at = |(i, angle): (usize, &f64)| (reading(i), Direction::new(0.0, *angle));
                angles.map(at).collect()
            }
        }
    }

    /// Returns the law with certain parameters.
    pub(super) fn friction(&self, q: &DVector<f64>) -> Result<Friction, FrictionError> {
        let constants = self.constants().into_iter();
        let constants = constants.map(|(name, how)| (name, how.value(q)));
        let values: Values = match self.sought.basis {
            Basis::Sum(_) => {
                let key = |(name, value): (ConstantName, f64)| match name {
                    ConstantName::Key(key) => Some((key, Value::Number(value))),
                    ConstantName::MuAt(_) => None,
                };
                let words = self.sought.words.iter();
                let words = words.map(|(name, word)| (name, word.clone()));
                constants.filter_map(key).chain(words).collect()
            }
            Basis::Table {
                angles,
                coefficients,
            } => {
                let at: Vec<f64> = self.angles.iter().map(|angle| degrees(*angle)).collect();
                let found: Vec<f64> = constants.map(|(_, value)| value).collect();
                let lists = [(*angles, Value::from(at)), (*coefficients, found.into())];
                lists.into_iter().collect()
            }
        };
        self.sought.law.made(&values)
    }

    /// Returns the constants of the law.
    pub(super) fn constants(&self) -> Vec<(ConstantName, Meaning)> {
        match self.sought.basis {
            Basis::Sum(sum) => {
                let parameters = self.sought.law.parameters.iter();
                let numbers = parameters.filter(|one| matches!(one.form, Form::Number(_)));
                let names = numbers.map(|one| ConstantName::Key(one.name));
                names.zip(sum.constants.iter().copied()).collect()
            }
            Basis::Table { .. } => {
                let angles = self.angles.iter().enumerate();
                angles
                    .map(|(i, angle)| (ConstantName::MuAt(*angle), Meaning::Parameter(i)))
                    .collect()
            }
        }
    }
}

/// Angles that were measured, ascending, and the number of that of each reading.
fn table(readings: &[Reading]) -> (Vec<f64>, Vec<usize>) {
    let turned = |reading: &Reading| {
        let angle = reading.slip.rem_euclid(TAU);
        if TAU - angle < SAME { 0.0 } else { angle }
    };
    let mut angles: Vec<f64> = readings.iter().map(turned).collect();
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|next, before| *next - *before < SAME);
    let node = |reading: &Reading| {
        let angle = turned(reading);
        angles.partition_point(|start| *start <= angle) - 1
    };
    let nodes = readings.iter().map(node).collect();
    (angles, nodes)
}
