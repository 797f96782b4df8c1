//! Pair-local numbering of the unknowns of one contact pair.
//!
//! ```text
//! positions of side a | positions of side b | tractions of a | tractions of b
//! 3 a node            | 3 a node            | (p, z1, z2)    | (p, z1, z2)
//! ```
//!
//! A rigid side `b` has no unknowns.

use std::collections::BTreeMap;

use crate::side::Side;
use nalgebra::Matrix3;
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

/// Prescribed positions of the nodes of both sides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Prescribed {
    /// `true` for prescribed components, three a node, by side.
    pub components: [Vec<bool>; 2],
    /// Axes of the components in columns, of nodes where they are not the coordinate axes.
    pub axes: [BTreeMap<usize, Matrix3<f64>>; 2],
}

impl Prescribed {
    /// Slope of a quantity by the position of a node along its axes, where that is free; zero
    /// where it is prescribed.
    pub fn free_slope(&self, side: Side, node: SurfaceNode, slope: &Vec3) -> Vec3 {
        let along = match self.axes[side].get(&node.index()) {
            Some(axes) => axes.tr_mul(slope),
            None => *slope,
        };
        let held = &self.components[side][3 * node.index()..3 * node.index() + 3];
        Vec3::from_fn(|axis, _| if held[axis] { 0.0 } else { along[axis] })
    }
}

/// Derivatives of a vector: `(first unknown of a triple, d vector / d triple)`. Unknowns of
/// contact come in triples: positions and tractions.
pub type Jacobian = Vec<(u32, Matrix3<f64>)>;

/// Derivatives of a scalar: `(first unknown of a triple, d scalar / d triple)`.
pub type Gradient = Vec<(u32, Vec3)>;

/// Numbers of the unknowns of one contact pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numbering {
    nodes: [u32; 2],
}

/// Kind of a pair-local unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// Component of the position of a surface node.
    Position {
        /// Side of the pair.
        side: Side,
        /// Surface-local node.
        node: SurfaceNode,
        /// Component.
        axis: usize,
    },
    /// Traction unknown of a surface node: pressure, then two tangential components.
    Traction {
        /// Side of the pair.
        side: Side,
        /// Surface-local node.
        node: SurfaceNode,
        /// `0`: pressure, `1`, `2`: along the nodal tangents.
        component: usize,
    },
}

impl Numbering {
    /// Numbers for sides with so many nodes that move and may bear traction.
    pub fn new(nodes: [usize; 2]) -> Self {
        Self {
            nodes: nodes.map(|count| count as u32),
        }
    }

    /// First of the three position unknowns of a node.
    pub fn position(&self, side: Side, node: SurfaceNode) -> u32 {
        3 * (node.0 + self.before(side))
    }

    /// First of the three traction unknowns of a node.
    pub fn traction(&self, side: Side, node: SurfaceNode) -> u32 {
        3 * (self.nodes[0] + self.nodes[1]) + self.position(side, node)
    }

    /// Number of nodes of the sides before this one.
    fn before(&self, side: Side) -> u32 {
        match side {
            Side::A => 0,
            Side::B => self.nodes[0],
        }
    }

    /// Number of all unknowns.
    pub fn count(&self) -> u32 {
        6 * (self.nodes[0] + self.nodes[1])
    }

    /// Returns the kind of the unknown `number`.
    pub fn unknown(&self, number: u32) -> Unknown {
        let count = self.nodes[0] + self.nodes[1];
        let traction = number >= 3 * count;
        let within = if traction { number - 3 * count } else { number };
        let (node, component) = (within / 3, (within % 3) as usize);
        let side = if node < self.nodes[0] {
            Side::A
        } else {
            Side::B
        };
        let node = SurfaceNode(node - self.before(side));
        if traction {
            Unknown::Traction {
                side,
                node,
                component,
            }
        } else {
            Unknown::Position {
                side,
                node,
                axis: component,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_meanings_agree() {
        let numbering = Numbering::new([4, 3]);
        assert_eq!(
            numbering.unknown(numbering.position(Side::B, SurfaceNode(2)) + 1),
            Unknown::Position {
                side: Side::B,
                node: SurfaceNode(2),
                axis: 1
            }
        );
        assert_eq!(
            numbering.unknown(numbering.traction(Side::A, SurfaceNode(3)) + 2),
            Unknown::Traction {
                side: Side::A,
                node: SurfaceNode(3),
                component: 2
            }
        );
    }
}
