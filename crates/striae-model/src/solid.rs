//! Mass, centre and inertia of a solid of uniform density inside a closed surface.
//!
//! By the divergence theorem, over bilinear facets `x(xi, eta)`,
//!
//! ```text
//! V = 1/3 int x . da,   int x dV = 1/4 int x (x . da),   int x x dV = 1/5 int x x (x . da),
//! da = x_,xi x x_,eta dxi deta,   J = rho (tr S I - S),   S = int (x - c)(x - c) dV
//! ```
//!
//! The integrands are polynomials of fourth order at most in each coordinate, which 3x3
//! Gauss points integrate exactly, on flat facets and on twisted ones.

use std::collections::HashSet;

use nalgebra::Matrix3;
use striae_mesh::{NodeId, Vec3};

use crate::model::RigidInertia;

/// A surface without an inside.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SolidError {
    /// An edge that is not once an edge of two facets, in opposite directions.
    #[error(
        "the surface is not closed at the edge from {} to {}; every edge must belong to two facets",
        edge[0], edge[1]
    )]
    Open {
        /// Nodes of the edge.
        edge: [NodeId; 2],
    },
    /// The facets look inward.
    #[error(
        "the enclosed volume is {volume}; facets must be oriented outward by the right-hand rule"
    )]
    InsideOut {
        /// The volume.
        volume: f64,
    },
}

/// Points and weights on `[-1, 1]`.
const GAUSS_3: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];

/// Inertia of what is inside facets of three or four corners; a triangle repeats its
/// last corner.
///
/// # Errors
/// When the surface is open or looks inward.
pub fn inertia(
    positions: &[Vec3],
    facets: &[[NodeId; 4]],
    density: f64,
) -> Result<RigidInertia, SolidError> {
    closed(facets)?;
    // From a point nearby, so that little is lost to cancellation.
    let origin = facets
        .first()
        .map_or_else(Vec3::zeros, |facet| positions[facet[0].index()]);
    let (mut volume, mut first, mut second) = (0.0, Vec3::zeros(), Matrix3::zeros());
    for facet in facets {
        let x = facet.map(|node| positions[node.index()] - origin);
        for (xi, w_xi) in GAUSS_3 {
            for (eta, w_eta) in GAUSS_3 {
                let (at, area) = point(&x, xi, eta);
                let flux = at.dot(&area) * w_xi * w_eta;
                volume += flux / 3.0;
                first += at * (flux / 4.0);
                second += at * at.transpose() * (flux / 5.0);
            }
        }
    }
    if volume <= 0.0 {
        return Err(SolidError::InsideOut { volume });
    }
    let centre = first / volume;
    let about_centre = (second - centre * centre.transpose() * volume) * density;
    let eigen = about_centre.symmetric_eigen();
    let [a, b, c]: [f64; 3] = eigen.eigenvalues.into();
    Ok(RigidInertia {
        mass: density * volume,
        centre: origin + centre,
        moments: [b + c, c + a, a + b],
        axes: eigen.eigenvectors,
    })
}

/// Position and area vector at a point of a facet.
fn point(x: &[Vec3; 4], xi: f64, eta: f64) -> (Vec3, Vec3) {
    let (u, v) = ([1.0 - xi, 1.0 + xi], [1.0 - eta, 1.0 + eta]);
    let at =
        x[0] * (u[0] * v[0]) + x[1] * (u[1] * v[0]) + x[2] * (u[1] * v[1]) + x[3] * (u[0] * v[1]);
    let d_xi = (x[1] - x[0]) * v[0] + (x[2] - x[3]) * v[1];
    let d_eta = (x[3] - x[0]) * u[0] + (x[2] - x[1]) * u[1];
    (at / 4.0, d_xi.cross(&d_eta) / 16.0)
}

