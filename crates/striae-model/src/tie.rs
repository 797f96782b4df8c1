//! Ties: surfaces of bodies that are glued from the start, by nodes that follow others.
//!
//! On one side of a tie, the one with the finer facets unless more of them would have every
//! corner prescribed in a component, nodes `s` follow those of the other side
//! with constant weights, in every component where they are not prescribed,
//!
//! ```text
//! x_s = sum_m w_sm x_m,   sum_m w_sm = 1
//! ```
//!
//! from rows `int psi_s (x_a - x_b) dA = 0` with dual functions `psi_s`, integrated once over
//! what the facets have in common in the reference configuration, see
//! [`striae_contact::tie`]. Nodes that follow are moved once, without strain, to where their
//! rows want them; so rigid motion is exact, and the force `t_s` of a tie on a node that follows
//! and `-w_sm t_s` on the others balance in force and moment. Source of that move: Puso,
//! "A 3D mortar method for solid mechanics", Int. J. Numer. Meth. Engng. 59 (2004),
//! doi:10.1002/nme.865.
//!
//! A node follows no row where it is prescribed in any step, in all components where that is not
//! along the coordinate axes, where it is tied to a rigid body, next to nothing of the facets
//! around it is covered, or it follows another tie. The functions of the
//! facets around it then go to their other nodes in equal parts, so that they still add up to
//! one. What a node follows may follow another tie in turn; rows that follow each other in
//! a circle are solved together, and are a [`TieFault`] where they say the same.

mod bound;
mod cover;
mod fault;
mod order;
mod patch;
mod renumbered;
mod rows;
mod side;
mod start;
mod surfaces;

pub use cover::covered;
pub use fault::TieFault;
pub use patch::NodalAreas;
pub use start::placed;

use std::collections::BTreeMap;
use striae_contact::side::Side;
use striae_mesh::{NodeId, Vec3};
use striae_surface::topology::Surface;

use crate::{model::Model, node::GlobalNode};
use order::Group;
use patch::Patch;
use rows::Sides;

/// Weights of nodes, by component: `None` where the node does not follow.
pub type Weights = [Option<Vec<(GlobalNode, f64)>>; 3];

/// A node that follows others.
#[derive(Clone, Debug, PartialEq)]
pub struct Follower {
    /// Its tie.
    pub tie: usize,
    /// The node.
    pub node: GlobalNode,
    /// Row of the tie: nodes, which may depend on others, and weights.
    pub row: Weights,
    /// Row in terms of independent nodes.
    pub weights: Weights,
}

/// A tie as it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Side whose nodes follow.
    pub follows: Side,
    /// Bodies of the sides.
    pub bodies: [usize; 2],
    /// Area that is tied.
    pub area: f64,
    /// Part of the facets of each side that is tied.
    pub cover: [f64; 2],
    /// Largest distance of facets that are tied.
    pub gap: f64,
    /// Size of the facets of the side that follows.
    pub facet_size: f64,
    /// Nodes of the tied surfaces, by side.
    pub nodes: [Vec<GlobalNode>; 2],
    /// Their facets in nodes of the meshes; a triangle repeats its last corner.
    facets: [Vec<[NodeId; 4]>; 2],
    /// Tied areas, by facet of the dependent side.
    patches: Vec<Patch>,
    /// Nodes of both sides that cannot move past the other one, ascending.
    glued: [Vec<GlobalNode>; 2],
}

/// All ties of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ties {
    /// Description of each tie.
    pub joints: Vec<Joint>,
    /// Nodes that follow, ascending.
    followers: Vec<Follower>,
    /// Their groups by component, none before those that it follows.
    orders: [Vec<Group>; 3],
    /// Of global nodes; empty without ties.
    of_node: Vec<Option<u32>>,
}

