//! Fields of a finished run, as numbers and as parts of figures.

use nalgebra::Matrix3;
use striae_contact::{
    side::Side,
    unknowns::{NodeResult, Status},
};
use striae_figure::{Axis, Color, Content, Series};
use striae_law::friction::Textures;
use striae_mesh::{ElementId, Vec3};
use striae_solve::state::State;
use striae_surface::{facet::Shape, node::SurfaceNode};

use super::study::Run;

/// A node of a contact surface at the end of a run.
pub struct MeasuredNode<'a> {
    /// Position in the reference configuration.
    pub reference: Vec3,
    /// Position in the current configuration.
    pub position: Vec3,
    /// Its tractions.
    pub result: &'a NodeResult,
}

/// Nodes of a side of the first pair, in the order of the surface.
pub fn surface_nodes(run: &Run, side: Side) -> Vec<MeasuredNode<'_>> {
    surface_nodes_in(run, &run.finished.state, side)
}

/// Nodes of a side of the first pair in another state of the run.
pub fn surface_nodes_in<'a>(run: &'a Run, state: &'a State, side: Side) -> Vec<MeasuredNode<'a>> {
    let problem = &run.finished.problem;
    let results = state.pairs[0].nodes[side].iter().enumerate();
    results
        .filter_map(|(index, result)| {
            let node = problem.surface_node(0, side, SurfaceNode::new(index))?;
            Some(MeasuredNode {
                reference: problem.reference[node],
                position: state.positions[node],
                result,
            })
        })
        .collect()
}

/// Largest difference of friction from the law, for slip and textures as they are, at the
/// kept nodes of side `a` of a pair that slip, over the largest that it may be at any node.
///
/// `opposite` is the texture of a plane on side `b`, if it has one.
pub fn law_error(run: &Run, pair: usize, opposite: Option<Vec3>) -> f64 {
    let plan = run.finished.problem.plans.last();
    let Some(friction) = plan.map(|plan| &plan.frictions[pair]) else {
        return f64::NAN;
    };
    let state = &run.finished.state.pairs[pair];
    let nodes = state.nodes[0].iter().zip(&state.kept[0]);
    let errors = nodes.filter_map(|(node, kept)| {
        let tangential = node.slip - node.normal * node.normal.dot(&node.slip);
        let way = tangential.try_normalize(0.0)?;
        if !*kept || node.status != Status::Slip || node.pressure <= 0.0 {
            return None;
        }
        let own = node.normal.cross(&node.texture).try_normalize(0.0);
        // Seen from this side, the structural vector of the other one is turned round.
        let opposite = opposite.map(|s| node.normal.cross(&s).normalize());
        let kernel = friction.kernel(&node.normal, &Textures { own, opposite });
        let way = (kernel.k_inverse * way).normalize();
        let cap = friction.cap(node.pressure, 0.0);
        let tau = kernel.traction(cap, &(way * (cap * kernel.reach(&way))));
        Some([(node.tau - tau).norm(), cap])
    });
    let worst = |worst: [f64; 2], error: [f64; 2]| [0, 1].map(|at| worst[at].max(error[at]));
    let [error, cap] = errors.fold([0.0; 2], worst);
    error / cap
}

/// Largest difference of the Cauchy stress from `expected` at the Gauss points
/// of all bodies, over the norm of `expected`.
pub fn stress_error(run: &Run, expected: &Matrix3<f64>) -> f64 {
    let (problem, state) = (&run.finished.problem, &run.finished.state);
    let mut largest = 0.0_f64;
    for (body, model) in problem.model.bodies.iter().enumerate() {
        let elements = model.mesh.elements().zip(problem.elements[body].iter());
        for (at, (corners, element)) in elements.enumerate() {
            let nodes = problem.nodes(body, corners).into_iter();
            let current: Vec<Vec3> = nodes.map(|node| state.positions[node]).collect();
            let (driven, variables) = problem.made_of(state, body, ElementId::new(at));
            let Ok(stresses) = element.stress(&current, driven, variables) else {
                return f64::NAN;
            };
            for stress in stresses {
                largest = largest.max((stress - expected).norm());
            }
        }
    }
    largest / expected.norm()
}

