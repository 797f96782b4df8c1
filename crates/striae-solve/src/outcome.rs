//! Endings of increments and runs.
//!
//! Longer than other files, as it lists every ending with its message.

use striae_sparse::SolveError;

use crate::norms::Norms;

/// Reason why an increment did not succeed and is repeated with a smaller one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CutBack {
    /// Newton's method ran out of iterations.
    #[error(
        "no convergence in {iterations} iterations ({}: {norms}){}",
        norms.worst(),
        cycling_text(cycling)
    )]
    NoConvergence {
        /// Iterations made.
        iterations: usize,
        /// Last norms.
        norms: Norms,
        /// Contact nodes that kept changing their status.
        cycling: Vec<CyclingNode>,
    },
    /// The residual grew out of bounds.
    #[error("the residual grew to {norms} in iteration {iteration}")]
    Diverged {
        /// Iteration.
        iteration: usize,
        /// Norms.
        norms: Norms,
    },
    /// An element was turned inside out.
    #[error(
        "body `{body}`, {element}; the body is compressed or sheared too much there: reduce its displacement or load, or refine the mesh"
    )]
    InvertedElement {
        /// Name of the body.
        body: String,
        /// Element, and its fault.
        element: striae_element::ElementFault,
    },
    /// A load has no direction.
    #[error("body `{body}`, facet set `{set}`: {error}")]
    Load {
        /// Name of the body.
        body: String,
        /// Facet set.
        set: String,
        /// Error of the load.
        error: striae_model::load::LoadError,
    },
    /// The ends of a spring have met.
    #[error(
        "spring `{spring}`: its ends have met, so that it has no direction any more; give it a fixed direction, or place its ends further apart"
    )]
    Spring {
        /// Name of the spring.
        spring: String,
    },
    /// The surface of a cavity has collapsed, or its gas has no volume.
    #[error(
        "cavity `{cavity}`: a facet of its surface has collapsed, or its gas would have a pressure below zero; change its content in smaller increments"
    )]
    Cavity {
        /// Name of the cavity.
        cavity: String,
    },
    /// A convected texture has no direction left at a node.
    #[error(
        "pair `{pair}`: the texture at {node} of body `{body}`, or opposite to it, has no direction: it has no tangential part any more, or directions around the node cancel, as in a facet with the axis of a radial texture; change the axis or the mesh there"
    )]
    CollapsedTexture {
        /// Name of the pair.
        pair: String,
        /// Name of the body.
        body: String,
        /// The node.
        node: striae_mesh::NodeId,
    },
    /// The surfaces of a pair are folded over each other.
    #[error(
        "pair `{pair}`: its surfaces are folded over each other: the segments between their facets cover more than twice the area of a side"
    )]
    Folded {
        /// Name of the pair.
        pair: String,
    },
    /// A factor of friction is not sound, or its law has failed.
    #[error("pair `{pair}`: {failure}")]
    Factor {
        /// Name of the pair.
        pair: String,
        /// The law and the cause.
        failure: striae_law::friction::FactorFailure,
    },
    /// Nodes outside the contact zone ran into the other side.
    #[error(
        "pair `{pair}`: {} nodes reached the other surface undetected, the first is {node} of body `{body}`",
        count
    )]
    MissedContact {
        /// Name of the pair.
        pair: String,
        /// Name of the body of the first node.
        body: String,
        /// The first node.
        node: striae_mesh::NodeId,
        /// Number of such nodes.
        count: usize,
    },
    /// Bodies have gone through each other.
    #[error("pair `{pair}`: {}", passage_text([body, other], *node, *depth, *is_prescribed))]
    Passage {
        /// Name of the pair.
        pair: String,
        /// Body or rigid surface of the node.
        body: String,
        /// The node, or the nearest one, that is in deepest.
        node: striae_mesh::NodeId,
        /// Name of the body or surface that was passed through.
        other: String,
        /// Depth of the point.
        depth: f64,
        /// Motion of one side relative to the other.
        way: f64,
        /// `true` if the node and the rigid surface are both prescribed.
        is_prescribed: bool,
    },
    /// A body has gone into itself or another one, where no contact kept them apart.
    #[error("{}", overlap_text([body, other], *node, *depth, *is_joined))]
    Overlap {
        /// Name of the body that comes inside.
        body: String,
        /// The node, or one of the facet, that is in deepest.
        node: striae_mesh::NodeId,
        /// Name of the body that it is inside of.
        other: String,
        /// Depth of the point.
        depth: f64,
        /// Position of the point at the start of the increment.
        start: Start,
        /// `true` if the body may touch itself there.
        is_joined: bool,
    },
    /// A body has gone through itself or another one, where no contact kept them apart.
    #[error("{}", crossing_text([body, other], *node, *is_joined))]
    Crossing {
        /// Name of the body that has gone through.
        body: String,
        /// The node, or one of the facet, that has.
        node: striae_mesh::NodeId,
        /// Name of the body that it has gone through.
        other: String,
        /// `true` if the body may touch itself there.
        is_joined: bool,
    },
    /// Friction pushes a node along its slip.
    #[error(
        "pair `{pair}`: friction pushes {node} of `{body}` in the direction of its slip and gains the energy {work:.1e}, {:.0} % of the frictional work at the nodes around it",
        100.0 * share
    )]
    Gain {
        /// Name of the pair.
        pair: String,
        /// Name of the body.
        body: String,
        /// The node.
        node: striae_mesh::NodeId,
        /// Work that it gains in the increment.
        work: f64,
        /// Ratio of this work to the sum of its magnitudes at all nodes of the side.
        share: f64,
    },
    /// A body has jumped.
    #[error(
        "body `{body}` would jump by {way:.3e} against its loads, although no prescribed displacement exceeds {driven:.3e}"
    )]
    Jump {
        /// Name of the body.
        body: String,
        /// Distance that its centre would move.
        way: f64,
        /// The longest way that is prescribed.
        driven: f64,
    },
    /// Nothing holds a body.
    #[error("{motion}; {}", free_text(stabilise))]
    Free {
        /// The body and how it can move.
        motion: Box<FreeMotion>,
        /// Pair whose stabilisation would carry it to contact that holds it.
        stabilise: Option<String>,
    },
    /// Contact that held a body has opened.
    #[error(
        "contact in pair `{pair}` opened and nothing else restrains the bodies: {motion}; prescribe displacements, set `stabilise = true` in pair `{pair}`, or give the step inertia with `dynamics = {{}}`"
    )]
    Released {
        /// Name of the pair.
        pair: String,
        /// The body and how it can move.
        motion: Box<FreeMotion>,
    },
    /// Stabilisation has not carried a body to contact that holds it.
    #[error(
        "{motion} at the end of the step, where stabilisation ends; pair `{pair}` {}",
        gap_text(*gap)
    )]
    NotBridged {
        /// Name of the pair.
        pair: String,
        /// The body and how it can move.
        motion: Box<FreeMotion>,
        /// Smallest gap that is left.
        gap: f64,
    },
    /// Friction does not hold a body against its loads.
    #[error(
        "limit of friction reached: {} of pair `{pair}` slip, {motion}, at the fraction {reached:.4} of the step",
        all_nodes(*sticking)
    )]
    FrictionLimit {
        /// Name of the pair.
        pair: String,
        /// Nodes that stick all the same.
        sticking: usize,
        /// The body and how it can move.
        motion: Box<FreeMotion>,
        /// Fraction of the step that was reached.
        reached: f64,
    },
    /// The loads on a body act beside what it stands on.
    #[error(
        "body `{body}` tips over the edge of its support `{other}`: its loads act outside the touching surfaces of pair `{pair}`, and nothing else restrains it, at the fraction {reached:.4} of the step"
    )]
    Tips {
        /// Name of the body.
        body: String,
        /// Body or rigid surface that it stands on.
        other: String,
        /// Name of the pair.
        pair: String,
        /// Fraction of the step that was reached.
        reached: f64,
    },
    /// Friction cannot hold a body against its loads, wherever it presses.
    #[error(
        "limit of friction reached: the loads on body `{body}` exceed the friction of pair `{pair}` that holds it on `{other}` (its largest coefficient is {largest:.4}), at the fraction {reached:.4} of the step; reduce the load along `{other}`, restrain the body, or give the step inertia with `dynamics = {{}}`"
    )]
    Slides {
        /// Name of the body.
        body: String,
        /// Body or rigid surface that it slides on.
        other: String,
        /// Name of the pair.
        pair: String,
        /// Largest coefficient of friction of the pair.
        largest: f64,
        /// Fraction of the step that was reached.
        reached: f64,
    },
    /// A body has flown off.
    #[error(
        "body `{body}` flies off: {node} would move by {way:.1e}, {times:.0e} times the size of the model. Nothing restrains it, or loads far exceed its stiffness: restrain it by displacements or contact, give the step inertia with `dynamics = {{}}`, or compare loads per area with Young's modulus"
    )]
    Flown {
        /// Name of the body.
        body: String,
        /// The node that flies furthest.
        node: striae_mesh::NodeId,
        /// Distance of the motion.
        way: f64,
        /// Ratio to the size of the undeformed bodies.
        times: f64,
    },
    /// Nothing holds a rigid body, which flies off.
    #[error(
        "rigid body `{rigid}` flies off: it would move by {way:.1e}, {times:.0e} times the size of the model. Nothing restrains it: hold it in its directions, restrain it by contact or springs, or give the step inertia with `dynamics = {{}}` and the body a mass"
    )]
    RigidFlown {
        /// Name of the rigid body.
        rigid: String,
        /// Distance of the motion.
        way: f64,
        /// Ratio to the size of the undeformed bodies.
        times: f64,
    },
    /// The linear system could not be solved.
    #[error("{place}{}", solving(place, error))]
    LinearSystem {
        /// Unknown that is involved.
        place: String,
        /// Error of the solver.
        error: SolveError,
    },
}

