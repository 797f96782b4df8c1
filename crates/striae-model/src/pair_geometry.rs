//! Pairs of a model in the reference configuration: surfaces, textures, what is behind the facets.

mod deformable;
mod fibres;
mod painted;

pub use fibres::{add_fibres, thickness_with};
pub use painted::Undirected;

use striae_contact::{
    interference::Fibre,
    pair::{ContactPair, Geometry, PairedSurface},
    pair_state::PairState,
    side::Side,
};
use striae_mesh::{Face, NodeId, Vec3, place};
use striae_surface::{
    texture::{Conditioning, TextureError},
    topology::Surface,
};

use crate::model::{ContactSurface, Model, Pair, RigidShape};
use deformable::deformable;
use painted::painted;

/// A contact pair with its place in the model.
#[derive(Clone, Debug)]
pub struct PairGeometry {
    /// The pair.
    pub contact: ContactPair,
    /// Body of each side, `None` for a rigid one.
    pub bodies: [Option<usize>; 2],
    /// Reference positions of a rigid side `b`.
    pub rigid_reference: Vec<Vec3>,
    /// Rigid surface that is side `b`.
    pub rigid: Option<usize>,
    /// Faces of each deformable side, in the order of the facets; `None` where another rank has
    /// the element.
    pub faces: [Vec<Option<Face>>; 2],
    /// Conditioning of the painting of each textured surface.
    pub conditionings: [Option<Conditioning>; 2],
    /// Fibres through what is behind the facets, see [`striae_contact::interference`].
    pub fibres: [Vec<Option<Fibre>>; 2],
}

impl PairGeometry {
    /// Areas that belong to the nodes of a side, `integral N_J da` over what is opposite.
    pub fn areas(&self, side: Side, state: &PairState) -> Vec<f64> {
        let Some(surface) = self.contact.sides[side].surface() else {
            return Vec::new();
        };
        let mut areas = vec![0.0; surface.nodes().len()];
        for (facet, of_facet) in &state.facets[side] {
            let corners = surface.facets()[facet.index()];
            for (corner, area) in corners.into_iter().zip(of_facet.area) {
                areas[corner] += area;
            }
        }
        areas
    }
}

/// A pair that cannot be in contact.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PairError {
    /// A side cannot be textured.
    #[error("pair `{pair}`, texture of {surface}{}: {error}", at_node(*node))]
    Texture {
        /// Name of the pair.
        pair: String,
        /// Side of the texture.
        side: usize,
        /// Name of the body or rigid surface.
        surface: String,
        /// Node of its mesh.
        node: Option<NodeId>,
        /// Error of the texture.
        error: TextureError,
    },
    /// A texture on the second side of self-contact.
    #[error("pair `{pair}`: a surface that touches itself has one texture, that of side `a`")]
    TextureOfItself {
        /// Name of the pair.
        pair: String,
    },
    /// A field has no tangential direction at a node.
    #[error(
        "pair `{pair}`: the texture of {surface} has no direction at {node}, {}: {}",
        place(at), cause.words()
    )]
    Undirected {
        /// Name of the pair.
        pair: String,
        /// Side of the texture.
        side: usize,
        /// Name of the body or rigid surface that is painted.
        surface: String,
        /// The node.
        node: String,
        /// Position; boxed, as errors should be small.
        at: Box<Vec3>,
        /// Reason.
        cause: Undirected,
    },
    /// A rigid plane has no nodes to paint.
    #[error("pair `{pair}`: a rigid plane takes a uniform, circumferential or radial texture")]
    PlaneTexture {
        /// Name of the pair.
        pair: String,
    },
    /// A rigid body without a surface is a side of a pair.
    #[error("pair `{pair}`: rigid body `{rigid}` has no surface")]
    BareSide {
        /// Name of the pair.
        pair: String,
        /// The rigid body.
        rigid: String,
    },
    /// A pair has a rigid first side or two rigid sides.
    #[error("pair `{pair}`: side `a` must be deformable")]
    RigidSide {
        /// Name of the pair.
        pair: String,
    },
}

