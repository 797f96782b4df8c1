//! Patches that are released: contact opens in an increment, and nothing else holds a body.
//!
//! A body that is pressed by loads and driven over an edge has no equilibrium beyond it. Newton's
//! method finds all nodes of the pair open and a singular system, or none that converges. That is
//! the reason of a cut if the pair was closed in the last converged state, is open in the latest
//! iteration, and a body is free without it.

use striae_contact::{
    evaluation::Evaluation,
    unknowns::{NodeResult, Status},
};

use crate::{
    assembly::StepContext,
    freedom::{Friction, free_motion},
    outcome::CutBack,
    state::State,
};
use striae_model::Procedure;

/// Pairs that are closed somewhere.
pub(super) fn closed(contacts: &[Evaluation]) -> Vec<bool> {
    contacts
        .iter()
        .map(|contact| is_closed(&contact.nodes))
        .collect()
}

fn is_closed(nodes: &[Vec<NodeResult>; 2]) -> bool {
    let mut nodes = nodes.iter().flatten();
    nodes.any(|node| node.status != Status::Open)
}

/// The body that is free, if contact that held it in `state` has opened when the increment
/// failed for `reason`; `closed` are the pairs that are closed still.
pub(super) fn released(
    context: &StepContext,
    state: &State,
    closed: &[bool],
    reason: &CutBack,
) -> Option<CutBack> {
    let may_be = matches!(
        reason,
        CutBack::NoConvergence { .. }
            | CutBack::Diverged { .. }
            | CutBack::Flown { .. }
            | CutBack::RigidFlown { .. }
            | CutBack::InvertedElement { .. }
            | CutBack::Folded { .. }
            | CutBack::LinearSystem { .. }
    );
    let procedure = context.problem.model.steps[context.index].procedure;
    // With inertia a body without contact flies, which is a solution.
    if !may_be || procedure != Procedure::QuasiStatic {
        return None;
    }
    let has_opened = |pair: usize| {
        !closed[pair] && context.stabilisation[pair] == 0.0 && is_closed(&state.pairs[pair].nodes)
    };
    let pair = (0..closed.len()).find(|&pair| has_opened(pair))?;
    let none = [Vec::new(), Vec::new()];
    let pairs = state.pairs.iter().enumerate();
    let contacts: Vec<_> = pairs
        .map(|(pair, of_pair)| {
            if has_opened(pair) {
                &none
            } else {
                &of_pair.nodes
            }
        })
        .collect();
    let motion = free_motion(context, state.into(), &contacts, Friction::Any)?;
    Some(CutBack::Released {
        pair: context.pairs[pair].name.clone(),
        motion: Box::new(motion),
    })
}
