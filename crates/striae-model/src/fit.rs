//! Faults that only meshes in their places show: gaps and overlaps, closed if a pair requests it,
//! otherwise judged; textures without a direction; nodes of ties moved to their places.

use crate::{
    fault::{Fault, FaultKind},
    initial::{InitialFault, close, crowded, fault, fits, wrong_way},
    model::{Initial, Model, PairId},
    painting,
    path::Path,
    tie::placed,
};

/// The model with its gaps closed, as its pairs request, and with dependent nodes of ties at their
/// places. The model must have no other faults.
///
/// # Errors
/// Faults of the meshes and textures of each pair and of the meshes of each tie.
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
    // Nodes are moved only towards surfaces that face them.
    for (index, pair) in model.pairs.iter().enumerate() {
        if matches!(pair.initial, Initial::Close(_))
            && let Some(found) = wrong_way(&model, PairId(index))
        {
            return Err(vec![located(found)]);
        }
    }
    let model = close(model).map_err(|fault| vec![located(fault)])?;
    let fits = fits(&model);
    let found = fits.iter().enumerate().filter_map(|(pair, fit)| {
        let (id, fit) = (PairId(pair), fit.as_ref()?);
        // Two parts of one body have the body between them.
        let apart = !model.pairs[pair].is_within_a_body();
        let judged = apart.then(|| fault(&model, id, fit)).flatten();
        judged.or_else(|| crowded(&model, id, fit))
    });
    let faults: Vec<Fault> = found.map(located).collect();
    if !faults.is_empty() {
        return Err(faults);
    }
    let unpainted = unpainted(&model);
    if !unpainted.is_empty() {
        return Err(unpainted);
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

/// Textures that cannot be painted on the meshes.
fn unpainted(model: &Model) -> Vec<Fault> {
    let faults = painting::faults(model).into_iter().map(|fault| {
        let path = Path::part("pairs", fault.pair);
        let path = match fault.side {
            Some(side) => path.field("textures").index(side),
            None => path,
        };
        let cause = fault.error;
        Fault {
            path,
            kind: FaultKind::Unpainted { cause },
        }
    });
    faults.collect()
}
