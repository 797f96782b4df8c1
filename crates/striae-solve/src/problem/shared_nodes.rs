//! Nodes that several pairs have of one surface.
//!
//! Each pair numbers the nodes of its sides for itself. Those of two pairs are the same place of
//! the same surface if they are one node of a body, with a common facet or with normals at rest
//! that differ by less than [`SHARP`]. Across a sharp edge they belong to two faces.

use std::collections::BTreeMap;

use striae_contact::{pair::Enforcement, side::Side};
use striae_mesh::{NodeId, Vec3};
use striae_surface::{node::SurfaceNode, normal::nodal_normals, topology::Surface};

use super::ProblemError;
use striae_model::{Model, node::GlobalNode, pair_geometry::PairGeometry};

/// Cosine of the angle between normals at rest beyond which nodes belong to two faces, 45 degrees
/// as between faces that touch without being named.
const SHARP: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A node of a side of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairNode {
    /// The pair.
    pub pair: usize,
    /// Its side.
    pub side: Side,
    /// The node.
    pub node: SurfaceNode,
}

/// A node as its pair sees it.
struct Seen {
    at: PairNode,
    normal: Vec3,
    /// Corners of its facets, each in ascending order.
    facets: Vec<[NodeId; 4]>,
}

impl Seen {
    fn is_one_with(&self, other: &Self) -> bool {
        let mut facets = self.facets.iter();
        self.normal.dot(&other.normal) > SHARP || facets.any(|facet| other.facets.contains(facet))
    }
}

/// Refuses two pairs, one of them collocated, that share nodes on both sides, or on one against the
/// same rigid surface: the rows of a collocated node would state twice that it lies there.
pub(super) fn refuse_twice_collocated(
    places: &[Vec<PairNode>],
    pairs: &[PairGeometry],
    model: &Model,
) -> Result<(), ProblemError> {
    let is_collocated =
        |at: &PairNode| pairs[at.pair].contact.enforcement == Enforcement::Collocated;
    let opposite = |at: &PairNode| {
        let geometry = &pairs[at.pair];
        (geometry.bodies[at.side.opposite()], geometry.rigid)
    };
    let mut shared: BTreeMap<[usize; 2], [bool; 2]> = BTreeMap::new();
    for place in places {
        for (number, first) in place.iter().enumerate() {
            let others = place[number + 1..].iter();
            let others = others.filter(|second| {
                second.pair != first.pair
                    && opposite(second) == opposite(first)
                    && (is_collocated(first) || is_collocated(second))
            });
            let (Some(body), Some(surface)) = (
                pairs[first.pair].bodies[first.side],
                pairs[first.pair].contact.sides[first.side].surface(),
            ) else {
                continue;
            };
            for second in others {
                let of_both = shared.entry([first.pair, second.pair]).or_default();
                of_both[first.side] = true;
                let is_rigid = pairs[first.pair].rigid.is_some();
                if is_rigid || of_both[first.side.opposite()] {
                    let name = |pair: usize| model.pairs[pair].name.clone();
                    return Err(ProblemError::SharedCollocated {
                        first: name(first.pair),
                        second: name(second.pair),
                        body: model.bodies[body].name.clone(),
                        node: surface.nodes()[first.node.index()],
                    });
                }
            }
        }
    }
    Ok(())
}

/// Nodes of all pairs that are the same place of the same surface, place by place; those that one
/// pair alone has are left out.
pub(super) fn shared_nodes(
    pairs: &[PairGeometry],
    first_node: &[usize],
    reference: &[Vec3],
) -> Vec<Vec<PairNode>> {
    let mut all: Vec<(GlobalNode, Seen)> = Vec::new();
    if pairs.len() > 1 {
        for (pair, geometry) in pairs.iter().enumerate() {
            for side in Side::BOTH {
                let surface = geometry.contact.sides[side].surface();
                if let (Some(body), Some(surface)) = (geometry.bodies[side], surface) {
                    let of_body = &reference[first_node[body]..];
                    let nodes = surface
                        .nodes()
                        .iter()
                        .zip(seen((pair, side), surface, of_body));
                    let global = |node: &NodeId| GlobalNode(first_node[body] + node.index());
                    all.extend(nodes.map(|(node, seen)| (global(node), seen)));
                }
            }
        }
    }
    all.sort_by_key(|(node, _)| *node);
    let of_nodes = all.chunk_by(|a, b| a.0 == b.0);
    let places = of_nodes.flat_map(|of_node| places(of_node.iter().map(|(_, seen)| seen)));
    places.filter(|place| place.len() > 1).collect()
}

/// Nodes of a side, in their order; `of_body` are the nodes of the body at rest.
fn seen<'a>(
    (pair, side): (usize, Side),
    surface: &'a Surface,
    of_body: &'a [Vec3],
) -> impl Iterator<Item = Seen> + 'a {
    let nodes = surface.nodes();
    let x: Vec<Vec3> = nodes.iter().map(|node| of_body[node.index()]).collect();
    let normals = nodal_normals(surface, &x);
    SurfaceNode::all(nodes.len()).map(move |node| {
        let corners = surface.corners(node).iter();
        let facets = corners.map(|corner| {
            let mut facet = surface.facets()[corner.facet.index()].map(|node| nodes[node]);
            facet.sort_unstable();
            facet
        });
        Seen {
            at: PairNode { pair, side, node },
            normal: normals[node],
            facets: facets.collect(),
        }
    })
}

/// Divides what pairs have of a node of a body into places of its surface.
fn places<'a>(of_node: impl Iterator<Item = &'a Seen>) -> Vec<Vec<PairNode>> {
    let mut places: Vec<Vec<&Seen>> = Vec::new();
    for seen in of_node {
        let is_near = |place: &mut Vec<&Seen>| place.iter().any(|other| other.is_one_with(seen));
        // One that is part of several places makes them one.
        let mut joined: Vec<&Seen> = places.extract_if(.., is_near).flatten().collect();
        joined.push(seen);
        places.push(joined);
    }
    let places = places.into_iter();
    places
        .map(|place| place.into_iter().map(|seen| seen.at).collect())
        .collect()
}
