//! Elastic constants of isotropic materials.
//!
//! ```text
//! lambda = E nu / ((1 + nu)(1 - 2 nu)),   G = E / (2 (1 + nu))
//! E = G (3 lambda + 2 G) / (lambda + G),  nu = lambda / (2 (lambda + G))
//! ```
//!
//! The elasticity tensor is positive definite iff `E > 0` and `-1 < nu < 1/2`.

use serde::Serialize;

use striae_declared::{ANY, NO_UNIT, POISSONS_RATIO, POSITIVE, Parameter, Set, Values};

/// Parameters of laws with two elastic constants; [`LameConstants::stated`] reads them.
pub const ELASTIC_CONSTANTS: Parameter = Parameter::one_of(
    "elastic_constants",
    &[
        Set {
            doc: "Young's modulus and Poisson's ratio.",
            parameters: &[
                Parameter::number(
                    "youngs_modulus",
                    POSITIVE,
                    "force per area",
                    "Young's modulus at small strain.",
                ),
                Parameter::number(
                    "poissons_ratio",
                    POISSONS_RATIO,
                    NO_UNIT,
                    "Poisson's ratio at small strain.",
                ),
            ],
        },
        Set {
            doc: "Lame's constants.",
            parameters: &[
                Parameter::number(
                    "lambda",
                    ANY,
                    "force per area",
                    "First Lame constant; the bulk modulus, `lambda + 2/3 shear_modulus`, must be positive.",
                ),
                Parameter::number(
                    "shear_modulus",
                    POSITIVE,
                    "force per area",
                    "Shear modulus.",
                ),
            ],
        },
    ],
);

/// The pair of Lame constants.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LameConstants {
    /// First Lame constant `lambda`.
    pub lambda: f64,
    /// Shear modulus `G`.
    pub shear: f64,
}

/// Elastic constants for which the material would not be stable.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum InadmissibleModuli {
    /// Young's modulus must be positive.
    #[error("Young's modulus is {0}, but it must be positive and finite")]
    YoungsModulus(f64),
    /// Poisson's ratio must lie between -1 and 1/2.
    #[error("Poisson's ratio is {0}, but it must be above -1 and below 0.5")]
    PoissonsRatio(f64),
    /// The bulk modulus must be positive.
    #[error(
        "`lambda` = {lambda} and `shear_modulus` = {shear} give a bulk modulus that is not positive"
    )]
    BulkModulus {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus.
        shear: f64,
    },
}

impl LameConstants {
    /// The constants that the values of [`ELASTIC_CONSTANTS`] state.
    ///
    /// # Errors
    ///
    /// When the material would not be stable.
    pub fn stated(values: &Values) -> Result<Self, InadmissibleModuli> {
        let Some(youngs_modulus) = values.number_if_any("youngs_modulus") else {
            let [lambda, shear] = ["lambda", "shear_modulus"].map(|name| values.number(name));
            if 3.0 * lambda + 2.0 * shear <= 0.0 {
                return Err(InadmissibleModuli::BulkModulus { lambda, shear });
            }
            return Ok(Self { lambda, shear });
        };
        Self::from_youngs_modulus(youngs_modulus, values.number("poissons_ratio"))
    }

    /// Values that state the constants.
    pub(super) fn values(&self) -> Values {
        [("lambda", self.lambda), ("shear_modulus", self.shear)].into()
    }

    /// From Young's modulus `E` and Poisson's ratio `nu`.
    ///
    /// # Errors
    ///
    /// If `E` is not positive or `nu` is outside `(-1, 1/2)`.
    pub fn from_youngs_modulus(
        youngs_modulus: f64,
        poissons_ratio: f64,
    ) -> Result<Self, InadmissibleModuli> {
        if !(youngs_modulus > 0.0 && youngs_modulus.is_finite()) {
            return Err(InadmissibleModuli::YoungsModulus(youngs_modulus));
        }
        if !(poissons_ratio > -1.0 && poissons_ratio < 0.5) {
            return Err(InadmissibleModuli::PoissonsRatio(poissons_ratio));
        }
        let shear = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
        Ok(Self {
            lambda: 2.0 * shear * poissons_ratio / (1.0 - 2.0 * poissons_ratio),
            shear,
        })
    }

    /// Young's modulus `E`.
    pub fn youngs_modulus(&self) -> f64 {
        self.shear * (3.0 * self.lambda + 2.0 * self.shear) / (self.lambda + self.shear)
    }

    /// Poisson's ratio `nu`.
    pub fn poissons_ratio(&self) -> f64 {
        self.lambda / (2.0 * (self.lambda + self.shear))
    }
}
