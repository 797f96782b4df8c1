//! Axes in which displacements of nodes are prescribed.
//!
//! A node that is prescribed along other directions than the coordinate axes has a frame of its
//! own, orthonormal axes `q_1, q_2, q_3` of which the first span the prescribed directions:
//!
//! ```text
//! x = sum q_k y_k,   y_k = q_k . x,   R_k = q_k . R
//! ```
//!
//! The components `y_k` take the place of the coordinates among the unknowns, and those of the
//! residual `R` that of its rows. Prescribed components are then eliminated as those of other
//! nodes are. Directions `d_i` that are not perpendicular to each other give them by the lower
//! triangle `L_ij = d_i . q_j`,
//!
//! ```text
//! sum_j L_ij y_j = d_i . x = v_i.
//! ```
//!
//! All directions follow from reference positions and stay.

use nalgebra::Matrix3;
use serde::Serialize;
use striae_mesh::Vec3;

/// Axes of the components of a prescribed displacement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub enum Axes {
    /// The coordinate axes.
    #[default]
    Global,
    /// The first axis along a vector; there are no others.
    Normal(Vec3),
    /// The first axis along `x`, the second one in the plane of `x` and `y` on the side of `y`.
    Skew {
        /// Along the first axis.
        x: Vec3,
        /// On the side of the second axis.
        y: Vec3,
    },
    /// Radial, tangential and axial direction at the reference position of each node, the
    /// tangential one by the right-hand rule about the axis. A tangential component is a length.
    Cylindrical {
        /// A point of the axis.
        point: Vec3,
        /// Along the axis.
        axis: Vec3,
    },
}

/// Distance from the axis of a cylinder, over that from its point, within which nodes are on it.
const ON_AXIS: f64 = 1e-9;

impl Axes {
    /// Unit vectors along the axes for a node at `x` in the reference configuration; `None` for
    /// those that do not exist, as radial ones on the axis.
    pub fn directions(&self, x: &Vec3) -> [Option<Vec3>; 3] {
        match self {
            Self::Global => [0, 1, 2].map(|axis| Some(Vec3::ith(axis, 1.0))),
            Self::Normal(normal) => [normal.try_normalize(0.0), None, None],
            Self::Skew { x, y } => {
                let first = x.try_normalize(0.0);
                let third = first.and_then(|first| first.cross(y).try_normalize(0.0));
                let second = first.zip(third).map(|(first, third)| third.cross(&first));
                [first, second, third]
            }
            Self::Cylindrical { point, axis } => {
                let Some(axial) = axis.try_normalize(0.0) else {
                    return [None; 3];
                };
                let arm = x - point;
                let across = arm - axial * axial.dot(&arm);
                let radial = across.try_normalize(ON_AXIS * arm.norm());
                [
                    radial,
                    radial.map(|radial| axial.cross(&radial)),
                    Some(axial),
                ]
            }
        }
    }

    /// Returns whether they are the coordinate axes.
    pub fn are_global(&self) -> bool {
        *self == Self::Global
    }
}

/// Sine of the angle below which two directions are one.
const SAME: f64 = 1e-9;
/// Part of a direction beyond those before it below which it follows from them.
const LEAST: f64 = 1e-4;
/// Round-off of components of unit vectors.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// Returns whether two unit vectors are along one line.
pub fn are_parallel(a: &Vec3, b: &Vec3) -> bool {
    a.cross(b).norm() < SAME
}

/// Axes of a node, of which the first span prescribed directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeFrame {
    axes: Matrix3<f64>,
    held: usize,
    lower: [[f64; 3]; 3],
}

impl NodeFrame {
    /// The frame of unit vectors along which a node is prescribed; `None` if one of them follows
    /// from the others or nearly so.
    pub fn new(directions: &[Vec3]) -> Option<Self> {
        let mut axes: Vec<Vec3> = Vec::with_capacity(3);
        let mut lower = [[0.0; 3]; 3];
        for (i, direction) in directions.iter().enumerate() {
            if axes.len() == 3 {
                return None;
            }
            let mut left = *direction;
            for (j, axis) in axes.iter().enumerate() {
                let along = direction.dot(axis);
                if along.abs() > ROUND_OFF {
                    lower[i][j] = along;
                    left -= axis * along;
                }
            }
            let length = left.norm();
            if length < LEAST {
                return None;
            }
            let is_unit = (length - 1.0).abs() <= ROUND_OFF;
            lower[i][i] = if is_unit { 1.0 } else { length };
            axes.push(if is_unit { left } else { left / length });
        }
        let held = axes.len();
        while axes.len() < 3 {
            let next = match axes.as_slice() {
                [] => Vec3::x(),
                [first] => first.cross(&Vec3::ith(first.iamin(), 1.0)).normalize(),
                [first, second, ..] => first.cross(second),
            };
            axes.push(next);
        }
        Some(Self {
            axes: Matrix3::from_columns(&axes),
            held,
            lower,
        })
    }

