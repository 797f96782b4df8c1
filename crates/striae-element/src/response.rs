//! Stored energy, internal force and consistent stiffness of an element.

use super::{
    ElementError, Stiffness, actuation::Law, compact::Compact, deformation::by_components,
    fault::error_at, reference::Reference, tangent::Tangents,
};
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use striae_law::bulk::{Past, Present, Response, ResponseError, Tangent};
use striae_mesh::Vec3;

/// Energy of an element with its first and second derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementResponse {
    /// Stored energy.
    pub energy: f64,
    /// Internal force on every corner, the derivative of the energy by its position.
    pub force: Vec<[f64; 3]>,
    /// Derivative of the force, symmetric to the last bit.
    pub stiffness: Stiffness,
    /// Energy that has been dissipated since the last converged state.
    pub dissipated: f64,
    /// New internal variables of the quadrature points, one point after the other.
    pub variables: Vec<f64>,
}

/// Answer of a law at a point.
pub(super) type Answer<T> = Result<Response<T>, ResponseError>;

impl ElementResponse {
    /// Storage for the new state of one of `count` points.
    pub(super) fn present(&mut self, point: usize, count: usize) -> Present<'_> {
        let each = self.variables.len() / count;
        Present {
            variables: &mut self.variables[point * each..(point + 1) * each],
            dissipated: 0.0,
        }
    }

    /// Takes over a force by components.
    #[inline(always)]
    pub(super) fn set_force<const N: usize>(&mut self, [x, y, z]: &[[f64; N]; 3]) {
        for (a, force) in self.force.iter_mut().enumerate() {
            *force = [x[a], y[a], z[a]];
        }
    }
}

impl<const N: usize, const Q: usize> Reference<N, Q> {
    /// Response to current corner positions `x`, written over an older one.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub(super) fn respond(
        &self,
        current: &[Vec3; N],
        law: &Law,
        past: Past,
        element: &mut ElementResponse,
    ) -> Result<(), ElementError> {
        match law.compact_response() {
            Some(law) => self.respond_by::<Compact<Q>>(current, element, |_, f, _| law(f)),
            None => self.respond_by::<[Tangent; Q]>(current, element, |g, f, present| {
                law.respond(f, past.of_point(g, Q), present)
            }),
        }
    }

    /// The response where the `law` answers at a point.
    fn respond_by<T: Tangents<Q>>(
        &self,
        current: &[Vec3; N],
        element: &mut ElementResponse,
        law: impl Fn(usize, &Matrix3<f64>, &mut Present) -> Answer<T::OfLaw>,
    ) -> Result<(), ElementError> {
        let mut tangents = T::unknown();
        let gradients = self.deformation_gradients(current);
        let stresses = self.answers(&gradients, element, law, &mut tangents)?;
        self.sum(&stresses, &tangents, element);
        Ok(())
    }

    /// The stresses with which the `law` answers to deformation gradients, and its tangents;
    /// sums up energies.
    pub(super) fn answers<T: Tangents<Q>>(
        &self,
        gradients: &[Matrix3<f64>; Q],
        element: &mut ElementResponse,
        law: impl Fn(usize, &Matrix3<f64>, &mut Present) -> Answer<T::OfLaw>,
        tangents: &mut T,
    ) -> Result<[Matrix3<f64>; Q], ElementError> {
        let mut stresses = [Matrix3::zeros(); Q];
        (element.energy, element.dissipated) = (0.0, 0.0);
        for (g, f) in gradients.iter().enumerate() {
            let mut present = element.present(g, Q);
            let response = law(g, f, &mut present);
            let dissipated = present.dissipated;
            let response = response.map_err(error_at(g))?;
            element.energy += self.weights[g] * response.energy;
            element.dissipated += self.weights[g] * dissipated;
            stresses[g] = response.first_piola;
            tangents.set(g, &response.tangent);
        }
        Ok(stresses)
    }

    /// Force and stiffness from the stresses and tangents at the quadrature points.
    pub(super) fn sum<T: Tangents<Q>>(
        &self,
        stresses: &[Matrix3<f64>; Q],
        tangents: &T,
        element: &mut ElementResponse,
    ) {
        Arch::new().dispatch(Sum {
            reference: self,
            stresses,
            tangents,
            element,
        });
    }
}

/// Force and stiffness, by as many lanes as the processor has.
struct Sum<'a, T, const N: usize, const Q: usize> {
    reference: &'a Reference<N, Q>,
    stresses: &'a [Matrix3<f64>; Q],
    tangents: &'a T,
    element: &'a mut ElementResponse,
}

impl<T: Tangents<Q>, const N: usize, const Q: usize> WithSimd for Sum<'_, T, N, Q> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let mut stresses = by_components(self.stresses);
        for component in &mut stresses {
            for g in 0..Q {
                component[g] *= self.reference.weights[g];
            }
        }
        self.element.set_force(&self.reference.gathered(&stresses));
        let none = |_, _| ([], []);
        let blocks = self.element.stiffness.blocks_mut();
        self.tangents.stiffness(self.reference, none, blocks);
    }
}
