//! Contact that is narrower than facets resolve.
//!
//! The width of the contact zone of smooth surfaces follows from loads and curvature, and facets
//! that are not much smaller resolve neither its size nor its pressure. The width `w` is that of a
//! rectangle with the same smaller moment of inertia as the pressed nodes `x_I` of the finer side,
//! with the areas `A_I` that belong to them,
//!
//! ```text
//! w = sqrt(12 l),   l = middle eigenvalue of  sum A_I (x_I - x)(x_I - x)^T / sum A_I + mean A_I / 12
//! ```
//!
//! which is 1.73 times the radius of a round zone. Facets are too coarse where fewer than [`FEWEST`]
//! lie across it, and [`FACETS`] would do. Zones that end at the edge of a surface are as wide as
//! that is, and are not judged.

use nalgebra::{Matrix3, SymmetricEigen};
use striae_contact::{configuration::Configuration, interference::across, side::Side};
use striae_mesh::{NodeId, Vec3};
use striae_surface::node::SurfaceNode;

use crate::{
    interference::{Positions, configuration},
    problem::Problem,
    state::State,
};

/// Facets across the zone of contact that show roughly its size.
const FEWEST: f64 = 3.0;
/// Facets across the zone of contact that would do.
const FACETS: f64 = 5.0;

/// Facets that are too coarse for the contact that they are in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coarse {
    /// Body of the coarser side.
    pub body: usize,
    /// A node there in the middle of the contact.
    pub node: NodeId,
    /// Facet size there.
    pub size: f64,
    /// Facet size that would do.
    pub enough: f64,
}

/// The facets of a pair in a state, if they are too coarse.
pub fn coarse(problem: &Problem, pair: usize, state: &State) -> Option<Coarse> {
    let contact = &problem.pairs[pair].contact;
    let at = configuration(problem, pair, Positions::from(state));
    let sides = contact.deformable_sides().iter();
    let zones = sides.filter_map(|&side| Zone::new(problem, (pair, side), state, &at));
    let zones: Vec<Zone> = zones.collect();
    let finest = zones.iter().min_by(|a, b| a.size.total_cmp(&b.size))?;
    if zones.iter().any(|zone| zone.ends_at_edge) {
        return None;
    }
    let width = finest.width();
    let opposite = finest.opposite(&at);
    let own = (finest.middle, finest.side, finest.size);
    let (node, side, size) = [Some(own), opposite]
        .into_iter()
        .flatten()
        .max_by(|a, b| a.2.total_cmp(&b.2))?;
    let (body, node) = problem.named_node(problem.surface_node(pair, side, node)?);
    (size > width / FEWEST).then_some(Coarse {
        body,
        node,
        size,
        enough: width / FACETS,
    })
}

/// The pressed nodes of a side.
struct Zone {
    side: Side,
    /// The one in the middle.
    middle: SurfaceNode,
    /// Facet size there.
    size: f64,
    /// Moments of inertia over the area.
    moments: Matrix3<f64>,
    ends_at_edge: bool,
}

impl Zone {
    fn new(
        problem: &Problem,
        (pair, side): (usize, Side),
        state: &State,
        at: &Configuration,
    ) -> Option<Self> {
        let surface = problem.pairs[pair].contact.sides[side].surface()?;
        let areas = problem.pairs[pair].areas(side, &state.pairs[pair]);
        let results = state.pairs[pair].nodes[side].iter().zip(areas).enumerate();
        let pressed = results.filter(|(_, (node, area))| node.pressure > 0.0 && *area > 0.0);
        let pressed = pressed.filter_map(|(node, (_, area))| {
            let node = SurfaceNode::new(node);
            let global = problem.surface_node(pair, side, node)?;
            Some((node, state.positions[global], area))
        });
        let pressed: Vec<(SurfaceNode, Vec3, f64)> = pressed.collect();
        let area: f64 = pressed.iter().map(|(.., area)| area).sum();
        let centre = pressed.iter().map(|(_, x, area)| x * *area).sum::<Vec3>() / area;
        let outer = |(_, x, area): &(_, Vec3, f64)| (x - centre) * (x - centre).transpose() * *area;
        let spread = pressed.iter().map(outer).sum::<Matrix3<f64>>() / area;
        let each = area / pressed.len() as f64;
        let distance = |(_, x, _): &&(SurfaceNode, Vec3, f64)| (x - centre).norm();
        let middle = pressed
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        Some(Self {
            side,
            middle: middle.0,
            size: at.side(side).sizes[middle.0],
            moments: spread + Matrix3::identity() * (each / 12.0),
            ends_at_edge: pressed
                .iter()
                .any(|(node, ..)| surface.is_on_boundary(*node)),
        })
    }

    fn width(&self) -> f64 {
        let mut moments = SymmetricEigen::new(self.moments).eigenvalues;
        moments.as_mut_slice().sort_unstable_by(f64::total_cmp);
        (12.0 * moments[1]).sqrt()
    }

    /// A node of a deformable side opposite to the middle, and the facet size there.
    fn opposite(&self, at: &Configuration) -> Option<(SurfaceNode, Side, f64)> {
        let side = self.side.opposite();
        if !at.pair.deformable_sides().contains(&side) {
            return None;
        }
        let (corners, weights) = across(at, self.side, self.middle)?.opposite?;
        let nearest = (0..4).max_by(|a, b| weights[*a].total_cmp(&weights[*b]))?;
        let node = corners[nearest];
        Some((node, side, at.side(side).sizes[node]))
    }
}
