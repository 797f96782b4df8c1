//! Gmsh `.msh` files, ASCII and binary, versions 2 and 4.1.
//!
//! A file is a sequence of sections `$Name .. $EndName`. Both versions lead to
//! the same list of nodes and cells; a cell knows the physical groups it is in.
//! Gmsh numbers the corners of all linear cells as [`striae_mesh::CellKind`] does, nodes on
//! edges and faces otherwise (`kind.rs`). A triangle of six nodes is four faces, and so is a
//! quadrangle of eight or nine.

mod input;
mod kind;
mod node_data;
mod version2;
mod version4;

use super::collected::{Collected, FileElement, position};
use super::lines::quoted;
use super::{MeshFileFault, Place, RigidSurfaceMesh, division};
use input::{Input, readable};
use kind::Kind;
pub(super) use node_data::node_data;
use std::collections::{BTreeMap, HashMap, HashSet};
use striae_mesh::{NodeId, Vec3};

/// The mesh of a body.
#[cfg(test)]
pub(super) fn body(bytes: &[u8]) -> Result<super::Reading, MeshFileFault> {
    collected(bytes)?.mesh()
}

/// Mesh of a body as stated in the file.
pub(super) fn collected(bytes: &[u8]) -> Result<Collected, MeshFileFault> {
    let file = File::read(bytes)?;
    let mut mesh = Collected::default();
    let mut known = HashMap::new();
    for cell in &file.cells {
        let groups = cell.groups.iter().map(|group| file.name(cell, *group));
        match cell.kind.dimension() {
            3 => {
                let kind = cell.kind.cell();
                let kind = kind.ok_or_else(|| cell.kind.fault(cell.place))?;
                let corners = cell.kind.ordered(&cell.nodes);
                // A cell of several groups is written several times in version 2.
                let number = *known.entry(corners.clone()).or_insert(cell.number);
                if number == cell.number {
                    mesh.elements.push(FileElement {
                        kind,
                        place: cell.place,
                        number,
                        corners,
                    });
                }
                for name in groups {
                    let set = mesh.element_sets.entry(name).or_default();
                    set.push((cell.place, number));
                }
            }
            dimension => {
                let groups: Vec<String> = groups.collect();
                mesh.add_lower(dimension, cell.place, &cell.nodes, groups);
            }
        }
    }
    mesh.nodes = file.nodes;
    Ok(mesh)
}

/// The triangles and quadrangles of a rigid surface.
pub(super) fn rigid_surface(bytes: &[u8]) -> Result<RigidSurfaceMesh, MeshFileFault> {
    Ok(numbered_rigid_surface(bytes)?.0)
}

/// Rigid surface, with the number of every node in the file.
pub(super) fn numbered_rigid_surface(
    bytes: &[u8],
) -> Result<(RigidSurfaceMesh, Vec<u64>), MeshFileFault> {
    let file = File::read(bytes)?;
    let mut ids: BTreeMap<u64, NodeId> = BTreeMap::new();
    let mut numbers = Vec::new();
    let mut positions = Vec::new();
    let mut facets = Vec::new();
    let mut known = HashSet::new();
    for cell in file.cells.iter().filter(|cell| cell.kind.dimension() == 2) {
        for corners in cell.facets()? {
            if !known.insert(corners) {
                continue;
            }
            let mut facet = [NodeId(0); 4];
            for (node, number) in facet.iter_mut().zip(corners) {
                let position = file.nodes.get(&number).ok_or_else(|| {
                    MeshFileFault::at(cell.place, "an existing node", format!("node {number}"))
                })?;
                *node = *ids.entry(number).or_insert_with(|| {
                    positions.push(*position);
                    numbers.push(number);
                    NodeId::new(positions.len() - 1)
                });
            }
            facets.push(facet);
        }
    }
    if facets.is_empty() {
        return Err(MeshFileFault::Empty {
            expected: "triangles or quadrangles",
            remedy: "mesh the surfaces (gmsh -2) and save them",
        });
    }
    let surface = RigidSurfaceMesh {
        positions,
        facets,
        left_out: 0,
    };
    Ok((surface, numbers))
}

/// The content of a file.
#[derive(Default)]
struct File {
    /// Names of physical groups by dimension and number.
    names: HashMap<(usize, u64), String>,
    nodes: BTreeMap<u64, Vec3>,
    cells: Vec<Cell>,
}

/// One element of any kind.
struct Cell {
    place: Place,
    number: u64,
    kind: Kind,
    /// Numbers of its physical groups.
    groups: Vec<u64>,
    nodes: Vec<u64>,
}

/// The versions of the format that are read.
enum Version {
    Two,
    Four(version4::Entities),
}

