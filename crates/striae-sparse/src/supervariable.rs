//! Groups of unknowns, and the order in which they are eliminated.

/// Position of a group of unknowns in a [`Structure`](crate::Structure).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Supervariable(pub usize);

/// Ordering class: everything in a lower tier is eliminated before a higher one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Tier(pub u32);
