//! Friction never creates energy.

use crate::scene::Run;

/// Friction takes out work in every increment.
pub fn dissipates(run: &Run) {
    for pair in 0..run.problem.pairs.len() {
        for states in run.states.windows(2) {
            let [before, after] = [0, 1].map(|at| states[at].pairs[pair].dissipated);
            let work = after - before;
            assert!(
                work >= 0.0,
                "pair {pair}: {work} at time {}",
                states[1].time
            );
        }
    }
}
