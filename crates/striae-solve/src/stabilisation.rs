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
//! The coefficient `c` is the smaller one of two. With the loads `F` on all bodies at the
//! end `s_1` of the first increment, free sides of the area `A` at the distance `g` come
//! together in it, and would go on by a tenth of the gap or facet size `h`,
//!
//! ```text
//! c = F s_1 T / ((g + min(g, h)/10) A (1 - s_1)),
//! ```
//!
//! and it is never more than a thousandth of what the softer side's modulus `E` and
//! facet size make of the duration `T`: `c = 1e-3 E T/h`, so that bodies in contact
//! hardly feel it. Under a load `F` the sides go on by `-ln(1 - s) F T/(c A)` as `s` goes
//! to 1, which has no bound: what is driven towards the other side gets there, given
//! small enough increments.

use striae_contact::interference::{Facing, facing};
use striae_contact::term::{Field, LocalTerm};
use striae_mesh::{ElementId, Vec3};

use crate::{
    assembly::StepContext,
    load,
    model::{Model, Procedure},
    problem::Problem,
    rigid::Pose,
    state::State,
};

/// First increment of a step with a stabilised pair, unless a smaller one is asked for, and
/// the largest one where all increments are to be larger. Loads are small at its end, and so
/// is what they lose on the way to contact.
const FIRST: [f64; 2] = [2e-3, 0.5];

/// How far the first increment would go beyond the gap without contact, over the gap or, if that
/// is less, the facet size.
const BEYOND: f64 = 0.1;
/// Largest coefficient over `E T/h`.
const LARGEST: f64 = 1e-3;

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
    pub side: usize,
    /// Surface node.
    pub node: u32,
    /// Weight in the relative motion.
    pub weight: f64,
    /// Where it was at the start of the increment.
    pub from: Vec3,
}

/// Whether a pair is stabilised in a step.
pub fn acts(model: &Model, step: usize, pair: usize) -> bool {
    let quasi_static = model.steps[step].procedure == Procedure::QuasiStatic;
    quasi_static && model.pairs[pair].stabilised
}

/// Whether any pair is stabilised in a step.
pub fn acts_in(model: &Model, step: usize) -> bool {
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

/// Coefficient `c` of a pair in the step; zero where it is not stabilised.
pub fn coefficient(context: &StepContext, pair: usize) -> f64 {
    let problem = context.problem;
    if !acts(&problem.model, context.index, pair) {
        return 0.0;
    }
    let start = context.start;
    let configuration = context.configuration(pair, &start.positions, &start.rigid);
    let facing = facing(&configuration);
    let sides = configuration.pair.deformable_sides();
    let share = 1.0 / sides.len() as f64;
    let area: f64 = facing.iter().map(|node| share * node.area).sum();
    if area == 0.0 {
        return 0.0;
    }
    let duration = problem.model.steps[context.index].duration;
    let sizes = || {
        sides
            .iter()
            .map(|&side| configuration.side(side).largest_size)
    };
    let moduli = sides
        .iter()
        .map(|&side| configuration.pair.sides[side].stiffness);
    let stiffness = moduli.zip(sizes()).map(|(modulus, size)| modulus / size);
    let largest = LARGEST * duration * stiffness.fold(f64::INFINITY, f64::min);
    let gap = facing
        .iter()
        .map(|node| node.gap)
        .fold(f64::INFINITY, f64::min);
    let first = first_increment(&problem.model, context.index);
    let way = gap + BEYOND * sizes().fold(gap, f64::min);
    let of_loads = loads(context, first) * first * duration / (way * area * (1.0 - first));
    if gap > 0.0 && of_loads > 0.0 {
        of_loads.min(largest)
    } else {
        largest
    }
}

/// Sum of the magnitudes of all loads at the fraction `s` of the step.
fn loads(context: &StepContext, s: f64) -> f64 {
    let problem = context.problem;
    let imposed = context.imposed(s);
    let mut sum: f64 = imposed
        .driving
        .iter()
        .map(|wrench| wrench.force.norm())
        .sum();
    for (planned, kind) in context.plan.loads.iter().zip(&imposed.loads) {
        let body = planned.body.0;
        for face in &planned.faces {
            let corners = problem.model.bodies[body].mesh.face_nodes(*face);
            let nodes = corners.map(|node| problem.node(body, node));
            let [reference, current] =
                [&problem.reference, &context.start.positions].map(|x| nodes.map(|node| x[node]));
            if let Ok(load) = load::response(kind, &reference, &current) {
                let forces = load.force.chunks_exact(3);
                let force: Vec3 = forces.map(Vec3::from_column_slice).sum();
                sum += force.norm();
            }
        }
    }
    let gravity = imposed.gravity.norm();
    for (body, elements) in problem.elements.iter().enumerate() {
        let masses = elements
            .iter()
            .enumerate()
            .map(|(at, element)| problem.density(body, ElementId::new(at)) * element.volume());
        sum += gravity * masses.sum::<f64>();
    }
    let points: f64 = problem.mass_points.iter().map(|(_, mass)| mass).sum();
    sum + gravity * points
}

/// What resists the motion of every pair from `state` to the fraction `s` of the step in
/// the time `elapsed`; nothing at the end of the step.
pub fn dashpots(context: &StepContext, state: &State, s: f64, elapsed: f64) -> Vec<Vec<Dashpot>> {
    let pairs = context.stabilisation.iter().enumerate();
    let of_pair = |(pair, coefficient): (usize, &f64)| {
        let factor = coefficient * (1.0 - s) / elapsed;
        if factor <= 0.0 {
            return Vec::new();
        }
        of_pair(context, state, pair, factor)
    };
    pairs.map(of_pair).collect()
}

fn of_pair(context: &StepContext, state: &State, pair: usize, factor: f64) -> Vec<Dashpot> {
    let configuration = context.configuration(pair, &state.positions, &state.rigid);
    let is_rigid = configuration.pair.is_rigid();
    let share = if is_rigid { 1.0 } else { 0.5 };
    let facing = facing(&configuration).into_iter();
    let dashpot = |facing: Facing| {
        let point = |side: usize, node: u32, weight: f64| Point {
            side,
            node,
            weight,
            from: configuration.side(side).x[node as usize],
        };
        let mut points = vec![point(facing.side, facing.node, 1.0)];
        if let (false, Some((corners, weights))) = (is_rigid, facing.opposite) {
            let corners = corners.into_iter().zip(weights).filter(|(_, w)| *w != 0.0);
            points.extend(corners.map(|(node, w)| point(1 - facing.side, node, -w)));
        }
        Dashpot {
            stiffness: factor * share * facing.area,
            gap: facing.gap,
            points,
        }
    };
    facing.map(dashpot).collect()
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
