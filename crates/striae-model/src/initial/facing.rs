//! Pairs of a model whose surfaces look away from each other, see [`facing`]. Sides that
//! consist of faces are not judged: each node looks for what faces it, and some faces of a skin
//! always look away.

use striae_contact::{
    configuration::Configuration,
    initial::{
        Fit,
        facing::{self, Seen},
    },
    side::Side,
};
use striae_mesh::{NodeId, Vec3};

use super::{Reference, may_meet, surface_node};
use crate::model::{Model, PairId};

/// A node that looks away from the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// Side of the node.
    pub side: Side,
    /// Node of the mesh.
    pub node: NodeId,
    /// Position of the node.
    pub at: Vec3,
    /// Cosine of the angle between the normals there.
    pub cosine: f64,
}

/// The nearest node of a pair whose sides look away from each other; `None` where some nodes
/// face each other.
pub fn turned(model: &Model, pair: PairId) -> Option<Turned> {
    found(model, pair, facing::turned)
}

/// A node of a pair whose sides look away from each other and cannot touch: they are back to back
/// and touch now, or no motion can bring them together.
pub fn back_to_back(model: &Model, pair: PairId, fit: &Fit) -> Option<Turned> {
    found(model, pair, |configuration| {
        let away = facing::back_to_back(configuration)?;
        (away.touches() || !may_meet(model, pair, fit)).then_some(away)
    })
}

/// A node of a pair whose sides overlap where neither faces the other.
pub fn askew(model: &Model, pair: PairId) -> Option<Turned> {
    found(model, pair, facing::askew)
}

/// A node that is found in the reference configuration of a pair.
fn found(
    model: &Model,
    pair: PairId,
    find: impl FnOnce(&Configuration) -> Option<Seen>,
) -> Option<Turned> {
    if model.pairs[pair.0].feature_angle.is_some() {
        return None;
    }
    let reference = Reference::new(model, pair)?;
    let (found, at) = reference.at(model, |stage| {
        let found = find(stage.configuration)?;
        let own = stage.configuration.side(found.side);
        Some((found, own.x[found.node.index()]))
    })?;
    Some(Turned {
        side: found.side,
        node: surface_node(model, pair, found.side, found.node)?,
        at,
        cosine: found.cosine,
    })
}
