//! From the surfaces of all ties to the rows of the nodes that follow.

use std::collections::BTreeMap;

use striae_contact::{
    configuration::Configuration,
    placement::Placement,
    side::Side,
    tie::{FacetRows, Joined, join},
};
use striae_mesh::{NodeId, Vec3};
use striae_surface::{node::SurfaceNode, topology::Surface};

use super::{
    Follower, Joint, TieFault, Weights,
    bound::Bound,
    patch::Patch,
    side::finer,
    surfaces::{contact_pair, unmet},
};
use crate::{
    model::{ContactSurface, Model},
    node::GlobalNode,
};

/// Covered part of the best covered facet at a node below which it does not follow.
const LEAST_COVER: f64 = 0.3;
/// Covered part of a facet that is all of it.
const WHOLE: f64 = 0.999;
/// Weights that are round-off.
const ROUND_OFF: f64 = 1e-12;
/// Relative difference of weights of rows that counts as zero.
const SAME: f64 = 1e-6;

/// The two surfaces of a tie.
pub(super) struct Sides {
    bodies: [usize; 2],
    follows: Side,
    /// Global nodes of both surfaces.
    nodes: [Vec<GlobalNode>; 2],
    /// Corners of their facets, as nodes of the meshes.
    corners: [Vec<[NodeId; 4]>; 2],
    joined: Joined,
    /// Rows of the facets that follow, in surface-local nodes.
    facets: [Vec<FacetRows>; 2],
    /// Tied areas.
    patches: Vec<Patch>,
    /// Nodes that cannot move past the other side.
    glued: [Vec<GlobalNode>; 2],
}

/// `d_j x_j + sum own - sum opposite` of a component of a node.
#[derive(Clone, Default)]
struct Sum {
    own: BTreeMap<GlobalNode, f64>,
    opposite: BTreeMap<GlobalNode, f64>,
}

impl Sides {
    /// The surfaces of a tie and what they have in common.
    pub(super) fn new(model: &Model, first_node: &[usize], tie: usize) -> Result<Self, TieFault> {
        let of_tie = &model.ties[tie];
        let name = || of_tie.name.clone();
        let [(a, faces_a), (b, faces_b)] = match [&of_tie.a, &of_tie.b] {
            [
                ContactSurface::Deformable {
                    body: a,
                    faces: on_a,
                },
                ContactSurface::Deformable {
                    body: b,
                    faces: on_b,
                },
            ] => [(a.0, on_a), (b.0, on_b)],
            _ => return Err(TieFault::Rigid { tie: name() }),
        };
        if a == b {
            let body = model.bodies[a].name.clone();
            return Err(TieFault::SameBody { tie: name(), body });
        }
        let [mesh_a, mesh_b] = [a, b].map(|body| &model.bodies[body].mesh);
        let pair = contact_pair([(mesh_a, faces_a), (mesh_b, faces_b)], of_tie.within);
        let positions = [(Side::A, a), (Side::B, b)].map(|(side, body)| {
            let nodes = pair.sides[side].surface().map_or(&[][..], Surface::nodes);
            let mesh = &model.bodies[body].mesh;
            let places = nodes.iter().map(|node| mesh.positions[node.index()]);
            places.collect::<Vec<Vec3>>()
        });
        let configuration = Configuration::new(&pair, positions, Placement::at_rest());
        let joined = join(&configuration, of_tie.within);
        unmet(model, &of_tie.name, [a, b], &configuration, &joined)?;
        Ok(Self {
            bodies: [a, b],
            follows: finer(&joined, [a, b].map(|body| &model.bodies[body].mesh)),
            nodes: [(Side::A, a), (Side::B, b)].map(|(side, body)| {
                let nodes = configuration.side(side).surface.nodes().iter();
                nodes
                    .map(|node| GlobalNode(first_node[body] + node.index()))
                    .collect()
            }),
            corners: Side::BOTH.map(|side| {
                let surface = configuration.side(side).surface;
                let facets = surface.facets().iter();
                facets
                    .map(|facet| facet.map(|corner| surface.nodes()[corner]))
                    .collect()
            }),
            facets: Side::BOTH.map(|side| joined.rows(&configuration, side)),
            joined,
            patches: Vec::new(),
            glued: [Vec::new(), Vec::new()],
        })
    }

    /// Description of the tie.
    pub(super) fn joint(self) -> Joint {
        let cover = Side::BOTH.map(|side| {
            let facets = self.joined.cover[side].iter().zip(&self.joined.areas[side]);
            let tied: f64 = facets.map(|(cover, area)| cover.min(1.0) * area).sum();
            tied / self.joined.areas[side].iter().sum::<f64>()
        });
        Joint {
            follows: self.follows,
            bodies: self.bodies,
            area: self.joined.area(),
            cover,
            gap: self.joined.gap,
            facet_size: self.joined.facet_size(self.follows),
            nodes: self.nodes,
            facets: self.corners,
            patches: self.patches,
            glued: self.glued,
        }
    }

