//! Bulk materials.

use crate::{
    faults::{FaultList, Span},
    raw,
    read::At,
};
use striae_law::bulk::{
    Hyperelastic, InadmissibleHyperelastic, Isochoric, LameConstants, Material, OgdenTerm,
    Volumetric,
};
use striae_model::FaultKind as ModelFault;

/// A material, or `None` after its faults have been noted.
pub(super) fn material(
    raw: &raw::Material,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<Material> {
    let law = raw.law.as_ref()?;
    match law {
        raw::BulkLaw::NeoHookean(law) => {
            let constants = lame_constants(law.constants.as_ref()?, faults)?;
            let volumetric = volumetric(law.volumetric.as_ref());
            Some(Material::neo_hookean_with(constants, volumetric))
        }
        raw::BulkLaw::LinearElastic(law) => {
            let constants = lame_constants(law.constants.as_ref()?, faults)?;
            Some(Material::linear_elastic(constants))
        }
        _ => rubber(law)?
            .map(Material::Hyperelastic)
            .map_err(|error| {
                let cause = error.to_string();
                faults.push(span, ModelFault::Material { cause });
            })
            .ok(),
    }
}

/// The rubber, or `None` where a constant could not be read.
fn rubber(law: &raw::BulkLaw) -> Option<Result<Hyperelastic, InadmissibleHyperelastic>> {
    let (isochoric, compressibility, form) = match law {
        raw::BulkLaw::NeoHookean(_) | raw::BulkLaw::LinearElastic(_) => return None,
        raw::BulkLaw::IsochoricNeoHookean(law) => {
            let shear = law.shear_modulus.as_ref()?.value.0;
            let isochoric = Isochoric::NeoHookean { shear };
            (isochoric, &law.compressibility, &law.volumetric)
        }
        raw::BulkLaw::MooneyRivlin(law) => {
            let isochoric = Isochoric::MooneyRivlin {
                c10: law.c10.as_ref()?.value.0,
                c01: law.c01.as_ref()?.value.0,
            };
            (isochoric, &law.compressibility, &law.volumetric)
        }
        raw::BulkLaw::Yeoh(law) => {
            let isochoric = Isochoric::Yeoh {
                c10: law.c10.as_ref()?.value.0,
                c20: law.c20.as_ref()?.value.0,
                c30: law.c30.as_ref()?.value.0,
            };
            (isochoric, &law.compressibility, &law.volumetric)
        }
        raw::BulkLaw::Ogden(law) => {
            let terms = law.terms.as_ref()?.value.iter().map(ogden_term);
            let isochoric = Isochoric::Ogden(terms.collect::<Option<_>>()?);
            (isochoric, &law.compressibility, &law.volumetric)
        }
        raw::BulkLaw::Gent(law) => {
            let isochoric = Isochoric::Gent {
                shear: law.shear_modulus.as_ref()?.value.0,
                limit: law.limit.as_ref()?.value.0,
            };
            (isochoric, &law.compressibility, &law.volumetric)
        }
        raw::BulkLaw::ArrudaBoyce(law) => {
            let isochoric = Isochoric::ArrudaBoyce {
                mu: law.mu.as_ref()?.value.0,
                locking_stretch: law.locking_stretch.as_ref()?.value.0,
            };
            (isochoric, &law.compressibility, &law.volumetric)
        }
    };
    let form = volumetric(form.as_ref());
    Some(match compressibility.as_ref()? {
        raw::Compressibility::BulkModulus(raw) => {
            Hyperelastic::new(isochoric, raw.bulk_modulus.as_ref()?.value.0, form)
        }
        raw::Compressibility::Ratio(raw) => {
            let ratio = raw.poissons_ratio.as_ref()?.value.0;
            Hyperelastic::with_poissons_ratio(isochoric, ratio, form)
        }
    })
}

fn ogden_term(raw: &At<raw::OgdenTerm>) -> Option<OgdenTerm> {
    Some(OgdenTerm {
        mu: raw.value.mu.as_ref()?.value.0,
        alpha: raw.value.alpha.as_ref()?.value.0,
    })
}

fn volumetric(raw: Option<&At<raw::Volumetric>>) -> Volumetric {
    match raw.map(|raw| raw.value) {
        None | Some(raw::Volumetric::Quadratic) => Volumetric::Quadratic,
        Some(raw::Volumetric::Logarithmic) => Volumetric::Logarithmic,
    }
}

fn lame_constants(
    constants: &raw::ElasticConstants,
    faults: &mut FaultList<'_>,
) -> Option<LameConstants> {
    match constants {
        raw::ElasticConstants::Engineering(raw) => {
            let (modulus, ratio) = (raw.youngs_modulus.as_ref()?, raw.poissons_ratio.as_ref()?);
            // The reader has checked the ranges already.
            LameConstants::from_youngs_modulus(modulus.value.0, ratio.value.0).ok()
        }
        raw::ElasticConstants::Lame(raw) => {
            let lambda = raw.lambda.as_ref()?;
            let shear = raw.shear_modulus.as_ref()?.value.0;
            if 3.0 * lambda.value.0 + 2.0 * shear <= 0.0 {
                let kind = ModelFault::BulkModulus {
                    lambda: lambda.value.0,
                    shear,
                };
                faults.push(&lambda.span, kind);
                return None;
            }
            Some(LameConstants {
                lambda: lambda.value.0,
                shear,
            })
        }
    }
}
