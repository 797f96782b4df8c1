//! Coefficients of stabilisation, and what resists motion in an increment, see
//! [`crate::stabilisation`].
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

use striae_contact::{
    interference::{Facing, facing},
    side::Side,
};
use striae_mesh::{ElementId, Vec3};
use striae_surface::node::SurfaceNode;

use super::StepContext;
use crate::{
    stabilisation::{Dashpot, Point, acts, first_increment},
    state::State,
};
use striae_model::load;

/// Penetration of the gap by the first increment without contact, over the gap or, if that is less,
/// the facet size.
const BEYOND: f64 = 0.1;
/// Largest coefficient over `E T/h`.
const LARGEST: f64 = 1e-3;

/// Coefficient `c` of a pair in the step; zero where it is not stabilised. Collective.
pub(super) fn coefficient(context: &StepContext, pair: usize) -> f64 {
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

/// Sum of the magnitudes of all loads at the fraction `s` of the step; collective.
fn loads(context: &StepContext, s: f64) -> f64 {
    let problem = context.problem;
    let imposed = context.imposed(s);
    let driving = imposed.driving.iter().map(|wrench| wrench.force.norm());
    let mut sum: f64 = match problem.share.owns_bodies() {
        true => driving.sum(),
        false => 0.0,
    };
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
    sum += imposed
        .forces
        .iter()
        .map(|(_, force)| force.norm())
        .sum::<f64>();
    let gravity = imposed.gravity.norm();
    for (body, elements) in problem.elements.iter().enumerate() {
        let masses = elements
            .iter()
            .enumerate()
            .map(|(at, element)| problem.density(body, ElementId::new(at)) * element.volume());
        sum += gravity * masses.sum::<f64>();
    }
    let points: f64 = problem.mass_points.iter().map(|(_, mass)| mass).sum();
    problem.share.sum(sum) + gravity * points
}

/// Dashpots that resist the motion of every pair from `state` to the fraction `s` of the step in
/// the time `elapsed`; none at the end of the step.
pub(super) fn dashpots(
    context: &StepContext,
    state: &State,
    s: f64,
    elapsed: f64,
) -> Vec<Vec<Dashpot>> {
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
        let point = |side: Side, node: SurfaceNode, weight: f64| Point {
            side,
            node,
            weight,
            from: configuration.side(side).x[node],
        };
        let mut points = vec![point(facing.side, facing.node, 1.0)];
        if let (false, Some((corners, weights))) = (is_rigid, facing.opposite) {
            let corners = corners.into_iter().zip(weights).filter(|(_, w)| *w != 0.0);
            points.extend(corners.map(|(node, w)| point(facing.side.opposite(), node, -w)));
        }
        Dashpot {
            stiffness: factor * share * facing.area,
            gap: facing.gap,
            points,
        }
    };
    facing.map(dashpot).collect()
}
