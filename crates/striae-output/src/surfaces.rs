//! Contact surfaces in files.

use std::path::Path;

use striae_contact::unknowns::{NodeResult, Status as ContactStatus};
use striae_mesh::{NodeId, Vec3};
use striae_solve::{problem::Problem, state::State};

use crate::{
    OutputError,
    vtk::{Array, Cells, Grid, Values, write},
    worn::Sums,
};

/// Writes a side of a pair as it is in a state, with what slip has done to its nodes and
/// the coefficient of wear, if one is known.
pub(crate) fn write_surface(
    path: &Path,
    problem: &Problem,
    state: &State,
    pair: usize,
    side: usize,
    (worn, wear): (&[Sums], Option<f64>),
) -> Result<(), OutputError> {
    let geometry = &problem.pairs[pair];
    let Some(surface) = geometry.contact.sides[side].surface() else {
        return Ok(());
    };
    let global = |node: usize| problem.surface_node(pair, side, node as u32);
    let count = surface.nodes().len();
    let points: Vec<Vec3> = (0..count)
        .filter_map(global)
        .map(|n| state.positions[n])
        .collect();
    let quads: Vec<[NodeId; 4]> = surface
        .facets()
        .iter()
        .map(|corners| corners.map(NodeId))
        .collect();
    let nodes = &state.pairs[pair].nodes[side];
    let scalars = |f: fn(&NodeResult) -> f64| Values::Scalars(nodes.iter().map(f).collect());
    let vectors = |f: fn(&NodeResult) -> Vec3| Values::Vectors(nodes.iter().map(f).collect());
    let sums = |at: usize, factor: f64| {
        Values::Scalars(worn.iter().map(|sums| factor * sums[at]).collect())
    };
    let status = nodes.iter().map(|node| match node.status {
        ContactStatus::Open => 0,
        ContactStatus::Stick => 1,
        ContactStatus::Slip => 2,
    });
    // Points of a rigid side lodge with nodes of side `a`.
    let lodged = &state.pairs[pair].points;
    let lodges = |node: usize| side == 0 && lodged.get(node).is_some_and(Option::is_some);
    let own = state.pairs[pair].pointed[side].iter().enumerate();
    let pointed = own.map(|(node, own)| u8::from(*own) + 2 * u8::from(lodges(node)));
    let codes = |nodes: &[bool]| Values::Codes(nodes.iter().copied().map(u8::from).collect());
    let kept = &state.pairs[pair].kept;
    let mut grid = Grid {
        points: &points,
        cells: Cells::Quadrilaterals(&quads),
        point_arrays: vec![
            Array::new("gap", scalars(|node| node.gap)),
            Array::new("pressure", scalars(|node| node.pressure)),
            Array::new(
                "traction",
                vectors(|node| node.tau - node.normal * node.pressure),
            ),
            Array::new("friction_traction", vectors(|node| node.tau)),
            Array::new("mean_pressure", scalars(NodeResult::mean_pressure)),
            Array::new("mean_traction", vectors(|node| node.mean)),
            Array::new("slip", vectors(|node| node.slip)),
            Array::new("accumulated_slip", sums(0, 1.0)),
            Array::new("friction_work", sums(1, 1.0)),
            Array::new("normal", vectors(|node| node.normal)),
            Array::new("texture", vectors(|node| node.texture)),
            Array::new(
                "structural_vector",
                vectors(|node| node.normal.cross(&node.texture)),
            ),
            Array::new("status", Values::Codes(status.collect())),
            Array::new("kept", codes(&kept[side])),
            Array::new("pointed", Values::Codes(pointed.collect())),
        ],
        cell_arrays: Vec::new(),
        time: state.time,
    };
    if let Some(coefficient) = wear {
        let depth = Array::new("wear_depth", sums(2, coefficient));
        grid.point_arrays.push(depth);
    }
    write(path, &grid)
}
