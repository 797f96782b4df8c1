//! The composite tetrahedron of ten nodes: four corners and the middles of the six edges.
//!
//! The element lies on the natural coordinates of the linear tetrahedron and is divided into twelve
//! linear ones, one at each corner and eight around the middle of the octahedron that is left, the
//! mean of the six middles of edges ([`COMPOSITE_PARTS`]). With the linear functions `l_0 .. l_3`
//! of the corners and
//!
//! ```text
//! p = l_0 + l_1 - 1/2,   q = l_0 + l_2 - 1/2,   r = l_0 + l_3 - 1/2,
//! c = 1 - 2 (|p| + |q| + |r|)
//! ```
//!
//! functions in the octahedron are `c/6 + 2 max(0, +-p)` at the middles of the edges `0 1` and
//! `2 3`, with `q` at `0 2` and `1 3`, with `r` at `0 3` and `1 2`, and zero at the corners.
//! Where `l_a > 1/2` they are `2 l_a - 1` at corner `a` and `2 l_b` in the middle of the edge
//! `a b`. (Thoutireddy et al., Int. J. Numer. Methods Eng. 53 (2002) 1337,
//! doi:10.1002/nme.337.)
//!
//! Middles follow the corners as in Abaqus and VTK, on the edges `0 1`, `1 2`, `2 0`, `0 3`,
//! `1 3`, `2 3`. Each side of the tetrahedron is four triangular faces: side `s` has the faces
//! `4 s .. 4 s + 3`. The points are the middles of the twelve parts.

use super::{CellShape, MAX_CORNERS};
use crate::Vec3;

/// Twelve linear tetrahedra by the nodes of the composite one; 10 is the mean of the middles of
/// its edges.
pub const COMPOSITE_PARTS: [[usize; 4]; 12] = [
    [0, 4, 6, 7],
    [1, 5, 4, 8],
    [2, 6, 5, 9],
    [3, 7, 9, 8],
    [10, 6, 4, 7],
    [10, 8, 4, 5],
    [10, 6, 9, 5],
    [10, 8, 9, 7],
    [10, 9, 8, 5],
    [10, 9, 6, 7],
    [10, 4, 8, 7],
    [10, 4, 6, 5],
];

pub(super) static SHAPE: CellShape = CellShape {
    name: "ten-node tetrahedron",
    plural: "ten-node tetrahedra",
    corners: &[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.5, 0.0, 0.0],
        [0.5, 0.5, 0.0],
        [0.0, 0.5, 0.0],
        [0.0, 0.0, 0.5],
        [0.5, 0.0, 0.5],
        [0.0, 0.5, 0.5],
    ],
    faces: &[
        &[0, 6, 4],
        &[6, 2, 5],
        &[4, 5, 1],
        &[6, 5, 4],
        &[0, 4, 7],
        &[4, 1, 8],
        &[7, 8, 3],
        &[4, 8, 7],
        &[1, 5, 8],
        &[5, 2, 9],
        &[8, 9, 3],
        &[5, 9, 8],
        &[2, 6, 9],
        &[6, 0, 7],
        &[9, 7, 3],
        &[6, 7, 9],
    ],
    faces_a_side: 4,
    // Of the parts at the corners.
    trihedra: &[
        [0, 4, 6, 7],
        [4, 6, 0, 7],
        [6, 0, 4, 7],
        [7, 0, 6, 4],
        [1, 5, 4, 8],
        [5, 4, 1, 8],
        [4, 1, 5, 8],
        [8, 1, 4, 5],
        [2, 6, 5, 9],
        [6, 5, 2, 9],
        [5, 2, 6, 9],
        [9, 2, 5, 6],
        [3, 7, 9, 8],
        [7, 9, 3, 8],
        [9, 3, 7, 8],
        [8, 3, 9, 7],
    ],
    regular: std::f64::consts::FRAC_1_SQRT_2,
    corner_jacobian: 8.0,
    points: &[
        middle(0, 0.625, 48.0),
        middle(1, 0.625, 48.0),
        middle(2, 0.625, 48.0),
        middle(3, 0.625, 48.0),
        middle(0, 0.4375, 96.0),
        middle(1, 0.4375, 96.0),
        middle(2, 0.4375, 96.0),
        middle(3, 0.4375, 96.0),
        middle(0, 0.0625, 96.0),
        middle(1, 0.0625, 96.0),
        middle(2, 0.0625, 96.0),
        middle(3, 0.0625, 96.0),
    ],
    recovery: None,
    vtk: 24,
    interpolation,
    gradients,
};

/// Natural coordinates of the points of the rule of degree two: one is `1 - 3 n` and the others
/// `n = (5 - sqrt(5))/20`.
const NEAR: f64 = 0.138_196_601_125_010_5;

/// Linear functions that are 1 at one of the four points of the rule of degree two and 0 at the
/// others, at natural coordinates: `(l_g - n)/(1 - 4 n)`.
pub fn composite_linear(at: &Vec3) -> [f64; 4] {
    let linear = [1.0 - at.x - at.y - at.z, at.x, at.y, at.z];
    linear.map(|l| (l - NEAR) / (1.0 - 4.0 * NEAR))
}

