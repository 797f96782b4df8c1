//! Meshes of bodies, and facets of rigid surfaces from files.

use std::{collections::BTreeMap, path::PathBuf};

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use striae::{
    mesh::{self, CellBlock, Face, NodeId},
    mesh_file,
};

use crate::{
    array::{
        Array1, Array2, corners, node_array, node_rows, node_table, nodes, rows, table, vectors,
    },
    cells,
    fault::refused,
};

/// Cells with named sets.
#[pyclass(frozen, module = "striae._striae")]
pub struct Mesh(pub mesh::Mesh);

#[pymethods]
impl Mesh {
    #[new]
    fn new(
        points: PyReadonlyArray2<'_, f64>,
        cells: Vec<(String, PyReadonlyArray2<'_, i64>)>,
    ) -> PyResult<Self> {
        let points = vectors(&points)?;
        let blocks: PyResult<Vec<CellBlock>> = cells
            .iter()
            .map(|(name, corners)| block(name, corners))
            .collect();
        let shaped = mesh::Mesh::new(points, blocks?).and_then(|mesh| {
            mesh.check_shape()?;
            Ok(mesh)
        });
        made(shaped)
    }

    fn points<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, f64>> {
        rows(py, self.0.positions.iter().map(|x| (*x).into()))
    }

    /// The corners of the cells of each kind that there is.
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Vec<(&'static str, Array2<'py, i64>)>> {
        let mut all = Vec::new();
        for (name, kind) in cells::KINDS {
            let blocks = self.0.blocks.iter().filter(|block| block.kind == kind);
            let nodes: Vec<NodeId> = blocks.flat_map(|block| block.nodes.clone()).collect();
            if !nodes.is_empty() {
                all.push((name, node_table(py, &nodes, kind.corner_count())?));
            }
        }
        Ok(all)
    }

    /// Corners of the boundary faces, outward by the right-hand rule.
    fn boundary<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, i64>> {
        self.quads(py, &self.0.boundary_faces())
    }

    fn node_sets(&self) -> Vec<String> {
        self.0.node_sets.names().map(str::to_owned).collect()
    }

    fn facet_sets(&self) -> Vec<String> {
        self.0.facet_sets.names().map(str::to_owned).collect()
    }

    fn node_set<'py>(&self, py: Python<'py>, name: &str) -> Option<Array1<'py, i64>> {
        let members = self.0.node_sets.get(name)?;
        Some(node_array(py, members))
    }

    fn facet_set<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Array2<'py, i64>>> {
        let members = self.0.facet_sets.get(name);
        members.map(|faces| self.quads(py, faces)).transpose()
    }

    /// Nodes of a facet set in ascending order.
    fn facet_nodes<'py>(&self, py: Python<'py>, name: &str) -> Option<Array1<'py, i64>> {
        let faces = self.0.facet_sets.get(name)?;
        Some(node_array(py, &self.0.nodes_of_faces(faces)))
    }

    fn with_node_set(&self, name: &str, members: PyReadonlyArray1<'_, i64>) -> PyResult<Self> {
        let mut mesh = self.0.clone();
        mesh.node_sets.insert(name, nodes(&members)?);
        checked(mesh)
    }

    /// A facet set from the corners of its facets, in any order.
    fn with_facet_set(&self, name: &str, quads: PyReadonlyArray2<'_, i64>) -> PyResult<Self> {
        let sorted = |corners: [NodeId; 4]| {
            let mut corners = corners.to_vec();
            corners.sort_unstable();
            corners.dedup();
            corners
        };
        let boundary = self.0.boundary_faces().into_iter();
        let known: BTreeMap<Vec<NodeId>, Face> = boundary
            .map(|face| (sorted(self.0.face_nodes(face)), face))
            .collect();
        let mut faces = Vec::new();
        for (row, quad) in corners::<4>(&quads)?.into_iter().enumerate() {
            let face = known.get(&sorted(quad)).ok_or_else(|| {
                let numbers = quad.map(|node| node.0);
                let text = format!("row {row}, {numbers:?}, is not a face of the boundary");
                refused(format!("facet set `{name}`"), text)
            })?;
            faces.push(*face);
        }
        let mut mesh = self.0.clone();
        mesh.facet_sets.insert(name, faces);
        checked(mesh)
    }

    /// A facet set of the boundary faces all of whose corners are among the nodes.
    fn with_facets_of(&self, name: &str, members: PyReadonlyArray1<'_, i64>) -> PyResult<Self> {
        let members = nodes(&members)?;
        let count = self.0.positions.len();
        if let Some(node) = members.iter().find(|node| node.index() >= count) {
            let text = format!("refers to {node}, but the mesh has {count} nodes");
            return Err(refused(format!("facet set `{name}`"), text));
        }
        let mut mesh = self.0.clone();
        mesh.facet_sets
            .insert(name, self.0.faces_of_nodes(&members));
        checked(mesh)
    }

    /// Corners of the boundary faces whose normals are within an angle of a direction.
    fn facets_along<'py>(
        &self,
        py: Python<'py>,
        direction: [f64; 3],
        radians: f64,
    ) -> PyResult<Array2<'py, i64>> {
        let all = self.0.boundary_faces();
        self.quads(py, &self.0.faces_along(&all, &direction.into(), radians))
    }

    /// Corners of the boundary faces around a place, up to edges that turn by an angle.
    fn facets_around<'py>(
        &self,
        py: Python<'py>,
        place: [f64; 3],
        radians: f64,
    ) -> PyResult<Array2<'py, i64>> {
        let all = self.0.boundary_faces();
        self.quads(py, &self.0.faces_around(&all, &place.into(), radians))
    }

    /// Corners of the boundary faces of elements of a set.
    fn facets_of<'py>(
        &self,
        py: Python<'py>,
        elements: &str,
    ) -> PyResult<Option<Array2<'py, i64>>> {
        let members = self.0.element_sets.get(elements);
        let faces = members.map(|elements| self.0.boundary_of(elements));
        faces.map(|faces| self.quads(py, &faces)).transpose()
    }

    fn element_sets(&self) -> Vec<String> {
        self.0.element_sets.names().map(str::to_owned).collect()
    }

    fn element_set<'py>(&self, py: Python<'py>, name: &str) -> Option<Array1<'py, i64>> {
        cells::members(py, &self.0, name)
    }

    fn with_element_set(&self, name: &str, members: PyReadonlyArray1<'_, i64>) -> PyResult<Self> {
        checked(cells::with_set(&self.0, name, &members)?)
    }

    fn middles<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, f64>> {
        rows(py, cells::middles(&self.0))
    }

    fn volume(&self) -> f64 {
        self.0.volume()
    }
}

