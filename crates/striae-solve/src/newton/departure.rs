//! Start of bodies that separate in one increment.
//!
//! The first iteration is linearised with closed contact. A body that is moved by more than
//! it overlaps with another would drag that other along and be turned inside out. Where two
//! surfaces overlap and do not any more once the bodies have moved rigidly with the mean of
//! what is prescribed on them, the bodies start from there, free of each other.

use nalgebra::Matrix3;
use striae_contact::{selection::Selection, side::Side};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    assembly::{Imposed, StepContext},
    rigid::Pose,
    state::State,
};

/// Singular value, over the largest one, of a direction that nothing is prescribed along.
const ROUND_OFF: f64 = 1e-9;

/// Positions to start iterating from; collective.
pub(super) fn first_positions(
    context: &StepContext,
    state: &State,
    imposed: &Imposed,
    rigid: &[Pose],
    selections: &[Selection],
) -> Vec<Vec3> {
    let problem = context.problem;
    let moves = mean_moves(context, state, imposed);
    let mut moved = state.positions.clone();
    for (body, way) in moves.iter().enumerate() {
        let nodes = problem.first_node[body]..problem.first_node[body + 1];
        moved[nodes].iter_mut().for_each(|x| *x += way);
    }
    // Bodies of pairs that come apart, and of those that do not.
    let (mut apart, mut together) = (vec![false; moves.len()], vec![false; moves.len()]);
    for (pair, selection) in selections.iter().enumerate() {
        let bodies: Vec<usize> = Side::BOTH
            .into_iter()
            .filter_map(|side| problem.surface_node(pair, side, SurfaceNode(0)))
            .map(|node| problem.body_node(node).0)
            .collect();
        let way = match *bodies.as_slice() {
            [a, b] => moves[a] - moves[b],
            [a] => moves[a],
            _ => continue,
        };
        if selection.kept().is_empty() || way == Vec3::zeros() {
            continue;
        }
        let start = context.configuration(pair, &state.positions, &state.rigid);
        // Shorter motions are within what the linearisation of closed contact can follow.
        let is_far = way.norm() > start.side(Side::A).largest_size;
        let left = is_far && {
            let end = context.configuration(pair, &moved, rigid);
            selection.overlaps(&start) && !selection.overlaps(&end)
        };
        let of_kind = if left { &mut apart } else { &mut together };
        bodies.iter().for_each(|&body| of_kind[body] = true);
    }
    let mut positions = state.positions.clone();
    // Moving a body that stays in contact with another one would break that contact.
    for body in (0..moves.len()).filter(|&body| apart[body] && !together[body]) {
        let nodes = problem.first_node[body]..problem.first_node[body + 1];
        positions[nodes.clone()].copy_from_slice(&moved[nodes]);
    }
    positions
}

/// Mean prescribed motion of each body, zero for tied bodies. Collective.
fn mean_moves(context: &StepContext, state: &State, imposed: &Imposed) -> Vec<Vec3> {
    let problem = context.problem;
    let bodies = problem.model.bodies.len();
    let mut sums = vec![Vec3::zeros(); bodies];
    // Rows of `sum e e^T` over the prescribed directions, three a body.
    let mut normals = vec![Vec3::zeros(); 3 * bodies];
    let own = imposed.positions.iter();
    for &(node, axis, position) in own.filter(|(node, _, _)| problem.share.owns(*node)) {
        let (body, _) = problem.body_node(node);
        let way = position - context.along(node, axis, &state.positions[node]);
        match context.turned.frame(node) {
            Some(frame) => {
                let direction = frame.axis(axis);
                sums[body] += direction * way;
                for row in 0..3 {
                    normals[3 * body + row] += direction * direction[row];
                }
            }
            None => {
                sums[body][axis] += way;
                normals[3 * body + axis][axis] += 1.0;
            }
        }
    }
    problem.share.sum_vectors(&mut sums);
    problem.share.sum_vectors(&mut normals);
    let mean = |body: usize| {
        let mut nodes = problem.first_node[body]..problem.first_node[body + 1];
        if problem.ties.joins(body) || nodes.any(|node| problem.tie_of[node].is_some()) {
            // Tied bodies move with others, and a rigid start of one of them would tear the tie.
            return Vec3::zeros();
        }
        let rows = &normals[3 * body..3 * body + 3];
        mean_of(
            &Matrix3::from_fn(|row, column| rows[row][column]),
            &sums[body],
        )
    };
    (0..bodies).map(mean).collect()
}

/// Motion that fits ways along directions best, from `sum e e^T` and `sum e way`; zero where
/// there are none.
fn mean_of(normal: &Matrix3<f64>, sum: &Vec3) -> Vec3 {
    if *normal == Matrix3::from_diagonal(&normal.diagonal()) {
        return Vec3::from_fn(|axis, _| sum[axis] / normal[(axis, axis)].max(1.0));
    }
    let inverse = normal.pseudo_inverse(ROUND_OFF * normal.norm());
    inverse.map_or_else(|_| Vec3::zeros(), |inverse| inverse * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_along_directions_are_those_of_the_mean_motion() {
        let motion = Vec3::new(0.3, -0.2, 0.5);
        let mean = |directions: &[Vec3]| {
            let normal = directions.iter().map(|e| e * e.transpose()).sum();
            let sum: Vec3 = directions.iter().map(|e| e * e.dot(&motion)).sum();
            mean_of(&normal, &sum)
        };
        assert_eq!(mean(&[Vec3::x(), Vec3::x()]), Vec3::new(0.3, 0.0, 0.0));
        let oblique = Vec3::new(0.6, 0.0, 0.8);
        let along = mean(&[oblique, oblique]);
        assert!((along - oblique * oblique.dot(&motion)).norm() < 1e-15);
        let all = mean(&[oblique, Vec3::y(), Vec3::x()]);
        assert!((all - motion).norm() < 1e-14);
        assert_eq!(mean_of(&Matrix3::zeros(), &Vec3::zeros()), Vec3::zeros());
    }
}
