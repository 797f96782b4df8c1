//! Computed contact tractions beside closed forms.
//!
//! Closed forms of contact assume small strains, under which it does not matter
//! where a traction is found and to which area it refers. Here it does. Nominal
//! tractions, forces per area at rest at places at rest, are compared: against a
//! plane, and between equal bodies, contact opens and closes at the same material
//! points in either theory, however much the surface is strained in itself.
//!
//! Tractions are sampled over the facets of a surface, each sample standing for
//! an area. With them an error is `sqrt(integral |t - t_exact|^2 dA)` over
//! `sqrt(integral |t_exact|^2 dA)`. Sizes of contact and stick zones come from
//! ellipses `v = v0 sqrt(1 - r^2/a^2)` fitted to samples: `v^2` is linear in
//! `r^2`, and its zero is found to a fraction of an element.

use std::collections::BTreeMap;

use striae_contact::{side::Side, unknowns::Status};
use striae_figure::{Axis, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_surface::{
    facet::{Shape, area_vector},
    node::SurfaceNode,
};
use striae_verify::fitted_rate;

use super::{
    measure::{MeasuredNode, facets, surface_nodes},
    study::Run,
};

/// Samples along each edge of a facet.
const PARTS: usize = 8;

/// Nominal tractions at a place of a surface and the area it stands for.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Position of the node.
    pub place: Vec3,
    /// Area at rest.
    pub area: f64,
    /// Normal force per area at rest.
    pub pressure: f64,
    /// Friction per area at rest.
    pub tau: Vec3,
    /// Status, of the nearest node.
    pub status: Status,
}

/// A semi-ellipse fitted to samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Value in the middle.
    pub peak: f64,
    /// Distance at which it vanishes.
    pub half_width: f64,
}

impl Ellipse {
    /// Value at a distance from the middle.
    pub fn at(&self, r: f64) -> f64 {
        self.peak * (1.0 - (r / self.half_width).powi(2)).max(0.0).sqrt()
    }
}

/// Samples inside of the facets under pressure on a side of the first pair.
pub fn samples(run: &Run, side: Side) -> Vec<Sample> {
    let grid: Vec<[f64; 2]> = grid().collect();
    let facets = sampled(run, side, &grid);
    facets
        .into_iter()
        .flat_map(|(_, samples)| samples)
        .collect()
}

/// Samples at the nodes under pressure on a side of the first pair, means over the
/// facets around them weighted by area.
pub fn nodal_samples(run: &Run, side: Side) -> Vec<Sample> {
    const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mut means: BTreeMap<SurfaceNode, Sample> = BTreeMap::new();
    for (facet, samples) in sampled(run, side, &CORNERS) {
        for (node, sample) in facet.into_iter().zip(samples) {
            let Some(mean) = means.get_mut(&node) else {
                means.insert(node, sample);
                continue;
            };
            let area = mean.area + sample.area;
            let [old, new] = [mean.area / area, sample.area / area];
            mean.pressure = old * mean.pressure + new * sample.pressure;
            mean.tau = mean.tau * old + sample.tau * new;
            mean.area = area;
        }
    }
    means.into_values().filter(|s| s.pressure > 0.0).collect()
}

