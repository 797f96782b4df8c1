//! A mesh for ParaView: its elements with their numbers, quality and sets.

use std::path::Path;

use striae::mesh_file::{Numbers, RigidSurfaceMesh};
use striae_mesh::{ElementId, Mesh, NodeId, quality::scaled_jacobian};
use striae_output::{
    OutputError,
    vtk::{self, Array, Cells, Grid, Values},
};

/// Writes a mesh. Arrays `elements: NAME` and `nodes: NAME` are 1 in the set, `facets: NAME` is
/// the number of facets of the element in the set.
pub fn write(mesh: &Mesh, numbers: &Numbers, file: &Path) -> Result<(), OutputError> {
    let elements = || (0..mesh.element_count()).map(ElementId::new);
    let scaled = elements()
        .map(|element| scaled_jacobian(mesh.kind(element), &mesh.element_positions(element)));
    let mut cell_arrays = vec![Array::new(
        "scaled_jacobian",
        Values::Scalars(scaled.collect()),
    )];
    let whole = |names: Vec<String>| -> Option<Values> {
        let numbers: Result<Vec<i32>, _> = names.iter().map(|name| name.parse()).collect();
        numbers.ok().map(Values::Integers)
    };
    let of_elements = whole(elements().map(|element| numbers.element(element)).collect());
    cell_arrays.extend(of_elements.map(|values| Array::new("element_number", values)));
    for (name, members) in mesh.element_sets.iter() {
        let codes = codes(mesh.element_count(), members.iter().map(|e| e.index()));
        cell_arrays.push(Array::new(format!("elements: {name}"), codes));
    }
    for (name, members) in mesh.facet_sets.iter() {
        let faces = members.iter().map(|face| face.element.index());
        let codes = codes(mesh.element_count(), faces);
        cell_arrays.push(Array::new(format!("facets: {name}"), codes));
    }
    let nodes = (0..mesh.positions.len()).map(NodeId::new);
    let of_nodes = whole(nodes.map(|node| numbers.node(node)).collect());
    let of_nodes = of_nodes.map(|values| Array::new("node_number", values));
    let mut point_arrays: Vec<Array> = of_nodes.into_iter().collect();
    for (name, members) in mesh.node_sets.iter() {
        let codes = codes(
            mesh.positions.len(),
            members.iter().map(|node| node.index()),
        );
        point_arrays.push(Array::new(format!("nodes: {name}"), codes));
    }
    let grid = Grid {
        points: &mesh.positions,
        cells: Cells::Blocks(&mesh.blocks),
        point_arrays,
        cell_arrays,
        time: 0.0,
    };
    vtk::write(file, &grid)
}

/// Writes a rigid surface.
pub fn write_surface(surface: &RigidSurfaceMesh, file: &Path) -> Result<(), OutputError> {
    let facets = surface.facets.iter().map(|nodes| {
        let mut nodes = nodes.to_vec();
        nodes.dedup();
        nodes
    });
    let facets: Vec<Vec<NodeId>> = facets.collect();
    let grid = Grid {
        points: &surface.positions,
        cells: Cells::Polygons(&facets),
        point_arrays: Vec::new(),
        cell_arrays: Vec::new(),
        time: 0.0,
    };
    vtk::write(file, &grid)
}

/// Number of times that each of so many items is a member.
fn codes(count: usize, members: impl Iterator<Item = usize>) -> Values {
    let mut codes = vec![0; count];
    members.for_each(|at| codes[at] += 1);
    Values::Codes(codes)
}
