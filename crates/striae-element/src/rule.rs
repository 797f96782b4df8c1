//! Data shared by all elements of a kind: interpolation at the quadrature points.

use striae_mesh::{CellKind, MAX_POINTS, Vec3};

/// Shares of the values at the points in a value at natural coordinates.
pub(super) type Recovery = fn(&Vec3) -> [f64; MAX_POINTS];

/// Interpolation of a kind with `N` corners at its `Q` quadrature points.
#[derive(Debug)]
pub(super) struct Rule<const N: usize, const Q: usize> {
    /// `N_a` by point.
    pub(super) values: [[f64; N]; Q],
    /// `dN_a/dxi` by point.
    pub(super) gradients: [[Vec3; N]; Q],
    /// Weights of the points in natural coordinates.
    pub(super) weights: [f64; Q],
    /// Matrix that extrapolates values at the quadrature points to the corners, by corner.
    pub(super) recovery: [[f64; Q]; N],
}

impl<const N: usize, const Q: usize> Rule<N, Q> {
    /// Of a kind whose elements have the points of its cells.
    pub(super) fn new(kind: CellKind, recovery: Recovery) -> Self {
        let shape = kind.shape();
        assert_eq!([shape.corners.len(), shape.points.len()], [N, Q], "{kind}");
        let at = |g: usize| Vec3::from(shape.points[g].0);
        Self {
            values: std::array::from_fn(|g| first((shape.interpolation)(&at(g)))),
            gradients: std::array::from_fn(|g| first((shape.gradients)(&at(g)))),
            weights: std::array::from_fn(|g| shape.points[g].1),
            recovery: std::array::from_fn(|a| first(recovery(&Vec3::from(shape.corners[a])))),
        }
    }
}

fn first<T: Copy, const ALL: usize, const N: usize>(values: [T; ALL]) -> [T; N] {
    std::array::from_fn(|a| values[a])
}