/// Position of a point at the start of an increment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Outside, or hardly inside.
    Apart,
    /// Inside already.
    Inside,
}

fn crossing_text([body, other]: [&str; 2], node: striae_mesh::NodeId, is_joined: bool) -> String {
    let through = match body == other {
        true => format!(
            "body `{body}` passes through itself: {node} goes in and comes out on the other side"
        ),
        false => format!("{node} of `{body}` passes through `{other}`"),
    };
    match is_joined {
        true => format!(
            "{through} in the smallest increment; it snaps over there: give the step inertia with `dynamics = {{}}`, or refine the mesh"
        ),
        false => format!("{through}{UNJOINED}"),
    }
}

/// Remedy where nothing keeps bodies apart.
const UNJOINED: &str = ", and no pair joins the surfaces there; let everything touch (`all = true` of `[contact]`), add a pair, or keep them apart";

fn passage_text(
    [body, other]: [&str; 2],
    node: striae_mesh::NodeId,
    depth: f64,
    is_prescribed: bool,
) -> String {
    match is_prescribed {
        true => format!(
            "{node} of `{body}` and `{other}` are both prescribed, and so that they go {depth:.3e} through each other; change one of their motions, or release the node"
        ),
        false => format!(
            "{node} of `{body}` passed through `{other}`, or {depth:.3e} into it, undetected by contact"
        ),
    }
}