fn at_node(node: Option<NodeId>) -> String {
    node.map_or_else(String::new, |node| format!(", {node}"))
}

/// A pair in the reference configuration, without fibres.
pub fn pair_geometry(model: &Model, pair: &Pair) -> Result<PairGeometry, PairError> {
    let mut bodies = [None, None];
    let mut faces = [Vec::new(), Vec::new()];
    let mut rigid = None;
    let mut rigid_reference = Vec::new();
    let mut side = |index: usize, surface: &ContactSurface| match surface {
        ContactSurface::Deformable {
            body,
            faces: of_side,
        } => {
            bodies[index] = Some(body.0);
            faces[index] = of_side.iter().copied().map(Some).collect();
            Ok(deformable(model, body.0, of_side, pair.feature_angle))
        }
        ContactSurface::Itself => Ok(PairedSurface {
            geometry: Geometry::Itself,
            stiffness: f64::INFINITY,
            texture: None,
            behind: Vec::new(),
            enclosure: None,
        }),
        ContactSurface::Rigid(surface) => {
            rigid = Some(surface.0);
            let (geometry, reference) = rigid_geometry(model, pair, surface.0)?;
            rigid_reference = reference;
            Ok(PairedSurface {
                geometry,
                stiffness: f64::INFINITY,
                texture: None,
                behind: Vec::new(),
                enclosure: None,
            })
        }
    };
    let mut sides = [side(0, &pair.a)?, side(1, &pair.b)?];
    let mut conditionings = [None, None];
    for (index, paint) in pair.textures.iter().enumerate() {
        let Some(paint) = paint else { continue };
        let geometry = &sides[index].geometry;
        let positions = side_positions(model, bodies[index], geometry, &rigid_reference);
        let (texture, conditioning) = painted(model, pair, index, geometry, &positions, paint)?;
        sides[index].texture = Some(texture);
        conditionings[index] = conditioning;
    }
    if bodies[0].is_none() {
        return Err(PairError::RigidSide {
            pair: pair.name.clone(),
        });
    }
    Ok(PairGeometry {
        contact: ContactPair {
            name: pair.name.clone(),
            sides,
            enforcement: pair.enforcement,
            search_distance: pair.search_distance,
            has_faces: pair.feature_angle.is_some(),
            one_body: pair.feature_angle.is_some() && bodies[0] == bodies[1],
            wear: pair.wear,
            wear_across: pair.wear_across,
        },
        bodies,
        rigid_reference,
        rigid,
        faces,
        conditionings,
        fibres: [Vec::new(), Vec::new()],
    })
}

/// Geometry of a rigid surface, and the reference positions of its nodes.
fn rigid_geometry(
    model: &Model,
    pair: &Pair,
    surface: usize,
) -> Result<(Geometry, Vec<Vec3>), PairError> {
    match &model.rigid_surfaces[surface].shape {
        RigidShape::Plane { point, normal } => {
            let plane = Geometry::Plane {
                point: *point,
                normal: normal.normalize(),
            };
            Ok((plane, Vec::new()))
        }
        RigidShape::Bare => Err(PairError::BareSide {
            pair: pair.name.clone(),
            rigid: model.rigid_surfaces[surface].name.clone(),
        }),
        RigidShape::Facets { positions, facets } => {
            let surface = Surface::new(facets);
            let nodes = surface.nodes().iter();
            let reference = nodes.map(|n| positions[n.index()]).collect();
            Ok((Geometry::Rigid(surface), reference))
        }
    }
}

/// Reference positions of the surface nodes of a side; none for a plane.
fn side_positions(
    model: &Model,
    body: Option<usize>,
    geometry: &Geometry,
    rigid_reference: &[Vec3],
) -> Vec<Vec3> {
    match (geometry, body) {
        (Geometry::Deformable(surface), Some(body)) => {
            let mesh = &model.bodies[body].mesh;
            surface
                .nodes()
                .iter()
                .map(|node| mesh.positions[node.index()])
                .collect()
        }
        (Geometry::Rigid(_), _) => rigid_reference.to_vec(),
        _ => Vec::new(),
    }
}
