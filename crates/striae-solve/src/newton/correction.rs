//! Corrections applied to a trial state.

use striae_contact::{
    complementarity::Iteration, evaluation::Evaluation, segment::Derivatives, side::Side,
    unknowns::Tractions,
};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use super::workspace::{SystemStorage, Workspace};
use crate::{
    assembly::{Assembled, Setting, Trial},
    layout::Layout,
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

/// How much of a correction was applied.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Taken {
    Whole,
    Part,
}

/// Applies a correction, halved while it turns elements inside out.
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
            Err(CutBack::InvertedElement { .. }) if factor > SMALLEST_PART => {
                (factor, taken) = (0.5 * factor, Taken::Part);
            }
            Err(other) => return Err(other),
        }
    }
}

/// The trial state with a part of a correction.
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
        if let Some(rigid) = problem.tie_of[node] {
            let reference = &problem.model.rigid_surfaces[rigid].reference;
            let placement = next.rigid[rigid].placement(reference);
            *position = placement.point(&problem.reference[node]);
            continue;
        }
        let first = layout.position(node);
        *position += Vec3::from_column_slice(&correction[first..first + 3]) * factor;
    }
    problem.ties.follow(&mut next.positions);
    for (pair, tractions) in next.tractions.iter_mut().enumerate() {
        add_tractions(layout, pair, tractions, correction, factor);
    }
    next
}

fn add_tractions(
    layout: &Layout,
    pair: usize,
    tractions: &mut Tractions,
    correction: &[f64],
    factor: f64,
) {
    for side in Side::BOTH {
        for (node, unknowns) in tractions.nodes[side].iter_mut().enumerate() {
            if let Some(first) = layout.traction(pair, side, SurfaceNode::new(node)) {
                for (component, unknown) in unknowns.iter_mut().enumerate() {
                    *unknown += factor * correction[first + component];
                }
            }
        }
    }
}
