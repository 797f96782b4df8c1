//! Points in deformed elements, and how deep.
//!
//! A point is in a hexahedron if Newton's method finds it at local coordinates in
//! `[-1, 1]^3` of the trilinear map; other elements are taken for [`pieces`], tetrahedra. Its depth is its distance to the nearest facet of
//! the surface, facets being four triangles about their middle.

use super::{
    pieces,
    vector::{
        Matrix, Vector, applied, cross, dot, length, mean, minus, plus, solved, times, transposed,
    },
};

/// Local coordinates of the corners of a hexahedron, in the order of VTK.
const CORNERS: [Vector; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    low: Vector,
    high: Vector,
}

impl Extent {
    /// The smallest box around points.
    pub fn of(points: &[Vector]) -> Self {
        let mut extent = Self {
            low: [f64::INFINITY; 3],
            high: [f64::NEG_INFINITY; 3],
        };
        for point in points {
            for axis in 0..3 {
                extent.low[axis] = extent.low[axis].min(point[axis]);
                extent.high[axis] = extent.high[axis].max(point[axis]);
            }
        }
        extent
    }

    /// Lowest corner.
    pub fn low(&self) -> Vector {
        self.low
    }

    /// Highest corner.
    pub fn high(&self) -> Vector {
        self.high
    }

    /// Returns true if two boxes have a common point.
    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }
    /// Returns whether a point is inside.
    pub fn holds(&self, point: Vector) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&point[axis]))
    }

    /// Distance of a point from the box.
    pub fn distance(&self, point: Vector) -> f64 {
        let beyond = [0, 1, 2].map(|axis| {
            let below = self.low[axis] - point[axis];
            below.max(point[axis] - self.high[axis]).max(0.0)
        });
        length(beyond)
    }
}

/// Returns whether a point is inside a hexahedron.
pub fn is_inside(corners: &[Vector; 8], point: Vector) -> bool {
    const OUTSIDE: f64 = 4.0;
    let mut xi = [0.0; 3];
    for _ in 0..30 {
        let (position, jacobian) = mapped(corners, xi);
        let Some(step) = solved(&jacobian, minus(point, position)) else {
            return false;
        };
        xi = plus(xi, step).map(|x| x.clamp(-OUTSIDE, OUTSIDE));
        if length(step) < 1e-10 {
            return xi.iter().all(|x| x.abs() <= 1.0);
        }
    }
    false
}

/// Position at local coordinates, and its derivative by them.
fn mapped(corners: &[Vector; 8], xi: Vector) -> (Vector, Matrix) {
    let mut position = [0.0; 3];
    let mut columns = [[0.0; 3]; 3];
    for (corner, local) in corners.iter().zip(CORNERS) {
        let factors = [0, 1, 2].map(|i| 1.0 + local[i] * xi[i]);
        let weight = factors[0] * factors[1] * factors[2] / 8.0;
        position = plus(position, times(weight, *corner));
        for i in 0..3 {
            let others = factors[(i + 1) % 3] * factors[(i + 2) % 3];
            columns[i] = plus(columns[i], times(local[i] * others / 8.0, *corner));
        }
    }
    (position, transposed(&columns))
}

/// Distance of a point from a triangle.
pub fn distance_from_triangle(point: Vector, [a, b, c]: [Vector; 3]) -> f64 {
    let (ab, ac) = (minus(b, a), minus(c, a));
    let normal = cross(ab, ac);
    let square = dot(normal, normal);
    let p = minus(point, a);
    if square > 0.0 {
        let v = dot(cross(p, ac), normal) / square;
        let w = dot(cross(ab, p), normal) / square;
        if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
            return dot(p, normal).abs() / square.sqrt();
        }
    }
    [[a, b], [b, c], [c, a]]
        .map(|edge| distance_from_edge(point, edge))
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

