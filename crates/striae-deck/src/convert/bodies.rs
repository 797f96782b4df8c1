//! Bodies and their materials: instances of parts, or pieces of a mesh without parts.

use super::Model;
use crate::lower::cards;
use crate::write::{
    law,
    value::{list, number, text},
};
use std::collections::BTreeSet;
use std::path::Path;
use striae_mesh::{ElementId, Mesh, NodeId, Sets};
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
    fn is_solid(&self) -> bool {
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
    material: String,
    /// More sets of nodes by number.
    node_sets: Vec<(String, NodeId)>,
    /// More sets of facets, by the set of their nodes.
    facet_sets: Vec<(String, String)>,
}

impl Body {
    fn new(name: String, elements: Option<String>, reading: Reading) -> Self {
        Self {
            name,
            elements,
            reading,
            material: String::new(),
            node_sets: Vec::new(),
            facet_sets: Vec::new(),
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
        let sets = self.node_sets.iter();
        let sets =
            sets.map(|(name, node)| format!("{{ name = {}, numbers = [{}] }}", text(name), node.0));
        if !self.node_sets.is_empty() {
            table += &format!("node_sets = {}\n", list(sets));
        }
        let sets = self.facet_sets.iter();
        let sets =
            sets.map(|(name, of)| format!("{{ name = {}, nodes = {} }}", text(name), text(of)));
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
        let bare = word.rsplit('.').next().unwrap_or(word);
        bare.parse::<u64>().ok()?;
        let numbers = &self.reading.numbers;
        let mut nodes = (0..self.reading.mesh.positions.len()).map(NodeId::new);
        let node = nodes.find(|node| {
            let of_file = numbers.node(*node);
            of_file.eq_ignore_ascii_case(word) || of_file == bare && !of_file.contains('.')
        })?;
        let name = format!("node {word}");
        if self.node_sets.iter().all(|(known, _)| *known != name) {
            self.node_sets.push((name.clone(), node));
        }
        Some(name)
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
            self.facet_sets.push((name.clone(), nodes));
        }
        Some(name)
    }

    /// Middle of its nodes.
    pub(super) fn middle(&self) -> striae_mesh::Vec3 {
        let (low, high) = self.reading.mesh.bounds();
        0.5 * (low + high)
    }
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
                        "the mesh has {pieces} pieces without element sets of their own; they become one body"
                    );
                    self.list(line, what);
                }
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                self.bodies.push(Body::new(stem.into_owned(), None, whole));
            }
        }
        Ok(())
    }

    fn read_materials(&mut self) {
        let Some(first) = self.bodies.first() else {
            return;
        };
        let cards = first.reading.materials.clone();
        for card in &cards {
            let keywords = self.keywords;
            let at = keywords.iter().position(|keyword| {
                keyword.name == "MATERIAL" && super::has(keyword, "NAME", &card.name)
            });
            let of_body = |body: &Body| {
                let mut sections = body.reading.sections.iter();
                sections.any(|section| section.material.eq_ignore_ascii_case(&card.name))
            };
            let is_used = self.bodies.iter().any(of_body);
            let made = card.card.as_ref().map_err(Clone::clone).and_then(|card| {
                let made = cards::material(card)?;
                let lines =
                    law::material(&made).ok_or("without a counterpart among the laws of decks")?;
                Ok((lines, card.density))
            });
            let line = at.map_or(0, |at| keywords[at].line);
            match made {
                Ok((lines, density)) => {
                    let density = density.map(|density| format!("density = {}\n", number(density)));
                    self.materials += &format!(
                        "\n[[material]]\nname = {}\n{}{lines}",
                        text(&card.name),
                        density.unwrap_or_default()
                    );
                    self.used
                        .extend(striae_meshfile::material_lines(keywords, line));
                }
                Err(cause) if is_used => {
                    let what = format!("*MATERIAL `{}`: {cause}", card.name);
                    self.list(line, what + "; the deck needs a material of this name");
                }
                Err(cause) => self.list(line, format!("*MATERIAL `{}`: {cause}", card.name)),
            }
        }
        for at in 0..self.bodies.len() {
            let body = &self.bodies[at];
            let elements = body.reading.mesh.element_count();
            let spelled = |material: &str| {
                let mut known = cards.iter();
                let known = known.find(|card| card.name.eq_ignore_ascii_case(material));
                text(known.map_or(material, |card| &card.name))
            };
            let sections = &body.reading.sections;
            let covers = |set: &str| {
                let members = body.reading.mesh.element_sets.get(set);
                members.is_some_and(|members| members.len() == elements)
            };
            let made = match &sections[..] {
                [only] if covers(&only.set) => {
                    format!("material = {}\n", spelled(&only.material))
                }
                [] => {
                    let line = self.keywords.first().map_or(1, |keyword| keyword.line);
                    let what = format!("body `{}` has no *SOLID SECTION", body.name);
                    self.listed.entry(line).or_default().push(what);
                    String::new()
                }
                all => {
                    let section = all.iter().map(|section| {
                        format!(
                            "{{ elements = {}, material = {} }}",
                            text(&section.set),
                            spelled(&section.material)
                        )
                    });
                    format!("sections = {}\n", list(section))
                }
            };
            self.bodies[at].material = made;
        }
        let sections = self.keywords.iter();
        let sections = sections.filter(|keyword| keyword.name == "SOLID SECTION");
        let lines: Vec<usize> = sections.map(|keyword| keyword.line).collect();
        self.used.extend(lines);
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
