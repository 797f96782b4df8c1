//! Files beside the results that document the run: the deck, and pictures of its friction.
//!
//! ```text
//! DIR/deck.toml                the deck as it was when the run began
//! DIR/law-PAIR.svg             coefficients of friction of a pair, of several that share them the first
//! DIR/law-PAIR-STEP.svg        those that a step changes them to
//! DIR/law-PAIR-coefficient.svg the same over what else they depend on
//! ```

use std::path::Path;

use striae_files::{read_text, write_atomically};
use striae_law::friction::{Analysis, Friction, Law};
use striae_model::Model;

use crate::{
    error::Error,
    figures::law::{SAMPLES, coefficients, dependence, frictions},
    log::Recording,
};

/// Angles between two textures at which their friction is drawn, in degrees.
const ANGLES: [f64; 5] = [0.0, 45.0, 90.0, 135.0, 180.0];

/// Writes deck and figures to the folder of a run that begins.
pub(crate) fn write(recording: &Recording, model: &Model) -> Result<(), Error> {
    let folder = &recording.folder;
    // A deck that did not come from a file has no copy.
    let source = recording.source.as_ref();
    if let Some(Ok(text)) = source.map(|source| read_text(&source.path)) {
        write_atomically(&folder.join("deck.toml"), text.as_bytes())?;
    }
    write_frictions(folder, model)
}

/// Writes the pictures of the friction of a model to a folder.
///
/// # Errors
/// When a file cannot be written.
pub fn write_frictions(folder: &Path, model: &Model) -> Result<(), Error> {
    let mut drawn: Vec<&Friction> = Vec::new();
    for named in frictions(model) {
        let angles: &[f64] = match named.friction.law() {
            Law::Frictionless => continue,
            _ if named.friction.coefficient().at_rest() == 0.0 => continue,
            Law::TwoTextures(_) => &ANGLES,
            _ => &ANGLES[..1],
        };
        if drawn.contains(&named.friction) {
            continue;
        }
        drawn.push(named.friction);
        let analyses: Vec<Analysis> = (angles.iter())
            .map(|angle| Analysis::new(named.friction, angle.to_radians(), SAMPLES))
            .collect();
        let file = folder.join(format!("law-{}.svg", named.file));
        coefficients(named.friction, &analyses).write_svg(&file)?;
        if let Some(figure) = dependence(named.friction) {
            figure.write_svg(&folder.join(format!("law-{}-coefficient.svg", named.file)))?;
        }
    }
    Ok(())
}
