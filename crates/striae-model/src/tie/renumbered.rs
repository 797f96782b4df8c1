//! Ties among the nodes that a rank holds.

use striae_mesh::NodeId;

use super::{Follower, Joint, Ties, Weights};
use crate::node::GlobalNode;

impl Ties {
    /// Ties for a mesh whose nodes have other numbers in unchanged order: `number` maps global
    /// nodes, of which there are `count`, `in_mesh` nodes of the mesh of a body.
    pub fn renumbered(
        self,
        count: usize,
        number: impl Fn(GlobalNode) -> GlobalNode,
        in_mesh: impl Fn(usize, NodeId) -> NodeId,
    ) -> Self {
        if self.of_node.is_empty() {
            return self;
        }
        let followers: Vec<Follower> = (self.followers.into_iter())
            .map(|follower| Follower {
                tie: follower.tie,
                node: number(follower.node),
                row: weights(follower.row, &number),
                weights: weights(follower.weights, &number),
            })
            .collect();
        let mut of_node = vec![None; count];
        for (at, follower) in followers.iter().enumerate() {
            of_node[follower.node] = Some(at as u32);
        }
        let joints = self.joints.into_iter();
        let joints = joints.map(|joint| renumbered(joint, &number, &in_mesh));
        Self {
            joints: joints.collect(),
            followers,
            orders: self.orders,
            of_node,
        }
    }
}

fn weights(weights: Weights, number: impl Fn(GlobalNode) -> GlobalNode) -> Weights {
    weights.map(|of_axis| {
        let weights = of_axis?.into_iter();
        Some(weights.map(|(node, w)| (number(node), w)).collect())
    })
}

fn renumbered(
    joint: Joint,
    number: impl Fn(GlobalNode) -> GlobalNode,
    in_mesh: impl Fn(usize, NodeId) -> NodeId,
) -> Joint {
    let bodies = joint.bodies;
    let mut facets = joint.facets;
    for (body, of_side) in bodies.into_iter().zip(&mut facets) {
        for corner in of_side.iter_mut().flatten() {
            *corner = in_mesh(body, *corner);
        }
    }
    let nodes = joint
        .nodes
        .map(|nodes| nodes.into_iter().map(&number).collect());
    let glued = joint
        .glued
        .map(|nodes| nodes.into_iter().map(&number).collect());
    let patches = joint.patches.into_iter();
    Joint {
        nodes,
        glued,
        facets,
        patches: patches.map(|patch| patch.renumbered(&number)).collect(),
        ..joint
    }
}