    /// Nodes of both sides that cannot move past the other one: those that follow, and corners of
    /// facets opposite that are covered wholly. Ascending.
    fn glued(&self, follows: impl Fn(GlobalNode) -> bool) -> [Vec<GlobalNode>; 2] {
        Side::BOTH.map(|side| {
            let facets = self.facets[side].iter();
            let corners = facets.flat_map(|facet| facet.corners.iter().zip(&facet.cover));
            let glued = corners.filter_map(|(&corner, &cover)| {
                let node = self.own(side, corner);
                let held = match side == self.follows {
                    true => follows(node),
                    false => cover >= WHOLE,
                };
                held.then_some(node)
            });
            let mut glued: Vec<GlobalNode> = glued.collect();
            glued.sort_unstable();
            glued.dedup();
            glued
        })
    }

    /// Tied areas, for nodes that keep rows of components.
    fn patches(&self, keeps: impl Fn(GlobalNode, usize) -> bool) -> Vec<Patch> {
        let global = [self.follows, self.follows.opposite()].map(|side| &self.nodes[side][..]);
        let facets = self.facets[self.follows].iter();
        facets
            .map(|facet| Patch::new(facet, global, &keeps))
            .collect()
    }

    /// Makes the other side the one that follows where fewer of the tied areas are lost then;
    /// returns a fault where some still are.
    fn turn(&mut self, tie: &str, bound: &Bound) -> Option<TieFault> {
        let other = self.follows.opposite();
        let [own, opposite] = [self.follows, other].map(|side| self.lost(side, bound));
        let none_follows = self.candidates(self.follows, bound).is_empty();
        let (axis, share) = if none_follows || worst(&own).1 > worst(&opposite).1 {
            self.follows = other;
            worst(&opposite)
        } else {
            worst(&own)
        };
        (share > SAME).then(|| TieFault::Prescribed {
            tie: tie.to_owned(),
            axis: ["x", "y", "z"][axis],
            share,
        })
    }

    /// Shares of the tied area, by component, that a side could not tie: no corner of its facets
    /// may follow, while nodes opposite are not prescribed.
    fn lost(&self, side: Side, bound: &Bound) -> [f64; 3] {
        let share = |axis: usize| {
            let facets = self.facets[side].iter().filter(|facet| {
                let mut corners = facet.corners.iter();
                corners.all(|&corner| bound.component(self.own(side, corner), axis))
            });
            let free = facets
                .flat_map(|facet| &facet.opposite)
                .filter(|(node, _)| {
                    let opposite = self.own(side.opposite(), **node);
                    !bound.component(opposite, axis)
                });
            let area: f64 = free.map(|(_, row)| row.iter().sum::<f64>()).sum();
            area / self.joined.area()
        };
        [0, 1, 2].map(share)
    }

    /// Global node of a node of the side that follows.
    fn own(&self, side: Side, node: SurfaceNode) -> GlobalNode {
        self.nodes[side][node]
    }

    /// Nodes of a side that may follow, with what their functions weigh.
    fn candidates(&self, side: Side, bound: &Bound) -> BTreeMap<GlobalNode, f64> {
        let (mut weights, mut cover) = (BTreeMap::new(), BTreeMap::new());
        for facet in &self.facets[side] {
            for (at, &corner) in facet.corners.iter().enumerate() {
                let node = self.own(side, corner);
                *weights.entry(node).or_insert(0.0) += facet.weights[at];
                let most: &mut f64 = cover.entry(node).or_insert(0.0);
                *most = most.max(facet.cover[at]);
            }
        }
        weights.retain(|node, _| cover[node] >= LEAST_COVER && !bound.wholly(*node));
        weights
    }
}

/// Component with the largest share, and the share.
fn worst(shares: &[f64; 3]) -> (usize, f64) {
    let first = (0, shares[0]);
    let others = shares.iter().copied().enumerate();
    others.fold(
        first,
        |most, other| {
            if other.1 > most.1 { other } else { most }
        },
    )
}

