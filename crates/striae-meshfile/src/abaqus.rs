//! Abaqus `.inp` files.
//!
//! A file is a sequence of keywords with parameters, each followed by its
//! lines of numbers or names; `*INCLUDE` stands for the lines of another file
//! (`abaqus/include.rs`). Read are nodes, elements `C3D4`, `C3D5`, `C3D6`, `C3D8`,
//! `C3D10`, `C3D15`, `C3D20` and `C3D27` of any variant, node and element sets (with `GENERATE`,
//! names of other sets, `NSET` of an `ELSET`) and element-based surfaces (`abaqus/part.rs`);
//! other keywords are passed over. Elements of lower dimension make sets of facets and nodes
//! (`abaqus/lower.rs`), and `*MATERIAL` and `*SOLID SECTION` are handed on as they stand
//! (`abaqus/material.rs`). `H` asks for mean dilatation and `I` for an assumed strain; elements `R`
//! are read, with a note, as those with full integration. Abaqus numbers nodes and sides as
//! [`striae_mesh::CellKind`] does; `S1` is side 0, all four faces of it in a ten-node
//! tetrahedron. Labels are the same in capital and small letters and keep the spelling of their
//! first use.
//!
//! Instances are parts put into their places (`abaqus/instance.rs`). A single one keeps its
//! numbers and labels; of several, sets are called `instance.set`, and all nodes and elements of
//! an instance by its name (`abaqus/names.rs`). Nodes and elements of the assembly itself
//! (reference points, connectors) are passed over.

mod include;
mod input;
mod instance;
mod keywords;
mod lower;
mod material;
mod names;
mod part;
mod sets;
mod surface;
mod unused;

use super::collected::Collected;
use super::numbers::NUMBER_BITS;
use super::{MeshFileError, MeshFileFault, Reading, RigidSurfaceMesh};
use include::Text;
pub use input::{InputFile, Points, finite};
use instance::{Motion, Placement};
use keywords::keywords;
pub use keywords::{Keyword, Row};
pub use material::material_lines;
use names::Names;
use part::{Part, Use};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The mesh of a body, or of a part of it, from a file.
pub(super) fn read(path: &Path, part: Option<&str>) -> Result<Reading, MeshFileError> {
    let text = Text::read(path)?;
    let collected = of_text(&text);
    let reading = collected.and_then(|collected| collected.of_part(part)?.mesh());
    reading.map_err(|fault| text.placed(fault))
}

/// Mesh of a body as stated in a file.
pub(super) fn read_collected(path: &Path) -> Result<Collected, MeshFileError> {
    let text = Text::read(path)?;
    of_text(&text).map_err(|fault| text.placed(fault))
}

/// The facets of a rigid surface, or of a part of it, and the number of every node in the file.
pub(super) fn rigid_surface(
    path: &Path,
    part: Option<&str>,
) -> Result<(RigidSurfaceMesh, Vec<u64>), MeshFileError> {
    let text = Text::read(path)?;
    let found = || {
        let keywords = keywords(&text.lines)?;
        let mut reader = Reader::of(&keywords)?;
        reader.place_all()?;
        let chosen = part.map(|part| (part, reader.names.instance(part)));
        reader.whole.rigid_surface(chosen)
    };
    found().map_err(|fault| text.placed(fault))
}

fn of_text(text: &Text) -> Result<Collected, MeshFileFault> {
    let explain = |fault| text.placed(fault).to_string();
    collected(&text.lines, explain, |line| text.place(line))
}

/// The mesh of a body.
#[cfg(test)]
pub(super) fn body(text: &str) -> Result<Reading, MeshFileFault> {
    part(text, None)
}

/// The mesh of a part of a body.
#[cfg(test)]
pub(super) fn part(text: &str, part: Option<&str>) -> Result<Reading, MeshFileFault> {
    let place = |line| format!("line {line}");
    let collected = collected(text, |fault| fault.to_string(), place)?;
    collected.of_part(part)?.mesh()
}