/// Relative difference in the mean square of the mean pressures around the nodes of a
/// side from the means of an exact one over the same areas, `integral N_k p / integral
/// N_k` at rest. Unlike a field drawn through the means it has nothing of what the means
/// take from a pressure that ends as a root.
pub fn difference_of_means(run: &Run, side: Side, exact: impl Fn(&Vec3) -> f64) -> f64 {
    let nodes = surface_nodes(run, side);
    let mut means = vec![[0.0; 3]; nodes.len()];
    for &facet in facets(run, side) {
        let corners = facet.map(|corner| &nodes[corner]);
        for [xi, eta] in grid() {
            let weights = Shape::Quadrilateral.weights(xi, eta);
            let parts = || corners.iter().zip(weights.value);
            let place: Vec3 = parts().map(|(node, weight)| node.reference * weight).sum();
            let area = |place: &dyn Fn(&MeasuredNode) -> Vec3| {
                area_vector(&weights, &corners.map(place)).norm()
            };
            let at_rest = area(&|node| node.reference) * 4.0 / (PARTS * PARTS) as f64;
            let stretch = area(&|node| node.position) / area(&|node| node.reference);
            let known = exact(&place);
            for ((node, weight), corner) in parts().zip(facet) {
                let share = weight * at_rest;
                let [area, computed, expected] = &mut means[corner];
                *area += share;
                *computed += share * stretch * node.result.mean_pressure();
                *expected += share * known;
            }
        }
    }
    let around = means.into_iter().filter(|[area, ..]| *area > 0.0);
    let (mut off, mut whole) = (0.0, 0.0);
    for [area, computed, expected] in around {
        off += (computed - expected).powi(2) / area;
        whole += expected.powi(2) / area;
    }
    (off / whole).sqrt()
}

/// Places inside of a facet.
fn grid() -> impl Iterator<Item = [f64; 2]> {
    let place = |part: usize| (2 * part + 1) as f64 / PARTS as f64 - 1.0;
    (0..PARTS * PARTS).map(move |at| [place(at / PARTS), place(at % PARTS)])
}

/// Samples at places of the facets under pressure, in coordinates of the facets.
fn sampled(run: &Run, side: Side, places: &[[f64; 2]]) -> Vec<([SurfaceNode; 4], Vec<Sample>)> {
    let nodes = surface_nodes(run, side);
    let mut all = Vec::new();
    for &facet in facets(run, side) {
        let corners = facet.map(|corner| &nodes[corner]);
        if corners
            .iter()
            .all(|node| node.result.mean_pressure() <= 0.0)
        {
            continue;
        }
        let samples = places.iter().map(|&[xi, eta]| {
            let weights = Shape::Quadrilateral.weights(xi, eta);
            let area = |place: &dyn Fn(&MeasuredNode) -> Vec3| {
                area_vector(&weights, &corners.map(place)).norm()
            };
            let at_rest = area(&|node| node.reference);
            let stretch = area(&|node| node.position) / at_rest;
            let mean = |value: &dyn Fn(&MeasuredNode) -> Vec3| -> Vec3 {
                let parts = corners.iter().zip(weights.value);
                parts.map(|(node, weight)| value(node) * weight).sum()
            };
            let heaviest = (0..4).max_by(|&i, &j| weights.value[i].total_cmp(&weights.value[j]));
            Sample {
                place: mean(&|node| node.reference),
                area: at_rest * 4.0 / places.len() as f64,
                pressure: stretch * mean(&|node| Vec3::x() * node.result.mean_pressure()).x,
                tau: mean(&|node| node.result.mean_friction()) * stretch,
                status: corners[heaviest.unwrap_or(0)].result.status,
            }
        });
        all.push((facet, samples.collect()));
    }
    all
}

/// Centre of pressure.
pub fn centre(samples: &[Sample]) -> Vec3 {
    let moment: Vec3 = samples
        .iter()
        .map(|s| s.place * (s.pressure * s.area))
        .sum();
    let force: f64 = samples.iter().map(|s| s.pressure * s.area).sum();
    moment / force
}

/// Relative difference in the mean square of a traction from an exact one.
pub fn difference(
    samples: &[Sample],
    value: impl Fn(&Sample) -> Vec3,
    exact: impl Fn(&Sample) -> Vec3,
) -> f64 {
    let (mut off, mut whole) = (0.0, 0.0);
    for sample in samples {
        let known = exact(sample);
        off += sample.area * (value(sample) - known).norm_squared();
        whole += sample.area * known.norm_squared();
    }
    (off / whole).sqrt()
}

