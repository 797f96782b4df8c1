//! Friction never creates energy.

use crate::scene::Run;
use striae_solve::report;

/// Friction takes out work in every increment, up to the round-off of the slips of
/// sticking nodes, which are differences of positions.
pub fn dissipates(run: &Run) {
    for pair in 0..run.problem.pairs.len() {
        for states in run.states.windows(2) {
            let [before, after] = [0, 1].map(|at| states[at].pairs[pair].dissipated);
            let work = after - before;
            let friction = report::pairs(&run.problem, &states[1])[pair].sides[0].friction;
            let positions = states[1].positions.iter().map(|x| x.norm());
            let size = positions.fold(0.0, f64::max);
            assert!(
                work >= -f64::EPSILON * friction * size,
                "pair {pair}: {work} at time {}",
                states[1].time
            );
        }
    }
}
