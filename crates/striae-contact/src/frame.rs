//! Nodal frames: normal and two tangents with their derivatives.
//!
//! The normal is the surface's own nodal normal or, against a rigid surface,
//! the opposite of the rigid normal at the projection. The first tangent is the
//! direction to the node's first neighbour made tangent and of unit length,
//! Jones & Papadopoulos (2006), eq. (54) with the missing normalisation; the
//! second is `t2 = n x t1`.

use nalgebra::Vector3;
use num_dual::DualSVec64;
use striae_mesh::Vec3;
use striae_surface::{
    normal::normal_jacobian,
    scalar::{cross, dot, normalised, scaled},
};

use crate::{
    configuration::Configuration,
    coverage::Place,
    projection::{Margin, differentiated_rigid},
    selection::{Role, Selection},
    term::{Jacobian, Lanes, Source, jacobian, variable3},
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
    let mut frames: Frames = [0, 1].map(|side| vec![None; selection.roles[side].len()]);
    for &side in configuration.pair.deformable_sides() {
        for (node, role) in selection.roles[side].iter().enumerate() {
            let node = node as u32;
            let n = match role {
                Role::Idle => continue,
                Role::Extended(leaders) if configuration.pair.is_rigid() => {
                    normal(configuration, side, leaders[0].node)?
                }
                _ => normal(configuration, side, node)?,
            };
            frames[side][node as usize] = Some(frame(configuration, side, node, n));
        }
    }
    Ok(frames)
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
        let mut jacobian = Vec::with_capacity(30);
        for (other, block) in normal_jacobian(own.surface, &own.x, node) {
            let first = numbering.position(side, other);
            jacobian.extend((0..3).map(|axis| (first + axis as u32, block.column(axis).into())));
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
    Ok(Tracked {
        value: -rigid.map(|component| component.re),
        jacobian: jacobian(&lanes, &-rigid),
    })
}

fn frame(configuration: &Configuration, side: usize, node: u32, n: Tracked) -> Frame {
    let own = configuration.side(side);
    let numbering = configuration.pair.numbering();
    let neighbour = own.surface.corners(node)[0].next;
    let x: Vector3<DualSVec64<9>> = variable3(&own.x[node as usize], 0);
    let x_next = variable3(&own.x[neighbour as usize], 3);
    let normal = variable3(&n.value, 6);
    let edge = x_next - x;
    let t1 = normalised(&(edge - scaled(&normal, dot(&edge, &normal))));
    let t2 = cross(&normal, &t1);
    let mut lanes = Lanes::default();
    for other in [node, neighbour] {
        lanes.push(Source::Unknowns {
            first: numbering.position(side, other),
            count: 3,
        });
    }
    lanes.push(Source::Vector(&n.jacobian));
    let tracked = |t: &Vector3<DualSVec64<9>>| Tracked {
        value: t.map(|component| component.re),
        jacobian: jacobian(&lanes, t),
    };
    Frame {
        t: [tracked(&t1), tracked(&t2)],
        n: n.clone(),
    }
}
