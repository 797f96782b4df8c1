//! Projection of a node onto the other side.
//!
//! Between deformable sides a node looks along its own normal `n_I`, Jones &
//! Papadopoulos (2006), eq. (58):
//!
//! ```text
//! sum_J N_J(xi, eta) x_J - x_I - g n_I = 0
//! ```
//!
//! Against a rigid surface the normal is the rigid surface's, `N(xi, eta)`
//! interpolated from its nodal normals, and `x_I - sum N_J x_J - g N = 0`.
//! Of all hits the one with the smallest `|g|` counts.

use nalgebra::{Matrix3, Vector3};
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    facet::{Shape, area_vector},
    node::SurfaceNode,
    scalar::{Real, combination, constant3, normalised},
};

use crate::{configuration::Snapshot, search::Bounds};

/// A point of a facet and the gap to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The facet.
    pub facet: FacetId,
    /// Its coordinates.
    pub xi: f64,
    /// Its coordinates.
    pub eta: f64,
    /// Gap, positive when open.
    pub gap: f64,
}

/// Along which normal a projection goes.
#[derive(Clone, Copy, Debug)]
pub enum Ray {
    /// Along this unit normal of the projected point.
    Own(Vec3),
    /// Along the interpolated normal of the surface projected onto.
    Opposite,
}

/// Distance outside a facet up to which a hit may lie, in facet coordinates.
const ROUND_OFF: f64 = 1e-8;
/// Gauss-Newton steps to a point of a facet: quadratic for points on it.
const STEPS: usize = 8;

/// Projects the point `x` onto those facets of `target` within the distance `reach` that are
/// admitted at the gap to them.
pub fn project(
    target: &Snapshot,
    x: &Vec3,
    ray: Ray,
    reach: f64,
    admits: impl Fn(FacetId, f64) -> bool,
) -> Option<Hit> {
    let bounds = match ray {
        Ray::Own(n) => Bounds::around([x - n * reach, x + n * reach]).inflated(1e-6 * reach),
        Ray::Opposite => Bounds::around([*x]).inflated(reach),
    };
    let mut best: Option<(f64, Hit)> = None;
    for item in target.tree().meeting(&bounds) {
        let facet = FacetId(item);
        let Some(hit) = on_facet(target, facet, x, ray) else {
            continue;
        };
        let excess = Shape::of(&target.corners(facet)).excess(hit.xi, hit.eta);
        if excess > ROUND_OFF || hit.gap.abs() > reach || !admits(facet, hit.gap) {
            continue;
        }
        let slack = 1e-9 * reach;
        let better = match &best {
            None => true,
            Some((known, other)) => {
                let difference = hit.gap.abs() - other.gap.abs();
                difference < -slack || (difference < slack && excess < *known)
            }
        };
        if better {
            best = Some((excess, hit));
        }
    }
    best.map(|(_, hit)| hit)
}

/// Interpolation functions of a facet with the corners `x` at a point on it or near it: those of
/// the point of the facet, continued beyond its edges, that is nearest.
pub(crate) fn weights_at(shape: Shape, x: &[Vec3; 4], point: &Vec3) -> [f64; 4] {
    let [mut xi, mut eta] = shape.centre();
    for _ in 0..STEPS {
        let weights = shape.weights(xi, eta);
        let away = point - combination(&weights.value, x);
        let along = [&weights.d_xi, &weights.d_eta].map(|weights| combination(weights, x));
        let [[a, b], [_, d]] = along.map(|u| along.map(|v| u.dot(&v)));
        let [e, f] = along.map(|u| u.dot(&away));
        let determinant = a * d - b * b;
        if determinant <= 0.0 {
            break;
        }
        xi += (d * e - b * f) / determinant;
        eta += (a * f - b * e) / determinant;
    }
    shape.weights(xi, eta).value
}

/// The point on the edge of a surface that is nearest to the line through `x` along `n`,
/// within the distance `reach` of `x`, and the nodes of that edge; of edges of facets that are
/// admitted at the gap to them.
pub fn nearest_edge(
    target: &Snapshot,
    x: &Vec3,
    n: &Vec3,
    reach: f64,
    admits: impl Fn(FacetId, f64) -> bool,
) -> Option<(Hit, [SurfaceNode; 2])> {
    let bounds = Bounds::around([*x]).inflated(reach);
    let edges = target.surface.boundary_edges();
    let mut best: Option<(f64, Hit, [SurfaceNode; 2])> = None;
    for item in target.edge_tree().meeting(&bounds) {
        let edge = edges[item as usize];
        let [start, end] = edge.nodes.map(|node| target.x[node] - x);
        let flat = |v: Vec3| v - n * n.dot(&v);
        let share = share_of_edge(&start, &(end - start), n);
        let point = start + (end - start) * share;
        let distance = flat(point).norm();
        let corners = target.corners(edge.facet);
        let facing = area_vector(
            &Shape::of(&corners).weights(0.25, 0.25),
            &target.corner_positions(edge.facet),
        );
        let is_near = point.norm() <= reach && admits(edge.facet, n.dot(&point));
        if !is_near || facing.dot(n) >= 0.0 {
            continue;
        }
        if best.is_none_or(|(known, ..)| distance < known) {
            let at = |node: SurfaceNode| {
                Shape::of(&corners).corner(corners.iter().position(|c| *c == node))
            };
            let [a, b] = edge.nodes.map(at);
            let [xi, eta] = [0, 1].map(|k| a[k] + (b[k] - a[k]) * share);
            let gap = n.dot(&point);
            let facet = edge.facet;
            best = Some((
                distance,
                Hit {
                    facet,
                    xi,
                    eta,
                    gap,
                },
                edge.nodes,
            ));
        }
    }
    best.map(|(_, hit, nodes)| (hit, nodes))
}

