//! Thickness of the body behind a facet.
//!
//! A contact surface is part of the skin of a body, and what is behind it by more than
//! the body is thick there is not inside. A [`Fibre`] leads from the centre of a facet
//! against its normal through the body to the other side of its skin; it is found
//! once, in the reference configuration, and its length follows the deformation.

use rayon::prelude::*;
use striae_mesh::{NodeId, Vec3};
use striae_surface::{
    node::SurfaceNode,
    topology::{Surface, distinct_corners},
};

use super::nearest::triangles;
use crate::{
    search::{Bounds, Tree},
    side::Side,
};

/// The end of a fibre through a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    /// Nodes of the mesh, on its skin around the end.
    pub nodes: [NodeId; 4],
    /// Their weights; they sum to one.
    pub weights: [f64; 4],
}

/// Thickness of the bodies behind the facets, by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Thickness(pub [Vec<f64>; 2]);

impl Thickness {
    /// Nothing is known: bodies have no end behind their facets.
    pub fn unbounded(counts: [usize; 2]) -> Self {
        Self(counts.map(|count| vec![f64::INFINITY; count]))
    }

    /// The largest one of a side.
    pub(super) fn largest(&self, side: Side) -> f64 {
        self.0[side].iter().copied().fold(0.0, f64::max)
    }
}

/// Fibres from all facets of a surface to the skin of its body; `None` where a fibre
/// meets no skin.
pub fn fibres(
    surface: &Surface,
    x: &[Vec3],
    skin: &Surface,
    skin_x: &[Vec3],
) -> Vec<Option<Fibre>> {
    let boxes = skin
        .facets()
        .iter()
        .map(|facet| Bounds::around(distinct_corners(facet).iter().map(|&n| skin_x[n])));
    let tree = Tree::new(boxes.collect());
    let facets = surface.facets().par_iter().with_min_len(8);
    facets
        .map(|corners| {
            let fan = triangles(corners, |node| x[node]);
            let area: Vec3 = fan.iter().map(|[a, b, c]| (b - a).cross(&(c - a))).sum();
            let start = centre(corners, |node| x[node]);
            let least = 1e-6 * area.norm().sqrt();
            opposite(skin, skin_x, &tree, [&start, &-area.normalize()], least)
        })
        .collect()
}

/// Lengths of the fibres; infinite where there is none.
pub fn lengths(
    surface: &Surface,
    x: &[Vec3],
    fibres: &[Option<Fibre>],
    skin_x: impl Fn(NodeId) -> Vec3,
) -> Vec<f64> {
    let facets = surface.facets().iter().zip(fibres);
    facets
        .map(|(corners, fibre)| {
            fibre.as_ref().map_or(f64::INFINITY, |fibre| {
                let ends = fibre.nodes.iter().zip(fibre.weights);
                let end: Vec3 = ends.map(|(&node, weight)| skin_x(node) * weight).sum();
                (end - centre(corners, |node| x[node])).norm()
            })
        })
        .collect()
}

pub(super) fn centre(corners: &[SurfaceNode; 4], x: impl Fn(SurfaceNode) -> Vec3) -> Vec3 {
    let ring = distinct_corners(corners);
    ring.iter().map(|&node| x(node)).sum::<Vec3>() / ring.len() as f64
}

/// The first point of the skin on a half-line beyond the distance `least`.
fn opposite(
    skin: &Surface,
    skin_x: &[Vec3],
    tree: &Tree,
    [start, direction]: [&Vec3; 2],
    least: f64,
) -> Option<Fibre> {
    let mut best: Option<(f64, Fibre)> = None;
    for facet in tree.on_ray(start, direction) {
        let corners = &skin.facets()[facet as usize];
        let fan = triangles(corners, |node| skin_x[node]);
        for (at, vertices) in fan.iter().enumerate() {
            let Some((distance, weights)) = met(vertices, start, direction) else {
                continue;
            };
            if distance > least && best.as_ref().is_none_or(|known| distance < known.0) {
                let weights = of_corners(at, fan.len(), weights);
                let nodes = corners.map(|corner| skin.nodes()[corner]);
                best = Some((distance, Fibre { nodes, weights }));
            }
        }
    }
    best.map(|(_, fibre)| fibre)
}

/// Weights of the corners of a facet for those of one of its triangles.
pub(super) fn of_corners(at: usize, count: usize, weights: [f64; 3]) -> [f64; 4] {
    if count == 1 {
        return [weights[0], weights[1], weights[2], 0.0];
    }
    let mut all = [0.25 * weights[2]; 4];
    all[at] += weights[0];
    all[(at + 1) % 4] += weights[1];
    all
}

/// Distance at which a half-line meets a triangle, and barycentric coordinates there
/// (Moeller & Trumbore, J. Graph. Tools 2 (1997)).
fn met([a, b, c]: &[Vec3; 3], start: &Vec3, direction: &Vec3) -> Option<(f64, [f64; 3])> {
    const ROUND_OFF: f64 = 1e-9;
    let (u, v, p) = (b - a, c - a, start - a);
    let determinant = u.dot(&direction.cross(&v));
    if determinant == 0.0 {
        return None;
    }
    let s = p.dot(&direction.cross(&v)) / determinant;
    let r = direction.dot(&p.cross(&u)) / determinant;
    let distance = v.dot(&p.cross(&u)) / determinant;
    let inside = s >= -ROUND_OFF && r >= -ROUND_OFF && s + r <= 1.0 + ROUND_OFF;
    (inside && distance >= 0.0).then_some((distance, [1.0 - s - r, s, r]))
}
