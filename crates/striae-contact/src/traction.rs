//! Nodal friction tractions `tau` from the unknowns, with their derivatives.
//!
//! At kinematic nodes `tau = -(L z + varpi eta)` with `varpi` at the present slip rate, elsewhere the unknowns are the
//! components of `tau` itself.

use nalgebra::Vector3;
use num_dual::DualSVec64;
use striae_law::friction::Textures as LawTextures;
use striae_mesh::Vec3;
use striae_surface::scalar::scaled;

use crate::{
    configuration::Configuration,
    frame::{Frame, Frames, Tracked},
    selection::{Role, Selection},
    slip_rate::{SlipVelocities, rate},
    term::{Lanes, Source, jacobian, variable, variable3},
    texture::{NodeTextures, Textures},
    unknowns::Tractions,
};

/// Nodal friction tractions by side; zero at idle nodes.
pub type NodalTractions = [Vec<Tracked>; 2];

/// What tractions depend on at every node.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// Nodal frames.
    pub frames: &'a Frames,
    /// Textures of both sides.
    pub textures: &'a Textures,
    /// Slip velocities.
    pub velocities: &'a SlipVelocities,
}

/// Friction tractions of all nodes.
pub fn nodal_tractions(
    configuration: &Configuration,
    selection: &Selection,
    surroundings: &Surroundings,
    tractions: &Tractions,
) -> NodalTractions {
    [0, 1].map(|side| {
        (0..selection.roles[side].len())
            .map(|node| match &surroundings.frames[side][node] {
                Some(frame) => nodal_traction(
                    configuration,
                    &selection.roles[side][node],
                    frame,
                    &surroundings.textures[side][node],
                    &surroundings.velocities[side][node],
                    configuration.pair.numbering().traction(side, node as u32),
                    tractions.nodes[side][node],
                ),
                None => Tracked::default(),
            })
            .collect()
    })
}

fn nodal_traction(
    configuration: &Configuration,
    role: &Role,
    frame: &Frame,
    textures: &NodeTextures,
    velocity: &Tracked,
    first: u32,
    unknowns: [f64; 3],
) -> Tracked {
    type D = DualSVec64<21>;
    let t: [Vector3<D>; 2] = [
        variable3(&frame.t[0].value, 3),
        variable3(&frame.t[1].value, 6),
    ];
    let vector = scaled(&t[0], variable(unknowns[1], 1)) + scaled(&t[1], variable(unknowns[2], 2));
    let tau = if matches!(role, Role::Kinematic(_)) {
        let friction = &configuration.pair.friction;
        let pressure: D = variable(unknowns[0], 0);
        let kernel = friction.kernel(&variable3(&frame.n.value, 9), &on_lanes(textures, 12));
        let velocity: Vector3<D> = variable3(&velocity.value, 18);
        kernel.traction(friction.cap(pressure, rate(velocity.as_slice())), &vector)
    } else {
        vector
    };
    let mut lanes = Lanes::default();
    lanes.push(Source::Unknowns { first, count: 3 });
    lanes.push(Source::Vector(&frame.t[0].jacobian));
    lanes.push(Source::Vector(&frame.t[1].jacobian));
    lanes.push(Source::Vector(&frame.n.jacobian));
    push_textures(&mut lanes, textures);
    lanes.push(Source::Vector(&velocity.jacobian));
    Tracked {
        value: tau.map(|component| component.re),
        jacobian: jacobian(&lanes, &tau),
    }
}

/// Textures of a node as variables from lane `lane` on.
pub fn on_lanes<const N: usize>(
    textures: &NodeTextures,
    lane: usize,
) -> LawTextures<DualSVec64<N>> {
    let variable = |texture: &Option<Tracked>, lane: usize| {
        texture
            .as_ref()
            .map(|texture| variable3(&texture.value, lane))
    };
    LawTextures {
        own: variable(&textures.own, lane),
        opposite: variable(&textures.opposite, lane + 3),
    }
}

/// Appends the six lanes of the textures of a node.
pub fn push_textures<'a>(lanes: &mut Lanes<'a>, textures: &'a NodeTextures) {
    for texture in [&textures.own, &textures.opposite] {
        lanes.push(match texture {
            Some(texture) => Source::Vector(&texture.jacobian),
            None => Source::Constant(3),
        });
    }
}

/// Components of `tau` that a node has when its role changes to or from kinematic:
/// of `z` from `tau` for the isotropic part of the law, as a first guess.
pub fn reinterpreted(unknowns: [f64; 3]) -> [f64; 3] {
    [unknowns[0], -unknowns[1], -unknowns[2]]
}

/// `sum_axis component t_axis`.
pub fn in_frame(frame: &Frame, components: [f64; 2]) -> Vec3 {
    frame.t[0].value * components[0] + frame.t[1].value * components[1]
}