/// The rows of all nodes that follow; their `weights` are still to be found.
pub(super) fn rows(
    model: &Model,
    first_node: &[usize],
    sides: &mut [Sides],
) -> Result<Vec<Follower>, Vec<TieFault>> {
    let bound = Bound::new(model, first_node);
    let mut faults = Vec::new();
    for (of_tie, tie) in sides.iter_mut().zip(&model.ties) {
        faults.extend(of_tie.turn(&tie.name, &bound));
    }
    let owner = owners(sides, &bound);
    let mut all = Vec::new();
    for (tie, of_tie) in sides.iter_mut().enumerate() {
        let follows = |node: GlobalNode| owner.get(&node) == Some(&tie);
        let keeps = |node: GlobalNode, axis: usize| follows(node) && !bound.component(node, axis);
        let mut found: BTreeMap<GlobalNode, Weights> = BTreeMap::new();
        for axis in 0..3 {
            for (node, sum) in sums(of_tie, |node| keeps(node, axis)) {
                found.entry(node).or_default()[axis] = Some(sum.weights(node));
            }
        }
        if found.is_empty() {
            faults.push(TieFault::Loose {
                tie: model.ties[tie].name.clone(),
                reason: match of_tie.candidates(of_tie.follows, &bound).is_empty() {
                    true => "all its nodes are prescribed, tied to rigid bodies or hardly covered",
                    false => "all nodes that it could tie belong to other ties",
                },
            });
        }
        of_tie.glued = of_tie.glued(|node| found.contains_key(&node));
        of_tie.patches = of_tie.patches(keeps);
        all.extend(found.into_iter().map(|(node, row)| Follower {
            tie,
            node,
            row,
            weights: Weights::default(),
        }));
    }
    if faults.is_empty() {
        Ok(all)
    } else {
        Err(faults)
    }
}

/// The tie that each node follows: the one in which it weighs most; of ties in which it
/// weighs the same, the first by the place of what is tied.
fn owners(sides: &[Sides], bound: &Bound) -> BTreeMap<GlobalNode, usize> {
    let mut owners: BTreeMap<GlobalNode, (usize, f64)> = BTreeMap::new();
    for (tie, of_tie) in sides.iter().enumerate() {
        for (node, weight) in of_tie.candidates(of_tie.follows, bound) {
            let known = owners.entry(node).or_insert((tie, weight));
            let other = &sides[known.0];
            let scale = weight.max(known.1);
            let wins = if (weight - known.1).abs() > SAME * scale {
                weight > known.1
            } else {
                comes_first(&of_tie.joined.centre, &other.joined.centre)
            };
            if wins {
                *known = (tie, weight);
            }
        }
    }
    owners
        .into_iter()
        .map(|(node, (tie, _))| (node, tie))
        .collect()
}

fn comes_first(a: &Vec3, b: &Vec3) -> bool {
    let scale = SAME * (a - b).norm();
    let axis = (0..3).find(|&axis| (a[axis] - b[axis]).abs() > scale);
    axis.is_some_and(|axis| a[axis] < b[axis])
}

/// Rows of one component of the nodes that keep theirs; the functions of the others go to
/// the nodes of their facets that do, in equal parts.
fn sums(sides: &Sides, keeps: impl Fn(GlobalNode) -> bool) -> BTreeMap<GlobalNode, Sum> {
    let side = sides.follows;
    let mut sums: BTreeMap<GlobalNode, Sum> = BTreeMap::new();
    for facet in &sides.facets[side] {
        let nodes: Vec<GlobalNode> = facet
            .corners
            .iter()
            .map(|&corner| sides.own(side, corner))
            .collect();
        let kept: Vec<GlobalNode> = nodes.iter().copied().filter(|&node| keeps(node)).collect();
        for (at, &node) in nodes.iter().enumerate() {
            let own_row = [node];
            let (takers, part) = match keeps(node) {
                true => (&own_row[..], 1.0),
                false => (kept.as_slice(), 1.0 / kept.len().max(1) as f64),
            };
            for taker in takers {
                let sum = sums.entry(*taker).or_default();
                *sum.own.entry(node).or_insert(0.0) += part * facet.weights[at];
                for (opposite, row) in &facet.opposite {
                    let opposite = sides.own(side.opposite(), *opposite);
                    *sum.opposite.entry(opposite).or_insert(0.0) += part * row[at];
                }
            }
        }
    }
    sums
}

impl Sum {
    /// Nodes that the node depends on, cleaned from round-off; the weights add up to one.
    fn weights(mut self, node: GlobalNode) -> Vec<(GlobalNode, f64)> {
        let own = self.own.remove(&node).unwrap_or(1.0);
        for (other, weight) in self.own {
            *self.opposite.entry(other).or_insert(0.0) -= weight;
        }
        let weights = self.opposite.into_iter().map(|(node, w)| (node, w / own));
        let mut weights: Vec<(GlobalNode, f64)> =
            weights.filter(|(_, w)| w.abs() > ROUND_OFF).collect();
        let excess = weights.iter().map(|(_, w)| w).sum::<f64>() - 1.0;
        let by_size = |a: &&mut (GlobalNode, f64), b: &&mut (GlobalNode, f64)| {
            a.1.abs().total_cmp(&b.1.abs())
        };
        if let Some((_, largest)) = weights.iter_mut().max_by(by_size) {
            *largest -= excess;
        }
        weights
    }
}
