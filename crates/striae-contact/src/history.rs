//! History that friction of a kept node goes by: slip and states up to the start of the increment.
//!
//! A place of contact has two surfaces, each with a history of its own. Friction goes by that of
//! the surface which has slipped farther,
//!
//! ```text
//! s = max(s_k, s_o),   s_o = sum_J D_kJ s_J / sum_J D_kJ   over the nodes J of the other side
//! ```
//!
//! and by its states, so that it does not depend on which side keeps nodes: a pin that slides along
//! a track takes its history with it. Of surfaces that have slipped as far, that of the kept node
//! counts.

use striae_surface::node::SurfaceNode;

use crate::{selection::Selection, side::Side, unknowns::Tractions};

/// History of a kept node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History<'a> {
    /// Slip up to the last converged state.
    pub slip: f64,
    /// The kept node.
    node: (Side, SurfaceNode),
    /// Nodes of the other side with their shares, if its history counts.
    opposite: &'a [(Side, SurfaceNode, f64)],
}

impl<'a> History<'a> {
    /// History of a kept node by its place among them.
    pub(crate) fn new(selection: &'a Selection, tractions: &Tractions, k: usize) -> Self {
        let node = selection.kept()[k].place();
        let slip = |(side, node): (Side, SurfaceNode)| tractions.accumulated[side][node];
        let own = Self {
            slip: slip(node),
            node,
            opposite: &[],
        };
        let other = Self {
            opposite: &selection.basis.opposite[k],
            ..own
        };
        let other = Self {
            slip: other.of(slip),
            ..other
        };
        match other.slip > own.slip {
            true => other,
            false => own,
        }
    }

    /// Value of the surface whose history counts, of values at its nodes.
    pub(crate) fn of(&self, value: impl Fn((Side, SurfaceNode)) -> f64) -> f64 {
        match self.opposite {
            [] => value(self.node),
            nodes => {
                let parts = nodes.iter();
                let parts = parts.map(|&(side, node, share)| share * value((side, node)));
                parts.sum()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_the_other_side_are_means() {
        let [a, b] = [0, 1].map(SurfaceNode::new);
        let opposite = [(Side::B, a, 0.25), (Side::B, b, 0.75)];
        let mut history = History {
            slip: 0.0,
            node: (Side::A, a),
            opposite: &opposite,
        };
        let value =
            |(side, node): (Side, SurfaceNode)| 10.0 * side.index() as f64 + node.index() as f64;
        assert_eq!(history.of(value), 10.75);
        history.opposite = &[];
        assert_eq!(history.of(value), 0.0);
    }
}
