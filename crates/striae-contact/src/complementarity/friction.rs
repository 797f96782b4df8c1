//! The tangential rows of a closed node.
//!
//! A node that can slip along one direction `q` only, as prescribed positions forbid the
//! other, has the friction of slip along it; across is only the slip of neighbours, which a
//! plane of symmetry mirrors. With `w = unit(K^-1 q)`, at right angles to `w'`, and
//! `y = w . (z + r_t K^-1 du)`,
//!
//! ```text
//! |y| <= varpi : q . du = 0, w' . z = 0    else z = varpi sign(y) w
//! ```
//!
//! One that cannot slip at all has `z = 0`. One that prescribed motions make slip, along a direction
//! in which it cannot by itself, slips:
//!
//! ```text
//! z = varpi K^-1 du/|K^-1 du|
//! ```
//!
//! Before anything has moved in an increment it has `z = r_t K^-1 du`, which resists in the directions
//! that friction alone holds.
//!
//! If friction falls with the slip rate, it may fall faster with slip than the bodies relax: with
//! `f(d) = F - k d - varpi(d/dt)`, `f'(0)` is positive, and Newton's method goes backwards from
//! rest. Where `varpi` is convex, as in a decay, `f` is concave, and from the right of the solution
//! Newton's method does not turn back. The least friction leads there: a node that sticks, slips
//! and sticks begins with it at every second time. Where `f` is negative throughout there is no
//! slip, and Newton's method goes back and forth about its largest value. A node whose slip goes
//! back and forth sticks, therefore.
//!
//! Longer than other files, as every stage of the iterations tells apart the same mobilities.

use nalgebra::{Matrix2, Vector2};

use super::{
    mobility::Mobility,
    node::{Bound, Iteration},
    state::{N, NodeState, Q, Rate, TRACTION},
};
use crate::{configuration::Configuration, table_1::Corrector, term::Field, unknowns::Status};

/// Tangential row: its field, its residual and its gradient over the lanes.
pub(super) type TangentialRow = (Field, f64, [f64; N]);

/// Status and tangential rows of a closed node with the unknowns `[z1, z2]`, and the friction by
/// which the rows deviate from the law; `r` is the default of `r_t`.
pub(super) fn tangential(
    state: &NodeState,
    configuration: &Configuration,
    [z1, z2]: [f64; 2],
    r: f64,
    iteration: Iteration,
) -> (Status, [TangentialRow; 2], f64) {
    let z = [Q::variable(z1, TRACTION + 1), Q::variable(z2, TRACTION + 2)];
    if state.friction.is_frictionless() {
        // Without friction the rows state `z = 0`, which no status changes.
        return (Status::Slip, z.map(traction), 0.0);
    }
    let along = |r: f64| Rate::Along([0, 1].map(|at| z[at].re + r * state.turned[at].re));
    let rate = match iteration {
        Iteration::Later(linearisation) => along(r * linearisation.slip_weight),
        Iteration::Given if state.node.before.status != Status::Slip => along(r),
        Iteration::First | Iteration::Corrected(_) | Iteration::Given => Rate::Present,
    };
    let lags = matches!(iteration, Iteration::Later(of) if of.bound == Bound::Lagging);
    let varpi_at = |rate| {
        let mut varpi = state.varpi(rate);
        if lags {
            varpi.slope[state.pressure_lane()] = 0.0;
        }
        varpi
    };
    let varpi = varpi_at(rate);
    let node = Friction {
        state,
        mobility: Mobility::new(state),
        size: configuration.size(state.node.side, state.node.node),
        begun: match state.node.before.status {
            // From the right of the solution, at the smallest friction, Newton's method converges
            // monotonically; from rest it may move away.
            Status::Open | Status::Stick if state.node.before.begun % 2 == 1 => {
                varpi_at(Rate::Weakest)
            }
            Status::Open | Status::Stick | Status::Slip => varpi,
        },
        varpi,
        z,
        r,
    };
    let (status, rows) = match iteration {
        Iteration::First => node.first(),
        Iteration::Later(linearisation) => {
            let r = r * linearisation.slip_weight;
            let (status, rows) = node.later(r, None);
            return (status, rows, node.deviation(status, r));
        }
        Iteration::Given => node.later(r, Some(state.node.before.status)),
        Iteration::Corrected(corrector) => node.corrected(r, corrector),
    };
    (status, rows, 0.0)
}

