//! Overlaps of curved surfaces that are pressed out, whose facets overlap by more or less.

use striae_contact::initial::Fit;
use striae_model::{Initial, Model};

use super::{Advice, Topic};

/// Error of the overlap from which on it is told.
const TOLD: f64 = 0.1;

/// Notes overlaps that are not those of the facets.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    for (pair, fit) in model.pairs.iter().zip(fits) {
        let share = fit.as_ref().map_or(0.0, |fit| fit.chords);
        if pair.initial == Initial::Resolve && share > TOLD {
            let text = format!(
                "pair `{}`: facets are chords of curved surfaces; the overlaps that are pressed out are those of the surfaces, {} of the facets",
                pair.name,
                match share {
                    0.0..1.0 => format!("which differ by {:.0} % from those", 100.0 * share),
                    _ => "which are smaller than the sagitta".to_owned(),
                },
            );
            advice.note(Topic::Fit, &pair.name, text);
        }
    }
}
