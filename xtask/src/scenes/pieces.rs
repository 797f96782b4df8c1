//! Elements of all kinds as tetrahedra, and the sides that no two of them share.
//!
//! Wedges and pyramids are tetrahedra about a diagonal of each side of four corners; those of
//! ten nodes eight, four at the corners and four about a diagonal of what is left. Their sides
//! are four triangles each.

use super::vector::{Vector, cross, dot, minus};

const WEDGE: [[usize; 4]; 3] = [[0, 1, 2, 5], [0, 1, 5, 4], [0, 4, 5, 3]];
const PYRAMID: [[usize; 4]; 2] = [[0, 1, 2, 4], [0, 2, 3, 4]];
const TEN: [[usize; 4]; 8] = [
    [0, 4, 6, 7],
    [4, 1, 5, 8],
    [6, 5, 2, 9],
    [7, 8, 9, 3],
    [4, 9, 6, 5],
    [4, 9, 5, 8],
    [4, 9, 8, 7],
    [4, 9, 7, 6],
];

const SIDES_OF_8: [&[usize]; 6] = [
    &[0, 3, 2, 1],
    &[4, 5, 6, 7],
    &[0, 1, 5, 4],
    &[2, 3, 7, 6],
    &[0, 4, 7, 3],
    &[1, 2, 6, 5],
];
/// As VTK has wedges, with the normal of the first triangle outward.
const SIDES_OF_6: [&[usize]; 5] = [
    &[0, 1, 2],
    &[3, 5, 4],
    &[0, 3, 4, 1],
    &[1, 4, 5, 2],
    &[2, 5, 3, 0],
];
const SIDES_OF_5: [&[usize]; 5] = [
    &[0, 3, 2, 1],
    &[0, 1, 4],
    &[1, 2, 4],
    &[2, 3, 4],
    &[3, 0, 4],
];
const SIDES_OF_4: [&[usize]; 4] = [&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]];
const SIDES_OF_10: [&[usize]; 16] = [
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
];

/// Tetrahedra of an element; none of a hexahedron.
pub fn tetrahedra(cell: &[usize]) -> Vec<[usize; 4]> {
    let parts: &[[usize; 4]] = match cell.len() {
        4 => &[[0, 1, 2, 3]],
        5 => &PYRAMID,
        6 => &WEDGE,
        10 => &TEN,
        _ => &[],
    };
    parts.iter().map(|part| part.map(|i| cell[i])).collect()
}

/// True if a point is inside a tetrahedron of either sense of turning.
pub fn is_inside([a, b, c, d]: &[Vector; 4], point: Vector) -> bool {
    const SLACK: f64 = -1e-12;
    let volume = |a: Vector, b: Vector, c: Vector, d: Vector| {
        dot(cross(minus(b, a), minus(c, a)), minus(d, a))
    };
    let whole = volume(*a, *b, *c, *d);
    whole != 0.0
        && [
            volume(point, *b, *c, *d),
            volume(*a, point, *c, *d),
            volume(*a, *b, point, *d),
            volume(*a, *b, *c, point),
        ]
        .iter()
        .all(|part| part / whole >= SLACK)
}

/// Sides of elements that no two of them share.
pub fn boundary(cells: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut sides: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
    for cell in cells {
        let of_cell: &[&[usize]] = match cell.len() {
            4 => &SIDES_OF_4,
            5 => &SIDES_OF_5,
            6 => &SIDES_OF_6,
            8 => &SIDES_OF_8,
            10 => &SIDES_OF_10,
            _ => &[],
        };
        for side in of_cell {
            let side: Vec<usize> = side.iter().map(|&corner| cell[corner]).collect();
            let mut key = side.clone();
            key.sort_unstable();
            sides.push((key, side));
        }
    }
    sides.sort_unstable();
    let alone = |group: &[(Vec<usize>, Vec<usize>)]| (group.len() == 1).then(|| group[0].1.clone());
    sides
        .chunk_by(|a, b| a.0 == b.0)
        .filter_map(alone)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::grid::TETRAHEDRA;

    /// Corners of a tetrahedron, and the middles of its edges.
    fn ten() -> Vec<Vector> {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let edges = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
        let middle = |[a, b]: [usize; 2]| [0, 1, 2].map(|i| 0.5 * (corners[a][i] + corners[b][i]));
        corners.into_iter().chain(edges.map(middle)).collect()
    }

    /// Volume of elements.
    fn volume(points: &[Vector], cell: &[usize]) -> f64 {
        let parts = match cell.len() {
            8 => TETRAHEDRA.map(|part| part.map(|i| cell[i])).to_vec(),
            _ => tetrahedra(cell),
        };
        let of = |[a, b, c, d]: [usize; 4]| {
            let [b, c, d] = [b, c, d].map(|i| minus(points[i], points[a]));
            dot(cross(b, c), d).abs() / 6.0
        };
        parts.into_iter().map(of).sum()
    }

    #[test]
    fn pieces_fill_their_elements() {
        let third = 1.0 / 3.0;
        let mut pyramid = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        pyramid.push([0.3, 0.4, 1.0]);
        let wedge = [0.0, 1.0]
            .map(|z| [[0.0, 0.0, z], [0.0, 1.0, z], [1.0, 0.0, z]])
            .concat();
        let cases = [(ten(), 0.5 * third), (pyramid, third), (wedge, 0.5)];
        for (points, expected) in cases {
            let cell: Vec<usize> = (0..points.len()).collect();
            let found = volume(&points, &cell);
            assert!((found - expected).abs() < 1e-12, "{}", points.len());
            let inside = |x| {
                let part = |part: [usize; 4]| is_inside(&part.map(|i| points[i]), x);
                tetrahedra(&cell).into_iter().any(part)
            };
            assert!(inside([0.2, 0.25, 0.3]) && !inside([0.9, 0.9, 0.3]));
            let sides = boundary(&[cell]);
            assert_eq!(sides.iter().flatten().max(), Some(&(points.len() - 1)));
            let within = |side: &Vec<usize>| -> f64 {
                let fan = side[1..].windows(2);
                let cones = fan.map(|edge| {
                    let [a, b, c] = [side[0], edge[0], edge[1]].map(|i| points[i]);
                    dot(a, cross(b, c)) / 6.0
                });
                cones.sum()
            };
            let found: f64 = sides.iter().map(within).sum();
            assert!((found - expected).abs() < 1e-12, "sides look outward");
        }
    }

    #[test]
    fn sides_between_elements_are_none() {
        let cells: Vec<Vec<usize>> = TETRAHEDRA.iter().map(|cell| cell.to_vec()).collect();
        assert_eq!(boundary(&cells).len(), 12);
    }
}
