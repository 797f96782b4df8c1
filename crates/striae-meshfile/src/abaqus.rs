//! Abaqus `.inp` files.
//!
//! A file is a sequence of keywords with parameters, each followed by its
//! lines of numbers or names. Read are nodes, elements `C3D4`, `C3D5`, `C3D6`, `C3D8`,
//! `C3D10`, `C3D15`, `C3D20` and `C3D27` of any variant, node and element sets (with `GENERATE`, names of other
//! sets, `NSET` of an `ELSET`) and element-based surfaces; other keywords are
//! passed over. Elements of lower dimension make sets of facets and nodes (`abaqus/lower.rs`). `H` asks for mean dilatation and `I` for an assumed strain; elements `R` are read,
//! with a note, as those with full integration. Abaqus numbers nodes and sides as [`striae_mesh::CellKind`] does; `S1` is side
//! 0, all four faces of it in a ten-node tetrahedron. Labels are the same in capital and
//! small letters and keep the spelling of their first use. A file may have one
//! part and one instance of it in its own place; nodes of the assembly itself
//! (reference points) are passed over.

mod keywords;
mod lower;
mod sets;

use super::collected::{Collected, FileElement, FileFace, position};
use super::lines::parsed;
use super::{Asked, MeshFileFault, Place, Reading};
use keywords::{Keyword, Row, keywords};
use lower::Lower;
use sets::LabelSets;
use std::collections::HashSet;
use striae_mesh::{CellKind, Vec3};

/// The mesh of a body.
pub(super) fn body(text: &str) -> Result<Reading, MeshFileFault> {
    collected(text)?.mesh()
}

/// What the file says of the mesh of a body.
pub(super) fn collected(text: &str) -> Result<Collected, MeshFileFault> {
    let mut reader = Reader::default();
    for keyword in keywords(text)? {
        reader.read(&keyword)?;
    }
    reader.finish()
}

#[derive(Default)]
struct Reader {
    mesh: Collected,
    node_sets: LabelSets,
    element_sets: LabelSets,
    lower: Lower,
    surfaces: LabelSets,
    faces: Vec<Vec<(Place, FileFace)>>,
    parts: usize,
    instances: usize,
    scope: Scope,
}

/// Where in the hierarchy of the file a keyword stands.
#[derive(Default, PartialEq)]
enum Scope {
    #[default]
    Part,
    Assembly,
}

impl Reader {
    fn read(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        match keyword.name.as_str() {
            "PART" => {
                self.parts += 1;
                self.single(keyword, self.parts)
            }
            "ASSEMBLY" => {
                self.scope = Scope::Assembly;
                Ok(())
            }
            "INSTANCE" => {
                self.instances += 1;
                self.scope = Scope::Part;
                self.in_place(keyword)?;
                self.single(keyword, self.instances)
            }
            "END INSTANCE" => {
                self.scope = Scope::Assembly;
                Ok(())
            }
            "END ASSEMBLY" => {
                self.scope = Scope::Part;
                Ok(())
            }
            "NODE" if self.scope == Scope::Assembly => Ok(()),
            "NODE" => self.nodes(keyword),
            "ELEMENT" => self.elements(keyword),
            "NSET" => self.node_set(keyword),
            "ELSET" => {
                let name = keyword.required("ELSET")?;
                self.element_sets.extend(name, keyword)
            }
            "SURFACE" => self.surface(keyword),
            "NGEN" | "NFILL" | "NCOPY" | "NMAP" | "ELGEN" | "ELCOPY" | "INCLUDE" | "SYSTEM" => {
                let fault = keyword.fault("nodes and elements written out one by one");
                Err(fault.with_remedy("write the mesh out flat with its preprocessor"))
            }
            _ => Ok(()),
        }
    }

    fn single(&self, keyword: &Keyword<'_>, count: usize) -> Result<(), MeshFileFault> {
        if count < 2 {
            return Ok(());
        }
        let fault = keyword.fault("a single part with a single instance");
        Err(fault.with_remedy("write each body into a file of its own"))
    }

