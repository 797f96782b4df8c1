//! Pointed nodes and points: edges and corners that pierce a face between its nodes.
//!
//! Weighted rows take the mean gap over the facets around a node, which stays positive
//! while an edge between two tilted facets is already inside the other body. Such a node
//! gets unknowns `(p, z1, z2)` of its own, whose traction is concentrated there. With the
//! unit normal `m` of the facet that it pierces (from the diagonals, `n = -m`), the shape
//! functions `N_J` of that facet at the projection and the area `w = h^2` of the node at the
//! start of the increment
//!
//! ```text
//! sum_J N_J x_J - x_I - g n = 0
//! du  = (I - n n)(x_I - xbar)
//! f_I = w (-p n + tau),   f_J = -N_J f_I
//! ```
//!
//! `xbar` is the material point that was opposite at the start. Row and force are adjoint on
//! plane facets, and forces of the two sides balance to round-off. Complementarity and
//! friction are those of all kept nodes, with the stiffness `1/(h_a/E_a + h_b/E_b)`.
//!
//! The same holds for *points* of a rigid surface: its vertices, and points on its convex
//! edges. They have no positions to solve for; their tractions lodge with the
//! corner of the pierced facet that is nearest and free, and `h` is the size there. Their `n`
//! is continuous over facets, see [`Spot`].
//!
//! What is pointed is chosen in [`choice`].

use crate::{
    collocated,
    configuration::Configuration,
    frame::Frame,
    kinematics::{Kinematics, Presence},
    selection::Selection,
    spot::Spot,
    term::Gradient,
    tracked::{Tracked, TrackedScalar},
};

pub mod choice;
mod force;
mod ridge;

pub use choice::{Pierced, Progress, pierced, staying};
pub use force::{PointedTerm, terms};
pub use ridge::Bend;

/// Gap and slip of a pointed node in the place `k` among the kept nodes.
pub fn kinematics(
    configuration: &Configuration,
    selection: &Selection,
    k: usize,
    frame: Option<&Frame>,
) -> Kinematics {
    let (side, node) = selection.kept()[k].place();
    let tip = selection.tip(side, node);
    let gap = match Spot::new(configuration, tip) {
        Some(spot) => TrackedScalar {
            value: spot.gap.value + tip.left(),
            ..spot.gap
        },
        // It is open where it sees nothing.
        None => TrackedScalar {
            value: f64::INFINITY,
            gradient: Gradient::new(),
        },
    };
    let slip = match (selection.partner(k), frame) {
        (Some(partner), Some(frame)) => collocated::slip(configuration, tip, partner, frame),
        _ => Tracked::default(),
    };
    Kinematics {
        reaches: Default::default(),
        pressure: Default::default(),
        gap,
        shares: collocated::shares(configuration, tip, selection.partner(k)),
        seen_slip: slip.value,
        slip,
        presence: Presence::Facing,
        stiffness: selection.stiffness(k),
    }
}
