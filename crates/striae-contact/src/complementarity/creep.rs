//! The tangential rows of a closed node whose friction depends on rate and state.
//!
//! Such friction has no threshold below which a node sticks: at any traction it creeps, at rates
//! that far below strength are less than the round-off of positions. So the rate is not taken from
//! the slip but found with the traction,
//!
//! ```text
//! z = Z y/|y| ,   y = z + r K^-1 du ,   Z + k v = |y| ,   Z = rho varpi(v) ,   k = r dt/kappa
//! ```
//!
//! with [`Friction::creep`](striae_law::friction::Friction::creep). Where this holds,
//! `r K^-1 du = k v y/|y|`. As `du` is along `K y`, `v = |du|/dt` for `kappa = |K y|/|y|`. The
//! row has the same solutions for every `r`; its Jacobian is globalised as that of slip at a given
//! friction, and exact at solutions. `r` is at least so large that a
//! length `|y|` belongs to one rate, however friction falls with slip.
//!
//! A node that can slip along one direction only has this row along it. One that prescribed motions
//! make slip has the friction of that rate, and one that cannot slip at all `z = 0`.
//!
//! While bounds of friction lag (see [`Iteration::later`](super::Iteration::later)), derivatives by
//! the pressure are left out.
//!
//! A node is told to stick while its state grows nearly as at rest, at `v theta/D` below
//! [`RESTING`].

use num_dual::{Dual64, DualSVec64};
use striae_law::friction::{Creep, Past, RateAndState};

use super::{
    friction::{Radius, TangentialRow, along, part, slip, traction},
    mobility::Mobility,
    node::Bound,
    state::{NodeState, Q, TRACTION},
};
use crate::{
    configuration::Configuration,
    term::{gradient, variable},
    unknowns::Status,
};

/// `v theta/D` below which a node sticks: its state grows by 1 % less than at rest.
const RESTING: f64 = 0.01;
/// Imposed slip over the facet size below which it is round-off.
const ROUND_OFF: f64 = 1e-12;

/// Status and tangential rows of a closed node with `r_t` and the given bound.
pub(super) fn creeping(
    state: &NodeState,
    law: &RateAndState,
    configuration: &Configuration,
    (r, bound): (f64, Bound),
) -> (Status, [TangentialRow; 2]) {
    let [p, z1, z2] = state.node.unknowns;
    let creeping = Creeping {
        state,
        law,
        past: Past {
            slip: state.node.accumulated,
            state: state.node.friction_state,
            elapsed: configuration.elapsed,
        },
        pressure: state.node.kinematics.bounding_pressure(p),
        by_pressure: match bound {
            Bound::Coupled => 1.0,
            Bound::Lagging => 0.0,
        },
        z: [Q::variable(z1, TRACTION + 1), Q::variable(z2, TRACTION + 2)],
        k_inverse: [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[i, j]| state.k_inverse(i, j)),
    };
    let size = configuration.size(state.node.side, state.node.node);
    match Mobility::new(state) {
        Mobility::Free => creeping.freely(&creeping.spring(r)),
        Mobility::Along(way) => creeping.along(&way.of_friction, &creeping.spring(r)),
        Mobility::Driven => creeping.imposed(ROUND_OFF * size),
        Mobility::Held => creeping.held(),
    }
}

/// Friction at a closed node.
struct Creeping<'a> {
    state: &'a NodeState<'a>,
    law: &'a RateAndState,
    past: Past,
    pressure: f64,
    /// Factor on derivatives by the pressure.
    by_pressure: f64,
    z: [Q; 2],
    /// Components of `K^-1` along the tangents, by rows.
    k_inverse: [Q; 4],
}

