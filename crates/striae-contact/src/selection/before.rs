//! What nodes are before the roles of an increment are chosen.

use crate::tip::RigidPoints;

/// Nodes that were kept, by side.
pub type Kept = [Vec<bool>; 2];

/// What nodes are before the roles of an increment are chosen.
#[derive(Clone, Copy, Debug)]
pub struct Before<'a> {
    /// Nodes that were kept in the last increment.
    pub kept: &'a Kept,
    /// Nodes that are kept in this one whatever their pivots.
    pub required: &'a Kept,
    /// Nodes that are [pointed](crate::pointed) in this one.
    pub pointed: &'a Kept,
    /// The same of points of a rigid side; may be empty.
    pub points: &'a RigidPoints,
}