fn overlap_text(
    [body, other]: [&str; 2],
    node: striae_mesh::NodeId,
    depth: f64,
    is_joined: bool,
) -> String {
    let through = match body == other {
        true => format!("body `{body}` passes through itself: {node} is {depth:.3e} inside"),
        false => format!("{node} of `{body}` is {depth:.3e} inside `{other}`"),
    };
    match is_joined {
        true => format!("{through}, more than half its facets; refine the mesh there"),
        false => format!("{through}{UNJOINED}"),
    }
}

/// Remedy for a linear system without a solution.
fn solving(place: &str, error: &SolveError) -> String {
    match error {
        SolveError::Singular { .. } if place.contains("traction") => {
            "; displacements, a tie or another pair prescribe how both surfaces move there: prescribe nodes away from the contact surface, or leave the facets around this node out of the pair".to_owned()
        }
        SolveError::Singular { .. } => {
            "; prescribe displacements that restrain it, load it towards the bodies it touches and along them by no more than their friction, or set `stabilise = true` in its pair".to_owned()
        }
        SolveError::NotFinite { .. } => {
            " has a term that is infinite or not a number; check that moduli, sizes and loads are in one system of units, and that all facets there have an area".to_owned()
        }
        SolveError::NotPositiveDefinite { .. } => {
            " has negative stiffness in some motion; use smaller increments, or other material constants".to_owned()
        }
        error => format!(": {error}"),
    }
}

