//! Formulations of elements.

use crate::{raw, read::At};
use striae_model::Formulation;

/// Formulation of elements, if it is stated.
pub(super) fn formulation(stated: &Option<At<raw::Formulation>>) -> Option<Formulation> {
    stated.as_ref().map(|word| match word.value {
        raw::Formulation::Standard => Formulation::Standard,
        raw::Formulation::MeanDilatation => Formulation::MeanDilatation,
        raw::Formulation::AssumedStrain => Formulation::AssumedStrain,
    })
}