/// Mesh of a body as stated in the text; `explain` gives the reason why a material cannot be used,
/// and `place` the location of a line.
pub(super) fn collected(
    text: &str,
    explain: impl Fn(MeshFileFault) -> String,
    place: impl Fn(usize) -> String,
) -> Result<Collected, MeshFileFault> {
    let keywords = keywords(text)?;
    let mut reader = Reader::of(&keywords)?;
    let unused = unused::unused(&keywords, &std::mem::take(&mut reader.unused), place);
    let mut collected = reader.finish()?;
    collected.materials = material::materials(&keywords, explain)?;
    collected.unused = unused;
    Ok(collected)
}

#[derive(Default)]
struct Reader<'a> {
    scope: Scope<'a>,
    /// The part or instance that is being read.
    current: Part,
    /// Parts that have been read, by name in capitals.
    parts: BTreeMap<String, Known<'a>>,
    names: Names,
    /// Content outside of parts, and everything that has been placed.
    whole: Part,
    /// Lines of keywords that are passed over.
    unused: BTreeSet<usize>,
}

/// Level of a keyword in the hierarchy of the file.
#[derive(Default)]
enum Scope<'a> {
    #[default]
    Outside,
    Part(&'a Keyword<'a>),
    Assembly,
    Instance(&'a Keyword<'a>, Placement),
}

/// A part that has been read.
struct Known<'a> {
    keyword: &'a Keyword<'a>,
    part: Part,
    /// Number of its instances.
    instances: usize,
}

