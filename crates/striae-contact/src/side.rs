//! The two sides of a pair.

use std::{
    fmt,
    ops::{Index, IndexMut},
};

use serde::{Deserialize, Serialize};

/// One of the two sides of a contact pair or of a tie. Arrays with an entry for each side are
/// indexed by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Side {
    /// Side `a`: the deformable one where one is rigid.
    A,
    /// Side `b`.
    B,
}

impl Side {
    /// Both sides in their order.
    pub const BOTH: [Self; 2] = [Self::A, Self::B];

    /// The other side.
    pub fn opposite(self) -> Self {
        match self {
            Self::A => Self::B,
            Self::B => Self::A,
        }
    }

    /// Its place in lists with an entry for each side: 0 for `a`, 1 for `b`.
    pub fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(["a", "b"][*self])
    }
}

impl<T> Index<Side> for [T; 2] {
    type Output = T;

    fn index(&self, side: Side) -> &T {
        &self[side.index()]
    }
}

impl<T> IndexMut<Side> for [T; 2] {
    fn index_mut(&mut self, side: Side) -> &mut T {
        &mut self[side.index()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_are_each_other_s_opposite() {
        for side in Side::BOTH {
            assert_eq!(side.opposite().opposite(), side);
            assert_eq!(side.index() + side.opposite().index(), 1);
            assert_eq!(Side::BOTH[side], side);
        }
    }
}
