//! Gaps and overlaps of the pairs of a model before anything has moved.
//!
//! Overlaps of more than two hundredths of the local facet size are a [`fault`] unless
//! the pair says what to make of them: [`close`] moves the nodes of the smaller side to
//! the other one, without strain, as it is the reference mesh that changes; [`Offsets`] let
//! overlaps fade over the first step.

mod close;
mod crowd;
mod facing;
mod offsets;
mod reach;
mod surfaces;
mod translation;

use striae_contact::{
    configuration::Configuration,
    initial::{Fit, Lies, fit},
    interference::{Stage, Standing, nearest_of},
    opposite::Opposite,
    placement::Placement,
    seating::Seating,
    side::Side,
};
use striae_mesh::{ElementId, NodeId, Vec3};
use striae_surface::node::SurfaceNode;

use crate::{
    interference::thickness_with,
    model::{ContactSurface, Initial, Model, PairId},
    problem::{PairGeometry, add_fibres, pair_geometry},
};

pub use close::close;
pub use crowd::opposite;
pub use facing::{Turned, turned};
pub use offsets::{Offsets, meant_depth};
pub use reach::may_meet;
pub use surfaces::surfaces;

/// Overlap over the local facet size that is no fault of the mesh.
pub(crate) const LARGEST_OVERLAP: f64 = 0.02;
/// Overlap over the local facet size that is round-off.
pub const ROUND_OFF: f64 = 1e-9;

/// What cannot be simulated as meshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InitialFault {
    /// Bodies overlap.
    #[error(
        "pair `{pair}`: `{body}` is {depth:.3e} inside `{other}` at ({:.6}, {:.6}, {:.6}), next to its {node}; that is {:.0} % of the local facet size. {}",
        at.x, at.y, at.z, 100.0 * share, closing.remedy()
    )]
    Overlap {
        /// Name of the pair.
        pair: String,
        /// Body or rigid surface of the node.
        body: String,
        /// The node.
        node: NodeId,
        /// What it is inside of.
        other: String,
        /// Where it is.
        at: Vec3,
        /// How deep.
        depth: f64,
        /// The same over the local facet size.
        share: f64,
        /// Whether nodes have been moved against it.
        closing: Closing,
    },
    /// Bodies overlap by so much that their other side is nearer.
    #[error(
        "pair `{pair}`: `{body}` is {depth:.3e} inside `{other}` at ({:.6}, {:.6}, {:.6}), next to its {node}, which is {:.0} % of the thickness of `{other}` there, {thickness:.3e}, and {:.0} % of the local facet size {size:.3e}. Overlaps are pressed out up to half the thickness; beyond, the other side of `{other}` is nearer. Move the bodies apart in the mesh, or bring them together in a step",
        at.x, at.y, at.z, 100.0 * depth / thickness, 100.0 * depth / size
    )]
    Deep {
        /// Name of the pair.
        pair: String,
        /// Body or rigid surface of the node.
        body: String,
        /// The node.
        node: NodeId,
        /// What it is inside of.
        other: String,
        /// Where it is.
        at: Vec3,
        /// How deep.
        depth: f64,
        /// How thick the other one is there.
        thickness: f64,
        /// The local facet size.
        size: f64,
    },
    /// No faces are near enough to be taken as touching.
    #[error(
        "pair `{pair}`: `interference` is measured from faces that touch, but none of the two sides face each other within the search distance of the pair, half a facet unless it is stated; the smallest gap is {gap:.3e}. Set `search_distance` to more than the gap between the faces that fit, or move them together in the mesh"
    )]
    Unseated {
        /// Name of the pair.
        pair: String,
        /// The smallest gap.
        gap: f64,
    },
    /// A body is on the wrong side of a rigid surface.
    #[error(
        "pair `{pair}`: body `{body}` is wholly behind `{rigid}`, whose normal points away from it; turn the normal of `{rigid}` round"
    )]
    Behind {
        /// Name of the pair.
        pair: String,
        /// The body.
        body: String,
        /// The rigid surface.
        rigid: String,
    },
    /// The sides look away from each other, as where facets are turned inside out.
    #[error(
        "pair `{pair}`: the surface of `{body}` looks away from that of `{other}`, so they cannot touch: at {node} of `{body}`, ({:.6}, {:.6}, {:.6}), both normals point the same way. {}",
        at.x, at.y, at.z, turning(rigid)
    )]
    Away {
        /// Name of the pair.
        pair: String,
        /// Body or rigid surface of the node.
        body: String,
        /// Name of the other one.
        other: String,
        /// The node.
        node: NodeId,
        /// Where it is.
        at: Vec3,
        /// Rigid surface that is a side, if one is.
        rigid: Option<String>,
    },
    /// Facets of one side are far smaller than those of the other.
    #[error(
        "pair `{pair}`: {} facets of `{body}` lie opposite one facet of `{other}`, at ({:.6}, {:.6}, {:.6}), too many for their contact to be computed. Refine `{other}` there, coarsen `{body}`, or make `{other}` a rigid surface if it hardly deforms",
        found.count, found.at.x, found.at.y, found.at.z
    )]
    Crowded {
        /// Name of the pair.
        pair: String,
        /// Body with the small facets.
        body: String,
        /// Body with the large one.
        other: String,
        /// How many lie opposite, and where.
        found: Opposite,
    },
    /// Moving nodes would turn an element inside out.
    #[error(
        "pair `{pair}`: `initial = \"close\"` would turn {element} of body `{body}` inside out. Set `initial = \"resolve\"` to press overlaps out in the first step instead, close only gaps that are small beside the elements, such as `initial = {{ close = 0 }}` for none, or mend the mesh"
    )]
    Inverted {
        /// Name of the pair.
        pair: String,
        /// The body.
        body: String,
        /// The first such element.
        element: ElementId,
    },
}