/// The place where `l_a` is `value` and the others are equal, for a part of so many.
const fn middle(a: usize, value: f64, parts: f64) -> ([f64; 3], f64) {
    let mut at = [(1.0 - value) / 3.0; 3];
    if a > 0 {
        at[a - 1] = value;
    }
    (at, 1.0 / parts)
}

/// Middles of the edges from a corner to the others, in the order of these.
const SPOKES: [[usize; 4]; 4] = [[0, 4, 6, 7], [4, 1, 5, 8], [6, 5, 2, 9], [7, 8, 9, 3]];
/// Middles of opposite edges, towards positive and negative `p`, `q` and `r`.
const AXES: [[usize; 2]; 3] = [[4, 9], [6, 8], [7, 5]];
/// Derivatives of `l_0 .. l_3`.
const SLOPES: [Vec3; 4] = [
    Vec3::new(-1.0, -1.0, -1.0),
    Vec3::new(1.0, 0.0, 0.0),
    Vec3::new(0.0, 1.0, 0.0),
    Vec3::new(0.0, 0.0, 1.0),
];

/// `l_0 .. l_3`, and the corner whose part the place is in.
fn place(at: &Vec3) -> ([f64; 4], Option<usize>) {
    let linear = [1.0 - at.x - at.y - at.z, at.x, at.y, at.z];
    (linear, linear.iter().position(|l| *l > 0.5))
}

fn interpolation(at: &Vec3) -> [f64; MAX_CORNERS] {
    let mut values = [0.0; MAX_CORNERS];
    let (l, corner) = place(at);
    if let Some(a) = corner {
        (0..4).for_each(|b| values[SPOKES[a][b]] = 2.0 * l[b]);
        values[a] -= 1.0;
        return values;
    }
    let along = [1, 2, 3].map(|b| l[0] + l[b] - 0.5);
    let centre = 1.0 - 2.0 * along.iter().map(|s| s.abs()).sum::<f64>();
    for ([up, down], s) in AXES.into_iter().zip(along) {
        values[up] = centre / 6.0 + 2.0 * s.max(0.0);
        values[down] = centre / 6.0 + 2.0 * (-s).max(0.0);
    }
    values
}

fn gradients(at: &Vec3) -> [Vec3; MAX_CORNERS] {
    let mut gradients = [Vec3::zeros(); MAX_CORNERS];
    let (l, corner) = place(at);
    if let Some(a) = corner {
        (0..4).for_each(|b| gradients[SPOKES[a][b]] = SLOPES[b] * 2.0);
        return gradients;
    }
    let along = [1, 2, 3].map(|b| (l[0] + l[b] >= 0.5, SLOPES[0] + SLOPES[b]));
    let outward = |(up, slope): (bool, Vec3)| if up { slope } else { -slope };
    let centre: Vec3 = along.into_iter().map(outward).sum::<Vec3>() * -2.0;
    for ([up, down], one) in AXES.into_iter().zip(along) {
        let towards = if one.0 { up } else { down };
        gradients[up] = centre / 6.0;
        gradients[down] = centre / 6.0;
        gradients[towards] += outward(one) * 2.0;
    }
    gradients
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Natural coordinates of the nodes and of the middle.
    fn nodes() -> Vec<Vec3> {
        let mut nodes: Vec<Vec3> = SHAPE.corners.iter().map(|x| Vec3::from(*x)).collect();
        nodes.push(nodes[4..].iter().sum::<Vec3>() / 6.0);
        nodes
    }

    #[test]
    fn parts_fill_the_tetrahedron_and_the_points_are_their_middles() {
        let nodes = nodes();
        for (part, (at, weight)) in COMPOSITE_PARTS.iter().zip(SHAPE.points) {
            let [a, b, c, d] = part.map(|node| nodes[node]);
            let volume = (b - a).dot(&(c - a).cross(&(d - a))) / 6.0;
            assert!((volume - weight).abs() < 1e-16, "{part:?}: {volume}");
            assert!(((a + b + c + d) / 4.0 - Vec3::from(*at)).norm() < 1e-16);
        }
    }

    #[test]
    fn functions_are_linear_in_every_part() {
        let nodes = nodes();
        let mut at_nodes: Vec<[f64; MAX_CORNERS]> = nodes.iter().map(interpolation).collect();
        at_nodes[10] = [0.0; MAX_CORNERS];
        at_nodes[10][4..10].fill(1.0 / 6.0);
        let shares = [0.1, 0.2, 0.3, 0.4];
        for part in COMPOSITE_PARTS {
            let at: Vec3 = part.iter().zip(shares).map(|(&n, s)| nodes[n] * s).sum();
            let values = interpolation(&at);
            for a in 0..10 {
                let ends = part.iter().zip(shares);
                let linear: f64 = ends.map(|(&n, share)| at_nodes[n][a] * share).sum();
                assert!((values[a] - linear).abs() < 1e-15, "{part:?} {a}");
            }
        }
    }

    #[test]
    fn the_faces_of_a_side_lie_in_a_plane() {
        let nodes = nodes();
        for side in SHAPE.faces.chunks(SHAPE.faces_a_side) {
            let area = |face: &[usize]| {
                let [a, b, c] = [face[0], face[1], face[2]].map(|at| nodes[at]);
                (b - a).cross(&(c - a))
            };
            assert!(side.iter().all(|face| area(face) == area(side[0])));
        }
    }
}
