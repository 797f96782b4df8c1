//! Pointed nodes: edges and corners that pierce a face between its nodes.
//!
//! Weighted rows take the mean gap over the facets around a node, which stays positive
//! while an edge between two tilted facets is already inside the other body. Such a node
//! gets unknowns `(p, z1, z2)` of its own, whose traction is concentrated there. With the
//! unit normal `m` of the facet that it pierces (from the diagonals, `n = -m`), the shape
//! functions `N_J` of that facet at the projection and the area `w = h^2` of the node at the
//! start of the increment
//!
//! ```text
//! sum_J N_J x_J - x_I - g n = 0
//! du  = (I - n n)(x_I - xbar)
//! f_I = w (-p n + tau),   f_J = -N_J f_I
//! ```
//!
//! `xbar` is the material point that was opposite at the start. Row and force are adjoint on
//! plane facets, and forces of the two sides balance to round-off. Complementarity and
//! friction are those of all kept nodes, with the stiffness `1/(h_a/E_a + h_b/E_b)`.
//!
//! A node pierces if it is open, lies deeper than [`PIERCED`] of the smaller facet size, and
//! its own facets are open in the mean and stand back from it by more than [`SHARP`] of
//! their size: the mean gap minus its own. Facets tilted by the angle `t` stand back by
//! `h tan(t)/3`. A node of a smooth surface of radius `R` with a mean gap of zero is inside
//! by `h^2/(6 R)`, too, which is left to the mean: up to .07 of a facet at the shoulders of
//! coarse tyres. What is not sharp closes in the mean before it is inside by `SHARP`. A node
//! stays pointed while it is pressed and the mean gap is larger than [`CLOSING`].
//!
//! Longer than other files, as a place, its gap and its forces share their derivatives.

use nalgebra::Matrix3;
use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{facet::Shape, topology::distinct_corners};

use crate::{
    collocated,
    common_field::CommonField,
    configuration::Configuration,
    field::FacetForces,
    frame::{Frame, Tracked},
    kinematics::{Kinematics, Presence, TrackedScalar},
    opposing::{Opposing, PlaceLanes},
    pair::Enforcement,
    pairing::{Scope, paired_facets},
    projection::{Hit, Margin, Ray, project},
    segment::Derivatives,
    selection::{Kept, Partner, Selection, compliances},
    term::{Field, Gradient, Lanes, LocalTerm, Row, Source},
    unknowns::NodeResult,
    weighted::add_chained,
};

/// Depth from which a node counts as pierced, over the smaller facet size.
pub const PIERCED: f64 = 0.02;

/// Mean gap of its own facets beyond its own from which it is sharp, over their size.
pub const SHARP: f64 = 0.1;

/// Mean gap of its own facets down to which a node stays pointed, over their size.
pub const CLOSING: f64 = 0.02;

/// How many reaches around a node an opposing facet is looked for.
const FOLLOW: f64 = 4.0;

/// Pressure that is none, over the modulus.
const NO_PRESSURE: f64 = 1e-10;

/// What a pointed node presses on.
pub struct Spot {
    /// The point of the facet; a plane has none.
    pub hit: Option<Hit>,
    /// Unit normal of the node, against that of the facet or plane.
    pub n: Tracked,
    /// Gap.
    gap: TrackedScalar,
    /// Corners of the facet without repetition.
    corners: Vec<u32>,
    opposing: Option<Opposing>,
}

