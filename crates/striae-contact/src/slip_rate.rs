//! Slip velocities of the kinematic nodes, with their derivatives.
//!
//! `v = (I - n n)(x_I - xbar)/dt` over the time `dt` since the last converged
//! configuration. Only friction that decays with the slip rate `|v|` asks for it.

use nalgebra::Matrix3;

use crate::{
    configuration::Configuration,
    frame::{Frame, Frames, Tracked},
    selection::{Partner, Role, Selection},
    term::{Lanes, Source, add_block},
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
    let numbering = configuration.pair.numbering();
    let (x, n) = (configuration.side(side).x[node as usize], frame.n.value);
    let per_time = 1.0 / configuration.elapsed;
    let tangential = (Matrix3::identity() - n * n.transpose()) * per_time;
    let mut lanes = Lanes::default();
    let mut gradient = [[0.0; 3]; 18];
    lanes.push(Source::Unknowns {
        first: numbering.position(side, node),
        count: 3,
    });
    lanes.push(Source::Vector(&frame.n.jacobian));
    if let Partner::Corners(corners, weights) = partner {
        for (at, corner) in corners.into_iter().enumerate() {
            lanes.push(Source::Unknowns {
                first: numbering.position(1 - side, corner),
                count: 3,
            });
            add_block(&mut gradient, 6 + 3 * at, &(tangential * -weights[at]));
        }
    }
    let relative = x - partner.point(configuration, side);
    let by_n = Matrix3::identity() * n.dot(&relative) + n * relative.transpose();
    add_block(&mut gradient, 0, &tangential);
    add_block(&mut gradient, 3, &(by_n * -per_time));
    Tracked {
        value: tangential * relative,
        jacobian: lanes.jacobian(&gradient),
    }
}