impl Creeping<'_> {
    /// `r`, at least what makes the rate unique.
    fn spring(&self, r: f64) -> Q {
        let friction = self.state.friction;
        let pressure = Dual64::from(self.pressure).derivative();
        let needed = friction.creep_stiffness(self.past, pressure);
        // `kappa` is at most the norm of `K`.
        let [a, b, c, d] = self.k_inverse.each_ref().map(|entry| entry.re);
        let norm = (a * a + b * b + c * c + d * d).sqrt() / (a * d - b * c).abs();
        match norm * needed.re > r {
            true => {
                let mut needed_r = Q::constant(norm * needed.re);
                needed_r.slope[self.state.pressure_lane()] = self.by_pressure * norm * needed.eps;
                needed_r
            }
            false => Q::constant(r),
        }
    }

    /// `z = Z y/|y|`.
    fn freely(&self, r: &Q) -> (Status, [TangentialRow; 2]) {
        let turned = &self.state.turned;
        let y = [0, 1].map(|at| {
            let spring = Q::product(r, &turned[at]);
            Q::combination([(1.0, &self.z[at]), (1.0, &spring)])
        });
        let Some((length, direction)) = unit(&y) else {
            return self.held();
        };
        let (rate, radius) = self.shared(&length, &direction, r);
        (self.status(rate), slip(&self.z, &y, &radius, false))
    }

    /// `w . z = Z sign(y)` with `y = w . (z + r K^-1 du)`, and no `z` across.
    fn along(&self, w: &[Q; 2], r: &Q) -> (Status, [TangentialRow; 2]) {
        let spring = Q::product(r, &part(w, &self.state.turned));
        let y = Q::combination([(1.0, &part(w, &self.z)), (1.0, &spring)]);
        let sign = y.re.signum();
        let length = Q::combination([(sign, &y)]);
        let direction = w.map(|w| Q::combination([(sign, &w)]));
        let (rate, radius) = self.shared(&length, &direction, r);
        (self.status(rate), along(w, &self.z, &y, &radius, false))
    }

    /// `z = 0`.
    fn held(&self) -> (Status, [TangentialRow; 2]) {
        (Status::Stick, self.z.map(traction))
    }

    /// `z = rho varpi(|du|/dt) K^-1 du/|K^-1 du|`.
    fn imposed(&self, round_off: f64) -> (Status, [TangentialRow; 2]) {
        let Some((way, _)) = unit(&self.state.slip).filter(|(way, _)| way.re > round_off) else {
            return self.held();
        };
        let Some((_, direction)) = unit(&self.state.turned) else {
            return self.held();
        };
        let rate = way.re / self.past.elapsed;
        let [log_rate, pressure] = [variable(rate.ln(), 0), variable(self.pressure, 1)];
        let varpi: DualSVec64<2> = self
            .state
            .friction
            .creeping_cap(self.past, pressure, log_rate);
        let [by_log_rate, by_pressure] = gradient(&varpi);
        let mut cap = Q::combination([(by_log_rate / way.re, &way)]);
        cap.re = varpi.re;
        cap.slope[self.state.pressure_lane()] += self.by_pressure * by_pressure;
        let radius = Q::product(&cap, &self.state.reach(&direction));
        let rows = [0, 1].map(|at| {
            let along = Q::product(&radius, &direction[at]);
            traction(Q::combination([(1.0, &self.z[at]), (-1.0, &along)]))
        });
        (self.status(rate), rows)
    }

    /// The slip rate, and `Z` for a length `|y|` and a direction.
    fn shared(&self, length: &Q, direction: &[Q; 2], r: &Q) -> (f64, Radius) {
        let reach = self.state.reach(direction);
        let kappa_inverse = self.over_slip(direction);
        let mut stiffness = Q::product(r, &kappa_inverse);
        stiffness = Q::combination([(self.past.elapsed, &stiffness)]);
        let found =
            self.state
                .friction
                .creep(self.past, self.pressure, reach.re, stiffness.re, length.re);
        let Creep {
            slip_rate,
            radius,
            by_length,
            by_pressure,
            by_reach,
            by_stiffness,
        } = found;
        let mut at_length = Q::combination([(by_reach, &reach), (by_stiffness, &stiffness)]);
        at_length.slope[self.state.pressure_lane()] += self.by_pressure * by_pressure;
        at_length.re = radius;
        let radius = Radius {
            at_length,
            by_length,
        };
        (slip_rate, radius)
    }

    /// `1/kappa = |w|/|K w|` for a unit vector `w`.
    fn over_slip(&self, w: &[Q; 2]) -> Q {
        let [a, b, c, d] = &self.k_inverse;
        // `K w` is the adjugate of `K^-1` over its determinant, times `w`.
        let difference = |one: [&Q; 2], other: [&Q; 2]| {
            let [one, other] = [one, other].map(|[first, second]| Q::product(first, second));
            Q::combination([(1.0, &one), (-1.0, &other)])
        };
        let determinant = difference([a, d], [b, c]);
        let adjugate = [
            difference([d, &w[0]], [b, &w[1]]),
            difference([a, &w[1]], [c, &w[0]]),
        ];
        let (length, _) = unit(&adjugate).expect("K is regular");
        let ratio = determinant.re.abs() / length.re;
        let slopes = Q::combination([
            (ratio / determinant.re, &determinant),
            (-ratio / length.re, &length),
        ]);
        Q {
            re: ratio,
            ..slopes
        }
    }

    fn status(&self, rate: f64) -> Status {
        let Past { state, elapsed, .. } = self.past;
        let after = self.law.state_after(state, rate, elapsed);
        match rate * after < RESTING * self.law.slip_distance {
            true => Status::Stick,
            false => Status::Slip,
        }
    }
}

/// Length and direction of a vector; `None` without length.
fn unit(v: &[Q; 2]) -> Option<(Q, [Q; 2])> {
    let length = v[0].re.hypot(v[1].re);
    if length == 0.0 {
        return None;
    }
    let direction = [0, 1].map(|at| v[at].re / length);
    let stretch = Q::combination([(direction[0], &v[0]), (direction[1], &v[1])]);
    let unit = [0, 1].map(|at| Q {
        re: direction[at],
        ..Q::combination([(1.0 / length, &v[at]), (-direction[at] / length, &stretch)])
    });
    Some((
        Q {
            re: length,
            ..stretch
        },
        unit,
    ))
}