fn all_nodes(sticking: usize) -> String {
    match sticking {
        0 => "all nodes".into(),
        1 => "all nodes except one".into(),
        count => format!("all nodes except {count}"),
    }
}

fn free_text(stabilise: &Option<String>) -> String {
    let hold = "prescribe displacements, or start with contact closed";
    match stabilise {
        None => hold.into(),
        Some(pair) => format!("{hold}, or set `stabilise = true` in pair `{pair}`"),
    }
}

fn gap_text(gap: f64) -> String {
    if gap > 0.0 {
        format!("is {gap:.3e} apart: load the body towards the other side, or restrain it")
    } else {
        "touches, but does not restrain it: prescribe displacements, or give it friction".into()
    }
}

impl CutBack {
    /// Remedy for the failure.
    pub fn remedy(&self) -> Remedy {
        match self {
            Self::Free { .. } => Remedy::None,
            Self::Overlap {
                start: Start::Inside,
                is_joined: false,
                ..
            } => Remedy::None,
            Self::NotBridged { gap, .. } if *gap <= 0.0 => Remedy::None,
            _ => Remedy::SmallerIncrement,
        }
    }
}

/// Remedies for an increment that did not succeed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// A smaller increment.
    SmallerIncrement,
    /// Nothing that a run can do.
    None,
}

/// A body that is free to move.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMotion {
    /// Body or surface that is free to move.
    pub mover: FreeMover,
    /// The motions in words: `along x and about z`, or, of a rigid body, "in `x` and in `rz`".
    pub motions: String,
}

/// Body that is free to move.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FreeMover {
    /// A deformable body of this name.
    Body(String),
    /// A rigid body of this name, with all that is tied to it.
    Rigid(String),
}

impl std::fmt::Display for FreeMotion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let motions = &self.motions;
        match &self.mover {
            FreeMover::Body(name) => {
                write!(
                    f,
                    "body `{name}` is not restrained: it is free to move {motions}"
                )
            }
            FreeMover::Rigid(name) => write!(f, "rigid body `{name}` is free to move {motions}"),
        }
    }
}

/// A contact node that changed its status in the last iterations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CyclingNode {
    /// Name of the pair.
    pub pair: String,
    /// Name of the body.
    pub body: String,
    /// The node.
    pub node: striae_mesh::NodeId,
    /// Status in the last iterations, oldest first: `o`pen, `s`tick or `S`lip.
    pub history: String,
}

fn cycling_text(cycling: &[CyclingNode]) -> String {
    const SHOWN: usize = 4;
    if cycling.is_empty() {
        return String::new();
    }
    let shown: Vec<String> = cycling
        .iter()
        .take(SHOWN)
        .map(|c| format!("{} of `{}` in `{}` {}", c.node, c.body, c.pair, c.history))
        .collect();
    let more = cycling.len().saturating_sub(SHOWN);
    let rest = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    format!(
        "; changing status (o open, s stick, S slip): {}{rest}",
        shown.join(", ")
    )
}

/// Ending of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// All steps were completed.
    Completed,
    /// An increment of the smallest size failed.
    Stopped {
        /// Name of the step.
        step: String,
        /// Time of the last converged state.
        time: f64,
        /// Reason why the last attempt failed.
        reason: CutBack,
    },
    /// The observer asked to stop.
    Interrupted {
        /// Time of the last converged state.
        time: f64,
    },
}

impl std::fmt::Display for Ending {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Ending::Completed => write!(f, "all steps completed"),
            Ending::Stopped { step, time, reason } => {
                write!(f, "step `{step}` stopped at time {time:.6}: {reason}")
            }
            Ending::Interrupted { time } => write!(f, "interrupted at time {time:.6}"),
        }
    }
}
