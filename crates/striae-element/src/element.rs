//! A single element of a mesh: what its block answers for it.

use super::{Actuation, Driven, ElementBlock, ElementError, ElementResponse, Mass};
use nalgebra::Matrix3;
use striae_law::bulk::Past;
use striae_mesh::{CellKind, Vec3};

/// One element.
#[derive(Clone, Copy, Debug)]
pub struct Element<'a> {
    pub(super) block: &'a dyn ElementBlock,
    pub(super) at: usize,
}

impl Element<'_> {
    /// See [`ElementBlock::respond`].
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub fn response<'d>(
        &self,
        x: &[Vec3],
        driven: impl Into<Driven<'d>>,
        past: Past,
    ) -> Result<ElementResponse, ElementError> {
        let driven = driven.into();
        let mut response = ElementResponse::zero(self.block, driven.material);
        let block = self.block;
        block.respond(self.at, x, &driven, past, &mut response)?;
        Ok(response)
    }

    /// Energy stored in the state that the points remember.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub fn stored_energy<'d>(
        &self,
        x: &[Vec3],
        driven: impl Into<Driven<'d>>,
        variables: &[f64],
    ) -> Result<f64, ElementError> {
        let elapsed = 0.0;
        let past = Past { variables, elapsed };
        Ok(self.response(x, driven, past)?.energy)
    }

    /// See [`ElementBlock::work`].
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub fn work<'d>(
        &self,
        x: &[Vec3],
        driven: impl Into<Driven<'d>>,
        variables: &[f64],
        change: &Actuation,
    ) -> Result<f64, ElementError> {
        let driven = driven.into();
        self.block.work(self.at, x, &driven, variables, change)
    }

    /// Number of quadrature points.
    pub fn points(&self) -> usize {
        self.block.points()
    }

    /// Mean of a variable over the volume.
    pub fn mean(&self, variables: &[f64], variable: usize) -> f64 {
        let weights = self.block.weights(self.at);
        let each = variables.len() / weights.len();
        let values = variables.iter().skip(variable).step_by(each);
        let sum: f64 = values
            .zip(weights)
            .map(|(value, weight)| value * weight)
            .sum();
        sum / self.volume()
    }

    /// See [`ElementBlock::mass`].
    pub fn mass(&self, density: f64) -> Mass {
        self.block.mass(self.at, density)
    }

    /// See [`ElementBlock::volume`].
    pub fn volume(&self) -> f64 {
        self.block.volume(self.at)
    }

    /// See [`ElementBlock::stiffness_per_modulus`].
    pub fn stiffness_per_modulus(&self) -> f64 {
        self.block.stiffness_per_modulus(self.at)
    }

    /// See [`ElementBlock::rotation`].
    pub fn rotation(&self, x: &[Vec3]) -> f64 {
        self.block.rotation(self.at, x)
    }

    /// See [`ElementBlock::stress`].
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub fn stress<'d>(
        &self,
        x: &[Vec3],
        driven: impl Into<Driven<'d>>,
        variables: &[f64],
    ) -> Result<Vec<Matrix3<f64>>, ElementError> {
        self.block.stress(self.at, x, &driven.into(), variables)
    }

    /// See [`ElementBlock::corner_stress`].
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub fn corner_stress<'d>(
        &self,
        x: &[Vec3],
        driven: impl Into<Driven<'d>>,
        variables: &[f64],
    ) -> Result<Vec<Matrix3<f64>>, ElementError> {
        let driven = driven.into();
        self.block.corner_stress(self.at, x, &driven, variables)
    }

    /// Kind of the element.
    pub fn kind(&self) -> CellKind {
        self.block.kind()
    }
}
