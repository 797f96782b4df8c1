//! Convex rigid solids about their middle.

use crate::scenes::vector::{Vector, cross, dot};

/// A convex solid about its middle.
pub struct Solid {
    /// Corners.
    pub corners: Vec<Vector>,
    /// Facets, outward by the right-hand rule.
    pub facets: Vec<[usize; 4]>,
    /// From its middle down to the base.
    pub below: f64,
    /// Its volume over the area on which it lies.
    pub high: f64,
}

/// A box.
pub fn cuboid(size: Vector) -> Solid {
    let corners = (0..8).map(|i| {
        let sign = |bit: usize| if i & bit > 0 { 0.5 } else { -0.5 };
        [size[0] * sign(1), size[1] * sign(2), size[2] * sign(4)]
    });
    Solid {
        corners: corners.collect(),
        facets: vec![
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ],
        below: 0.5 * size[2],
        high: size[2],
    }
}

/// A prism of many sides about the axis `y`, on one of them.
pub fn roller(radius: f64, long: f64, sides: usize) -> Solid {
    let at = |i: usize, y: f64| {
        let (sine, cosine) = ((i as f64 + 0.5) * std::f64::consts::TAU / sides as f64).sin_cos();
        [radius * sine, y, -radius * cosine]
    };
    let mut corners: Vec<Vector> = (0..sides).map(|i| at(i, -0.5 * long)).collect();
    corners.extend((0..sides).map(|i| at(i, 0.5 * long)));
    corners.extend([[0.0, -0.5 * long, 0.0], [0.0, 0.5 * long, 0.0]]);
    let mut facets = Vec::new();
    for i in 0..sides {
        let next = (i + 1) % sides;
        facets.push([i, i + sides, next + sides, next]);
        facets.push([2 * sides, i, next, next]);
        facets.push([2 * sides + 1, next + sides, i + sides, i + sides]);
    }
    let below = radius * (std::f64::consts::PI / sides as f64).cos();
    Solid {
        corners,
        facets,
        below,
        high: radius,
    }
}

/// Volume of a solid about the origin.
pub fn volume(solid: &Solid) -> f64 {
    let of = |facet: &[usize; 4]| {
        let [a, b, c, d] = facet.map(|i| solid.corners[i]);
        (dot(cross(a, b), c) + dot(cross(a, c), d)) / 6.0
    };
    solid.facets.iter().map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::vector::minus;

    #[test]
    fn facets_of_solids_look_outwards() {
        for solid in [cuboid([1.0, 2.0, 3.0]), roller(1.0, 2.0, 12)] {
            for [a, b, c, _] in &solid.facets {
                let [a, b, c] = [a, b, c].map(|&i| solid.corners[i]);
                assert!(dot(cross(minus(b, a), minus(c, a)), a) > 0.0);
            }
        }
        assert!((volume(&cuboid([1.0, 2.0, 3.0])) - 6.0).abs() < 1e-12);
        // A prism of twelve sides has an area of 3.
        assert!((volume(&roller(1.0, 2.0, 12)) - 6.0).abs() < 1e-12);
    }
}
