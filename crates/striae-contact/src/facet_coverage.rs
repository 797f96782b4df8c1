//! Coverage of a facet by the other side: full, partial or none.

use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    facet::{Shape, area_vector},
    scalar::combination,
    topology::distinct_corners,
};

use crate::{configuration::Configuration, search::Bounds, segment::FACING, side::Side};

/// Part of a facet that the other side covers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FacetCoverage {
    /// Nothing.
    Bare,
    /// All of it.
    Whole,
    /// Parts of it, by these opposing facets.
    Cut(Vec<FacetId>),
}

impl Configuration<'_> {
    /// Coverage of a facet of a deformable side.
    pub fn facet_coverage(&self, side: Side, facet: FacetId) -> FacetCoverage {
        let own = self.side(side);
        let corners = own.corners(facet);
        let reach = corners
            .map(|node| self.reach(side, node))
            .into_iter()
            .fold(0.0, f64::max);
        let positions = own.corner_positions(facet);
        let shape = Shape::of(&corners);
        let [xi, eta] = shape.centre();
        let centre = shape.weights(xi, eta);
        let middle = combination(&centre.value, &positions);
        let m = area_vector(&centre, &positions).normalize();
        let bounds = own.bounds(facet).inflated(reach);
        let radius = positions
            .map(|x| (x - middle).norm())
            .into_iter()
            .fold(0.0, f64::max);
        let opposing = self.pair.opposing(side);
        if self.plane().is_none() && self.is_near_edge(opposing, &middle, radius + reach) {
            return self.cut((side, facet), &bounds, &middle, &m, 2.0 * reach);
        }
        let admits = |other: FacetId, gap: f64| self.facets_may_face(side, [facet, other], gap);
        match self.contact_of(side, middle, m, 2.0 * reach, admits) {
            Some(_) => FacetCoverage::Whole,
            None => FacetCoverage::Bare,
        }
    }

    /// Returns whether an edge of the surface passes within `distance` of the point. Boxes serve as
    /// a filter only: the choice of quadrature must not depend on the axes.
    fn is_near_edge(&self, side: Side, x: &Vec3, distance: f64) -> bool {
        let snapshot = self.side(side);
        let edges = snapshot.surface.boundary_edges();
        let around = Bounds::around([*x]).inflated(distance);
        snapshot
            .edge_tree()
            .meeting(&around)
            .into_iter()
            .any(|edge| {
                let [a, b] = edges[edge as usize].nodes.map(|node| snapshot.x[node]);
                let along = b - a;
                let share = (along.dot(&(x - a)) / along.norm_squared()).clamp(0.0, 1.0);
                (a + along * share - x).norm() <= distance
            })
    }

    fn cut(
        &self,
        (side, facet): (Side, FacetId),
        bounds: &Bounds,
        middle: &Vec3,
        m: &Vec3,
        distance: f64,
    ) -> FacetCoverage {
        let other = self.facing(side);
        let faces = |covering: &FacetId| {
            let positions = other.corner_positions(*covering);
            let corners = distinct_corners(&other.surface.facets()[covering.index()]).len();
            let normal = if corners == 3 {
                (positions[1] - positions[0]).cross(&(positions[2] - positions[0]))
            } else {
                (positions[2] - positions[0]).cross(&(positions[3] - positions[1]))
            };
            let away = (positions[0] - middle).dot(m);
            // A wall beside what covers a facet does not cover it, too.
            let least = if self.pair.is_by_faces() { FACING } else { 0.0 };
            normal.dot(m) < least * normal.norm()
                && away.abs() <= distance + 0.5 * other.facet_size(*covering)
                && self.facets_may_face(side, [facet, *covering], away)
        };
        let facets: Vec<FacetId> = other
            .tree()
            .meeting(bounds)
            .into_iter()
            .map(FacetId)
            .filter(faces)
            .collect();
        if facets.is_empty() {
            FacetCoverage::Bare
        } else {
            FacetCoverage::Cut(facets)
        }
    }
}
