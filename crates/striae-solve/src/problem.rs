//! A validated model, ready to be solved: everything that is the same in all increments.
//!
//! Of a model that ranks share, each has a problem of its own, see [`crate::share`].
//!
//! Longer than other files, as it lists all that follows from a model, and why none can.

mod contact_facet;
mod deformable;
mod fibres;
mod frame;
mod nodes;
mod painted;
mod shadow;
mod shared_nodes;

pub use contact_facet::ContactFacet;
pub(crate) use fibres::{add_fibres, thickness_with};
pub(crate) use frame::Frame;
pub(crate) use nodes::extent;
pub use painted::Undirected;
pub(crate) use shared_nodes::PairNode;

use std::collections::HashMap;
use striae_contact::{
    interference::Fibre,
    pair::{ContactPair, Geometry, PairedSurface},
    pair_state::PairState,
    side::Side,
};
use striae_element::{ElementFault, Elements};
use striae_mesh::{Face, NodeId, Vec3, place};
use striae_surface::{
    texture::{Conditioning, TextureError},
    topology::Surface,
};

use crate::{
    body_mass::{BodyMass, masses},
    cavity::CavitySurface,
    composition::Composition,
    model::{ContactSurface, Model, Pair, RigidShape},
    node::GlobalNode,
    plan::{StepPlan, plans},
    share::Share,
    skin::Skin,
    spring::Link,
    tie::{TieFault, Ties, first_nodes},
};
use contact_facet::contact_facets;
use deformable::deformable;
use painted::painted;
use shared_nodes::{refuse_twice_collocated, shared_nodes};

/// A model with what follows from it.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The model.
    pub model: Model,
    /// First global node of every body; the last entry is the number of their nodes.
    pub first_node: Vec<usize>,
    /// Reference position of every global node.
    pub reference: Vec<Vec3>,
    /// Reference elements of every body.
    pub elements: Vec<Elements>,
    /// Materials of the elements of every body.
    pub compositions: Vec<Composition>,
    /// Contact pairs.
    pub pairs: Vec<PairGeometry>,
    /// Conditions in force in each step.
    pub plans: Vec<StepPlan>,
    /// Nodes tied to every rigid body, with its mass points and points where springs hold it.
    pub tied: Vec<Vec<GlobalNode>>,
    /// Rigid body that each global node is tied to.
    pub tie_of: Vec<Option<usize>>,
    /// Point masses: global nodes that belong to no body, after those that do.
    pub mass_points: Vec<(GlobalNode, f64)>,
    /// Links of all springs.
    pub links: Vec<Link>,
    /// Surfaces of all cavities.
    pub cavities: Vec<CavitySurface>,
    /// Global nodes whose mass is moved to others.
    pub massless: Vec<bool>,
    /// Mass of every body.
    pub masses: Vec<BodyMass>,
    /// Nodes that follow others in ties.
    pub ties: Ties,
    /// Nodes of pairs, by pair and side, that follow nodes which touch the same opponent.
    pub shadowed: Vec<[Vec<bool>; 2]>,
    /// Contact facets that each face of each body is.
    pub contact_facets: HashMap<(usize, Face), Vec<ContactFacet>>,
    /// Nodes of pairs that are one place of a surface, place by place.
    pub(crate) shared_nodes: Vec<Vec<PairNode>>,
    /// The skins of all bodies of the whole.
    pub(crate) skin: Skin,
    /// Share of the whole problem.
    pub share: Share,
}

/// A contact pair with its place in the problem.
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
    /// Fibres through what is behind the facets, see [`crate::interference`].
    pub fibres: [Vec<Option<Fibre>>; 2],
}

