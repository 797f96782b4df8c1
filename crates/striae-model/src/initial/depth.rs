//! Overlaps that are too deep to be pressed out.

use striae_contact::interference::{Interference, Place, Stage, inside};

use super::LARGEST_OVERLAP;

/// Overlap over the thickness of the body beyond which its other side is nearer.
const HALF: f64 = 0.5;

/// The deepest overlap over the thickness of the body, if it is more than half of it, with that
/// thickness and the local facet size.
pub(super) fn beyond_middle(stage: &Stage) -> Option<(Interference, f64, f64)> {
    let found = inside(stage, LARGEST_OVERLAP).into_iter();
    let thick = found.filter_map(|found| {
        let Place::Facet(facet) = found.place else {
            return None;
        };
        let thickness = stage.thickness.0[found.side.opposite()][facet.index()];
        (found.depth > HALF * thickness).then_some((found, thickness))
    });
    let share = |(found, thickness): &(Interference, f64)| found.depth / thickness;
    let (found, thickness) = thick.max_by(|a, b| share(a).total_cmp(&share(b)))?;
    let size = stage.configuration.side(found.side).sizes[found.node];
    Some((found, thickness, size))
}
