//! Bodies that nothing holds and that fly off.
//!
//! The norms judge a residual against the forces in the elements. A body that Newton's method has
//! thrown far away is stretched on its way, the forces in it grow beyond all others, and the
//! residual is small against them, or against what round-off leaves of them. No equilibrium of
//! the model is there: without inertia a node does not go many times the size of the model
//! further than what drives it. Stabilisation, which resists as long as a step lasts, has an
//! ending of its own.

use striae_mesh::{NodeId, Vec3};

use crate::{
    assembly::{Setting, Trial},
    outcome::CutBack,
    problem::Problem,
};
use striae_model::{Procedure, node::GlobalNode};

/// Way in one increment, over the size of the undeformed bodies, beyond what is prescribed.
const FARTHEST: f64 = 100.0;

/// The node that flies furthest, or else the first rigid body that does, if one does; collective.
pub(super) fn flown(setting: &Setting, trial: &Trial) -> Option<CutBack> {
    let context = setting.context;
    let problem = context.problem;
    let is_static = problem.model.steps[context.index].procedure == Procedure::QuasiStatic;
    let is_resisted = context
        .stabilisation
        .iter()
        .any(|&viscosity| viscosity > 0.0);
    if !is_static || is_resisted {
        return None;
    }
    let (share, before) = (&problem.share, &setting.state.positions);
    let size = problem.size();
    let farthest = FARTHEST * size + share.largest(prescribed(setting, trial));
    // Points of rigid bodies come after the nodes of all bodies.
    let count = problem.first_node[problem.model.bodies.len()];
    let of_bodies = first(
        problem,
        furthest(&before[..count], &trial.positions[..count]),
    );
    if let Some((body, node, way)) = of_bodies.filter(|(.., way)| *way > farthest) {
        return Some(CutBack::Flown {
            body: problem.model.bodies[body].name.clone(),
            node,
            way,
            times: way / size,
        });
    }
    let before = setting.imposed.before.iter();
    let ways = trial
        .rigid
        .iter()
        .zip(before)
        .map(|(now, before)| (now.displacement - before.displacement).norm());
    let (rigid, way) = ways.enumerate().find(|(_, way)| *way > farthest)?;
    Some(CutBack::RigidFlown {
        rigid: problem.model.rigid_surfaces[rigid].name.clone(),
        way,
        times: way / size,
    })
}

/// Body, node and way of the first node of all ranks that has gone furthest; collective.
fn first(problem: &Problem, own: Option<(usize, f64)>) -> Option<(usize, NodeId, f64)> {
    let own = own.map(|(node, way)| (problem.named_node(GlobalNode(node)), way));
    if problem.share.is_alone() {
        return own.map(|((body, node), way)| (body, node, way));
    }
    let bytes = own.map_or_else(Vec::new, |((body, node), way)| {
        let numbers = [way.to_bits(), body as u64, node.index() as u64];
        numbers.map(u64::to_le_bytes).concat()
    });
    let all = problem.share.team().gather(&bytes).into_iter();
    let all = all.filter(|bytes| !bytes.is_empty()).map(|bytes| {
        let bits = |at: usize| {
            let bytes = bytes[8 * at..8 * (at + 1)].try_into();
            u64::from_le_bytes(bytes.expect("numbers have eight bytes"))
        };
        let (body, node) = (bits(1) as usize, NodeId::new(bits(2) as usize));
        (body, node, f64::from_bits(bits(0)))
    });
    all.reduce(|most, other| {
        let is_first = (other.0, other.1) < (most.0, most.1);
        let is_it = other.2 > most.2 || other.2 == most.2 && is_first;
        if is_it { other } else { most }
    })
}

/// The node with the longest way.
fn furthest(before: &[Vec3], now: &[Vec3]) -> Option<(usize, f64)> {
    let ways = before.iter().zip(now).map(|(from, to)| (to - from).norm());
    ways.enumerate()
        .reduce(|most, way| if way.1 > most.1 { way } else { most })
}

/// The longest way that is prescribed, of nodes or of rigid bodies.
fn prescribed(setting: &Setting, trial: &Trial) -> f64 {
    let (imposed, state) = (setting.imposed, setting.state);
    let of_nodes = imposed.positions.iter();
    let of_nodes = of_nodes.map(|&(node, axis, to)| {
        (to - setting.context.along(node, axis, &state.positions[node])).abs()
    });
    let of_bodies = trial.rigid.iter().zip(&imposed.before).zip(&imposed.rigid);
    let of_bodies = of_bodies.flat_map(|((now, before), given)| {
        let way = now.displacement - before.displacement;
        (0..3)
            .filter(|&axis| given[axis].is_some())
            .map(move |axis| way[axis].abs())
    });
    of_nodes.chain(of_bodies).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_way_is_found() {
        let before = [
            Vec3::zeros(),
            Vec3::new(3.0, 0.0, 0.0),
            Vec3::new(0.0, 4.0, 0.0),
        ];
        let mut now = before;
        now[2].z = -7.0;
        assert_eq!(furthest(&before, &now), Some((2, 7.0)));
    }
}