impl Mesh {
    fn quads<'py>(&self, py: Python<'py>, faces: &[Face]) -> PyResult<Array2<'py, i64>> {
        node_rows(py, faces.iter().map(|face| self.0.face_nodes(*face)))
    }
}

fn block(name: &str, corners: &PyReadonlyArray2<'_, i64>) -> PyResult<CellBlock> {
    let known = cells::KINDS.iter().find(|(known, _)| *known == name);
    let (_, kind) = known.ok_or_else(|| refused("cells", format!("no kind is `{name}`")))?;
    Ok(CellBlock {
        kind: *kind,
        nodes: table(corners, kind.corner_count())?,
    })
}

/// The mesh with its sets `all`, or `striae.ModelError`.
pub fn made(mesh: Result<mesh::Mesh, impl std::fmt::Display>) -> PyResult<Mesh> {
    let mut mesh = mesh.map_err(|error| refused("mesh", error))?;
    mesh.name_all_facets();
    mesh.name_all_elements();
    Ok(Mesh(mesh))
}

fn checked(mesh: mesh::Mesh) -> PyResult<Mesh> {
    let found = mesh.check();
    made(found.map(|()| mesh))
}

/// Reads the mesh of a body, or of a part of it.
#[pyfunction]
pub fn read_mesh(path: PathBuf, elements: Option<String>) -> PyResult<Mesh> {
    let reading = mesh_file::read_part(path, elements.as_deref());
    made(reading.map(|reading| reading.mesh))
}

/// Reads the facets of a rigid surface.
#[pyfunction]
pub fn read_rigid_surface(
    py: Python<'_>,
    path: PathBuf,
) -> PyResult<(Array2<'_, f64>, Array2<'_, i64>)> {
    let surface = mesh_file::read_rigid_surface(path).map_err(|error| refused("mesh", error))?;
    let points = rows(py, surface.positions.iter().map(|x| (*x).into()))?;
    Ok((points, node_rows(py, surface.facets.into_iter())?))
}
