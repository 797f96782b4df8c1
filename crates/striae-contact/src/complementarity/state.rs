//! Gap, slip and cap of a kept node over the lanes of its rows.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_surface::scalar::constant3;

use super::{Prescribed, node::ContactNode};
use crate::{
    configuration::Configuration,
    kinematics::{Kinematics, Presence, Pressure},
    quantity::Quantity,
    term::{Lanes, Source, gradient, parts, variable3},
    traction::{Cap, in_frame, on_lanes, push_textures},
    unknown::{Numbering, Unknown},
    unknowns::{NodeResult, Status},
};

/// Number of lanes.
pub(super) const N: usize = 24;
/// A scalar over the lanes.
pub(super) type Q = Quantity<N>;
/// Lane of the gap.
const GAP: usize = 0;
/// Lanes of `du`.
const SLIP: usize = 1;
/// Lanes of the normal.
const NORMAL: usize = 4;
/// Lanes of both tangents.
pub(super) const TANGENTS: usize = 7;
/// Lanes of `p`, `z1`, `z2`.
pub(super) const TRACTION: usize = 13;
/// Lanes of the textures.
const TEXTURES: usize = 16;
/// Lane of the slip rate.
const RATE: usize = 22;
/// Lane of the pressure that bounds friction.
const PRESSURE: usize = 23;

/// Derivative of the gap below which nothing can change it.
const FIXED: f64 = 1e-9;

/// Slip rate at which friction is evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) enum Rate {
    /// The present one.
    Present,
    /// The present one where the slip goes along `y`, else none.
    Along([f64; 2]),
    /// The one at which friction has fallen most.
    Weakest,
}

/// Gap and slip of a node as functions of the unknowns.
pub(super) struct NodeState<'a> {
    /// The node.
    pub(super) node: &'a ContactNode<'a>,
    /// Friction law.
    pub(super) friction: &'a Friction,
    numbering: Numbering,
    prescribed: &'a Prescribed,
    /// `true` where the surface of the node touches itself.
    is_on_itself: bool,
    /// Lanes that the quantities depend on.
    pub(super) lanes: Lanes<'a>,
    /// The gap.
    pub(super) gap: Q,
    /// Components of `du`.
    pub(super) slip: [Q; 2],
    /// Components of `K^-1 du`.
    pub(super) turned: [Q; 2],
    /// `K^-1` over the lanes of the normal and of the textures.
    k_inverse: Matrix3<DualSVec64<9>>,
}

impl<'a> NodeState<'a> {
    /// The state of a node.
    pub(super) fn new(
        configuration: &Configuration,
        node: &'a ContactNode<'a>,
        friction: &'a Friction,
        prescribed: &'a Prescribed,
    ) -> Self {
        let numbering = configuration.pair.numbering();
        let Kinematics { gap, slip, .. } = node.kinematics;
        let [t1, t2] = &node.frame.t;
        let mut lanes = Lanes::default();
        lanes.push(Source::Scalar(&gap.gradient));
        lanes.push(Source::Vector(&slip.jacobian));
        lanes.push(Source::Vector(&node.frame.n.jacobian));
        lanes.push(Source::Vector(&t1.jacobian));
        lanes.push(Source::Vector(&t2.jacobian));
        lanes.push(Source::Unknowns {
            first: numbering.traction(node.side, node.node),
            count: 3,
        });
        push_textures(&mut lanes, node.textures);
        lanes.push(Source::Scalar(&node.rate.gradient));
        lanes.push(match &node.kinematics.pressure {
            Pressure::AtNode => Source::Constant(1),
            Pressure::AtPoints(supported) => Source::Scalar(&supported.mean.gradient),
        });
        // Lanes of the law: normal and textures.
        let normal: Vector3<DualSVec64<9>> = variable3(&node.frame.n.value, 0);
        let textures = on_lanes(node.textures, 3);
        let kernel = friction.kernel(&normal, &textures);
        let (turned, by_surroundings) = parts(&(kernel.k_inverse * constant3(&slip.value)));
        let k_inverse = kernel.k_inverse.map(|component| component.re);
        // `t . v` for a vector `v` that depends on the slip and on the law's lanes.
        let component = |axis: usize, v: &Vec3, by_slip: Vec3| {
            let mut component = Q::constant(node.frame.t[axis].value.dot(v));
            component.depend(SLIP, &by_slip);
            component.depend(TANGENTS + 3 * axis, v);
            component
        };
        let of_slip = [0, 1].map(|axis| component(axis, &slip.value, node.frame.t[axis].value));
        // The law works on `K^-1 du`: in these variables the slip surface is a circle, or a table
        // over one angle.
        let turned = [0, 1].map(|axis| {
            let t = node.frame.t[axis].value;
            let mut component = component(axis, &turned, k_inverse.tr_mul(&t));
            by_surroundings.iter().enumerate().for_each(|(lane, by)| {
                component.slope[of_law(lane)] += t.dot(&Vec3::from(*by));
            });
            component
        });
        Self {
            node,
            friction,
            numbering,
            prescribed,
            is_on_itself: configuration.pair.is_self_contact(),
            lanes,
            gap: Q::variable(gap.value, GAP),
            slip: of_slip,
            turned,
            k_inverse: kernel.k_inverse,
        }
    }

