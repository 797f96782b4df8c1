//! Test of whether runs that differ do so by round-off.

use super::differences::{Differences, FORCES, ITERATIONS};
use crate::scenes::output::History;

/// Evidence from runs of one process, with loads changed by round-off, about ranks that differ from
/// one process.
///
/// The forces of the ranks may differ slightly: those of a changed run must differ by as much. Or
/// they may belong to a state that one process does not reach otherwise: a changed run must reach
/// it, with the forces of the ranks. They may take more or fewer iterations in an increment:
/// changed runs must differ from the unchanged one by as many. If the ranks made other increments,
/// their forces cannot be compared: a changed run must make other increments, too.
pub struct Evidence<'a> {
    alone: &'a History,
    together: &'a History,
    /// `true` if the forces of a changed run account for those of the ranks.
    has_forces: bool,
    /// The most iterations by which an increment of a changed run differs.
    iterations: f64,
}

/// Largest difference of forces that is one of round-off within a state.
const LITTLE: f64 = 1e-6;

impl<'a> Evidence<'a> {
    pub fn new(alone: &'a History, together: &'a History) -> Self {
        Self {
            alone,
            together,
            has_forces: false,
            iterations: ITERATIONS,
        }
    }

    /// Adds a changed run, and says what was found if it is enough; `ends_alike` tells whether
    /// its exit code is that of the ranks.
    pub fn with(&mut self, changed: &History, ends_alike: bool) -> Option<String> {
        let Ok(found) = Differences::of(self.alone, self.together) else {
            let other = Differences::of(self.alone, changed).err()?;
            return ends_alike.then_some(other);
        };
        let change = Differences::of(self.alone, changed).ok()?;
        let left = Differences::of(self.together, changed).ok()?;
        self.iterations = self.iterations.max(change.iterations);
        let is_as_far = found.forces <= change.forces.min(LITTLE);
        self.has_forces |= ends_alike && (left.forces <= FORCES || is_as_far);
        let is_enough = self.has_forces && found.iterations <= self.iterations;
        is_enough.then(|| format!("{change}; held against the ranks: {left}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one process two increments with a force of 1 in the end, changed as given.
    fn history(iterations: f64, force: f64) -> History {
        let text = format!("iterations,reaction.a.x\n3,0.5\n{iterations},{force}\n");
        History::of(&text).unwrap()
    }

    #[test]
    fn another_state_is_excused_by_a_run_that_comes_to_it() {
        let (alone, together) = (history(4.0, 1.0), history(4.0, 0.9));
        let mut evidence = Evidence::new(&alone, &together);
        assert!(evidence.with(&history(4.0, 1.0), true).is_none());
        // A third state, farther away.
        assert!(evidence.with(&history(4.0, 0.8), true).is_none());
        assert!(evidence.with(&history(4.0, 0.9), false).is_none());
        assert!(evidence.with(&history(4.0, 0.9 - 1e-11), true).is_some());
    }

    #[test]
    fn forces_are_excused_by_others_that_differ_as_much() {
        let (alone, together) = (history(4.0, 1.0), history(4.0, 1.0 + 3e-8));
        let mut evidence = Evidence::new(&alone, &together);
        assert!(evidence.with(&history(4.0, 1.0 + 1e-8), true).is_none());
        assert!(evidence.with(&history(4.0, 1.0 - 4e-8), true).is_some());
    }

    #[test]
    fn iterations_are_excused_by_as_many() {
        let (alone, together) = (history(4.0, 1.0), history(9.0, 1.0));
        let mut evidence = Evidence::new(&alone, &together);
        assert!(evidence.with(&history(7.0, 1.0), true).is_none());
        assert!(evidence.with(&history(10.0, 0.5), true).is_some());
    }

    #[test]
    fn other_increments_are_excused_by_other_increments() {
        let (alone, changed) = (history(4.0, 1.0), history(9.0, 1.0));
        let together = History::of("iterations,reaction.a.x\n3,0.5\n").unwrap();
        let mut evidence = Evidence::new(&alone, &together);
        assert!(evidence.with(&changed, true).is_none());
        assert!(evidence.with(&together, false).is_none());
        assert!(evidence.with(&together, true).is_some());
        // Others of a changed run say nothing of ranks that made the same.
        let mut evidence = Evidence::new(&alone, &changed);
        assert!(evidence.with(&together, true).is_none());
    }
}
