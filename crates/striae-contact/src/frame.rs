//! Nodal frames: normal and two tangents with their derivatives.
//!
//! The normal is the surface's own nodal normal or, against a rigid surface,
//! the opposite of the rigid normal at the projection. The first tangent is the
//! direction to the node's first neighbour made tangent and of unit length,
//! Jones & Papadopoulos (2006), eq. (54) with the missing normalisation; the
//! second is `t2 = n x t1`.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use rayon::prelude::*;
use striae_mesh::Vec3;
use striae_surface::normal::normal_jacobian;

use crate::{
    configuration::Configuration,
    coverage::Place,
    projection::{Margin, differentiated_rigid},
    selection::{Role, Selection},
    term::{Jacobian, Lanes, Source, add_block, parts, variable3},
};

/// A vector with its derivatives by the unknowns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tracked {
    /// The vector.
    pub value: Vec3,
    /// Its derivatives.
    pub jacobian: Jacobian,
}

/// Normal and tangents of a node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Unit normal `n`.
    pub n: Tracked,
    /// Unit tangents.
    pub t: [Tracked; 2],
}

/// Frames of the nodes that carry traction, by side; `None` elsewhere.
pub type Frames = [Vec<Option<Frame>>; 2];

/// A node lost sight of the other side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LostProjection {
    /// Side of the pair.
    pub side: usize,
    /// Surface-local node.
    pub node: u32,
}

/// Frames of all nodes that carry traction.
pub fn frames(
    configuration: &Configuration,
    selection: &Selection,
) -> Result<Frames, LostProjection> {
    let of_side = |side: usize| -> Result<Vec<Option<Frame>>, LostProjection> {
        let roles = &selection.roles[side];
        let found: Vec<_> = (0..roles.len())
            .into_par_iter()
            .with_min_len(16)
            .map(|node| frame_of(configuration, side, node as u32, &roles[node]))
            .collect();
        found.into_iter().collect()
    };
    Ok([of_side(0)?, of_side(1)?])
}

fn frame_of(
    configuration: &Configuration,
    side: usize,
    node: u32,
    role: &Role,
) -> Result<Option<Frame>, LostProjection> {
    let n = match role {
        Role::Idle => return Ok(None),
        Role::Extended(leaders) if configuration.pair.is_rigid() => {
            normal(configuration, side, leaders[0].node)?
        }
        _ => normal(configuration, side, node)?,
    };
    Ok(Some(frame(configuration, side, node, n)))
}

/// Largest distance, in reaches, over which a projection is followed within an increment.
pub const FOLLOW: f64 = 6.0;

fn normal(
    configuration: &Configuration,
    side: usize,
    node: u32,
) -> Result<Tracked, LostProjection> {
    let own = configuration.side(side);
    let numbering = configuration.pair.numbering();
    if !configuration.pair.is_rigid() {
        let mut jacobian = normal_jacobian(own.surface, &own.x, node);
        for entry in &mut jacobian {
            entry.0 = numbering.position(side, entry.0);
        }
        return Ok(Tracked {
            value: own.normals[node as usize],
            jacobian,
        });
    }
    if let Some((_, normal)) = configuration.plane() {
        return Ok(Tracked {
            value: -normal,
            jacobian: Vec::new(),
        });
    }
    let reach = FOLLOW * configuration.reach(side, node);
    let contact = configuration
        .contact(side, node, reach, Margin::Extrapolated)
        .ok_or(LostProjection { side, node })?;
    let Place::Facet(hit) = contact.place else {
        return Err(LostProjection { side, node });
    };
    let x: Vector3<DualSVec64<3>> = variable3(&own.x[node as usize], 0);
    let (_, rigid) = differentiated_rigid(configuration.side(1), &hit, &x);
    let mut lanes = Lanes::default();
    lanes.push(Source::Unknowns {
        first: numbering.position(side, node),
        count: 3,
    });
    let (value, gradient) = parts(&-rigid);
    Ok(Tracked {
        value,
        jacobian: lanes.jacobian(&gradient),
    })
}

fn frame(configuration: &Configuration, side: usize, node: u32, n: Tracked) -> Frame {
    let own = configuration.side(side);
    let numbering = configuration.pair.numbering();
    let neighbour = own.surface.corners(node)[0].next;
    let edge = own.x[neighbour as usize] - own.x[node as usize];
    let along = edge.dot(&n.value);
    let tangential = edge - n.value * along;
    let length = tangential.norm();
    let t1 = tangential / length;
    let across = (Matrix3::identity() - t1 * t1.transpose()) / length;
    let by_edge = across * (Matrix3::identity() - n.value * n.value.transpose());
    let by_n = -across * (Matrix3::identity() * along + n.value * edge.transpose());
    let turn = n.value.cross_matrix();
    let mut lanes = Lanes::default();
    for other in [node, neighbour] {
        lanes.push(Source::Unknowns {
            first: numbering.position(side, other),
            count: 3,
        });
    }
    lanes.push(Source::Vector(&n.jacobian));
    let tracked = |value: Vec3, by_edge: Matrix3<f64>, by_n: Matrix3<f64>| {
        let mut gradient = [[0.0; 3]; 9];
        add_block(&mut gradient, 0, &-by_edge);
        add_block(&mut gradient, 3, &by_edge);
        add_block(&mut gradient, 6, &by_n);
        Tracked {
            value,
            jacobian: lanes.jacobian(&gradient),
        }
    };
    let t2 = n.value.cross(&t1);
    Frame {
        t: [
            tracked(t1, by_edge, by_n),
            tracked(t2, turn * by_edge, turn * by_n - t1.cross_matrix()),
        ],
        n: n.clone(),
    }
}
