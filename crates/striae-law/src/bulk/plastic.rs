//! Metals: plasticity of von Mises for large strains.
//!
//! In the logarithmic elastic strains `e_a` with the deviator `s` of the Kirchhoff stresses
//! and the equivalent plastic strain `p`,
//!
//! ```text
//! W = K/2 (e_1 + e_2 + e_3)^2 + G |dev e|^2
//! tau_a = K (e_1 + e_2 + e_3) + 2 G dev e_a
//! |s| <= sqrt(2/3) Y(p) ,   de_p = g s/|s| ,   dp = sqrt(2/3) g ,   g >= 0
//! ```
//!
//! integrated by the exponential map: with the strains `e` for the flow before and
//! `s = 2 G dev e`, the deviator shrinks along itself,
//!
//! ```text
//! |s| - 2 G g = sqrt(2/3) Y(p + sqrt(2/3) g) ,   b = 1 - 2 G g/|s| ,   n = s/|s|
//! T = K 1 1 + 2 G b (I - 1 1/3) + 2 G (1 - b - 2 G/(2 G + 2/3 Y')) n n
//! ```
//!
//! Plastic flow keeps the volume exactly. The plastic work, the integral of `Y` over `p`,
//! counts as dissipated. Loading along fixed axes is exact for increments of any size.
//!
//! Sources: Simo, Comput. Methods Appl. Mech. Eng. 99 (1992) 61-112,
//! doi:10.1016/0045-7825(92)90123-2; Weber & Anand, Comput. Methods Appl. Mech. Eng. 79
//! (1990) 173-202, doi:10.1016/0045-7825(90)90131-5.

use super::hardening::HARDENING;
use super::spectrum::{FLOW, Spectrum};
use super::{
    ELASTIC_CONSTANTS, Field, Hardening, LameConstants, Law, Material, Past, Present, Response,
    ResponseError, Tangent,
};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;
use striae_declared::Declared;

/// The law.
pub static ELASTIC_PLASTIC: Declared<Material> = Declared {
    name: "elastic-plastic",
    summary: "Metal with von Mises plasticity and isotropic hardening, for large strains.",
    parameters: &[ELASTIC_CONSTANTS, HARDENING],
    build: |values| {
        let constants = LameConstants::stated(values)?;
        let hardening = Hardening::stated(values)?;
        Ok(Material::plastic(Plastic::new(constants, hardening)))
    },
    fit: None,
};

impl Material {
    /// Metal that yields.
    pub fn plastic(law: Plastic) -> Self {
        let values = law.constants.values().followed_by(law.hardening.values());
        Self::new(Law::Plastic(law), Some(ELASTIC_PLASTIC.stated(values)))
    }
}

/// An elastic solid that yields.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plastic {
    constants: LameConstants,
    hardening: Hardening,
}

impl Plastic {
    /// With elastic constants and the yield stress over the plastic strain.
    pub fn new(constants: LameConstants, hardening: Hardening) -> Self {
        Self {
            constants,
            hardening,
        }
    }

    /// The yield stress.
    pub fn hardening(&self) -> &Hardening {
        &self.hardening
    }

    /// The elastic constants.
    pub fn lame_constants(&self) -> LameConstants {
        self.constants
    }

    /// The flow, then the equivalent plastic strain.
    pub(super) fn variables(&self) -> usize {
        FLOW + 1
    }

    /// `equivalent_plastic_strain`.
    pub(super) fn fields(&self) -> Vec<Field> {
        vec![Field {
            name: "equivalent_plastic_strain".to_owned(),
            variable: FLOW,
        }]
    }

    pub(super) fn respond(
        &self,
        f: &Matrix3<f64>,
        past: Past,
        present: &mut Present,
    ) -> Result<Response, ResponseError> {
        let (flow, plastic) = past.variables.split_at(FLOW);
        let spectrum = Spectrum::new(f, flow)?;
        let returned = self.returned(&spectrum.strains, plastic[0]);
        let mut response = Response {
            energy: returned.energy,
            first_piola: Matrix3::zeros(),
            tangent: Tangent::zeros(),
        };
        spectrum.add(&returned.stresses, &returned.slopes, &mut response);
        // The eigenvectors leave it symmetric to round-off only.
        response.tangent = (response.tangent + response.tangent.transpose()) * 0.5;
        let (new_flow, new_plastic) = present.variables.split_at_mut(FLOW);
        if returned.strain > plastic[0] {
            spectrum.flow(&returned.strains, new_flow);
        } else {
            new_flow.copy_from_slice(flow);
        }
        new_plastic[0] = returned.strain;
        present.dissipated = self.hardening.work(plastic[0], returned.strain);
        Ok(response)
    }

    /// The strains `e` before the flow, returned to the yield surface.
    #[allow(non_snake_case)]
    fn returned(&self, e: &Vector3<f64>, plastic: f64) -> Returned {
        let LameConstants { lambda, shear: G } = self.constants;
        let (K, volume) = (lambda + 2.0 / 3.0 * G, e.sum());
        let deviator = e.add_scalar(-volume / 3.0);
        let s = deviator.norm();
        let flowed = self.hardening.flow(2.0 * G * s, G, plastic);
        let share = flowed.map_or(1.0, |flowed| 1.0 - flowed / s);
        let strain = plastic + (2.0f64 / 3.0).sqrt() * flowed.unwrap_or(0.0);
        let mut slopes = Matrix3::repeat(K - 2.0 / 3.0 * G * share);
        slopes += Matrix3::identity() * (2.0 * G * share);
        if flowed.is_some() {
            let n = deviator / s;
            let slope = self.hardening.slope(strain);
            let along = 1.0 - share - G / (G + slope / 3.0);
            slopes += n * n.transpose() * (2.0 * G * along);
        }
        let elastic = deviator * share;
        Returned {
            strains: elastic.add_scalar(volume / 3.0),
            stresses: (elastic * (2.0 * G)).add_scalar(K * volume),
            slopes,
            energy: 0.5 * K * volume * volume + G * elastic.norm_squared(),
            strain,
        }
    }
}

/// Result of a return to the yield surface.
struct Returned {
    /// Elastic strains.
    strains: Vector3<f64>,
    stresses: Vector3<f64>,
    /// Derivatives of the stresses by the strains before the flow.
    slopes: Matrix3<f64>,
    energy: f64,
    /// Equivalent plastic strain.
    strain: f64,
}
