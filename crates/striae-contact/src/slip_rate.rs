//! Slip rates of the kept nodes, with their derivatives.
//!
//! `|v| = |du|/dt` over the time `dt` since the last converged configuration, with the slip that is
//! seen, without what the ramp adds. Only friction that depends on the slip rate needs it: the
//! friction of a node and the row that it obeys use one rate.

use striae_law::friction::Friction;

use crate::{
    configuration::Configuration, kinematics::Kinematics, selection::Selection, side::Side,
    tracked::TrackedScalar,
};

/// Slip rates by side; zero without derivatives if nothing depends on them.
pub type SlipRates = [Vec<TrackedScalar>; 2];

/// Slip rates of all kept nodes, from kinematics without ramps.
pub fn slip_rates(
    configuration: &Configuration,
    friction: &Friction,
    selection: &Selection,
    kinematics: &[Kinematics],
) -> SlipRates {
    let mut rates = Side::BOTH.map(|side| vec![TrackedScalar::default(); selection.nodes(side)]);
    if friction.depends_on_rate() && configuration.elapsed.is_finite() {
        for (kept, kinematics) in selection.kept().iter().zip(kinematics) {
            let (side, node) = kept.place();
            rates[side][node] = slip_rate(kinematics, configuration.elapsed);
        }
    }
    rates
}

/// The slip rate of a node, without derivatives where it does not slip.
fn slip_rate(kinematics: &Kinematics, elapsed: f64) -> TrackedScalar {
    let slip = &kinematics.slip;
    let Some(direction) = slip.value.try_normalize(0.0) else {
        return TrackedScalar::default();
    };
    let by_slip = direction / elapsed;
    let blocks = slip.jacobian.iter();
    TrackedScalar {
        value: slip.value.norm() / elapsed,
        gradient: blocks
            .map(|(first, block)| (*first, block.tr_mul(&by_slip)))
            .collect(),
    }
}
