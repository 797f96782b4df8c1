//! Textures given at the nodes of a surface by a file.
//!
//! The file identifies nodes by number: the numbers of the file the mesh was read from, or
//! positions from 0 where it was generated or written in the deck. The paint has one direction for
//! every node of the surface, in ascending order of their ids.

use super::{list, surfaces::Surfaces};
use crate::{fault::FaultKind, faults::FaultList, raw};
use std::path::PathBuf;
use striae_mesh::NodeId;
use striae_meshfile::{self as mesh_file, MeshFileError};
use striae_model::{ContactSurface, RigidShape};
use striae_surface::{texture::Paint, topology::Surface};

/// The paint of a side that has nodes; `None` for a plane, or after faults have
/// been noted.
pub(super) fn paint(
    raw: &raw::NodalTexture,
    side: &ContactSurface,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Paint> {
    let file = raw.nodal.as_ref()?;
    let nodes = nodes(side, surfaces)?;
    let path = surfaces.base.join(&file.value.0);
    let name = raw.name.as_ref().map(|name| name.value.0.as_str());
    let read = || -> Result<Paint, MeshFileError> {
        let vectors = mesh_file::read_node_vectors(&path, name)?;
        let numbers = match mesh_file_of(side, surfaces) {
            Some(mesh) => numbers(side, mesh)?,
            None => Vec::new(),
        };
        let number = |node: &NodeId| {
            let known = numbers.get(node.index()).copied();
            known.unwrap_or(u64::from(node.0))
        };
        let directions = vectors.of_nodes(nodes.iter().map(number));
        let directions = directions.map_err(|fault| fault.of(&path))?;
        Ok(Paint::Nodal(directions))
    };
    read()
        .map_err(|error| {
            let kind = FaultKind::NodalTexture {
                owner: owner(side, surfaces),
                cause: error.to_string(),
            };
            faults.push(&file.span, kind);
        })
        .ok()
}

/// Nodes of the surface in ascending order, none of a plane.
fn nodes(side: &ContactSurface, surfaces: &Surfaces<'_>) -> Option<Vec<NodeId>> {
    let facets: Vec<[NodeId; 4]> = match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = surfaces.bodies.mesh(*body)?;
            faces.iter().map(|face| mesh.face_nodes(*face)).collect()
        }
        ContactSurface::Rigid(rigid) => match &surfaces.rigid[rigid.0].as_ref()?.shape {
            RigidShape::Facets { facets, .. } => facets.clone(),
            RigidShape::Plane { .. } | RigidShape::Bare => return None,
        },
        ContactSurface::Itself => return None,
    };
    Some(Surface::new(&facets).nodes().to_vec())
}

/// A file of a mesh, and the part of it that the mesh is.
type MeshFile<'r> = (PathBuf, Option<&'r str>);

/// The file of the mesh, if it was read from one.
fn mesh_file_of<'r>(side: &ContactSurface, surfaces: &Surfaces<'r>) -> Option<MeshFile<'r>> {
    let written = surfaces.written;
    let (file, part) = match side {
        ContactSurface::Deformable { body, .. } => {
            let body = &list(&written.body)[body.0].value;
            match &body.mesh.as_ref()?.value {
                raw::Mesh::File(file) => (&file.file, file.elements.as_ref()),
                raw::Mesh::Generated(_) | raw::Mesh::Inline(_) => return None,
            }
        }
        ContactSurface::Rigid(rigid) => match list(&written.rigid)[rigid.0].value.shape.as_ref()? {
            raw::RigidShape::Mesh(surface) => match &surface.mesh.as_ref()?.value {
                raw::SurfaceMesh::File(file) => (&file.file, file.elements.as_ref()),
                raw::SurfaceMesh::Inline(_) => return None,
            },
            raw::RigidShape::Plane(_) | raw::RigidShape::Tied(_) => return None,
        },
        ContactSurface::Itself => return None,
    };
    let path = surfaces.base.join(&file.as_ref()?.value.0);
    Some((path, part.map(|part| part.value.0.as_str())))
}

/// Numbers of the nodes in the file of their mesh, by id.
fn numbers(side: &ContactSurface, (mesh, part): MeshFile<'_>) -> Result<Vec<u64>, MeshFileError> {
    match side {
        ContactSurface::Deformable { .. } => mesh_file::node_numbers(mesh, part),
        ContactSurface::Rigid(_) => mesh_file::rigid_node_numbers(mesh, part),
        ContactSurface::Itself => Ok(Vec::new()),
    }
}

fn owner(side: &ContactSurface, surfaces: &Surfaces<'_>) -> String {
    match side {
        ContactSurface::Deformable { body, .. } => {
            format!("body `{}`", surfaces.bodies.name(*body))
        }
        ContactSurface::Rigid(rigid) => {
            let name = surfaces.rigid[rigid.0].as_ref().map(|rigid| &rigid.name);
            format!("rigid surface `{}`", name.map_or("", String::as_str))
        }
        ContactSurface::Itself => "side `a`".to_owned(),
    }
}