impl<'a> Reader<'a> {
    /// Reads all keywords of a file.
    fn of(keywords: &'a [Keyword<'a>]) -> Result<Self, MeshFileFault> {
        let mut reader = Self {
            names: Names::of(keywords),
            ..Self::default()
        };
        for keyword in keywords {
            reader.read(keyword)?;
        }
        Ok(reader)
    }

    fn read(&mut self, keyword: &'a Keyword<'a>) -> Result<(), MeshFileFault> {
        match keyword.name.as_str() {
            "PART" => {
                self.close()?;
                self.scope = Scope::Part(keyword);
                Ok(())
            }
            "ASSEMBLY" => {
                self.close()?;
                self.scope = Scope::Assembly;
                Ok(())
            }
            "INSTANCE" => {
                self.close()?;
                self.open_instance(keyword)
            }
            "END PART" | "END ASSEMBLY" => {
                self.close()?;
                self.scope = Scope::Outside;
                Ok(())
            }
            "END INSTANCE" => self.close(),
            "NODE" | "ELEMENT" if matches!(self.scope, Scope::Assembly) => self.pass_over(keyword),
            "NODE" => self.part().read_nodes(keyword),
            "ELEMENT" => self.part().read_elements(keyword),
            "NSET" | "ELSET" | "SURFACE" => self.read_set(keyword),
            "SOLID SECTION" => self.part().read_section(keyword),
            "NGEN" | "NFILL" | "NCOPY" | "NMAP" | "ELGEN" | "ELCOPY" | "SYSTEM" => {
                let fault = keyword.fault("nodes and elements written out one by one");
                Err(fault.with_remedy("write the mesh out flat with its preprocessor"))
            }
            "PARAMETER" => {
                let fault = keyword.fault("numbers in the places of parameters");
                Err(fault.with_remedy("write the value for each name in angle brackets"))
            }
            _ => {
                self.unused.insert(keyword.line);
                Ok(())
            }
        }
    }

    /// Part that keywords of the mesh refer to.
    fn part(&mut self) -> &mut Part {
        match self.scope {
            Scope::Part(_) | Scope::Instance(..) => &mut self.current,
            Scope::Outside | Scope::Assembly => &mut self.whole,
        }
    }

    /// Puts away the part or instance that is being read.
    fn close(&mut self) -> Result<(), MeshFileFault> {
        let scope = std::mem::take(&mut self.scope);
        match scope {
            Scope::Part(keyword) => {
                let part = std::mem::take(&mut self.current);
                let known = Known {
                    keyword,
                    part,
                    instances: 0,
                };
                let name = keyword.required("NAME")?.to_uppercase();
                if self.parts.insert(name, known).is_some() {
                    return Err(keyword.fault("a name that no other part has"));
                }
            }
            Scope::Instance(keyword, placement) => {
                self.scope = Scope::Assembly;
                let part = std::mem::take(&mut self.current);
                let several = !placement.prefix.is_empty();
                if several && !part.has_numbers_of_instances() {
                    let expected = format!("numbers below {}", 1_u64 << NUMBER_BITS);
                    return Err(keyword.fault(&expected));
                }
                self.whole.place(&part, &placement);
                if !several {
                    return Ok(());
                }
                let name = keyword.required("NAME")?;
                self.whole
                    .name_all(&part, placement.raise, name, keyword.line);
            }
            Scope::Outside | Scope::Assembly => self.scope = scope,
        }
        Ok(())
    }

    fn open_instance(&mut self, keyword: &'a Keyword<'a>) -> Result<(), MeshFileFault> {
        let name = keyword.required("PART")?;
        let known = self.parts.get_mut(&name.to_uppercase());
        let known = known.ok_or_else(|| keyword.fault("an instance of a part defined before"))?;
        known.instances += 1;
        self.current = known.part.clone();
        let motion = Motion::read(keyword)?;
        let (raise, prefix) = self.names.add(keyword)?;
        let placement = Placement {
            raise,
            prefix,
            motion,
        };
        self.scope = Scope::Instance(keyword, placement);
        Ok(())
    }

    /// Nodes and elements of the assembly are no part of a body, but sets may name them.
    fn pass_over(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        self.whole.name_sets(keyword);
        if keyword.name == "NODE" {
            return self.names.own_nodes(keyword);
        }
        let kind = keyword.required("TYPE")?.to_uppercase();
        if lower::is_solid(&kind) {
            return Err(keyword.fault("solid elements in a part"));
        }
        let note = format!("elements of type {kind} of the assembly are ignored");
        self.whole.note(note);
        self.names.own_elements(keyword)
    }

    fn read_set(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        let names = match self.scope {
            Scope::Part(_) | Scope::Instance(..) => self.names.of_part(),
            Scope::Outside | Scope::Assembly => self.names.for_keyword(keyword)?,
        };
        let part = self.part();
        match keyword.name.as_str() {
            "NSET" => part.read_node_set(keyword, &names),
            "ELSET" => part.read_element_set(keyword, &names),
            _ => {
                if part.read_surface(keyword, &names)? == Use::Nothing {
                    self.unused.insert(keyword.line);
                }
                Ok(())
            }
        }
    }

    fn finish(mut self) -> Result<Collected, MeshFileFault> {
        self.place_all()?;
        let whole = self.names.only().map(str::to_owned);
        let collected = self.whole.collected(self.names.needed())?;
        Ok(Collected { whole, ..collected })
    }

    /// Puts all that has been read into the whole.
    fn place_all(&mut self) -> Result<(), MeshFileFault> {
        self.close()?;
        if self.names.is_empty() {
            self.place_lone_part()?;
        } else {
            for known in self.parts.values().filter(|known| known.instances == 0) {
                let name = known.keyword.required("NAME")?;
                let note = format!("part `{name}` has no instance and is left out");
                self.whole.note(note);
            }
        }
        Ok(())
    }

    /// Places the part of a file without an assembly.
    fn place_lone_part(&mut self) -> Result<(), MeshFileFault> {
        let parts = std::mem::take(&mut self.parts);
        let mut parts: Vec<Known<'_>> = parts.into_values().collect();
        parts.sort_by_key(|known| known.keyword.line);
        if let Some(second) = parts.get(1) {
            let fault = second.keyword.fault("an assembly with instances of parts");
            return Err(fault.with_remedy("write each part into a file of its own"));
        }
        let place = Placement {
            raise: 0,
            prefix: String::new(),
            motion: Motion::default(),
        };
        parts
            .iter()
            .for_each(|known| self.whole.place(&known.part, &place));
        Ok(())
    }
}

/// A number, its exponent also marked with `D`.
fn number(word: &str) -> Option<f64> {
    word.replace(['D', 'd'], "e").parse().ok()
}
