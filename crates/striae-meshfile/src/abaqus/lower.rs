//! Elements of Abaqus that are no solids of a body.
//!
//! Shells, membranes, surface elements and plane solids are facets, trusses, beams and pipes
//! lines, by the beginning of their type. Their sets become sets of facets and nodes; elements
//! of any other type, as masses, springs, cohesive elements and continuum shells, are ignored, which
//! a note says.

use super::super::collected::{Collected, FileFace};
use super::super::lines::parsed;
use super::super::{MeshFileFault, Place, lower};
use super::keywords::Keyword;
use super::sets::LabelSets;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// Elements by number.
#[derive(Clone, Default)]
pub(super) struct Lower {
    elements: BTreeMap<u64, Element>,
    /// Number of elements by their type.
    ignored: BTreeMap<String, usize>,
    ignored_numbers: BTreeSet<u64>,
}

#[derive(Clone)]
struct Element {
    line: usize,
    dimension: usize,
    nodes: Vec<u64>,
}

/// Beginnings of the types of facets.
const FACETS: [&str; 14] = [
    "S3", "S4", "S6", "S8", "S9", "STRI", "SFM", "M3D", "R3D", "CPS", "CPE", "CAX", "DS", "AC2D",
];
/// Beginnings of the types of lines.
const LINES: [&str; 7] = ["T2D", "T3D", "B2", "B3", "PIPE", "R2D", "RB"];

/// Returns whether elements of this type, in capitals, are solids of a body.
pub(super) fn is_solid(kind: &str) -> bool {
    kind.starts_with("C3D")
}

impl Lower {
    /// Reads rows `number, nodes..` of elements that are no solids.
    pub(super) fn read(
        &mut self,
        kind: &str,
        keyword: &Keyword<'_>,
        sets: &mut LabelSets,
    ) -> Result<(), MeshFileFault> {
        keyword.refuse_input()?;
        let starts = |starts: &[&str]| starts.iter().any(|start| kind.starts_with(start));
        let dimension = if starts(&FACETS) {
            Some(2)
        } else {
            starts(&LINES).then_some(1)
        };
        for row in keyword.joined_rows(usize::MAX) {
            let expected = "an element number and node numbers";
            let words = row.words.iter().filter(|word| !word.is_empty());
            let numbers = words.map(|word| parsed(row.line, word, expected));
            let numbers = numbers.collect::<Result<Vec<u64>, _>>()?;
            let (number, nodes) = numbers.split_first().ok_or_else(|| row.fault(expected))?;
            if let Some(set) = keyword.parameter("ELSET") {
                sets.push(set, row.line, *number);
            }
            let Some(dimension) = dimension else {
                *self.ignored.entry(kind.to_owned()).or_default() += 1;
                self.ignored_numbers.insert(*number);
                continue;
            };
            let element = Element {
                line: row.line,
                dimension,
                nodes: nodes.to_vec(),
            };
            if self.elements.insert(*number, element).is_some() {
                return Err(twice(row.line, *number));
            }
        }
        Ok(())
    }

    /// Numbers and lines of the elements that are facets.
    pub(super) fn facets(&self) -> impl Iterator<Item = (u64, usize)> {
        let all = self.elements.iter();
        let facets = all.filter(|(_, element)| element.dimension == 2);
        facets.map(|(number, element)| (*number, element.line))
    }

    /// Returns whether a number is that of no element here.
    pub(super) fn is_solid(&self, number: u64) -> bool {
        !self.elements.contains_key(&number) && !self.ignored_numbers.contains(&number)
    }

    /// Numbers of all elements and of their nodes.
    pub(super) fn numbers(&self) -> impl Iterator<Item = u64> {
        let nodes = self.elements.values().flat_map(|element| &element.nodes);
        let elements = self.elements.keys().chain(&self.ignored_numbers);
        elements.chain(nodes).copied()
    }

    /// The faces that an element is, none where it is no facet.
    pub(super) fn faces(&self, number: u64) -> Vec<FileFace> {
        let element = self.elements.get(&number);
        let facet = element.filter(|element| element.dimension == 2);
        facet.map_or_else(Vec::new, |facet| lower::faces(&facet.nodes))
    }

    /// Elements of these numbers with their nodes.
    pub(super) fn nodes(&self, numbers: &HashSet<u64>) -> Vec<u64> {
        let chosen = self.elements.iter();
        let chosen = chosen.filter(|(number, _)| numbers.contains(number));
        chosen
            .flat_map(|(_, element)| element.nodes.clone())
            .collect()
    }

    /// Adds the elements of a part whose numbers are raised.
    pub(super) fn place(&mut self, part: &Self, raise: u64) {
        for (number, element) in &part.elements {
            let nodes = element.nodes.iter().map(|node| node + raise);
            let placed = Element {
                nodes: nodes.collect(),
                ..*element
            };
            self.elements.insert(number + raise, placed);
        }
        for (kind, count) in &part.ignored {
            *self.ignored.entry(kind.clone()).or_default() += count;
        }
        let ignored = part.ignored_numbers.iter();
        self.ignored_numbers
            .extend(ignored.map(|number| number + raise));
    }

    /// Moves the elements out of the element sets of a mesh to where they belong.
    pub(super) fn sort_out(self, mesh: &mut Collected) -> Result<(), MeshFileFault> {
        let mut solids = mesh.elements.iter();
        if let Some(solid) = solids.find(|solid| self.elements.contains_key(&solid.number)) {
            let number = mesh.named(solid.number);
            let found = format!("element {number} for the second time");
            return Err(MeshFileFault::at(
                solid.place,
                "a new element number",
                found,
            ));
        }
        let mut sets_of: HashMap<u64, Vec<String>> = HashMap::new();
        mesh.element_sets.retain(|name, members| {
            let all = members.len();
            members.retain(|(_, number)| {
                if self.elements.contains_key(number) {
                    sets_of.entry(*number).or_default().push(name.clone());
                    return false;
                }
                !self.ignored_numbers.contains(number)
            });
            all == 0 || !members.is_empty()
        });
        for (number, element) in &self.elements {
            let sets = sets_of.remove(number).unwrap_or_default();
            let place = Place::Line(element.line);
            mesh.add_lower(element.dimension, place, &element.nodes, sets);
        }
        for (kind, count) in &self.ignored {
            let are = if *count == 1 {
                "element of type {} is"
            } else {
                "elements of type {} are"
            };
            let are = are.replace("{}", kind);
            mesh.notes.push(format!("{count} {are} ignored"));
        }
        Ok(())
    }
}

fn twice(line: usize, number: u64) -> MeshFileFault {
    let found = format!("element {number} for the second time");
    MeshFileFault::line(line, "a new element number", found)
}
