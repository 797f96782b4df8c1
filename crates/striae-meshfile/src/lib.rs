//! Meshes of bodies and rigid surfaces from files.
//!
//! | ending | format | what is read |
//! | --- | --- | --- |
//! | `.msh` | Gmsh, ASCII and binary, versions 2 and 4.1 | cells; physical volumes as element sets, surfaces as facet and node sets, curves and points as node sets |
//! | `.inp` | Abaqus | elements `C3D4`, `C3D5`, `C3D6`, `C3D8`, `C3D10`, `C3D15`, `C3D20`, `C3D27` of any variant, `*NSET`, `*ELSET`, `*SURFACE`; materials |
//! | `.vtu`, `.vtk` | unstructured grids of VTK, as XML and legacy | cells; arrays of integers as sets `<array>-<value>` |
//! | `.stl` | STL, ASCII and binary | triangles of a rigid surface |
//! | `.csv` | lines `node,x,y,z` | vectors at nodes; so do `$NodeData` of three components in `.msh` |
//!
//! Tetrahedra have four or ten nodes. Hexahedra of 20 or 27 nodes and wedges of 15 or 18 are
//! divided into linear ones on all their nodes, see [`Reading::notes`].
//!
//! Nodes that no element uses are left out, also of sets; sets that become
//! empty vanish. Elements of lower dimension make sets of facets and nodes where they lie on the
//! body. Each facet set gives its name to the set of its nodes unless the
//! file has a node set of that name; node set and element set `all` hold
//! everything. Physical groups of Gmsh without a name are called by their number.
//!
//! Formats: Gmsh reference manual, "Gmsh file formats"; Abaqus keywords
//! reference guide; "VTK file formats" in VTK's documentation.

mod abaqus;
mod cards;
mod collected;
mod content;
mod division;
mod error;
mod gmsh;
mod ids;
mod lines;
mod loose;
mod lower;
mod node_vectors;
mod numbers;
mod restrict;
mod sets;
mod stl;
#[cfg(test)]
mod tests;
mod unused;
mod vtk;

pub use abaqus::{InputFile, Keyword, Points, Row, finite, material_lines};
pub use cards::{Card, Elasticity, MaterialCard, Moduli, SectionCard};
pub use content::content;
pub use error::{MeshFileError, MeshFileFault, Place, Section};
pub use node_vectors::NodeVectors;
pub use numbers::Numbers;
pub use unused::{Unused, unused_note};

use collected::Collected;
use std::path::Path;
use striae_mesh::{Mesh, NodeId, Vec3};

/// A rigid surface read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidSurfaceMesh {
    /// Node positions.
    pub positions: Vec<Vec3>,
    /// Corners of the facets in the order of the file; a triangle repeats its
    /// last corner.
    pub facets: Vec<[NodeId; 4]>,
    /// Triangles of an STL file that have no area and are left out.
    pub left_out: usize,
}

/// The mesh of a body read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The mesh.
    pub mesh: Mesh,
    /// Notes on parts of the file that were interpreted or replaced, one line each.
    pub notes: Vec<String>,
    /// The formulation that the elements of the file request.
    pub asked: Option<Asked>,
    /// Numbers of nodes and elements in the file.
    pub numbers: Numbers,
    /// Materials that the file states.
    pub materials: Vec<MaterialCard>,
    /// Materials that the file gives to element sets of the mesh.
    pub sections: Vec<SectionCard>,
    /// Keywords of the file that no mesh is made of.
    pub unused: Vec<Unused>,
}

impl From<Mesh> for Reading {
    /// A mesh of no file, whose nodes and elements are numbered from 0.
    fn from(mesh: Mesh) -> Self {
        let numbers = Numbers {
            nodes: (0..mesh.positions.len() as u64).collect(),
            elements: (0..mesh.element_count() as u64).collect(),
            instances: Vec::new(),
        };
        Self {
            mesh,
            notes: Vec::new(),
            asked: None,
            numbers,
            materials: Vec::new(),
            sections: Vec::new(),
            unused: Vec::new(),
        }
    }
}

/// A formulation of elements that a letter in their name requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// With a pressure of their own: `C3D8H`.
    MeanDilatation,
    /// With incompatible modes: `C3D8I`.
    AssumedStrain,
}

/// Reads the mesh of a body from a `.msh`, `.inp`, `.vtu` or `.vtk` file.
///
/// # Errors
/// [`MeshFileError`] names the file and, where there is one, the line. Every
/// mesh returned has passed [`Mesh::check`] and [`Mesh::check_shape`].
pub fn read(path: impl AsRef<Path>) -> Result<Mesh, MeshFileError> {
    read_with_notes(path).map(|reading| reading.mesh)
}

/// Reads a file like [`read`], with notes about it.
///
/// # Errors
/// Returns the errors of [`read`].
pub fn read_with_notes(path: impl AsRef<Path>) -> Result<Reading, MeshFileError> {
    read_part(path, None)
}

/// Reads a part of a file like [`read_with_notes`]: an element set, a physical volume, or an
/// instance of a part. Sets are restricted to that part; sets without members in it are dropped.
///
/// # Errors
/// Returns the errors of [`read`], and [`MeshFileFault::NoPart`] if the file has no part of that
/// name.
pub fn read_part(path: impl AsRef<Path>, part: Option<&str>) -> Result<Reading, MeshFileError> {
    let path = path.as_ref();
    if ending(path) == "inp" {
        return abaqus::read(path, part);
    }
    let reading = collected(path).and_then(|collected| collected.of_part(part)?.mesh());
    reading.map_err(|fault| fault.of(path))
}

