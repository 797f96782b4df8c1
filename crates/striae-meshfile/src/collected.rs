//! What a file says of a mesh, by the file's own numbers, and the mesh made of it.

use super::MeshFileFault;
use std::collections::{BTreeMap, HashMap};
use striae_mesh::{
    CellBlock, CellKind, ElementId, Face, Mesh, MeshError, NodeId, Sets, Vec3, sorted_face,
};

/// Nodes, elements and sets by the numbers of the file.
#[derive(Default)]
pub(super) struct Collected {
    /// Position by node number.
    pub(super) nodes: BTreeMap<u64, Vec3>,
    /// Elements in the order of the file.
    pub(super) elements: Vec<FileElement>,
    /// Node numbers with the line that names them.
    pub(super) node_sets: BTreeMap<String, Vec<(usize, u64)>>,
    /// Element numbers with the line that names them.
    pub(super) element_sets: BTreeMap<String, Vec<(usize, u64)>>,
    /// Faces with the line that names them.
    pub(super) facet_sets: BTreeMap<String, Vec<(usize, FileFace)>>,
}

/// An element of the file.
pub(super) struct FileElement {
    pub(super) line: usize,
    pub(super) number: u64,
    pub(super) kind: CellKind,
    pub(super) corners: Vec<u64>,
}

/// A face as a file names it.
#[derive(Clone, Copy, Debug)]
pub(super) enum FileFace {
    /// By its corners, in any order.
    Corners([u64; 4]),
    /// By element number and side, as [`Face::side`].
    Side(u64, u8),
}

impl Collected {
    /// The mesh, checked.
    pub(super) fn mesh(mut self) -> Result<Mesh, MeshFileFault> {
        if self.elements.is_empty() {
            return Err(MeshFileFault::Empty {
                expected: "tetrahedra, pyramids, wedges or hexahedra",
                remedy: "mesh the volume of the body and save it",
            });
        }
        // Few blocks of many cells: elements of one kind together, in the order of the file.
        self.elements.sort_by_key(|element| element.kind);
        let node_ids = self.node_ids()?;
        let element_ids = self.element_ids()?;
        let mut mesh = Mesh::new(
            node_ids.keys().map(|number| self.nodes[number]).collect(),
            self.blocks(&node_ids),
        )?;
        self.check_shape(&mesh)?;
        mesh.facet_sets = self.facet_sets(&mesh, &node_ids, &element_ids)?;
        mesh.node_sets = self.node_sets(&mesh, &node_ids)?;
        mesh.element_sets = self.element_sets(&element_ids)?;
        mesh.check()?;
        Ok(mesh)
    }

    /// Numbers of the nodes that elements use, in the order of their ids.
    pub(super) fn node_numbers(&self) -> Result<Vec<u64>, MeshFileFault> {
        Ok(self.node_ids()?.into_keys().collect())
    }

    /// New ids of the nodes that elements use, in ascending order of their numbers.
    fn node_ids(&self) -> Result<BTreeMap<u64, NodeId>, MeshFileFault> {
        let mut ids = BTreeMap::new();
        for element in &self.elements {
            for &number in &element.corners {
                if !self.nodes.contains_key(&number) {
                    return Err(missing(element.line, "node", number));
                }
                ids.insert(number, NodeId(0));
            }
        }
        for (index, id) in ids.values_mut().enumerate() {
            *id = NodeId::new(index);
        }
        Ok(ids)
    }

    fn blocks(&self, node_ids: &BTreeMap<u64, NodeId>) -> Vec<CellBlock> {
        let corners = |element: &FileElement| -> Vec<NodeId> {
            let numbers = element.corners.iter();
            numbers.map(|number| node_ids[number]).collect()
        };
        let cells = self.elements.iter().map(|e| (e.kind, corners(e)));
        let cells: Vec<(CellKind, Vec<NodeId>)> = cells.collect();
        CellBlock::runs(cells.iter().map(|(kind, corners)| (*kind, &corners[..])))
    }

    fn element_ids(&self) -> Result<HashMap<u64, ElementId>, MeshFileFault> {
        let mut ids = HashMap::new();
        for (index, element) in self.elements.iter().enumerate() {
            if ids.insert(element.number, ElementId::new(index)).is_some() {
                let found = format!("element {} for the second time", element.number);
                return Err(MeshFileFault::line(
                    element.line,
                    "a new element number",
                    found,
                ));
            }
        }
        Ok(ids)
    }

