//! The move of nodes that follow to where their rows want them, without strain.

use striae_mesh::{MeshError, Vec3};

use super::{TieFault, Ties, body_node, first_nodes};
use crate::model::Model;

/// Largest number of times that rows are found again.
const MOST: usize = 10;
/// Way over what positions are made of that is round-off: nodes stay.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// The model with the nodes that follow moved to where they belong, which says how far.
///
/// Rows are found again for the new positions until nothing moves, so that a model that has been
/// placed stays unchanged.
///
/// # Errors
/// All invalid ties.
pub fn placed(mut model: Model) -> Result<Model, Vec<TieFault>> {
    if model.ties.is_empty() {
        return Ok(model);
    }
    let meshed = positions(&model);
    for _ in 0..MOST {
        let ties = Ties::new(&model)?;
        let before = positions(&model);
        model = ties.moved(model).map_err(|fault| vec![fault])?;
        let after = positions(&model);
        for follower in &ties.followers {
            let tie = &mut model.ties[follower.tie];
            let way = (after[follower.node] - meshed[follower.node]).norm();
            tie.moved = tie.moved.max(way);
        }
        if before == after {
            break;
        }
    }
    Ok(model)
}

/// Positions of all nodes of all bodies.
fn positions(model: &Model) -> Vec<Vec3> {
    let bodies = model.bodies.iter();
    bodies
        .flat_map(|body| body.mesh.positions.iter().copied())
        .collect()
}

/// The model with the nodes moved.
pub(super) fn moved(ties: &Ties, mut model: Model) -> Result<Model, TieFault> {
    if ties.is_empty() {
        return Ok(model);
    }
    let first_node = first_nodes(&model);
    let before = positions(&model);
    let mut after = before.clone();
    ties.follow(&mut after);
    for follower in &ties.followers {
        let (body, node) = body_node(&first_node, follower.node);
        let (from, to) = (before[follower.node], after[follower.node]);
        let size = from.norm() + ties.joints[follower.tie].facet_size;
        if (to - from).norm() > ROUND_OFF * size {
            model.bodies[body].mesh.positions[node.index()] = to;
        }
    }
    for (tie, joint) in ties.joints.iter().enumerate() {
        let body = &model.bodies[joint.bodies[joint.follows]];
        if let Err(MeshError::Inverted { element, .. }) = body.mesh.check_shape() {
            let own = ties.followers.iter().filter(|own| own.tie == tie);
            let ways = own.map(|own| (after[own.node] - before[own.node]).norm());
            return Err(TieFault::Inverted {
                tie: model.ties[tie].name.clone(),
                body: body.name.clone(),
                moved: ways.fold(0.0, f64::max),
                element,
            });
        }
    }
    Ok(model)
}
