//! Gap and slip of the kept nodes, with their derivatives by all unknowns.

use striae_mesh::Vec3;

use crate::tracked::{Tracked, TrackedScalar};

/// What contact and friction at a kept node depend on.
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
    /// Whether any segment of the present configuration bears on the node.
    pub presence: Presence,
    /// Pressure per gap and friction per slip, `[r_n, r_t]`, that scale the complementarity.
    pub stiffness: [f64; 2],
}

/// Whether a node faces the other side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Presence {
    /// It does.
    #[default]
    Facing,
    /// It has left the other side in this increment.
    Gone,
}

/// What is reported of a node, kept or not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Gap.
    pub gap: f64,
    /// Slip.
    pub slip: Vec3,
    /// Area that belongs to the node, `integral N da`.
    pub area: f64,
}