/// Friction at a closed node.
struct Friction<'a> {
    state: &'a NodeState<'a>,
    mobility: Mobility,
    size: f64,
    varpi: Q,
    /// Radius for the row of slip: of the weakest friction where the node begins to slip again.
    begun: Q,
    z: [Q; 2],
    /// The default of `r_t`.
    r: f64,
}

impl Friction<'_> {
    /// In the first iteration: nodes that slipped continue to slip.
    fn first(&self) -> (Status, [TangentialRow; 2]) {
        let [z1, z2] = self.z.map(|z| z.re);
        // Only nodes still near the slip surface continue to slip; one far inside has been
        // unloaded.
        if self.state.node.slipped && z1.hypot(z2) > 0.5 * self.least_radius() {
            (Status::Slip, self.continued())
        } else {
            (Status::Stick, self.stick())
        }
    }

    /// In a later one: `y` decides on the status, and on the rows unless their status is given.
    fn later(&self, r: f64, given: Option<Status>) -> (Status, [TangentialRow; 2]) {
        let before = &self.state.node.before;
        // Only the first time, as the reduced tangent costs quadratic convergence.
        let begins = given.is_none() && before.status != Status::Slip && before.begun == 0;
        let has_slip = |slips: bool| given.map_or(slips, |status| status == Status::Slip);
        let (slips, rows) = match &self.mobility {
            Mobility::Along(way) => {
                let w = &way.of_friction;
                let y = self.along(w, r);
                let way = w.map(|w| Q::combination([(y.re.signum(), &w)]));
                let radius = self.reaching(&self.varpi, &way).re;
                let slips = self.slips(y.re.abs(), radius, way.map(|way| way.re));
                let limit = || self.reaching(&self.begun, &way);
                let rows = || along(w, &self.z, &y, &Radius::given(limit()), begins);
                (slips, has_slip(slips).then(rows))
            }
            Mobility::Driven => {
                let rows = self.driven();
                (rows.is_some(), rows)
            }
            Mobility::Free | Mobility::Held => {
                let y = self.y(r);
                let length = y[0].re.hypot(y[1].re);
                let radius = self.reaching(&self.varpi, &y).re;
                let slips = self.slips(length, radius, y.map(|y| y.re));
                let rows = || {
                    let radius = Radius::given(self.reaching(&self.begun, &y));
                    slip(&self.z, &y, &radius, begins)
                };
                (slips, has_slip(slips).then(rows))
            }
        };
        let status = match slips {
            true => Status::Slip,
            false => Status::Stick,
        };
        (status, self.slip_or_stick(rows).1)
    }

    /// Friction by which the rows of a later iteration deviate from the law: they may have the
    /// radius of the weakest friction, or let a node stick beyond the slip surface.
    fn deviation(&self, status: Status, r: f64) -> f64 {
        if !self.state.friction.weakens() {
            return 0.0;
        }
        let y = match &self.mobility {
            Mobility::Free | Mobility::Held => self.y(r),
            Mobility::Along(way) => {
                let y = self.along(&way.of_friction, r);
                way.of_friction.map(|w| Q::combination([(y.re, &w)]))
            }
            Mobility::Driven => return 0.0,
        };
        let [of_law, of_row] = [&self.varpi, &self.begun].map(|varpi| self.reaching(varpi, &y).re);
        match status {
            Status::Slip => (of_row - of_law).abs(),
            Status::Stick => (y[0].re.hypot(y[1].re) - of_law).max(0.0),
            Status::Open => 0.0,
        }
    }

    /// The corrector decides.
    fn corrected(&self, r: f64, corrector: Corrector) -> (Status, [TangentialRow; 2]) {
        let inflated = Q::combination([(corrector.inflation.factor(), &self.varpi)]);
        let radius = |direction: &[Q; 2]| self.reaching(&inflated, direction);
        let slips = |z: [f64; 2], turned: [f64; 2]| {
            let before = self.state.node.before.status;
            corrector.status(before, z, turned, radius(&self.z).re) == Status::Slip
        };
        let turned = &self.state.turned;
        let rows = match &self.mobility {
            Mobility::Along(way) => {
                let w = &way.of_friction;
                let [z, turned] = [&self.z, turned].map(|v| part(w, v).re);
                slips([z, 0.0], [turned, 0.0]).then(|| {
                    let y = self.along(w, r);
                    let way = w.map(|w| Q::combination([(y.re.signum(), &w)]));
                    along(w, &self.z, &y, &Radius::given(radius(&way)), false)
                })
            }
            Mobility::Driven => self.driven(),
            Mobility::Free | Mobility::Held => {
                let [z, turned] = [&self.z, turned].map(|v| [v[0].re, v[1].re]);
                slips(z, turned).then(|| {
                    let y = self.y(r);
                    slip(&self.z, &y, &Radius::given(radius(&y)), false)
                })
            }
        };
        self.slip_or_stick(rows)
    }

    /// Slip along `du` whatever `z` is; `None` before anything has moved.
    fn driven(&self) -> Option<[TangentialRow; 2]> {
        let turned = &self.state.turned;
        let moves = turned[0].re != 0.0 || turned[1].re != 0.0;
        moves.then(|| {
            let radius = Radius::given(self.reaching(&self.varpi, turned));
            slip(&self.z, turned, &radius, false)
        })
    }

    /// Radius of the slip surface at which slip continues: if friction depends on the slip rate,
    /// `|z|` is that of the rate so far.
    fn continued_radius(&self) -> Q {
        let radius = self.reaching(&self.varpi, &self.z);
        let [z1, z2] = self.z.map(|z| z.re);
        let friction = self.state.friction;
        let share = match friction.depends_on_rate() {
            true if radius.re > 0.0 => (z1.hypot(z2) / radius.re).min(friction.largest_over_rest()),
            _ => 1.0,
        };
        Q::combination([(share, &radius)])
    }

    /// The radius of the slip surface at the slip rate where friction has fallen most.
    fn least_radius(&self) -> f64 {
        let kinetic = self.state.varpi(Rate::Weakest);
        self.reaching(&kinetic, &self.z).re
    }

    /// Returns whether a node slips, from the length of `y` and the radius of the slip surface in
    /// its direction. Where friction falls with the slip rate, a node whose slip reverses or
    /// oscillates sticks first; from then on its static friction decides.
    fn slips(&self, length: f64, radius: f64, y: [f64; 2]) -> bool {
        let [first, second] = &self.state.turned;
        let before = &self.state.node.before;
        // The slip found would be against the direction of friction that it was computed with.
        let around = first.re * y[0] + second.re * y[1] < 0.0;
        let du = self.state.slip[0].re.hypot(self.state.slip[1].re);
        let sticks = self.state.friction.weakens()
            && before.status == Status::Slip
            && (around || before.goes_back_and_forth(du));
        length > radius && !sticks
    }

    /// `varpi rho`, the radius of the slip surface in a direction.
    fn reaching(&self, varpi: &Q, direction: &[Q; 2]) -> Q {
        let reach = self.state.reach(direction);
        Q::product(varpi, &reach)
    }

    fn slip_or_stick(&self, slip: Option<[TangentialRow; 2]>) -> (Status, [TangentialRow; 2]) {
        match slip {
            Some(rows) => (Status::Slip, rows),
            None => (Status::Stick, self.stick()),
        }
    }

    /// `z + r K^-1 du`.
    fn y(&self, r: f64) -> [Q; 2] {
        let turned = &self.state.turned;
        [0, 1].map(|at| Q::combination([(1.0, &self.z[at]), (r, &turned[at])]))
    }

    /// `w . (z + r K^-1 du)`.
    fn along(&self, w: &[Q; 2], r: f64) -> Q {
        let [z, turned] = [&self.z, &self.state.turned].map(|v| part(w, v));
        Q::combination([(1.0, &z), (r, &turned)])
    }

    /// Slip that continues in the direction of `z`: `|z| = varpi rho` and no slip across, or no `z`
    /// across where the node cannot move that way. Where prescribed motions drive it and friction
    /// alone may hold it across, it resists by `r_t`.
    fn continued(&self) -> [TangentialRow; 2] {
        let z = &self.z;
        let radius = self.continued_radius();
        let (_, direction) = polar(Vector2::new(z[0].re, z[1].re));
        let along = Q::combination([(direction.x, &z[0]), (direction.y, &z[1]), (-1.0, &radius)]);
        let across = |v: &[Q; 2]| Q::combination([(direction.x, &v[1]), (-direction.y, &v[0])]);
        let second = match self.mobility {
            Mobility::Free => self.resting(across(&self.state.turned)),
            Mobility::Along(_) | Mobility::Held => traction(across(z)),
            Mobility::Driven => {
                let [z, turned] = [z, &self.state.turned].map(across);
                self.resisting(&z, &turned)
            }
        };
        [traction(along), second]
    }

    /// `du = 0`, with `z = 0` in directions in which the node cannot move. One that prescribed
    /// motions drive has not moved yet, and friction alone may hold it in another direction.
    fn stick(&self) -> [TangentialRow; 2] {
        let slip = &self.state.slip;
        match &self.mobility {
            Mobility::Free => slip.map(|slip| self.resting(slip)),
            Mobility::Along(way) => {
                let resting = part(&way.of_slip, slip);
                [self.resting(resting), across(&way.of_friction, &self.z)]
            }
            Mobility::Held => self.z.map(traction),
            Mobility::Driven => {
                let turned = &self.state.turned;
                [0, 1].map(|at| self.resisting(&self.z[at], &turned[at]))
            }
        }
    }

    /// Friction that grows with slip, for the iteration in which its direction is not known.
    fn resisting(&self, z: &Q, turned: &Q) -> TangentialRow {
        traction(Q::combination([(1.0, z), (-self.r, turned)]))
    }

    /// No slip.
    fn resting(&self, slip: Q) -> TangentialRow {
        // Stick residuals are lengths and are measured by the facet size, not by a pressure.
        (Field::Stick(self.size), slip.re, slip.slope)
    }
}

