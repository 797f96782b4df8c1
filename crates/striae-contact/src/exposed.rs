//! Loads on the exposed part of cut facets: what the covered part takes away.

use nalgebra::Vector3;
use num_dual::DualSVec64;
use striae_mesh::FacetId;
use striae_surface::{
    facet::{Shape, area_vector},
    scalar::{Real, norm, scaled},
    topology::distinct_corners,
};

use crate::{
    clip::covered_points,
    configuration::Configuration,
    side::Side,
    term::{Field, Lanes, LocalTerm, Row, Source, by_lane, variables3},
};

/// A load on the surface, as force per current area.
pub trait SurfaceLoad {
    /// The load at a point of the facet with these current corners. A triangle repeats its
    /// last one, and is asked with its own coordinates.
    fn per_area<D: Real>(&self, x: &[Vector3<D>; 4], xi: D, eta: D) -> Vector3<D>;
}

/// Nodal forces of a load on the covered part of a cut facet: rows of the
/// corners' positions with the residual *plus* force (what is taken away from
/// the external load).
pub fn covered_load<L: SurfaceLoad>(
    configuration: &Configuration,
    side: Side,
    facet: FacetId,
    covers: &[FacetId],
    load: &L,
) -> Vec<LocalTerm> {
    const N: usize = 24;
    let numbering = configuration.pair.numbering();
    let (own, other) = (configuration.side(side), configuration.facing(side));
    let first = own
        .corners(facet)
        .map(|corner| numbering.position(side, corner));
    let shape = Shape::of(&own.corners(facet));
    let x: [Vector3<DualSVec64<N>>; 4] = variables3(&own.corner_positions(facet), 0);
    let mut terms = Vec::with_capacity(covers.len());
    for &cover in covers {
        let mut lanes = Lanes::default();
        for first in first {
            lanes.push(Source::Unknowns { first, count: 3 });
        }
        let opposite = other.corners(cover);
        for corner in opposite {
            lanes.push(if configuration.pair.is_rigid() {
                Source::Constant(3)
            } else {
                Source::Unknowns {
                    first: numbering.position(configuration.pair.opposing(side), corner),
                    count: 3,
                }
            });
        }
        let corners = variables3(&other.corner_positions(cover), 12);
        let window = &corners[..distinct_corners(&opposite).len()];
        let mut force = [(); 4].map(|()| Vector3::repeat(DualSVec64::<N>::from_re(0.0)));
        for point in covered_points(shape, &x, window) {
            let weights = shape.weights(point.xi, point.eta);
            let area = norm(&area_vector(&weights, &x)) * point.weight;
            let density = scaled(&load.per_area(&x, point.xi, point.eta), area);
            for corner in 0..4 {
                force[corner] += scaled(&density, weights.value[corner]);
            }
        }
        let force: [DualSVec64<N>; 12] = std::array::from_fn(|at| force[at / 3][at % 3]);
        let rows: [Row; 12] = std::array::from_fn(|at| {
            let unknown = first[at / 3] + (at % 3) as u32;
            (unknown, Field::Momentum, force[at].re)
        });
        terms.push(LocalTerm::from_lanes(&lanes, &rows, &by_lane(&force)));
    }
    terms
}