fn distance_from_edge(point: Vector, [a, b]: [Vector; 2]) -> f64 {
    let along = minus(b, a);
    let square = dot(along, along);
    let share = if square > 0.0 {
        (dot(minus(point, a), along) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    length(minus(point, plus(a, times(share, along))))
}

/// The triangles of a facet: four about its middle, or itself.
pub fn triangles(facet: &[Vector]) -> Vec<[Vector; 3]> {
    if let [a, b, c] = *facet {
        return vec![[a, b, c]];
    }
    let middle = mean(facet);
    let next = |i: usize| facet[(i + 1) % facet.len()];
    (0..facet.len())
        .map(|i| [facet[i], next(i), middle])
        .collect()
}

/// Area of a facet.
pub fn area(facet: &[Vector]) -> f64 {
    let twice = triangles(facet)
        .into_iter()
        .map(|[a, b, c]| length(cross(minus(b, a), minus(c, a))));
    0.5 * twice.sum::<f64>()
}

/// A surface of facets to measure distances from.
pub struct Surface {
    facets: Vec<(Extent, Vec<[Vector; 3]>)>,
}

impl Surface {
    /// The surface of some facets.
    pub fn new(facets: impl IntoIterator<Item = Vec<Vector>>) -> Self {
        let facets = facets.into_iter();
        Self {
            facets: facets
                .map(|facet| (Extent::of(&facet), triangles(&facet)))
                .collect(),
        }
    }

    /// Distance of a point; infinite from nothing.
    pub fn distance(&self, point: Vector) -> f64 {
        let mut nearest = f64::INFINITY;
        for (extent, triangles) in &self.facets {
            // The middle of a facet may stand out of the box of its corners by round-off.
            if extent.distance(point) > nearest {
                continue;
            }
            for triangle in triangles {
                nearest = nearest.min(distance_from_triangle(point, *triangle));
            }
        }
        nearest
    }
}

/// A deformed body.
pub struct Solid {
    hexahedra: Vec<(Extent, [Vector; 8])>,
    tetrahedra: Vec<(Extent, [Vector; 4])>,
    extent: Extent,
    surface: Surface,
}

impl Solid {
    /// The body with these points and elements.
    pub fn new(points: &[Vector], cells: &[Vec<usize>]) -> Self {
        let hexahedra = cells.iter().filter_map(|cell| {
            let corners = <[usize; 8]>::try_from(&cell[..]).ok()?.map(|i| points[i]);
            Some((Extent::of(&corners), corners))
        });
        let tetrahedra = cells.iter().flat_map(|cell| pieces::tetrahedra(cell));
        let tetrahedra = tetrahedra.map(|cell| {
            let corners = cell.map(|i| points[i]);
            (Extent::of(&corners), corners)
        });
        let facets = pieces::boundary(cells).into_iter();
        Self {
            hexahedra: hexahedra.collect(),
            tetrahedra: tetrahedra.collect(),
            extent: Extent::of(points),
            surface: Surface::new(
                facets.map(|facet| facet.into_iter().map(|i| points[i]).collect()),
            ),
        }
    }

    /// Distance from the surface of a point inside; `None` outside.
    pub fn depth(&self, point: Vector) -> Option<f64> {
        let holds = |(extent, corners): &(Extent, [Vector; 8])| {
            extent.holds(point) && is_inside(corners, point)
        };
        let in_piece = |(extent, corners): &(Extent, [Vector; 4])| {
            extent.holds(point) && pieces::is_inside(corners, point)
        };
        let inside = || self.hexahedra.iter().any(holds) || self.tetrahedra.iter().any(in_piece);
        (self.extent.holds(point) && inside()).then(|| self.surface.distance(point))
    }
}

/// Height of a surface of triangles above a place in the plane `z = 0`, and the
/// cosine of its slope there, negative where it looks down; `None` beside it.
pub fn height(surface: &[[Vector; 3]], [x, y, _]: Vector) -> Option<(f64, f64)> {
    const SLACK: f64 = 1e-12;
    let at = |[a, b, c]: &[Vector; 3]| {
        let flat = |p: &Vector, q: &Vector| [q[0] - p[0], q[1] - p[1]];
        let (ab, ac, ap) = (flat(a, b), flat(a, c), [x - a[0], y - a[1]]);
        let cross_2 = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
        let whole = cross_2(ab, ac);
        let (v, w) = (cross_2(ap, ac) / whole, cross_2(ab, ap) / whole);
        let inside = v >= -SLACK && w >= -SLACK && v + w <= 1.0 + SLACK;
        let normal = cross(minus(*b, *a), minus(*c, *a));
        let cosine = normal[2] / length(normal);
        inside.then(|| (a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]), cosine))
    };
    surface.iter().find_map(at)
}

