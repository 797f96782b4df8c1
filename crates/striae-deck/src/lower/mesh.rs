//! Meshes of bodies and rigid surfaces, generated, read or written in the deck.

use crate::{
    fault::FaultKind,
    faults::{FaultList, Span},
    raw,
    read::At,
    value::{Text, vector},
};
use std::path::{Path, PathBuf};
use striae_mesh::generate::{Generate, Generator, MOST_ELEMENTS};
use striae_mesh::{CellBlock, CellKind, Mesh, NodeId, Vec3};
use striae_meshfile::{self as mesh_file, MeshFileError, MeshFileFault, Reading};
use striae_model::{FaultKind as ModelFault, nearest};
use striae_output::available_bytes;

/// Bytes that making and checking a mesh takes for each element, measured on blocks.
const BYTES: f64 = 900.0;
/// Bytes that the thriftiest solver takes for each node, by the formula of `striae check`.
const RUN_BYTES: f64 = 15e3;
/// Memory by formula over that which suffices.
const UNCERTAIN: f64 = 1.5;

/// Mesh of a body, with notes about its file; `None` after its faults have been noted.
///
/// Meshes from generators and files have been checked for consistency and inverted elements.
pub(super) fn body_mesh(
    raw: &At<raw::Mesh>,
    body: &str,
    base: &Path,
    faults: &mut FaultList<'_>,
) -> Option<Reading> {
    let owner = format!("body `{body}`");
    let mesh: Option<Mesh> = match &raw.value {
        raw::Mesh::File(file) => {
            let part = file.elements.as_ref();
            let name = part.map(|part| part.value.0.as_str());
            let read = mesh_file::read_part(path(&file.file, base)?, name);
            return made_of_part(read, (&file.file, part), owner, &raw.span, faults);
        }
        raw::Mesh::Inline(mesh) => inline_mesh(mesh, owner, &raw.span, faults),
        raw::Mesh::Generated(generator) => {
            let generator = match generator.made(&raw.span)? {
                Ok(generator) => generator,
                Err((refusal, span)) => return made(Err(refusal), owner, &span, faults),
            };
            if let Some(kind) = too_large(&generator, body) {
                faults.push(&raw.span, kind);
                return None;
            }
            made(generator.mesh(), owner, &raw.span, faults)
        }
    };
    mesh.map(Reading::from)
}

/// The fault that a mesh would take more memory than there is, told before it is taken.
fn too_large(generator: &Generator, body: &str) -> Option<FaultKind> {
    // More than a generator makes is a fault of its own.
    let elements = generator
        .elements()
        .filter(|count| *count <= MOST_ELEMENTS)?;
    let made = BYTES * elements as f64;
    let run = RUN_BYTES * generator.nodes().unwrap_or(0) as f64;
    let available = available_bytes()?;
    let needed = match (made > available, run > UNCERTAIN * available) {
        (_, true) => run,
        (true, false) => made,
        (false, false) => return None,
    };
    Some(FaultKind::MeshMemory {
        body: body.to_owned(),
        elements,
        needed,
        available,
    })
}

/// Positions and facets of a rigid surface; `None` after its faults have been noted.
pub(super) fn surface(
    raw: &At<raw::SurfaceMesh>,
    name: &str,
    base: &Path,
    faults: &mut FaultList<'_>,
) -> Option<(Vec<Vec3>, Vec<[NodeId; 4]>)> {
    match &raw.value {
        raw::SurfaceMesh::File(file) => {
            let owner = format!("rigid surface `{name}`");
            let part = file.elements.as_ref();
            let name = part.map(|part| part.value.0.as_str());
            let read = mesh_file::read_rigid_part(path(&file.file, base)?, name);
            let read = made_of_part(read, (&file.file, part), owner, &raw.span, faults);
            read.map(|surface| (surface.positions, surface.facets))
        }
        raw::SurfaceMesh::Inline(surface) => inline_surface(surface, name, faults),
    }
}

/// Mesh made of a part of a file, which may not be there.
fn made_of_part<T>(
    read: Result<T, MeshFileError>,
    (file, part): (&Option<At<Text>>, Option<&At<Text>>),
    owner: String,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<T> {
    match (read, part) {
        (
            Err(MeshFileError {
                fault: MeshFileFault::NoPart { name, known },
                ..
            }),
            Some(part),
        ) => {
            let file = file.as_ref().map(|file| file.value.0.clone());
            let kind = FaultKind::NoPart {
                file: file.unwrap_or_default(),
                nearest: nearest(&name, known.iter().map(String::as_str)),
                name,
                known,
            };
            faults.push(&part.span, kind);
            None
        }
        (read, _) => made(read, owner, span, faults),
    }
}

fn made<T>(
    result: Result<T, impl std::error::Error>,
    owner: String,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<T> {
    result
        .map_err(|error| {
            faults.push(
                span,
                ModelFault::Mesh {
                    owner,
                    cause: error.to_string(),
                },
            )
        })
        .ok()
}

fn path(raw: &Option<At<Text>>, base: &Path) -> Option<PathBuf> {
    Some(base.join(&raw.as_ref()?.value.0))
}

/// A mesh written in the deck.
fn inline_mesh(
    raw: &raw::InlineMesh,
    owner: String,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<Mesh> {
    let positions = raw.positions.as_ref()?.value.iter();
    let positions: Vec<Vec3> = positions.map(|at| vector(&at.value)).collect();
    let mut cells: Vec<(CellKind, Vec<NodeId>)> = Vec::new();
    for (index, cell) in raw.cells.as_ref()?.value.iter().enumerate() {
        let nodes = positions.len();
        if let Some(node) = cell.value.0.iter().find(|node| node.0 >= nodes) {
            let node = node.0;
            let cause = format!(
                "element {index} refers to node {node}, but the mesh has {nodes} nodes, counted from 0"
            );
            faults.push(&cell.span, ModelFault::Mesh { owner, cause });
            return None;
        }
        let corners = cell.value.0.iter().map(|node| NodeId::new(node.0));
        let corners: Vec<NodeId> = corners.collect();
        let mut kinds = CellKind::ALL.into_iter();
        match kinds.find(|kind| kind.corner_count() == corners.len()) {
            Some(kind) => cells.push((kind, corners)),
            None => {
                let cause = format!("no kind of element has corners: {}", corners.len());
                faults.push(&cell.span, ModelFault::Mesh { owner, cause });
                return None;
            }
        }
    }
    let blocks = CellBlock::runs(cells.iter().map(|(kind, corners)| (*kind, &corners[..])));
    let mesh = Mesh::new(positions, blocks).and_then(|mesh| mesh.check_shape().map(|()| mesh));
    made(mesh, owner, span, faults)
}

fn inline_surface(
    raw: &raw::InlineSurface,
    name: &str,
    faults: &mut FaultList<'_>,
) -> Option<(Vec<Vec3>, Vec<[NodeId; 4]>)> {
    let positions: Vec<Vec3> = raw
        .positions
        .as_ref()?
        .value
        .iter()
        .map(|position| vector(&position.value))
        .collect();
    let mut facets = Vec::new();
    for (facet, corners) in raw.facets.as_ref()?.value.iter().enumerate() {
        match corners.value.iter().find(|node| node.0 >= positions.len()) {
            Some(node) => faults.push(
                &corners.span,
                FaultKind::MissingNode {
                    surface: name.into(),
                    facet,
                    node: node.0,
                    nodes: positions.len(),
                },
            ),
            None => facets.push(corners.value.map(|node| NodeId::new(node.0))),
        }
    }
    (facets.len() == raw.facets.as_ref()?.value.len()).then_some((positions, facets))
}
