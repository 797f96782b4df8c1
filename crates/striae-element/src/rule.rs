//! What all elements of a kind have in common: interpolation at the quadrature points.

use striae_mesh::{CellKind, Vec3};

/// Interpolation of a kind with `N` corners at its `Q` quadrature points.
#[derive(Debug)]
pub(super) struct Rule<const N: usize, const Q: usize> {
    /// `N_a` by point.
    pub(super) values: [[f64; N]; Q],
    /// `dN_a/dxi` by point.
    pub(super) gradients: [[Vec3; N]; Q],
    /// Weights of the points in natural coordinates.
    pub(super) weights: [f64; Q],
}

impl<const N: usize, const Q: usize> Rule<N, Q> {
    pub(super) fn new(kind: CellKind) -> Self {
        let shape = kind.shape();
        assert_eq!([shape.corners.len(), shape.points.len()], [N, Q], "{kind}");
        let at = |g: usize| Vec3::from(shape.points[g].0);
        Self {
            values: std::array::from_fn(|g| first((shape.interpolation)(&at(g)))),
            gradients: std::array::from_fn(|g| first((shape.gradients)(&at(g)))),
            weights: std::array::from_fn(|g| shape.points[g].1),
        }
    }
}

fn first<T: Copy, const ALL: usize, const N: usize>(values: [T; ALL]) -> [T; N] {
    std::array::from_fn(|a| values[a])
}

/// The value of a tetrahedron, the mean, at the corners: stress is constant.
pub(super) fn tetrahedron_recovery() -> [[f64; 4]; 4] {
    [[0.25; 4]; 4]
}

/// The linear field closest to the values at the points, at the corners.
pub(super) fn pyramid_recovery() -> [[f64; 8]; 5] {
    let shape = CellKind::Pyramid.shape();
    let at = |g: usize| Vec3::from(shape.points[g].0);
    let middle = (0..8).map(at).sum::<Vec3>() / 8.0;
    // The points are symmetric: moments about their middle are diagonal.
    let from_middle = |g: usize| at(g) - middle;
    let squares: Vec3 = (0..8)
        .map(|g| from_middle(g).component_mul(&from_middle(g)))
        .sum();
    std::array::from_fn(|a| {
        let corner = Vec3::from(shape.corners[a]) - middle;
        std::array::from_fn(|g| 0.125 + corner.component_div(&squares).dot(&from_middle(g)))
    })
}

/// The field linear in the triangle and along the axis through the values, at the corners.
pub(super) fn wedge_recovery() -> [[f64; 6]; 6] {
    let shape = CellKind::Wedge.shape();
    std::array::from_fn(|a| {
        let [x, y, z] = shape.corners[a];
        // Points of the triangle are halfway from its middle to the corners.
        let out = |s: f64| 2.0 * s - 1.0 / 3.0;
        first((shape.interpolation)(&Vec3::new(
            out(x),
            out(y),
            z * 3f64.sqrt(),
        )))
    })
}

/// The trilinear field through the values at the Gauss points, at the corners.
pub(super) fn hexahedron_recovery() -> [[f64; 8]; 8] {
    let shape = CellKind::Hexahedron.shape();
    std::array::from_fn(|a| {
        first((shape.interpolation)(
            &(Vec3::from(shape.corners[a]) * 3f64.sqrt()),
        ))
    })
}
