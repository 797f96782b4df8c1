//! Nodal frames: normal and two tangents with their derivatives.
//!
//! The normal is the surface's own nodal normal or, against a rigid surface,
//! the opposite of the rigid normal at the projection. The first tangent is the
//! direction to the node's first neighbour made tangent and of unit length,
//! Jones & Papadopoulos (2006), eq. (54) with the missing normalisation; the
//! second is `t2 = n x t1`.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use rayon::prelude::*;
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::{Configuration, Snapshot},
    coverage::{Found, Place},
    edge::on_edge,
    nodal_normal::own_normal,
    projection::{Hit, differentiated_rigid},
    selection::Selection,
    side::Side,
    term::{Lanes, Source, add_block, parts, variable3},
    tracked::Tracked,
};

/// Sine of the angle to the normal below which an edge gives no tangent.
const ALONG: f64 = 0.2;

/// Normal and tangents of a node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Unit normal `n`.
    pub n: Tracked,
    /// Unit tangents.
    pub t: [Tracked; 2],
}

/// Frames of the nodes that carry traction, by side; `None` elsewhere.
pub type Frames = [Vec<Option<Frame>>; 2];

/// Frames of all nodes that carry traction.
pub fn frames(configuration: &Configuration, selection: &Selection) -> Frames {
    Side::BOTH.map(|side| {
        (0..selection.nodes(side))
            .into_par_iter()
            .with_min_len(16)
            .map(SurfaceNode::new)
            .map(|node| {
                let carries = selection.carries(side, node);
                carries.then(|| frame_of(configuration, side, node))
            })
            .collect()
    })
}

/// The frame of a node.
pub(crate) fn frame_of(configuration: &Configuration, side: Side, node: SurfaceNode) -> Frame {
    let n = normal(configuration, side, node);
    frame(configuration, side, node, n)
}

/// The normal of a node: of its surface or, against a rigid one, of that.
fn normal(configuration: &Configuration, side: Side, node: SurfaceNode) -> Tracked {
    let rigid = configuration.pair.is_rigid();
    let of_rigid = rigid.then(|| rigid_normal(configuration, node)).flatten();
    of_rigid.unwrap_or_else(|| own_normal(configuration, side, node))
}

/// The opposite of the rigid normal at the projection; `None` far away from the surface.
fn rigid_normal(configuration: &Configuration, node: SurfaceNode) -> Option<Tracked> {
    if let Some((_, normal)) = configuration.plane() {
        return Some(Tracked {
            value: -normal,
            jacobian: Vec::new(),
        });
    }
    let (contact, found) = configuration.opposite(Side::A, node)?;
    let Place::Facet(hit) = contact.place else {
        return None;
    };
    let target = configuration.side(Side::B);
    if let Found::Edge(nodes) = found {
        return Some(normal_on_edge(configuration, node, &hit, nodes));
    }
    let x: Vector3<DualSVec64<3>> = variable3(&configuration.side(Side::A).x[node], 0);
    let (_, rigid) = differentiated_rigid(target, &hit, &x);
    let mut lanes = Lanes::default();
    lanes.push(Source::Unknowns {
        first: configuration.pair.numbering().position(Side::A, node),
        count: 3,
    });
    let (value, gradient) = parts(&-rigid);
    Some(Tracked {
        value,
        jacobian: lanes.jacobian(&gradient),
    })
}

/// Normal and its derivatives at the nearest point of the edge of the rigid surface.
fn normal_on_edge(
    configuration: &Configuration,
    node: SurfaceNode,
    hit: &Hit,
    nodes: [SurfaceNode; 2],
) -> Tracked {
    let place = on_edge(configuration, Side::A, node, hit, nodes);
    let target = configuration.side(Side::B);
    let [start, end] = nodes.map(|node| target.normals[node]);
    let sum = start + (end - start) * place.share.value;
    let (length, value) = (sum.norm(), -sum.normalize());
    let across = Matrix3::identity() - value * value.transpose();
    let by_share = -(across * (end - start)) / length;
    let by = |(first, slope): (u32, Vec3)| (first, by_share * slope.transpose());
    Tracked {
        value,
        jacobian: place.share.gradient.into_iter().map(by).collect(),
    }
}

/// The neighbour that the first tangent points to: the first one, unless it lies nearly
/// along the normal.
fn neighbour(own: &Snapshot, node: SurfaceNode, n: &Vec3) -> SurfaceNode {
    let corners = own.surface.corners(node);
    let tangential = |neighbour: SurfaceNode| {
        let edge = (own.x[neighbour] - own.x[node]).normalize();
        (edge - n * n.dot(&edge)).norm()
    };
    let first = corners[0].next;
    if tangential(first) > ALONG {
        return first;
    }
    let ring = corners
        .iter()
        .flat_map(|corner| [corner.next, corner.previous]);
    ring.max_by(|a, b| tangential(*a).total_cmp(&tangential(*b)))
        .unwrap_or(first)
}

/// The frame with this normal.
fn frame(configuration: &Configuration, side: Side, node: SurfaceNode, n: Tracked) -> Frame {
    let own = configuration.side(side);
    let numbering = configuration.pair.numbering();
    let neighbour = neighbour(own, node, &n.value);
    let edge = own.x[neighbour] - own.x[node];
    let along = edge.dot(&n.value);
    let tangential = edge - n.value * along;
    let length = tangential.norm();
    let t1 = tangential / length;
    let across = (Matrix3::identity() - t1 * t1.transpose()) / length;
    let by_edge = across * (Matrix3::identity() - n.value * n.value.transpose());
    let by_n = -across * (Matrix3::identity() * along + n.value * edge.transpose());
    let turn = n.value.cross_matrix();
    let mut lanes = Lanes::default();
    for other in [node, neighbour] {
        lanes.push(Source::Unknowns {
            first: numbering.position(side, other),
            count: 3,
        });
    }
    lanes.push(Source::Vector(&n.jacobian));
    let tracked = |value: Vec3, by_edge: Matrix3<f64>, by_n: Matrix3<f64>| {
        let mut gradient = [[0.0; 3]; 9];
        add_block(&mut gradient, 0, &-by_edge);
        add_block(&mut gradient, 3, &by_edge);
        add_block(&mut gradient, 6, &by_n);
        Tracked {
            value,
            jacobian: lanes.jacobian(&gradient),
        }
    };
    let t2 = n.value.cross(&t1);
    Frame {
        t: [
            tracked(t1, by_edge, by_n),
            tracked(t2, turn * by_edge, turn * by_n - t1.cross_matrix()),
        ],
        n: n.clone(),
    }
}