    fn in_place(&self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        let moves = |row: &&Row<'_>| {
            row.words
                .iter()
                .any(|word| number(word).is_none_or(|value| value != 0.0))
        };
        match keyword.rows.iter().find(moves) {
            None => Ok(()),
            Some(row) => Err(row
                .fault("an instance in its own place")
                .with_remedy("move the part itself")),
        }
    }

    /// Rows `number, x, y, z`; missing coordinates are zero.
    fn nodes(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
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
            if self.mesh.nodes.insert(tag, x).is_some() {
                return Err(row.fault("a node number that has not been used"));
            }
            if let Some(set) = keyword.parameter("NSET") {
                self.node_sets.push(set, row.line, tag);
            }
        }
        Ok(())
    }

    /// Rows `number, corners..`.
    fn elements(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
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
        for row in keyword.joined_rows() {
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
            self.mesh.elements.push(FileElement {
                kind,
                place: Place::Line(row.line),
                number: *number,
                corners: ordered(corners),
            });
        }
        Ok(())
    }

    /// Notes what the letters of a kind of element ask for.
    fn ask(&mut self, name: &str) {
        let letters = name
            .trim_start_matches("C3D")
            .trim_start_matches(|c: char| c.is_numeric());
        let asked = match letters.contains('H') {
            true => Some(Asked::MeanDilatation),
            false => letters.contains('I').then_some(Asked::AssumedStrain),
        };
        self.mesh.asked = self.mesh.asked.or(asked);
        let note = format!("elements {name} are read as elements with full integration");
        if letters.contains('R') && !self.mesh.notes.contains(&note) {
            self.mesh.notes.push(note);
        }
    }

    fn node_set(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        let name = keyword.required("NSET")?;
        let Some(elements) = keyword.parameter("ELSET") else {
            return self.node_sets.extend(name, keyword);
        };
        let members = self.element_sets.get(elements);
        let members = members.ok_or_else(|| keyword.fault("an element set defined before"))?;
        let chosen: HashSet<u64> = members.iter().map(|member| member.1).collect();
        for element in &self.mesh.elements {
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

    /// Rows `element or element set, S1..S6`, or `SPOS`, `SNEG` of shells on the body.
    fn surface(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        let kind = keyword.parameter("TYPE").unwrap_or("ELEMENT");
        if !kind.eq_ignore_ascii_case("ELEMENT") {
            return Ok(());
        }
        let mut faces = Vec::new();
        for row in &keyword.rows {
            let word = row.words.get(1).copied().unwrap_or_default();
            let elements = self.element_sets.members(row, row.words[0])?;
            let place = Place::Line(row.line);
            if ["SPOS", "SNEG"].contains(&word.to_uppercase().as_str()) {
                let of_shells = elements.iter().flat_map(|shell| self.lower.faces(*shell));
                faces.extend(of_shells.map(|face| (place, face)));
                continue;
            }
            let side =
                side(word).ok_or_else(|| row.fault("a face S1 to S6 of an element or set"))?;
            let sides = elements.into_iter();
            faces.extend(sides.map(|element| (place, FileFace::Side(element, side))));
        }
        let index = self.faces.len() as u64;
        self.surfaces
            .push(keyword.required("NAME")?, keyword.line, index);
        self.faces.push(faces);
        Ok(())
    }

    fn finish(mut self) -> Result<Collected, MeshFileFault> {
        for (name, indices) in self.surfaces.into_sets() {
            let faces = indices
                .into_iter()
                .flat_map(|(_, index)| std::mem::take(&mut self.faces[index as usize]));
            self.mesh.facet_sets.insert(name, faces.collect());
        }
        self.mesh.node_sets = self.node_sets.into_sets();
        self.mesh.element_sets = self.element_sets.into_sets();
        self.lower.sort_out(&mut self.mesh)?;
        Ok(self.mesh)
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

fn side(word: &str) -> Option<u8> {
    let number: u8 = word.strip_prefix(['S', 's'])?.parse().ok()?;
    (1..=6).contains(&number).then(|| number - 1)
}

/// A number, its exponent also marked with `D`.
fn number(word: &str) -> Option<f64> {
    word.replace(['D', 'd'], "e").parse().ok()
}
