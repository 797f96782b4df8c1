//! Faults of ties, with their messages.

use striae_mesh::{ElementId, Vec3, place, significant};

/// Reason why a tie cannot hold.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TieFault {
    /// A side is no surface of a body.
    #[error(
        "tie `{tie}`: both sides must be facets of bodies; nodes are tied to a rigid body by its `ties`"
    )]
    Rigid {
        /// The tie.
        tie: String,
    },
    /// Both sides are of one body.
    #[error(
        "tie `{tie}` joins body `{body}` to itself; merge the nodes of the mesh, or mesh its two parts as two bodies"
    )]
    SameBody {
        /// The tie.
        tie: String,
        /// The body.
        body: String,
    },
    /// The sides have nothing in common.
    #[error(
        "tie `{tie}`: the surfaces of `{a}` and `{b}` do not meet; the nearest of their nodes are {distance} apart. Name facets that face each other, move the bodies together, or set `within` to a larger distance",
        distance = significant(*distance, 4))]
    Nothing {
        /// The tie.
        tie: String,
        /// Body of side `a`.
        a: String,
        /// Body of side `b`.
        b: String,
        /// Distance of the nearest nodes.
        distance: f64,
    },
    /// Facets that face each other from too far away.
    #[error(
        "tie `{tie}`: at {} `{a}` and `{b}` are {gap} apart, {:.0} % of the facet size. Repair the meshes, leave these facets out, or set `within` to the largest distance to be tied",
        place(at), 100.0 * share,
        gap = significant(*gap, 4))]
    Apart {
        /// The tie.
        tie: String,
        /// Body of side `a`.
        a: String,
        /// Body of side `b`.
        b: String,
        /// Distance.
        gap: f64,
        /// Distance relative to the facet size.
        share: f64,
        /// Position.
        at: Vec3,
    },
    /// No node is left that could follow.
    #[error(
        "tie `{tie}` holds nothing: {reason}. Refine one of the surfaces, or leave out facets that meet others"
    )]
    Loose {
        /// The tie.
        tie: String,
        /// Reason.
        reason: &'static str,
    },
    /// Areas that neither side can tie in a component.
    #[error(
        "tie `{tie}`: over {:.1} % of its area displacements along {axis} are prescribed on every node of one side, elsewhere on every node of the other side, so nothing could hold the two together along {axis}. Prescribe displacements on one of the two bodies only, or split the tie into one for each of these areas",
        100.0 * share
    )]
    Prescribed {
        /// The tie.
        tie: String,
        /// Component.
        axis: &'static str,
        /// Share of the tied area.
        share: f64,
    },
    /// Ties that follow each other in a circle.
    #[error(
        "ties {} depend on each other in a cycle where they meet, and their equations are redundant; make one of the surfaces finer than the two it meets, or leave the facets at the common edge out of one tie",
        quoted(ties)
    )]
    Circle {
        /// The ties.
        ties: Vec<String>,
    },
    /// Moving nodes would turn an element inside out.
    #[error(
        "tie `{tie}`: moving the nodes of `{body}` by up to {moved} onto the other surface would turn {element} inside out; refine the surfaces where they are curved, or repair the mesh",
        moved = significant(*moved, 4))]
    Inverted {
        /// The tie.
        tie: String,
        /// The body.
        body: String,
        /// Distance that nodes are moved.
        moved: f64,
        /// The first such element.
        element: ElementId,
    },
}

impl TieFault {
    /// Name of the tie, or of the first one.
    pub fn tie(&self) -> &str {
        match self {
            Self::Rigid { tie }
            | Self::SameBody { tie, .. }
            | Self::Nothing { tie, .. }
            | Self::Apart { tie, .. }
            | Self::Loose { tie, .. }
            | Self::Prescribed { tie, .. }
            | Self::Inverted { tie, .. } => tie,
            Self::Circle { ties } => ties.first().map_or("", String::as_str),
        }
    }
}

fn quoted(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}
