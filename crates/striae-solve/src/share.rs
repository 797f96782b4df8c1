//! Share of a problem that a rank holds.
//!
//! The volume is divided by a [`Division`]: a rank has its own elements and their nodes. Data that
//! grow with the surface only are *replicated*, all ranks hold them: the nodes of contact surfaces
//! and tied surfaces, nodes around the ends of fibres, nodes tied to rigid bodies and mass points.
//! Nodes, elements and unknowns have local numbers in the order of those of the whole problem, so
//! that sums over replicated data agree to the last bit on all ranks.
//! [`Problem::shared`](crate::problem::Problem::shared) makes the problem of a share.
//!
//! Every node has one *owner*, a rank that has an element of it: the one with most of them, and
//! among equals the one that owns the fewest nodes so far. Mass points, the coordinates of rigid
//! bodies and nodes without an element are owned by rank 0. Traction unknowns are owned with the
//! node that carries them.
//!
//! # What is of a share, what of the whole
//!
//! | of a problem | on a share |
//! | --- | --- |
//! | `model`: meshes, sets, sections, displacements, releases, loads, faces of pairs and ties | what is local of it; empty where nothing is |
//! | `model`: all else, such as materials, rigid surfaces, frictions, settings | the whole |
//! | `first_node`, `reference`, `elements`, `masses`, `massless`, `tie_of`, `plans` | local nodes and elements |
//! | `compositions` | local elements, but stiffest shear modulus and used sections of the whole body |
//! | `pairs` | all facets and surface nodes, with local mesh nodes; `faces` is `None` where another rank has the element |
//! | `tied`, `mass_points`, `ties`, `shadowed` | all of them, in local nodes |
//! | `skin` | all of it, in nodes of the whole |
//! | [`Whole`] | counts, extent, fits of pairs |
//!
//! # What is partial
//!
//! Sums over elements, over faces with loads, or over all nodes are partial on a share and are
//! reduced where they are formed, so all functions that need such sums are collective:
//!
//! | where | what | how |
//! | --- | --- | --- |
//! | `assembly` | residuals, internal, inertia and applied forces at nodes of several ranks, as elements and loads leave them | sum |
//! | `assembly` | rows of the tangent that all ranks know: what is held, stabilisation, mass points, turning arms, contact that ties or moving bodies change | owner |
//! | `assembly/blocks` | rows of all other contact in the tangent | the rank that a place falls to, as owners may be anywhere |
//! | `assembly/elements` | strain energy, dissipation, squares of forces; the first inverted element | sum; any |
//! | `layout` | what the pattern of contact grows by | union |
//! | `assembly/measure` | squares of residuals and of applied forces, over owned nodes; squares of round-off; largest distance from the origin | sum; largest |
//! | `assembly/context/dashpots` | magnitudes of loads, masses | sum |
//! | `mass` | `M v`, kinetic energy, momentum | sum, mass points once |
//! | `newton/energy` | work over all nodes | sum over owned nodes |
//! | `newton/departure` | mean of what is prescribed on a body | sum over owned nodes |
//! | `newton/flight` | the node that flies furthest, the longest way that is prescribed | largest |
//! | `freedom` | rows of prescribed nodes, middles and sizes of bodies | sum over owned nodes; largest |
//! | `report` | reactions of node sets; middles of mass and velocities of bodies; which sets are held | sum over owned nodes; sum; any |
//! | `section` | forces, moments, areas and centres of cuts | sum |
//! | `audit/motion` | mean ways of bodies and loads on them; the longest way that is prescribed | sum over owned nodes; largest |
//! | `support` | loads on bodies, what holds them, their middles and sizes | sum over owned nodes; largest |
//! | `skin` | places of the nodes of all skins | sum over owned nodes |
//! | `warning` | energy that is round-off, largest rotation | sum; largest |
//!
//! Once elements and loads are summed at nodes, all ranks that hold a node have identical bits of
//! its residual. Everything that follows from there, contact, ties, rigid bodies, mass points and
//! terms carried over in time, is added by each of them, again with identical bits; no part of the
//! residual is left out.
//!
//! Resultants of pairs, reports of ties, interference, passages, roles and status of contact nodes,
//! offsets and poses follow from replicated data alone and need no communication.

mod contact;
mod division;
mod exchange;
mod reduced;

use std::sync::Arc;

use striae_contact::initial::Fit;
use striae_mesh::{ElementId, NodeId, Vec3};

use crate::team::{Alone, Team};
use striae_model::node::GlobalNode;

pub(crate) use contact::shared_out;
pub use division::Division;

/// Share of a problem that a rank holds.
#[derive(Clone, Debug)]
pub struct Share {
    team: Arc<dyn Team>,
    /// `None` where it is the whole.
    holding: Option<Arc<Holding>>,
}