impl Ties {
    /// The ties of a model.
    ///
    /// # Errors
    /// All invalid ties.
    pub fn new(model: &Model) -> Result<Self, Vec<TieFault>> {
        if model.ties.is_empty() {
            return Ok(Self::default());
        }
        let first_node = &first_nodes(model);
        let (mut faults, mut sides) = (Vec::new(), Vec::new());
        for tie in 0..model.ties.len() {
            match Sides::new(model, first_node, tie) {
                Ok(found) => sides.push(found),
                Err(fault) => faults.push(fault),
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let rows = rows::rows(model, first_node, &mut sides)?;
        let (followers, orders) = order::resolved(model, rows)?;
        let nodes = first_node[model.bodies.len()];
        let mut of_node = vec![None; nodes];
        for (at, follower) in followers.iter().enumerate() {
            of_node[follower.node] = Some(at as u32);
        }
        Ok(Self {
            joints: sides.into_iter().map(Sides::joint).collect(),
            followers,
            orders,
            of_node,
        })
    }

    /// The model with the nodes that follow where their rows want them.
    ///
    /// # Errors
    /// When an element would be turned inside out.
    pub fn moved(&self, model: Model) -> Result<Model, TieFault> {
        start::moved(self, model)
    }

    /// Returns whether no node depends on others.
    pub fn is_empty(&self) -> bool {
        self.followers.is_empty()
    }

    /// Nodes that follow, ascending.
    pub fn followers(&self) -> &[Follower] {
        &self.followers
    }

    /// Dependence of a node on others, if there is any.
    pub fn follower(&self, node: GlobalNode) -> Option<&Follower> {
        let at = self.of_node.get(node.0).copied().flatten()?;
        Some(&self.followers[at as usize])
    }

    /// Nodes that a component of a node depends on, with weights, if it does.
    pub fn followed(&self, node: GlobalNode, axis: usize) -> Option<&[(GlobalNode, f64)]> {
        self.follower(node)?.weights[axis].as_deref()
    }

    /// Nodes whose positions some nodes have theirs from, ascending: themselves, or what they
    /// follow.
    pub fn behind(&self, nodes: &[GlobalNode]) -> Vec<GlobalNode> {
        let mut behind = Vec::with_capacity(nodes.len());
        for &node in nodes {
            let Some(follower) = self.follower(node) else {
                behind.push(node);
                continue;
            };
            let followed = follower.weights.iter().flatten().flatten();
            behind.extend(followed.map(|(node, _)| *node));
            if follower.weights.contains(&None) {
                behind.push(node);
            }
        }
        behind.sort_unstable();
        behind.dedup();
        behind
    }

    /// The surface of a side of a tie, in nodes of the mesh of its body.
    pub fn surface(&self, tie: usize, side: Side) -> Surface {
        Surface::new(&self.joints[tie].facets[side])
    }

    /// Returns whether a tie holds a node of a body to another body, so that it cannot move past it.
    pub fn glues(&self, node: GlobalNode, bodies: [usize; 2]) -> bool {
        self.joints.iter().any(|joint| {
            let side = match joint.bodies {
                found if found == bodies => Side::A,
                [b, a] if [a, b] == bodies => Side::B,
                _ => return false,
            };
            joint.glued[side].binary_search(&node).is_ok()
        })
    }

    /// Returns whether a body has a side in a tie.
    pub fn joins(&self, body: usize) -> bool {
        self.joints.iter().any(|joint| joint.bodies.contains(&body))
    }

    /// Gives the nodes that follow what those have that they follow: positions, velocities.
    pub fn follow(&self, vectors: &mut [Vec3]) {
        for follower in &self.followers {
            for (axis, weights) in follower.weights.iter().enumerate() {
                if let Some(weights) = weights {
                    let sum = weights.iter().map(|(node, w)| w * vectors[*node][axis]);
                    vectors[follower.node][axis] = sum.sum();
                }
            }
        }
    }

    /// Passes forces on nodes that follow to those that they follow, and leaves none; returns
    /// with every follower the force that its row takes from it.
    pub fn pass_on(&self, forces: &mut [Vec3]) -> impl Iterator<Item = (&Follower, Vec3)> {
        let mut taken = vec![Vec3::zeros(); self.followers.len()];
        for (axis, order) in self.orders.iter().enumerate() {
            for group in order.iter().rev() {
                let nodes = group.members.iter().map(|&at| self.followers[at].node);
                let on_members = nodes.map(|node| std::mem::take(&mut forces[node][axis]));
                let rows = group.taken(on_members.collect());
                for (&at, force) in group.members.iter().zip(rows) {
                    taken[at][axis] = force;
                    for (node, weight) in self.followers[at].row[axis].iter().flatten() {
                        forces[*node][axis] += weight * force;
                    }
                }
                // What rows of a group pass among its members is in what they take.
                for &at in &group.members {
                    forces[self.followers[at].node][axis] = 0.0;
                }
            }
        }
        self.followers.iter().zip(taken)
    }

    /// Adds the forces of ties on nodes to those that `own` takes from a follower.
    pub fn react(follower: &Follower, own: &Vec3, forces: &mut [Vec3]) {
        for (axis, row) in follower.row.iter().enumerate() {
            if let Some(row) = row {
                forces[follower.node][axis] += own[axis];
                for (node, weight) in row {
                    forces[*node][axis] -= weight * own[axis];
                }
            }
        }
    }

    /// Forces of a tie on the nodes of both sides, from those of all ties on all nodes.
    pub fn forces(&self, tie: usize, of_all: &[Vec3]) -> [BTreeMap<GlobalNode, Vec3>; 2] {
        let joint = &self.joints[tie];
        let mut left = of_all.to_vec();
        let mut forces = [BTreeMap::new(), BTreeMap::new()];
        for (follower, own) in self.pass_on(&mut left) {
            if follower.tie != tie {
                continue;
            }
            let mut add = |node: GlobalNode, axis: usize, force: f64| {
                let on_own = joint.nodes[joint.follows].binary_search(&node).is_ok();
                let side = if on_own {
                    joint.follows
                } else {
                    joint.follows.opposite()
                };
                let sum: &mut Vec3 = forces[side].entry(node).or_insert_with(Vec3::zeros);
                sum[axis] += force;
            };
            for (axis, row) in follower.row.iter().enumerate() {
                for (node, weight) in row.iter().flatten() {
                    add(*node, axis, -weight * own[axis]);
                }
                if row.is_some() {
                    add(follower.node, axis, own[axis]);
                }
            }
        }
        forces
    }
}

/// First global node of every body, and the number of their nodes.
pub fn first_nodes(model: &Model) -> Vec<usize> {
    let mut first_node = vec![0];
    for body in &model.bodies {
        first_node.push(first_node[first_node.len() - 1] + body.mesh.positions.len());
    }
    first_node
}

/// Body and node of a global node.
fn body_node(first_node: &[usize], GlobalNode(node): GlobalNode) -> (usize, NodeId) {
    let body = first_node.partition_point(|&first| first <= node) - 1;
    (body, NodeId::new(node - first_node[body]))
}