fn closed(facets: &[[NodeId; 4]]) -> Result<(), SolidError> {
    let mut edges = HashSet::new();
    let all = || {
        facets.iter().flat_map(|facet| {
            let edges = (0..4).map(|at| [facet[at], facet[(at + 1) % 4]]);
            edges.filter(|edge| edge[0] != edge[1])
        })
    };
    for edge in all() {
        if !edges.insert(edge) {
            return Err(SolidError::Open { edge });
        }
    }
    match all().find(|[from, to]| !edges.contains(&[*to, *from])) {
        Some(edge) => Err(SolidError::Open { edge }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    /// A grid of facets over the faces of a cube, its points mapped.
    fn cube(count: usize, map: impl Fn(Vec3) -> Vec3) -> (Vec<Vec3>, Vec<[NodeId; 4]>) {
        let mut positions: Vec<Vec3> = Vec::new();
        let mut node = |x: Vec3| {
            let known = positions.iter().position(|y| (y - x).norm() < 1e-9);
            NodeId::new(known.unwrap_or_else(|| {
                positions.push(x);
                positions.len() - 1
            }))
        };
        let mut facets = Vec::new();
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let (u, v) = if side > 0.0 {
                    ((axis + 1) % 3, (axis + 2) % 3)
                } else {
                    ((axis + 2) % 3, (axis + 1) % 3)
                };
                let at = |i: usize, j: usize| {
                    let along = |i: usize| 2.0 * i as f64 / count as f64 - 1.0;
                    Vec3::ith(axis, side) + Vec3::ith(u, along(i)) + Vec3::ith(v, along(j))
                };
                for (i, j) in (0..count * count).map(|k| (k % count, k / count)) {
                    let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    facets.push(corners.map(&mut node));
                }
            }
        }
        (positions.into_iter().map(map).collect(), facets)
    }

    fn tensor(inertia: &RigidInertia) -> Matrix3<f64> {
        inertia.axes * Matrix3::from_diagonal(&inertia.moments.into()) * inertia.axes.transpose()
    }

    #[test]
    fn a_turned_box_is_exact() {
        let rotation = Rotation3::new(Vec3::new(0.3, -0.5, 0.8)).into_inner();
        let half = Vec3::new(0.5, 1.0, 1.5);
        let centre = Vec3::new(3.0, -2.0, 7.0);
        let (positions, mut facets) = cube(2, |x| centre + rotation * x.component_mul(&half));
        // Triangles as well.
        let [a, b, c, d] = facets[0];
        facets[0] = [a, b, c, c];
        facets.push([a, c, d, d]);
        let inertia = inertia(&positions, &facets, 2.0).unwrap();
        let mass = 2.0 * 8.0 * half.product();
        assert!((inertia.mass - mass).abs() < 1e-12 * mass);
        assert!((inertia.centre - centre).norm() < 1e-12);
        let squares = half.component_mul(&half) * (mass / 3.0);
        let moments = Vec3::repeat(squares.sum()) - squares;
        let expected = rotation * Matrix3::from_diagonal(&moments) * rotation.transpose();
        assert!(
            (tensor(&inertia) - expected).norm() < 1e-11 * mass,
            "{}",
            tensor(&inertia)
        );
        let at_most = inertia.moments.iter().sum::<f64>();
        assert!(inertia.moments.iter().all(|moment| 2.0 * moment <= at_most));
    }

    #[test]
    fn a_sphere_is_approached_with_the_square_of_the_facets() {
        let radius: f64 = 0.7;
        let errors = [6, 12, 24].map(|count| {
            let (positions, facets) = cube(count, |x| x.normalize() * radius);
            let inertia = inertia(&positions, &facets, 3.0).unwrap();
            let mass = 3.0 * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
            let moment = 0.4 * mass * radius * radius;
            [
                (inertia.mass / mass - 1.0).abs(),
                (tensor(&inertia) / moment - Matrix3::identity()).norm(),
            ]
        });
        for at in 0..2 {
            let errors = errors.map(|error| error[at]);
            for pair in errors.windows(2) {
                let rate = (pair[0] / pair[1]).log2();
                assert!((rate - 2.0).abs() < 0.1, "{rate} {errors:?}");
            }
            assert!(errors[2] < 0.02);
        }
    }

    #[test]
    fn open_and_inward_surfaces_are_refused() {
        let (positions, mut facets) = cube(1, |x| x);
        let inward: Vec<_> = facets.iter().map(|[a, b, c, d]| [*d, *c, *b, *a]).collect();
        let refused = inertia(&positions, &inward, 1.0);
        assert!(matches!(refused, Err(SolidError::InsideOut { volume }) if volume < -7.9));
        facets.pop();
        let refused = inertia(&positions, &facets, 1.0);
        assert!(matches!(refused, Err(SolidError::Open { .. })));
    }
}
