//! Position of a point relative to a surface of facets.
//!
//! Quadrilaterals are four triangles around their centre, so that nothing depends on
//! the corner that is named first. A point is in front of the surface or behind it by
//! the normal at the nearest point of the surface; at edges that is the sum of the
//! normals of the triangles, at corners their sum by angles (Baerentzen & Aanaes, IEEE
//! Trans. Vis. Comput. Graph. 11 (2005), DOI 10.1109/TVCG.2005.49). A point whose
//! nearest point lies on the edge of the surface is beside it, unless it lies exactly
//! over the edge.

use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    node::SurfaceNode,
    topology::{Surface, distinct_corners},
};

use super::triangle::{self, Part};
use crate::{search::Tree, segment::FACING};

/// The nearest point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its facet.
    pub facet: FacetId,
    /// The point.
    pub point: Vec3,
    /// Normal there.
    pub normal: Vec3,
    /// Distance from it.
    pub distance: f64,
    /// On which side of the surface one is there.
    pub standing: Standing,
}

/// On which side of a surface a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// On the side the normal points to, or on the surface.
    Front,
    /// On the other side.
    Behind,
    /// Beyond its edge.
    Beside,
}

/// A surface with its nodes somewhere.
pub(crate) struct Placed<'a, F: Fn(SurfaceNode) -> Vec3> {
    /// Topology.
    pub surface: &'a Surface,
    /// Tree over boxes that hold the facets.
    pub tree: &'a Tree,
    /// Position of a node.
    pub x: F,
}

/// Part of a facet.
#[derive(Clone, Copy)]
enum Feature {
    Corner(usize),
    Edge(usize),
    Inside,
}

/// Distance from the normal at an edge of the surface, over the size of the facet, at
/// which a point still lies over the edge.
const OVER_EDGE: f64 = 1e-6;

/// Vertices of the triangles of a facet; the last one is the centre in quadrilaterals.
pub(super) fn triangles(
    corners: &[SurfaceNode; 4],
    x: impl Fn(SurfaceNode) -> Vec3,
) -> Vec<[Vec3; 3]> {
    let ring = distinct_corners(corners);
    let x: Vec<Vec3> = ring.iter().map(|&node| x(node)).collect();
    if let [a, b, c] = x[..] {
        return vec![[a, b, c]];
    }
    let centre = x.iter().sum::<Vec3>() / x.len() as f64;
    (0..x.len())
        .map(|i| [x[i], x[(i + 1) % x.len()], centre])
        .collect()
}

