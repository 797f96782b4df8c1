//! A part of an Abaqus file: nodes, elements, sets and surfaces under its own numbers; or the
//! whole in which parts have been placed.

use super::super::collected::{Collected, FileElement, FileFace, missing, position};
use super::super::lines::parsed;
use super::super::numbers::NUMBER_BITS;
use super::super::{Asked, MeshFileFault, Place, RigidSurfaceMesh, SectionCard};
use super::instance::Placement;
use super::keywords::{Keyword, Row};
use super::lower::{self, Lower};
use super::names::Names;
use super::number;
use super::sets::{LabelSets, Member};
use std::{
    collections::{BTreeMap, HashSet},
    iter::once,
};
use striae_mesh::{CellKind, NodeId, Vec3};

/// Content of a part.
#[derive(Clone)]
pub(super) struct Part {
    nodes: BTreeMap<u64, Vec3>,
    elements: Vec<FileElement>,
    pub(super) node_sets: LabelSets,
    pub(super) element_sets: LabelSets,
    pub(super) lower: Lower,
    pub(super) surfaces: Surfaces,
    /// Element sets with their material.
    sections: Vec<(String, String)>,
    notes: Vec<String>,
    asked: Option<Asked>,
}

/// Use of a keyword.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Mesh,
    Nothing,
}

/// Faces by the label of their surface in capitals, with the label as it was first spelled.
pub(super) type Surfaces = BTreeMap<String, (String, Vec<(Place, FileFace)>)>;

impl Default for Part {
    fn default() -> Self {
        Self {
            nodes: BTreeMap::new(),
            elements: Vec::new(),
            node_sets: LabelSets::new(Member::Node),
            element_sets: LabelSets::new(Member::Element),
            lower: Lower::default(),
            surfaces: Surfaces::new(),
            sections: Vec::new(),
            notes: Vec::new(),
            asked: None,
        }
    }
}

impl Part {
    /// Rows `number, x, y, z`; missing coordinates are zero.
    pub(super) fn read_nodes(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        if keyword
            .parameter("SYSTEM")
            .is_some_and(|system| system != "R")
        {
            return Err(keyword.fault("Cartesian coordinates"));
        }
        keyword.refuse_input()?;
        for row in &keyword.rows {
            let tag: u64 = parsed(row.line, row.words[0], "a node number")?;
            let mut x = Vec3::zeros();
            for axis in 0..3 {
                let word = row.words.get(axis + 1).copied().unwrap_or("");
                if !word.is_empty() {
                    x[axis] = number(word).ok_or_else(|| row.fault("a coordinate"))?;
                }
            }
            let x = position(Place::Line(row.line), tag, x)?;
            if self.nodes.insert(tag, x).is_some() {
                return Err(row.fault("a node number that has not been used"));
            }
            if let Some(set) = keyword.parameter("NSET") {
                self.node_sets.push(set, row.line, tag);
            }
        }
        Ok(())
    }

    /// Rows `number, corners..`.
    pub(super) fn read_elements(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        let name = keyword.required("TYPE")?.to_uppercase();
        let Some((kind, nodes)) = cell(&name) else {
            if !lower::is_solid(&name) {
                return self.lower.read(&name, keyword, &mut self.element_sets);
            }
            let fault = keyword.fault(
                "TYPE=C3D4, C3D5, C3D6, C3D8, C3D10, C3D15, C3D20, C3D27 or one of their variants",
            );
            return Err(fault.with_remedy("mesh the part with these elements"));
        };
        self.ask(&name);
        let expected = format!("an element number and {nodes} node numbers");
        keyword.refuse_input()?;
        for row in keyword.joined_rows(nodes + 1) {
            let numbers: Vec<u64> = row
                .words
                .iter()
                .map(|word| parsed(row.line, word, &expected))
                .collect::<Result<_, _>>()?;
            let (number, corners) = match numbers.as_slice() {
                [number, corners @ ..] if corners.len() == nodes => (number, corners),
                _ => return Err(row.fault(&expected)),
            };
            if let Some(set) = keyword.parameter("ELSET") {
                self.element_sets.push(set, row.line, *number);
            }
            self.elements.push(FileElement {
                kind,
                place: Place::Line(row.line),
                number: *number,
                corners: ordered(corners),
            });
        }
        Ok(())
    }

    /// Notes what the letters of a kind of element request.
    fn ask(&mut self, name: &str) {
        let letters = name
            .trim_start_matches("C3D")
            .trim_start_matches(|c: char| c.is_numeric());
        let asked = match letters.contains('H') {
            true => Some(Asked::MeanDilatation),
            false => letters.contains('I').then_some(Asked::AssumedStrain),
        };
        self.asked = self.asked.or(asked);
        if letters.contains('R') {
            self.note(format!(
                "elements {name} are read as elements with full integration"
            ));
        }
    }

