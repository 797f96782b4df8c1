//! Facets of one side that lie opposite to one facet of the other.
//!
//! Nodes whose facets lie opposite to the same facet couple with each other through it and
//! its neighbours. Choosing among `m` of them which ones keep traction unknowns takes a
//! triangular factor for each: for `c` facets opposite to one, of `n` in all,
//!
//! ```text
//! m = min(9 c, n),   c (m^2 / 2) 8 bytes
//! ```
//!
//! Facets are taken as their boxes. Those of a side at a gap are moved together along the
//! axis nearest to the normal.

use striae_mesh::Vec3;

use crate::{
    search::{Bounds, Tree},
    side::Side,
};

/// Facets about one that couple through it.
const NEIGHBOURHOOD: f64 = 9.0;
/// Bytes of an entry of a triangular factor, over the square of its size.
const ENTRY: f64 = 4.0;
/// Part of the size of a box by which it is smaller, so that neighbours do not count.
const INSIDE: f64 = 1e-6;

/// The facet with the most facets opposite to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opposite {
    /// Side of the facet.
    pub side: Side,
    /// Its centre.
    pub at: Vec3,
    /// Number of facets that lie opposite.
    pub count: usize,
    /// Memory for the choice of unknowns about it.
    pub bytes: f64,
    /// Memory for that of all facets.
    pub total: f64,
}

impl Opposite {
    /// Counts by the corners of the facets of both sides, whose gap is at most that; stops at
    /// the first facet that takes more memory than a limit.
    pub fn of(sides: [&[[Vec3; 4]]; 2], gap: f64, limit: f64) -> Option<Self> {
        let boxes = sides.map(|facets| {
            let boxes = facets.iter().map(|facet| Bounds::around(*facet));
            boxes.collect::<Vec<_>>()
        });
        let trees = boxes.map(Tree::new);
        let mut most: Option<Self> = None;
        let mut total = 0.0;
        for side in Side::BOTH {
            let others = sides[side.opposite()].len();
            for facet in sides[side] {
                let count = trees[side.opposite()].meeting(&reach(facet, gap)).len();
                let bytes = bytes(count, others);
                total += bytes;
                if most.is_none_or(|most| count > most.count) {
                    most = Some(Self {
                        side,
                        at: facet.iter().sum::<Vec3>() / 4.0,
                        count,
                        bytes,
                        total: 0.0,
                    });
                }
                if bytes > limit {
                    return most.map(|most| Self { total, ..most });
                }
            }
        }
        most.map(|most| Self { total, ..most })
    }
}

fn bytes(count: usize, others: usize) -> f64 {
    let coupled = (NEIGHBOURHOOD * count as f64).min(others as f64);
    ENTRY * count as f64 * coupled * coupled
}

/// Box of a facet, smaller within its plane and larger across it.
fn reach(facet: &[Vec3; 4], gap: f64) -> Bounds {
    let [a, b, c, d] = facet;
    let normal = (c - a).cross(&(d - b));
    let bounds = Bounds::around(*facet);
    let size = (bounds.high - bounds.low).norm();
    let mut by = Vec3::repeat(-INSIDE * size);
    by[normal.iamax()] = gap + INSIDE * size;
    Bounds {
        low: bounds.low - by,
        high: bounds.high + by,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(divisions: [usize; 2], z: f64) -> Vec<[Vec3; 4]> {
        let [nx, ny] = divisions;
        let at = |i: usize, j: usize| Vec3::new(i as f64 / nx as f64, j as f64 / ny as f64, z);
        let cells = (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j)));
        let corners = |(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        cells.map(corners).collect()
    }

    #[test]
    fn slivers_are_counted_across_and_along() {
        let counted = |a, b, gap: f64| {
            let sides = [grid(a, 0.0), grid(b, gap)];
            let found = Opposite::of([&sides[0], &sides[1]], gap, f64::INFINITY);
            let found = found.unwrap();
            (found.side, found.count)
        };
        assert_eq!(counted([60, 3], [3, 3], 0.0), (Side::B, 20));
        assert_eq!(counted([60, 3], [3, 3], 0.1), (Side::B, 20));
        assert_eq!(counted([3, 3], [60, 3], 0.1), (Side::A, 20));
        assert_eq!(counted([60, 3], [3, 60], 0.0), (Side::A, 20));
        assert_eq!(counted([20, 20], [20, 20], 0.0), (Side::A, 1));
    }

    #[test]
    fn counting_stops_at_the_limit() {
        let sides = [grid([60, 3], 0.0), grid([3, 3], 0.0)];
        let found = Opposite::of([&sides[0], &sides[1]], 0.0, 1e6).unwrap();
        assert_eq!(found.bytes, bytes(20, 180));
        assert_eq!(found.total, 180.0 * bytes(1, 9) + found.bytes);
    }
}