pub(super) fn traction(value: Q) -> TangentialRow {
    (Field::Traction, value.re, value.slope)
}

/// `q . v`.
pub(super) fn part(q: &[Q; 2], v: &[Q; 2]) -> Q {
    let [first, second] = [0, 1].map(|at| Q::product(&q[at], &v[at]));
    Q::combination([(1.0, &first), (1.0, &second)])
}

/// No `z` across the unit vector `w`.
fn across(w: &[Q; 2], z: &[Q; 2]) -> TangentialRow {
    let [first, second] = w;
    let across = [Q::combination([(-1.0, second)]), *first];
    traction(part(&across, z))
}

/// Radius of the slip surface.
pub(super) struct Radius {
    /// At a given length of `y`.
    pub(super) at_length: Q,
    /// Derivative by that length.
    pub(super) by_length: f64,
}

impl Radius {
    /// A radius that does not depend on the length of `y`.
    fn given(at_length: Q) -> Self {
        Self {
            at_length,
            by_length: 0.0,
        }
    }
}

/// `z = radius sign(y) w`: [`slip`] along the unit vector `w`, with its Jacobian that does not
/// let a node whose slip turns around jump from one side of the slip surface to the other.
pub(super) fn along(
    w: &[Q; 2],
    z: &[Q; 2],
    y: &Q,
    limit: &Radius,
    begins: bool,
) -> [TangentialRow; 2] {
    let zw = part(w, z);
    let Radius {
        at_length: limit,
        by_length,
    } = limit;
    let (sign, radius) = (y.re.signum(), limit.re);
    let reduced = reduction(zw.re.abs(), zw.re * sign, radius, begins);
    let m = match y.re == 0.0 {
        // The limit of the quotient.
        true => *by_length,
        false => (1.0 - reduced) * radius / y.re.abs() + reduced * by_length,
    };
    let row = Q::combination([(1.0, &zw), (-m, y), (-sign, limit)]);
    let residual = zw.re - radius * sign;
    [(Field::Traction, residual, row.slope), across(w, z)]
}

