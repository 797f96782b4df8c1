//! What a file says of a mesh, by the file's own numbers, and the mesh made of it.

use super::division::{self, Middles};
use super::{Asked, MeshFileFault, Place, Reading};
use std::collections::{BTreeMap, HashMap, HashSet};
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
    /// Node numbers with the place that names them.
    pub(super) node_sets: BTreeMap<String, Vec<(Place, u64)>>,
    /// Element numbers with the place that names them.
    pub(super) element_sets: BTreeMap<String, Vec<(Place, u64)>>,
    /// Faces with the place that names them.
    pub(super) facet_sets: BTreeMap<String, Vec<(Place, FileFace)>>,
    /// What is made of something else than the file says.
    pub(super) notes: Vec<String>,
    /// The formulation that the elements of the file ask for.
    pub(super) asked: Option<Asked>,
}

/// An element of the file, or a part of one.
#[derive(Clone)]
pub(super) struct FileElement {
    pub(super) place: Place,
    pub(super) number: u64,
    pub(super) kind: CellKind,
    /// Corners; more nodes of an element of higher order, in the order of `division.rs`.
    pub(super) corners: Vec<u64>,
}

/// A face as a file names it.
#[derive(Clone, Copy, Debug)]
pub(super) enum FileFace {
    /// By its corners, in any order.
    Corners([u64; 4]),
    /// A quadrilateral of a divided cell by its corners and the middles of its edges.
    Eight([u64; 4], [u64; 4]),
    /// By element number and side, as [`Face::side`].
    Side(u64, u8),
}

/// The elements of a file when those of higher order are divided.
struct Divided {
    /// Linear elements, those of a kind together.
    elements: Vec<FileElement>,
    /// All nodes of the elements that are divided, by number.
    wholes: HashMap<u64, (CellKind, Vec<u64>)>,
    middles: Middles,
}

impl Collected {
    /// The mesh, checked, and what there is to say about it.
    pub(super) fn mesh(mut self) -> Result<Reading, MeshFileFault> {
        if self.elements.is_empty() {
            return Err(MeshFileFault::Empty {
                expected: "tetrahedra, pyramids, wedges or hexahedra",
                remedy: "mesh the volume of the body and save it",
            });
        }
        let divided = self.divided()?;
        let node_ids = node_ids(&divided.elements);
        let element_ids = element_ids(&divided.elements);
        let mut mesh = Mesh::new(
            node_ids.keys().map(|number| self.nodes[number]).collect(),
            blocks(&divided.elements, &node_ids),
        )?;
        check_shape(&divided.elements, &mesh)?;
        mesh.facet_sets = self.facet_sets(&mesh, &node_ids, &element_ids, &divided)?;
        mesh.node_sets = self.node_sets(&mesh, &node_ids)?;
        mesh.element_sets = self.element_sets(&element_ids)?;
        mesh.check()?;
        Ok(Reading {
            mesh,
            notes: self.notes,
            asked: self.asked,
        })
    }

    /// Numbers of the nodes that elements use, in the order of their ids.
    pub(super) fn node_numbers(mut self) -> Result<Vec<u64>, MeshFileFault> {
        let divided = self.divided()?;
        Ok(node_ids(&divided.elements).into_keys().collect())
    }

