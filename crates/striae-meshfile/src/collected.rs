//! Mesh as stated in a file, with the file's own numbers, and the mesh made of it.

use super::division::{self, Middles};
use super::ids::Ids;
use super::loose::Loose;
use super::{
    Asked, MaterialCard, MeshFileFault, Numbers, Place, Reading, SectionCard, Unused, numbers,
};
use std::collections::{BTreeMap, HashMap, HashSet};
use striae_mesh::{CellBlock, CellKind, ElementId, Mesh, MeshError, NodeId, Vec3};

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
    /// Elements of lower dimension in no set.
    pub(super) loose: Loose,
    /// Notes on parts of the file that were interpreted or replaced.
    pub(super) notes: Vec<String>,
    /// The formulation that the elements of the file request.
    pub(super) asked: Option<Asked>,
    /// The instances whose numbers are raised, see `abaqus/names.rs`.
    pub(super) instances: Vec<String>,
    /// Materials that the file states.
    pub(super) materials: Vec<MaterialCard>,
    /// Materials of element sets.
    pub(super) sections: Vec<SectionCard>,
    /// Keywords that no mesh is made of.
    pub(super) unused: Vec<Unused>,
    /// The name of the only instance, which stands for all elements.
    pub(super) whole: Option<String>,
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FileFace {
    /// By its corners, in any order.
    Corners([u64; 4]),
    /// A quadrilateral of a divided cell by its corners and the middles of its edges.
    Eight([u64; 4], [u64; 4]),
    /// By element number and side, as [`striae_mesh::Face::side`].
    Side(u64, u8),
    /// All faces of an element on the boundary of the body.
    Free(u64),
}

/// The elements of a file when those of higher order are divided.
pub(super) struct Divided {
    /// Linear elements, those of a kind together.
    elements: Vec<FileElement>,
    /// All nodes of the elements that are divided, by number.
    pub(super) wholes: HashMap<u64, (CellKind, Vec<u64>)>,
    pub(super) middles: Middles,
}

impl FileFace {
    /// The largest number in it.
    pub(super) fn largest(self) -> u64 {
        let largest = |nodes: &[u64]| nodes.iter().copied().fold(0, u64::max);
        match self {
            Self::Corners(corners) => largest(&corners),
            Self::Eight(corners, on) => largest(&corners).max(largest(&on)),
            Self::Side(element, _) | Self::Free(element) => element,
        }
    }

    /// The face where numbers are raised.
    pub(super) fn raised(self, by: u64) -> Self {
        let all = |nodes: [u64; 4]| nodes.map(|node| node + by);
        match self {
            Self::Corners(corners) => Self::Corners(all(corners)),
            Self::Eight(corners, on) => Self::Eight(all(corners), all(on)),
            Self::Side(element, side) => Self::Side(element + by, side),
            Self::Free(element) => Self::Free(element + by),
        }
    }
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
        let ids = Ids {
            nodes: node_ids(&divided.elements),
            elements: element_ids(&divided.elements),
            instances: self.instances.clone(),
        };
        let numbers = ids.nodes.keys();
        let mut mesh = Mesh::new(
            numbers.map(|number| self.nodes[number]).collect(),
            blocks(&divided.elements, &ids.nodes),
        )?;
        self.check_shape(&divided.elements, &mesh)?;
        self.add_sets(&mut mesh, &ids, &divided)?;
        mesh.check()?;
        self.notes.extend(self.loose.note());
        let mut sections = self.sections;
        sections.retain(|section| mesh.element_sets.get(&section.set).is_some());
        let elements = divided.elements.iter().map(|element| element.number);
        Ok(Reading {
            mesh,
            notes: self.notes,
            asked: self.asked,
            numbers: Numbers {
                nodes: ids.nodes.into_keys().collect(),
                elements: elements.collect(),
                instances: self.instances,
            },
            materials: self.materials,
            sections,
            unused: self.unused,
        })
    }

    /// A number as the file writes it, with the name of its instance if need be.
    pub(super) fn named(&self, number: u64) -> String {
        numbers::named(&self.instances, number)
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
                return Err(missing(element.place, "node", &self.named(number)));
            }
        }
        for element in &self.elements {
            if !known.insert(element.number) {
                let found = format!("element {} for the second time", self.named(element.number));
                let place = element.place;
                return Err(MeshFileFault::at(place, "a new element number", found));
            }
        }
        Ok(())
    }

    fn check_shape(&self, elements: &[FileElement], mesh: &Mesh) -> Result<(), MeshFileFault> {
        match mesh.check_shape() {
            Err(MeshError::Inverted {
                element,
                determinant,
                ..
            }) => {
                let FileElement { place, number, .. } = &elements[element.index()];
                let found = format!("element {} with {determinant:.3e}", self.named(*number));
                let fault = MeshFileFault::at(*place, "a positive Jacobian determinant", found);
                Err(fault.with_remedy("repair the mesh or reverse the order of the corners"))
            }
            other => Ok(other?),
        }
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

/// The position of a node, which is finite.
pub(super) fn position(place: Place, number: u64, x: Vec3) -> Result<Vec3, MeshFileFault> {
    if x.iter().all(|coordinate| coordinate.is_finite()) {
        return Ok(x);
    }
    let found = format!("node {number} at ({}, {}, {})", x.x, x.y, x.z);
    Err(MeshFileFault::at(place, "finite coordinates", found))
}

/// New ids of the corners of a facet, `None` where one is not in the mesh.
pub(super) fn corner_nodes(
    numbers: [u64; 4],
    node_ids: &BTreeMap<u64, NodeId>,
) -> Option<[NodeId; 4]> {
    let mut nodes = [NodeId(0); 4];
    for (node, number) in nodes.iter_mut().zip(numbers) {
        *node = *node_ids.get(&number)?;
    }
    Some(nodes)
}

/// The fault that a number stands for nothing.
pub(super) fn missing(place: Place, what: &str, number: &str) -> MeshFileFault {
    let found = format!("{what} {number}, which the file does not define");
    MeshFileFault::at(place, format!("an existing {what}"), found)
}