/// The smallest part of the tangent that a node keeps which begins to slip for the
/// first time in an increment, over `varpi/|y|`: a
/// body that friction alone holds would have no stiffness sideways when all its nodes begin at
/// once.
const BEGINNING: f64 = 0.3;

/// Length and direction of a vector, which may be so short that the square of its length is zero:
/// what opens is left with tractions that fade away.
fn polar(v: Vector2<f64>) -> (f64, Vector2<f64>) {
    let length = v.x.hypot(v.y);
    (length, v / length)
}

/// `f beta` for `|z|` and its part along `y`, by which the tangent of a node is reduced along `y`.
fn reduction(length: f64, along: f64, radius: f64, begins: bool) -> f64 {
    // The last bound avoids 0/0 at a node that has neither traction nor friction.
    let f = along / radius.max(length).max(f64::MIN_POSITIVE);
    let whole = f * damping(length, along, radius);
    match begins {
        // A body held by friction alone would lose all tangential stiffness when all its nodes
        // begin to slip in one iteration.
        true => whole.min(1.0 - BEGINNING),
        false => whole,
    }
}

/// `beta`, by which the Jacobian is damped where `z` points against `y`.
fn damping(length: f64, along: f64, radius: f64) -> f64 {
    let alpha = if length > 0.0 { along / length } else { 0.0 };
    let delta = if radius > 0.0 {
        (length / radius).min(1.0)
    } else {
        1.0
    };
    // Traction against the slip direction may make the undamped Jacobian indefinite.
    if alpha < 0.0 {
        1.0 / (1.0 - alpha * delta)
    } else {
        1.0
    }
}

