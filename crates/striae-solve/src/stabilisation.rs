//! Viscous forces that carry bodies across a gap to contact.
//!
//! A body that only contact will hold has no equilibrium before it touches. A pair that is
//! stabilised resists, in quasi-static steps, the relative motion of its sides: on every
//! node `i` that faces the other side acts
//!
//! ```text
//! f_i = -c (1 - s) A_i (v_i - sum w_j v_j),    v = (x - x_n)/dt
//! ```
//!
//! and the opposite force on what is opposite to it: on the corners `j` of the facet with
//! the nearest point, with the weights `w_j` of that point, or on a rigid body, whose velocity is taken
//! at the node. `A_i` is the area of the node, halved where both sides are deformable as
//! both have nodes then; `s` is the fraction of the step at the end of the increment, so the
//! result of the step has nothing of it. Who faces whom is found at the start of the
//! increment.
//!
//! The coefficient `c` follows from the loads of the step, see [`crate::assembly::StepContext`].

use striae_contact::{
    side::Side,
    term::{Field, LocalTerm},
};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{problem::Problem, rigid::Pose};
use striae_model::{Model, Procedure};

/// First increment of a step with a stabilised pair, unless a smaller one is requested, and the
/// largest one if all increments are to be larger. Loads are small at its end, and so is what they
/// lose on the way to contact.
const FIRST: [f64; 2] = [2e-3, 0.5];

/// Relative motion of a node and what is opposite to it that is resisted.
#[derive(Clone, Debug, PartialEq)]
pub struct Dashpot {
    /// Force over relative displacement.
    pub stiffness: f64,
    /// Gap at the start of the increment.
    pub gap: f64,
    /// Side, surface node and weight of what moves, where it moves from, and of a body on the
    /// other side what is there.
    pub points: Vec<Point>,
}

/// A node of a dashpot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Side of the pair.
    pub side: Side,
    /// Surface node.
    pub node: SurfaceNode,
    /// Weight in the relative motion.
    pub weight: f64,
    /// Position at the start of the increment.
    pub from: Vec3,
}

/// Returns whether a pair is stabilised in a step.
pub fn acts(model: &Model, step: usize, pair: usize) -> bool {
    let quasi_static = model.steps[step].procedure == Procedure::QuasiStatic;
    quasi_static && model.pairs[pair].stabilised
}

/// Returns whether any pair is stabilised in a step.
pub(crate) fn acts_in(model: &Model, step: usize) -> bool {
    (0..model.pairs.len()).any(|pair| acts(model, step, pair))
}

/// Fraction of the step at which its first increment ends at most.
pub fn first_increment(model: &Model, step: usize) -> f64 {
    let increments = &model.steps[step].increments;
    let first = increments.initial.min(increments.largest);
    if acts_in(model, step) {
        let [enough, most] = FIRST;
        first.min(enough.max(increments.smallest)).min(most)
    } else {
        first
    }
}

impl Dashpot {
    /// Relative displacement since the start of the increment, with the nodes of a pair of
    /// the problem at `positions` and the body on the other side moved from one pose to the other.
    pub fn stretch(
        &self,
        problem: &Problem,
        pair: usize,
        positions: &[Vec3],
        body: Option<[&Pose; 2]>,
    ) -> Vec3 {
        let geometry = &problem.pairs[pair];
        let placements = body.zip(geometry.rigid).map(|(poses, rigid)| {
            let reference = &problem.model.rigid_surfaces[rigid].reference;
            poses.map(|pose| pose.placement(reference))
        });
        let way = |point: &Point| {
            let node = problem.surface_node(pair, point.side, point.node);
            let x = positions[node.expect("points of dashpots are nodes")];
            let from = match &placements {
                Some([before, now]) => now.point(&before.back(&point.from)),
                None => point.from,
            };
            (x - from) * point.weight
        };
        self.points.iter().map(way).sum()
    }

    /// Rows of the residual and their tangent, relative to what is on a rigid other side.
    pub fn term(&self, stretch: &Vec3, first: impl Fn(&Point) -> u32) -> LocalTerm {
        let count = 3 * self.points.len();
        let mut points: Vec<(u32, f64)> =
            self.points.iter().map(|p| (first(p), p.weight)).collect();
        points.sort_unstable_by_key(|point| point.0);
        let unknowns: Vec<u32> = points.iter().flat_map(|p| p.0..p.0 + 3).collect();
        let weight = |at: usize| points[at / 3].1;
        let residual = (0..count).map(|row| self.stiffness * weight(row) * stretch[row % 3]);
        let tangent = (0..count * count).map(|at| {
            let (row, column) = (at / count, at % count);
            let same = row % 3 == column % 3;
            let value = self.stiffness * weight(row) * weight(column);
            if same { value } else { 0.0 }
        });
        LocalTerm {
            residual: residual.collect(),
            tangent: tangent.collect(),
            fields: vec![Field::Momentum; count],
            rows: unknowns.clone(),
            columns: unknowns,
        }
    }
}