impl<F: Fn(SurfaceNode) -> Vec3> Placed<'_, F> {
    /// The point of the surface nearest to `x`; `None` without facets.
    pub(crate) fn nearest(&self, x: &Vec3) -> Option<Nearest> {
        self.nearest_among(x, |_| true)
    }

    /// The point nearest to `x` of the facets that face one of the directions `normals`.
    pub(crate) fn nearest_facing(&self, x: &Vec3, normals: &[Vec3]) -> Option<Nearest> {
        self.nearest_among(x, |facet| {
            let normal = self.area(facet).normalize();
            normals.iter().any(|of| of.dot(&normal) < FACING)
        })
    }

    fn nearest_among(&self, x: &Vec3, counts: impl Fn(FacetId) -> bool) -> Option<Nearest> {
        let mut best: Option<(f64, u32, Vec3, Feature)> = None;
        self.tree.visit_nearest(x, |facet| {
            if !counts(FacetId(facet)) {
                return f64::INFINITY;
            }
            let (point, feature) = self.on_facet(facet, x);
            let square = (point - x).norm_squared();
            if best
                .as_ref()
                .is_none_or(|known| (square, facet) < (known.0, known.1))
            {
                best = Some((square, facet, point, feature));
            }
            square
        });
        let (square, facet, point, feature) = best?;
        let facet = FacetId(facet);
        let (normal, is_edge) = self.normal(facet, feature);
        let away = x - point;
        let along = away.dot(&normal);
        let over = || (away - normal * along).norm() <= OVER_EDGE * self.size(facet);
        Some(Nearest {
            facet,
            point,
            normal,
            distance: square.sqrt(),
            standing: match along {
                _ if is_edge && !over() => Standing::Beside,
                along if along < 0.0 => Standing::Behind,
                _ => Standing::Front,
            },
        })
    }

    /// The nearest point of a facet.
    fn on_facet(&self, facet: u32, x: &Vec3) -> (Vec3, Feature) {
        let corners = &self.surface.facets()[facet as usize];
        let triangles = triangles(corners, &self.x);
        let is_fan = triangles.len() > 1;
        let mut best: Option<(f64, Vec3, Feature)> = None;
        for (at, vertices) in triangles.iter().enumerate() {
            let (weights, part) = triangle::nearest(vertices, x);
            let point = (0..3).map(|k| vertices[k] * weights[k]).sum::<Vec3>();
            let square = (point - x).norm_squared();
            if best.as_ref().is_none_or(|known| square < known.0) {
                let feature = match part {
                    Part::Vertex(k) if !is_fan => Feature::Corner(k),
                    Part::Edge(k) if !is_fan => Feature::Edge(k),
                    Part::Vertex(k) if k < 2 => Feature::Corner((at + k) % triangles.len()),
                    Part::Edge(0) => Feature::Edge(at),
                    _ => Feature::Inside,
                };
                best = Some((square, point, feature));
            }
        }
        let (_, point, feature) = best.expect("a facet has a triangle");
        (point, feature)
    }

    /// Unit normal at a part of a facet, and whether that is on the edge of the surface.
    fn normal(&self, facet: FacetId, feature: Feature) -> (Vec3, bool) {
        let corners = &self.surface.facets()[facet.index()];
        let ring = distinct_corners(corners);
        let (sum, is_edge) = match feature {
            Feature::Inside => (self.area(facet), false),
            Feature::Edge(k) => self.edge_normal(ring[k], ring[(k + 1) % ring.len()]),
            Feature::Corner(k) => self.corner_normal(ring[k]),
        };
        (sum.normalize(), is_edge)
    }

    /// Twice the area vector of a facet.
    fn area(&self, facet: FacetId) -> Vec3 {
        triangles(&self.surface.facets()[facet.index()], &self.x)
            .iter()
            .map(|[a, b, c]| (b - a).cross(&(c - a)))
            .sum()
    }

    fn size(&self, facet: FacetId) -> f64 {
        (0.5 * self.area(facet).norm()).sqrt()
    }

    fn edge_normal(&self, start: SurfaceNode, end: SurfaceNode) -> (Vec3, bool) {
        let (mut sum, mut count) = (Vec3::zeros(), 0);
        for corner in self.surface.corners(start) {
            if corner.next != end && corner.previous != end {
                continue;
            }
            let triangles = self.at_corner(start, corner.facet);
            let beside = triangles.first().filter(|_| corner.next == end);
            if let Some(normal) = beside.or(triangles.last()) {
                sum += normal.1;
            }
            count += 1;
        }
        (sum, count == 1)
    }

    fn corner_normal(&self, node: SurfaceNode) -> (Vec3, bool) {
        let corners = self.surface.corners(node).iter();
        let sum = corners
            .flat_map(|corner| self.at_corner(node, corner.facet))
            .map(|(angle, normal)| normal * angle)
            .sum();
        (sum, self.surface.is_on_boundary(node))
    }

    /// Angle and unit normal of the triangles of a facet at a node, counter-clockwise.
    fn at_corner(&self, node: SurfaceNode, facet: FacetId) -> Vec<(f64, Vec3)> {
        let corners = &self.surface.facets()[facet.index()];
        let ring = distinct_corners(corners);
        let at = ring.iter().position(|&corner| corner == node);
        let at = at.expect("a facet of a node has it as a corner");
        let triangles = triangles(corners, &self.x);
        let turned = |[a, b, c]: &[Vec3; 3]| {
            let (u, v) = (b - a, c - a);
            (u.angle(&v), u.cross(&v).normalize())
        };
        if let [[a, b, c]] = triangles[..] {
            return vec![turned(&[[a, b, c], [b, c, a], [c, a, b]][at])];
        }
        let count = triangles.len();
        let [_, b, c] = triangles[at];
        let [p, q, r] = triangles[(at + count - 1) % count];
        vec![turned(&[q, b, c]), turned(&[q, r, p])]
    }
}
