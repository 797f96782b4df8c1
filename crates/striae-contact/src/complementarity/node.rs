//! Inputs of the rows of a kept node.

use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    factors::NodeFactor, frame::Frame, kinematics::Kinematics, segment::Derivatives, side::Side,
    slip_freedom::SlipFreedom, table_1::Corrector, texture::NodeTextures, tracked::TrackedScalar,
    unknown::Prescribed, unknowns::Label,
};

/// Stage of the iterations of an increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Iteration {
    /// The first: touching nodes are closed; closed nodes stick or, if they slipped before,
    /// continue to slip in their direction.
    First,
    /// A later one: the state decides.
    Later(Linearisation),
    /// A later one: the labels of the nodes decide.
    Corrected(Corrector),
    /// In a state whose contact is given: nodes have the statuses of their labels.
    Given,
}

impl Iteration {
    /// A later iteration of Newton's method.
    pub const LATER: Self = Self::Later(Linearisation::NEWTON);

    /// The iteration with a number, counted from 1, after the first one.
    ///
    /// First contact has no length scale, so that cycles of stick and slip do not end with smaller
    /// increments. Nearly all come from pressures that change with friction: with given bounds of
    /// friction, stick and slip have one solution. So the bounds lag for some iterations.
    pub fn later(number: usize) -> Self {
        let (slip_weight, bound) = match number {
            0..=13 => (1.0, Bound::Coupled),
            14..=26 => (10.0, Bound::Lagging),
            _ => (10.0, Bound::Coupled),
        };
        Self::Later(Linearisation { slip_weight, bound })
    }

    /// Linearisation of the slip rows.
    pub(super) fn linearisation(self) -> Linearisation {
        match self {
            Self::Later(linearisation) => linearisation,
            Self::First | Self::Corrected(_) | Self::Given => Linearisation::NEWTON,
        }
    }
}

/// Linearisation of the slip rows, which decides how the solution is found, not which one it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearisation {
    /// `r_t` over its default.
    pub slip_weight: f64,
    /// Bound of friction.
    pub bound: Bound,
}

impl Linearisation {
    /// Newton's method.
    pub const NEWTON: Self = Self {
        slip_weight: 1.0,
        bound: Bound::Coupled,
    };
}

/// Bound of friction in an iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Bound that follows the pressures of the iteration.
    Coupled,
    /// Bound of the pressures before.
    Lagging,
}

/// Conditions under which a pair is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Conditions<'a> {
    /// Friction law of the step.
    pub friction: &'a Friction,
    /// Prescribed positions.
    pub prescribed: &'a Prescribed,
    /// Stage of the iteration.
    pub iteration: Iteration,
    /// Nodes whose rows are wanted with derivatives, by side; of all without.
    pub wanted: Option<&'a [Vec<bool>; 2]>,
}

/// A kept node with all that its rows need.
#[derive(Clone, Debug)]
pub struct ContactNode<'a> {
    /// Side of the pair.
    pub side: Side,
    /// Surface-local node.
    pub node: SurfaceNode,
    /// Gap and slip.
    pub kinematics: &'a Kinematics,
    /// Nodal frame.
    pub frame: &'a Frame,
    /// Textures of both sides at the node.
    pub textures: &'a NodeTextures,
    /// Slip rate, if friction depends on it.
    pub rate: &'a TrackedScalar,
    /// `true` if the node slipped in the last converged increment.
    pub slipped: bool,
    /// Slip that its friction goes by, up to the last converged state.
    pub accumulated: f64,
    /// State that its friction goes by, at the last converged state.
    pub friction_state: f64,
    /// Factors of its friction, if the law has some.
    pub factor: Option<&'a NodeFactor>,
    /// In which directions its friction is determined.
    pub freedom: SlipFreedom,
    /// Label from the previous iterations.
    pub before: Label,
    /// `p`, `z1`, `z2`.
    pub unknowns: [f64; 3],
    /// Friction traction `tau`.
    pub tau: Vec3,
    /// Request for derivatives of the rows.
    pub derivatives: Derivatives,
}
