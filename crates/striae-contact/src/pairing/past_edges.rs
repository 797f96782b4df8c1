//! Faces that overlap past edges of their bodies.
//!
//! A body that slides off another one sinks a little once its edge is beyond the other edge. The
//! two faces that end at these edges then face each other through both bodies, overlapping by the
//! whole way that is left to slide, on a strip that is only as wide as the body sank. Pushing them
//! apart would take tension elsewhere. With the overlap `d_0` of the points of a segment at the
//! start of the increment, and the distances `w_1` and `w_2` of its farthest vertex from an edge
//! at which the face of its first and of its second facet ends, facets are not paired where
//!
//! ```text
//! d_0 > max(w_1, w_2)
//! ```
//!
//! Faces that come onto each other in the increment have `d_0 <= 0`, however narrow the strip.

use striae_mesh::Vec3;
use striae_surface::topology::distinct_corners;

use super::PairedFacets;
use crate::configuration::Configuration;

/// Returns whether facets face each other past edges of their bodies; `start` are the positions
/// at the start of the increment, by side.
pub(super) fn face_past_edges(
    configuration: &Configuration,
    paired: &PairedFacets,
    start: &[Vec<Vec3>; 2],
) -> bool {
    let overlap = -gap_at(paired, start);
    if overlap <= 0.0 {
        return false;
    }
    let Some(vertices) = paired.segment.at_vertices() else {
        return false;
    };
    let mut widths = [0, 1]
        .map(|at| width(configuration, paired, at, &vertices))
        .into_iter();
    widths.all(|width| overlap > width)
}

/// Distance of the farthest vertex of a segment from an edge at which the face of one of its
/// facets ends; infinite if it does not end at the facet.
fn width(
    configuration: &Configuration,
    paired: &PairedFacets,
    at: usize,
    vertices: &[[f64; 8]],
) -> f64 {
    let surface = configuration.side(paired.sides[at]).surface;
    let corners = &paired.corners[at];
    let ring = distinct_corners(corners).len();
    let x = &paired.x[4 * at..4 * at + 4];
    let place = |n: &[f64; 8]| -> Vec3 { (0..4).map(|c| x[c] * n[4 * at + c]).sum() };
    let edges = (0..ring).map(|corner| [corner, (corner + 1) % ring]);
    let ends = edges.filter(|&[from, to]| surface.is_boundary_edge([corners[from], corners[to]]));
    let distance = |[from, to]: [usize; 2]| {
        let along = (x[to] - x[from]).normalize();
        let apart = vertices.iter().map(|n| place(n) - x[from]);
        apart
            .map(|apart| (apart - along * apart.dot(&along)).norm())
            .fold(0.0, f64::max)
    };
    ends.map(distance).fold(f64::INFINITY, f64::min)
}

/// Mean gap at the start of the increment of the points that a segment consists of.
fn gap_at(paired: &PairedFacets, start: &[Vec<Vec3>; 2]) -> f64 {
    let x = std::array::from_fn(|corner| {
        let at = corner / 4;
        start[paired.sides[at]][paired.corners[at][corner % 4]]
    });
    let sum: Vec3 = (0..4).map(|c| paired.difference(c, &x, &x[0])).sum();
    paired.segment.normal.dot(&sum) / paired.segment.area
}

#[cfg(test)]
mod tests {
    use striae_mesh::NodeId;

    use super::*;
    use crate::{
        pair::ContactPair,
        pairing::{
            Corners, Scope, compliances, paired_facets,
            tests::{pair_of, side},
        },
        placement::Placement,
        segment::SegmentDerivatives,
    };

    /// Number of paired facets of a square wall that ends at `z = 0`, and of one above it that
    /// faces it: the latter sank by `sank`, overlaps by `overlap`, and was `gap` away before.
    fn paired(sank: f64, overlap: f64, gap: f64) -> usize {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let wall = |x: f64, z: f64| corners.map(|[y, up]| Vec3::new(x, y, z + up)).to_vec();
        let node = NodeId::new;
        let wall_of = |facet: [usize; 4]| side(&[facet.map(node)]);
        let sides = [wall_of([0, 1, 2, 3]), wall_of([0, 3, 2, 1])];
        let pair = ContactPair {
            has_faces: true,
            ..pair_of(sides, None)
        };
        let lower = wall(0.0, -1.0);
        let start = [lower.clone(), wall(gap, -sank)];
        let x = [lower, wall(-overlap, -sank)];
        let at = Configuration::new(&pair, x, Placement::at_rest());
        let compliances = compliances(&at);
        let scope = Scope {
            compliances: &compliances,
            depth: 0.0,
            start: Some(&start),
        };
        let none = |_: &[Corners]| SegmentDerivatives::None;
        paired_facets(&at, scope, &none, |_| true).len()
    }

    #[test]
    fn walls_that_meet_in_an_increment_touch_however_little_they_share() {
        for sank in [0.02, 0.2, 0.5] {
            assert_eq!(paired(sank, 0.1, 0.05), 1);
            assert_eq!(paired(sank, -0.1, 0.15), 1);
        }
    }

    #[test]
    fn walls_beyond_each_others_edges_do_not_touch() {
        assert_eq!(paired(0.02, 0.3, -0.4), 0);
        assert_eq!(paired(0.02, 0.03, -0.1), 0);
        assert_eq!(paired(0.02, 0.01, -0.1), 0);
        // Wider than they overlapped.
        assert_eq!(paired(0.4, 0.3, -0.35), 1);
        assert_eq!(paired(0.2, 0.3, -0.1), 1);
    }
}
