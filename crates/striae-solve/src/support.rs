//! Support of bodies: finds loads that contact cannot hold, however rough it is.
//!
//! The loads on a body, a force and a torque `w`, are in equilibrium with contact only if there are
//! forces `f_k` at the points where it is supported that press, `-n . f_k >= 0`, with
//!
//! ```text
//! w + sum (f_k, x_k x f_k) = 0
//! ```
//!
//! except for prescribed components. A cone of friction is approximated by its edges, so the task
//! is to find weights `c >= 0` of the columns of a matrix by least squares (Lawson & Hanson,
//! *Solving Least Squares Problems* (1974), chapter 23). The remainder of `w` is held by nothing:
//! with a coefficient of [`ROUGH`] the body tips over an edge, or is lifted off; with that of its
//! friction, in a pyramid around the cone, it slides. Points are those of a grid on its facets that
//! face the other side and touch it.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector, Matrix6, SymmetricEigen, Vector6};
use striae_contact::{
    configuration::Configuration,
    interference::{Standing, nearest_of},
    side::Side,
};
use striae_mesh::{FacetId, Vec3};

use crate::{
    assembly::StepContext,
    interference::{Positions, configuration},
    problem::Problem,
    state::State,
};
use striae_model::{BodyId, Mover};

/// Coefficient of friction that is as good as any, and edges of its cone.
const ROUGH: f64 = 100.0;
const ROUGH_EDGES: usize = 4;
/// Edges of the pyramid around a cone of friction.
const EDGES: usize = 16;
/// Most intervals of the grid along an edge of a facet, and about how many points there are.
const INTERVALS: usize = 8;
const POINTS: usize = 20_000;
/// Gap over the facet size up to which a point is supported.
const TOUCHING: f64 = 0.05;
/// Remainder of the loads, relative to their size, up to which they count as held.
const LEFT: f64 = 1e-3;

/// A body that contact cannot hold against its loads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unsupported {
    /// The body.
    pub body: usize,
    /// The pair that it stands on.
    pub pair: usize,
    /// Its way to move.
    pub way: Way,
}

/// Ways in which contact fails to hold a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// No friction would hold it.
    Tips,
    /// Its friction does not hold it.
    Slides,
}

/// A body that contact does not hold against the loads `applied` at the nodes in a converged state,
/// in the given way. Collective.
pub(crate) fn unsupported(
    context: &StepContext,
    state: &State,
    applied: &[Vec3],
    way: Way,
) -> Option<Unsupported> {
    let problem = context.problem;
    (0..problem.model.bodies.len()).find_map(|body| {
        let own = |pair: &usize| problem.pairs[*pair].bodies.contains(&Some(body));
        let springs = &problem.model.springs;
        let sprung = springs
            .iter()
            .any(|of| of.holds(Mover::Deformable(BodyId(body))));
        let tied = sprung
            || problem.ties.joins(body)
            || !problem
                .nodes_of(body)
                .all(|node| problem.tie_of[node].is_none());
        let pairs: Vec<usize> = (0..problem.pairs.len()).filter(own).collect();
        if tied || pairs.is_empty() {
            return None;
        }
        let frame = Frame::new(problem, body, state);
        let held = frame.held(context, body, state);
        let load = held * frame.load(problem, body, state, applied);
        let cones = pairs.iter().map(|&pair| match way {
            Way::Tips => (pair, ROUGH, ROUGH_EDGES),
            Way::Slides => {
                let mu = context.plan.frictions[pair].largest_coefficient();
                (pair, mu.min(ROUGH) / (PI / EDGES as f64).cos(), EDGES)
            }
        });
        let columns = cones.map(|(pair, mu, edges)| {
            let supports = frame.supports(problem, (pair, body), state);
            let columns = supports.flat_map(|support| frame.cone(support, mu, edges));
            columns.collect()
        });
        let columns: Vec<Vec<Vector6<f64>>> = columns.collect();
        let most = (0..pairs.len()).max_by_key(|&at| columns[at].len())?;
        let columns: Vec<Vector6<f64>> = columns.concat().iter().map(|c| held * c).collect();
        let is_held = load.norm() == 0.0 || left(&columns, &-load) <= LEFT * load.norm();
        (!is_held && !columns.is_empty()).then_some(Unsupported {
            body,
            pair: pairs[most],
            way,
        })
    })
}

