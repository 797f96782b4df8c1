//! Interpolation of directions along the edges of a surface.
//!
//! Inverse multiquadric: with the distance `r` along edges from each painted node `k`,
//!
//! ```text
//! A(X_I) = sum_k phi(r_Ik) c_k,    phi(r) = 1/sqrt(1 + (r/beta)^2),    sum_l phi(r_kl) c_l = A_k
//! ```
//!
//! (paper, equation (48); R. L. Hardy, "Multiquadric equations of topography", J. Geophys.
//! Res. 76 (1971), doi:10.1029/JB076i008p01905). With Euclidean distances the matrix is
//! positive definite for any width; with distances along edges it is so for small `beta`
//! only. Four corners of a square of side `L`, at distances `L` and `2 L`, have the
//! eigenvalue `1 + phi(2 L) - 2 phi(L)`: it is `-0.08` for the paper's `beta = D`, the diameter
//! of the graph. Then the interpolant oscillates wildly. With the default `beta = D/4` it is
//! `0.35`. The more places, the smaller `beta` must be; in every case an indefinite kernel is
//! refused.
//!
//! `D` is estimated by the largest distance from a painted node: between half the diameter of
//! the graph and all of it. All matrices are dense, of the number of painted nodes.

use nalgebra::{DMatrix, SymmetricEigen};
use striae_mesh::Vec3;

use super::TextureError;
use crate::{graph::EdgeGraph, node::SurfaceNode};

/// Smallest eigenvalue, relative to the largest, of a kernel that counts as positive definite.
const DEFINITE: f64 = 1e-12;

/// Conditioning of the directions between painted places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conditioning {
    /// Every node has its own direction; nothing was interpolated.
    Given,
    /// Directions were interpolated from some nodes.
    Interpolated {
        /// Estimated diameter `D` of the edge graph.
        diameter: f64,
        /// Width `beta` that was used.
        width: f64,
        /// Smallest eigenvalue of the kernel matrix, whose diagonal is 1.
        smallest_eigenvalue: f64,
        /// Its condition number.
        condition: f64,
        /// Largest length of the interpolated vectors between unit vectors; well above 1, they
        /// oscillate.
        amplitude: f64,
    },
}

/// Directions at all nodes from unit directions at `places`, of which no two are the same node.
pub(super) fn interpolate(
    graph: &EdgeGraph,
    places: &[(SurfaceNode, Vec3)],
    width: Option<f64>,
) -> Result<(Vec<Vec3>, Conditioning), TextureError> {
    let distances: Vec<Vec<f64>> = (places.iter())
        .map(|(node, _)| graph.distances_from(*node))
        .collect();
    let diameter = diameter(&distances)?;
    let width = width.unwrap_or(diameter / 4.0);
    if !(width > 0.0 && width.is_finite()) {
        return Err(TextureError::Width { width });
    }
    let between = DMatrix::from_fn(places.len(), places.len(), |k, l| {
        distances[k.min(l)][places[k.max(l)].0]
    });
    let kernel = definite_kernel(&between, width)?;
    let painted = DMatrix::from_fn(places.len(), 3, |k, i| places[k].1[i]);
    let scaled = DMatrix::from_diagonal(&kernel.eigenvalues.map(f64::recip));
    let coefficients = &kernel.eigenvectors * scaled * kernel.eigenvectors.transpose() * painted;
    let directions: Vec<Vec3> = (0..distances[0].len())
        .map(|node| {
            (distances.iter().zip(coefficients.row_iter()))
                .map(|(from, c)| Vec3::new(c[0], c[1], c[2]) * phi(from[node], width))
                .sum()
        })
        .collect();
    let conditioning = Conditioning::Interpolated {
        diameter,
        width,
        smallest_eigenvalue: kernel.eigenvalues.min(),
        condition: kernel.eigenvalues.max() / kernel.eigenvalues.min(),
        amplitude: directions.iter().map(Vec3::norm).fold(0.0, f64::max),
    };
    Ok((directions, conditioning))
}

/// Largest distance from a painted node, if every node is connected with one.
fn diameter(distances: &[Vec<f64>]) -> Result<f64, TextureError> {
    let nodes = distances.first().ok_or(TextureError::NothingPainted)?.len();
    if let Some(node) = (0..nodes).find(|&i| distances.iter().all(|from| from[i].is_infinite())) {
        return Err(TextureError::Unpainted {
            node: SurfaceNode::new(node),
        });
    }
    let finite = distances.iter().flatten().filter(|r| r.is_finite());
    Ok(finite.copied().fold(0.0, f64::max))
}

/// Eigenvalues and vectors of the kernel matrix, if it is positive definite.
fn definite_kernel(
    between: &DMatrix<f64>,
    width: f64,
) -> Result<SymmetricEigen<f64, nalgebra::Dyn>, TextureError> {
    let kernel = |width: f64| SymmetricEigen::new(between.map(|r| phi(r, width)));
    let definite = |kernel: &SymmetricEigen<f64, nalgebra::Dyn>| {
        kernel.eigenvalues.min() > DEFINITE * kernel.eigenvalues.max()
    };
    let wanted = kernel(width);
    if definite(&wanted) {
        return Ok(wanted);
    }
    // Ends, because the kernel tends to the identity.
    let mut advice = width / 2.0;
    while !definite(&kernel(advice)) {
        advice /= 2.0;
    }
    Err(TextureError::IndefiniteKernel {
        width,
        smallest_eigenvalue: wanted.eigenvalues.min(),
        advice,
    })
}

/// Inverse multiquadric; zero at infinite distance.
fn phi(distance: f64, width: f64) -> f64 {
    (1.0 + (distance / width).powi(2)).sqrt().recip()
}