/// Whether nodes of a pair have been moved to close its gaps and overlaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closing {
    /// They have not.
    Open,
    /// They have.
    Made,
}

impl Closing {
    /// What to do about an overlap that is there.
    fn remedy(self) -> &'static str {
        match self {
            Self::Made => {
                "It is left after `initial = \"close\"` has moved the nodes of the smaller or finer side: between these nodes the other side reaches deeper. Set `initial = \"resolve\"` to press it out in the first step, refine the side that was moved, or mend the mesh"
            }
            Self::Open => {
                "Mend the mesh, or set `initial = \"close\"` to move nodes or `initial = \"resolve\"` to press the overlap out in the first step"
            }
        }
    }
}

impl InitialFault {
    /// Name of the pair.
    pub fn pair(&self) -> &str {
        match self {
            Self::Overlap { pair, .. }
            | Self::Deep { pair, .. }
            | Self::Unseated { pair, .. }
            | Self::Behind { pair, .. }
            | Self::Away { pair, .. }
            | Self::Crowded { pair, .. }
            | Self::Inverted { pair, .. } => pair,
        }
    }
}

/// The fault that many facets of a pair lie opposite to one.
pub fn crowded(model: &Model, pair: PairId, fit: &Fit) -> Option<InitialFault> {
    let found = crowd::crowd(model, pair, fit)?;
    Some(InitialFault::Crowded {
        pair: model.pairs[pair.0].name.clone(),
        body: other_name(model, pair, found.side).to_owned(),
        other: other_name(model, pair, found.side.opposite()).to_owned(),
        found,
    })
}

/// How all pairs fit; `None` for pairs that are no pairs.
pub fn fits(model: &Model) -> Vec<Option<Fit>> {
    let pairs = 0..model.pairs.len();
    pairs
        .map(|pair| Reference::new(model, PairId(pair)).map(|reference| reference.fit(model)))
        .collect()
}

/// What is wrong with a pair that fits like this.
pub fn fault(model: &Model, pair: PairId, fit: &Fit) -> Option<InitialFault> {
    let of_pair = &model.pairs[pair.0];
    if fit.lies == Lies::Behind && is_wholly_behind(model, pair) {
        return Some(InitialFault::Behind {
            pair: of_pair.name.clone(),
            body: side_name(model, &of_pair.a).to_owned(),
            rigid: side_name(model, &of_pair.b).to_owned(),
        });
    }
    if of_pair.interference.is_some()
        && let Some(fault) = unseated(model, pair, fit)
    {
        return Some(fault);
    }
    let overlap = fit
        .overlap
        .filter(|overlap| overlap.share() > LARGEST_OVERLAP)?;
    // Of surfaces that look away from each other, what is in front seems to be inside.
    if let Some(turned) = turned(model, pair) {
        return Some(away(model, pair, turned));
    }
    if of_pair.initial == Initial::Resolve || of_pair.interference.is_some() {
        return too_deep(model, pair);
    }
    let node = surface_node(model, pair, overlap.side, overlap.node)?;
    Some(InitialFault::Overlap {
        pair: of_pair.name.clone(),
        body: other_name(model, pair, overlap.side.opposite()).to_owned(),
        node,
        other: other_name(model, pair, overlap.side).to_owned(),
        at: overlap.point,
        depth: overlap.depth,
        share: overlap.share(),
        closing: match of_pair.initial {
            Initial::Close(_) => Closing::Made,
            Initial::AsMeshed | Initial::Resolve => Closing::Open,
        },
    })
}

/// The fault that no faces of a pair with an interference are near enough to touch.
fn unseated(model: &Model, pair: PairId, fit: &Fit) -> Option<InitialFault> {
    let seating = Reference::new(model, pair)?.at(model, Seating::new);
    seating.is_empty().then(|| InitialFault::Unseated {
        pair: model.pairs[pair.0].name.clone(),
        gap: fit.gap.map_or(fit.distance, |gap| gap.gap),
    })
}