/// Reference point of moments, and their arm.
struct Frame {
    middle: Vec3,
    size: f64,
}

impl Frame {
    fn new(problem: &Problem, body: usize, state: &State) -> Self {
        let nodes = problem
            .nodes_of(body)
            .filter(|node| problem.share.owns(*node));
        let x: Vec<Vec3> = nodes.map(|node| state.positions[node]).collect();
        let mut sum = [x.iter().sum::<Vec3>()];
        problem.share.sum_vectors(&mut sum);
        let middle = sum[0] / problem.share.sum(x.len() as f64).max(1.0);
        let arms = x.iter().map(|x| (x - middle).norm());
        let size = problem.share.largest(arms.fold(0.0, f64::max));
        Self { middle, size }
    }

    /// A force at a place, and its torque over the size.
    fn wrench(&self, x: &Vec3, force: &Vec3) -> Vector6<f64> {
        let torque = ((x - self.middle) / self.size).cross(force);
        Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z)
    }

    fn load(
        &self,
        problem: &Problem,
        body: usize,
        state: &State,
        applied: &[Vec3],
    ) -> Vector6<f64> {
        let nodes = problem
            .nodes_of(body)
            .filter(|node| problem.share.owns(*node));
        let sum = nodes.map(|node| self.wrench(&state.positions[node], &applied[node]));
        let mut sum: Vector6<f64> = sum.sum();
        problem.share.team().sum(sum.as_mut_slice());
        sum
    }

    /// Projection that removes from forces and torques the part that prescribed nodes hold.
    fn held(&self, context: &StepContext, body: usize, state: &State) -> Matrix6<f64> {
        let problem = context.problem;
        let mut normal = Matrix6::zeros();
        for node in problem
            .nodes_of(body)
            .filter(|node| problem.share.owns(*node))
        {
            for axis in (0..3).filter(|axis| context.fixed[node.component(*axis)]) {
                let row = self.wrench(&state.positions[node], &context.axis(node, axis));
                normal += row * row.transpose();
            }
        }
        problem.share.team().sum(normal.as_mut_slice());
        let eigen = SymmetricEigen::new(normal);
        let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
        let free = (0..6).filter(|&k| eigen.eigenvalues[k] <= 1e-9 * largest);
        let free =
            free.map(|k| eigen.eigenvectors.column(k) * eigen.eigenvectors.column(k).transpose());
        free.sum()
    }

    /// Points where a body is supported in a pair, and where they are pushed.
    fn supports(
        &self,
        problem: &Problem,
        (pair, body): (usize, usize),
        state: &State,
    ) -> impl Iterator<Item = (Vec3, Vec3)> {
        let at = configuration(problem, pair, Positions::from(state));
        let sides = at.pair.deformable_sides().iter();
        let own = sides.filter(|side| {
            !at.pair.is_in_one_body() && problem.pairs[pair].bodies[**side] == Some(body)
        });
        let points: Vec<_> = own.flat_map(|&side| supports(&at, side)).collect();
        points.into_iter()
    }

    /// Edges of a cone of friction.
    fn cone(
        &self,
        (x, push): (Vec3, Vec3),
        mu: f64,
        edges: usize,
    ) -> impl Iterator<Item = Vector6<f64>> {
        let t = push.cross(&Vec3::ith(push.iamin(), 1.0)).normalize();
        let s = push.cross(&t);
        (0..edges).map(move |edge| {
            let (sine, cosine) = (2.0 * PI * edge as f64 / edges as f64).sin_cos();
            let force = push + (t * cosine + s * sine) * mu;
            self.wrench(&x, &force.normalize())
        })
    }
}

