//! Errors of mesh files.

use std::path::{Path, PathBuf};
use striae_mesh::MeshError;

/// A mesh file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", path.display())]
pub struct MeshFileError {
    /// The file.
    pub path: PathBuf,
    /// Fault in the file.
    #[source]
    pub fault: MeshFileFault,
}

/// Location in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line of text, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
    Byte(usize),
    /// A record of a section of a binary file.
    Record {
        /// The section.
        section: Section,
        /// The record, from 1; 0 is the beginning of the section.
        record: u32,
    },
    /// A cell of a VTK file, from 0.
    Cell(usize),
    /// A point of a VTK file, from 0.
    Point(usize),
    /// A triangle of a binary STL file, from 1.
    Triangle(usize),
}

/// A section of a Gmsh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// `$MeshFormat`.
    MeshFormat,
    /// `$PhysicalNames`.
    PhysicalNames,
    /// `$Entities`.
    Entities,
    /// `$Nodes`.
    Nodes,
    /// `$Elements`.
    Elements,
    /// `$NodeData`.
    NodeData,
    /// One that is not read.
    Other,
}

impl Section {
    /// The section that a line begins.
    pub(super) fn new(line: &str) -> Self {
        let known = [
            Self::MeshFormat,
            Self::PhysicalNames,
            Self::Entities,
            Self::Nodes,
            Self::Elements,
            Self::NodeData,
        ];
        let known = known.into_iter().find(|section| section.line() == line);
        known.unwrap_or(Self::Other)
    }

    /// The line that begins it.
    fn line(self) -> &'static str {
        match self {
            Self::MeshFormat => "$MeshFormat",
            Self::PhysicalNames => "$PhysicalNames",
            Self::Entities => "$Entities",
            Self::Nodes => "$Nodes",
            Self::Elements => "$Elements",
            Self::NodeData => "$NodeData",
            Self::Other => "a section that is not read",
        }
    }
}

impl std::fmt::Display for Section {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.line())
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Record { section, record: 0 } => write!(f, "{section}"),
            Self::Record { section, record } => write!(f, "{section}, record {record}"),
            Self::Cell(cell) => write!(f, "cell {cell}"),
            Self::Point(point) => write!(f, "point {point}"),
            Self::Triangle(triangle) => write!(f, "triangle {triangle}"),
        }
    }
}

/// Fault in a mesh file.
#[derive(Debug, thiserror::Error)]
pub enum MeshFileFault {
    /// The operating system refuses to read it.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] std::io::Error),
    /// Its name does not say what it holds.
    #[error("unknown kind of file; expected {expected}")]
    UnknownEnding {
        /// The endings that are known.
        expected: &'static str,
    },
    /// A place that is wrong or cannot be used.
    #[error("{place}: expected {expected}, found {found}{}", Remedy(remedy))]
    At {
        /// Location in the file.
        place: Place,
        /// Expected content.
        expected: String,
        /// Content found.
        found: String,
        /// Remedy.
        remedy: Option<&'static str>,
    },
    /// A binary file that is shorter or longer than it says.
    #[error("the file declares {announced} bytes, but has {found}")]
    Length {
        /// Number of bytes that follows from its header.
        announced: u64,
        /// Its number of bytes.
        found: u64,
    },
    /// The file contains nothing of the kind that is read.
    #[error("expected {expected}, found none; {remedy}")]
    Empty {
        /// Content searched for.
        expected: &'static str,
        /// Remedy.
        remedy: &'static str,
    },
    /// A part that the file does not have.
    #[error("{}", no_part(name, known))]
    NoPart {
        /// The requested name.
        name: String,
        /// Names of its element sets and instances.
        known: Vec<String>,
    },
    /// Node data that are not there, or one of several that are.
    #[error("{}", node_data(name, known))]
    NodeData {
        /// The requested name.
        name: Option<String>,
        /// Names of all node data of the file.
        known: Vec<String>,
    },
    /// A node without a vector.
    #[error("it has no vector for node {number} of the mesh")]
    NoVector {
        /// Number of the node in the file of the mesh.
        number: u64,
    },
    /// The mesh is inconsistent.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl MeshFileFault {
    /// A wrong line.
    pub(super) fn line(line: usize, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self::at(Place::Line(line), expected, found)
    }

    /// A wrong place.
    pub(super) fn at(place: Place, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self::At {
            place,
            expected: expected.into(),
            found: found.into(),
            remedy: None,
        }
    }

    /// Adds advice to the fault, if it has a location.
    pub(super) fn with_remedy(mut self, advice: &'static str) -> Self {
        if let Self::At { remedy, .. } = &mut self {
            *remedy = Some(advice);
        }
        self
    }

    /// The fault together with its file.
    pub fn of(self, path: &Path) -> MeshFileError {
        MeshFileError {
            path: path.to_owned(),
            fault: self,
        }
    }
}

fn node_data(name: &Option<String>, known: &[String]) -> String {
    let named: Vec<String> = known.iter().map(|name| format!("`{name}`")).collect();
    let known = match named.len() {
        0 => "there is none".to_owned(),
        1 => format!("there is {}", named[0]),
        _ => format!("there are {}", named.join(", ")),
    };
    match name {
        Some(name) => format!("expected node data `{name}` once; {known}"),
        None if named.is_empty() => format!("expected node data; {known}"),
        None => format!("expected the name of one of the node data; {known}"),
    }
}

fn no_part(name: &str, known: &[String]) -> String {
    let named: Vec<String> = known.iter().map(|name| format!("`{name}`")).collect();
    match named.len() {
        0 => format!("it has no element set or instance `{name}`, nor any other"),
        _ => format!(
            "it has no element set or instance `{name}`; it has {}",
            named.join(", ")
        ),
    }
}

struct Remedy<'a>(&'a Option<&'static str>);

impl std::fmt::Display for Remedy<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(remedy) => write!(f, "; {remedy}"),
            None => Ok(()),
        }
    }
}
