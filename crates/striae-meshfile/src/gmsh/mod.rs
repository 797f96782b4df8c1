//! Gmsh `.msh` files, ASCII, versions 2 and 4.1.
//!
//! A file is a sequence of sections `$Name .. $EndName`. Both versions lead to
//! the same list of nodes and cells; a cell knows the physical groups it is in.
//! Gmsh numbers the corners of all linear cells as [`striae_mesh::CellKind`] does, nodes on
//! edges and faces otherwise (`kind.rs`). A triangle of six nodes is four faces, and so is a
//! quadrangle of eight or nine.

mod kind;
mod node_data;
mod version2;
mod version4;

use super::collected::{Collected, FileElement, FileFace, position};
use super::lines::{Line, Lines};
use super::{MeshFileFault, Reading, RigidSurfaceMesh, division};
use kind::Kind;
pub(super) use node_data::node_data;
use std::collections::{BTreeMap, HashMap, HashSet};
use striae_mesh::{NodeId, Vec3};

/// The mesh of a body.
pub(super) fn body(text: &str) -> Result<Reading, MeshFileFault> {
    collected(text)?.mesh()
}

/// What the file says of the mesh of a body.
pub(super) fn collected(text: &str) -> Result<Collected, MeshFileFault> {
    let file = File::read(text)?;
    let mut mesh = Collected::default();
    let mut known = HashMap::new();
    for cell in &file.cells {
        let groups = cell.groups.iter().map(|group| file.name(cell, *group));
        match cell.kind.dimension() {
            3 => {
                let kind = cell.kind.cell();
                let kind = kind.ok_or_else(|| cell.kind.fault(cell.line))?;
                let corners = cell.kind.ordered(&cell.nodes);
                // A cell of several groups is written several times in version 2.
                let number = *known.entry(corners.clone()).or_insert(cell.number);
                if number == cell.number {
                    mesh.elements.push(FileElement {
                        kind,
                        line: cell.line,
                        number,
                        corners,
                    });
                }
                for name in groups {
                    let set = mesh.element_sets.entry(name).or_default();
                    set.push((cell.line, number));
                }
            }
            2 if cell.groups.is_empty() => {}
            2 => {
                let faces = cell.faces()?;
                for name in groups {
                    let set = mesh.facet_sets.entry(name).or_default();
                    set.extend(faces.iter().map(|face| (cell.line, *face)));
                }
            }
            _ => {
                for name in groups {
                    let set = mesh.node_sets.entry(name).or_default();
                    set.extend(cell.nodes.iter().map(|&node| (cell.line, node)));
                }
            }
        }
    }
    mesh.nodes = file.nodes;
    Ok(mesh)
}

/// The triangles and quadrangles of a rigid surface.
pub(super) fn rigid_surface(text: &str) -> Result<RigidSurfaceMesh, MeshFileFault> {
    Ok(numbered_rigid_surface(text)?.0)
}