    /// Unit vectors along the axes, in columns.
    pub fn axes(&self) -> &Matrix3<f64> {
        &self.axes
    }

    /// Unit vector along an axis.
    pub fn axis(&self, axis: usize) -> Vec3 {
        self.axes.column(axis).into()
    }

    /// Number of prescribed components, which are the first ones.
    pub fn held(&self) -> usize {
        self.held
    }

    /// Projection to the directions that are free.
    pub fn free(&self) -> Matrix3<f64> {
        let free = (self.held..3).map(|axis| self.axis(axis) * self.axis(axis).transpose());
        free.sum()
    }

    /// Prescribed components of a vector with these components along the directions.
    pub fn components(&self, along: &[f64]) -> [f64; 3] {
        let mut components = [0.0; 3];
        for (i, value) in along.iter().enumerate() {
            let known = (0..i).filter(|j| self.lower[i][*j] != 0.0);
            let known: f64 = known.map(|j| self.lower[i][j] * components[j]).sum();
            components[i] = (value - known) / self.lower[i][i];
        }
        components
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_perpendicular_and_right_handed() {
        let x = Vec3::new(1.0, 2.0, 0.5);
        let skew = Axes::Skew {
            x: Vec3::new(1.0, 1.0, 0.0),
            y: Vec3::new(0.0, 3.0, 1.0),
        };
        let cylindrical = Axes::Cylindrical {
            point: Vec3::new(0.0, 1.0, 0.0),
            axis: Vec3::new(0.0, 0.0, 2.0),
        };
        for axes in [Axes::Global, skew, cylindrical] {
            let [a, b, c] = axes.directions(&x).map(Option::unwrap);
            assert!((a.cross(&b) - c).norm() < 1e-15, "{axes:?}");
        }
        let [radial, tangential, _] = cylindrical.directions(&x).map(Option::unwrap);
        let half = 0.5_f64.sqrt();
        assert!((radial - Vec3::new(half, half, 0.0)).norm() < 1e-15);
        assert!((tangential - Vec3::new(-half, half, 0.0)).norm() < 1e-15);
    }

    #[test]
    fn axes_that_do_not_exist_are_none() {
        let cylindrical = Axes::Cylindrical {
            point: Vec3::zeros(),
            axis: Vec3::z(),
        };
        let [radial, tangential, axial] = cylindrical.directions(&Vec3::new(0.0, 0.0, 3.0));
        assert_eq!((radial, tangential, axial), (None, None, Some(Vec3::z())));
        let skew = Axes::Skew {
            x: Vec3::x(),
            y: Vec3::x() * -2.0,
        };
        assert_eq!(
            skew.directions(&Vec3::zeros()),
            [Some(Vec3::x()), None, None]
        );
        assert_eq!(
            Axes::Normal(Vec3::zeros()).directions(&Vec3::x()),
            [None; 3]
        );
    }

    #[test]
    fn components_along_oblique_directions_give_the_vector() {
        let directions = [
            Vec3::new(0.6, 0.8, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(0.48, 0.6, 0.64),
        ];
        let u = Vec3::new(0.3, -0.2, 0.7);
        for count in 1..=3 {
            let stated = &directions[..count];
            let frame = NodeFrame::new(stated).unwrap();
            let along: Vec<f64> = stated.iter().map(|d| d.dot(&u)).collect();
            let components = frame.components(&along);
            for (axis, component) in components.iter().enumerate().take(count) {
                assert!((component - frame.axis(axis).dot(&u)).abs() < 1e-15);
            }
            let orthogonality = frame.axes().transpose() * frame.axes() - Matrix3::identity();
            assert!(orthogonality.norm() < 1e-15 && frame.held() == count);
        }
        assert_eq!(NodeFrame::new(&[Vec3::x(), Vec3::x()]), None);
        let in_a_plane = [Vec3::x(), Vec3::y(), Vec3::new(0.6, 0.8, 0.0)];
        assert_eq!(NodeFrame::new(&in_a_plane), None);
        let four = [Vec3::x(), Vec3::y(), Vec3::z(), Vec3::new(0.6, 0.8, 0.0)];
        assert_eq!(NodeFrame::new(&four), None);
    }
}
