//! Triangles divided where contact begins.
//!
//! A triangle whose vertices are all in one state has the rule of its segment. Another one is
//! divided by four, at most [`DIVISIONS`] times, and the smallest parts have a rule with points at
//! their vertices.

use super::{plane_facet::Vec2, rule};

/// Number of times that a triangle with both closed and open vertices is divided into four.
pub(super) const DIVISIONS: usize = 2;

/// The points of a triangle: those of `rule` on it, or on the parts of it whose vertices are in
/// one state, and of a rule with vertices on the smallest parts that are not.
pub(super) fn divided(
    corners: &[Vec2; 3],
    rule: &[rule::Point],
    state: &impl Fn(&Vec2) -> usize,
) -> Vec<rule::Point> {
    let mut points = Vec::new();
    let whole = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let states = corners.each_ref().map(state);
    let part = Part {
        vertices: whole,
        states,
        weight: 1.0,
    };
    part.points(corners, rule, state, DIVISIONS, &mut points);
    points
}

/// A part of a triangle.
struct Part {
    /// Barycentric coordinates of its vertices.
    vertices: [[f64; 3]; 3],
    /// State at them.
    states: [usize; 3],
    /// Its area over that of the triangle.
    weight: f64,
}

impl Part {
    fn points(
        &self,
        corners: &[Vec2; 3],
        rule: &[rule::Point],
        state: &impl Fn(&Vec2) -> usize,
        divisions: usize,
        points: &mut Vec<rule::Point>,
    ) {
        let [first, second, third] = self.states;
        let pure = first == second && second == third;
        if !pure && divisions > 0 {
            for part in self.divided(corners, state) {
                part.points(corners, rule, state, divisions - 1, points);
            }
            return;
        }
        let rule = if pure { rule } else { &rule::VERTEX_5 };
        points.extend(rule.iter().map(|(shares, weight)| {
            let place = |at: usize| (0..3).map(|v| shares[v] * self.vertices[v][at]).sum();
            ([place(0), place(1), place(2)], weight * self.weight)
        }));
    }

    fn divided(&self, corners: &[Vec2; 3], state: &impl Fn(&Vec2) -> usize) -> [Self; 4] {
        let v = &self.vertices;
        let middle = |i: usize, j: usize| std::array::from_fn(|at| 0.5 * (v[i][at] + v[j][at]));
        let middles: [[f64; 3]; 3] = [middle(1, 2), middle(2, 0), middle(0, 1)];
        let states = middles.map(|shares| {
            let place = corners[0] * shares[0] + corners[1] * shares[1] + corners[2] * shares[2];
            state(&place)
        });
        let part = |vertices, states| Self {
            vertices,
            states,
            weight: 0.25 * self.weight,
        };
        let [m0, m1, m2] = middles;
        let [s0, s1, s2] = states;
        let [t0, t1, t2] = self.states;
        [
            part([v[0], m2, m1], [t0, s2, s1]),
            part([m2, v[1], m0], [s2, t1, s0]),
            part([m1, m0, v[2]], [s1, s0, t2]),
            part(middles, states),
        ]
    }
}
