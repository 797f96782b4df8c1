//! The place that a tip presses on, with its derivatives.
//!
//! It is found along the normal `m` of the facet. The traction of a node acts along that
//! normal, too; that of a rigid point along the one between the nodal normals of the
//! deformable side, `n = -unit(sum N_J n_J)`. It turns continuously where the point goes from
//! one facet to the next, as it does again and again in the valley that it presses in.

use nalgebra::Matrix3;
use striae_mesh::Vec3;
use striae_surface::{
    facet::{Shape, facet_normal},
    node::SurfaceNode,
    topology::distinct_corners,
};

use crate::{
    configuration::Configuration,
    nodal_normal::own_normal,
    opposing::Opposing,
    partner::Partner,
    projection::{Hit, Margin, Ray, project, project_on},
    side::Side,
    term::{Gradient, Jacobian},
    tip::Tip,
    tracked::{Tracked, TrackedScalar, add_chained, add_slope},
};

/// How many reaches around a tip an opposing facet is looked for.
const FOLLOW: f64 = 4.0;

/// How far beyond its edges a facet holds a node, in facet coordinates: a twentieth of the
/// side of a quadrilateral, a tenth of that of a triangle.
const AWAY: f64 = 0.1;

/// What a tip presses on.
pub struct Spot {
    /// The point of the facet; a plane has none.
    pub hit: Option<Hit>,
    /// Unit normal of the tip, against that of the facet or plane.
    pub n: Tracked,
    /// Opposite of the normal of the facet, along which it is found.
    pub ray: Tracked,
    /// Gap.
    pub gap: TrackedScalar,
    /// Corners of the facet without repetition.
    pub corners: Vec<SurfaceNode>,
    /// The projection with its derivatives.
    pub opposing: Option<Opposing>,
}

impl Spot {
    /// The point opposite to a tip along the normal of what it faces there; `None` beside
    /// the other side or far away from it.
    pub fn new(configuration: &Configuration, tip: Tip) -> Option<Self> {
        let numbering = configuration.pair.numbering();
        let (side, own) = (tip.side(), tip.unknown(configuration));
        let x = tip.position(configuration);
        let yields = tip.presses_on_deformable(configuration);
        if let Some((point, normal)) = configuration.plane() {
            let plane = Tracked {
                value: -normal,
                jacobian: Vec::new(),
            };
            return Some(Self {
                hit: None,
                n: plane.clone(),
                ray: plane,
                gap: TrackedScalar {
                    value: (x - point).dot(&normal),
                    gradient: own.map(|own| (own, normal)).into_iter().collect(),
                },
                corners: Vec::new(),
                opposing: None,
            });
        }
        let hit = faced(configuration, tip, FOLLOW * tip.reach(configuration))?;
        let target = configuration.side(side.opposite());
        let corners = target.corners(hit.facet);
        let positions = target.corner_positions(hit.facet);
        let mut ray = Tracked {
            value: -facet_normal(&positions),
            jacobian: Vec::new(),
        };
        if yields {
            ray.jacobian = normal_jacobian(&positions, |corner| {
                numbering.position(side.opposite(), corners[corner])
            });
        }
        let opposing = Opposing::new(Shape::of(&corners), &hit, &ray.value, &positions);
        let own = own.map(|own| (own, -opposing.gap_by_r));
        let mut gradient: Gradient = own.into_iter().collect();
        if yields {
            for (corner, weight) in corners.iter().zip(opposing.weights) {
                let first = numbering.position(side.opposite(), *corner);
                add_slope(&mut gradient, first, opposing.gap_by_r * weight);
            }
        }
        let by_n = opposing.gap_by_r * -hit.gap;
        for (first, block) in &ray.jacobian {
            add_slope(&mut gradient, *first, block.tr_mul(&by_n));
        }
        let n = match tip {
            Tip::Node { .. } => ray.clone(),
            Tip::Rigid(_) => between_nodes(configuration, &hit, &opposing, &ray),
        };
        Some(Self {
            hit: Some(hit),
            n,
            ray,
            gap: TrackedScalar {
                value: hit.gap,
                gradient,
            },
            corners: distinct_corners(&corners).to_vec(),
            opposing: Some(opposing),
        })
    }

