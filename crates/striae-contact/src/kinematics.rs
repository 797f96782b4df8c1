//! Gap and slip of the kept nodes, with their derivatives by all unknowns.

use striae_mesh::Vec3;

use crate::{
    tracked::{Tracked, TrackedScalar},
    unknown::Gradient,
};

/// Kinematic quantities that contact and friction at a kept node depend on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kinematics {
    /// Gap, positive when open.
    pub gap: TrackedScalar,
    /// Slip `du` of the node's own side relative to the other since the last converged
    /// configuration, in the tangent plane of the node.
    pub slip: Tracked,
    /// The slip without what the ramp adds, for reports.
    pub seen_slip: Vec3,
    /// Shares of nodes in the friction of the node, by their first position unknown, over its
    /// weight: what its slip is adjoint to.
    pub shares: Vec<(u32, f64)>,
    /// Derivative of the mean gap over the support by the positions of nodes, whether or not
    /// points of it are open.
    pub reaches: Gradient,
    /// Presence of segments that contribute to the node in the present configuration.
    pub presence: Presence,
    /// Law that determines its pressure.
    pub pressure: Pressure,
    /// Pressure per gap and friction per slip, `[r_n, r_t]`, that scale the complementarity.
    pub stiffness: [f64; 2],
}

/// Law that determines the pressure of a node.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Pressure {
    /// By the sign of the augmented pressure `p - r_n g` at the node.
    #[default]
    AtNode,
    /// At the points of its support.
    AtPoints(Supported),
}

/// The support of a node whose pressure is decided at points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Supported {
    /// `w_k = integral phi_k`, of the present configuration.
    pub weight: TrackedScalar,
    /// Share of the support that is closed at the full bedding.
    pub closed: f64,
    /// `true` if any point is closed.
    pub touches: bool,
    /// `r_k`.
    pub bedding: f64,
    /// Mean pressure over the support, `P^_k = p_k + r_k (E p)_k/w_k`.
    pub mean: TrackedScalar,
}

impl Kinematics {
    /// `integral phi_k` over which the slip is a mean: of the present configuration where pressure
    /// is decided at points, else that at the start of the increment.
    pub fn slip_weight(&self, start: f64) -> f64 {
        match &self.pressure {
            Pressure::AtNode => start,
            Pressure::AtPoints(supported) => supported.weight.value,
        }
    }

    /// The pressure that bounds friction at the node, which has the unknown `p`; not positive
    /// where it is open. Where no point is closed the mean is zero up to round-off.
    pub fn bounding_pressure(&self, p: f64) -> f64 {
        match &self.pressure {
            Pressure::AtNode => p,
            Pressure::AtPoints(supported) if supported.touches => supported.mean.value,
            Pressure::AtPoints(supported) => supported.mean.value.min(0.0),
        }
    }
}

/// Presence of the other side at a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Presence {
    /// The node faces the other side.
    #[default]
    Facing,
    /// The node faces the other side, but no point of its support is closed and nothing else gives
    /// it pressure.
    Apart,
    /// The node has left the other side in this increment.
    Gone,
}

/// Values reported for a node, kept or not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Gap.
    pub gap: f64,
    /// Slip.
    pub slip: Vec3,
    /// Area that belongs to the node, `integral N da`.
    pub area: f64,
}