    /// `t_i . K^-1 t_j`.
    pub(super) fn k_inverse(&self, i: usize, j: usize) -> Q {
        let t = [i, j].map(|axis| self.node.frame.t[axis].value);
        let (turned, by_surroundings) = parts(&(self.k_inverse * constant3(&t[1])));
        let mut component = Q::constant(t[0].dot(&turned));
        component.depend(TANGENTS + 3 * i, &turned);
        let k_inverse = self.k_inverse.map(|component| component.re);
        component.depend(TANGENTS + 3 * j, &k_inverse.tr_mul(&t[0]));
        for (lane, by) in by_surroundings.iter().enumerate() {
            component.slope[of_law(lane)] += t[0].dot(&Vec3::from(*by));
        }
        component
    }

    /// Results reported for the node.
    pub(super) fn result(&self) -> NodeResult {
        let ContactNode {
            frame,
            tau,
            kinematics,
            ..
        } = self.node;
        NodeResult {
            gap: match kinematics.presence {
                Presence::Facing | Presence::Apart => kinematics.gap.value,
                Presence::Gone => 0.0,
            },
            pressure: self.bounding_pressure().max(0.0),
            tau: *tau,
            slip: kinematics.seen_slip,
            normal: frame.n.value,
            texture: Vec3::zeros(),
            mean: Vec3::zeros(),
            status: Status::Open,
            closed: match &kinematics.pressure {
                Pressure::AtNode => 1.0,
                Pressure::AtPoints(supported) => supported.closed,
            },
            apart: kinematics.presence != Presence::Facing,
            deviation: 0.0,
        }
    }

    /// The pressure that bounds friction.
    pub(super) fn bounding_pressure(&self) -> f64 {
        let [p, ..] = self.node.unknowns;
        self.node.kinematics.bounding_pressure(p)
    }

    /// Returns whether a free position of the node itself or of a node of the other side changes the
    /// gap. Neighbours on its own side have rows of their own, so their freedom to move does not make
    /// room for one more.
    pub(super) fn is_free(&self) -> bool {
        let reaches = &self.node.kinematics.reaches;
        let position = |first: u32| match self.numbering.unknown(first) {
            Unknown::Position { side, node, .. } => Some((side, node)),
            _ => None,
        };
        let own = (self.node.side, self.node.node);
        let of_own = reaches
            .iter()
            .find(|(first, _)| position(*first) == Some(own));
        reaches.iter().any(|(first, reach)| {
            let Some((side, node)) = position(*first) else {
                return false;
            };
            // A surface that touches itself has one side; what faces the node is pushed the other way.
            let is_opposite = match self.is_on_itself {
                true => of_own.is_some_and(|(_, own)| own.dot(reach) < 0.0),
                false => side != own.0,
            };
            let answers = is_opposite || (side, node) == own;
            answers && self.prescribed.free_slope(side, node, reach).amax() > FIXED
        })
    }

    /// `varpi` at a slip rate.
    pub(super) fn varpi(&self, rate: Rate) -> Q {
        let present = self.node.rate.value;
        let factor = self.node.factor;
        let of_present = factor.map(|factor| &factor.present);
        let (rate, factor) = match rate {
            Rate::Present => (present, of_present),
            Rate::Along(y) => {
                let goes = y[0] * self.turned[0].re + y[1] * self.turned[1].re;
                match goes > 0.0 {
                    true => (present, of_present),
                    false => (0.0, factor.map(|factor| &factor.at_rest)),
                }
            }
            Rate::Weakest => (
                self.friction.weakest_rate().unwrap_or(present),
                factor.map(|factor| &factor.fast),
            ),
        };
        let history = (self.node.accumulated, factor);
        let cap = Cap::new(self.friction, history, self.bounding_pressure(), rate);
        let mut varpi = Q::constant(cap.value);
        varpi.slope[self.pressure_lane()] = cap.by_pressure;
        for (lane, by) in cap.by_surroundings.iter().enumerate() {
            varpi.slope[of_law(lane)] += by;
        }
        if rate == present {
            varpi.slope[RATE] = cap.by_rate;
        }
        varpi
    }

    /// The lane of the pressure that bounds friction.
    pub(super) fn pressure_lane(&self) -> usize {
        match self.node.kinematics.pressure {
            Pressure::AtNode => TRACTION,
            Pressure::AtPoints(_) => PRESSURE,
        }
    }

    /// `rho`, how far `z` reaches over `varpi` in a direction with components along the
    /// tangents.
    pub(super) fn reach(&self, direction: &[Q; 2]) -> Q {
        let friction = self.friction;
        if !friction.turns() {
            return Q::constant(1.0);
        }
        let frame = self.node.frame;
        let components = direction.each_ref().map(|component| component.re);
        // Lanes of the law, then those of the direction.
        let normal: Vector3<DualSVec64<12>> = variable3(&frame.n.value, 0);
        let textures = on_lanes(self.node.textures, 3);
        let vector = variable3(&in_frame(frame, components), 9);
        let reach = friction.kernel(&normal, &textures).reach(&vector);
        let by = gradient(&reach);
        let by_vector = Vec3::new(by[9], by[10], by[11]);
        let by_components = frame.t.each_ref().map(|t| by_vector.dot(&t.value));
        let [first, second] = direction;
        let mut rho = Q::combination([(by_components[0], first), (by_components[1], second)]);
        for (axis, component) in components.iter().enumerate() {
            rho.depend(TANGENTS + 3 * axis, &(by_vector * *component));
        }
        for (lane, by) in by[..9].iter().enumerate() {
            rho.slope[of_law(lane)] += by;
        }
        Q {
            re: reach.re,
            ..rho
        }
    }
}

/// The lane of a normal or texture that is a lane of the law.
fn of_law(lane: usize) -> usize {
    if lane < 3 {
        NORMAL + lane
    } else {
        TEXTURES + lane - 3
    }
}
