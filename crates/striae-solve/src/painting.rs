//! Textures that cannot be painted, found before a problem is made of the model.

use crate::{
    model::Model,
    problem::{ProblemError, pair_geometry},
};

/// What is wrong with the sides and textures of each pair; nothing if all can be painted.
pub fn faults(model: &Model) -> Vec<ProblemError> {
    let pairs = model.pairs.iter();
    pairs
        .filter_map(|pair| pair_geometry(model, pair).err())
        .collect()
}
