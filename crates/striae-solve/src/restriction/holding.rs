//! Parts of the whole that a rank holds, their owners, and the other ranks that hold them.

use striae_mesh::{ElementId, NodeId, Vec3};

use super::numbers::Numbers;
use crate::{
    problem::{Frame, extent},
    rigid::mass_points,
    share::{Division, Holding, Whole},
};
use striae_model::{
    Model, PairId,
    initial::{fits, may_meet},
    node::GlobalNode,
};

/// Description of what a rank holds.
pub(super) fn holding(
    whole: &Frame,
    division: &Division,
    numbers: &Numbers,
    rank: usize,
) -> Holding {
    let model = whole.placed.as_ref().unwrap_or(&whole.model);
    let points: Vec<Vec3> = (model.rigid_surfaces.iter())
        .filter_map(|rigid| rigid.inertia.as_ref())
        .flat_map(mass_points)
        .collect();
    let count = division.owners().len() + points.len();
    let mut owned = vec![0; division.ranks()];
    let (mut owners, mut places, mut nodes) = (Vec::new(), Vec::new(), Vec::new());
    let mut replicated = Vec::new();
    for node in (0..count).map(GlobalNode) {
        let owner = division.owner(node);
        if let Some(local) = numbers.node(node) {
            owners.push(owner as u32);
            places.push(owned[owner] as u32);
            nodes.push(node.0);
            if numbers.is_replicated(node) {
                replicated.push(local);
            }
        }
        owned[owner] += 1;
    }
    let bodies = 0..model.bodies.len();
    Holding {
        owners,
        places,
        owned,
        nodes,
        replicated,
        common: common(model, division, numbers, rank),
        elements: bodies
            .clone()
            .map(|body| {
                let all = (0..division.elements()[body].len()).map(ElementId::new);
                all.filter(|id| numbers.element(body, *id).is_some())
                    .collect()
            })
            .collect(),
        mesh_nodes: bodies
            .map(|body| {
                let all = (0..model.bodies[body].mesh.positions.len()).map(NodeId::new);
                all.filter(|node| numbers.in_mesh(body, *node).is_some())
                    .collect()
            })
            .collect(),
        whole: known(whole, &points, count),
    }
}

/// Local nodes that other ranks have elements of, by rank, but for those that all ranks hold.
fn common(
    model: &Model,
    division: &Division,
    numbers: &Numbers,
    rank: usize,
) -> Vec<Vec<GlobalNode>> {
    let mut common = vec![Vec::new(); division.ranks()];
    let bodies = model.bodies.iter().zip(division.elements());
    for ((body, ranks), first) in bodies.zip(numbers.first_whole()) {
        let elements = body.mesh.elements().zip(ranks);
        for (corners, other) in elements.filter(|(_, other)| **other as usize != rank) {
            for node in corners {
                let node = GlobalNode(first + node.index());
                if let (Some(local), false) = (numbers.node(node), numbers.is_replicated(node)) {
                    common[*other as usize].push(local);
                }
            }
        }
    }
    for nodes in &mut common {
        nodes.sort_unstable();
        nodes.dedup();
    }
    common
}

/// Data of the whole problem that every rank keeps.
fn known(whole: &Frame, points: &[Vec3], nodes: usize) -> Whole {
    let model = &whole.model;
    let at = whole.placed.as_ref().unwrap_or(model);
    let positions = at.bodies.iter().flat_map(|body| &body.mesh.positions);
    let fits = fits(model);
    let pairs = fits.iter().enumerate();
    Whole {
        nodes,
        mesh_nodes: (at.bodies.iter())
            .map(|body| body.mesh.positions.len())
            .collect(),
        elements: (at.bodies.iter())
            .map(|body| body.mesh.element_count())
            .collect(),
        extent: extent(positions.chain(points)),
        may_meet: pairs
            .map(|(pair, fit)| {
                let fit = fit.as_ref();
                fit.is_none_or(|fit| may_meet(model, PairId(pair), fit))
            })
            .collect(),
        fits,
    }
}
