//! Numbers of the unknowns of a rank in the whole system.

use striae_condensed::Numbering;
use striae_mesh::Vec3;
use striae_sparse::Supervariable;

use crate::{layout::Layout, problem::Problem};

/// The numbers: own ones without a gap, in the order of the layout; collective.
///
/// Unknowns of a supervariable stay together.
pub(crate) fn numbering(problem: &Problem, layout: &Layout) -> Numbering {
    let share = &problem.share;
    let offsets = layout.offsets();
    let size = |at: usize| offsets[at + 1] - offsets[at];
    let supervariables = 0..offsets.len() - 1;
    let is_own = |&at: &usize| layout.is_own(problem, Supervariable(at));
    let count: usize = supervariables.clone().filter(is_own).map(size).sum();
    let counts = share.team().gather(&(count as u64).to_le_bytes());
    let counts: Vec<usize> = counts.iter().map(|bytes| number(bytes)).collect();
    let start: usize = counts[..share.team().rank()].iter().sum();
    let mut next = start;
    // Numbers are exact; where a rank does not own what it holds, the sum has that of the owner.
    let mut firsts = vec![Vec3::zeros(); offsets.len() - 1];
    for at in supervariables.clone().filter(is_own) {
        firsts[at].x = next as f64;
        next += size(at);
    }
    let (of_nodes, of_bodies) = firsts.split_at_mut(problem.reference.len());
    share.sum_at_nodes(&mut [of_nodes]);
    share.sum_vectors(of_bodies);
    let whole = supervariables.flat_map(|at| {
        let first = firsts[at].x as usize;
        first..first + size(at)
    });
    Numbering {
        count: counts.iter().sum(),
        own: start..next,
        whole: whole.collect(),
    }
}

fn number(bytes: &[u8]) -> usize {
    u64::from_le_bytes(bytes.try_into().expect("a number has eight bytes")) as usize
}
