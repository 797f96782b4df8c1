//! Normals of nodes of a deforming surface, with their derivatives.

use striae_surface::{node::SurfaceNode, normal::normal_jacobian};

use crate::{configuration::Configuration, side::Side, tracked::Tracked};

/// The normal of a node's own surface.
pub fn own_normal(configuration: &Configuration, side: Side, node: SurfaceNode) -> Tracked {
    let own = configuration.side(side);
    let numbering = configuration.pair.numbering();
    let jacobian = normal_jacobian(own.surface, &own.x, node).into_iter();
    Tracked {
        value: own.normals[node],
        jacobian: jacobian
            .map(|(node, block)| (numbering.position(side, node), block))
            .collect(),
    }
}