impl PairGeometry {
    /// Areas that belong to the nodes of a side, `integral N_J da` over what is opposite.
    pub(crate) fn areas(&self, side: Side, state: &PairState) -> Vec<f64> {
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

/// A model that cannot be solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProblemError {
    /// An element of the mesh is degenerate.
    #[error("body `{body}`, {fault}")]
    Element {
        /// Name of the body.
        body: String,
        /// Fault of the element.
        fault: ElementFault,
    },
    /// A tie is none.
    #[error("{0}")]
    Tie(TieFault),
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
    /// Two pairs, one of them collocated, that hold a node against the same surface.
    #[error(
        "pairs `{first}` and `{second}` share {node} of `{body}` and press it on the same surface, but the nodes of a collocated pair belong to it alone: make one pair of both, or use weighted contact for both"
    )]
    SharedCollocated {
        /// Name of a pair.
        first: String,
        /// Name of the other one.
        second: String,
        /// Body with the node.
        body: String,
        /// The node.
        node: NodeId,
    },
    /// Springs in a model that ranks share.
    #[error(
        "spring `{spring}`: springs cannot be divided among several processes; run the model in one process, or remove its springs"
    )]
    SharedSpring {
        /// Name of the first one.
        spring: String,
    },
    /// Cavities in a model that ranks share.
    #[error(
        "cavity `{cavity}`: cavities cannot be divided among several processes; run the model in one process, or load its faces with a `pressure`"
    )]
    SharedCavity {
        /// Name of the first one.
        cavity: String,
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

impl Problem {
    /// Prepares a model.
    ///
    /// # Errors
    /// When the mesh has degenerate elements or a pair no deformable first side.
    pub fn new(model: Model) -> Result<Self, ProblemError> {
        Self::on(Frame::new(model)?)
    }

    /// Adds the elements to what is known before them.
    ///
    /// # Errors
    /// When the mesh has degenerate elements.
    pub(crate) fn on(frame: Frame) -> Result<Self, ProblemError> {
        let Frame {
            model,
            placed,
            ties,
            pairs,
            mut massless,
            shadowed,
            materials,
            skin,
            share,
        } = frame;
        let (given, model) = match placed {
            Some(placed) => (Some(model), placed),
            None => (None, model),
        };
        let first_node = first_nodes(&model);
        let mut reference = Vec::new();
        let mut elements = Vec::new();
        let mut compositions = Vec::new();
        for (body, materials) in model.bodies.iter().zip(materials) {
            reference.extend_from_slice(&body.mesh.positions);
            let of_body = body.elements().map_err(|fault| ProblemError::Element {
                body: body.name.clone(),
                fault,
            })?;
            compositions.push(Composition::new(body, &of_body, materials));
            elements.push(of_body);
        }
        let (mut tied, mass_points) = crate::rigid::ties(&model, &first_node, &mut reference);
        let links = crate::spring::links(&model, &first_node, (&mut reference, &mut tied));
        massless.resize(reference.len(), false);
        let tie_of = tie_of(&tied, reference.len());
        let shared_nodes = shared_nodes(&pairs, &first_node, &reference);
        refuse_twice_collocated(&shared_nodes, &pairs, &model)?;
        let plans = plans(&model);
        let at = (&reference[..], &plans[..]);
        Ok(Self {
            cavities: crate::cavity::surfaces(&model, &first_node, at),
            contact_facets: contact_facets(&pairs),
            shared_nodes,
            masses: masses(&model, &elements, &compositions, (&first_node, &massless)),
            massless,
            plans,
            tied,
            shadowed,
            ties,
            tie_of,
            mass_points,
            links,
            pairs,
            first_node,
            reference,
            elements,
            compositions,
            model: given.unwrap_or(model),
            skin,
            share,
        })
    }

    /// Returns whether the coordinates of a rigid body are unknowns: if nodes are tied to it, or if
    /// contact may move it because some are free in a step.
    pub(crate) fn has_coordinates(&self, rigid: usize) -> bool {
        let free = |plan: &StepPlan| plan.rigid[rigid].iter().any(Option::is_none);
        !self.tied[rigid].is_empty() || self.plans.iter().any(free)
    }

    /// Volume of a cavity with the nodes at `positions`; zero where a face has collapsed.
    pub fn cavity_volume(&self, cavity: usize, positions: &[Vec3]) -> f64 {
        let volume = self.cavities[cavity].volume(&self.reference, positions);
        volume.unwrap_or(0.0)
    }

    /// Returns whether a rigid body has inertia of its own or of nodes tied to it.
    pub(crate) fn has_mass(&self, rigid: usize) -> bool {
        let of_bodies = self.first_node[self.model.bodies.len()];
        let mut tied = self.tied[rigid].iter();
        self.model.rigid_surfaces[rigid].inertia.is_some() || tied.any(|node| node.0 < of_bodies)
    }
}

/// Rigid body that each of so many nodes is tied to.
fn tie_of(tied: &[Vec<GlobalNode>], nodes: usize) -> Vec<Option<usize>> {
    let mut tie_of = vec![None; nodes];
    for (rigid, nodes) in tied.iter().enumerate() {
        nodes.iter().for_each(|&node| tie_of[node] = Some(rigid));
    }
    tie_of
}

/// A pair in the reference configuration, without fibres.
pub(crate) fn pair_geometry(model: &Model, pair: &Pair) -> Result<PairGeometry, ProblemError> {
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
        return Err(ProblemError::RigidSide {
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
) -> Result<(Geometry, Vec<Vec3>), ProblemError> {
    match &model.rigid_surfaces[surface].shape {
        RigidShape::Plane { point, normal } => {
            let plane = Geometry::Plane {
                point: *point,
                normal: normal.normalize(),
            };
            Ok((plane, Vec::new()))
        }
        RigidShape::Bare => Err(ProblemError::BareSide {
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
