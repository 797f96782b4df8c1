//! Elements in the order that Python sees: by kind, as in `Mesh.cells`.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use striae::mesh::{self, CellKind, ElementId};

use crate::{array::Array1, fault::refused};

/// Kinds of cells as meshio calls them.
pub const KINDS: [(&str, CellKind); 5] = [
    ("hexahedron", CellKind::Hexahedron),
    ("wedge", CellKind::Wedge),
    ("pyramid", CellKind::Pyramid),
    ("tetra", CellKind::Tetrahedron),
    ("tetra10", CellKind::CompositeTetrahedron),
];

/// The elements of a mesh in this order.
pub fn by_kind(mesh: &mesh::Mesh) -> Vec<usize> {
    let mut first = 0;
    let mut blocks = Vec::with_capacity(mesh.blocks.len());
    for block in &mesh.blocks {
        blocks.push((block.kind, first..first + block.len()));
        first += block.len();
    }
    let of_kind = |(_, kind)| blocks.iter().filter(move |(known, _)| *known == kind);
    let all = KINDS.into_iter().flat_map(of_kind);
    all.flat_map(|(_, elements)| elements.clone()).collect()
}

/// Members of an element set in this order.
pub fn members<'py>(py: Python<'py>, mesh: &mesh::Mesh, name: &str) -> Option<Array1<'py, i64>> {
    let members = mesh.element_sets.get(name)?;
    let mut places = vec![0; mesh.element_count()];
    for (place, element) in by_kind(mesh).into_iter().enumerate() {
        places[element] = place as i64;
    }
    let mut found: Vec<i64> = members.iter().map(|at| places[at.index()]).collect();
    found.sort_unstable();
    Some(PyArray1::from_vec(py, found))
}

/// The mesh with a set of elements by their numbers in this order.
pub fn with_set(
    mesh: &mesh::Mesh,
    name: &str,
    members: &PyReadonlyArray1<'_, i64>,
) -> PyResult<mesh::Mesh> {
    let order = by_kind(mesh);
    let element = |number: &i64| {
        let found = usize::try_from(*number).ok().and_then(|at| order.get(at));
        found.map(|at| ElementId::new(*at)).ok_or_else(|| {
            let count = order.len();
            let text = format!("refers to element {number}, but the mesh has {count} elements");
            refused(format!("element set `{name}`"), text)
        })
    };
    let members = members.as_array();
    let members: PyResult<Vec<ElementId>> = members.iter().map(element).collect();
    let mut mesh = mesh.clone();
    mesh.element_sets.insert(name, members?);
    Ok(mesh)
}

/// Middles of the elements in this order: means of their corners.
pub fn middles(mesh: &mesh::Mesh) -> impl ExactSizeIterator<Item = [f64; 3]> {
    by_kind(mesh).into_iter().map(|element| {
        let corners = mesh.element_positions(ElementId::new(element));
        let sum: mesh::Vec3 = corners.iter().sum();
        (sum / corners.len() as f64).into()
    })
}