/// The fault that an overlap is too deep to be pressed out.
fn too_deep(model: &Model, pair: PairId) -> Option<InitialFault> {
    let reference = Reference::new(model, pair)?;
    let (found, thickness, size) = reference.at(model, offsets::beyond_middle)?;
    Some(InitialFault::Deep {
        pair: model.pairs[pair.0].name.clone(),
        body: other_name(model, pair, found.side.opposite()).to_owned(),
        node: surface_node(model, pair, found.side, found.node)?,
        other: other_name(model, pair, found.side).to_owned(),
        at: found.point,
        depth: found.depth,
        thickness,
        size,
    })
}

/// The fault that the sides of a pair look away from each other.
pub fn away(model: &Model, pair: PairId, Turned { side, node, at }: Turned) -> InitialFault {
    let of_pair = &model.pairs[pair.0];
    let rigid = match &of_pair.b {
        ContactSurface::Rigid(_) => Some(side_name(model, &of_pair.b).to_owned()),
        ContactSurface::Deformable { .. } | ContactSurface::Itself => None,
    };
    InitialFault::Away {
        pair: of_pair.name.clone(),
        body: other_name(model, pair, side.opposite()).to_owned(),
        other: other_name(model, pair, side).to_owned(),
        node,
        at,
        rigid,
    }
}

/// Advice for surfaces that look away from each other.
fn turning(rigid: &Option<String>) -> String {
    match rigid {
        Some(rigid) => format!(
            "Turn the facets of `{rigid}` round (list their corners counter-clockwise as seen from where the body is), or name the facets of the body that face it"
        ),
        None => "Name the facets that face each other".to_owned(),
    }
}

/// The node, of the mesh of its body or rigid surface, that a surface node is.
pub fn surface_node(model: &Model, pair: PairId, side: Side, node: SurfaceNode) -> Option<NodeId> {
    let geometry = pair_geometry(model, &untextured(&model.pairs[pair.0])).ok()?;
    let surface = geometry.contact.sides[side].surface()?;
    surface.nodes().get(node.index()).copied()
}

/// Name of the body or rigid surface opposite to a side.
pub fn other_name(model: &Model, pair: PairId, side: Side) -> &str {
    let of_pair = &model.pairs[pair.0];
    let [a, b] = of_pair.surfaces();
    side_name(model, [b, a][side])
}

fn side_name<'m>(model: &'m Model, side: &ContactSurface) -> &'m str {
    match side {
        ContactSurface::Deformable { body, .. } => &model.bodies[body.0].name,
        ContactSurface::Rigid(rigid) => &model.rigid_surfaces[rigid.0].name,
        ContactSurface::Itself => "itself",
    }
}

fn untextured(pair: &crate::model::Pair) -> crate::model::Pair {
    crate::model::Pair {
        textures: [None, None],
        ..pair.clone()
    }
}

/// A pair in the reference configuration.
struct Reference {
    geometry: PairGeometry,
}

impl Reference {
    fn new(model: &Model, pair: PairId) -> Option<Self> {
        let mut geometry = pair_geometry(model, &untextured(&model.pairs[pair.0])).ok()?;
        add_fibres(model, std::slice::from_mut(&mut geometry));
        Some(Self { geometry })
    }

    /// Reference positions of the surface nodes.
    fn positions(&self, model: &Model) -> [Vec<Vec3>; 2] {
        Side::BOTH.map(|side| match self.geometry.bodies[side] {
            Some(body) => {
                let surface = self.geometry.contact.sides[side].surface();
                let nodes = surface.map_or(&[][..], |surface| surface.nodes());
                let mesh = &model.bodies[body].mesh;
                nodes
                    .iter()
                    .map(|node| mesh.positions[node.index()])
                    .collect()
            }
            None => self.geometry.rigid_reference.clone(),
        })
    }

    fn at<T>(&self, model: &Model, what: impl FnOnce(&Stage) -> T) -> T {
        let at = |body: usize, node: NodeId| model.bodies[body].mesh.positions[node.index()];
        let (pair, positions) = (&self.geometry.contact, self.positions(model));
        what(&Stage {
            configuration: &Configuration::new(pair, positions, Placement::at_rest()),
            thickness: &thickness_with(&self.geometry, at),
        })
    }

    fn fit(&self, model: &Model) -> Fit {
        self.at(model, fit)
    }
}

/// Whether all nodes of the body of side `a` are behind a rigid side.
fn is_wholly_behind(model: &Model, pair: PairId) -> bool {
    let Some(reference) = Reference::new(model, pair) else {
        return false;
    };
    let Some(body) = reference.geometry.bodies[0] else {
        return false;
    };
    let nodes = &model.bodies[body].mesh.positions;
    reference.at(model, |stage| match stage.configuration.plane() {
        Some((point, normal)) => nodes.iter().all(|x| (x - point).dot(&normal) < 0.0),
        None => nodes.iter().all(|x| {
            let nearest = nearest_of(stage.configuration.side(Side::B), x);
            nearest.is_some_and(|nearest| nearest.standing == Standing::Behind)
        }),
    })
}
