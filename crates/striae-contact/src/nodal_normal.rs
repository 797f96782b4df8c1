//! Normals of nodes of a deforming surface, with their derivatives.

use striae_surface::normal::normal_jacobian;

use crate::{configuration::Configuration, side::Side, tracked::Tracked};

/// The normal of a node's own surface.
pub fn own_normal(configuration: &Configuration, side: Side, node: u32) -> Tracked {
    let own = configuration.side(side);
    let numbering = configuration.pair.numbering();
    let mut jacobian = normal_jacobian(own.surface, &own.x, node);
    for entry in &mut jacobian {
        entry.0 = numbering.position(side, entry.0);
    }
    Tracked {
        value: own.normals[node as usize],
        jacobian,
    }
}