    /// Says something once.
    pub(super) fn note(&mut self, note: String) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    pub(super) fn read_node_set(
        &mut self,
        keyword: &Keyword<'_>,
        names: &Names,
    ) -> Result<(), MeshFileFault> {
        let name = keyword.required("NSET")?;
        let Some(elements) = keyword.parameter("ELSET") else {
            return names.extend(&mut self.node_sets, name, keyword);
        };
        let row = Row::of_word(keyword.line, elements);
        let members = names.members(&self.element_sets, &row, elements);
        let members = members.map_err(|_| keyword.fault("an element set defined before"))?;
        let chosen: HashSet<u64> = members.into_iter().collect();
        for element in &self.elements {
            if chosen.contains(&element.number) {
                for &corner in &element.corners {
                    self.node_sets.push(name, keyword.line, corner);
                }
            }
        }
        for node in self.lower.nodes(&chosen) {
            self.node_sets.push(name, keyword.line, node);
        }
        Ok(())
    }

    pub(super) fn read_element_set(
        &mut self,
        keyword: &Keyword<'_>,
        names: &Names,
    ) -> Result<(), MeshFileFault> {
        let name = keyword.required("ELSET")?;
        names.extend(&mut self.element_sets, name, keyword)
    }

    /// The material of an element set; layers have several.
    pub(super) fn read_section(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        let set = keyword.required("ELSET")?;
        if keyword.parameter("COMPOSITE").is_some() {
            self.note(format!(
                "the layers of *SOLID SECTION of `{set}` are ignored"
            ));
            return Ok(());
        }
        let material = keyword.required("MATERIAL")?;
        self.sections.push((set.to_owned(), material.to_owned()));
        Ok(())
    }

    pub(super) fn surface(&mut self, label: &str) -> &mut Vec<(Place, FileFace)> {
        let surface = self.surfaces.entry(label.to_uppercase());
        let (_, faces) = surface.or_insert_with(|| (label.to_owned(), Vec::new()));
        faces
    }

    /// Puts another part into this whole.
    pub(super) fn place(&mut self, part: &Self, at: &Placement) {
        let raised = |number: u64| number + at.raise;
        for (number, x) in &part.nodes {
            self.nodes.insert(raised(*number), at.motion.moved(*x));
        }
        self.elements
            .extend(part.elements.iter().map(|element| FileElement {
                number: raised(element.number),
                corners: element.corners.iter().map(|node| raised(*node)).collect(),
                ..*element
            }));
        self.node_sets.place(&part.node_sets, at);
        self.element_sets.place(&part.element_sets, at);
        self.lower.place(&part.lower, at.raise);
        for (label, faces) in part.surfaces.values() {
            let faces = faces.iter();
            let faces = faces.map(|(place, face)| (*place, face.raised(at.raise)));
            let label = format!("{}{label}", at.prefix);
            self.surface(&label).extend(faces);
        }
        let sections = part.sections.iter();
        let placed = sections.map(|(set, of)| (format!("{}{set}", at.prefix), of.clone()));
        self.sections.extend(placed);
        self.asked = self.asked.or(part.asked);
        part.notes.iter().for_each(|note| self.note(note.clone()));
    }

    /// Knows the sets that nodes or elements are put into, without members.
    pub(super) fn name_sets(&mut self, keyword: &Keyword<'_>) {
        let labels = ["NSET", "ELSET"].map(|key| keyword.parameter(key));
        labels[0]
            .into_iter()
            .for_each(|set| self.node_sets.name(set));
        labels[1]
            .into_iter()
            .for_each(|set| self.element_sets.name(set));
    }

    /// Adds the sets of all nodes and of all elements of a placed part, by a name.
    pub(super) fn name_all(&mut self, part: &Self, raise: u64, name: &str, line: usize) {
        for node in part.nodes.keys() {
            self.node_sets.push(name, line, node + raise);
        }
        for element in &part.elements {
            self.element_sets.push(name, line, element.number + raise);
        }
    }

    /// Returns whether all numbers are below the limit that holds for several instances, also
    /// those that sets and elements speak of.
    pub(super) fn has_numbers_of_instances(&self) -> bool {
        let nodes = self.nodes.keys().copied();
        let elements = self.elements.iter();
        let elements = elements.flat_map(|of| once(of.number).chain(of.corners.iter().copied()));
        let sets = self.node_sets.members().chain(self.element_sets.members());
        let faces = self.surfaces.values().flat_map(|(_, faces)| faces);
        let faces = faces.map(|(_, face)| face.largest());
        let numbers = nodes.chain(elements).chain(sets).chain(faces);
        let mut numbers = numbers.chain(self.lower.numbers());
        numbers.all(|number| number < 1 << NUMBER_BITS)
    }