impl Spot {
    /// The point opposite to a node along the normal of what it faces there; `None` beside
    /// the other side or far away from it.
    pub fn new(configuration: &Configuration, side: usize, node: u32) -> Option<Self> {
        let numbering = configuration.pair.numbering();
        let own = numbering.position(side, node);
        let x = configuration.side(side).x[node as usize];
        if let Some((point, normal)) = configuration.plane() {
            return Some(Self {
                hit: None,
                n: Tracked {
                    value: -normal,
                    jacobian: Vec::new(),
                },
                gap: TrackedScalar {
                    value: (x - point).dot(&normal),
                    gradient: vec![(own, normal)],
                },
                corners: Vec::new(),
                opposing: None,
            });
        }
        let hit = faced(configuration, side, node, FOLLOW)?;
        let target = configuration.side(1 - side);
        let corners = target.corners(hit.facet);
        let positions = target.corner_positions(hit.facet);
        let mut n = Tracked {
            value: -facet_normal(&positions),
            jacobian: Vec::new(),
        };
        if !configuration.pair.is_rigid() {
            n.jacobian = normal_jacobian(&positions, |corner| {
                numbering.position(1 - side, corners[corner])
            });
        }
        let opposing = Opposing::new(Shape::of(&corners), &hit, &n.value, &positions);
        let mut gradient: Gradient = vec![(own, -opposing.gap_by_r)];
        let mut add = |first: u32, slope: Vec3| match gradient.iter_mut().find(|e| e.0 == first) {
            Some((_, sum)) => *sum += slope,
            None => gradient.push((first, slope)),
        };
        if !configuration.pair.is_rigid() {
            for (corner, weight) in corners.iter().zip(opposing.weights) {
                let first = numbering.position(1 - side, *corner);
                add(first, opposing.gap_by_r * weight);
            }
        }
        let by_n = opposing.gap_by_r * -hit.gap;
        for (first, block) in &n.jacobian {
            add(*first, block.tr_mul(&by_n));
        }
        Some(Self {
            hit: Some(hit),
            n,
            gap: TrackedScalar {
                value: hit.gap,
                gradient,
            },
            corners: distinct_corners(&corners).to_vec(),
            opposing: Some(opposing),
        })
    }

    /// The material point, for slip in an increment that starts here.
    pub fn partner(&self, configuration: &Configuration, side: usize, node: u32) -> Partner {
        match (&self.hit, &self.opposing) {
            (Some(hit), Some(opposing)) if !configuration.pair.is_rigid() => {
                let corners = configuration.side(1 - side).corners(hit.facet);
                Partner::Corners(corners, opposing.weights)
            }
            _ => {
                let x = configuration.side(side).x[node as usize];
                let point = x + self.n.value * self.gap.value;
                Partner::Rigid(configuration.placement.back(&point))
            }
        }
    }
}

/// The facet that a node faces, along the normal of that facet.
fn faced(configuration: &Configuration, side: usize, node: u32, reaches: f64) -> Option<Hit> {
    let own = configuration.side(side);
    let (x, normal) = (&own.x[node as usize], own.normals[node as usize]);
    let reach = reaches * configuration.reach(side, node);
    let target = configuration.side(1 - side);
    project(target, x, Ray::Facet(normal), reach, Margin::Seam)
}

/// Unit normal from the diagonals.
pub fn facet_normal(x: &[Vec3; 4]) -> Vec3 {
    (x[2] - x[0]).cross(&(x[3] - x[1])).normalize()
}

/// Derivatives of the opposite of the unit normal by the corners at the unknowns `first`.
fn normal_jacobian(x: &[Vec3; 4], first: impl Fn(usize) -> u32) -> crate::term::Jacobian {
    let (along, across) = (x[2] - x[0], x[3] - x[1]);
    let area = along.cross(&across);
    let length = area.norm();
    let m = area / length;
    let by_area = (m * m.transpose() - Matrix3::identity()) / length;
    let by_along = by_area * -across.cross_matrix();
    let by_across = by_area * along.cross_matrix();
    let mut jacobian = crate::term::Jacobian::new();
    for (corner, by) in [-by_along, -by_across, by_along, by_across]
        .into_iter()
        .enumerate()
    {
        let identity = vec![(first(corner), Matrix3::identity())];
        add_chained(&mut jacobian, &by, &identity);
    }
    jacobian
}

/// Gap and slip of a pointed node in the place `k` among the kept nodes.
pub fn kinematics(
    configuration: &Configuration,
    selection: &Selection,
    k: usize,
    frame: Option<&Frame>,
) -> Kinematics {
    let (side, node) = selection.kept()[k].place();
    let node = node as u32;
    let gap = match Spot::new(configuration, side, node) {
        Some(spot) => spot.gap,
        // It is open where it sees nothing.
        None => TrackedScalar {
            value: f64::INFINITY,
            gradient: Gradient::new(),
        },
    };
    let slip = match (selection.partner(k), frame) {
        (Some(partner), Some(frame)) => collocated::slip(configuration, side, node, partner, frame),
        _ => Tracked::default(),
    };
    Kinematics {
        gap,
        shares: collocated::shares(configuration, side, node, selection.partner(k)),
        seen_slip: slip.value,
        slip,
        presence: Presence::Facing,
        stiffness: selection.stiffness(k),
    }
}

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

