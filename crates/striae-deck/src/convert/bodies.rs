//! Bodies and their materials: instances of parts, or pieces of a mesh without parts.

use super::Model;
use crate::write::value::{list, text};
use std::collections::{BTreeSet, HashMap};
use std::path::Path;
use striae_mesh::{ElementId, Face, Mesh, NodeId, Sets};
use striae_meshfile::{Keyword, MeshFileError, Reading, read_part};

/// An instance of a part.
pub(super) struct Instance<'a> {
    pub(super) keyword: &'a Keyword<'a>,
    pub(super) name: &'a str,
    /// Types of the elements of its part, in capitals.
    pub(super) kinds: BTreeSet<String>,
    /// Keywords of its part and those within the instance itself.
    pub(super) own: Vec<&'a Keyword<'a>>,
}

impl Instance<'_> {
    /// Returns whether it has solid elements.
    pub(super) fn is_solid(&self) -> bool {
        self.kinds.iter().any(|kind| kind.starts_with("C3D"))
    }

    /// Returns whether it is a rigid surface of facets.
    pub(super) fn is_rigid(&self) -> bool {
        !self.is_solid() && self.kinds.iter().any(|kind| kind.starts_with("R3D"))
    }
}

/// The instances of a file.
pub(super) fn instances<'a>(keywords: &'a [Keyword<'a>]) -> Vec<Instance<'a>> {
    let mut parts: Vec<(&str, Vec<&Keyword<'_>>)> = Vec::new();
    let mut instances: Vec<Instance<'_>> = Vec::new();
    let mut scope = "";
    for keyword in keywords {
        let name = keyword.parameter("NAME").unwrap_or_default();
        match keyword.name.as_str() {
            "PART" => parts.push((name, Vec::new())),
            "INSTANCE" => {
                let part = keyword.parameter("PART").unwrap_or_default();
                let mut known = parts.iter();
                let known = known.find(|(name, _)| name.eq_ignore_ascii_case(part));
                let own = known.map_or_else(Vec::new, |(_, own)| own.clone());
                let kinds = BTreeSet::new();
                instances.push(Instance {
                    keyword,
                    name,
                    kinds,
                    own,
                });
            }
            _ => match scope {
                "PART" => parts
                    .iter_mut()
                    .last()
                    .into_iter()
                    .for_each(|(_, own)| own.push(keyword)),
                "INSTANCE" => {
                    let last = instances.iter_mut().last();
                    last.into_iter().for_each(|last| last.own.push(keyword));
                }
                _ => {}
            },
        }
        match keyword.name.as_str() {
            opened @ ("PART" | "INSTANCE") => scope = opened,
            "END PART" | "END INSTANCE" => scope = "",
            _ => {}
        }
    }
    for instance in &mut instances {
        let elements = instance.own.iter();
        let elements = elements.filter(|keyword| keyword.name == "ELEMENT");
        let kinds = elements.filter_map(|keyword| keyword.parameter("TYPE"));
        instance.kinds = kinds.map(str::to_uppercase).collect();
    }
    instances
}

/// A body of the deck.
pub(super) struct Body {
    pub(super) name: String,
    /// The part of the file that it is.
    elements: Option<String>,
    pub(super) reading: Reading,
    /// Material of all of it, or sections.
    pub(super) material: String,
    /// More sets of nodes by number.
    node_sets: Vec<(String, Vec<NodeId>)>,
    /// More sets of elements by number.
    element_sets: Vec<(String, Vec<ElementId>)>,
    /// More sets of facets.
    facet_sets: Vec<(String, Facets)>,
    /// Nodes and elements by their numbers in the file, in capitals.
    nodes_by_number: HashMap<String, NodeId>,
    elements_by_number: HashMap<String, Vec<ElementId>>,
}

/// Members of a set of facets.
enum Facets {
    /// All whose corners are in a set of nodes.
    Among(String),
    These(Vec<Face>),
}

impl Body {
    fn new(name: String, elements: Option<String>, reading: Reading) -> Self {
        let nodes = (0..reading.mesh.positions.len()).map(NodeId::new);
        let numbers = &reading.numbers;
        let nodes_by_number = nodes
            .map(|node| (numbers.node(node).to_uppercase(), node))
            .collect();
        let mut elements_by_number: HashMap<String, Vec<ElementId>> = HashMap::new();
        for element in (0..reading.mesh.element_count()).map(ElementId::new) {
            let number = numbers.element(element).to_uppercase();
            elements_by_number.entry(number).or_default().push(element);
        }
        Self {
            name,
            elements,
            reading,
            material: String::new(),
            node_sets: Vec::new(),
            element_sets: Vec::new(),
            facet_sets: Vec::new(),
            nodes_by_number,
            elements_by_number,
        }
    }

    /// Its table in the deck.
    pub(super) fn table(&self, written: &str) -> String {
        let part = self.elements.as_ref();
        let part = part.map_or(String::new(), |part| format!(", elements = {}", text(part)));
        let mut table = format!(
            "\n[[body]]\nname = {}\n{}mesh = {{ file = {}{part} }}\n",
            text(&self.name),
            self.material,
            text(written)
        );
        let nodes = self.node_sets.iter().map(|(name, nodes)| {
            let numbers = nodes.iter().map(|node| node.0.to_string());
            of_numbers(name, list(numbers))
        });
        let elements = self.element_sets.iter().map(|(name, elements)| {
            let numbers = elements.iter().map(|element| element.0.to_string());
            of_numbers(name, list(numbers))
        });
        for (key, sets) in [
            ("node_sets", nodes.collect::<Vec<_>>()),
            ("element_sets", elements.collect()),
        ] {
            if !sets.is_empty() {
                table += &format!("{key} = {}\n", list(sets));
            }
        }
        let sets = self.facet_sets.iter();
        let sets = sets.map(|(name, of)| match of {
            Facets::Among(nodes) => format!("{{ name = {}, nodes = {} }}", text(name), text(nodes)),
            Facets::These(faces) => {
                let faces = faces.iter();
                let sides = faces.map(|face| format!("[{}, {}]", face.element.0, face.side));
                format!("{{ name = {}, sides = {} }}", text(name), list(sides))
            }
        });
        if !self.facet_sets.is_empty() {
            table += &format!("facet_sets = {}\n", list(sets));
        }
        table
    }

    /// Its node set that a word of the file stands for; of a number a set of this one node.
    pub(super) fn node_set(&mut self, word: &str) -> Option<String> {
        if let Some(name) = spelled(&self.reading.mesh.node_sets, word) {
            return Some(name);
        }
        let node = self.node(word)?;
        Some(self.set_of_nodes(format!("node {word}"), vec![node]))
    }

    /// Its node of a number of the file.
    pub(super) fn node(&self, word: &str) -> Option<NodeId> {
        let bare = word.rsplit('.').next().unwrap_or(word);
        bare.parse::<u64>().ok()?;
        let by_number = &self.nodes_by_number;
        let node = by_number.get(&word.to_uppercase());
        node.or_else(|| by_number.get(bare)).copied()
    }

    /// A set of nodes of a name, new if there is none like it.
    pub(super) fn set_of_nodes(&mut self, name: String, nodes: Vec<NodeId>) -> String {
        let is_taken = |name: &str| {
            let mut own = self.node_sets.iter();
            let is_own = own.any(|(known, of)| known == name && *of != nodes);
            is_own || self.reading.mesh.node_sets.get(name).is_some()
        };
        let mut name = name;
        while is_taken(&name) {
            name += "'";
        }
        if self.node_sets.iter().all(|(known, _)| *known != name) {
            self.node_sets.push((name.clone(), nodes));
        }
        name
    }

    /// A new set of elements.
    pub(super) fn set_of_elements(&mut self, name: String, elements: Vec<ElementId>) -> String {
        let mut name = name;
        while self.reading.mesh.element_sets.get(&name).is_some()
            || self.element_sets.iter().any(|(known, _)| *known == name)
        {
            name += "'";
        }
        self.element_sets.push((name.clone(), elements));
        name
    }

    /// Its facet set that a word of the file stands for; of a set of nodes the facets with all
    /// corners in it.
    pub(super) fn facet_set(&mut self, word: &str) -> Option<String> {
        let mesh = &self.reading.mesh;
        if let Some(name) = spelled(&mesh.facet_sets, word) {
            return Some(name);
        }
        let nodes = spelled(&mesh.node_sets, word)?;
        let found = mesh.faces_among(&mesh.boundary_faces(), mesh.node_sets.get(&nodes)?);
        if found.is_empty() {
            return None;
        }
        let name = format!("facets of {nodes}");
        if self.facet_sets.iter().all(|(known, _)| *known != name) {
            self.facet_sets.push((name.clone(), Facets::Among(nodes)));
        }
        Some(name)
    }

    /// A new set of faces.
    pub(super) fn set_of_faces(&mut self, faces: Vec<Face>) -> String {
        let sets = &self.facet_sets;
        let own = sets.iter().filter(|(_, of)| matches!(of, Facets::These(_)));
        let name = format!("loaded faces {}", own.count() + 1);
        self.facet_sets.push((name.clone(), Facets::These(faces)));
        name
    }

    /// Elements that a word of the file stands for.
    pub(super) fn elements_of(&self, word: &str) -> Vec<ElementId> {
        let sets = &self.reading.mesh.element_sets;
        if let Some(set) = spelled(sets, word) {
            return sets.get(&set).unwrap_or_default().to_vec();
        }
        let bare = word.rsplit('.').next().unwrap_or(word);
        let by_number = &self.elements_by_number;
        let found = by_number.get(&word.to_uppercase());
        let found = found.or_else(|| by_number.get(bare));
        found.cloned().unwrap_or_default()
    }

    /// Nodes of one of its sets, of the mesh or of the deck.
    pub(super) fn nodes(&self, set: &str) -> Vec<NodeId> {
        if let Some(nodes) = self.reading.mesh.node_sets.get(set) {
            return nodes.to_vec();
        }
        let mut own = self.node_sets.iter();
        let found = own.find(|(name, _)| name == set);
        found.map_or_else(Vec::new, |(_, nodes)| nodes.clone())
    }

    /// Returns whether all its elements are in the set that a word stands for.
    pub(super) fn is_within(&self, word: &str) -> bool {
        let all = self.reading.mesh.element_count();
        self.name.eq_ignore_ascii_case(word) || self.elements_of(word).len() == all
    }
}

/// A set of the deck by the numbers of its members.
fn of_numbers(name: &str, numbers: String) -> String {
    format!("{{ name = {}, numbers = {numbers} }}", text(name))
}

/// The name of the set that a word stands for; the name of an instance before it counts where
/// the file has several.
fn spelled<T: Ord + Copy>(sets: &Sets<T>, word: &str) -> Option<String> {
    let bare = word.rsplit_once('.').map_or(word, |(_, bare)| bare);
    let same = |wanted: &str| {
        let mut names = sets.iter().map(|(name, _)| name);
        names.find(|name| name.eq_ignore_ascii_case(wanted))
    };
    same(word).or_else(|| same(bare)).map(str::to_owned)
}

impl<'a> Model<'a> {
    /// Reads bodies with their materials.
    pub(super) fn read_bodies(&mut self, path: &Path) -> Result<(), MeshFileError> {
        if self.instances.is_empty() {
            self.read_pieces(path)?;
        }
        let mut others = Vec::new();
        for instance in &self.instances {
            if instance.is_solid() {
                let reading = read_part(path, Some(instance.name))?;
                let name = instance.name.to_owned();
                self.bodies
                    .push(Body::new(name.clone(), Some(name), reading));
            } else if !instance.is_rigid() && !instance.kinds.is_empty() {
                let kinds: Vec<&str> = instance.kinds.iter().map(String::as_str).collect();
                let what = format!("*INSTANCE `{}` of {}", instance.name, kinds.join(", "));
                others.push((instance.keyword.line, what));
            }
        }
        for (line, what) in others {
            self.list(line, what);
        }
        if self.bodies.is_empty() {
            let line = self.keywords.first().map_or(1, |keyword| keyword.line);
            let what = "the model has no solid elements such as C3D8; a deck is of solids in three dimensions";
            self.list(line, what);
        }
        self.read_materials();
        Ok(())
    }

    /// Bodies of a file without parts: its pieces, where each is an element set.
    fn read_pieces(&mut self, path: &Path) -> Result<(), MeshFileError> {
        let has_solids = self.keywords.iter().any(|keyword| {
            let kind = keyword.parameter("TYPE").unwrap_or_default();
            keyword.name == "ELEMENT" && kind.to_uppercase().starts_with("C3D")
        });
        if !has_solids {
            return Ok(());
        }
        let whole = read_part(path, None)?;
        let names = piece_sets(&whole.mesh);
        let pieces = whole.mesh.pieces().len();
        match names {
            Some(names) if pieces > 1 => {
                for name in names {
                    let reading = read_part(path, Some(&name))?;
                    self.bodies
                        .push(Body::new(name.clone(), Some(name), reading));
                }
            }
            _ => {
                if pieces > 1 {
                    let line = self.keywords.first().map_or(1, |keyword| keyword.line);
                    let what = format!(
                        "the mesh has {pieces} pieces that are no element sets; they become one body; give each an *ELSET to have several"
                    );
                    self.list(line, what);
                }
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                self.bodies.push(Body::new(stem.into_owned(), None, whole));
            }
        }
        Ok(())
    }

    /// Bodies by place with the node set that a word stands for.
    pub(super) fn nodes(&mut self, word: &str) -> Vec<(usize, String)> {
        let bodies = self.bodies_named(word).into_iter();
        bodies
            .filter_map(|at| Some((at, self.bodies[at].node_set(word)?)))
            .collect()
    }

    /// Bodies by place that a word may speak of: the one whose name it begins with, or all.
    pub(super) fn bodies_named(&self, word: &str) -> Vec<usize> {
        let instance = word.rsplit_once('.').map(|(instance, _)| instance);
        let exact = self.bodies.iter().position(|body| {
            instance.is_some_and(|instance| body.name.eq_ignore_ascii_case(instance))
        });
        let mut instances = self.instances.iter();
        let is_other = instances.any(|other| {
            instance.is_some_and(|instance| other.name.eq_ignore_ascii_case(instance))
        });
        match exact {
            Some(exact) => vec![exact],
            // An instance that is no body has none of their sets.
            None if is_other => Vec::new(),
            None => (0..self.bodies.len()).collect(),
        }
    }
}

/// Element sets that are the pieces of a mesh, one each; `None` where one is not.
fn piece_sets(mesh: &Mesh) -> Option<Vec<String>> {
    let sets = |nodes: &Vec<NodeId>| {
        let elements: Vec<ElementId> = mesh.elements_of(nodes);
        let mut sets = mesh.element_sets.iter();
        let found = sets.find(|(_, members)| *members == &elements[..]);
        found.map(|(name, _)| name.to_owned())
    };
    mesh.pieces().iter().map(sets).collect()
}