/// Pressure in colour on a side of the first pair where the other side covers
/// it, seen from above; every facet is divided into `parts` x `parts`.
pub fn pressure_map(run: &Run, side: Side, parts: usize, bar: Axis) -> Content {
    let windows = outlines(run, side.opposite());
    let mut polygons = Vec::new();
    let mut values = Vec::new();
    for (polygon, pressure) in cells(run, side, parts) {
        for window in &windows {
            let common = clipped(&polygon, window);
            if common.len() > 2 {
                polygons.push(common);
                values.push(pressure);
            }
        }
    }
    Content::Facets {
        polygons,
        values,
        bar,
    }
}

/// Parts of all facets of a side with the pressure in their middles.
fn cells(run: &Run, side: Side, parts: usize) -> Vec<(Vec<[f64; 2]>, f64)> {
    let nodes = surface_nodes(run, side);
    let mut cells = Vec::new();
    for facet in facets(run, side) {
        let corners = facet.map(|corner| &nodes[corner]);
        let at = |i: f64, j: f64| {
            let place = |share: f64| 2.0 * share / parts as f64 - 1.0;
            let weights = Shape::Quadrilateral.weights(place(i), place(j)).value;
            let pairs = weights.into_iter().zip(corners);
            pairs.fold([0.0; 3], |[x, y, p], (w, node)| {
                [
                    x + w * node.position.x,
                    y + w * node.position.y,
                    p + w * node.result.pressure,
                ]
            })
        };
        for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (i as f64, j as f64))) {
            let ring = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
            let polygon = ring.map(|(a, b)| at(i + a, j + b)).map(|[x, y, _]| [x, y]);
            cells.push((polygon.to_vec(), at(i + 0.5, j + 0.5)[2]));
        }
    }
    cells
}

/// Outlines of the facets of a side, counter-clockwise seen from above.
fn outlines(run: &Run, side: Side) -> Vec<Vec<[f64; 2]>> {
    let nodes = surface_nodes(run, side);
    let outline = |facet: &[SurfaceNode; 4]| {
        let ring = facet.map(|corner| nodes[corner].position);
        let mut ring = ring.map(|x| [x.x, x.y]).to_vec();
        if area(ring[0], ring[1], ring[2]) < 0.0 {
            ring.reverse();
        }
        ring
    };
    facets(run, side).iter().map(outline).collect()
}

/// The part of a polygon inside a convex window (Sutherland and Hodgman).
fn clipped(polygon: &[[f64; 2]], window: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept = polygon.to_vec();
    for (index, &from) in window.iter().enumerate() {
        let to = window[(index + 1) % window.len()];
        let before = std::mem::take(&mut kept);
        for (at, &next) in before.iter().enumerate() {
            let last = before[(at + before.len() - 1) % before.len()];
            let inside = [last, next].map(|place| area(from, to, place));
            if (inside[0] < 0.0) != (inside[1] < 0.0) {
                let s = inside[0] / (inside[0] - inside[1]);
                kept.push([0, 1].map(|axis| last[axis] + s * (next[axis] - last[axis])));
            }
            if inside[1] >= 0.0 {
                kept.push(next);
            }
        }
    }
    kept
}

/// Twice the area of a triangle, positive counter-clockwise.
fn area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Edges of the facets of a side of the first pair, seen from above.
pub fn mesh_lines(run: &Run, side: Side, name: &str, color: Color) -> Series {
    let nodes = surface_nodes(run, side);
    let mut points = Vec::new();
    for facet in facets(run, side) {
        let ring = [0, 1, 2, 3, 0].map(|corner| nodes[facet[corner]].position);
        points.extend(ring.map(|x| [x.x, x.y]));
        points.push([f64::NAN; 2]);
    }
    Series::new(name, Content::line(points)).colored(color)
}

/// Facets of a side of the first pair.
pub fn facets(run: &Run, side: Side) -> &[[SurfaceNode; 4]] {
    let sides = &run.finished.problem.pairs[0].contact.sides;
    sides[side]
        .surface()
        .map_or(&[], |surface| surface.facets())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clipping_keeps_what_is_common() {
        let square = |x: f64, y: f64| vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]];
        let common = clipped(&square(0.0, 0.0), &square(0.25, 0.5));
        let fan: f64 = common[1..]
            .windows(2)
            .map(|pair| 0.5 * area(common[0], pair[0], pair[1]))
            .sum();
        assert!((fan - 0.375).abs() < 1e-15, "{common:?}");
        assert!(clipped(&square(0.0, 0.0), &square(2.0, 0.0)).is_empty());
    }
}
