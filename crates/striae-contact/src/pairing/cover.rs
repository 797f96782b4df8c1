//! Area that the segments of a pair cover.
//!
//! A point of a surface lies opposite to one point of the other one, so that the areas of all
//! segments sum up to at most the area of each side; and to more only where layers are within the
//! reach of one another. A correction of Newton's method that goes through a body folds the
//! surfaces over each other: each of their facets then faces a large part of the other side, and
//! the segments cover a side ten times and more. Such a state is none of two bodies.

use std::sync::atomic::{AtomicU64, Ordering};

use striae_mesh::FacetId;

use super::PairedFacets;
use crate::configuration::Configuration;

/// Area that segments may cover, over the area of a side, or over what they covered before.
const MOST: f64 = 2.0;
/// The limit in units of the sum.
const UNITS: f64 = (1_u64 << 40) as f64;

/// Sum of the areas of segments up to a limit. Integers are summed, so that the order of facets, and
/// with it the number of threads, changes no bit.
pub(super) struct Cover {
    limit: f64,
    sum: AtomicU64,
}

/// The surfaces of a pair are folded over each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Folded;

impl Cover {
    /// Nothing yet, up to an area.
    pub(super) fn up_to(limit: f64) -> Self {
        let sum = AtomicU64::new(0);
        Self { limit, sum }
    }

    /// Adds segments.
    pub(super) fn add(&self, paired: &[PairedFacets]) {
        // One facet beyond the limit is enough; without a bound the sum of many could overflow.
        let units = (area(paired) / self.limit * UNITS).min(2.0 * UNITS);
        self.sum.fetch_add(units as u64, Ordering::Relaxed);
    }

    /// Returns whether the segments cover more than the limit.
    pub(super) fn is_exceeded(&self) -> bool {
        self.sum.load(Ordering::Relaxed) as f64 > UNITS
    }
}

/// Area that the segments of a configuration may cover; infinite before a plane, which each facet
/// faces once.
pub(super) fn most(configuration: &Configuration) -> f64 {
    if configuration.plane().is_some() {
        return f64::INFINITY;
    }
    let sides = configuration.sides.iter().flatten();
    let areas = sides.map(|side| {
        let facets = (0..side.surface.facets().len()).map(FacetId::new);
        let area = |facet| {
            let [a, b, c, d] = side.corner_positions(facet);
            0.5 * (c - a).cross(&(d - b)).norm()
        };
        facets.map(area).sum::<f64>()
    });
    MOST * areas.fold(f64::INFINITY, f64::min)
}

/// Area that segments may cover that covered another one before.
pub(super) fn most_after(before: f64) -> f64 {
    MOST * before
}

/// Area of segments.
pub(super) fn area(paired: &[PairedFacets]) -> f64 {
    paired.iter().map(|paired| paired.segment.area).sum()
}

#[cfg(test)]
mod tests {
    use striae_mesh::{NodeId, Vec3};

    use super::*;
    use crate::{
        pair::PairedSurface,
        pairing::{
            Corners, Scope, compliances, paired_facets, paired_unless_folded,
            tests::{pair_of, side},
        },
        placement::Placement,
        segment::SegmentDerivatives,
    };

    /// Layers of unit squares that look upwards or downwards.
    fn layers(count: usize, up: bool) -> PairedSurface {
        let ring = |layer: usize| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|corner| NodeId::new(4 * layer + corner));
            if up { [a, b, c, d] } else { [a, d, c, b] }
        };
        let facets: Vec<_> = (0..count).map(ring).collect();
        side(&facets)
    }

    /// Corners of layers at heights, each moved aside from the last.
    fn corners(heights: &[f64], aside: f64) -> Vec<Vec3> {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let layers = heights.iter().enumerate();
        let layers = layers
            .flat_map(|(layer, z)| square.map(|[x, y]| Vec3::new(x + aside * layer as f64, y, *z)));
        layers.collect()
    }

    /// Number of pairs of five layers on top of one another with one below, after they were `aside`
    /// of each other; `swapped` exchanges the sides.
    fn paired_after(aside: f64, swapped: bool) -> Result<usize, Folded> {
        let heights = [0.05, 0.1, 0.15, 0.2, 0.25];
        let mut sides = [layers(1, true), layers(heights.len(), false)];
        if swapped {
            sides.reverse();
        }
        let pair = pair_of(sides, Some(0.5));
        let at = |aside: f64| {
            let mut x = [corners(&[0.0], 0.0), corners(&heights, aside)];
            if swapped {
                x.reverse();
            }
            Configuration::new(&pair, x, Placement::at_rest())
        };
        let (now, start) = (at(0.0), at(aside));
        let compliances = compliances(&now);
        let scope = Scope {
            compliances: &compliances,
            depth: 0.0,
            start: None,
        };
        let none = |_: &[Corners]| SegmentDerivatives::None;
        assert_eq!(paired_facets(&now, scope, &none, |_| true).len(), 5);
        let found = paired_unless_folded(&now, &start, scope, &none, |_| true);
        found.map(|paired| paired.len())
    }

    #[test]
    fn surfaces_that_cover_another_many_times_are_folded_unless_they_did_so_before() {
        for swapped in [false, true] {
            assert_eq!(paired_after(0.0, swapped), Ok(5));
            assert_eq!(paired_after(0.1, swapped), Ok(5));
            assert_eq!(paired_after(0.4, swapped), Err(Folded));
            assert_eq!(paired_after(2.0, swapped), Err(Folded));
        }
    }
}
