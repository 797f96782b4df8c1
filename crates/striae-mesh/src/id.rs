//! Typed identifiers, so that a node cannot be mistaken for an element.

use serde::{Deserialize, Serialize};
use std::fmt;

macro_rules! id {
    ($name:ident, $doc:literal, $word:literal) => {
        #[doc = $doc]
        #[derive(
            Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
        )]
        pub struct $name(pub u32);

        impl $name {
            /// The id of the item at position `index`.
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("more than 2^32 items in a mesh"))
            }

            /// The position of the item in its list.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!($word, " {}"), self.0)
            }
        }
    };
}

id!(NodeId, "A node of one mesh.", "node");
id!(ElementId, "An element of one mesh.", "element");
id!(FacetId, "A facet of one surface.", "facet");

/// A face of an element: a triangle or a quadrilateral.
///
/// Local face numbers and the corners of each face, ordered so that the normal
/// by the right-hand rule points out of the element, are in
/// [`CellShape::faces`](crate::CellShape::faces).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct Face {
    /// The element that owns the face.
    pub element: ElementId,
    /// Local number of the face.
    pub side: u8,
}

impl fmt::Display for Face {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "side {} of {}", self.side, self.element)
    }
}
