//! Slip velocities of the kinematic nodes, with their derivatives.
//!
//! `v = (I - n n)(x_I - xbar)/dt` over the time `dt` since the last converged
//! configuration. Only friction that decays with the slip rate `|v|` asks for it.

use nalgebra::Vector3;
use num_dual::{DualNum, DualSVec64};
use striae_surface::scalar::{combination, constant3, dot, scaled};

use crate::{
    configuration::Configuration,
    frame::{Frame, Frames, Tracked},
    selection::{Partner, Role, Selection},
    term::{Lanes, Source, jacobian, variable3, variables3},
};

/// Slip velocities by side; zero without derivatives where nothing asks for them.
pub type SlipVelocities = [Vec<Tracked>; 2];

/// Slip velocities of all kinematic nodes.
pub fn slip_velocities(
    configuration: &Configuration,
    selection: &Selection,
    frames: &Frames,
) -> SlipVelocities {
    let asked = configuration.pair.friction.decays() && configuration.elapsed.is_finite();
    [0, 1].map(|side| {
        let roles = selection.roles[side].iter().enumerate();
        roles
            .map(|(node, role)| match (role, &frames[side][node]) {
                (Role::Kinematic(partner), Some(frame)) if asked => {
                    slip_velocity(configuration, side, node as u32, *partner, frame)
                }
                _ => Tracked::default(),
            })
            .collect()
    })
}

fn slip_velocity(
    configuration: &Configuration,
    side: usize,
    node: u32,
    partner: Partner,
    frame: &Frame,
) -> Tracked {
    type D = DualSVec64<18>;
    let numbering = configuration.pair.numbering();
    let mut lanes = Lanes::default();
    lanes.push(Source::Unknowns {
        first: numbering.position(side, node),
        count: 3,
    });
    lanes.push(Source::Vector(&frame.n.jacobian));
    let opposite: Vector3<D> = match partner {
        Partner::Rigid(point) => constant3(&configuration.placement.point(&point)),
        Partner::Corners(corners, weights) => {
            for corner in corners {
                lanes.push(Source::Unknowns {
                    first: numbering.position(1 - side, corner),
                    count: 3,
                });
            }
            let x = &configuration.side(1 - side).x;
            let positions = corners.map(|corner| x[corner as usize]);
            combination(&weights.map(D::from), &variables3(&positions, 6))
        }
    };
    let x: Vector3<D> = variable3(&configuration.side(side).x[node as usize], 0);
    let n: Vector3<D> = variable3(&frame.n.value, 3);
    let relative = x - opposite;
    let along = relative - scaled(&n, dot(&relative, &n));
    let velocity = scaled(&along, D::from(1.0 / configuration.elapsed));
    Tracked {
        value: velocity.map(|component| component.re),
        jacobian: jacobian(&lanes, &velocity),
    }
}

/// The length of a vector given by components, without derivatives at zero.
pub fn rate<D: DualNum<Primitive = f64> + Copy>(components: &[D]) -> D {
    let square = components.iter().fold(D::zero(), |sum, &c| sum + c * c);
    if square.re() > 0.0 {
        square.sqrt()
    } else {
        D::zero()
    }
}
