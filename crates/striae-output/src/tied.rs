//! Tied surfaces in files.

use std::path::Path;

use striae_contact::side::Side;
use striae_mesh::{NodeId, Vec3};
use striae_solve::{
    problem::Problem,
    report::{TieTraction, tie_surface},
    state::State,
};

use crate::{
    OutputError,
    vtk::{Array, Cells, Grid, Values, write},
};

/// Writes a side of a tie in a state, with the tractions at its nodes.
pub(crate) fn write_tied(
    path: &Path,
    problem: &Problem,
    state: &State,
    (tie, side): (usize, Side),
    tractions: &[TieTraction],
) -> Result<(), OutputError> {
    let surface = tie_surface(problem, tie, side);
    let first = problem.first_node[problem.ties.joints[tie].bodies[side]];
    let nodes = surface.nodes().iter();
    let points: Vec<Vec3> = nodes
        .map(|node| state.positions[first + node.index()])
        .collect();
    let facets = surface.facets().iter();
    let quads: Vec<[NodeId; 4]> = facets
        .map(|corners| corners.map(|node| NodeId(node.0)))
        .collect();
    let vectors = |f: fn(&TieTraction) -> Vec3| Values::Vectors(tractions.iter().map(f).collect());
    let along_normal = tractions.iter().map(TieTraction::along_normal).collect();
    let grid = Grid {
        points: &points,
        cells: Cells::Quadrilaterals(&quads),
        point_arrays: vec![
            Array::new("traction", vectors(|node| node.traction)),
            Array::new("normal_traction", Values::Scalars(along_normal)),
            Array::new("shear_traction", vectors(TieTraction::shear)),
            Array::new("normal", vectors(|node| node.normal)),
        ],
        cell_arrays: Vec::new(),
        time: state.time,
    };
    write(path, &grid)
}
