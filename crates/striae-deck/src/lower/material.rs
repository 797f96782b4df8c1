//! Bulk materials.

use super::{admissible::admissible, fibres::with_fibres};
use crate::{
    faults::{FaultList, Span},
    raw,
    read::At,
};
use striae_law::bulk::{
    Branch, Hardening, Hyperelastic, InadmissibleHardening, InadmissibleHyperelastic, Isochoric,
    LameConstants, Material, OgdenTerm, Plastic, Viscoelastic, Volumetric,
};
use striae_model::FaultKind as ModelFault;

/// A material, or `None` after its faults have been noted.
pub(super) fn material(
    raw: &raw::Material,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<Material> {
    let ground = ground(raw, span, faults)?;
    match &raw.fibres {
        Some(fibres) => with_fibres(ground, fibres, faults),
        None => Some(ground),
    }
}

/// A material without its fibres.
fn ground(raw: &raw::Material, span: &Span, faults: &mut FaultList<'_>) -> Option<Material> {
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
        raw::BulkLaw::ElasticPlastic(law) => {
            let constants = lame_constants(law.constants.as_ref()?, faults)?;
            let hardening = hardening(law.hardening.as_ref()?)?;
            let hardening = admissible(hardening, span, faults)?;
            Some(Material::Plastic(Plastic::new(constants, hardening)))
        }
        _ => {
            let (made, relaxation) = rubber(law)?;
            let slow = admissible(made, span, faults)?;
            let Some(relaxation) = relaxation else {
                return Some(Material::Hyperelastic(slow));
            };
            let branches: Option<Vec<Branch>> = relaxation.value.iter().map(branch).collect();
            let made = Viscoelastic::new(slow, &branches?);
            admissible(made, &relaxation.span, faults).map(Material::Viscoelastic)
        }
    }
}

fn branch(raw: &At<raw::Branch>) -> Option<Branch> {
    Some(Branch {
        ratio: raw.value.ratio.as_ref()?.value.0,
        time: raw.value.time.as_ref()?.value.0,
    })
}

/// The hardening, or `None` where a constant could not be read.
fn hardening(raw: &raw::Hardening) -> Option<Result<Hardening, InadmissibleHardening>> {
    Some(match raw {
        raw::Hardening::Smooth(raw) => {
            let first = raw.yield_stress.as_ref()?.value.0;
            let modulus = raw.hardening_modulus.as_ref();
            let modulus = modulus.map_or(0.0, |modulus| modulus.value.0);
            let Some(saturation) = &raw.saturation else {
                return Some(Hardening::linear(first, modulus));
            };
            let stress = saturation.value.stress.as_ref()?.value.0;
            let rate = saturation.value.rate.as_ref()?.value.0;
            Hardening::voce(first, stress, rate, modulus)
        }
        raw::Hardening::Table(raw) => {
            let pairs = raw.yield_table.as_ref()?.value.iter();
            let pairs: Vec<[f64; 2]> = pairs.map(|pair| pair.value.map(|x| x.0)).collect();
            Hardening::table(&pairs)
        }
    })
}

/// Properties common to all rubber laws, besides their isochoric part.
type Common<'a> = (
    &'a Option<raw::Compressibility>,
    &'a Option<At<raw::Volumetric>>,
    &'a Option<At<Vec<At<raw::Branch>>>>,
);

/// The rubber and what relaxes beside it, or `None` where a constant could not be read.
#[allow(clippy::type_complexity)]
fn rubber(
    law: &raw::BulkLaw,
) -> Option<(
    Result<Hyperelastic, InadmissibleHyperelastic>,
    Option<&At<Vec<At<raw::Branch>>>>,
)> {
    let (isochoric, (compressibility, form, relaxation)) = isochoric(law)?;
    let form = volumetric(form.as_ref());
    let made = match compressibility.as_ref()? {
        raw::Compressibility::BulkModulus(raw) => {
            Hyperelastic::new(isochoric, raw.bulk_modulus.as_ref()?.value.0, form)
        }
        raw::Compressibility::Ratio(raw) => {
            let ratio = raw.poissons_ratio.as_ref()?.value.0;
            Hyperelastic::with_poissons_ratio(isochoric, ratio, form)
        }
    };
    Some((made, relaxation.as_ref()))
}

/// The isochoric part of rubber.
fn isochoric(law: &raw::BulkLaw) -> Option<(Isochoric, Common<'_>)> {
    Some(match law {
        raw::BulkLaw::NeoHookean(_)
        | raw::BulkLaw::LinearElastic(_)
        | raw::BulkLaw::ElasticPlastic(_) => return None,
        raw::BulkLaw::IsochoricNeoHookean(law) => {
            let shear = law.shear_modulus.as_ref()?.value.0;
            (
                Isochoric::NeoHookean { shear },
                (&law.compressibility, &law.volumetric, &law.relaxation),
            )
        }
        raw::BulkLaw::MooneyRivlin(law) => {
            let isochoric = Isochoric::MooneyRivlin {
                c10: law.c10.as_ref()?.value.0,
                c01: law.c01.as_ref()?.value.0,
            };
            (
                isochoric,
                (&law.compressibility, &law.volumetric, &law.relaxation),
            )
        }
        raw::BulkLaw::Yeoh(law) => {
            let isochoric = Isochoric::Yeoh {
                c10: law.c10.as_ref()?.value.0,
                c20: law.c20.as_ref()?.value.0,
                c30: law.c30.as_ref()?.value.0,
            };
            (
                isochoric,
                (&law.compressibility, &law.volumetric, &law.relaxation),
            )
        }
        raw::BulkLaw::Ogden(law) => {
            let terms = law.terms.as_ref()?.value.iter().map(ogden_term);
            (
                Isochoric::Ogden(terms.collect::<Option<_>>()?),
                (&law.compressibility, &law.volumetric, &law.relaxation),
            )
        }
        raw::BulkLaw::Gent(law) => {
            let isochoric = Isochoric::Gent {
                shear: law.shear_modulus.as_ref()?.value.0,
                limit: law.limit.as_ref()?.value.0,
            };
            (
                isochoric,
                (&law.compressibility, &law.volumetric, &law.relaxation),
            )
        }
        raw::BulkLaw::ArrudaBoyce(law) => {
            let isochoric = Isochoric::ArrudaBoyce {
                mu: law.mu.as_ref()?.value.0,
                locking_stretch: law.locking_stretch.as_ref()?.value.0,
            };
            (
                isochoric,
                (&law.compressibility, &law.volumetric, &law.relaxation),
            )
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