/// A rigid motion `x = R (X - c) + c + u`, turned back.
pub fn turned_back(rotation: &Matrix, about: Vector, displacement: Vector, x: Vector) -> Vector {
    let from = minus(minus(x, displacement), about);
    plus(about, applied(&transposed(rotation), from))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(at: f64) -> [Vector; 8] {
        CORNERS.map(|c| c.map(|x| at + 0.5 * (x + 1.0)))
    }

    #[test]
    fn points_are_found_in_distorted_hexahedra() {
        let mut corners = cube(0.0);
        corners[6] = [1.3, 1.2, 1.4];
        corners[0] = [-0.2, 0.1, 0.0];
        for xi in [[0.0; 3], [0.9, -0.9, 0.5], [-0.99, 0.99, 0.99]] {
            let (inside, _) = mapped(&corners, xi);
            assert!(is_inside(&corners, inside), "{xi:?}");
            let (outside, _) = mapped(&corners, xi.map(|x| x + 1.2));
            assert!(!is_inside(&corners, outside), "{xi:?}");
        }
    }

    #[test]
    fn the_derivative_of_the_map_is_that_of_the_position() {
        let mut corners = cube(0.0);
        corners[6] = [1.3, 1.2, 1.4];
        let xi = [0.2, -0.3, 0.4];
        let (at, jacobian) = mapped(&corners, xi);
        for i in 0..3 {
            let mut shifted = xi;
            shifted[i] += 1e-6;
            let difference = times(1e6, minus(mapped(&corners, shifted).0, at));
            let column = transposed(&jacobian)[i];
            assert!(length(minus(difference, column)) < 1e-6);
        }
    }

    #[test]
    fn depth_is_the_distance_to_the_outer_surface() {
        // Two cubes side by side: their common side is no surface.
        let mut points = cube(0.0).to_vec();
        points
            .extend(CORNERS.map(|c| [0.5 * (c[0] + 3.0), 0.5 * (c[1] + 1.0), 0.5 * (c[2] + 1.0)]));
        let shared = [1, 8, 11, 2, 5, 12, 15, 6];
        let mut second = [8, 9, 10, 11, 12, 13, 14, 15];
        for corner in [0, 3, 4, 7] {
            second[corner] = match corner {
                0 => 1,
                3 => 2,
                4 => 5,
                _ => 6,
            };
        }
        assert_eq!(points[shared[0]], points[shared[1]]);
        let cells = [(0..8).collect(), second.to_vec()];
        assert_eq!(pieces::boundary(&cells).len(), 10);
        let solid = Solid::new(&points, &cells);
        let depth = solid.depth([1.0, 0.5, 0.9]).unwrap();
        assert!((depth - 0.1).abs() < 1e-12, "{depth}");
        assert_eq!(solid.depth([1.0, 0.5, 1.1]), None);
        assert!((solid.depth([1.7, 0.5, 0.5]).unwrap() - 0.3).abs() < 1e-12);
    }

    #[test]
    fn distances_from_triangles_are_to_inside_edges_and_corners() {
        let triangle = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let cases = [
            ([0.2, 0.2, 0.5], 0.5),
            ([0.5, -2.0, 0.0], 2.0),
            ([-3.0, -4.0, 0.0], 5.0),
            ([1.0, 1.0, 0.0], 0.5f64.sqrt()),
        ];
        for (point, expected) in cases {
            let found = distance_from_triangle(point, triangle);
            assert!((found - expected).abs() < 1e-14, "{point:?}");
        }
    }

    #[test]
    fn areas_and_heights_are_those_of_planes() {
        let quad = [
            [0.0, 0.0, 1.0],
            [2.0, 0.0, 2.0],
            [2.0, 1.0, 2.0],
            [0.0, 1.0, 1.0],
        ];
        assert!((area(&quad) - 5.0f64.sqrt()).abs() < 1e-12);
        let (z, cosine) = height(&triangles(&quad), [0.5, 0.3, 9.0]).unwrap();
        assert!((z - 1.25).abs() < 1e-12);
        assert!((cosine - 2.0 / 5.0f64.sqrt()).abs() < 1e-12);
        assert_eq!(height(&triangles(&quad), [3.0, 0.3, 0.0]), None);
    }
}
