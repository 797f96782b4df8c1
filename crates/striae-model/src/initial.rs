//! Gaps and overlaps of the pairs of a model before anything has moved.
//!
//! Overlaps of more than two hundredths of the local facet size are a [`fault`] unless the pair
//! states their treatment: [`close`] moves the nodes of the smaller side to the other one, without
//! strain, as it is the reference mesh that changes; or contact
//! presses them out over the first step.

mod close;
mod crowd;
mod depth;
mod facing;
mod faults;
mod opposed;
mod reach;
mod translation;

use striae_contact::{
    configuration::Configuration,
    initial::{Fit, Lies, fit},
    interference::{Stage, Standing, nearest_of},
    placement::Placement,
    seating::Seating,
    side::Side,
};
use striae_mesh::{NodeId, Vec3};
use striae_surface::{node::SurfaceNode, topology::Surface};

use crate::{
    model::{ContactSurface, Initial, Model, PairId, RigidShape},
    pair_geometry::{PairGeometry, add_fibres, pair_geometry, thickness_with},
};

pub use close::close;
pub use crowd::opposite;
use facing::askew;
pub use facing::{Turned, back_to_back, turned};
pub use faults::{Closing, InitialFault, Reversal};
pub use opposed::opposed;
pub use reach::may_meet;

/// Overlap over the local facet size that is no fault of the mesh.
pub(crate) const LARGEST_OVERLAP: f64 = 0.02;
/// Overlap over the local facet size that is round-off.
pub const ROUND_OFF: f64 = 1e-9;

/// The fault that many facets of a pair lie opposite to one.
pub fn crowded(model: &Model, pair: PairId, fit: &Fit) -> Option<InitialFault> {
    let found = crowd::crowd(model, pair, fit)?;
    Some(InitialFault::Crowded {
        pair: model.pairs[pair.0].name.clone(),
        body: other_name(model, pair, found.side).to_owned(),
        other: other_name(model, pair, found.side.opposite()).to_owned(),
        count: found.count,
        at: found.at,
    })
}

/// Initial fit of all pairs; `None` for pairs that are not valid.
pub fn fits(model: &Model) -> Vec<Option<Fit>> {
    let of_pair = |pair: usize| {
        if model.pairs[pair].is_in_one_body() {
            // Neither surfaces nor fibres through the body are needed.
            return Some(Fit::WITHIN_A_BODY);
        }
        Some(Reference::new(model, PairId(pair))?.fit(model))
    };
    (0..model.pairs.len()).map(of_pair).collect()
}

/// Fault of a pair with this fit.
pub fn fault(model: &Model, pair: PairId, fit: &Fit) -> Option<InitialFault> {
    let of_pair = &model.pairs[pair.0];
    if let Some(fault) = behind(model, pair, fit) {
        return Some(fault);
    }
    if of_pair.interference.is_some()
        && let Some(fault) = unseated(model, pair, fit)
    {
        return Some(fault);
    }
    if let Some(turned) = back_to_back(model, pair, fit) {
        return Some(away(model, pair, turned));
    }
    let overlap = fit.overlap.filter(|_| is_deep(fit))?;
    // Of surfaces that do not face each other, what is in front seems to be inside.
    if let Some(turned) = turned(model, pair).or_else(|| askew(model, pair)) {
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

/// Returns whether sides overlap by more than meshes that touch.
fn is_deep(fit: &Fit) -> bool {
    let overlap = fit.overlap.as_ref();
    overlap.is_some_and(|overlap| overlap.share() > LARGEST_OVERLAP)
}

/// The fault that a pair is the wrong way round, so that its gaps cannot be closed.
pub fn wrong_way(model: &Model, pair: PairId) -> Option<InitialFault> {
    if let Some(turned) = turned(model, pair) {
        return Some(away(model, pair, turned));
    }
    let fit = Reference::new(model, pair)?.fit(model);
    behind(model, pair, &fit)
}

/// Returns whether overlaps of a pair that are pressed out are those of curved surfaces that
/// conform, not those of the facets that are their chords.
pub fn conforms(model: &Model, pair: PairId) -> bool {
    let reference = Reference::new(model, pair);
    reference.is_some_and(|reference| reference.at(model, Seating::of_surfaces).is_some())
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
    let (found, thickness, size) = reference.at(model, depth::beyond_middle)?;
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
pub fn away(model: &Model, pair: PairId, turned: Turned) -> InitialFault {
    let Turned {
        side,
        node,
        at,
        cosine,
    } = turned;
    let of_pair = &model.pairs[pair.0];
    let reversal = reversal(model, &of_pair.b);
    let rigid = reversal.map(|how| Box::new((side_name(model, &of_pair.b).to_owned(), how)));
    InitialFault::Away {
        pair: of_pair.name.clone(),
        body: other_name(model, pair, side.opposite()).to_owned(),
        other: other_name(model, pair, side).to_owned(),
        node,
        at,
        angle: cosine.clamp(-1.0, 1.0).acos().to_degrees(),
        rigid,
    }
}

/// Part of the statement of a side to reverse, if it is rigid.
fn reversal(model: &Model, side: &ContactSurface) -> Option<Reversal> {
    let ContactSurface::Rigid(rigid) = side else {
        return None;
    };
    Some(match model.rigid_surfaces[rigid.0].shape {
        RigidShape::Plane { .. } => Reversal::Normal,
        RigidShape::Facets { .. } | RigidShape::Bare => Reversal::Corners,
    })
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
        let of_skin = |side: Side, skin: &Surface| {
            let body = self.geometry.bodies[side].expect("a part of a skin has a body");
            skin.nodes().iter().map(|node| at(body, *node)).collect()
        };
        let configuration = Configuration::new(pair, positions, Placement::at_rest());
        what(&Stage {
            configuration: &configuration.enclosed(of_skin),
            thickness: &thickness_with(&self.geometry, at),
        })
    }

    fn fit(&self, model: &Model) -> Fit {
        self.at(model, fit)
    }
}

/// The fault that all of a body is behind a rigid side, or on it: what overlaps a tool that faces
/// it has nodes in front.
fn behind(model: &Model, pair: PairId, fit: &Fit) -> Option<InitialFault> {
    let of_pair = &model.pairs[pair.0];
    let reversal = reversal(model, &of_pair.b)?;
    if fit.lies != Lies::Behind && !is_deep(fit) {
        return None;
    }
    let reference = Reference::new(model, pair)?;
    let mesh = &model.bodies[reference.geometry.bodies[0]?].mesh;
    let round_off = LARGEST_OVERLAP * mesh.characteristic_size();
    let is_behind = |stage: &Stage, x: &Vec3| {
        let (point, normal) = match stage.configuration.plane() {
            Some(plane) => plane,
            None => match nearest_of(stage.configuration.side(Side::B), x) {
                Some(nearest) if nearest.standing == Standing::Behind => return true,
                Some(nearest) => (nearest.point, nearest.normal),
                None => return false,
            },
        };
        (x - point).dot(&normal) <= round_off
    };
    let mut nodes = mesh.positions.iter();
    let is_all = reference.at(model, |stage| nodes.all(|x| is_behind(stage, x)));
    is_all.then(|| InitialFault::Behind {
        pair: of_pair.name.clone(),
        body: side_name(model, &of_pair.a).to_owned(),
        rigid: side_name(model, &of_pair.b).to_owned(),
        reversal,
    })
}
