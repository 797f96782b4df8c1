//! Recovery of the Cauchy stress at the nodes.
//!
//! In each element the values at the quadrature points are continued to the corners: in a
//! hexahedron by the trilinear field through them,
//!
//! ```text
//! sigma_a = sum_g N_g(sqrt(3) xi_a) sigma_g.
//! ```
//!
//! At each node the values of its elements are averaged with the reference
//! volumes of the elements as weights (Hinton & Campbell 1974,
//! doi:10.1002/nme.1620080303). Uniform stress is reproduced exactly.

use super::{Driven, ElementFault, Elements};
use nalgebra::Matrix3;
use striae_mesh::{ElementId, Mesh, Vec3};

/// Cauchy stress at every node of a mesh, whose reference elements are `reference`, whose current
/// node positions are `positions`; zero at nodes without an element. `made_of` returns the material
/// of an element and the variables of its quadrature points.
///
/// # Errors
///
/// The first element that is turned inside out.
pub fn nodal_cauchy_stress<'a, D: Into<Driven<'a>>>(
    mesh: &Mesh,
    reference: &Elements,
    positions: &[Vec3],
    made_of: impl Fn(ElementId) -> (D, &'a [f64]),
) -> Result<Vec<Matrix3<f64>>, ElementFault> {
    let (mut stress, volume) = nodal_stress_sums(mesh, reference, positions, made_of)?;
    for (sigma, volume) in stress.iter_mut().zip(volume) {
        if volume > 0.0 {
            *sigma /= volume;
        }
    }
    Ok(stress)
}

/// Sums at every node of what [`nodal_cauchy_stress`] averages: stress times volume, and volume.
/// Sums of the parts of a mesh add up to those of the whole.
///
/// # Errors
///
/// The first element that is turned inside out.
pub fn nodal_stress_sums<'a, D: Into<Driven<'a>>>(
    mesh: &Mesh,
    reference: &Elements,
    positions: &[Vec3],
    made_of: impl Fn(ElementId) -> (D, &'a [f64]),
) -> Result<(Vec<Matrix3<f64>>, Vec<f64>), ElementFault> {
    let mut stress = vec![Matrix3::zeros(); positions.len()];
    let mut volume = vec![0.0; positions.len()];
    for (index, (corners, element)) in mesh.elements().zip(reference.iter()).enumerate() {
        let current: Vec<Vec3> = corners.iter().map(|node| positions[node.index()]).collect();
        let id = ElementId::new(index);
        let (driven, variables) = made_of(id);
        let at_corners = element.corner_stress(&current, driven, variables);
        let at_corners = at_corners.map_err(|error| ElementFault { element: id, error })?;
        for (node, sigma) in corners.iter().zip(at_corners) {
            stress[node.index()] += sigma * element.volume();
            volume[node.index()] += element.volume();
        }
    }
    Ok((stress, volume))
}

/// Equivalent stress of von Mises, `sqrt(3/2 s : s)` with the deviator `s`.
pub fn von_mises(cauchy_stress: &Matrix3<f64>) -> f64 {
    let mean = cauchy_stress.trace() / 3.0;
    let deviator = cauchy_stress - Matrix3::identity() * mean;
    (1.5 * deviator.norm_squared()).sqrt()
}