    /// Divides elements of higher order and adds the nodes they lack.
    fn divided(&mut self) -> Result<Divided, MeshFileFault> {
        self.check_elements()?;
        let mut middles = Middles::beside(&self.nodes);
        let is_divided =
            |element: &FileElement| division::is_divided(element.kind, element.corners.len());
        for element in self.elements.iter().filter(|element| is_divided(element)) {
            middles.note(element.kind, &element.corners);
        }
        let (mut elements, mut wholes) = (Vec::new(), HashMap::new());
        let mut counts: BTreeMap<(CellKind, usize), usize> = BTreeMap::new();
        for element in std::mem::take(&mut self.elements) {
            if !is_divided(&element) {
                elements.push(element);
                continue;
            }
            let kind = element.kind;
            *counts.entry((kind, element.corners.len())).or_default() += 1;
            let nodes = element.corners.clone();
            let all = division::completed(kind, nodes, &mut middles, &mut self.nodes);
            let all = all.expect("nodes that have been checked");
            elements.extend(division::parts(kind).into_iter().map(|part| FileElement {
                corners: part.iter().map(|at| all[*at]).collect(),
                ..element
            }));
            wholes.insert(element.number, (kind, all));
        }
        for ((kind, nodes), count) in counts {
            let (name, are) = match count {
                1 => (kind.shape().name, "is"),
                _ => (kind.shape().plural, "are"),
            };
            self.notes.push(format!(
                "{count} {name} of {nodes} nodes {are} divided into {} linear ones",
                8 * count
            ));
        }
        // Few blocks of many cells: elements of one kind together, in the order of the file.
        elements.sort_by_key(|element| element.kind);
        Ok(Divided {
            elements,
            wholes,
            middles,
        })
    }

    /// Checks that numbers are new and nodes are there.
    fn check_elements(&self) -> Result<(), MeshFileFault> {
        let mut known = HashSet::new();
        for element in &self.elements {
            let mut corners = element.corners.iter();
            if let Some(&number) = corners.find(|number| !self.nodes.contains_key(number)) {
                return Err(missing(element.place, "node", number));
            }
        }
        for element in &self.elements {
            if !known.insert(element.number) {
                let found = format!("element {} for the second time", element.number);
                let place = element.place;
                return Err(MeshFileFault::at(place, "a new element number", found));
            }
        }
        Ok(())
    }