/// Lanes of the node's position and normal, the corners, the unknowns and the friction.
const X: usize = 0;
const NORMAL: usize = 3;
const CORNERS: usize = 6;
const PRESSURE: usize = 18;
const TAU: usize = 21;
const LANES: usize = 24;

impl CommonField<'_> {
    fn pointed_term(&self, k: usize) -> Option<PointedTerm> {
        let configuration = self.configuration;
        let (side, node) = self.selection.kept()[k].place();
        let spot = Spot::new(configuration, side, node as u32)?;
        let weight = self.selection.weight(k);
        let pressure = self.tractions.nodes[side][node][0];
        let tau = &self.tau[side][node];
        let force = (tau.value - spot.n.value * pressure) * weight;
        let lanes = self.pointed_lanes(side, node, &spot);
        // Rows state what is left without the forces, so the node's own -f.
        let mut by_force = [[0.0; 3]; LANES];
        for axis in 0..3 {
            by_force[NORMAL + axis][axis] = -weight * pressure;
            by_force[TAU + axis][axis] = weight;
        }
        by_force[PRESSURE] = (spot.n.value * -weight).into();
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
        add(numbering.position(side, node as u32), 1.0);
        if !configuration.pair.is_rigid()
            && let Some(opposing) = &spot.opposing
        {
            for (&corner, share) in spot.corners.iter().zip(opposing.weights) {
                add(numbering.position(1 - side, corner), -share);
            }
            for at in 0..spot.corners.len() {
                let by_r = force * opposing.weights_by_r[at].transpose();
                let mut by_lane = [[0.0; 3]; LANES];
                let place = PlaceLanes {
                    x: X,
                    n: NORMAL,
                    corners: CORNERS,
                };
                opposing.spread(&by_r, place, &mut by_lane);
                for (by, slope) in gradient.iter_mut().zip(&by_lane) {
                    for axis in 0..3 {
                        by[3 * (at + 1) + axis] += slope[axis];
                    }
                }
            }
        }
        let triples = lanes.triples();
        let columns = lanes.chained(&gradient, &triples);
        Some(PointedTerm {
            term: LocalTerm::from_columns(&rows, &triples, &columns),
            facets: self.pointed_facets(side, node, &spot, &force, weight),
        })
    }

    fn pointed_lanes<'b>(&'b self, side: usize, node: usize, spot: &'b Spot) -> Lanes<'b> {
        let numbering = self.configuration.pair.numbering();
        let triple = |first: u32| Source::Unknowns { first, count: 3 };
        let mut lanes = Lanes::default();
        lanes.push(triple(numbering.position(side, node as u32)));
        lanes.push(Source::Vector(&spot.n.jacobian));
        match &spot.hit {
            Some(hit) if !self.configuration.pair.is_rigid() => {
                let corners = self.configuration.side(1 - side).corners(hit.facet);
                for corner in corners {
                    lanes.push(triple(numbering.position(1 - side, corner)));
                }
            }
            _ => lanes.push(Source::Constant(12)),
        }
        lanes.push(triple(numbering.traction(side, node as u32)));
        lanes.push(Source::Vector(&self.tau[side][node].jacobian));
        lanes
    }

    fn pointed_facets(
        &self,
        side: usize,
        node: usize,
        spot: &Spot,
        force: &Vec3,
        weight: f64,
    ) -> [Option<(FacetId, FacetForces)>; 2] {
        let own = self.configuration.side(side);
        let pressure = weight * self.tractions.nodes[side][node][0];
        let friction = weight * self.tau[side][node].value.norm();
        let mut of_side = FacetForces {
            pressure,
            friction,
            ..FacetForces::default()
        };
        let mut of_other = of_side;
        let facet = own.surface.corners(node as u32)[0].facet;
        let corners = own.corners(facet);
        if let Some(at) = corners.iter().position(|corner| *corner as usize == node) {
            of_side.force[at] = *force;
        }
        let mut facets = [None, None];
        facets[side] = Some((facet, of_side));
        if let (Some(hit), Some(opposing)) = (&spot.hit, &spot.opposing) {
            for (at, share) in opposing.weights.iter().enumerate().take(spot.corners.len()) {
                of_other.force[at] = force * -*share;
            }
            facets[1 - side] = Some((hit.facet, of_other));
        }
        facets
    }
}