    /// Facets of elements that are no solids; of a part those in the set of its name, or in the
    /// instance at a place.
    pub(super) fn rigid_surface(
        &self,
        part: Option<(&str, Option<u64>)>,
    ) -> Result<(RigidSurfaceMesh, Vec<u64>), MeshFileFault> {
        let in_set: Option<HashSet<u64>> = match part {
            Some((name, None)) => {
                let known = || self.element_sets.labels();
                let members = self
                    .element_sets
                    .get(name)
                    .ok_or_else(|| MeshFileFault::NoPart {
                        name: name.to_owned(),
                        known: known(),
                    })?;
                Some(members.iter().map(|(_, number)| *number).collect())
            }
            _ => None,
        };
        let is_chosen = |number: u64| match part {
            Some((_, Some(instance))) => number >> NUMBER_BITS == instance,
            _ => in_set.as_ref().is_none_or(|set| set.contains(&number)),
        };
        let mut ids: BTreeMap<u64, NodeId> = BTreeMap::new();
        let (mut positions, mut numbers, mut facets) = (Vec::new(), Vec::new(), Vec::new());
        for (number, line) in self.lower.facets() {
            let faces = self.lower.faces(number).into_iter();
            for face in faces.filter(|_| is_chosen(number)) {
                let (FileFace::Corners(corners) | FileFace::Eight(corners, _)) = face else {
                    continue;
                };
                let mut facet = [NodeId(0); 4];
                for (node, corner) in facet.iter_mut().zip(corners) {
                    let x = self.nodes.get(&corner);
                    let x =
                        x.ok_or_else(|| missing(Place::Line(line), "node", &corner.to_string()))?;
                    *node = *ids.entry(corner).or_insert_with(|| {
                        positions.push(*x);
                        numbers.push(corner);
                        NodeId::new(positions.len() - 1)
                    });
                }
                facets.push(facet);
            }
        }
        if facets.is_empty() {
            return Err(MeshFileFault::Empty {
                expected: "elements such as R3D3, R3D4 or S4",
                remedy: "mesh the rigid surface with them",
            });
        }
        let surface = RigidSurfaceMesh {
            positions,
            facets,
            left_out: 0,
        };
        Ok((surface, numbers))
    }

    /// Leaves numbers of ranges that are not defined out of sets and of surfaces made of them.
    fn leave_out_undefined(&mut self) {
        let undefined = self
            .node_sets
            .undefined(|node| self.nodes.contains_key(&node));
        self.notes.extend(self.node_sets.leave_out(&undefined));
        let solids: HashSet<u64> = self.elements.iter().map(|of| of.number).collect();
        let is_defined = |number| solids.contains(&number) || !self.lower.is_solid(number);
        let undefined = self.element_sets.undefined(is_defined);
        self.notes.extend(self.element_sets.leave_out(&undefined));
        for (_, faces) in self.surfaces.values_mut() {
            faces.retain(|(_, face)| match face {
                FileFace::Side(element, _) | FileFace::Free(element) => {
                    !undefined.contains(element)
                }
                FileFace::Corners(_) | FileFace::Eight(..) => true,
            });
        }
    }

    /// The mesh, with the names of instances that numbers need.
    pub(super) fn collected(mut self, instances: Vec<String>) -> Result<Collected, MeshFileFault> {
        self.leave_out_undefined();
        let sections = self.sections.iter().map(|(set, material)| SectionCard {
            set: self.element_sets.spelled(set),
            material: material.clone(),
        });
        let sections = sections.collect();
        let mut mesh = Collected {
            nodes: self.nodes,
            elements: self.elements,
            node_sets: self.node_sets.into_sets(),
            element_sets: self.element_sets.into_sets(),
            facet_sets: self.surfaces.into_values().collect(),
            notes: self.notes,
            asked: self.asked,
            instances,
            sections,
            ..Collected::default()
        };
        self.lower.sort_out(&mut mesh)?;
        Ok(mesh)
    }
}

/// The kind of `C3D` with the number of nodes and letters, such as `C3D8R` or `C3D6H`, or the
/// one that such cells are divided into; and the number of nodes.
fn cell(kind: &str) -> Option<(CellKind, usize)> {
    let nodes = kind.strip_prefix("C3D")?;
    let nodes = nodes.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let nodes = nodes.parse().ok()?;
    let kind = match nodes {
        4 => CellKind::Tetrahedron,
        5 => CellKind::Pyramid,
        6 | 15 => CellKind::Wedge,
        8 | 20 | 27 => CellKind::Hexahedron,
        10 => CellKind::CompositeTetrahedron,
        _ => return None,
    };
    Some((kind, nodes))
}

/// The middle of a hexahedron of 27 nodes comes before those of its faces in Abaqus.
fn ordered(nodes: &[u64]) -> Vec<u64> {
    let mut nodes = nodes.to_vec();
    if nodes.len() == 27 {
        nodes[20..].rotate_left(1);
    }
    nodes
}
