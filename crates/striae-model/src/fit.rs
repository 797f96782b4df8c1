//! Gaps and overlaps of the meshes: closed where a pair asks for it, otherwise judged; nodes
//! of ties put where they belong.

use striae_solve::{
    initial::{InitialFault, close, fault, fits},
    model::{Model, PairId},
    tie::placed,
};

use crate::{
    fault::{Fault, FaultKind},
    path::Path,
};

/// The model with its gaps closed, as its pairs ask for, and with nodes that follow in ties
/// where they belong. The model must have no other faults.
///
/// # Errors
/// What is wrong with the meshes of each pair and each tie.
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
    if !faults.is_empty() {
        return Err(faults);
    }
    let ties: Vec<String> = model.ties.iter().map(|tie| tie.name.clone()).collect();
    placed(model).map_err(|faults| {
        let faults = faults.into_iter().map(|fault| {
            let tie = ties.iter().position(|name| name == fault.tie());
            Fault {
                path: tie.map_or(Path::of("ties"), |tie| Path::part("ties", tie)),
                kind: FaultKind::Tie { fault },
            }
        });
        faults.collect()
    })
}