/// Points of a side that touch the other one, and where they are pushed.
fn supports(at: &Configuration, side: Side) -> Vec<(Vec3, Vec3)> {
    let own = at.side(side);
    let count = own.surface.facets().len();
    let intervals = ((POINTS / count.max(1)) as f64).sqrt() as usize;
    let intervals = intervals.clamp(1, INTERVALS);
    let facets = (0..count).map(FacetId::new);
    let points = facets.flat_map(|facet| {
        let x = own.corner_positions(facet);
        let size = own.facet_size(facet);
        grid(intervals).map(move |(s, t)| {
            let [low, high] = [x[0].lerp(&x[1], s), x[3].lerp(&x[2], s)];
            (low.lerp(&high, t), size)
        })
    });
    let points = points.filter_map(|(x, size)| {
        if let Some((point, normal)) = at.plane() {
            return ((x - point).dot(&normal) < TOUCHING * size).then_some((x, normal));
        }
        let nearest = nearest_of(at.side(side.opposite()), &x)?;
        let gap = (x - nearest.point).dot(&nearest.normal);
        let is_over = nearest.standing != Standing::Beside;
        (is_over && gap < TOUCHING * size).then_some((x, nearest.normal))
    });
    points.collect()
}

/// Places on a facet, its corners among them.
fn grid(intervals: usize) -> impl Iterator<Item = (f64, f64)> {
    let at = move |k: usize| k as f64 / intervals as f64;
    (0..=intervals).flat_map(move |i| (0..=intervals).map(move |j| (at(i), at(j))))
}

/// Remainder of `w` after the best combination of columns with nonnegative weights.
fn left(columns: &[Vector6<f64>], w: &Vector6<f64>) -> f64 {
    const ROUND_OFF: f64 = 1e-10;
    let mut weights = vec![0.0; columns.len()];
    let mut used: Vec<usize> = Vec::new();
    for _ in 0..10 * columns.len().min(100) {
        let taken: Vector6<f64> = used.iter().map(|&at| columns[at] * weights[at]).sum();
        let rest = w - taken;
        let slope = |at: &usize| columns[*at].dot(&rest);
        let steepest = (0..columns.len()).max_by(|a, b| slope(a).total_cmp(&slope(b)));
        let Some(next) =
            steepest.filter(|at| slope(at) > ROUND_OFF * w.norm() && !used.contains(at))
        else {
            return rest.norm();
        };
        used.push(next);
        loop {
            let matrix = DMatrix::from_fn(6, used.len(), |row, at| columns[used[at]][row]);
            let solved = matrix
                .svd(true, true)
                .solve(&DVector::from_column_slice(w.as_slice()), 1e-12);
            let Ok(solved) = solved else {
                return rest.norm();
            };
            let step = (0..used.len()).filter(|&at| solved[at] <= 0.0).map(|at| {
                let from = weights[used[at]];
                from / (from - solved[at]).max(f64::MIN_POSITIVE)
            });
            let step = step.fold(1.0, f64::min);
            for (at, &column) in used.iter().enumerate() {
                weights[column] += step * (solved[at] - weights[column]);
            }
            if step == 1.0 {
                break;
            }
            used.retain(|&column| weights[column] > 1e-14 * w.norm());
            if used.is_empty() {
                break;
            }
        }
    }
    let taken: Vector6<f64> = used.iter().map(|&at| columns[at] * weights[at]).sum();
    (w - taken).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_within_a_cone_are_held_and_others_are_not() {
        let column = |x: f64, y: f64| Vector6::new(0.0, 0.0, 1.0, y, -x, 0.0);
        let columns = [
            column(0.0, 0.0),
            column(1.0, 0.0),
            column(1.0, 1.0),
            column(0.0, 1.0),
        ];
        for (x, y) in [(0.5, 0.5), (0.01, 0.3), (1.0, 1.0), (0.5, 0.0)] {
            assert!(left(&columns, &column(x, y)) < 1e-12, "{x} {y}");
        }
        // The nearest point of the cone is another one than that of the square.
        assert!(left(&columns, &column(-0.1, 0.5)) > 0.05);
        assert!(left(&columns, &column(0.5, 1.2)) > 0.1);
        assert!((left(&columns, &-column(0.5, 0.5)) - column(0.5, 0.5).norm()).abs() < 1e-12);
        assert_eq!(left(&[], &column(0.0, 0.0)), 1.0);
    }
}
