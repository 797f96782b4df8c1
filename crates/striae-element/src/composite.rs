//! The composite tetrahedron of ten nodes: displacements linear in twelve parts, a deformation
//! gradient linear in the whole.
//!
//! In part `s` with the reference volume `V_s` the displacements of the ten nodes have the
//! constant gradients `G_a^s` (functions: `striae_mesh`, `cell/composite.rs`). The deformation
//! gradient of the element is their projection on linear fields, taken at four points,
//!
//! ```text
//! psi_g = (l_g - n)/(1 - 4 n),   n = (5 - sqrt(5))/20          1 at point g, 0 at the others
//! w_g   = sum_s V_s psi_g(middle of s)                         = int psi_g dV
//! G_ga  = sum_s V_s psi_g(middle of s) G_a^s / w_g             F_g = sum_a x_a (x) G_ga
//! ```
//!
//! (Thoutireddy et al., Int. J. Numer. Methods Eng. 53 (2002) 1337, doi:10.1002/nme.337;
//! Ostien et al., ibid. 107 (2016) 1145, doi:10.1002/nme.5218). The points are those of the
//! rule of degree two of the linear tetrahedron. Where edges are straight and their nodes are in
//! the middle, `int psi_g psi_h dV = w_g d_gh`, so that this is the projection by least squares
//! of these sources. Elsewhere it is the same with the scalar product taken at the points:
//! constant gradients stay what they are, and `sum_g w_g F_g = int F dV`, which is what both
//! patch tests ask for. A rank of 24 leaves the six rigid motions alone.
//!
//! From there on the element is one of ten corners and four points. With
//! [`Formulation::MeanDilatation`](super::Formulation) the volume part is averaged over the
//! element (`dilatation.rs`), as Ostien et al. do. Averaged completely the rank is 21, and three
//! motions cost nothing; the element goes
//!
//! ```text
//! beta = 1 - min(1, sqrt(c mu / kappa)),   c = 1, or 1/100 in a material that yields,
//! ```
//!
//! of the way instead, `mu` and `kappa` at rest: what differs from the mean is resisted by the
//! modulus `(1 - beta)^2 kappa = c mu`, as a change of shape, however large `kappa` is.
//!
//! Mass is that of the parts, `m_ab = rho V_s (1 + d_ab)/20` with the corners of a part, exact
//! for the displacements; what belongs to the middle goes in equal parts to its six nodes.

use super::{ElementError, mass::Mass, reference::Reference};
use nalgebra::Matrix3;
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{COMPOSITE_PARTS, CellKind, Vec3, composite_linear};

/// Nodes.
pub(super) const NODES: usize = 10;
/// Quadrature points.
pub(super) const POINTS: usize = 4;
/// Reference volumes of the parts.
pub(super) type Parts = [f64; COMPOSITE_PARTS.len()];

/// The element with the reference positions `X`, and the volumes of its parts.
///
/// # Errors
///
/// [`ElementError::Degenerate`] where a part, or the volume of a point, is not positive.
pub(super) fn reference(
    corners: &[Vec3; NODES],
) -> Result<(Reference<NODES, POINTS>, Parts), ElementError> {
    let mut volumes = Parts::default();
    let mut weights = [0.0; POINTS];
    let mut gradients = [[[0.0; NODES]; 3]; POINTS];
    let points = CellKind::CompositeTetrahedron.shape().points;
    for (part, (middle, _)) in points.iter().enumerate() {
        let (determinant, of_nodes) = slopes(corners, part)?;
        volumes[part] = determinant / 6.0;
        for (g, value) in composite_linear(&Vec3::from(*middle))
            .into_iter()
            .enumerate()
        {
            let share = volumes[part] * value;
            weights[g] += share;
            for (a, slope) in of_nodes.iter().enumerate() {
                (0..3).for_each(|j| gradients[g][j][a] += share * slope[j]);
            }
        }
    }
    for (point, (all, &weight)) in gradients.iter_mut().zip(&weights).enumerate() {
        if weight <= 0.0 {
            let determinant = 6.0 * weight;
            return Err(ElementError::Degenerate { point, determinant });
        }
        all.as_flattened_mut().iter_mut().for_each(|g| *g /= weight);
    }
    Ok((Reference { gradients, weights }, volumes))
}

/// Fraction by which the volume ratios at the points are averaged.
pub(super) fn share(material: &Material) -> f64 {
    let LameConstants { lambda, shear } = material.lame_constants();
    let factor = match material.yields() {
        true => 0.01,
        false => 1.0,
    };
    1.0 - (factor * shear / (lambda + 2.0 * shear / 3.0))
        .sqrt()
        .min(1.0)
}

/// The linear field through the values at the points, at the nodes.
pub(super) fn recovery() -> [[f64; POINTS]; NODES] {
    let corners = CellKind::CompositeTetrahedron.shape().corners;
    std::array::from_fn(|a| composite_linear(&Vec3::from(corners[a])))
}

/// The mass matrix from the volumes of the parts.
pub(super) fn mass(parts: &Parts, density: f64) -> Mass {
    let mut mass = Mass::default();
    for (nodes, volume) in COMPOSITE_PARTS.iter().zip(parts) {
        for (place, &a) in nodes.iter().enumerate() {
            for (other, &b) in nodes.iter().enumerate() {
                let factor = if place == other { 0.1 } else { 0.05 };
                let (first, second) = (shares(a), shares(b));
                let part = density * volume * factor / (first.len() * second.len()) as f64;
                for a in first.clone() {
                    second.clone().for_each(|b| mass[a][b] += part);
                }
            }
        }
    }
    mass
}

/// The nodes that a node of a part stands for.
fn shares(node: usize) -> std::ops::Range<usize> {
    match node {
        NODES => 4..NODES,
        node => node..node + 1,
    }
}

/// Six times the volume of a part, and the gradients `G_a^s` of the nodes in it.
fn slopes(corners: &[Vec3; NODES], part: usize) -> Result<(f64, [Vec3; NODES]), ElementError> {
    let centre = corners[4..].iter().sum::<Vec3>() / 6.0;
    let nodes = COMPOSITE_PARTS[part];
    let [a, b, c, d] = nodes.map(|node| corners.get(node).copied().unwrap_or(centre));
    let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
    let determinant = edges.determinant();
    let inverse = edges.try_inverse().filter(|_| determinant > 0.0);
    let Some(inverse) = inverse else {
        let point = part;
        return Err(ElementError::Degenerate { point, determinant });
    };
    let ends = [0, 1, 2].map(|row| inverse.row(row).transpose());
    let start = -ends.iter().sum::<Vec3>();
    let mut of_nodes = [Vec3::zeros(); NODES];
    for (node, slope) in nodes.into_iter().zip([start].into_iter().chain(ends)) {
        let share = 1.0 / shares(node).len() as f64;
        shares(node).for_each(|a| of_nodes[a] += slope * share);
    }
    Ok((determinant, of_nodes))
}
