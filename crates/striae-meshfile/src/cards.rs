//! Materials that a mesh file states, by the constants that stand there.
//!
//! | card of Abaqus | energy or meaning |
//! | --- | --- |
//! | `*ELASTIC` | Young's modulus and Poisson's ratio |
//! | `*HYPERELASTIC, NEO HOOKE` | `C10 (I1 - 3) + (J - 1)^2/D1` |
//! | `*HYPERELASTIC, MOONEY-RIVLIN` | `C10 (I1 - 3) + C01 (I2 - 3) + (J - 1)^2/D1` |
//! | `*HYPERELASTIC, YEOH` | `sum_i Ci0 (I1 - 3)^i + (J - 1)^2/D1` |
//! | `*HYPERELASTIC, OGDEN` | `sum_i 2 mu_i/alpha_i^2 (L1^alpha_i + L2^alpha_i + L3^alpha_i - 3) + (J - 1)^2/D1` |
//! | `*PLASTIC` | yield stress over the plastic strain |
//! | `*VISCOELASTIC, TIME=PRONY` | shares `g_i` of the modulus of sudden deformations that relax in `tau_i` |
//!
//! `I1`, `I2` and `L_a` are of the isochoric deformation. Source: Abaqus materials guide,
//! "Hyperelastic behavior of rubberlike materials", "Time domain viscoelasticity".

use std::fmt;

/// A material of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialCard {
    /// Its name.
    pub name: String,
    /// Card, or the reason why it cannot be used, with the file and line.
    pub card: Result<Card, String>,
}

/// Elements of a file that are of a material of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SectionCard {
    /// Name of the element set.
    pub set: String,
    /// Name of the material.
    pub material: String,
}

/// Constants of a material, as the file states them.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// Mass per volume.
    pub density: Option<f64>,
    /// Elastic constants.
    pub elasticity: Elasticity,
    /// Kind of the moduli if some relax.
    pub moduli: Moduli,
    /// Yield stress and plastic strain, row by row; empty for what does not yield.
    pub hardening: Vec<[f64; 2]>,
    /// Share `g` and time `tau` of each branch that relaxes.
    pub relaxation: Vec<[f64; 2]>,
}

/// Elastic constants in Abaqus's terms.
#[derive(Clone, Debug, PartialEq)]
pub enum Elasticity {
    /// `*ELASTIC`.
    Linear {
        /// Young's modulus.
        youngs_modulus: f64,
        /// Poisson's ratio.
        poissons_ratio: f64,
    },
    /// `*HYPERELASTIC, NEO HOOKE`.
    NeoHooke {
        /// Constant of the first invariant.
        c10: f64,
        /// Compressibility, above zero.
        d1: f64,
    },
    /// `*HYPERELASTIC, MOONEY-RIVLIN`.
    MooneyRivlin {
        /// Constant of the first invariant.
        c10: f64,
        /// Constant of the second invariant.
        c01: f64,
        /// Compressibility, above zero.
        d1: f64,
    },
    /// `*HYPERELASTIC, YEOH`.
    Yeoh {
        /// Constants of the powers of `I1 - 3`.
        c: [f64; 3],
        /// Compressibility, above zero.
        d1: f64,
    },
    /// `*HYPERELASTIC, OGDEN`.
    Ogden {
        /// `mu_i` and `alpha_i`.
        terms: Vec<[f64; 2]>,
        /// Compressibility, above zero.
        d1: f64,
    },
}

/// Kind of the moduli of a material that relaxes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Moduli {
    /// Moduli for slow deformations.
    #[default]
    LongTerm,
    /// Moduli for sudden deformations.
    Instantaneous,
}

impl fmt::Display for Card {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.elasticity)?;
        if !self.hardening.is_empty() {
            let count = self.hardening.len();
            write!(f, "; yields from {:e}, rows: {count}", self.hardening[0][0])?;
        }
        if !self.relaxation.is_empty() {
            let which = match self.moduli {
                Moduli::LongTerm => "long-term moduli",
                Moduli::Instantaneous => "instantaneous moduli",
            };
            let count = self.relaxation.len();
            write!(f, "; {which}, branches that relax: {count}")?;
        }
        match self.density {
            Some(density) => write!(f, "; density {density:e}"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Elasticity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Linear {
                youngs_modulus,
                poissons_ratio,
            } => write!(f, "elastic, E = {youngs_modulus:e}, nu = {poissons_ratio}"),
            Self::NeoHooke { c10, d1 } => write!(f, "neo-Hooke, C10 = {c10:e}, D1 = {d1:e}"),
            Self::MooneyRivlin { c10, c01, d1 } => write!(
                f,
                "Mooney-Rivlin, C10 = {c10:e}, C01 = {c01:e}, D1 = {d1:e}"
            ),
            Self::Yeoh {
                c: [c10, c20, c30],
                d1,
            } => write!(
                f,
                "Yeoh, C10 = {c10:e}, C20 = {c20:e}, C30 = {c30:e}, D1 = {d1:e}"
            ),
            Self::Ogden { terms, d1 } => {
                write!(f, "Ogden with N = {}, D1 = {d1:e}", terms.len())
            }
        }
    }
}