/// Share of the edge `d` that starts at `r` from a point, nearest to the line through that
/// point along `n`.
pub fn share_of_edge(r: &Vec3, d: &Vec3, n: &Vec3) -> f64 {
    let along = d - n * n.dot(d);
    (-r.dot(&along) / d.dot(&along).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}

fn on_facet(target: &Snapshot, facet: FacetId, x: &Vec3, ray: Ray) -> Option<Hit> {
    let corners = target.corners(facet);
    let shape = Shape::of(&corners);
    let positions = target.corner_positions(facet);
    let normals = corners.map(|node| target.normals[node]);
    let [mut xi, mut eta] = shape.centre();
    let mut gap = 0.0;
    let scale = target.facet_size(facet);
    for _ in 0..25 {
        let (residual, jacobian) = system(shape, &positions, &normals, x, ray, [xi, eta, gap]);
        let step = jacobian.lu().solve(&residual)?;
        xi -= step.x;
        eta -= step.y;
        gap -= step.z;
        if !(xi.abs() < 50.0 && eta.abs() < 50.0) {
            return None;
        }
        if step.x.abs().max(step.y.abs()) < 1e-13 && step.z.abs() < 1e-13 * scale {
            break;
        }
    }
    let weights = shape.weights(xi, eta);
    let m = area_vector(&weights, &positions);
    let facing = match ray {
        Ray::Own(n) => m.dot(&n) < 0.0,
        Ray::Opposite => m.dot(&combination(&weights.value, &normals)) > 0.0,
    };
    facing.then_some(Hit {
        facet,
        xi,
        eta,
        gap,
    })
}

/// Residual of the projection equations and its derivative by `(xi, eta, g)`.
fn system(
    shape: Shape,
    positions: &[Vec3; 4],
    normals: &[Vec3; 4],
    x: &Vec3,
    ray: Ray,
    [xi, eta, gap]: [f64; 3],
) -> (Vec3, Matrix3<f64>) {
    let weights = shape.weights(xi, eta);
    let point = combination(&weights.value, positions);
    let d_xi = combination(&weights.d_xi, positions);
    let d_eta = combination(&weights.d_eta, positions);
    match ray {
        Ray::Own(n) => (
            point - x - n * gap,
            Matrix3::from_columns(&[d_xi, d_eta, -n]),
        ),
        Ray::Opposite => {
            let sum = combination(&weights.value, normals);
            let length = sum.norm();
            let n = sum / length;
            let tangential = |v: Vec3| (v - n * n.dot(&v)) / length;
            let n_xi = tangential(combination(&weights.d_xi, normals));
            let n_eta = tangential(combination(&weights.d_eta, normals));
            (
                point + n * gap - x,
                Matrix3::from_columns(&[d_xi + n_xi * gap, d_eta + n_eta * gap, n]),
            )
        }
    }
}

/// A converged projection along the interpolated normal of a rigid facet with its
/// derivatives: `(xi, eta, g)` as functions of the node alone, with the rigid normal
/// at the projection. Along the node's own normal see [`Opposing`](crate::opposing::Opposing).
pub fn differentiated_rigid<D: Real>(
    target: &Snapshot,
    hit: &Hit,
    x: &Vector3<D>,
) -> ([D; 3], Vector3<D>) {
    let corners = target.corners(hit.facet);
    let shape = Shape::of(&corners);
    let positions = target.corner_positions(hit.facet);
    let normals = corners.map(|node| target.normals[node]);
    let at = [hit.xi, hit.eta, hit.gap];
    let real = x.map(|component| component.re());
    let (value, jacobian) = system(shape, &positions, &normals, &real, Ray::Opposite, at);
    let residual = constant3::<D>(&(value + real)) - x;
    let solution = implicit(at, &jacobian, &residual);
    let weights = shape.weights(solution[0], solution[1]).value;
    let normal = normalised(&combination(&weights, &normals.each_ref().map(constant3)));
    (solution, normal)
}

/// `u - J^-1 r` for a root `u` of `r`: equal to `u`, with the derivatives of
/// the implicit function.
fn implicit<D: Real>(at: [f64; 3], jacobian: &Matrix3<f64>, residual: &Vector3<D>) -> [D; 3] {
    let inverse = jacobian
        .try_inverse()
        .expect("a converged projection has a regular Jacobian");
    std::array::from_fn(|row| {
        let mut value = D::from(at[row]);
        for column in 0..3 {
            value -= residual[column] * inverse[(row, column)];
        }
        value
    })
}
