//! The place that a tip presses on, with its derivatives.

use nalgebra::Matrix3;
use striae_mesh::Vec3;
use striae_surface::{facet::Shape, topology::distinct_corners};

use super::Tip;
use crate::{
    configuration::Configuration,
    frame::Tracked,
    kinematics::TrackedScalar,
    opposing::Opposing,
    projection::{Hit, Margin, Ray, project},
    selection::Partner,
    term::{Gradient, Jacobian},
    weighted::add_chained,
};

/// How many reaches around a tip an opposing facet is looked for.
const FOLLOW: f64 = 4.0;

/// What a tip presses on.
pub struct Spot {
    /// The point of the facet; a plane has none.
    pub hit: Option<Hit>,
    /// Unit normal of the tip, against that of the facet or plane.
    pub n: Tracked,
    /// Gap.
    pub gap: TrackedScalar,
    /// Corners of the facet without repetition.
    pub corners: Vec<u32>,
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
            return Some(Self {
                hit: None,
                n: Tracked {
                    value: -normal,
                    jacobian: Vec::new(),
                },
                gap: TrackedScalar {
                    value: (x - point).dot(&normal),
                    gradient: own.map(|own| (own, normal)).into_iter().collect(),
                },
                corners: Vec::new(),
                opposing: None,
            });
        }
        let hit = faced(configuration, tip, FOLLOW * tip.reach(configuration))?;
        let target = configuration.side(1 - side);
        let corners = target.corners(hit.facet);
        let positions = target.corner_positions(hit.facet);
        let mut n = Tracked {
            value: -facet_normal(&positions),
            jacobian: Vec::new(),
        };
        if yields {
            n.jacobian = normal_jacobian(&positions, |corner| {
                numbering.position(1 - side, corners[corner])
            });
        }
        let opposing = Opposing::new(Shape::of(&corners), &hit, &n.value, &positions);
        let own = own.map(|own| (own, -opposing.gap_by_r));
        let mut gradient: Gradient = own.into_iter().collect();
        let mut add = |first: u32, slope: Vec3| match gradient.iter_mut().find(|e| e.0 == first) {
            Some((_, sum)) => *sum += slope,
            None => gradient.push((first, slope)),
        };
        if yields {
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
    pub fn partner(&self, configuration: &Configuration, tip: Tip) -> Partner {
        match (&self.hit, &self.opposing) {
            (Some(hit), Some(opposing)) if tip.presses_on_deformable(configuration) => {
                let corners = configuration.side(1 - tip.side()).corners(hit.facet);
                Partner::Corners(corners, opposing.weights)
            }
            _ => {
                let point = tip.position(configuration) + self.n.value * self.gap.value;
                Partner::Rigid(configuration.placement.back(&point))
            }
        }
    }
}

/// The facet that a tip faces within `reach`, along the normal of that facet.
pub fn faced(configuration: &Configuration, tip: Tip, reach: f64) -> Option<Hit> {
    let (x, normal) = (tip.position(configuration), tip.normal(configuration));
    let target = configuration.side(1 - tip.side());
    project(target, &x, Ray::Facet(normal), reach, Margin::Seam)
}

/// Unit normal from the diagonals.
pub fn facet_normal(x: &[Vec3; 4]) -> Vec3 {
    (x[2] - x[0]).cross(&(x[3] - x[1])).normalize()
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