/// The semi-ellipse closest to points `[r, v]` in the mean square of `v^2`.
pub fn fitted_ellipse(points: &[[f64; 2]]) -> Ellipse {
    let count = points.len() as f64;
    let squares = || points.iter().map(|[r, v]| [r * r, v * v]);
    let mean = squares().fold([0.0; 2], |[a, b], [x, y]| [a + x / count, b + y / count]);
    let (mut above, mut below) = (0.0, 0.0);
    for [x, y] in squares() {
        above += (x - mean[0]) * (y - mean[1]);
        below += (x - mean[0]).powi(2);
    }
    let slope = above / below;
    let square = mean[1] - slope * mean[0];
    Ellipse {
        peak: square.sqrt(),
        half_width: (-square / slope).sqrt(),
    }
}

/// Rate of errors over the element sizes, NaN unless there are two of them.
pub fn rate(points: &[[f64; 2]]) -> f64 {
    let usable = points.len() > 1 && points.iter().all(|[h, e]| *h > 0.0 && *e > 0.0);
    let (h, error): (Vec<f64>, Vec<f64>) = points.iter().map(|[h, e]| (*h, *e)).unzip();
    if usable {
        fitted_rate(&h, &error)
    } else {
        f64::NAN
    }
}

/// Limit `v0` of values `v0 + C h^r` on the three finest of meshes each half as
/// wide as the one before (Richardson), NaN with fewer.
pub fn limit(points: &[[f64; 2]]) -> f64 {
    let [.., [_, coarse], [_, middle], [_, fine]] = points else {
        return f64::NAN;
    };
    let (before, last) = (middle - coarse, fine - middle);
    fine - last * last / (last - before)
}

/// Errors over element sizes with fitted rates, in double logarithms.
pub fn convergence(unit: &str, families: &[(String, Vec<[f64; 2]>)]) -> Figure {
    let markers = [
        Marker::Circle,
        Marker::Square,
        Marker::Triangle,
        Marker::Diamond,
    ];
    let panel = Panel::new(
        Axis::logarithmic("element size", unit),
        Axis::logarithmic("relative error", ""),
    );
    let panel = families
        .iter()
        .zip(markers)
        .fold(panel, |panel, ((name, points), marker)| {
            let points = points.clone();
            panel.with(Series::new(
                name.clone(),
                Content::PowerLaw { points, marker },
            ))
        });
    Figure::new(Width::Column, vec![panel])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ellipse_is_found_from_its_points() {
        let points = [0.0, 0.3, 0.5, 1.1].map(|r: f64| [r, 2.0 * (1.0 - r * r / 2.25).sqrt()]);
        let ellipse = fitted_ellipse(&points);
        assert!((ellipse.peak - 2.0).abs() < 1e-14);
        assert!((ellipse.half_width - 1.5).abs() < 1e-14);
    }

    #[test]
    fn the_limit_of_a_power_law_is_found() {
        let points = [0.8, 0.4, 0.2, 0.1].map(|h: f64| [h, 3.0 - 2.0 * h.powf(1.3)]);
        assert!((limit(&points) - 3.0).abs() < 1e-12);
        assert!(limit(&points[..2]).is_nan());
    }

    #[test]
    fn differences_are_relative_and_weighted_by_area() {
        let sample = |pressure: f64, area: f64| Sample {
            place: Vec3::new(pressure, 0.0, 0.0),
            area,
            pressure,
            tau: Vec3::zeros(),
            status: Status::Stick,
        };
        let samples = [sample(1.0, 3.0), sample(2.0, 1.0)];
        let normal = |s: &Sample| Vec3::new(0.0, 0.0, s.pressure);
        assert_eq!(difference(&samples, normal, normal), 0.0);
        let off = difference(&samples, normal, |_| Vec3::new(0.0, 0.0, 1.0));
        assert!((off - 0.5).abs() < 1e-15);
        assert!((centre(&samples).x - 7.0 / 5.0).abs() < 1e-15);
    }
}
