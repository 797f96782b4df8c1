//! Overlaps that are meant as an interference, beside the sagitta of curved surfaces.

use striae_contact::initial::Fit;
use striae_model::{Initial, Model};
use striae_solve::warning::{Kind, chords};

use super::{Advice, Topic};

/// Warns of overlaps that are pressed out and change with the facets that face each other.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    for (pair, fit) in model.pairs.iter().zip(fits) {
        let share = fit.as_ref().map_or(0.0, |fit| fit.chords);
        if pair.initial == Initial::Resolve && share > Kind::Chords.limit() {
            advice.warn(Topic::Fit, &pair.name, chords(&pair.name, share));
        }
    }
}
