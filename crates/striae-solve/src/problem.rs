//! A validated model, ready to be solved: everything that is the same in all increments.
//!
//! Of a model that ranks share, each has a problem of its own, see [`crate::share`].
//!
//! Longer than other files, as it lists all that follows from a model, and why none can.

mod contact_facet;
mod frame;
mod nodes;
mod shadow;
mod shared_nodes;

pub use contact_facet::ContactFacet;
pub(crate) use frame::Frame;
pub(crate) use nodes::extent;
pub(crate) use shared_nodes::PairNode;

use std::collections::HashMap;
use striae_element::{ElementFault, Elements};
use striae_mesh::{Face, NodeId, Vec3};

use crate::{
    body_mass::{BodyMass, masses},
    composition::Composition,
    share::Share,
    skin::Skin,
    spring::Link,
};
use contact_facet::contact_facets;
use shared_nodes::{refuse_twice_collocated, shared_nodes};
use striae_model::{
    Model,
    cavity::CavitySurface,
    node::GlobalNode,
    pair_geometry::{PairError, PairGeometry},
    plan::{StepPlan, plans},
    tie::{TieFault, Ties, first_nodes},
};

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
    /// A pair is none.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// A tie is none.
    #[error("{0}")]
    Tie(TieFault),
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
            cavities: striae_model::cavity::surfaces(&model, &first_node, at),
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
