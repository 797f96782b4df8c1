//! Words for what stops an increment: contact met unnoticed, linear systems
//! without a solution.

use striae_condensed::Numbering;
use striae_sparse::SolveError;

use crate::{
    assembly::{Setting, Trial},
    layout::Layout,
    outcome::CutBack,
    problem::Problem,
};
use striae_model::node::GlobalNode;

/// Nodes without a share in the traction field that have met the other surface.
pub(super) fn missed(setting: &Setting, trial: &Trial) -> Option<CutBack> {
    let (context, state) = (setting.context, setting.state);
    let problem = context.problem;
    for (pair, selection) in setting.selections.iter().enumerate() {
        let start = context.configuration(pair, &state.positions, &state.rigid);
        let configuration = context.configuration(pair, &trial.positions, &trial.rigid);
        let missed = selection.left_out(&start, &configuration);
        if let Some(&(side, node)) = missed.first() {
            let global = problem.surface_node(pair, side, node);
            let global = global.expect("nodes that are left out are those of bodies");
            let (body, node) = problem.named_node(global);
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

/// A linear system that cannot be solved, with the place of its fault; collective. Solvers name
/// unknowns by their numbers in the system of all ranks.
pub(super) fn linear_system(
    problem: &Problem,
    (layout, numbering): (&Layout, Option<&Numbering>),
    error: SolveError,
) -> CutBack {
    type Words = fn(&Problem, &Layout, usize) -> String;
    let fault: Option<(usize, Words)> = match &error {
        SolveError::NotFinite { row } => Some((*row, equilibrium)),
        SolveError::Singular { unknown, .. } => Some((*unknown, place)),
        _ => None,
    };
    let place = match (fault, numbering) {
        (Some((unknown, words)), Some(numbering)) => {
            let own = numbering.own.contains(&unknown);
            let at = || numbering.whole.iter().position(|whole| *whole == unknown);
            let found = own.then(at).flatten();
            let words = found.map(|at| words(problem, layout, at));
            told(problem, &words.unwrap_or_default())
        }
        _ => "linear system".to_owned(),
    };
    CutBack::LinearSystem { place, error }
}

/// The words of the one rank that has any; collective.
fn told(problem: &Problem, own: &str) -> String {
    let all = problem.share.team().gather(own.as_bytes());
    let words = all.iter().map(|words| String::from_utf8_lossy(words));
    words.collect()
}

/// Words for the equation of a global unknown.
fn equilibrium(problem: &Problem, layout: &Layout, row: usize) -> String {
    if let Some(cavity) = layout.cavity_of(row) {
        let name = &problem.model.cavities[cavity].name;
        return format!("the volume of cavity `{name}`");
    }
    let offsets = layout.offsets();
    let at = offsets.partition_point(|&offset| offset <= row) - 1;
    let rigid = (0..problem.tied.len()).find(|&rigid| layout.rigid(rigid) == Some(offsets[at]));
    match rigid {
        Some(rigid) => {
            let name = &problem.model.rigid_surfaces[rigid].name;
            format!("the equilibrium of rigid body `{name}`")
        }
        None => {
            let (body, node) = problem.named_node(GlobalNode(at));
            let name = &problem.model.bodies[body].name;
            format!("the equilibrium of {node} of body `{name}`")
        }
    }
}

/// Words for a global unknown.
fn place(problem: &Problem, layout: &Layout, unknown: usize) -> String {
    if let Some(cavity) = layout.cavity_of(unknown) {
        let name = &problem.model.cavities[cavity].name;
        return format!("the pressure in cavity `{name}` is undetermined");
    }
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
    let (body, node) = problem.named_node(GlobalNode(at));
    let name = &problem.model.bodies[body].name;
    match unknown - layout.position(GlobalNode(at)) {
        component @ 0..3 => {
            let axis = ["x", "y", "z"][component];
            format!("body `{name}` is not restrained: {node} is free to move in {axis}")
        }
        _ => format!("the contact traction at {node} of body `{name}` is undetermined"),
    }
}
