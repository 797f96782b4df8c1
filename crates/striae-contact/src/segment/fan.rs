//! Triangles of a common polygon.
//!
//! Flat corners are cut off first. Where edges all but run along each other their
//! crossing is a flat corner that moves along them without bound: cut off alone,
//! its triangle vanishes as fast as it moves; as the end of a diagonal it would
//! multiply the error of quadrature by its speed. What remains is a fan: about its
//! first corner where the rule is exact and any fan as good, else about the mean of
//! the corners, so that the sum does not depend on where their list starts.

use super::{plane_facet::Vec2, polygon::Vertex};

/// Sine of the turn at a corner below which it counts as flat.
const FLAT: f64 = 1e-3;

/// Common point of the triangles of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Apex {
    /// In a corner.
    Corner,
    /// In the mean of the corners.
    Centre,
}

/// Triangles of a polygon of `n` vertices by indices; index `n` is the centre.
pub(super) struct Fan {
    /// Three indices each, counter-clockwise.
    pub triangles: Vec<[usize; 3]>,
    /// The vertices of which the centre is the mean; empty if there is none.
    pub around: Vec<usize>,
    /// Places of the vertices and of the centre if there is one.
    pub places: Vec<Vec2>,
}

/// The triangles of a convex polygon, counter-clockwise.
pub(super) fn fan(polygon: &[Vertex], apex: Apex) -> Fan {
    let mut places: Vec<Vec2> = polygon.iter().map(|vertex| vertex.place).collect();
    let mut kept: Vec<usize> = (0..polygon.len()).collect();
    let mut triangles = cut_off(&places, &mut kept);
    if kept.len() == 3 || apex == Apex::Corner {
        triangles.extend((2..kept.len()).map(|at| [kept[0], kept[at - 1], kept[at]]));
        return Fan {
            triangles,
            around: Vec::new(),
            places,
        };
    }
    let sum: Vec2 = kept.iter().map(|at| places[*at]).sum();
    places.push(sum / kept.len() as f64);
    let next = |at: usize| kept[(at + 1) % kept.len()];
    triangles.extend((0..kept.len()).map(|at| [kept[at], next(at), polygon.len()]));
    Fan {
        triangles,
        around: kept,
        places,
    }
}

/// Removes flat corners, but never the last three, and returns their triangles.
fn cut_off(places: &[Vec2], kept: &mut Vec<usize>) -> Vec<[usize; 3]> {
    let mut triangles = Vec::with_capacity(8);
    let mut at = 0;
    while kept.len() > 3 && at < kept.len() {
        let count = kept.len();
        let [before, after] = [count - 1, 1].map(|step| kept[(at + step) % count]);
        let (u, v) = (
            places[kept[at]] - places[before],
            places[after] - places[kept[at]],
        );
        if u.perp(&v).abs() <= FLAT * u.norm() * v.norm() && u.dot(&v) > 0.0 {
            triangles.push([before, kept.remove(at), after]);
            at = 0;
        } else {
            at += 1;
        }
    }
    triangles
}
