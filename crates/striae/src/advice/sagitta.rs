//! Overlaps of curved surfaces that are pressed out, whose facets overlap by more or less.

use striae_contact::initial::Fit;
use striae_model::{Initial, Model, PairId, initial::conforms};

use super::{Advice, Topic};

/// Error of the overlap from which on it is told.
const TOLD: f64 = 0.1;

/// Notes overlaps that are not those of the facets, and warns of those that are but should not be.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    for (index, (pair, fit)) in model.pairs.iter().zip(fits).enumerate() {
        let Some(fit) = fit.as_ref().filter(|fit| fit.chords > TOLD) else {
            continue;
        };
        if pair.initial != Initial::Resolve {
            continue;
        }
        let name = &pair.name;
        let differ = match fit.chords {
            0.0..1.0 => format!(
                "differ from those of the facets by {:.0} %",
                100.0 * fit.chords
            ),
            _ => "are smaller than the sagitta of the facets".to_owned(),
        };
        if conforms(model, PairId(index)) {
            let text = format!(
                "pair `{name}`: facets are chords of curved surfaces; the overlaps that are pressed out are those of the surfaces, which {differ}"
            );
            advice.note(Topic::Fit, name, text);
        } else {
            let text = format!(
                "pair `{name}`: facets are chords of curved surfaces, and the overlaps of these {differ}; as the surfaces do not conform, those of the facets are pressed out. Refine the meshes, or let the bodies overlap by moving them in a step"
            );
            advice.warn(Topic::Fit, name, text);
        }
    }
}
