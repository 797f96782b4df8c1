//! Typed identifiers, so that a node cannot be mistaken for an element.

use std::fmt;

macro_rules! id {
    ($name:ident, $doc:literal, $word:literal) => {
        #[doc = $doc]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
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
id!(ElementId, "A hexahedral element of one mesh.", "element");
id!(FacetId, "A facet of one surface.", "facet");

/// One of the six faces of a hexahedral element.
///
/// Local face numbers and the corners of each face, ordered so that the normal
/// by the right-hand rule points out of the element, are in [`Face::CORNERS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Face {
    /// The element that owns the face.
    pub element: ElementId,
    /// Local number of the face, `0..6`.
    pub side: u8,
}

impl Face {
    /// Local corners of the six faces, outward by the right-hand rule; the
    /// element's corners are numbered as VTK's hexahedron (bottom face
    /// `0 1 2 3` counter-clockwise seen from the top, then the top face).
    /// Sides: `0` = -zeta, `1` = +zeta, `2` = -eta, `3` = +xi, `4` = +eta, `5` = -xi.
    pub const CORNERS: [[usize; 4]; 6] = [
        [0, 3, 2, 1],
        [4, 5, 6, 7],
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
    ];
}

impl fmt::Display for Face {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "side {} of {}", self.side, self.element)
    }
}