/// The same, and the number of every node in the file.
pub(super) fn numbered_rigid_surface(
    text: &str,
) -> Result<(RigidSurfaceMesh, Vec<u64>), MeshFileFault> {
    let file = File::read(text)?;
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
                    MeshFileFault::line(cell.line, "an existing node", format!("node {number}"))
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
    Ok((RigidSurfaceMesh { positions, facets }, numbers))
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
    line: usize,
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
    fn read(text: &str) -> Result<Self, MeshFileFault> {
        let mut lines = Lines::new(text);
        let mut file = Self::default();
        let mut version = None;
        while let Some(line) = lines.next() {
            let Some(section) = line.text.strip_prefix('$') else {
                return Err(line.fault("a section such as $MeshFormat"));
            };
            match (section, &mut version) {
                ("MeshFormat", None) => version = Some(read_format(&mut lines)?),
                ("PhysicalNames", _) => file.read_names(&mut lines)?,
                ("Entities", Some(Version::Four(entities))) => entities.read(&mut lines)?,
                ("Nodes", Some(Version::Two)) => version2::nodes(&mut lines, &mut file)?,
                ("Elements", Some(Version::Two)) => version2::elements(&mut lines, &mut file)?,
                ("Nodes", Some(Version::Four(_))) => version4::nodes(&mut lines, &mut file)?,
                ("Elements", Some(Version::Four(entities))) => {
                    version4::elements(&mut lines, entities, &mut file)?;
                }
                ("Nodes" | "Elements" | "Entities", None) => {
                    return Err(line.fault("$MeshFormat before all other sections"));
                }
                _ => {
                    skip(&mut lines, section)?;
                    continue;
                }
            }
            lines.exactly(&format!("$End{section}"))?;
        }
        Ok(file)
    }

    /// `count`, then lines `dimension number "name"`.
    fn read_names(&mut self, lines: &mut Lines<'_>) -> Result<(), MeshFileFault> {
        let count: usize = lines
            .words("the number of names")?
            .next("the number of names")?;
        for _ in 0..count {
            let line = lines.expect("a physical name")?;
            let mut words = line.words();
            let dimension = words.next("a dimension")?;
            let number = words.next("the number of a physical group")?;
            self.names.insert((dimension, number), quoted_name(line)?);
        }
        Ok(())
    }

    fn name(&self, cell: &Cell, group: u64) -> String {
        let name = self.names.get(&(cell.kind.dimension(), group));
        name.cloned().unwrap_or_else(|| group.to_string())
    }

    fn add_node(&mut self, line: usize, number: u64, x: &[f64]) -> Result<(), MeshFileFault> {
        let x = position(line, number, Vec3::new(x[0], x[1], x[2]))?;
        match self.nodes.insert(number, x) {
            None => Ok(()),
            Some(_) => {
                let found = format!("node {number} for the second time");
                Err(MeshFileFault::line(line, "a new node number", found))
            }
        }
    }
}

impl Cell {
    /// The faces that it is, on a body.
    fn faces(&self) -> Result<Vec<FileFace>, MeshFileFault> {
        if let (Kind::QUADRANGLE_8, &[a, b, c, d, ab, bc, cd, da]) = (self.kind, &self.nodes[..]) {
            return Ok(vec![FileFace::Eight([a, b, c, d], [ab, bc, cd, da])]);
        }
        let facets = self.facets()?.into_iter();
        Ok(facets.map(FileFace::Corners).collect())
    }

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
            _ => Err(self.kind.fault(self.line)),
        }
    }
}

/// `version file-type data-size`.
fn read_format(lines: &mut Lines<'_>) -> Result<Version, MeshFileFault> {
    let line = lines.expect("version, file type and data size")?;
    let mut words = line.words();
    let version: String = words.next("a version")?;
    let file_type: String = words.next("file type 0 (ASCII)")?;
    if file_type != "0" {
        return Err(line
            .fault("file type 0 (ASCII)")
            .with_remedy("save the mesh with Mesh.Binary = 0"));
    }
    match version.as_str() {
        "4.1" => Ok(Version::Four(version4::Entities::default())),
        "2" | "2.0" | "2.1" | "2.2" => Ok(Version::Two),
        _ => Err(line
            .fault("version 2.2 or 4.1")
            .with_remedy("save the mesh with Mesh.MshFileVersion = 4.1")),
    }
}

fn quoted_name(line: Line<'_>) -> Result<String, MeshFileFault> {
    let name = line
        .text
        .split_once('"')
        .and_then(|(_, rest)| rest.strip_suffix('"'));
    Ok(name
        .ok_or_else(|| line.fault("a name in quotation marks"))?
        .to_owned())
}

fn skip(lines: &mut Lines<'_>, section: &str) -> Result<(), MeshFileFault> {
    let end = format!("$End{section}");
    while lines.expect(&end)?.text != end {}
    Ok(())
}