/// Mesh of a body as stated in a file of another format than Abaqus's.
fn collected(path: &Path) -> Result<Collected, MeshFileFault> {
    match ending(path).as_str() {
        "msh" => gmsh::collected(&bytes(path)?),
        "vtu" => vtk::xml_collected(&bytes(path)?),
        "vtk" => vtk::legacy_collected(&bytes(path)?),
        _ => Err(MeshFileFault::UnknownEnding { expected: BODY }),
    }
}

/// Reads the triangles and quadrangles of a rigid surface from a `.msh`, `.inp` or `.stl` file.
///
/// Points, curves and volumes of a Gmsh file are passed over, and so are solids and lines of an
/// Abaqus file. Triangles of an STL file share corners at equal positions; triangles with two
/// corners at the same position have no area and are left out.
///
/// # Errors
/// [`MeshFileError`] names the file and, where there is one, the line.
pub fn read_rigid_surface(path: impl AsRef<Path>) -> Result<RigidSurfaceMesh, MeshFileError> {
    read_rigid_part(path, None)
}

/// Reads a part of an Abaqus file like [`read_rigid_surface`]: an element set, or an instance.
///
/// # Errors
/// Returns the errors of [`read_rigid_surface`], and [`MeshFileFault::NoPart`] if the file has no
/// part of that name.
pub fn read_rigid_part(
    path: impl AsRef<Path>,
    part: Option<&str>,
) -> Result<RigidSurfaceMesh, MeshFileError> {
    let path = path.as_ref();
    match (ending(path).as_str(), part) {
        ("inp", _) => return abaqus::rigid_surface(path, part).map(|(surface, _)| surface),
        ("msh" | "stl", Some(part)) => Err(MeshFileFault::NoPart {
            name: part.to_owned(),
            known: Vec::new(),
        }),
        ("msh", None) => bytes(path).and_then(|bytes| gmsh::rigid_surface(&bytes)),
        ("stl", None) => bytes(path).and_then(|bytes| stl::rigid_surface(&bytes)),
        _ => Err(MeshFileFault::UnknownEnding {
            expected: ".msh (Gmsh), .inp (Abaqus) or .stl",
        }),
    }
    .map_err(|fault| fault.of(path))
}

/// Reads vectors at nodes from a `.msh` or `.csv` file.
///
/// Of the node data of a Gmsh file those called `name` are read, or the only ones. A list has a
/// line `node,x,y,z` for every node, below these words; its name is ignored.
///
/// # Errors
/// [`MeshFileError`] names the file and, where there is one, the line.
pub fn read_node_vectors(
    path: impl AsRef<Path>,
    name: Option<&str>,
) -> Result<NodeVectors, MeshFileError> {
    let path = path.as_ref();
    match ending(path).as_str() {
        "msh" => bytes(path).and_then(|bytes| gmsh::node_data(&bytes, name)),
        "csv" => text(path).and_then(|text| node_vectors::list(&text)),
        _ => Err(MeshFileFault::UnknownEnding {
            expected: ".msh (Gmsh) or .csv",
        }),
    }
    .map_err(|fault| fault.of(path))
}

/// Numbers in the file of the nodes of what [`read_part`] returns, in the order of their ids.
///
/// # Errors
/// As [`read_part`].
pub fn node_numbers(path: impl AsRef<Path>, part: Option<&str>) -> Result<Vec<u64>, MeshFileError> {
    let path = path.as_ref();
    let collected = match ending(path).as_str() {
        "inp" => Ok(abaqus::read_collected(path)?),
        _ => collected(path),
    };
    collected
        .and_then(|collected| collected.of_part(part)?.node_numbers())
        .map_err(|fault| fault.of(path))
}

/// Numbers in the file of the nodes of what [`read_rigid_part`] returns, in the
/// order of their ids; the nodes of an STL file have none and are counted from 0.
///
/// # Errors
/// As [`read_rigid_part`].
pub fn rigid_node_numbers(
    path: impl AsRef<Path>,
    part: Option<&str>,
) -> Result<Vec<u64>, MeshFileError> {
    let path = path.as_ref();
    match ending(path).as_str() {
        "msh" => bytes(path)
            .and_then(|bytes| gmsh::numbered_rigid_surface(&bytes))
            .map(|(_, numbers)| numbers)
            .map_err(|fault| fault.of(path)),
        "inp" => abaqus::rigid_surface(path, part).map(|(_, numbers)| numbers),
        _ => read_rigid_surface(path).map(|surface| (0..surface.positions.len() as u64).collect()),
    }
}

/// Endings of meshes of bodies.
const BODY: &str = ".msh (Gmsh), .inp (Abaqus), .vtu or .vtk (VTK)";

fn ending(path: &Path) -> String {
    path.extension()
        .map(|ending| ending.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}

fn bytes(path: &Path) -> Result<Vec<u8>, MeshFileFault> {
    content(path).map_err(MeshFileFault::Unreadable)
}

/// The text of a file; bytes that are not UTF-8 can only matter in names.
fn text(path: &Path) -> Result<String, MeshFileFault> {
    Ok(String::from_utf8_lossy(&bytes(path)?).into_owned())
}
