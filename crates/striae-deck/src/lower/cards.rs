//! Sections of a body by the materials that its mesh file states.
//!
//! Constants of Abaqus become those of this program, with `g = sum g_i` of what relaxes:
//!
//! | card | law | constants |
//! | --- | --- | --- |
//! | `*ELASTIC` | neo-Hookean | `E`, `nu` |
//! | `*ELASTIC` and `*VISCOELASTIC` | isochoric neo-Hookean | `G = E/(2 (1 + nu))`, `K = E/(3 (1 - 2 nu))` |
//! | `*ELASTIC` and `*PLASTIC` | elastic-plastic | `E`, `nu`, pairs of strain and stress |
//! | `NEO HOOKE` | isochoric neo-Hookean | `G = 2 C10`, `K = 2/D1` |
//! | `MOONEY-RIVLIN` | Mooney-Rivlin | `c10`, `c01`, `K = 2/D1` |
//! | `YEOH` | Yeoh | `c10`, `c20`, `c30`, `K = 2/D1` |
//! | `OGDEN` | Ogden | `mu = 2 mu_i/alpha_i`, `alpha_i`, `K = 2/D1` |
//! | `*VISCOELASTIC` | branches | ratio `g_i/(1 - g)`, time `tau_i` |
//!
//! `U = (J - 1)^2/D1` of Abaqus is `K/2 (J - 1)^2`. Instantaneous moduli are those of slow
//! deformations over `1 - g`, but for the bulk modulus. Sources: Abaqus materials guide,
//! "Hyperelastic behavior of rubberlike materials", "Time domain viscoelasticity".

use striae_law::bulk::{
    Branch, Hardening, Hyperelastic, Isochoric, LameConstants, Material, OgdenTerm, Plastic,
    Viscoelastic, Volumetric,
};
use striae_mesh::Mesh;
use striae_meshfile::{Card, Elasticity, MaterialCard, Moduli, SectionCard};
use striae_model::{BodySection, Formulation};

/// Materials stated by a mesh file.
pub(super) struct Cards {
    pub(super) materials: Vec<MaterialCard>,
    pub(super) sections: Vec<SectionCard>,
}

impl Cards {
    /// The sections of a body, or why there are none; `stated` is the formulation that the deck or
    /// the elements of the file request.
    pub(super) fn sections(
        &self,
        mesh: &Mesh,
        stated: Option<Formulation>,
    ) -> Result<Vec<BodySection>, String> {
        if self.sections.is_empty() {
            let cause =
                "it assigns no material to an element set, as *SOLID SECTION of Abaqus does";
            return Err(cause.to_owned());
        }
        let sections = self.sections.iter();
        sections
            .map(|section| self.section(section, mesh, stated))
            .collect()
    }

    fn section(
        &self,
        section: &SectionCard,
        mesh: &Mesh,
        stated: Option<Formulation>,
    ) -> Result<BodySection, String> {
        let mut known = self.materials.iter();
        let known = known.find(|card| card.name.eq_ignore_ascii_case(&section.material));
        let unknown = || format!("there is no material `{}`", section.material);
        let card = known.ok_or_else(unknown)?.card.as_ref()?;
        let material = material(card);
        let inadmissible = |cause| format!("material `{}`: {cause}", section.material);
        let material = material.map_err(inadmissible)?;
        let elements = mesh.element_sets.get(&section.set).unwrap_or_default();
        Ok(BodySection {
            set: section.set.clone(),
            elements: elements.to_vec(),
            formulation: stated.unwrap_or(Formulation::suited_to(&material)),
            material,
            density: card.density.unwrap_or(0.0),
        })
    }
}

/// The law that a card states.
pub(crate) fn material(card: &Card) -> Result<Material, String> {
    let relaxing: f64 = card.relaxation.iter().map(|[g, _]| g).sum();
    let slow = match card.moduli {
        Moduli::LongTerm => 1.0,
        Moduli::Instantaneous => 1.0 - relaxing,
    };
    if let Elasticity::Linear {
        youngs_modulus,
        poissons_ratio,
    } = card.elasticity
        && card.relaxation.is_empty()
    {
        return solid(card, youngs_modulus, poissons_ratio);
    }
    let (isochoric, bulk) = rubber(&card.elasticity, slow);
    let rubber = Hyperelastic::new(isochoric, bulk, Volumetric::Quadratic);
    let rubber = rubber.map_err(|error| error.to_string())?;
    if card.relaxation.is_empty() {
        return Ok(Material::hyperelastic(rubber));
    }
    let branches = card.relaxation.iter().map(|[g, time]| Branch {
        ratio: g / (1.0 - relaxing),
        time: *time,
    });
    let branches: Vec<Branch> = branches.collect();
    let material = Viscoelastic::new(rubber, &branches).map_err(|error| error.to_string())?;
    Ok(Material::viscoelastic(material))
}

/// An elastic solid, or a metal.
fn solid(card: &Card, youngs_modulus: f64, poissons_ratio: f64) -> Result<Material, String> {
    let constants = LameConstants::from_youngs_modulus(youngs_modulus, poissons_ratio);
    let constants = constants.map_err(|error| error.to_string())?;
    if card.hardening.is_empty() {
        return Ok(Material::neo_hookean(constants));
    }
    let pairs = card
        .hardening
        .iter()
        .map(|[stress, strain]| [*strain, *stress]);
    let hardening = Hardening::table(&pairs.collect::<Vec<_>>());
    let hardening = hardening.map_err(|error| error.to_string())?;
    Ok(Material::plastic(Plastic::new(constants, hardening)))
}

/// The isochoric part, times `slow`, and the bulk modulus.
fn rubber(elasticity: &Elasticity, slow: f64) -> (Isochoric, f64) {
    match elasticity {
        Elasticity::Linear {
            youngs_modulus: modulus,
            poissons_ratio: ratio,
        } => {
            let shear = slow * modulus / (2.0 * (1.0 + ratio));
            let bulk = modulus / (3.0 * (1.0 - 2.0 * ratio));
            (Isochoric::NeoHookean { shear }, bulk)
        }
        Elasticity::NeoHooke { c10, d1 } => {
            let shear = slow * 2.0 * c10;
            (Isochoric::NeoHookean { shear }, 2.0 / d1)
        }
        Elasticity::MooneyRivlin { c10, c01, d1 } => {
            let (c10, c01) = (slow * c10, slow * c01);
            (Isochoric::MooneyRivlin { c10, c01 }, 2.0 / d1)
        }
        Elasticity::Yeoh { c, d1 } => {
            let [c10, c20, c30] = c.map(|c| slow * c);
            (Isochoric::Yeoh { c10, c20, c30 }, 2.0 / d1)
        }
        Elasticity::Ogden { terms, d1 } => {
            let terms = terms.iter().map(|[mu, alpha]| OgdenTerm {
                mu: slow * 2.0 * mu / alpha,
                alpha: *alpha,
            });
            (Isochoric::Ogden(terms.collect()), 2.0 / d1)
        }
    }
}
