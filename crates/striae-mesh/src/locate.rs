//! Location of a place in a mesh: the element it lies in and the weights of its corners.
//!
//! The natural coordinates `xi` of `x` solve `sum_a N_a(xi) X_a = x` by Newton's method; the
//! place is inside where no `N_a(xi)` is negative.

use nalgebra::Matrix3;

use crate::{CellKind, ElementId, Mesh, NodeId, Vec3};

/// Negative interpolation that still counts as inside.
const MARGIN: f64 = 1e-6;
/// Most iterations.
const ITERATIONS: usize = 20;
/// Length of a correction at which the iteration ends.
const SMALL: f64 = 1e-13;

/// A place in a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Located {
    /// The element.
    pub element: ElementId,
    /// Its corners with the values of their interpolation functions, which sum to one.
    pub weights: Vec<(NodeId, f64)>,
}

impl Mesh {
    /// Location of a place in the reference configuration: in the element it lies deepest in,
    /// `None` if it is outside of all.
    pub fn locate(&self, x: &Vec3) -> Option<Located> {
        let mut best: Option<(f64, Located)> = None;
        let mut first = 0;
        for block in &self.blocks {
            for (at, corners) in block.cells().enumerate() {
                let positions: Vec<Vec3> = corners
                    .iter()
                    .map(|node| self.positions[node.index()])
                    .collect();
                let Some(values) = inside(block.kind, &positions, x) else {
                    continue;
                };
                let least = values.iter().copied().fold(f64::INFINITY, f64::min);
                if best.as_ref().is_none_or(|(depth, _)| least > *depth) {
                    let weights = corners.iter().copied().zip(values).collect();
                    let element = ElementId::new(first + at);
                    best = Some((least, Located { element, weights }));
                }
            }
            first += block.len();
        }
        best.map(|(_, located)| located)
    }
}

/// Values of the interpolation functions at a place in a cell.
fn inside(kind: CellKind, corners: &[Vec3], x: &Vec3) -> Option<Vec<f64>> {
    let start = corners[0];
    let (low, high) = corners.iter().fold((start, start), |(low, high), corner| {
        (low.inf(corner), high.sup(corner))
    });
    let margin = MARGIN * (high - low).norm();
    let outside = |axis: usize| x[axis] < low[axis] - margin || x[axis] > high[axis] + margin;
    if (0..3).any(outside) {
        return None;
    }
    let shape = kind.shape();
    let natural = shape.corners.iter().map(|corner| Vec3::from(*corner));
    let mut xi = natural.sum::<Vec3>() / shape.corners.len() as f64;
    for _ in 0..ITERATIONS {
        let values = (shape.interpolation)(&xi);
        let gradients = (shape.gradients)(&xi);
        let mut left = *x;
        let mut jacobian = Matrix3::zeros();
        for (corner, (value, gradient)) in corners.iter().zip(values.iter().zip(gradients)) {
            left -= corner * *value;
            jacobian += corner * gradient.transpose();
        }
        let correction = jacobian.try_inverse()? * left;
        xi += correction;
        if correction.norm() < SMALL {
            break;
        }
    }
    let values = (shape.interpolation)(&xi)[..corners.len()].to_vec();
    values
        .iter()
        .all(|value| *value >= -MARGIN)
        .then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Block;

    #[test]
    fn places_are_found_in_cells_of_all_kinds() {
        for cells in CellKind::ALL {
            let block = Block {
                divisions: [3, 2, 2],
                cells,
                irregularity: 0.2,
                ..Block::default()
            };
            let mesh = block.mesh().unwrap();
            for x in [[0.31, 0.52, 0.77], [0.0, 0.0, 0.0], [1.0, 0.4, 0.1]].map(Vec3::from) {
                let located = mesh.locate(&x).unwrap();
                let weights = located.weights.iter();
                let sum: f64 = weights.clone().map(|(_, weight)| weight).sum();
                let again: Vec3 = weights
                    .map(|(node, weight)| mesh.positions[node.index()] * *weight)
                    .sum();
                assert!((sum - 1.0).abs() < 1e-12);
                assert!((again - x).norm() < 1e-12, "{cells:?}: {again:?}");
            }
            assert_eq!(mesh.locate(&Vec3::new(1.1, 0.5, 0.5)), None);
        }
    }
}
