//! The common polygon of two convex polygons whose vertices know what they are.
//!
//! The vertices are the corners of either that the other contains and the
//! crossings of edges whose ends lie strictly on either side of each other. Which
//! side of an edge a corner lies on is decided once, with a tolerance: a corner
//! that close to an edge counts as on it, is itself the vertex, and forms no
//! crossing. One tolerance for all decides without contradiction. Vertices are put
//! in order by their direction from the middle.

use super::plane_facet::Vec2;

/// A convex outline, counter-clockwise.
pub(super) struct Outline {
    /// Numbers of its corners in the facet, three or four.
    pub corners: Vec<usize>,
    /// Positions of the vertices.
    pub places: Vec<Vec2>,
}

/// Origin of a vertex of the common polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Label {
    /// A corner of one side, numbered 0..8 with those of the second after the first's.
    Corner(usize),
    /// A corner of each side in one place: their middle.
    Both([usize; 2]),
    /// Crossing of an edge of each side.
    Crossing([CutEdge; 2]),
}

/// An edge and the share of it, from start to end, at which it is crossed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CutEdge {
    /// Numbers of start and end, 0..8.
    pub ends: [usize; 2],
    /// Share of the way.
    pub share: f64,
}

impl Label {
    /// A number of its own, without the share at which edges cross.
    fn number(&self) -> u64 {
        let pair = |[a, b]: [usize; 2]| 8 * a as u64 + b as u64;
        match self {
            Self::Corner(corner) => *corner as u64,
            Self::Both(corners) => 64 + pair(*corners),
            Self::Crossing([a, b]) => 128 + 64 * pair(a.ends) + pair(b.ends),
        }
    }
}

/// Labels of all vertices in order, as one number.
pub(super) fn topology(vertices: &[Vertex]) -> u64 {
    let labels = vertices.iter().map(|vertex| vertex.label.number());
    labels.fold(FIRST, mixed)
}

/// Start and factor of the hash FNV-1a (Fowler, Noll, Vo).
pub const FIRST: u64 = 0xcbf2_9ce4_8422_2325;
const FACTOR: u64 = 0x0000_0100_0000_01b3;

/// A hash with another number in it.
pub const fn mixed(hash: u64, number: u64) -> u64 {
    (hash ^ number).wrapping_mul(FACTOR)
}

/// A vertex of the common polygon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    /// Position of the vertex.
    pub place: Vec2,
    /// Origin of the vertex, which determines how it moves.
    pub label: Label,
}

/// Distances of the corners of one outline inside the edges of another, zero if on
/// them: row by corner, column by edge.
type Distances = [[f64; 4]; 4];

impl Outline {
    fn len(&self) -> usize {
        self.places.len()
    }

    fn after(&self, at: usize) -> usize {
        (at + 1) % self.len()
    }

    fn distances(&self, window: &Outline, tolerance: f64) -> Distances {
        let mut distances = [[0.0; 4]; 4];
        for edge in 0..window.len() {
            let start = window.places[edge];
            let along = (window.places[window.after(edge)] - start).normalize();
            for corner in 0..self.len() {
                let distance = along.perp(&(self.places[corner] - start));
                // Exactly zero, so that all tests of one corner against one edge agree.
                distances[corner][edge] = if distance.abs() <= tolerance {
                    0.0
                } else {
                    distance
                };
            }
        }
        distances
    }

    /// Corners that the window contains.
    fn inside(&self, distances: &Distances, window: &Outline) -> Vec<usize> {
        let within = |corner: &usize| distances[*corner][..window.len()].iter().all(|d| *d >= 0.0);
        (0..self.len()).filter(within).collect()
    }
}

/// Vertices of the common polygon of two outlines, counter-clockwise. Corners within
/// `tolerance` of an edge are on it. Fewer than three mean no common area.
pub(super) fn common(a: &Outline, b: &Outline, tolerance: f64) -> Vec<Vertex> {
    let of_a = a.distances(b, tolerance);
    let of_b = b.distances(a, tolerance);
    let mut vertices = Vec::with_capacity(12);
    let mut alone = b.inside(&of_b, a);
    for i in a.inside(&of_a, b) {
        let (place, own) = (a.places[i], a.corners[i]);
        // Both corners were snapped to the edges of the other by up to the tolerance each.
        let near = |j: &usize| (b.places[*j] - place).norm() <= 2.0 * tolerance;
        vertices.push(match alone.iter().position(near) {
            Some(found) => {
                let j = alone.remove(found);
                Vertex {
                    place: (place + b.places[j]) * 0.5,
                    label: Label::Both([own, 4 + b.corners[j]]),
                }
            }
            None => Vertex {
                place,
                label: Label::Corner(own),
            },
        });
    }
    vertices.extend(alone.into_iter().map(|j| Vertex {
        place: b.places[j],
        label: Label::Corner(4 + b.corners[j]),
    }));
    for i in 0..a.len() {
        for j in 0..b.len() {
            vertices.extend(crossing(a, i, &of_a, b, j, &of_b));
        }
    }
    in_order(vertices)
}

fn crossing(
    a: &Outline,
    i: usize,
    of_a: &Distances,
    b: &Outline,
    j: usize,
    of_b: &Distances,
) -> Option<Vertex> {
    let (i_end, j_end) = (a.after(i), b.after(j));
    let [d, d_end] = [of_a[i][j], of_a[i_end][j]];
    let [e, e_end] = [of_b[j][i], of_b[j_end][i]];
    // Strictly on both sides: where a corner lies on the edge, the corner itself is the vertex.
    if !(d * d_end < 0.0 && e * e_end < 0.0) {
        return None;
    }
    let (share, other) = (d / (d - d_end), e / (e - e_end));
    let on_a = a.places[i] + (a.places[i_end] - a.places[i]) * share;
    let edge_a = CutEdge {
        ends: [a.corners[i], a.corners[i_end]],
        share,
    };
    let edge_b = CutEdge {
        ends: [4 + b.corners[j], 4 + b.corners[j_end]],
        share: other,
    };
    Some(Vertex {
        place: on_a,
        label: Label::Crossing([edge_a, edge_b]),
    })
}

/// Sorted by direction from their mean.
fn in_order(vertices: Vec<Vertex>) -> Vec<Vertex> {
    let sum: Vec2 = vertices.iter().map(|vertex| vertex.place).sum();
    let middle = sum / vertices.len() as f64;
    let mut keyed: Vec<(f64, Vertex)> = vertices
        .into_iter()
        .map(|vertex| (direction(&(vertex.place - middle)), vertex))
        .collect();
    keyed.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    keyed.into_iter().map(|(_, vertex)| vertex).collect()
}

/// Grows with the angle of a vector, from 0 to 4.
fn direction(v: &Vec2) -> f64 {
    // Monotone in the angle like `atan2`, but with exactly rounded operations only, which are the
    // same on every machine.
    let along = v.x / (v.x.abs() + v.y.abs());
    if v.y >= 0.0 { 1.0 - along } else { 3.0 + along }
}

/// Twice the area of a polygon.
pub(super) fn twice_area(vertices: &[Vertex]) -> f64 {
    let Some(first) = vertices.first() else {
        return 0.0;
    };
    let corner =
        |pair: &[Vertex]| (pair[0].place - first.place).perp(&(pair[1].place - first.place));
    vertices.windows(2).map(corner).sum()
}
