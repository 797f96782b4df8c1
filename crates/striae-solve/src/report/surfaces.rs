//! Contact surfaces before anything has moved: gaps as meshed, normals and textures.
//!
//! The gap of a node is its distance from the nearest point of the other side where it faces
//! that, less than zero inside of it, and zero where nothing opposes it. Normals are the
//! nodal normals of the side itself. There is no traction and no slip.

use rayon::prelude::*;
use striae_contact::{
    initial::Faces, interference::Stage, side::Side, texture::SideTexture, unknowns::NodeResult,
};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    interference::{configuration, thickness},
    problem::Problem,
    state::State,
};

/// Results at the nodes of all deformable sides in a state that no increment led to, by pair and
/// side.
pub fn surfaces(problem: &Problem, state: &State) -> Vec<[Vec<NodeResult>; 2]> {
    let pairs = 0..problem.pairs.len();
    pairs.map(|pair| of_pair(problem, state, pair)).collect()
}

fn of_pair(problem: &Problem, state: &State, pair: usize) -> [Vec<NodeResult>; 2] {
    let placed = configuration(problem, pair, state.into());
    if placed.is_apart(0.0) {
        return state.pairs[pair].nodes.clone();
    }
    let stage = Stage {
        configuration: &placed,
        thickness: &thickness(problem, pair, &state.positions),
    };
    let faces = Faces::new(&stage);
    Side::BOTH.map(|side| {
        if problem.pairs[pair].bodies[side].is_none() {
            return state.pairs[pair].nodes[side].clone();
        }
        let nodes = 0..stage.configuration.side(side).x.len();
        let nodes = nodes.into_par_iter().with_min_len(16);
        let nodes = nodes.map(SurfaceNode::new);
        nodes
            .map(|node| of_node(&stage, &faces, side, node))
            .collect()
    })
}

fn of_node(stage: &Stage, faces: &Faces, side: Side, node: SurfaceNode) -> NodeResult {
    let snapshot = stage.configuration.side(side);
    let normal = snapshot.normals[node];
    let texture = match &stage.configuration.pair.sides[side].texture {
        Some(SideTexture::Nodal(texture)) => texture.at(node, &snapshot.x, normal).ok(),
        _ => None,
    };
    NodeResult {
        gap: faces.signed_gap(side, node).map_or(0.0, |(gap, _)| gap),
        normal,
        texture: texture.map_or(Vec3::zeros(), |axes| axes.s),
        ..NodeResult::default()
    }
}
