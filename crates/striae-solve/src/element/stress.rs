//! Recovery of the Cauchy stress at the nodes.
//!
//! In each element the trilinear field through the values at the Gauss points
//! is continued to the corners,
//!
//! ```text
//! sigma_a = sum_g N_g(sqrt(3) xi_a) sigma_g
//! ```
//!
//! and at each node the values of its elements are averaged with the reference
//! volumes of the elements as weights (Hinton & Campbell 1974,
//! doi:10.1002/nme.1620080303). Uniform stress is reproduced exactly.

use super::response::error_at;
use super::shape::{CORNERS, shape};
use super::{ElementError, ElementFault, ReferenceElement};
use nalgebra::Matrix3;
use striae_law::bulk::Material;
use striae_mesh::{ElementId, Mesh, Vec3};

/// Cauchy stress at every node of a mesh, whose reference elements are
/// `reference` and whose current node positions are `positions`; zero at nodes
/// without an element.
///
/// # Errors
///
/// The first element that is turned inside out.
pub fn nodal_cauchy_stress(
    mesh: &Mesh,
    reference: &[ReferenceElement],
    positions: &[Vec3],
    material: &Material,
) -> Result<Vec<Matrix3<f64>>, ElementFault> {
    let mut stress = vec![Matrix3::zeros(); positions.len()];
    let mut volume = vec![0.0; positions.len()];
    for (index, (corners, element)) in mesh.elements.iter().zip(reference).enumerate() {
        let current = corners.map(|node| positions[node.index()]);
        let at_corners =
            element
                .corner_stress(&current, material)
                .map_err(|error| ElementFault {
                    element: ElementId::new(index),
                    error,
                })?;
        for (node, sigma) in corners.iter().zip(at_corners) {
            stress[node.index()] += sigma * element.volume();
            volume[node.index()] += element.volume();
        }
    }
    for (sigma, volume) in stress.iter_mut().zip(volume) {
        if volume > 0.0 {
            *sigma /= volume;
        }
    }
    Ok(stress)
}

/// Equivalent stress of von Mises, `sqrt(3/2 s : s)` with the deviator `s`.
pub fn von_mises(cauchy_stress: &Matrix3<f64>) -> f64 {
    let mean = cauchy_stress.trace() / 3.0;
    let deviator = cauchy_stress - Matrix3::identity() * mean;
    (1.5 * deviator.norm_squared()).sqrt()
}

impl ReferenceElement {
    /// Cauchy stress at the Gauss points for current corner positions `x`.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub fn gauss_stress(
        &self,
        current: &[Vec3; 8],
        material: &Material,
    ) -> Result<[Matrix3<f64>; 8], ElementError> {
        let mut stress = [Matrix3::zeros(); 8];
        for (g, sigma) in stress.iter_mut().enumerate() {
            let f = self.deformation_gradient(g, current);
            *sigma = material.cauchy_stress(&f).map_err(error_at(g))?;
        }
        Ok(stress)
    }

    /// Cauchy stress continued from the Gauss points to the corners.
    fn corner_stress(
        &self,
        current: &[Vec3; 8],
        material: &Material,
    ) -> Result<[Matrix3<f64>; 8], ElementError> {
        let at_gauss_points = self.gauss_stress(current, material)?;
        Ok(CORNERS.map(|corner| {
            let weights = shape(&(Vec3::from(corner) * 3f64.sqrt()));
            (0..8).map(|g| at_gauss_points[g] * weights[g]).sum()
        }))
    }
}
