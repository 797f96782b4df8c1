//! The directions in which a closed node can slip.
//!
//! If friction is determined along one direction `q` only (see [`crate::directions`]), a node slips
//! along it, and `z` points along `w = unit(K^-1 q)`.

use super::state::{NodeState, Q};
use crate::slip_freedom::SlipFreedom;

/// In which directions a node can slip.
pub(super) enum Mobility {
    /// In all.
    Free,
    /// Along one direction and back.
    Along(Box<Way>),
    /// In none.
    Held,
    /// In none by itself, but it is made to slip.
    Driven,
}

/// The only way that a node can go, in components along the tangents.
pub(super) struct Way {
    /// `q`.
    pub(super) of_slip: [Q; 2],
    /// The direction of `z` where it slips along `q`, the unit vector of `K^-1 q`.
    pub(super) of_friction: [Q; 2],
}

impl Mobility {
    /// Mobility of a node, from the directions in which its friction is determined.
    pub(super) fn new(state: &NodeState) -> Self {
        match state.node.freedom {
            SlipFreedom::Plane => Self::Free,
            SlipFreedom::Line(direction) => {
                let of_slip = direction.map(Q::constant);
                let of_friction = of_friction(state, &of_slip);
                Self::Along(Box::new(Way {
                    of_slip,
                    of_friction,
                }))
            }
            SlipFreedom::Held => Self::Held,
            SlipFreedom::Driven => Self::Driven,
        }
    }
}

/// Unit vector of `K^-1 q`.
fn of_friction(state: &NodeState, q: &[Q; 2]) -> [Q; 2] {
    let v = [0, 1].map(|i| {
        let [first, second] = [0, 1].map(|j| Q::product(&state.k_inverse(i, j), &q[j]));
        Q::combination([(1.0, &first), (1.0, &second)])
    });
    let length = v[0].re.hypot(v[1].re);
    let unit = [0, 1].map(|i| v[i].re / length);
    let stretch = Q::combination([(unit[0], &v[0]), (unit[1], &v[1])]);
    [0, 1].map(|i| Q {
        re: unit[i],
        ..Q::combination([(1.0 / length, &v[i]), (-unit[i] / length, &stretch)])
    })
}
