//! A body that ranks share, in pieces: each has the elements of a rank, their nodes, and the
//! numbers of both in the whole mesh.

use std::path::{Path, PathBuf};

use striae_mesh::{CellBlock, NodeId, Vec3};
use striae_solve::{problem::Problem, state::State};

use crate::{
    BodyField, OutputError,
    bodies::body_grid,
    checksums::{Checksums, sum},
    parts::{file_of_pieces, piece},
    ranks::{agreed, on_first, told},
    vtk::{Array, Cells, ELEMENT, Grid, NODE, Values, write, write_together},
};

/// Writes a body: each rank its piece, rank 0 the file that names the pieces. Returns that file
/// and checksums of all pieces; collective.
pub(crate) fn write_pieces(
    folder: &Path,
    (problem, state): (&Problem, &State),
    (body, name, count): (usize, &str, usize),
    fields: &[BodyField],
) -> Result<(PathBuf, Checksums), OutputError> {
    let (share, rank) = (&problem.share, problem.share.team().rank());
    let grid = body_grid(problem, state, body, fields);
    let own = Own::new(problem, body, grid);
    let file = piece(name, count, rank);
    let written = match own.numbers.is_empty() {
        // A rank without an element still knows what arrays there are.
        true => Ok(None),
        false => write(&folder.join(&file), &own.grid())
            .and_then(|()| sum(folder, &file))
            .map(Some),
    };
    let written = agreed(share, written)?;
    let sums: Checksums = told(share, &written).into_iter().flatten().collect();
    let together = file_of_pieces(name, count);
    on_first(share, || {
        let beside = |(file, _): &(String, _)| {
            let name = Path::new(file).file_name().unwrap_or_default();
            name.to_string_lossy().into_owned()
        };
        let pieces: Vec<String> = sums.iter().map(beside).collect();
        write_together(&folder.join(&together), &own.grid(), &pieces)
    })?;
    Ok((together, sums))
}

/// The nodes of a grid that have elements, and all else of it.
struct Own {
    points: Vec<Vec3>,
    blocks: Vec<CellBlock>,
    point_arrays: Vec<Array>,
    cell_arrays: Vec<Array>,
    time: f64,
    /// Numbers of the elements in the whole.
    numbers: Vec<i32>,
}

impl Own {
    fn new(problem: &Problem, body: usize, grid: Grid<'_>) -> Self {
        let mesh = &problem.model.bodies[body].mesh;
        let mut places = vec![None; grid.points.len()];
        for node in mesh.elements().flatten() {
            places[node.index()] = Some(NodeId(0));
        }
        let mut kept = Vec::new();
        for (node, place) in places.iter_mut().enumerate() {
            if let Some(place) = place {
                *place = NodeId::new(kept.len());
                kept.push(node);
            }
        }
        let block = |block: &CellBlock| CellBlock {
            kind: block.kind,
            nodes: (block.nodes.iter())
                .filter_map(|node| places[node.index()])
                .collect(),
        };
        let share = &problem.share;
        let elements = (0..mesh.element_count()).map(striae_mesh::ElementId::new);
        let numbers = elements.map(|id| share.whole_element(body, id).0 as i32);
        let numbers: Vec<i32> = numbers.collect();
        let nodes = kept.iter().map(|node| {
            let node = NodeId::new(*node);
            share.whole_mesh_node(body, node).0 as i32
        });
        let mut point_arrays: Vec<Array> = (grid.point_arrays.iter())
            .map(|array| Array::new(array.name.clone(), chosen(&array.values, &kept)))
            .collect();
        point_arrays.push(Array::new(NODE, Values::Integers(nodes.collect())));
        let mut cell_arrays = grid.cell_arrays;
        cell_arrays.push(Array::new(ELEMENT, Values::Integers(numbers.clone())));
        Self {
            points: kept.iter().map(|node| grid.points[*node]).collect(),
            blocks: mesh.blocks.iter().map(block).collect(),
            point_arrays,
            cell_arrays,
            time: grid.time,
            numbers,
        }
    }

    fn grid(&self) -> Grid<'_> {
        Grid {
            points: &self.points,
            cells: Cells::Blocks(&self.blocks),
            point_arrays: self.point_arrays.clone(),
            cell_arrays: self.cell_arrays.clone(),
            time: self.time,
        }
    }
}

/// Values at some of the points.
fn chosen(values: &Values, kept: &[usize]) -> Values {
    fn of<T: Clone>(values: &[T], kept: &[usize]) -> Vec<T> {
        kept.iter().map(|at| values[*at].clone()).collect()
    }
    match values {
        Values::Scalars(values) => Values::Scalars(of(values, kept)),
        Values::Vectors(values) => Values::Vectors(of(values, kept)),
        Values::SymmetricTensors(values) => Values::SymmetricTensors(of(values, kept)),
        Values::Tensors(values) => Values::Tensors(of(values, kept)),
        Values::Integers(values) => Values::Integers(of(values, kept)),
        Values::Codes(values) => Values::Codes(of(values, kept)),
    }
}