    /// The material point, for slip in an increment that starts here.
    pub fn partner(&self, configuration: &Configuration, tip: Tip) -> Partner {
        match (&self.hit, &self.opposing) {
            (Some(hit), Some(opposing)) if tip.presses_on_deformable(configuration) => {
                let corners = configuration.side(tip.side().opposite()).corners(hit.facet);
                Partner::Corners(corners, opposing.weights)
            }
            _ => {
                let point = tip.position(configuration) + self.n.value * self.gap.value;
                Partner::Rigid(configuration.placement.back(&point))
            }
        }
    }
}

/// `-unit(sum N_J n_J)` with the nodal normals of side `a` where a rigid point is.
fn between_nodes(
    configuration: &Configuration,
    hit: &Hit,
    opposing: &Opposing,
    ray: &Tracked,
) -> Tracked {
    let numbering = configuration.pair.numbering();
    let corners = configuration.side(Side::A).corners(hit.facet);
    let normals = corners.map(|corner| own_normal(configuration, Side::A, corner));
    let weighted = || normals.iter().zip(opposing.weights);
    let sum: Vec3 = weighted()
        .map(|(normal, weight)| normal.value * weight)
        .sum();
    let (length, value) = (sum.norm(), -sum.normalize());
    let by_sum = (value * value.transpose() - Matrix3::identity()) / length;
    let slopes = normals.iter().zip(&opposing.weights_by_r);
    let by_r: Matrix3<f64> = slopes.map(|(n, by_r)| n.value * by_r.transpose()).sum();
    let by_r = by_sum * by_r;
    let mut jacobian = Jacobian::new();
    for (at, (normal, weight)) in weighted().enumerate() {
        add_chained(&mut jacobian, &(by_sum * weight), &normal.jacobian);
        let first = numbering.position(Side::A, corners[at]);
        let here = vec![(first, Matrix3::identity())];
        add_chained(&mut jacobian, &(by_r * weight), &here);
    }
    add_chained(&mut jacobian, &(by_r * -hit.gap), &ray.jacobian);
    Tracked { value, jacobian }
}

/// The facet that a tip faces within `reach`, along the normal of that facet. The one that a
/// node was in at the start of an increment holds it until it is `AWAY` beyond its edges:
/// between two facets that dip towards each other either normal drives it to the other.
pub fn faced(configuration: &Configuration, tip: Tip, reach: f64) -> Option<Hit> {
    let (x, normal) = (tip.position(configuration), tip.normal(configuration));
    let target = configuration.side(tip.side().opposite());
    if let Tip::Node {
        home: Some(home), ..
    } = tip
        && let Some(hit) = project_on(target, home, &x, Ray::Facet(normal), AWAY)
        && hit.gap.abs() <= reach
    {
        return Some(hit);
    }
    project(target, &x, Ray::Facet(normal), reach, Margin::Seam)
}

/// Derivatives of the opposite of the unit normal by the corners at the unknowns `first`.
fn normal_jacobian(x: &[Vec3; 4], first: impl Fn(usize) -> u32) -> Jacobian {
    let (along, across) = (x[2] - x[0], x[3] - x[1]);
    let area = along.cross(&across);
    let length = area.norm();
    let m = area / length;
    let by_area = (m * m.transpose() - Matrix3::identity()) / length;
    let by_along = by_area * -across.cross_matrix();
    let by_across = by_area * along.cross_matrix();
    let mut jacobian = Jacobian::new();
    for (corner, by) in [-by_along, -by_across, by_along, by_across]
        .into_iter()
        .enumerate()
    {
        let identity = vec![(first(corner), Matrix3::identity())];
        add_chained(&mut jacobian, &by, &identity);
    }
    jacobian
}
