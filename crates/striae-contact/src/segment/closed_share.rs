//! Closed share of supports, which decides the beddings of the next increment.
//!
//! ```text
//! int phi_k dA   where g < p_k l_k/C_OPEN
//! ```
//!
//! that is, where a support is closed at the bedding of an open one. Triangles are cut where a gap
//! that is linear between their vertices passes the limit: a sum over the points of a rule would
//! jump by the weight of a point whenever one closes, and with it all that the next increment
//! leads to. On parallelograms and triangles it is exact, on others it has no jumps either.

use super::{
    plane_facet::Vec2,
    rule,
    support::{Pressing, Support, dot},
};

/// Interpolation functions at a place, and the area there over that of the place.
pub(super) type At = ([f64; 8], f64);

/// A vertex of a part of a triangle with the gap there.
type Vertex = (Vec2, f64);

/// Integral of every support, whose weights are `whole`, over triangles.
pub(super) fn closed(
    pressing: &Pressing,
    whole: Vec<f64>,
    triangles: impl Iterator<Item = [Vec2; 3]>,
    rule: &[rule::Point],
    at: &impl Fn(&Vec2) -> At,
) -> Vec<f64> {
    let vertex = |place: Vec2| (place, pressing.gap(&at(&place).0));
    let triangles: Vec<[Vertex; 3]> = triangles.map(|places| places.map(vertex)).collect();
    let gaps = || triangles.iter().flatten().map(|(_, gap)| *gap);
    let least = gaps().fold(f64::INFINITY, f64::min);
    let largest = gaps().fold(f64::NEG_INFINITY, f64::max);
    let of_support = |support: &Support, limit: f64, whole: f64| {
        if largest < limit {
            return whole;
        }
        let of_point = |place: &Vec2| {
            let (n, area) = at(place);
            area * dot(&support.shares, &n)
        };
        let of_triangle = |triangle| over_polygon(&below(triangle, limit), rule, &of_point);
        match least < limit {
            true => triangles.iter().map(of_triangle).sum(),
            false => 0.0,
        }
    };
    let supports = pressing.supports().zip(pressing.full_limits());
    let supports = supports.zip(whole);
    supports
        .map(|(((support, _), limit), whole)| of_support(support, *limit, whole))
        .collect()
}

/// Part of a triangle with gaps up to a limit.
fn below(triangle: &[Vertex; 3], limit: f64) -> Vec<Vec2> {
    let mut places = Vec::with_capacity(4);
    for (at, (from, gap)) in triangle.iter().enumerate() {
        let (to, next) = &triangle[(at + 1) % 3];
        let [start, end] = [limit - gap, limit - next];
        if start >= 0.0 {
            places.push(*from);
        }
        if start * end < 0.0 {
            places.push(from + (to - from) * (start / (start - end)));
        }
    }
    places
}

/// Integral over a triangle or a quadrilateral, this one in triangles about the mean of its
/// vertices, so that it does not matter where they begin.
fn over_polygon(places: &[Vec2], rule: &[rule::Point], of_point: &impl Fn(&Vec2) -> f64) -> f64 {
    let over = |v: [Vec2; 3]| {
        let area = 0.5 * (v[1] - v[0]).perp(&(v[2] - v[0]));
        let values = rule.iter().map(|(shares, weight)| {
            let place = v[0] * shares[0] + v[1] * shares[1] + v[2] * shares[2];
            weight * of_point(&place)
        });
        area * values.sum::<f64>()
    };
    match *places {
        [a, b, c] => over([a, b, c]),
        [a, b, c, d] => {
            let centre = (a + b + c + d) * 0.25;
            let edges = [[a, b], [b, c], [c, d], [d, a]];
            edges
                .map(|[from, to]| over([from, to, centre]))
                .iter()
                .sum()
        }
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A support of the first corner of the unit square, in triangles about its centre.
    fn share(heights: [f64; 4], pressure: f64) -> f64 {
        let support = Support {
            shares: std::array::from_fn(|c| f64::from(u8::from(c == 0))),
            pressure,
            bedding: 1.0,
            full: 2.0,
        };
        let heights = std::array::from_fn(|c| heights.get(c).copied().unwrap_or(0.0));
        let pressing = Pressing::new(vec![support], heights, [0.0, 0.0]);
        let at = |place: &Vec2| {
            let [x, y] = [place.x, place.y];
            let n = [(1.0 - x) * (1.0 - y), x * (1.0 - y), x * y, (1.0 - x) * y];
            (
                std::array::from_fn(|c| n.get(c).copied().unwrap_or(0.0)),
                1.0,
            )
        };
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from);
        let centre = Vec2::new(0.5, 0.5);
        let triangles = (0..4).map(|c| [corners[c], corners[(c + 1) % 4], centre]);
        closed(&pressing, vec![0.25], triangles, &rule::DEGREE_6, &at)[0]
    }

    #[test]
    fn share_of_a_tilted_gap_is_exact() {
        // g = x, closed where x < p/2: (s - s^2/2)/2.
        for s in [0.1, 0.3, 0.5, 0.8] {
            let found = share([0.0, 1.0, 1.0, 0.0], 2.0 * s);
            assert!((found - 0.5 * (s - 0.5 * s * s)).abs() < 1e-15);
        }
        assert_eq!(share([0.0, 1.0, 1.0, 0.0], 2.1), 0.25);
        assert_eq!(share([0.1, 1.0, 1.0, 0.1], 0.2), 0.0);
    }

    #[test]
    fn share_has_no_jumps() {
        let steps = 2000;
        let at = |step: usize| share([0.0, 0.7, 1.3, 0.4], 3.0 * step as f64 / steps as f64);
        for step in 0..steps {
            let moved = at(step + 1) - at(step);
            assert!(
                (0.0..2.0 / steps as f64).contains(&moved),
                "{step}: {moved}"
            );
        }
    }
}