impl File {
    fn read(bytes: &[u8]) -> Result<Self, MeshFileFault> {
        let bytes = readable(bytes);
        let mut input = Input::new(&bytes);
        let mut file = Self::default();
        let mut version = None;
        while let Some(section) = input.section()? {
            match (section, &mut version) {
                ("MeshFormat", None) => version = Some(read_format(&mut input)?),
                ("PhysicalNames", _) => file.read_names(&mut input)?,
                ("Entities", Some(Version::Four(entities))) => entities.read(&mut input)?,
                ("Nodes", Some(Version::Two)) => version2::nodes(&mut input, &mut file)?,
                ("Elements", Some(Version::Two)) => version2::elements(&mut input, &mut file)?,
                ("Nodes", Some(Version::Four(_))) => version4::nodes(&mut input, &mut file)?,
                ("Elements", Some(Version::Four(entities))) => {
                    version4::elements(&mut input, entities, &mut file)?;
                }
                ("Nodes" | "Elements" | "Entities", None) => {
                    let found = format!("`${section}`");
                    return Err(input.fault("$MeshFormat before all other sections", found));
                }
                _ => {
                    input.skip(section)?;
                    continue;
                }
            }
            input.end(section)?;
        }
        Ok(file)
    }

    /// `count`, then lines `dimension number "name"`.
    fn read_names(&mut self, input: &mut Input<'_>) -> Result<(), MeshFileFault> {
        input.text_row("the number of names")?;
        let count: usize = input.word("the number of names")?;
        for _ in 0..count {
            let line = input.line("a physical name")?;
            let fault = |expected| input.fault(expected, quoted(line));
            let mut words = line.split_whitespace().map(str::parse);
            let dimension = words.next().and_then(Result::ok);
            let number = words.next().and_then(Result::ok);
            let dimension = dimension.ok_or_else(|| fault("a dimension"))?;
            let number = number.ok_or_else(|| fault("the number of a physical group"))?;
            self.names
                .insert((dimension, number as u64), quoted_name(line, fault)?);
        }
        Ok(())
    }

    fn name(&self, cell: &Cell, group: u64) -> String {
        let name = self.names.get(&(cell.kind.dimension(), group));
        name.cloned().unwrap_or_else(|| group.to_string())
    }

    fn add_node(&mut self, place: Place, number: u64, x: &[f64]) -> Result<(), MeshFileFault> {
        let x = position(place, number, Vec3::new(x[0], x[1], x[2]))?;
        match self.nodes.insert(number, x) {
            None => Ok(()),
            Some(_) => {
                let found = format!("node {number} for the second time");
                Err(MeshFileFault::at(place, "a new node number", found))
            }
        }
    }
}

impl Cell {
    /// The corners of quadrangles, or of triangles with the last one twice.
    fn facets(&self) -> Result<Vec<[u64; 4]>, MeshFileFault> {
        match (self.kind, self.nodes.as_slice()) {
            (Kind::TRIANGLE, &[a, b, c]) => Ok(vec![[a, b, c, c]]),
            (Kind::QUADRANGLE, &[a, b, c, d]) => Ok(vec![[a, b, c, d]]),
            (Kind::TRIANGLE_6, &[a, b, c, ab, bc, ca]) => {
                Ok(division::in_triangles([a, b, c], [ab, bc, ca]))
            }
            (Kind::QUADRANGLE_9, &[a, b, c, d, ab, bc, cd, da, middle]) => {
                Ok(division::quartered([a, b, c, d], [ab, bc, cd, da], middle))
            }
            _ => Err(self.kind.fault(self.place)),
        }
    }
}

/// `version file-type data-size`, and in binary files a number that shows the order of bytes.
fn read_format(input: &mut Input<'_>) -> Result<Version, MeshFileFault> {
    let line = input.line("version, file type and data size")?;
    let mut words = line.split_whitespace();
    let mut word = |expected: &str| {
        let word = words.next();
        word.ok_or_else(|| input.fault(expected, "the end of the line"))
    };
    let version = word("a version")?;
    let file_type = word("file type 0 (ASCII) or 1 (binary)")?;
    let version = match version {
        "4.1" => Version::Four(version4::Entities::default()),
        "2" | "2.0" | "2.1" | "2.2" => Version::Two,
        _ => {
            let fault = input.fault("version 2.2 or 4.1", quoted(line));
            return Err(fault.with_remedy("save the mesh with Mesh.MshFileVersion = 4.1"));
        }
    };
    match (file_type, words.next()) {
        ("0", _) => {}
        ("1", Some("4")) => input.begin_binary(4)?,
        ("1", Some("8")) => input.begin_binary(8)?,
        ("1", _) => return Err(input.fault("data size 4 or 8", quoted(line))),
        _ => return Err(input.fault("file type 0 (ASCII) or 1 (binary)", quoted(line))),
    }
    Ok(version)
}

/// The text in quotation marks at the end of a line.
fn quoted_name(
    line: &str,
    fault: impl Fn(&'static str) -> MeshFileFault,
) -> Result<String, MeshFileFault> {
    let name = line.split_once('"');
    let name = name.and_then(|(_, rest)| rest.strip_suffix('"'));
    Ok(name
        .ok_or_else(|| fault("a name in quotation marks"))?
        .to_owned())
}
