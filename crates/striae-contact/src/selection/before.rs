//! What nodes are before the roles of an increment are chosen.

/// Nodes that were kept, by side.
pub type Kept = [Vec<bool>; 2];

/// What nodes are before the roles of an increment are chosen.
#[derive(Clone, Copy, Debug)]
pub struct Before<'a> {
    /// Nodes that were kept in the last increment.
    pub kept: &'a Kept,
    /// Nodes that are kept in this one whatever their pivots.
    pub required: &'a Kept,
}