/// Nodes without pressure that pierce the other side; `carried` is the field at them.
pub fn pierced(
    configuration: &Configuration,
    selection: &Selection,
    carried: &[Vec<[f64; 3]>; 2],
) -> Vec<(usize, u32)> {
    if configuration.pair.enforcement != Enforcement::Weighted {
        return Vec::new();
    }
    let mut deep: Vec<(usize, u32, f64)> = Vec::new();
    for &side in configuration.pair.deformable_sides() {
        let nothing = NO_PRESSURE * configuration.pair.sides[side].stiffness;
        let own_gap = |node: u32| {
            let is_free =
                !selection.is_pointed(side, node) && carried[side][node as usize][0] <= nothing;
            let gap = is_free.then(|| inside(configuration, side, node)).flatten();
            gap.map(|gap| (side, node, gap))
        };
        let found: Vec<(usize, u32, f64)> = (0..selection.nodes(side) as u32)
            .into_par_iter()
            .with_min_len(16)
            .filter_map(own_gap)
            .collect();
        deep.extend(found);
    }
    if deep.is_empty() {
        return Vec::new();
    }
    let means = mean_gaps(configuration, selection.scope());
    let is_sharp = |&(side, node, gap): &(usize, u32, f64)| {
        let size = configuration.side(side).sizes[node as usize];
        let mean = means[side][node as usize];
        mean.is_none_or(|mean| mean > 0.0 && mean - gap > SHARP * size)
    };
    let sharp = deep.into_iter().filter(is_sharp);
    sharp.map(|(side, node, _)| (side, node)).collect()
}

/// Gap of a node that lies deeper inside the other side than [`PIERCED`].
fn inside(configuration: &Configuration, side: usize, node: u32) -> Option<f64> {
    let own = configuration.side(side);
    let size = own.sizes[node as usize];
    if let Some((point, normal)) = configuration.plane() {
        let gap = (own.x[node as usize] - point).dot(&normal);
        let faces = own.normals[node as usize].dot(&normal) < 0.0;
        let near = -gap < configuration.reach(side, node);
        return (faces && near && gap < -PIERCED * size).then_some(gap);
    }
    let hit = faced(configuration, side, node, 1.0)?;
    let target = configuration.side(1 - side);
    let size = if configuration.pair.is_rigid() {
        size
    } else {
        let corners = target.corners(hit.facet);
        let sizes = corners.map(|corner| target.sizes[corner as usize]);
        sizes.into_iter().fold(size, f64::min)
    };
    (hit.gap < -PIERCED * size).then_some(hit.gap)
}

/// Pointed nodes of a converged configuration that are so in the next increment too.
pub fn staying(
    configuration: &Configuration,
    pointed: &Kept,
    nodes: &[Vec<NodeResult>; 2],
) -> Kept {
    let mut staying = pointed.clone();
    if !pointed.iter().flatten().any(|pointed| *pointed) {
        return staying;
    }
    let compliances = compliances(configuration);
    let scope = Scope {
        compliances: &compliances,
        depth: 0.0,
    };
    let gaps = mean_gaps(configuration, scope);
    for side in 0..2 {
        for (node, stays) in staying[side].iter_mut().enumerate() {
            let size = configuration.side(side).sizes[node];
            *stays &= nodes[side][node].pressure > 0.0
                && gaps[side][node].is_none_or(|gap| gap > CLOSING * size);
        }
    }
    staying
}

/// `integral N_I g / integral N_I` at all nodes with facets near the other side.
fn mean_gaps(configuration: &Configuration, scope: Scope) -> [Vec<Option<f64>>; 2] {
    let mut sums = [0, 1].map(|side| {
        let count = configuration.sides[side].as_ref().map_or(0, |s| s.x.len());
        vec![[0.0; 2]; count]
    });
    for paired in paired_facets(configuration, scope, Derivatives::None, |_| true) {
        let origin = paired.origin(configuration);
        for corner in 0..8 {
            if let Some((side, node)) = paired.node(configuration, corner) {
                let sum = paired.difference(corner, &paired.x, &origin);
                let [gap, area] = &mut sums[side][node as usize];
                *gap += paired.segment.normal.dot(&sum);
                *area += paired.area_of(corner);
            }
        }
    }
    sums.map(|side| {
        let mean = |[gap, area]: [f64; 2]| (area > 0.0).then(|| gap / area);
        side.into_iter().map(mean).collect()
    })
}