/// A part of a problem, and which of the whole it is.
#[derive(Clone, Debug)]
pub struct Holding {
    /// Rank that owns each local node.
    pub owners: Vec<u32>,
    /// Place of each local node among all nodes that its owner owns, which are in their order.
    pub places: Vec<u32>,
    /// Number of nodes that each rank owns.
    pub owned: Vec<usize>,
    /// Number of each local node in the whole problem, ascending.
    pub nodes: Vec<usize>,
    /// Local nodes that all ranks hold, ascending.
    pub replicated: Vec<GlobalNode>,
    /// Other local nodes that each other rank holds as well, ascending; so both ranks have
    /// them in the same order.
    pub common: Vec<Vec<GlobalNode>>,
    /// Number in the whole mesh of each local element of each body, ascending.
    pub elements: Vec<Vec<ElementId>>,
    /// Number in the whole mesh of each local node of each body, ascending.
    pub mesh_nodes: Vec<Vec<NodeId>>,
    /// Data of the whole problem.
    pub whole: Whole,
}

/// Data of the whole problem that a share keeps.
#[derive(Clone, Debug)]
pub struct Whole {
    /// Number of nodes, including mass points.
    pub nodes: usize,
    /// Number of nodes of each body.
    pub mesh_nodes: Vec<usize>,
    /// Number of elements of each body.
    pub elements: Vec<usize>,
    /// Ends of the box around all nodes at rest.
    pub extent: [Vec3; 2],
    /// Initial fit of the pairs.
    pub fits: Vec<Option<Fit>>,
    /// `true` for pairs whose sides may ever meet.
    pub may_meet: Vec<bool>,
}

impl Share {
    /// The whole, on a rank that is alone.
    pub fn alone() -> Self {
        Self {
            team: Arc::new(Alone),
            holding: None,
        }
    }

    /// A part.
    pub fn new(team: Arc<dyn Team>, holding: Holding) -> Self {
        Self {
            team,
            holding: Some(Arc::new(holding)),
        }
    }

    /// All ranks.
    pub fn team(&self) -> &dyn Team {
        &*self.team
    }

    /// Description of the share; `None` if it is the whole problem.
    pub fn holding(&self) -> Option<&Holding> {
        self.holding.as_deref()
    }

    /// Rank that owns a node.
    pub fn owner(&self, node: GlobalNode) -> usize {
        let holding = self.holding.as_ref();
        holding.map_or(0, |holding| holding.owners[node] as usize)
    }

    /// Returns whether there is no other rank.
    pub fn is_alone(&self) -> bool {
        self.team.size() == 1
    }

    /// Returns whether this rank owns a node.
    pub fn owns(&self, node: GlobalNode) -> bool {
        let holding = self.holding.as_ref();
        holding.is_none_or(|holding| holding.owners[node] as usize == self.team.rank())
    }

    /// Returns whether this rank owns the unknowns that belong to no node: the coordinates of rigid
    /// bodies.
    pub fn owns_bodies(&self) -> bool {
        self.team.rank() == 0
    }

    /// Number of a node in the whole problem.
    pub fn whole_node(&self, node: GlobalNode) -> GlobalNode {
        let holding = self.holding.as_ref();
        holding.map_or(node, |holding| GlobalNode(holding.nodes[node]))
    }

    /// Number of a node of a body in its whole mesh.
    pub fn whole_mesh_node(&self, body: usize, node: NodeId) -> NodeId {
        let holding = self.holding.as_ref();
        let nodes = holding.and_then(|holding| holding.mesh_nodes.get(body));
        // Mass points are those of no body.
        nodes.map_or(node, |nodes| nodes[node.index()])
    }

    /// Number of an element of a body in its whole mesh.
    pub fn whole_element(&self, body: usize, element: ElementId) -> ElementId {
        let holding = self.holding.as_ref();
        holding.map_or(element, |holding| holding.elements[body][element.index()])
    }

    /// Number of nodes of the whole problem, of which this rank holds `local` ones.
    pub(crate) fn whole_node_count(&self, local: usize) -> usize {
        self.holding().map_or(local, |holding| holding.whole.nodes)
    }

    /// Local number of a node of the whole problem, where it is held.
    pub(crate) fn local_node(&self, node: GlobalNode) -> Option<GlobalNode> {
        match &self.holding {
            None => Some(node),
            Some(holding) => {
                let place = holding.nodes.binary_search(&node.0).ok();
                place.map(GlobalNode)
            }
        }
    }

    /// Local number of a node of the whole mesh of a body, where it is held.
    pub fn local_mesh_node(&self, body: usize, node: NodeId) -> Option<NodeId> {
        match &self.holding {
            None => Some(node),
            Some(holding) => {
                let place = holding.mesh_nodes[body].binary_search(&node).ok();
                place.map(NodeId::new)
            }
        }
    }

    /// Local number of an element of the whole mesh of a body, where it is held.
    pub fn local_element(&self, body: usize, element: ElementId) -> Option<ElementId> {
        match &self.holding {
            None => Some(element),
            Some(holding) => {
                let place = holding.elements[body].binary_search(&element).ok();
                place.map(ElementId::new)
            }
        }
    }
}