    fn facet_sets(
        &self,
        mesh: &Mesh,
        node_ids: &BTreeMap<u64, NodeId>,
        element_ids: &HashMap<u64, Vec<ElementId>>,
        divided: &Divided,
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
            for &(place, face) in members {
                let of_face = match face {
                    FileFace::Side(number, side) if !divided.wholes.contains_key(&number) => {
                        let elements = element_ids.get(&number);
                        let elements = elements.ok_or_else(|| missing(place, "element", number))?;
                        let element = elements[0];
                        let sides = mesh.kind(element).faces_of_side(side);
                        let faces = sides.map(|side| mesh.face_nodes(Face { element, side }));
                        Some(faces.collect())
                    }
                    other => divided.facets(other, node_ids),
                };
                let of_face: Vec<[NodeId; 4]> = of_face.unwrap_or_default();
                let found = of_face
                    .iter()
                    .map(|nodes| boundary.get(&sorted_face(*nodes)));
                let found: Option<Vec<&Face>> = found.collect();
                let found = found.filter(|found| !found.is_empty());
                faces.extend(found.ok_or_else(|| not_on_boundary(place, name, face))?);
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
            if let Some((place, number)) = members
                .iter()
                .find(|(_, number)| !self.nodes.contains_key(number))
            {
                return Err(missing(*place, "node", *number));
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
        element_ids: &HashMap<u64, Vec<ElementId>>,
    ) -> Result<Sets<ElementId>, MeshFileFault> {
        let mut sets = Sets::default();
        sets.insert("all", element_ids.values().flatten().copied());
        for (name, members) in &self.element_sets {
            let elements: Result<Vec<&Vec<ElementId>>, MeshFileFault> = members
                .iter()
                .map(|&(place, number)| {
                    let ids = element_ids.get(&number);
                    ids.ok_or_else(|| missing(place, "element", number))
                })
                .collect();
            sets.insert(name, elements?.into_iter().flatten().copied());
        }
        Ok(sets)
    }
}

impl Divided {
    /// Nodes of the facets of a face that is known by its nodes, or of a divided element.
    fn facets(&self, face: FileFace, node_ids: &BTreeMap<u64, NodeId>) -> Option<Vec<[NodeId; 4]>> {
        let facets = match face {
            FileFace::Corners(corners) => vec![corners],
            FileFace::Eight(corners, on) => {
                division::quartered(corners, on, self.middles.of(corners)?)
            }
            FileFace::Side(number, side) => {
                let (kind, nodes) = &self.wholes[&number];
                division::facets(*kind, side.into(), nodes)
            }
        };
        let facets = facets.into_iter();
        facets
            .map(|corners| corner_nodes(corners, node_ids))
            .collect()
    }
}

/// New ids of the nodes of elements, in ascending order of their numbers.
fn node_ids(elements: &[FileElement]) -> BTreeMap<u64, NodeId> {
    let numbers = elements.iter().flat_map(|element| &element.corners);
    let mut ids: BTreeMap<u64, NodeId> = numbers.map(|number| (*number, NodeId(0))).collect();
    for (index, id) in ids.values_mut().enumerate() {
        *id = NodeId::new(index);
    }
    ids
}

fn blocks(elements: &[FileElement], node_ids: &BTreeMap<u64, NodeId>) -> Vec<CellBlock> {
    let corners = |element: &FileElement| -> Vec<NodeId> {
        let numbers = element.corners.iter();
        numbers.map(|number| node_ids[number]).collect()
    };
    let cells = elements.iter().map(|e| (e.kind, corners(e)));
    let cells: Vec<(CellKind, Vec<NodeId>)> = cells.collect();
    CellBlock::runs(cells.iter().map(|(kind, corners)| (*kind, &corners[..])))
}

/// Ids of the elements, or of all parts of those that are divided.
fn element_ids(elements: &[FileElement]) -> HashMap<u64, Vec<ElementId>> {
    let mut ids: HashMap<u64, Vec<ElementId>> = HashMap::new();
    for (index, element) in elements.iter().enumerate() {
        let of_number = ids.entry(element.number).or_default();
        of_number.push(ElementId::new(index));
    }
    ids
}

fn check_shape(elements: &[FileElement], mesh: &Mesh) -> Result<(), MeshFileFault> {
    match mesh.check_shape() {
        Err(MeshError::Inverted {
            element,
            determinant,
            ..
        }) => {
            let FileElement { place, number, .. } = &elements[element.index()];
            let found = format!("element {number} with {determinant:.3e}");
            let fault = MeshFileFault::at(*place, "a positive Jacobian determinant", found);
            Err(fault.with_remedy("repair the mesh or reverse the order of the corners"))
        }
        other => Ok(other?),
    }
}

/// The position of a node, which is finite.
pub(super) fn position(place: Place, number: u64, x: Vec3) -> Result<Vec3, MeshFileFault> {
    if x.iter().all(|coordinate| coordinate.is_finite()) {
        return Ok(x);
    }
    let found = format!("node {number} at ({}, {}, {})", x.x, x.y, x.z);
    Err(MeshFileFault::at(place, "finite coordinates", found))
}

fn corner_nodes(numbers: [u64; 4], node_ids: &BTreeMap<u64, NodeId>) -> Option<[NodeId; 4]> {
    let mut nodes = [NodeId(0); 4];
    for (node, number) in nodes.iter_mut().zip(numbers) {
        *node = *node_ids.get(&number)?;
    }
    Some(nodes)
}

fn missing(place: Place, what: &str, number: u64) -> MeshFileFault {
    let found = format!("{what} {number}, which the file does not define");
    MeshFileFault::at(place, format!("an existing {what}"), found)
}

fn not_on_boundary(place: Place, set: &str, face: FileFace) -> MeshFileFault {
    let found = match face {
        FileFace::Corners(corners) | FileFace::Eight(corners, _) => {
            format!("the nodes {corners:?}")
        }
        FileFace::Side(element, side) => format!("side {} of element {element}", side + 1),
    };
    let expected = format!("a face on the boundary of the body in set '{set}'");
    MeshFileFault::at(place, expected, found)
        .with_remedy("sets of faces hold outer faces of the body only")
}
