//! Contact brought to rest on linearised bodies.
//!
//! After a correction contact has changed: nodes have closed or begun to slip. While the factors of
//! the bodies are available, contact is corrected repeatedly with linear bodies, at the cost of a
//! small dense system, until it rests. The result replaces the correction if the true residual is
//! smaller.

use striae_contact::{complementarity::Iteration, segment::Derivatives};

use super::{
    correction::{corrected, labelled},
    workspace::Workspace,
};
use crate::{
    assembly::{Assembled, Contact, Setting, Trial},
    outcome::CutBack,
};

/// Most corrections of contact alone.
const MOST: usize = 8;
/// Norm at which contact rests in the first iteration.
const AT_REST: f64 = 1e-6;
/// Part of the square of the norm before that bodies which are not linear leave at least.
const LEFT: f64 = 0.01;

/// Corrects contact on bodies linearised at `trial`, and evaluates the state that is
/// reached.
///
/// `correction` leads to the first state at which contact is evaluated, `before` is the norm at
/// `trial` if it is known. Returns `None` if the true norm does not improve or the state cannot be
/// evaluated: the correction alone leads to another state.
///
/// # Errors
/// Returns errors that are not caused by the state that is reached.
pub(super) fn contact_at_rest(
    workspace: &mut Workspace,
    setting: &Setting,
    (trial, assembled): (&Trial, &Assembled),
    correction: &[f64],
    before: Option<f64>,
) -> Result<Option<(Trial, Assembled)>, CutBack> {
    if !workspace.corrects_contact() {
        return Ok(None);
    }
    let tolerance = setting.context.problem.model.solver.tolerance;
    // The nonlinearity of the bodies leaves an error of the order of the square of the norm anyway.
    let enough = before.map_or(AT_REST, |norm| (LEFT * norm * norm).max(0.1 * tolerance));
    let background = &assembled.background;
    let mut whole = correction.to_vec();
    let mut from = trial.clone();
    labelled(&mut from, &assembled.contacts);
    for pass in 0..=MOST {
        let next = corrected(setting, workspace.system(), &from, &whole, 1.0);
        let moved = (&next, whole.as_slice());
        let found = workspace.assemble_contact(setting, background, moved, Iteration::LATER);
        let Some(found) = evaluated(found)?.flatten() else {
            return Ok(None);
        };
        if pass == MOST || found.norms.largest() <= enough {
            let contact = Contact::Known(found.contacts);
            let assembled = workspace.assemble_with(contact, setting, &next, Derivatives::First);
            // The prediction on linear bodies can be worse than none; then the plain correction is
            // taken.
            let is_better = |found: &Assembled| found.norms.largest() <= before.unwrap_or(1.0);
            let better = evaluated(assembled)?.filter(is_better);
            return Ok(better.map(|assembled| (next, assembled)));
        }
        let Some(further) = workspace.contact_correction(&found.residual) else {
            return Ok(None);
        };
        whole
            .iter_mut()
            .zip(&further)
            .for_each(|(sum, part)| *sum += part);
        labelled(&mut from, &found.contacts);
    }
    Ok(None)
}

/// Result of an evaluation; `None` for a state at which it is not possible.
fn evaluated<T>(found: Result<T, CutBack>) -> Result<Option<T>, CutBack> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(
            CutBack::InvertedElement { .. }
            | CutBack::Load { .. }
            | CutBack::CollapsedTexture { .. }
            | CutBack::Folded { .. }
            | CutBack::Factor { .. },
        ) => Ok(None),
        Err(reason) => Err(reason),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use striae_mesh::NodeId;

    #[test]
    fn only_faults_of_the_state_mean_that_nothing_was_reached() {
        let at = |pair: &str| CutBack::CollapsedTexture {
            pair: pair.to_owned(),
            body: String::new(),
            node: NodeId::new(3),
        };
        assert_eq!(evaluated::<()>(Err(at("one"))), Ok(None));
        assert_eq!(evaluated(Ok(2)), Ok(Some(2)));
        let missed = CutBack::MissedContact {
            pair: "one".to_owned(),
            body: String::new(),
            node: NodeId::new(3),
            count: 1,
        };
        assert_eq!(evaluated::<()>(Err(missed.clone())), Err(missed));
    }
}
