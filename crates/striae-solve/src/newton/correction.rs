//! Corrections applied to a trial state.

use striae_contact::{
    complementarity::Iteration,
    evaluation::Evaluation,
    segment::Derivatives,
    side::Side,
    unknowns::{Status, Tractions},
};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use super::workspace::{SystemStorage, Workspace};
use crate::{
    assembly::{Assembled, Setting, Trial},
    outcome::CutBack,
};

/// Gives the nodes of a trial state the labels they have been found to have.
pub(super) fn labelled(trial: &mut Trial, contacts: &[Evaluation]) {
    for (tractions, contact) in trial.tractions.iter_mut().zip(contacts) {
        tractions.label(&contact.nodes);
    }
}

/// Smallest part of a correction that is tried.
const SMALLEST_PART: f64 = 1.0 / 16.0;

/// Part of a correction that was applied.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Taken {
    Whole,
    Part,
}

/// Applies a correction, halved while it turns elements inside out or folds surfaces over each
/// other.
pub(super) fn step(
    workspace: &mut Workspace,
    setting: &Setting,
    trial: &Trial,
    (iteration, derivatives): (Iteration, Derivatives),
    correction: &[f64],
) -> Result<(Trial, Assembled, Taken), CutBack> {
    let (mut factor, mut taken) = (1.0, Taken::Whole);
    loop {
        let next = corrected(setting, workspace.system(), trial, correction, factor);
        match workspace.assemble(setting, &next, iteration, derivatives) {
            Ok(assembled) => return Ok((next, assembled, taken)),
            Err(CutBack::InvertedElement { .. } | CutBack::Folded { .. })
                if factor > SMALLEST_PART =>
            {
                (factor, taken) = (0.5 * factor, Taken::Part);
            }
            Err(other) => return Err(other),
        }
    }
}

/// The trial state with a part of a correction. Nodes of a trial have the labels of the rows by
/// which it is corrected.
pub(super) fn corrected(
    setting: &Setting,
    system: &SystemStorage,
    trial: &Trial,
    correction: &[f64],
    factor: f64,
) -> Trial {
    let layout = &system.layout;
    let problem = setting.context.problem;
    let mut next = trial.clone();
    for (rigid, pose) in next.rigid.iter_mut().enumerate() {
        if let Some(first) = layout.rigid(rigid) {
            let present = pose.coordinates();
            let moved = std::array::from_fn(|at| present[at] + factor * correction[first + at]);
            *pose = setting.imposed.before[rigid].moved_to(&moved);
        }
    }
    for (node, position) in problem.global_nodes().zip(&mut next.positions) {
        if problem.tie_of[node].is_none() {
            let first = layout.position(node);
            let change = Vec3::from_column_slice(&correction[first..first + 3]);
            *position += setting.context.vector(node, &change) * factor;
        }
    }
    for (cavity, pressure) in next.pressures.iter_mut().enumerate() {
        *pressure += factor * correction[layout.cavity(cavity)];
    }
    next.place_tied(problem);
    for (pair, tractions) in next.tractions.iter_mut().enumerate() {
        let selection = &setting.selections[pair];
        add_tractions(tractions, correction, factor, |side, node| {
            let rows = match selection.is_kept(side, node) {
                true => Rows::OfStatus,
                false => Rows::Idle,
            };
            layout.traction(pair, side, node).map(|first| (first, rows))
        });
    }
    next
}

/// Equations of the rows of a node's tractions.
#[derive(Clone, Copy, PartialEq)]
enum Rows {
    /// Equations of the status of the node.
    OfStatus,
    /// The tractions stay unchanged.
    Idle,
}

/// Adds a part of a correction to tractions; `place` finds their unknowns.
///
/// Rows of open nodes are `z = 0`, and `p = 0` too where they are apart. What they ask for is known, and what a solver
/// finds differs from it by round-off, or by what an iterative one leaves. That would decide
/// the friction of a node that closes next, as the derivative of `varpi = mu max(p, 0)` jumps
/// at zero, and with it how many iterations follow.
fn add_tractions(
    tractions: &mut Tractions,
    correction: &[f64],
    factor: f64,
    place: impl Fn(Side, SurfaceNode) -> Option<(usize, Rows)>,
) {
    for side in Side::BOTH {
        let nodes = tractions.nodes[side]
            .iter_mut()
            .zip(&tractions.labels[side]);
        for (node, (unknowns, label)) in nodes.enumerate() {
            let Some((first, rows)) = place(side, SurfaceNode::new(node)) else {
                continue;
            };
            let is_open = rows == Rows::OfStatus && label.status == Status::Open;
            for (component, unknown) in unknowns.iter_mut().enumerate() {
                let is_known = is_open && (component > 0 || label.apart);
                let change = match is_known {
                    true => -*unknown,
                    false => correction[first + component],
                };
                *unknown += factor * change;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_nodes_keep_nothing_of_the_errors_of_solvers() {
        let mut tractions = Tractions::zero([3, 0]);
        tractions.nodes[Side::A] = vec![[4.0, 2.0, -2.0]; 3];
        for (node, status) in [Status::Open, Status::Stick].into_iter().enumerate() {
            tractions.labels[Side::A][node].status = status;
            tractions.labels[Side::A][node].apart = status == Status::Open;
        }
        let correction = [-4.0 + 1e-13, -2.0, 2.0 + 1e-7];
        let place = |_, node: SurfaceNode| {
            let rows = [Rows::OfStatus, Rows::OfStatus, Rows::Idle];
            Some((0, rows[node.index()]))
        };
        let mut half = tractions.clone();
        add_tractions(&mut half, &correction, 0.5, place);
        assert_eq!(half.nodes[Side::A][0], [2.0, 1.0, -1.0]);
        add_tractions(&mut tractions, &correction, 1.0, place);
        let [open, stick, idle] = &tractions.nodes[Side::A][..] else {
            panic!("three nodes")
        };
        assert_eq!(open, &[0.0; 3]);
        assert!(stick[0] > 0.0 && stick[2] > 0.0);
        assert_eq!(stick, idle);
    }
}
