//! Gaps and overlaps of the meshes: closed where a pair asks for it, otherwise judged.

use crate::{fault::FaultKind, faults::FaultList, raw, read::At};
use striae_solve::{
    initial::{InitialFault, close, fault, fits},
    model::{Model, PairId},
};

/// The model with its gaps closed; what is wrong with it is noted where the pair is.
pub(super) fn fitted(
    model: Model,
    written: &[At<raw::Pair>],
    faults: &mut FaultList<'_>,
) -> Option<Model> {
    let names: Vec<String> = model.pairs.iter().map(|pair| pair.name.clone()).collect();
    let mut note = |fault: InitialFault| {
        let at = names.iter().position(|name| name == fault.pair());
        let span = at.and_then(|at| written.get(at)).map_or(0..0, |pair| {
            let name = pair.value.name.as_ref();
            name.map_or(pair.span.clone(), |name| name.span.clone())
        });
        faults.push(&span, FaultKind::Initial { fault });
    };
    let model = close(model).map_err(&mut note).ok()?;
    let fits = fits(&model);
    let found = fits.iter().enumerate().filter_map(|(pair, fit)| {
        let fit = fit.as_ref()?;
        fault(&model, PairId(pair), fit)
    });
    found.for_each(note);
    Some(model)
}
