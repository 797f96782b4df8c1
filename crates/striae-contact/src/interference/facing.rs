//! Nodes that face the other side, however far away.

use striae_surface::{node::SurfaceNode, topology::distinct_corners};

use super::{
    nearest::{Standing, triangles},
    placed,
    thickness::of_corners,
    triangle,
};
use crate::{
    configuration::{Configuration, Snapshot},
    side::Side,
};

/// A node of a deformable side and the nearest point of the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facing {
    /// Side of the node.
    pub side: Side,
    /// The node.
    pub node: SurfaceNode,
    /// Its share in the area of its side.
    pub area: f64,
    /// Distance along the normal of the other side, negative behind it.
    pub gap: f64,
    /// Corners of the facet of the nearest point and their weights there; `None` on a plane.
    pub opposite: Option<([SurfaceNode; 4], [f64; 4])>,
}

/// Cosine between the normals of a node and of the point nearest to it below which they
/// face each other.
const OPPOSED: f64 = -1e-3;

/// Distance up to which a node may lie beside the edge of the other side, over the facet size
/// there.
const BESIDE: f64 = 0.5;

/// All nodes of the deformable sides that face the other side: their normals are opposed,
/// and they lie over the other side or beside it by less than half a facet.
pub fn facing(configuration: &Configuration) -> Vec<Facing> {
    let of_side = |&side: &Side| {
        let snapshot = configuration.side(side);
        let areas = areas(snapshot);
        let nodes = areas.into_iter().enumerate();
        let found: Vec<Facing> = nodes
            .filter_map(|(node, area)| {
                let found = across(configuration, side, SurfaceNode::new(node))?;
                Some(Facing { area, ..found })
            })
            .collect();
        found
    };
    match configuration.pair.is_in_one_body() {
        true => Vec::new(),
        false => {
            let sides = configuration.pair.deformable_sides();
            sides.iter().flat_map(of_side).collect()
        }
    }
}

/// Facet that a node faces, without its share in the area.
pub fn across(configuration: &Configuration, side: Side, node: SurfaceNode) -> Option<Facing> {
    let (gap, opposite) = nearest(configuration, side, node)?;
    Some(Facing {
        side,
        node,
        area: 0.0,
        gap,
        opposite,
    })
}

type Opposite = Option<([SurfaceNode; 4], [f64; 4])>;

fn nearest(
    configuration: &Configuration,
    side: Side,
    node: SurfaceNode,
) -> Option<(f64, Opposite)> {
    let snapshot = configuration.side(side);
    let (x, normal) = (snapshot.x[node], snapshot.normals[node]);
    if let Some((point, n)) = configuration.plane() {
        return (normal.dot(&n) < OPPOSED).then(|| ((x - point).dot(&n), None));
    }
    let other = configuration.side(side.opposite());
    let nearest = placed(other).nearest(&x)?;
    let gap = (x - nearest.point).dot(&nearest.normal);
    let beside = (x - nearest.point - nearest.normal * gap).norm();
    let corners = other.corners(nearest.facet);
    let size = other.sizes[corners[0]];
    let over = nearest.standing != Standing::Beside || beside < BESIDE * size;
    (over && normal.dot(&nearest.normal) < OPPOSED).then(|| {
        let fan = triangles(&corners, |node| other.x[node]);
        let distance = |at: &usize| {
            let (weights, _) = triangle::nearest(&fan[*at], &x);
            let point: striae_mesh::Vec3 = (0..3).map(|k| fan[*at][k] * weights[k]).sum();
            (point - x).norm_squared()
        };
        let best = (0..fan.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let best = best.expect("a facet has a triangle");
        let (weights, _) = triangle::nearest(&fan[best], &x);
        let weights = of_corners(best, fan.len(), weights);
        (gap, Some((corners, weights)))
    })
}

/// Areas of the facets, shared by their corners.
fn areas(snapshot: &Snapshot) -> Vec<f64> {
    let mut areas = vec![0.0; snapshot.x.len()];
    for corners in snapshot.surface.facets() {
        let fan = triangles(corners, |node| snapshot.x[node]);
        let area: striae_mesh::Vec3 = fan.iter().map(|[a, b, c]| (b - a).cross(&(c - a))).sum();
        let ring = distinct_corners(corners);
        for &node in ring {
            areas[node] += 0.5 * area.norm() / ring.len() as f64;
        }
    }
    areas
}
