//! Slip velocities of the kept nodes, with their derivatives.
//!
//! `v = du/dt` over the time `dt` since the last converged configuration. Only friction that
//! decays with the slip rate `|v|` asks for it.

use crate::{
    configuration::Configuration, frame::Tracked, kinematics::Kinematics, selection::Selection,
};

/// Slip velocities by side; zero without derivatives where nothing asks for them.
pub type SlipVelocities = [Vec<Tracked>; 2];

/// Slip velocities of all kept nodes.
pub fn slip_velocities(
    configuration: &Configuration,
    selection: &Selection,
    kinematics: &[Kinematics],
) -> SlipVelocities {
    let mut velocities = [0, 1].map(|side| vec![Tracked::default(); selection.nodes(side)]);
    if configuration.pair.friction.decays() && configuration.elapsed.is_finite() {
        let per_time = 1.0 / configuration.elapsed;
        for (kept, kinematics) in selection.kept().iter().zip(kinematics) {
            let (side, node) = kept.place();
            let slip = &kinematics.slip;
            velocities[side][node] = Tracked {
                value: slip.value * per_time,
                jacobian: slip
                    .jacobian
                    .iter()
                    .map(|(first, block)| (*first, block * per_time))
                    .collect(),
            };
        }
    }
    velocities
}