/// `z = radius y/|y|`, with `beta F` of [`super`] and `M = radius/|y| (I - beta F) + radius' beta F`.
pub(super) fn slip(z: &[Q; 2], y: &[Q; 2], limit: &Radius, begins: bool) -> [TangentialRow; 2] {
    let Radius {
        at_length: limit,
        by_length,
    } = limit;
    let zv = Vector2::new(z[0].re, z[1].re);
    let yv = Vector2::new(y[0].re, y[1].re);
    let (length, direction) = polar(yv);
    let radius = limit.re;
    // `F = z y/(..)` reduces the tangent along `z`; at the solution `z` is along `y`.
    let reduced = reduction(zv.norm(), zv.dot(&direction), radius, begins);
    let along = zv.dot(&direction);
    let f = match along == 0.0 {
        // The quotient below would be 0/0.
        true => Matrix2::zeros(),
        false => zv * direction.transpose() * (reduced / along),
    };
    let m = (Matrix2::identity() - f) * (radius / length) + f * *by_length;
    [0, 1].map(|at| {
        let row = Q::combination([
            (1.0, &z[at]),
            (-m[(at, 0)], &y[0]),
            (-m[(at, 1)], &y[1]),
            (-direction[at], limit),
        ]);
        let residual = zv[at] - radius * direction[at];
        (Field::Traction, residual, row.slope)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fades_away_has_a_direction() {
        for size in [1.0, 1e-200, 4e-309] {
            let (length, direction) = polar(Vector2::new(3.0, -4.0) * size);
            assert!((length / size - 5.0).abs() < 1e-6, "{length}");
            assert!((direction - Vector2::new(0.6, -0.8)).norm() < 1e-6);
        }
        let [z, y] = [1e-309, -1e-309].map(|z| [Q::constant(z), Q::constant(-0.5 * z)]);
        for (_, residual, row) in slip(&z, &y, &Radius::given(Q::constant(2e-310)), false) {
            assert!(residual.is_finite() && row.iter().all(|slope| slope.is_finite()));
        }
    }
}
