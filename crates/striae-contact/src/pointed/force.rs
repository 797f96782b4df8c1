//! Concentrated forces of the pointed nodes and points.
//!
//! `f = w (-p n + tau)` on the tip and `-N_J f` on the corners of the facet that it pierces.
//! The row of a rigid tip is left out: what acts on a rigid body follows from the others.

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::node::SurfaceNode;

use crate::{
    common_field::CommonField,
    field::FacetForces,
    opposing::PlaceLanes,
    side::Side,
    spot::Spot,
    term::{Field, Lanes, LocalTerm, Row, Source},
    tip::Tip,
};

/// Momentum rows of a pointed node and of the facet that it presses on.
pub struct PointedTerm {
    /// The rows.
    pub term: LocalTerm,
    /// Forces on the facets of each side.
    pub facets: [Option<(FacetId, FacetForces)>; 2],
}

/// Forces of all pointed nodes.
pub fn terms(field: CommonField) -> Vec<PointedTerm> {
    let places = field.selection.pointed_places();
    let found: Vec<Option<PointedTerm>> = places
        .into_par_iter()
        .with_min_len(8)
        .map(|k| field.pointed_term(k))
        .collect();
    found.into_iter().flatten().collect()
}

/// Lanes of the tip's position and normal, the corners, the unknowns, the friction and the
/// normal along which the place is found.
const X: usize = 0;
const NORMAL: usize = 3;
const CORNERS: usize = 6;
const PRESSURE: usize = 18;
const TAU: usize = 21;
const RAY: usize = 24;
const LANES: usize = 27;

impl CommonField<'_> {
    fn pointed_term(&self, k: usize) -> Option<PointedTerm> {
        let configuration = self.configuration;
        let (side, node) = self.selection.kept()[k].place();
        let tip = self.selection.tip(side, node);
        let spot = Spot::new(configuration, tip)?;
        let weight = self.selection.weight(k);
        let pressure = self.tractions.nodes[side][node][0];
        let tau = &self.tau[side][node];
        let force = (tau.value - spot.n.value * pressure) * weight;
        let lanes = self.pointed_lanes((side, node), tip, &spot);
        let by_force = by_force(&spot.n.value, pressure, weight);
        let numbering = configuration.pair.numbering();
        let mut rows: Vec<Row> = Vec::with_capacity(15);
        let mut gradient = [[0.0; 15]; LANES];
        let mut add = |first: u32, share: f64| {
            let at = rows.len();
            for axis in 0..3 {
                let residual = -force[axis] * share;
                rows.push((first + axis as u32, Field::Momentum, residual));
                for (by, slope) in gradient.iter_mut().zip(&by_force) {
                    by[at + axis] -= slope[axis] * share;
                }
            }
        };
        let own = tip.unknown(configuration);
        if let Some(own) = own {
            add(own, 1.0);
        }
        if tip.presses_on_deformable(configuration)
            && let Some(opposing) = &spot.opposing
        {
            for (&corner, share) in spot.corners.iter().zip(opposing.weights) {
                add(numbering.position(side.opposite(), corner), -share);
            }
            let first = 3 * usize::from(own.is_some());
            for at in 0..spot.corners.len() {
                let by_r = force * opposing.weights_by_r[at].transpose();
                let mut by_lane = [[0.0; 3]; LANES];
                let place = PlaceLanes {
                    x: X,
                    n: RAY,
                    corners: CORNERS,
                };
                opposing.spread(&by_r, place, &mut by_lane);
                for (by, slope) in gradient.iter_mut().zip(&by_lane) {
                    for axis in 0..3 {
                        by[first + 3 * at + axis] += slope[axis];
                    }
                }
            }
        }
        let triples = lanes.triples();
        let columns = lanes.chained(&gradient, &triples);
        Some(PointedTerm {
            term: LocalTerm::from_columns(&rows, &triples, &columns),
            facets: self.pointed_facets((side, node), tip, &spot, &force, weight),
        })
    }

    fn pointed_lanes<'b>(
        &'b self,
        (side, node): (Side, SurfaceNode),
        tip: Tip,
        spot: &'b Spot,
    ) -> Lanes<'b> {
        let numbering = self.configuration.pair.numbering();
        let triple = |first: u32| Source::Unknowns { first, count: 3 };
        let mut lanes = Lanes::default();
        lanes.push(tip.lanes(self.configuration));
        lanes.push(Source::Vector(&spot.n.jacobian));
        match &spot.hit {
            Some(hit) if tip.presses_on_deformable(self.configuration) => {
                let corners = self.configuration.side(side.opposite()).corners(hit.facet);
                for corner in corners {
                    lanes.push(triple(numbering.position(side.opposite(), corner)));
                }
            }
            _ => lanes.push(Source::Constant(12)),
        }
        lanes.push(triple(numbering.traction(side, node)));
        lanes.push(Source::Vector(&self.tau[side][node].jacobian));
        lanes.push(Source::Vector(&spot.ray.jacobian));
        lanes
    }

    fn pointed_facets(
        &self,
        (side, node): (Side, SurfaceNode),
        tip: Tip,
        spot: &Spot,
        force: &Vec3,
        weight: f64,
    ) -> [Option<(FacetId, FacetForces)>; 2] {
        let pressure = weight * self.tractions.nodes[side][node][0];
        let friction = weight * self.tau[side][node].value.norm();
        let mut of_side = FacetForces {
            pressure,
            friction,
            ..FacetForces::default()
        };
        let mut of_other = of_side;
        let mut facets = [None, None];
        if let Tip::Node { .. } = tip {
            let own = self.configuration.side(side);
            let facet = own.surface.corners(node)[0].facet;
            let corners = own.corners(facet);
            if let Some(at) = corners
                .iter()
                .position(|corner| corner.index() == node.index())
            {
                of_side.force[at] = *force;
            }
            facets[side] = Some((facet, of_side));
        }
        if let (Some(hit), Some(opposing)) = (&spot.hit, &spot.opposing) {
            for (at, share) in opposing.weights.iter().enumerate().take(spot.corners.len()) {
                of_other.force[at] = force * -*share;
            }
            facets[side.opposite()] = Some((hit.facet, of_other));
        }
        facets
    }
}

/// Derivatives of `-f` of the node itself by the lanes of its normal, pressure and friction:
/// rows state what is left without the forces.
fn by_force(n: &Vec3, pressure: f64, weight: f64) -> [[f64; 3]; LANES] {
    let mut by_force = [[0.0; 3]; LANES];
    for axis in 0..3 {
        by_force[NORMAL + axis][axis] = -weight * pressure;
        by_force[TAU + axis][axis] = weight;
    }
    by_force[PRESSURE] = (n * -weight).into();
    by_force
}
