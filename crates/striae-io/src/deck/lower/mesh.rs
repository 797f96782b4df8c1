//! Meshes of bodies and rigid surfaces, generated, read or written in the deck.

use super::generator;
use crate::deck::{fault::FaultKind, faults::FaultList, raw, read::At, value::vector};
use std::path::Path;
use striae_mesh::{Mesh, NodeId, Vec3};

/// Elements of a mesh beyond which no machine could solve for it.
const MOST_ELEMENTS: u128 = 20_000_000;

/// How many inverted elements a fault names.
const NAMED: usize = 5;

/// The mesh of a body, checked; `None` after its faults have been noted.
pub(super) fn body_mesh(
    raw: &At<raw::Mesh>,
    body: &str,
    base: &Path,
    faults: &mut FaultList<'_>,
) -> Option<Mesh> {
    let owner = || format!("body `{body}`");
    let result = match &raw.value {
        raw::Mesh::File(file) => from_file(file, base)?,
        raw::Mesh::Generated(raw) => generated(raw, &owner, faults)?,
    };
    let checked = result.and_then(|mesh| {
        mesh.check()
            .map(|()| mesh)
            .map_err(|error| error.to_string())
    });
    let mesh = checked
        .map_err(|cause| {
            faults.push(
                &raw.span,
                FaultKind::Mesh {
                    owner: owner(),
                    cause,
                },
            )
        })
        .ok()?;
    let inverted = mesh.quality().inverted;
    if inverted.is_empty() {
        return Some(mesh);
    }
    let count = inverted.len();
    let elements = inverted.into_iter().take(NAMED).collect();
    faults.push(
        &raw.span,
        FaultKind::Inverted {
            body: body.into(),
            elements,
            count,
        },
    );
    None
}

/// A generated mesh, unless a parameter could not be read or it would be too large.
fn generated(
    raw: &raw::Generator,
    owner: &dyn Fn() -> String,
    faults: &mut FaultList<'_>,
) -> Option<Result<Mesh, String>> {
    let generator = generator::Generator::new(raw, faults)?;
    let (span, elements) = generator.elements(raw)?;
    if elements > MOST_ELEMENTS {
        faults.push(
            &span,
            FaultKind::TooLarge {
                owner: owner(),
                elements,
                most: MOST_ELEMENTS,
            },
        );
        return None;
    }
    Some(generator.mesh().map_err(|error| error.to_string()))
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
            let result = surface_from_file(file, base)?;
            let owner = format!("rigid surface `{name}`");
            result
                .map_err(|cause| faults.push(&raw.span, FaultKind::Mesh { owner, cause }))
                .ok()
        }
        raw::SurfaceMesh::Inline(surface) => inline_surface(surface, name, faults),
    }
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

fn from_file(raw: &raw::MeshFile, base: &Path) -> Option<Result<Mesh, String>> {
    let path = base.join(&raw.file.as_ref()?.value.0);
    Some(Err(format!(
        "{}: reading meshes from files is not possible yet",
        path.display()
    )))
}

fn surface_from_file(
    raw: &raw::MeshFile,
    base: &Path,
) -> Option<Result<(Vec<Vec3>, Vec<[NodeId; 4]>), String>> {
    let path = base.join(&raw.file.as_ref()?.value.0);
    Some(Err(format!(
        "{}: reading meshes from files is not possible yet",
        path.display()
    )))
}
