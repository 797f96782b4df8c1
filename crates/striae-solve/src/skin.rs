//! The skins of all bodies, judged for passing through themselves and each other.
//!
//! Pairs say which surfaces touch, and each is looked at by [`crate::interference`]. What no pair
//! sees is judged here, see [`striae_contact::interference::Skins`]: a body against itself, but for
//! the two sides of a pair, and two bodies that no tie joins, beside the sides of their pairs. All
//! ranks hold the skins.

use std::collections::HashSet;

use striae_contact::{
    interference::{MovingSkins, Overlap, PlacedSkins, SHARE, Skins, Spot},
    side::Side,
};
use striae_mesh::{FacetId, NodeId, Vec3};
use striae_surface::topology::Surface;

use crate::share::Share;
use striae_model::{
    ContactSurface, Model, Pair,
    node::GlobalNode,
    tie::{Ties, first_nodes},
};

/// The skins of all bodies of the whole problem.
#[derive(Clone, Debug)]
pub(crate) struct Skin {
    skins: Skins,
    /// Body and node of its whole mesh, by node of the surface.
    nodes: Vec<(usize, NodeId)>,
    /// Positions of the nodes at rest.
    reference: Vec<Vec3>,
    /// Sides of pairs that each node of the surface belongs to.
    sides: Vec<Vec<(usize, Side)>>,
    /// Bodies of every pair, the lower number first.
    paired: Vec<Option<[usize; 2]>>,
    /// Bodies that ties join, the lower number first.
    tied: HashSet<[usize; 2]>,
    /// Bodies whose faces may touch each other.
    self_contact: HashSet<usize>,
}

/// A body inside itself or another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyOverlap {
    /// The point that is inside, and how deep.
    pub found: Overlap,
    /// Its body.
    pub body: usize,
    /// Node of its mesh that it is, or a corner of the facet whose centre it is.
    pub node: NodeId,
    /// Body that it is inside of.
    pub other: usize,
    /// Depth at the start of the increment.
    pub before: f64,
    /// `true` if the body may touch itself there.
    pub is_joined: bool,
}

/// A point of a body that has gone through itself or another body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BodyCrossing {
    /// Body of the point.
    pub body: usize,
    /// Node of its mesh that it is, or a corner of the facet whose centre it is.
    pub node: NodeId,
    /// Body that it has gone through.
    pub other: usize,
    /// `true` if the body may touch itself there.
    pub is_joined: bool,
}

impl Skin {
    /// The skins of the bodies of a whole model.
    pub(crate) fn new(model: &Model, ties: &Ties) -> Self {
        let first = first_nodes(model);
        let (mut facets, mut bodies) = (Vec::new(), Vec::new());
        for (body, of_body) in model.bodies.iter().enumerate() {
            for face in of_body.mesh.boundary_faces() {
                let corners = of_body.mesh.face_nodes(face);
                facets.push(corners.map(|node| NodeId::new(first[body] + node.index())));
                bodies.push(body);
            }
        }
        let surface = Surface::new(&facets);
        let nodes = surface.nodes().iter().map(|node| {
            let body = first.partition_point(|&first| first <= node.index()) - 1;
            (body, NodeId::new(node.index() - first[body]))
        });
        let nodes: Vec<(usize, NodeId)> = nodes.collect();
        let at = |&(body, node): &(usize, NodeId)| model.bodies[body].mesh.positions[node.index()];
        let tied = ties.joints.iter().map(|joint| joint.bodies);
        Self {
            reference: nodes.iter().map(at).collect(),
            nodes,
            sides: sides(model, &surface, &first),
            paired: model.pairs.iter().map(bodies_of).collect(),
            tied: tied.map(|[a, b]| [a.min(b), a.max(b)]).collect(),
            self_contact: model.pairs.iter().filter_map(touches_itself).collect(),
            skins: Skins { surface, bodies },
        }
    }

    /// Positions of the nodes of the skins; collective.
    fn places(&self, share: &Share, positions: &[Vec3]) -> Vec<Vec3> {
        let own = self.skins.surface.nodes().iter().map(|node| {
            let local = share.local_node(GlobalNode(node.index()));
            let own = local.filter(|local| share.owns(*local));
            own.map_or_else(Vec3::zeros, |local| positions[local])
        });
        let mut places: Vec<Vec3> = own.collect();
        share.sum_vectors(&mut places);
        places
    }

    /// Returns whether no contact pair and no tie covers a point and the facet it is behind.
    fn is_judged(&self, spot: Spot, facet: FacetId) -> bool {
        let [body, other] = [self.skins.body(spot), self.skins.bodies[facet.index()]];
        let [own, others] = [spot, Spot::Centre(facet)].map(|spot| self.sides_of(spot));
        if body == other {
            let faces = |(pair, side): &(usize, Side)| others.contains(&(*pair, side.opposite()));
            return !own.iter().any(faces);
        }
        let bodies = [body.min(other), body.max(other)];
        let joins = |(pair, _): &(usize, Side)| self.paired[*pair] == Some(bodies);
        !self.tied.contains(&bodies) && !own.iter().chain(&others).any(joins)
    }

