//! What a run should be read with care for.

use striae_contact::initial::Fit;

use crate::{
    initial::{may_meet, other_name},
    model::{Model, PairId},
};

/// Something that makes results doubtful, with the number it is judged by.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// What it is about.
    pub kind: Kind,
    /// Name of the contact pair, if it is about one.
    pub pair: Option<String>,
    /// Worst value.
    pub value: f64,
    /// Value above which there is a warning.
    pub limit: f64,
    /// Time of the worst value.
    pub time: f64,
    /// In a sentence.
    pub text: String,
}

/// Kinds of warnings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A pair can never meet.
    NeverMeets,
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// What a model should be read with care for, given how its pairs fit.
pub fn warnings_at_start(model: &Model, fits: &[Option<Fit>]) -> Vec<Warning> {
    let mut warnings = Vec::new();
    for (pair, fit) in fits.iter().enumerate() {
        let pair = PairId(pair);
        if let Some(fit) = fit.as_ref().filter(|fit| !may_meet(model, pair, fit)) {
            let name = &model.pairs[pair.0].name;
            let [a, b] = [1, 0].map(|side| other_name(model, pair, side));
            let distance = fit.distance;
            warnings.push(Warning {
                kind: Kind::NeverMeets,
                pair: Some(name.clone()),
                value: distance,
                limit: 0.0,
                time: 0.0,
                text: format!(
                    "pair `{name}` can never meet: `{a}` and `{b}` are {distance:.3e} apart, and no prescribed displacement goes as far"
                ),
            });
        }
    }
    warnings
}
