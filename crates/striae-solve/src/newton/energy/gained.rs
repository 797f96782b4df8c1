//! Energy that contact makes beyond what friction explains.

use super::Ends;
use crate::offsets::Offsets;

impl Ends<'_> {
    /// Energy that contact has made beyond friction, at least. Only the forces at the ends of an
    /// increment are known: it counts by that end at which it is less, and not at all where
    /// contact takes energy by one end and makes it by the other, as friction does that has begun
    /// in it. In the first step overlaps of the meshes that are pressed out, and interferences,
    /// give what they hold.
    pub(in crate::newton) fn gained(&self, friction: f64) -> f64 {
        if self.context.index == 0 && self.context.offsets.iter().any(Offsets::are_any) {
            return self.state.gained;
        }
        let others = friction + self.stabilisation() + self.work_of_stabilisation();
        let others = others - self.resisted(|_| true);
        let ends = [0.0, 1.0].map(|weight| others - self.contact(weight));
        let least = f64::max(ends[0].min(ends[1]), 0.0) + f64::min(ends[0].max(ends[1]), 0.0);
        self.state.gained + least
    }
}
