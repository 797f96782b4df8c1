//! The part of the stored energy that depends on the volume ratio `J` alone.
//!
//! ```text
//! quadratic    U = k/2 (J - 1)^2      J U' = k (J - 1) J      J (J U')' = k (2 J - 1) J
//! logarithmic  U = k/2 ln^2 J         J U' = k ln J           J (J U')' = k
//! ```
//!
//! Both are zero and free of stress at `J = 1`, where `U'' = k`. The quadratic term keeps
//! a finite stress as `J -> 0`; the logarithmic one grows without bound there, but its
//! stress `U'` falls again beyond `J = e`.

use num_dual::DualNum;
use serde::Serialize;

use striae_declared::{Parameter, Values};

/// The energies by their names, with their formulas.
const ENERGIES: &[(Volumetric, (&str, &str))] = &[
    (Volumetric::Quadratic, ("quadratic", "`k/2 (J - 1)^2`.")),
    (Volumetric::Logarithmic, ("logarithmic", "`k/2 ln^2 J`.")),
];

/// The names and formulas alone.
const WORDS: [(&str, &str); ENERGIES.len()] = words();

/// Parameter of laws with a volumetric energy; [`Volumetric::stated`] reads it.
pub const VOLUMETRIC: Parameter = Parameter::word(
    "volumetric",
    &WORDS,
    "Form of the volumetric energy for the volume ratio `J` and a modulus `k`.",
);

/// Form of the volumetric energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Volumetric {
    /// `k/2 (J - 1)^2`.
    #[default]
    Quadratic,
    /// `k/2 ln^2 J`.
    Logarithmic,
}

const fn words() -> [(&'static str, &'static str); ENERGIES.len()] {
    let mut words = [("", ""); ENERGIES.len()];
    let mut at = 0;
    while at < words.len() {
        words[at] = ENERGIES[at].1;
        at += 1;
    }
    words
}

impl Volumetric {
    /// The energy that the value of `volumetric` states.
    pub fn stated(values: &Values) -> Self {
        let word = values.word(VOLUMETRIC.name);
        let mut energies = ENERGIES.iter();
        let found = energies.find(|(_, (name, _))| *name == word);
        found.map_or(Self::default(), |(energy, _)| *energy)
    }

    /// The name of the energy in decks.
    pub fn name(self) -> &'static str {
        let mut energies = ENERGIES.iter();
        let found = energies.find(|(energy, _)| *energy == self);
        found.map_or("", |(_, (name, _))| name)
    }

    /// `U(J)` for the modulus `k`.
    pub(super) fn energy<D: DualNum<Primitive = f64> + Copy>(self, modulus: f64, j: D) -> D {
        let strain = match self {
            Self::Quadratic => j - 1.0,
            Self::Logarithmic => j.ln(),
        };
        strain * strain * (0.5 * modulus)
    }

    /// `J U'` and `J (J U')'`: the Kirchhoff pressure and its derivative by `ln J`.
    pub(super) fn pressure(self, modulus: f64, j: f64) -> (f64, f64) {
        match self {
            Self::Quadratic => (modulus * (j - 1.0) * j, modulus * (2.0 * j - 1.0) * j),
            Self::Logarithmic => (modulus * j.ln(), modulus),
        }
    }
}
