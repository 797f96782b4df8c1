//! Contact and friction at a kept node.
//!
//! Unknowns `p` and `z = z1 t1 + z2 t2`. With the gap `g` and the slip `du` since the last
//! converged configuration (see `kinematics`),
//! `varpi = varpi(max(p, 0), |du|/dt)` and `y = z + r_t K^-1 du`:
//!
//! ```text
//! g = 0         : points decide    z = 0 where P^ <= 0
//! |y| <= varpi  : du = 0   else z = varpi y/|y|
//! ```
//!
//! `P^` is the mean pressure over the support, which bounds friction. Where the pressure is
//! decided at the node, `p` takes its place, and the node is closed where `p - r_n g > 0`, else
//! `p = 0`, `z = 0`. A node that has left the other side has `p = 0`, too.
//!
//! with `varpi rho(y)` for `varpi` where friction is tabulated, see
//! [`striae_law::friction::Kernel::reach`].
//!
//! The slip row is linearised with the globalised Jacobian of Hueeber, Stadler
//! & Wohlmuth (SIAM J. Sci. Comput. 30, 2008, doi:10.1137/060671061),
//!
//! ```text
//! dz - M dy - (y/|y|) dvarpi = -(z - varpi y/|y|),    M = varpi/|y| (I - beta F),
//! F = z y^T/(max(varpi, |z|) |y|),   alpha = cos(z, y),   delta = min(|z|/varpi, 1),
//! beta = 1/(1 - alpha delta) if alpha < 0 else 1,
//! ```
//!
//! which is the exact one where the row is satisfied.
//!
//! Friction that depends on rate and state has no stick; see `creep`.

mod creep;
mod friction;
mod mobility;
mod node;
mod state;

pub use crate::unknown::Prescribed;
pub use node::{Bound, Conditions, ContactNode, Iteration, Linearisation};

use crate::{
    configuration::Configuration,
    kinematics::{Presence, Pressure},
    segment::Derivatives,
    term::{Field, LocalTerm},
    unknowns::{NodeResult, Status},
};
use creep::creeping;
use friction::tangential;
use state::{N, NodeState, TRACTION};

/// Gap below which a node counts as touching at the start of an increment, over the local size.
const TOUCHING: f64 = 1e-6;

/// The three rows of a kept node, its results, and the status that its state decides on, which it
/// has unless another one is given.
pub fn rows(
    configuration: &Configuration,
    node: &ContactNode,
    conditions: Conditions,
) -> (LocalTerm, NodeResult, Status) {
    let Conditions {
        friction,
        prescribed,
        iteration,
        wanted: _,
    } = conditions;
    let state = NodeState::new(configuration, node, friction, prescribed);
    let [p, z1, z2] = node.unknowns;
    let size = configuration.size(node.side, node.node);
    let [r_n, r_t] = node.kinematics.stiffness;
    let g = state.gap.re;
    let is_free = state.is_free();
    let first = iteration == Iteration::First;
    let given = (iteration == Iteration::Given).then_some(node.before.status);
    let is_closed = |closes: bool| given.map_or(closes, |status| status != Status::Open);
    let (stated, closes) = match &node.kinematics.pressure {
        Pressure::AtNode => {
            let touching = first && g <= TOUCHING * size;
            let closes = is_free && (touching || p - r_n * g > 0.0);
            (is_closed(closes), closes)
        }
        Pressure::AtPoints(supported) => {
            let stated = is_free && node.kinematics.presence == Presence::Facing;
            let pressed = match first {
                true => supported.touches,
                false => state.bounding_pressure() > 0.0,
            };
            (stated, stated && pressed)
        }
    };
    let held = |component: usize, value: f64| {
        let mut row = [0.0; N];
        row[TRACTION + component] = 1.0;
        (Field::Traction, value, row)
    };
    let normal = match stated {
        true => (Field::Gap(size), g, state.gap.slope),
        false => held(0, p),
    };
    let (mut decided, deviation, rows) = if is_closed(closes) {
        let (status, [first, second], deviation) = match friction.rate_and_state() {
            Some(law) if configuration.elapsed.is_finite() => {
                let Linearisation { slip_weight, bound } = iteration.linearisation();
                let how = (r_t * slip_weight, bound);
                let (status, rows) = creeping(&state, law, configuration, how);
                (status, rows, 0.0)
            }
            _ => tangential(&state, configuration, [z1, z2], r_t, iteration),
        };
        (status, deviation, [normal, first, second])
    } else {
        (Status::Stick, 0.0, [normal, held(1, z1), held(2, z2)])
    };
    if !closes {
        decided = Status::Open;
    }
    let result = NodeResult {
        status: given.unwrap_or(decided),
        deviation,
        ..state.result()
    };
    let first = configuration
        .pair
        .numbering()
        .traction(node.side, node.node);
    let numbered = [0, 1, 2].map(|at| (first + at as u32, rows[at].0, rows[at].1));
    let term = match node.derivatives {
        Derivatives::First => {
            let gradient: [[f64; 3]; N] =
                std::array::from_fn(|lane| rows.each_ref().map(|row| row.2[lane]));
            LocalTerm::from_lanes(&state.lanes, &numbered, &gradient)
        }
        Derivatives::None => LocalTerm::from_columns::<0>(&numbered, &[], &[]),
    };
    (term, result, decided)
}