    fn check_shape(&self, mesh: &Mesh) -> Result<(), MeshFileFault> {
        match mesh.check_shape() {
            Err(MeshError::Inverted {
                element,
                determinant,
                ..
            }) => {
                let FileElement { line, number, .. } = &self.elements[element.index()];
                let found = format!("element {number} with {determinant:.3e}");
                let fault = MeshFileFault::line(*line, "a positive Jacobian determinant", found);
                Err(fault.with_remedy("repair the mesh or reverse the order of the corners"))
            }
            other => Ok(other?),
        }
    }

    fn facet_sets(
        &self,
        mesh: &Mesh,
        node_ids: &BTreeMap<u64, NodeId>,
        element_ids: &HashMap<u64, ElementId>,
    ) -> Result<Sets<Face>, MeshFileFault> {
        let mut sets = Sets::default();
        if self.facet_sets.is_empty() {
            return Ok(sets);
        }
        let boundary: HashMap<[NodeId; 4], Face> = mesh
            .boundary_faces()
            .into_iter()
            .map(|face| (sorted_face(mesh.face_nodes(face)), face))
            .collect();
        for (name, members) in &self.facet_sets {
            let mut faces = Vec::with_capacity(members.len());
            for &(line, face) in members {
                let of_face: Vec<[NodeId; 4]> = match face {
                    FileFace::Corners(numbers) => {
                        corner_nodes(numbers, node_ids).into_iter().collect()
                    }
                    FileFace::Side(number, side) => {
                        let element = *element_ids
                            .get(&number)
                            .ok_or_else(|| missing(line, "element", number))?;
                        let sides = mesh.kind(element).faces_of_side(side);
                        let faces = sides.map(|side| mesh.face_nodes(Face { element, side }));
                        faces.collect()
                    }
                };
                let found = of_face
                    .iter()
                    .map(|nodes| boundary.get(&sorted_face(*nodes)));
                let found: Option<Vec<&Face>> = found.collect();
                let found = found.filter(|found| !found.is_empty());
                faces.extend(found.ok_or_else(|| not_on_boundary(line, name, face))?);
            }
            sets.insert(name, faces);
        }
        Ok(sets)
    }

    fn node_sets(
        &self,
        mesh: &Mesh,
        node_ids: &BTreeMap<u64, NodeId>,
    ) -> Result<Sets<NodeId>, MeshFileFault> {
        let mut sets = Sets::default();
        sets.insert("all", node_ids.values().copied());
        for (name, faces) in mesh.facet_sets.iter() {
            sets.insert(name, mesh.nodes_of_faces(faces));
        }
        for (name, members) in &self.node_sets {
            if let Some((line, number)) = members
                .iter()
                .find(|(_, number)| !self.nodes.contains_key(number))
            {
                return Err(missing(*line, "node", *number));
            }
            let used: Vec<NodeId> = members
                .iter()
                .filter_map(|(_, number)| node_ids.get(number).copied())
                .collect();
            if !used.is_empty() {
                sets.insert(name, used);
            }
        }
        Ok(sets)
    }

    fn element_sets(
        &self,
        element_ids: &HashMap<u64, ElementId>,
    ) -> Result<Sets<ElementId>, MeshFileFault> {
        let mut sets = Sets::default();
        sets.insert("all", element_ids.values().copied());
        for (name, members) in &self.element_sets {
            let elements: Result<Vec<ElementId>, MeshFileFault> = members
                .iter()
                .map(|&(line, number)| {
                    let id = element_ids.get(&number).copied();
                    id.ok_or_else(|| missing(line, "element", number))
                })
                .collect();
            sets.insert(name, elements?);
        }
        Ok(sets)
    }
}

fn corner_nodes(numbers: [u64; 4], node_ids: &BTreeMap<u64, NodeId>) -> Option<[NodeId; 4]> {
    let mut nodes = [NodeId(0); 4];
    for (node, number) in nodes.iter_mut().zip(numbers) {
        *node = *node_ids.get(&number)?;
    }
    Some(nodes)
}

fn missing(line: usize, what: &str, number: u64) -> MeshFileFault {
    let found = format!("{what} {number}, which the file does not define");
    MeshFileFault::line(line, format!("an existing {what}"), found)
}

fn not_on_boundary(line: usize, set: &str, face: FileFace) -> MeshFileFault {
    let found = match face {
        FileFace::Corners(corners) => format!("the nodes {corners:?}"),
        FileFace::Side(element, side) => format!("side {} of element {element}", side + 1),
    };
    let expected = format!("a face on the boundary of the body in set '{set}'");
    MeshFileFault::line(line, expected, found)
        .with_remedy("sets of faces hold outer faces of the body only")
}
