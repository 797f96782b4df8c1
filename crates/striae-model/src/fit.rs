//! Gaps and overlaps of the meshes: closed where a pair asks for it, otherwise judged.

use striae_solve::{
    initial::{InitialFault, close, fault, fits},
    model::{Model, PairId},
};

use crate::{
    fault::{Fault, FaultKind},
    path::Path,
};

/// The model with its gaps closed, as its pairs ask for. The model must have no other
/// faults.
///
/// # Errors
/// What is wrong with the meshes of each pair.
pub fn fitted(model: Model) -> Result<Model, Vec<Fault>> {
    let names: Vec<String> = model.pairs.iter().map(|pair| pair.name.clone()).collect();
    let located = |fault: InitialFault| {
        let pair = names.iter().position(|name| name == fault.pair());
        let path = pair.map_or(Path::of("pairs"), |pair| Path::part("pairs", pair));
        Fault {
            path: path.field("initial"),
            kind: FaultKind::Initial { fault },
        }
    };
    let model = close(model).map_err(|fault| vec![located(fault)])?;
    let fits = fits(&model);
    let found = fits.iter().enumerate().filter_map(|(pair, fit)| {
        let fit = fit.as_ref()?;
        fault(&model, PairId(pair), fit)
    });
    let faults: Vec<Fault> = found.map(located).collect();
    if faults.is_empty() {
        Ok(model)
    } else {
        Err(faults)
    }
}
