//! The place that a tip presses on, with its derivatives.
//!
//! It is found along the normal `m` of the facet; a rigid point that is beyond the edges of all
//! facets faces the edge or node between them, see `crate::crease`. The traction of a node acts along that
//! normal, too; that of a rigid point along the one between the nodal normals of the
//! deformable side, `n = -unit(sum N_J n_J)`. It turns continuously where the point goes from
//! one facet to the next, as it does again and again in the valley that it presses in.

use nalgebra::Matrix3;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    facet::{Shape, facet_normal},
    node::SurfaceNode,
    topology::distinct_corners,
};

use crate::{
    configuration::Configuration,
    crease::{Crease, Kind, crease},
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
    /// Opposite of the normal along which it is found, with the derivatives that
    /// `Opposing` is chained with.
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
        let place = faced_place(configuration, tip, FOLLOW * tip.reach(configuration))?;
        let hit = place.hit();
        let target = configuration.side(side.opposite());
        let corners = target.corners(hit.facet);
        let (ray, opposing) = place.seen(configuration, tip);
        let own = own.map(|own| (own, -opposing.gap_by_r));
        let mut gradient: Gradient = own.into_iter().collect();
        if yields {
            for (corner, weight) in corners.iter().zip(opposing.weights) {
                let first = numbering.position(side.opposite(), *corner);
                add_slope(&mut gradient, first, opposing.gap_by_r * weight);
            }
        }
        for (first, block) in &ray.jacobian {
            add_slope(&mut gradient, *first, block.tr_mul(&opposing.gap_by_n));
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

/// What a tip faces.
enum Place {
    /// A facet, along its normal.
    Facet(Hit),
    /// The edge or node between facets.
    Between(Crease),
}

impl Place {
    fn hit(&self) -> Hit {
        match self {
            Self::Facet(hit) => *hit,
            Self::Between(crease) => crease.hit,
        }
    }

    /// Opposite of the normal that leads there, and the place with its derivatives.
    fn seen(&self, configuration: &Configuration, tip: Tip) -> (Tracked, Opposing) {
        let opposite = tip.side().opposite();
        let target = configuration.side(opposite);
        let by_corners = |facet: FacetId| {
            let (corners, x) = (target.corners(facet), target.corner_positions(facet));
            let numbering = configuration.pair.numbering();
            let first = |corner: usize| numbering.position(opposite, corners[corner]);
            match tip.presses_on_deformable(configuration) {
                true => normal_jacobian(&x, first),
                false => Jacobian::new(),
            }
        };
        match self {
            Self::Facet(hit) => {
                let (corners, x) = (
                    target.corners(hit.facet),
                    target.corner_positions(hit.facet),
                );
                let value = -facet_normal(&x);
                let opposing = Opposing::new(Shape::of(&corners), hit, &value, &x);
                let jacobian = by_corners(hit.facet);
                (Tracked { value, jacobian }, opposing)
            }
            Self::Between(crease) => {
                let mut jacobian = Jacobian::new();
                if let Kind::Edge(edge) = &crease.kind {
                    for (facet, share) in edge.facets.into_iter().zip(edge.shares) {
                        let by = Matrix3::from_diagonal_element(share);
                        add_chained(&mut jacobian, &by, &by_corners(facet));
                    }
                }
                let value = crease.normal;
                let opposing = crease.opposing(&target.corners(crease.hit.facet));
                (Tracked { value, jacobian }, opposing)
            }
        }
    }
}

/// The point that a tip faces within `reach`, see [`Spot`].
pub fn faced(configuration: &Configuration, tip: Tip, reach: f64) -> Option<Hit> {
    faced_place(configuration, tip, reach).map(|place| place.hit())
}

/// What a tip faces within `reach`. The facet that a node was in at the start of an increment
/// holds it until it is `AWAY` beyond its edges: between two facets that dip towards each other
/// either normal drives it to the other.
fn faced_place(configuration: &Configuration, tip: Tip, reach: f64) -> Option<Place> {
    let (x, normal) = (tip.position(configuration), tip.normal(configuration));
    let target = configuration.side(tip.side().opposite());
    let along = Ray::Facet(normal);
    let on_facet = |margin: Margin| project(target, &x, along, reach, margin).map(Place::Facet);
    match tip {
        Tip::Node { home, .. } => {
            let held = home.and_then(|home| project_on(target, home, &x, along, AWAY));
            let held = held.filter(|hit| hit.gap.abs() <= reach);
            held.map(Place::Facet).or_else(|| on_facet(Margin::Seam))
        }
        Tip::Rigid(_) => {
            let inside = on_facet(Margin::Inside);
            let nearer = inside.as_ref().map_or(reach, |place| place.hit().gap.abs());
            let between = crease(target, &x, &normal, nearer).map(Place::Between);
            between.or(inside).or_else(|| on_facet(Margin::Seam))
        }
    }
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
