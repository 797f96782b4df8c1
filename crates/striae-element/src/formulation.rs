//! Formulations of elements.

use serde::Serialize;
use striae_law::bulk::Material;

/// Formulation of the elements of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Formulation {
    /// By displacements alone, all of the deformation gradient at every point. Locks
    /// where volumes can hardly change.
    Standard,
    /// With pressure and volume ratio constant in the element. Linear tetrahedra are
    /// the same without it: they lock.
    MeanDilatation,
    /// Hexahedra with a deformation gradient that is enhanced for bending; cells of other kinds
    /// as [`Formulation::Standard`]. A response takes about seven times as long.
    AssumedStrain,
}

/// Poisson's ratio above which elements with displacements alone are too stiff.
const LOCKING: f64 = 0.45;
/// Difference from it that is round-off of the elastic constants, of which others are computed.
const ROUND_OFF: f64 = 1e-9;

impl Formulation {
    /// Formulation suited to a material: mean dilatation above a Poisson's ratio of 0.45 and for
    /// materials that yield, as plastic flow preserves the volume.
    pub fn suited_to(material: &Material) -> Self {
        if material.yields() {
            return Self::MeanDilatation;
        }
        let constants = material.lame_constants();
        let poissons_ratio = 0.5 * constants.lambda / (constants.lambda + constants.shear);
        if poissons_ratio > LOCKING + ROUND_OFF {
            Self::MeanDilatation
        } else {
            Self::Standard
        }
    }
}

#[cfg(test)]
mod tests {
    use striae_law::bulk::LameConstants;

    use super::*;

    #[test]
    fn round_off_of_the_modulus_decides_nothing() {
        let suited = |modulus: f64, ratio: f64| {
            let constants = LameConstants::from_youngs_modulus(modulus, ratio).unwrap();
            Formulation::suited_to(&Material::linear_elastic(constants))
        };
        for step in 0..1000 {
            let modulus = 1.7e6 + 101.3 * f64::from(step);
            assert_eq!(suited(modulus, LOCKING), Formulation::Standard, "{modulus}");
            assert_eq!(suited(modulus, 0.451), Formulation::MeanDilatation);
        }
    }
}