    /// Sides of pairs that a point belongs to.
    fn sides_of(&self, spot: Spot) -> Vec<(usize, Side)> {
        let nodes = match spot {
            Spot::Node(node) => vec![node],
            Spot::Centre(facet) => self.skins.surface.facets()[facet.index()].to_vec(),
        };
        nodes
            .iter()
            .flat_map(|&node| self.sides[node].iter().copied())
            .collect()
    }
}

/// Sides of pairs that each node of the skins belongs to.
fn sides(model: &Model, surface: &Surface, first: &[usize]) -> Vec<Vec<(usize, Side)>> {
    let mut sides = vec![Vec::new(); surface.nodes().len()];
    for (at, pair) in model.pairs.iter().enumerate() {
        // Within one body faces look for each other wherever they are, and only here is seen which
        // of them is inside.
        if pair.feature_angle.is_some() && bodies_of(pair).is_some_and(|[a, b]| a == b) {
            continue;
        }
        for (side, of_side) in [(Side::A, &pair.a), (Side::B, &pair.b)] {
            let ContactSurface::Deformable { body, faces } = of_side else {
                continue;
            };
            let mesh = &model.bodies[body.0].mesh;
            for node in faces.iter().flat_map(|face| mesh.face_nodes(*face)) {
                let node = surface.node(NodeId::new(first[body.0] + node.index()));
                if let Some(node) = node
                    && !sides[node].contains(&(at, side))
                {
                    sides[node].push((at, side));
                }
            }
        }
    }
    sides
}

/// Body whose faces a pair lets touch each other.
fn touches_itself(pair: &Pair) -> Option<usize> {
    match (&pair.a, &pair.b) {
        (ContactSurface::Deformable { body, .. }, ContactSurface::Itself) => Some(body.0),
        _ => {
            let [a, b] = bodies_of(pair)?;
            (a == b && pair.feature_angle.is_some()).then_some(a)
        }
    }
}

/// Both bodies of a pair, the lower number first; `None` against a rigid surface.
fn bodies_of(pair: &Pair) -> Option<[usize; 2]> {
    match (&pair.a, &pair.b) {
        (
            ContactSurface::Deformable { body, .. },
            ContactSurface::Deformable { body: other, .. },
        ) => Some([body.0.min(other.0), body.0.max(other.0)]),
        _ => None,
    }
}

/// First point that goes through a body where no pair sees it in an increment. Collective.
pub(crate) fn crossing(
    skin: &Skin,
    share: &Share,
    [start, end]: [&[Vec3]; 2],
) -> Option<BodyCrossing> {
    let [start, end] = [start, end].map(|positions| skin.places(share, positions));
    let moving = MovingSkins::new(&skin.skins, [&start, &end]);
    let judged = |spot: Spot, facet: FacetId| skin.is_judged(spot, facet);
    let first = moving.crossings(judged).into_iter().next()?;
    let (body, node) = skin.nodes[skin.skins.node(first.spot)];
    let other = skin.skins.bodies[first.facet.index()];
    Some(BodyCrossing {
        body,
        node,
        other,
        is_joined: body == other && skin.self_contact.contains(&body),
    })
}

/// Overlaps that no pair sees and that are deeper than [`SHARE`] of the facet size at the end of
/// an increment and were less at its start; those as meshed are meant. Collective.
pub(crate) fn overlaps(skin: &Skin, share: &Share, [start, end]: [&[Vec3]; 2]) -> Vec<BodyOverlap> {
    let at = skin.places(share, end);
    let judged = |spot: Spot, facet: FacetId| skin.is_judged(spot, facet);
    let mut found = PlacedSkins::new(&skin.skins, &at).overlaps(judged);
    found.retain(|found| found.share() > SHARE);
    let is_any = !found.is_empty();
    let was = match is_any {
        true => skin.places(share, start),
        false => return Vec::new(),
    };
    let before = PlacedSkins::new(&skin.skins, &was);
    let meshed = PlacedSkins::new(&skin.skins, &skin.reference);
    let depth = |at: &PlacedSkins, spot: Spot| at.overlap(spot, judged);
    found
        .into_iter()
        .filter_map(|found| {
            let before = depth(&before, found.spot).map_or(0.0, |known| known.depth);
            let is_meant = || depth(&meshed, found.spot).is_some_and(|known| known.share() > SHARE);
            let (body, node) = skin.nodes[skin.skins.node(found.spot)];
            let other = skin.skins.bodies[found.facet.index()];
            (found.depth > before * (1.0 + 1e-9) && !is_meant()).then(|| BodyOverlap {
                found,
                body,
                node,
                other,
                before,
                is_joined: body == other && skin.self_contact.contains(&body),
            })
        })
        .collect()
}
