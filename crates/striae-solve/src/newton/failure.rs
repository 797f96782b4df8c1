//! Words for what stops an increment: contact met unnoticed, linear systems
//! without a solution.

use striae_sparse::SolveError;

use crate::{
    assembly::{Setting, Trial},
    layout::Layout,
    node::GlobalNode,
    outcome::CutBack,
    problem::Problem,
};

/// Nodes without a share in the traction field that have met the other surface.
pub(super) fn missed(setting: &Setting, trial: &Trial) -> Option<CutBack> {
    let (context, state) = (setting.context, setting.state);
    let problem = context.problem;
    for (pair, selection) in setting.selections.iter().enumerate() {
        let start = context.configuration(pair, &state.positions, &state.rigid);
        let configuration = context.configuration(pair, &trial.positions, &trial.rigid);
        let missed = selection.left_out(&start, &configuration);
        if let Some(&(side, node)) = missed.first() {
            let global = problem.surface_node(pair, side, node)?;
            let (body, node) = problem.body_node(global);
            return Some(CutBack::MissedContact {
                pair: problem.model.pairs[pair].name.clone(),
                body: problem.model.bodies[body].name.clone(),
                node,
                count: missed.len(),
            });
        }
    }
    None
}

/// A linear system that cannot be solved, with the place of its singularity.
pub(super) fn linear_system(problem: &Problem, layout: &Layout, error: SolveError) -> CutBack {
    let place = match &error {
        SolveError::Singular { unknown, .. } => place(problem, layout, *unknown),
        _ => "linear system".to_owned(),
    };
    CutBack::LinearSystem { place, error }
}

/// Words for a global unknown.
fn place(problem: &Problem, layout: &Layout, unknown: usize) -> String {
    let at = layout
        .offsets()
        .partition_point(|&offset| offset <= unknown)
        - 1;
    let rigid =
        (0..problem.tied.len()).find(|&rigid| layout.rigid(rigid) == Some(layout.offsets()[at]));
    if let Some(rigid) = rigid {
        let name = &problem.model.rigid_surfaces[rigid].name;
        let kind = ["x", "y", "z", "rx", "ry", "rz"][unknown - layout.offsets()[at]];
        return format!("rigid body `{name}` is free to move in {kind}");
    }
    let (body, node) = problem.body_node(GlobalNode(at));
    let name = &problem.model.bodies[body].name;
    match unknown - layout.position(GlobalNode(at)) {
        component @ 0..3 => {
            let axis = ["x", "y", "z"][component];
            format!("body `{name}` is not held: {node} is free to move in {axis}")
        }
        _ => format!("the contact traction at {node} of body `{name}` is not determined"),
    }
}
