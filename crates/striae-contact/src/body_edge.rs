//! Facets that meet at an edge or a corner of their body.
//!
//! The body lies between two such facets however sharp the edge becomes: it may fold along a
//! smooth surface or a notch, but not along an edge, whose elements would have to be turned inside
//! out. With the unit normals `n` and the centres `c` of facets `i` and `j` with a common node in
//! the reference configuration, there is an edge between them if
//!
//! ```text
//! n_i . n_j < .71   and   (c_j - c_i) . (n_i - n_j) < 0
//! ```

use std::collections::{BTreeMap, BTreeSet};

use striae_mesh::{FacetId, NodeId, Vec3};
use striae_surface::{
    facet::Shape,
    topology::{Surface, distinct_corners},
};

use crate::{
    segment::{Facet, facet_normal},
    side::Side,
};

/// Cosine between the normals of facets up to which a border between them is an edge.
const EDGE: f64 = 0.71;
/// Height of an edge over the distance of the centres below which it is flat, or a closed slit.
const ROUND_OFF: f64 = 1e-9;

/// A facet in the reference configuration.
struct Meshed {
    place: (Side, FacetId),
    nodes: Vec<NodeId>,
    centre: Vec3,
    normal: Vec3,
}

/// Facets beyond edges and corners of the body that both surfaces are of, by side and facet; `x`
/// returns the positions of nodes in the reference configuration.
pub fn beyond_edges(
    surfaces: [Option<&Surface>; 2],
    x: impl Fn(NodeId) -> Vec3,
) -> [Vec<Vec<(Side, FacetId)>>; 2] {
    let sides = Side::BOTH.into_iter().zip(surfaces);
    let facets: Vec<Meshed> = sides
        .filter_map(|(side, surface)| Some(meshed(side, surface?, &x)))
        .flatten()
        .collect();
    let mut around: BTreeMap<NodeId, Vec<usize>> = BTreeMap::new();
    for (at, facet) in facets.iter().enumerate() {
        for node in &facet.nodes {
            around.entry(*node).or_default().push(at);
        }
    }
    let count = |surface: Option<&Surface>| surface.map_or(0, |surface| surface.facets().len());
    let mut found = surfaces.map(|surface| vec![Vec::new(); count(surface)]);
    for facet in &facets {
        let near = facet.nodes.iter().flat_map(|node| &around[node]);
        // Facets with a common edge share two nodes.
        let near: BTreeSet<usize> = near.copied().collect();
        let near = near.into_iter().map(|other| &facets[other]);
        let beyond = near.filter(|other| is_edge(facet, other));
        let (side, at) = facet.place;
        found[side][at.index()] = beyond.map(|other| other.place).collect();
    }
    found
}

/// The facets of a surface in the reference configuration; those without area have no edges.
fn meshed(side: Side, surface: &Surface, x: &impl Fn(NodeId) -> Vec3) -> Vec<Meshed> {
    let facets = surface.facets().iter().enumerate();
    let found = facets.filter_map(|(at, corners)| {
        let node = |corner| surface.nodes()[corner];
        let ring = distinct_corners(corners).iter();
        let nodes: Vec<NodeId> = ring.map(|&corner| node(corner)).collect();
        Some(Meshed {
            place: (side, FacetId::new(at)),
            centre: nodes.iter().map(|node| x(*node)).sum::<Vec3>() / nodes.len() as f64,
            normal: facet_normal(&Facet {
                corners: corners.map(|corner| x(node(corner))),
                shape: Shape::of(corners),
            })?,
            nodes,
        })
    });
    found.collect()
}

fn is_edge(i: &Meshed, j: &Meshed) -> bool {
    let apart = j.centre - i.centre;
    i.normal.dot(&j.normal) < EDGE && apart.dot(&(i.normal - j.normal)) < -ROUND_OFF * apart.norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Squares with a common edge; the second one rises from the first at an angle in degrees.
    fn beyond(angle: f64, is_outer: bool) -> usize {
        let (sine, cosine) = angle.to_radians().sin_cos();
        let at = |x: f64, z: f64| [0.0, 1.0].map(|y| Vec3::new(x, y, z));
        let x = [at(0.0, 0.0), at(1.0, 0.0), at(cosine, sine)].concat();
        let node = NodeId::new;
        let turned = |[a, b, c, d]: [NodeId; 4]| match is_outer {
            true => [a, b, c, d],
            false => [a, d, c, b],
        };
        let lower = turned([node(0), node(1), node(3), node(2)]);
        let upper = turned([node(0), node(4), node(5), node(1)]);
        let surfaces = [lower, upper].map(|facet| Surface::new(&[facet]));
        let of_sides = beyond_edges([Some(&surfaces[0]), Some(&surfaces[1])], |n| x[n.index()]);
        let whole = Surface::new(&[lower, upper]);
        let [of_one, none] = beyond_edges([Some(&whole), None], |n| x[n.index()]);
        assert!(none.is_empty());
        let count = |of: &[Vec<(Side, FacetId)>]| of.iter().map(Vec::len).sum::<usize>();
        assert_eq!(count(&of_one), count(&of_sides[0]) + count(&of_sides[1]));
        count(&of_one)
    }

    #[test]
    fn edges_are_convex_and_sharp() {
        for angle in [1.0, 20.0, 90.0, 130.0] {
            assert_eq!(beyond(angle, true), 2, "{angle}");
            assert_eq!(beyond(angle, false), 0, "{angle}");
        }
        // A closed slit, and borders that are almost smooth.
        for angle in [0.0, 140.0, 180.0, 220.0] {
            assert_eq!(beyond(angle, true), 0, "{angle}");
            assert_eq!(beyond(angle, false), 0, "{angle}");
        }
    }
}
