//! Painting of the textures of a pair on its sides, and why it may fail.

use striae_contact::{pair::Geometry, texture::SideTexture};
use striae_mesh::{NodeId, Vec3};
use striae_surface::{
    node::SurfaceNode,
    normal::nodal_normals,
    texture::{Conditioning, Field, Paint, Texture, TextureError},
    topology::Surface,
};

use super::PairError;
use crate::model::{ContactSurface, Model, Pair};

/// Reason why a texture has no direction at a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undirected {
    /// The axis of the field passes through the node.
    OnAxis,
    /// The direction is along the normal of the surface.
    AlongNormal,
    /// The direction that is stated at the node is zero or not a number.
    Zero,
    /// Directions that are stated around the node cancel there.
    Cancelled,
}

impl Undirected {
    /// Reason why a field has no direction at a point.
    pub fn of(field: &Field, x: &Vec3) -> Self {
        match field.lines.pole() {
            Some(axis) => {
                let arm = x - axis.point;
                let along = axis.direction.normalize();
                let off = (arm - along * along.dot(&arm)).norm();
                match off <= 1e-6 * arm.norm().max(f64::MIN_POSITIVE) || arm.norm() == 0.0 {
                    true => Self::OnAxis,
                    false => Self::AlongNormal,
                }
            }
            None => Self::AlongNormal,
        }
    }

    /// Reason why a paint has no direction at a node of a surface with nodes at `positions`.
    fn of_paint(paint: &Paint, node: SurfaceNode, positions: &[Vec3]) -> Self {
        let x = positions[node.index()];
        let is_nearest = |place: &Vec3| {
            let distance = (x - place).norm();
            positions
                .iter()
                .all(|other| distance <= (other - place).norm())
        };
        let stated = match paint {
            Paint::Field(field) => return Self::of(field, &x),
            Paint::Nodal(directions) => directions.get(node.index()),
            Paint::Nodes { directions, .. } => {
                let mut stated = directions.iter();
                stated
                    .find(|(at, _)| *at == node)
                    .map(|(_, direction)| direction)
            }
            Paint::Points { directions, .. } => {
                let mut stated = directions.iter();
                let stated = stated.find(|(place, _)| is_nearest(place));
                stated.map(|(_, direction)| direction)
            }
        };
        match stated {
            Some(direction) if direction.norm() > 0.0 => Self::AlongNormal,
            Some(_) => Self::Zero,
            None => Self::Cancelled,
        }
    }

    /// Cause and remedy, as the end of a sentence.
    pub fn words(self) -> &'static str {
        match self {
            Self::OnAxis => {
                "its axis passes through that node, where circles and rays have no direction; move the axis or the mesh so that no node lies on it, or leave the facets around the node out of the pair"
            }
            Self::AlongNormal => {
                "it is normal to the surface there; choose a direction with a tangential part"
            }
            Self::Zero => {
                "the direction stated there is zero or not a number; state one with a length"
            }
            Self::Cancelled => {
                "the directions stated around it cancel there; state one nearer to it, or reverse one of them"
            }
        }
    }
}

/// Paint that is stated at nodes of the mesh, in their order, at those of a surface: on an edge
/// between faces each of them has it.
fn on_faces(surface: &Surface, paint: &Paint) -> Paint {
    let mut stated = surface.nodes().to_vec();
    stated.dedup();
    if stated.len() == surface.nodes().len() {
        return paint.clone();
    }
    let place = |node: &NodeId| stated.partition_point(|other| other < node);
    match paint {
        Paint::Nodal(directions) if directions.len() == stated.len() => {
            let nodes = surface.nodes().iter();
            Paint::Nodal(nodes.map(|node| directions[place(node)]).collect())
        }
        Paint::Nodes { directions, width } => {
            let on_node = |&(at, direction): &(SurfaceNode, Vec3)| {
                let nodes = SurfaceNode::all(surface.nodes().len());
                let is_it = move |node: &SurfaceNode| place(&surface.nodes()[*node]) == at.index();
                nodes.filter(is_it).map(move |node| (node, direction))
            };
            Paint::Nodes {
                directions: directions.iter().flat_map(on_node).collect(),
                width: *width,
            }
        }
        Paint::Field(_) | Paint::Points { .. } | Paint::Nodal(_) => paint.clone(),
    }
}

/// The texture of a side with nodes at `positions`.
pub(super) fn painted(
    model: &Model,
    pair: &Pair,
    index: usize,
    geometry: &Geometry,
    positions: &[Vec3],
    paint: &Paint,
) -> Result<(SideTexture, Option<Conditioning>), PairError> {
    let surface = match (geometry, paint) {
        (Geometry::Plane { .. }, Paint::Field(field)) => {
            return Ok((SideTexture::Plane(field.clone()), None));
        }
        (Geometry::Plane { .. }, _) => {
            return Err(PairError::PlaneTexture {
                pair: pair.name.clone(),
            });
        }
        (Geometry::Deformable(surface) | Geometry::Rigid(surface), _) => surface,
        (Geometry::Itself, _) => {
            return Err(PairError::TextureOfItself {
                pair: pair.name.clone(),
            });
        }
    };
    let normals = nodal_normals(surface, positions);
    let paint = &on_faces(surface, paint);
    let painted = Texture::new(positions, surface.facets(), &normals, paint);
    let (texture, conditioning) = painted.map_err(|error| {
        let node = error.node();
        let of_mesh = node.and_then(|node| surface.nodes().get(node.index()).copied());
        let (pair_name, side) = (pair.name.clone(), index);
        let owner = match [&pair.a, &pair.b][index] {
            ContactSurface::Deformable { body, .. } => {
                format!("body `{}`", model.bodies[body.0].name)
            }
            ContactSurface::Rigid(rigid) => {
                format!("rigid surface `{}`", model.rigid_surfaces[rigid.0].name)
            }
            ContactSurface::Itself => "side `a` itself".to_owned(),
        };
        match (&error, node, of_mesh) {
            (TextureError::Vanishing { .. }, Some(node), Some(of_mesh)) => PairError::Undirected {
                pair: pair_name,
                side,
                surface: owner,
                node: of_mesh.to_string(),
                at: Box::new(positions[node.index()]),
                cause: Undirected::of_paint(paint, node, positions),
            },
            _ => PairError::Texture {
                pair: pair_name,
                side,
                surface: owner,
                node: of_mesh,
                error,
            },
        }
    })?;
    Ok((SideTexture::Nodal(texture), Some(conditioning)))
}
