//! Pressure decided at the points of a segment.
//!
//! A kept node `k` has the pressure `p_k` and a bedding `r_k` on its support `phi_k`:
//!
//! ```text
//! P_k = max(0, p_k - r_k g)      P = sum_k phi_k P_k >= 0      g = sum_d a_d N_d
//! F_c = int N_c P dA             G_k = int phi_k min(g, p_k/r_k) dA
//! ```
//!
//! `a_d` is the height of corner `d`, negative on side `a`. Where all nodes are closed, or all
//! open, at all vertices, the rule of the segment serves. Else its triangles are divided by four
//! while their vertices differ, at most [`DIVISIONS`] times, and the last of them have a rule
//! with points at the vertices: area that is closed touches a vertex, so none is missed.
//! Polynomials up to degree five are exact either way, so that nothing jumps as a vertex closes.
//! Derivatives are those of the sums.

use pulp::{Simd, WithSimd};

use super::{
    Polygon, Slopes,
    chain::CornerSlopes,
    closed::Closed,
    fan::{Apex, Fan, fan},
    plane_facet::{PlaneFacet, Vec2},
    rule,
    sums::add,
};

/// How often a triangle is divided by four whose vertices are not all closed or all open.
pub(super) const DIVISIONS: usize = 2;

/// Supports whose rows are integrated at once, beside the forces on the eight corners.
const AT_ONCE: usize = 8;
/// Integrals at once.
pub(super) const M: usize = 8 + AT_ONCE;

/// The support of a kept node on a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// `phi_k` at the eight corners.
    pub shares: [f64; 8],
    /// `p_k`.
    pub pressure: f64,
    /// `r_k`; zero where nothing yields, and nothing is pressed.
    pub bedding: f64,
    /// `r_k` of an open support, which says what is open for the next increment.
    pub full: f64,
}

/// What pressure is decided by, beside a segment.
#[derive(Clone, Debug)]
pub struct Pressing {
    /// Supports of the kept nodes.
    supports: Vec<Support>,
    /// Gaps below which they are closed.
    limits: Vec<f64>,
    /// Gaps below which they count as closed for the next increment.
    full_limits: Vec<f64>,
    /// `a_d`.
    heights: [f64; 8],
}

/// Integrals of pressure over a segment.
#[derive(Clone, Debug, Default)]
pub struct Pressed {
    /// `F_c`.
    pub force: [f64; 8],
    /// `G_k`.
    pub rows: Vec<f64>,
    /// `int phi_k` over the points that are closed at the full bedding.
    pub closed: Vec<f64>,
    /// Whether any point is closed, by support.
    pub touches: Vec<bool>,
    /// Area under pressure.
    pub area: f64,
    /// Derivatives, if the segment has any.
    pub slopes: Option<Box<PressedSlopes>>,
}

/// Derivatives of the integrals of pressure.
#[derive(Clone, Debug, Default)]
pub struct PressedSlopes {
    /// `dF_c/dx`, column `3 k + i` for `x_k . e_i`.
    pub force: [[f64; 24]; 8],
    /// `dG_k/dx`.
    pub rows: Vec<[f64; 24]>,
    /// `dF_c/dp_k`.
    pub force_by_pressure: Vec<[f64; 8]>,
    /// `dG_k/dp_k`.
    pub rows_by_pressure: Vec<f64>,
}

impl Pressing {
    /// Of supports at heights `a_d` of the corners; points with a gap below `touching` count as
    /// closed that nothing presses yet.
    pub fn new(supports: Vec<Support>, heights: [f64; 8], touching: f64) -> Self {
        let limit = |support: &Support| match support.bedding > 0.0 {
            true => support.pressure / support.bedding + touching,
            false => f64::NEG_INFINITY,
        };
        let full = |support: &Support| match support.full > 0.0 {
            true => support.pressure / support.full + touching,
            false => f64::NEG_INFINITY,
        };
        Self {
            full_limits: supports.iter().map(full).collect(),
            limits: supports.iter().map(limit).collect(),
            supports,
            heights,
        }
    }

    #[inline(always)]
    pub(super) fn gap(&self, shares: &[f64; 8]) -> f64 {
        dot(&self.heights, shares)
    }

    /// The supports with the gaps below which they are closed.
    #[inline(always)]
    pub(super) fn supports(&self) -> impl Iterator<Item = (&Support, f64)> {
        self.supports.iter().zip(self.limits.iter().copied())
    }

    pub(super) fn count(&self) -> usize {
        self.supports.len()
    }

    /// How many supports are closed at a point with these interpolation functions: which, as
    /// those with the largest limits are.
    pub(super) fn state(&self, shares: &[f64; 8]) -> usize {
        let gap = self.gap(shares);
        self.limits.iter().filter(|limit| gap < **limit).count()
    }

    /// Whether nothing presses, and no point with these functions is closed.
    pub(super) fn is_idle(&self, mut points: impl Iterator<Item = [f64; 8]>) -> bool {
        let unpressed = |support: &Support| support.pressure == 0.0;
        self.supports.iter().all(unpressed) && points.all(|shares| self.state(&shares) == 0)
    }

    /// `sum_k v_k share_kd`, of a value of every support.
    pub(super) fn at_corners(&self, value: impl Fn(&Support) -> f64) -> [f64; 8] {
        let mut sum = [0.0; 8];
        for support in &self.supports {
            add(&mut sum, value(support), &support.shares);
        }
        sum
    }

    /// Heights of the corners.
    pub(super) fn heights(&self) -> &[f64; 8] {
        &self.heights
    }

    /// Adds the weight of a point to the supports that are closed at it with the full bedding.
    pub(super) fn add_closed(&self, sums: &mut [f64], n: &[f64; 8], weight: f64) {
        let gap = self.gap(n);
        let supports = self.supports.iter().zip(&self.full_limits);
        for ((support, limit), sum) in supports.zip(sums) {
            if gap < *limit {
                *sum += weight * dot(&support.shares, n);
            }
        }
    }

    /// The smallest gap at which a support is open with the full bedding.
    pub(super) fn least_full_limit(&self) -> f64 {
        self.full_limits
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min)
    }

    /// The smallest gap at which a support is open.
    pub(super) fn least_limit(&self) -> f64 {
        self.limits.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// `int phi_k` over the segment.
    pub(super) fn weights(&self, mass: &[[f64; 8]; 8]) -> Vec<f64> {
        let weight = |support: &Support| -> f64 {
            let own = mass.iter().map(|row| dot(row, &support.shares));
            // The functions of each side sum up to one.
            own.sum::<f64>() / sides(mass)
        };
        self.supports.iter().map(weight).collect()
    }

    /// The integrals where nothing presses and nothing is closed: `G_k = 0`.
    pub(super) fn idle(&self, mass: &[[f64; 8]; 8], slopes: Option<&Slopes>) -> Pressed {
        let open = self.weights(mass).into_iter();
        let count = self.supports.len();
        Pressed {
            rows: vec![0.0; count],
            slopes: slopes.map(|_| {
                Box::new(PressedSlopes {
                    rows: vec![[0.0; 24]; count],
                    force_by_pressure: vec![[0.0; 8]; count],
                    rows_by_pressure: open
                        .zip(&self.supports)
                        .map(|(open, support)| over_bedding(open, support))
                        .collect(),
                    ..PressedSlopes::default()
                })
            }),
            closed: vec![0.0; count],
            touches: vec![false; count],
            ..Pressed::default()
        }
    }
}

/// How many sides have functions.
fn sides(mass: &[[f64; 8]; 8]) -> f64 {
    let has = |first: usize| (first..first + 4).any(|c| mass[c][c] != 0.0);
    f64::from(u8::from(has(0)) + u8::from(has(4)))
}

/// `value/r_k`, nothing where there is no bedding.
#[inline(always)]
pub(super) fn over_bedding(value: f64, support: &Support) -> f64 {
    match support.bedding > 0.0 {
        true => value / support.bedding,
        false => 0.0,
    }
}

#[inline(always)]
pub(super) fn dot(a: &[f64; 8], b: &[f64; 8]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Values at a point that integrands are made of.
pub(super) struct Point {
    /// `P`.
    pub pressure: f64,
    /// `sum phi_k r_k` over the closed nodes.
    pub stiffness: f64,
    /// `sum_k share_kd P_k`, of which the gradient of `P` at constant gap is made.
    pub by_shares: [f64; 8],
}

impl Point {
    /// Adds the supports at a point, with the weight of the point, to sums by support.
    #[inline(always)]
    pub(super) fn new(pressing: &Pressing, n: &[f64; 8], gap: f64) -> Self {
        let mut point = Self {
            pressure: 0.0,
            stiffness: 0.0,
            by_shares: [0.0; 8],
        };
        for (support, limit) in pressing.supports() {
            if gap < limit {
                let phi = dot(&support.shares, n);
                let own = support.pressure - support.bedding * gap;
                point.pressure += phi * own;
                point.stiffness += phi * support.bedding;
                add(&mut point.by_shares, own, &support.shares);
            }
        }
        point
    }
}

/// What a support has at a point.
pub(super) struct OfSupport {
    /// `phi_k`.
    pub phi: f64,
    /// `min(g, p_k/r_k)`.
    pub held: f64,
    /// One where it is closed, else zero.
    pub closed: f64,
}

impl OfSupport {
    #[inline(always)]
    pub(super) fn new((support, limit): (&Support, f64), n: &[f64; 8], gap: f64) -> Self {
        let closed = gap < limit;
        Self {
            phi: dot(&support.shares, n),
            held: match closed {
                true => gap,
                false => over_bedding(support.pressure, support),
            },
            closed: f64::from(u8::from(closed)),
        }
    }
}

impl Polygon {
    /// Integrals of pressure, with derivatives if those of the segment are known.
    pub(super) fn pressed(
        &self,
        pressing: &Pressing,
        mass: &[[f64; 8]; 8],
        slopes: Option<&Slopes>,
    ) -> Pressed {
        let facets = &self.pair.facets;
        let at = |place: &Vec2| shares(facets, place);
        let vertices = || self.vertices.iter().map(|vertex| at(&vertex.place));
        if pressing.is_idle(vertices()) {
            return pressing.idle(mass, slopes);
        }
        let mut states = vertices().map(|n| pressing.state(&n));
        let first = states.next();
        let pure = states.all(|state| Some(state) == first);
        let (rule, apex) = self.pair.rule_of_pressure();
        if pure && first == Some(pressing.count()) {
            let fan = fan(&self.vertices, apex);
            let closed = Closed::new(self, pressing, &fan, rule);
            if closed.holds() {
                return closed.pressed(mass, slopes);
            }
        }
        let fan = fan(&self.vertices, Apex::Centre);
        let points: Vec<Vec<rule::Point>> = fan
            .triangles
            .iter()
            .map(|indices| {
                let corners = indices.map(|at| fan.places[at]);
                divided(&corners, rule, &|place| pressing.state(&at(place)))
            })
            .collect();
        let mut pressed = Pressed {
            rows: vec![0.0; pressing.count()],
            closed: vec![0.0; pressing.count()],
            touches: vec![false; pressing.count()],
            slopes: slopes.map(|_| Box::new(PressedSlopes::default())),
            ..Pressed::default()
        };
        for first in (0..pressing.count().max(1)).step_by(AT_ONCE) {
            let count = AT_ONCE.min(pressing.count() - first);
            let mut sums = Sums::zero(fan.places.len());
            pulp::Arch::new().dispatch(Integrate {
                facets,
                fan: &fan,
                points: &points,
                pressing,
                first,
                count,
                with_slopes: slopes.is_some(),
                sums: &mut sums,
            });
            pressed.take(&sums, first, count);
            if let (Some(known), Some(found)) = (slopes, &mut pressed.slopes) {
                let rows = self.in_space(sums.moved, &fan, known);
                found.force.copy_from_slice(&rows[..8]);
                found.rows.extend_from_slice(&rows[8..8 + count]);
                let by_pressure = &sums.by_pressure[..count];
                found.force_by_pressure.extend_from_slice(by_pressure);
                let supports = &pressing.supports[first..first + count];
                let open = sums.open[..count].iter().zip(supports);
                let by_pressure = open.map(|(open, support)| over_bedding(*open, support));
                found.rows_by_pressure.extend(by_pressure);
            }
        }
        pressed
    }

    /// Derivatives by the corners in space.
    pub(super) fn in_space(&self, moved: Moved, fan: &Fan, known: &Slopes) -> [[f64; 24]; M] {
        let (pair, polygon) = (&self.pair, &self.vertices);
        let Moved {
            corners,
            heights,
            vertices,
        } = moved;
        let own = CornerSlopes::new(corners, vertices, polygon, fan, &pair.places);
        let by_height = Some(&*heights);
        own.in_space(&pair.plane, &pair.corners, &known.normal, by_height)
    }
}

/// Interpolation functions of both facets at a place.
pub(super) fn shares(facets: &[PlaneFacet; 2], place: &Vec2) -> [f64; 8] {
    let [a, b] = [facets[0].at(place).value, facets[1].at(place).value];
    std::array::from_fn(|c| if c < 4 { a[c] } else { b[c - 4] })
}

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

/// Derivatives of `M` integrals in the plane of a pair.
pub(super) struct Moved {
    /// By the two coordinates of each corner, while the polygon rests.
    corners: Box<[[[f64; M]; 2]; 8]>,
    /// By the height of each corner.
    heights: Box<[[f64; M]; 8]>,
    /// By the two coordinates of each vertex and of the centre.
    vertices: Vec<[[f64; M]; 2]>,
}

/// What an integrand depends on at a point.
pub(super) struct Integrand {
    /// Its value.
    pub value: [f64; M],
    /// Derivative by the gap.
    pub by_gap: [f64; M],
    /// Gradient along an axis by the place on either side, at a constant gap.
    pub gradient: [[[f64; M]; 2]; 2],
    /// Gradient of the gap in the same order.
    pub of_gap: [[f64; 2]; 2],
}

/// A triangle of a fan under way: weights of its vertices.
pub(super) struct OnTriangle {
    own: [f64; M],
    by_vertex: [[[f64; M]; 2]; 3],
}

impl Moved {
    pub(super) fn zero(vertices: usize) -> Self {
        Self {
            corners: Box::new([[[0.0; M]; 2]; 8]),
            heights: Box::new([[0.0; M]; 8]),
            vertices: vec![[[0.0; M]; 2]; vertices],
        }
    }

    /// Adds a point with the functions `n` of the corners, `shares` of the vertices of its
    /// triangle and the weight `whole` of its area.
    #[inline(always)]
    pub(super) fn add_point(
        &mut self,
        on: &mut OnTriangle,
        integrand: &Integrand,
        n: &[f64; 8],
        (shares, whole): (&[f64; 3], f64),
    ) {
        for c in 0..8 {
            let sign = if c < 4 { -1.0 } else { 1.0 };
            add(&mut self.heights[c], whole * sign * n[c], &integrand.by_gap);
        }
        for axis in 0..2 {
            let mut total = [0.0; M];
            for side in 0..2 {
                let mut gradient = integrand.gradient[side][axis];
                let of_gap = integrand.of_gap[side][axis];
                add(&mut gradient, of_gap, &integrand.by_gap);
                for c in 4 * side..4 * side + 4 {
                    add(&mut self.corners[c][axis], -whole * n[c], &gradient);
                }
                add(&mut total, 1.0, &gradient);
            }
            for k in 0..3 {
                add(&mut on.by_vertex[k][axis], whole * shares[k], &total);
            }
        }
    }

    /// Adds what the vertices `v` of a triangle with these indices move.
    #[inline(always)]
    pub(super) fn add_triangle(&mut self, on: &OnTriangle, v: &[Vec2; 3], indices: &[usize; 3]) {
        for k in 0..3 {
            let opposite = (v[(k + 2) % 3] - v[(k + 1) % 3]) * 0.5;
            let by_area = [-opposite.y, opposite.x];
            let target = &mut self.vertices[indices[k]];
            for axis in 0..2 {
                add(&mut target[axis], 1.0, &on.by_vertex[k][axis]);
                add(&mut target[axis], by_area[axis], &on.own);
            }
        }
    }
}

impl Integrand {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self {
            value: [0.0; M],
            by_gap: [0.0; M],
            gradient: [[[0.0; M]; 2]; 2],
            of_gap: [[0.0; 2]; 2],
        }
    }
}

impl OnTriangle {
    /// Sum of the integrands over the area of the triangle.
    #[inline(always)]
    pub(super) fn own(&self) -> &[f64; M] {
        &self.own
    }

    #[inline(always)]
    pub(super) fn add_value(&mut self, weight: f64, integrand: &Integrand) {
        add(&mut self.own, weight, &integrand.value);
    }

    pub(super) fn new() -> Self {
        Self {
            own: [0.0; M],
            by_vertex: [[[0.0; M]; 2]; 3],
        }
    }
}

/// Sums over the points of a polygon.
struct Sums {
    value: [f64; M],
    moved: Moved,
    /// `dF_c/dp_k`.
    by_pressure: [[f64; 8]; AT_ONCE],
    open: [f64; AT_ONCE],
    closed: [f64; AT_ONCE],
    touches: [bool; AT_ONCE],
    area: f64,
}

impl Sums {
    fn zero(vertices: usize) -> Self {
        Self {
            value: [0.0; M],
            moved: Moved::zero(vertices),
            by_pressure: [[0.0; 8]; AT_ONCE],
            open: [0.0; AT_ONCE],
            closed: [0.0; AT_ONCE],
            touches: [false; AT_ONCE],
            area: 0.0,
        }
    }
}

impl Pressed {
    fn take(&mut self, sums: &Sums, first: usize, count: usize) {
        self.force.copy_from_slice(&sums.value[..8]);
        self.area = sums.area;
        self.rows[first..first + count].copy_from_slice(&sums.value[8..8 + count]);
        self.closed[first..first + count].copy_from_slice(&sums.closed[..count]);
        self.touches[first..first + count].copy_from_slice(&sums.touches[..count]);
    }
}

/// Integrates forces and the rows of some supports over a polygon.
struct Integrate<'a> {
    facets: &'a [PlaneFacet; 2],
    fan: &'a Fan,
    points: &'a [Vec<rule::Point>],
    pressing: &'a Pressing,
    first: usize,
    count: usize,
    with_slopes: bool,
    sums: &'a mut Sums,
}

impl WithSimd for Integrate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        for (indices, points) in self.fan.triangles.iter().zip(self.points) {
            self.add_triangle(indices, points);
        }
    }
}

impl Integrate<'_> {
    #[inline(always)]
    fn add_triangle(&mut self, indices: &[usize; 3], points: &[rule::Point]) {
        let v = indices.map(|at| self.fan.places[at]);
        let area = 0.5 * (v[1] - v[0]).perp(&(v[2] - v[0]));
        let mut on = OnTriangle::new();
        for (shares, weight) in points {
            let place = v[0] * shares[0] + v[1] * shares[1] + v[2] * shares[2];
            self.add_point(&place, (shares, *weight, area), &mut on);
        }
        add(&mut self.sums.value, area, &on.own);
        if self.with_slopes {
            self.sums.moved.add_triangle(&on, &v, indices);
        }
    }

    #[inline(always)]
    fn add_point(
        &mut self,
        place: &Vec2,
        (shares, weight, area): (&[f64; 3], f64, f64),
        on: &mut OnTriangle,
    ) {
        let of = [self.facets[0].at(place), self.facets[1].at(place)];
        let n: [f64; 8] = std::array::from_fn(|c| of[c / 4].value[c % 4]);
        let gap = self.pressing.gap(&n);
        let point = Point::new(self.pressing, &n, gap);
        let supports = || {
            let supports = self.pressing.supports();
            supports.skip(self.first).take(self.count).enumerate()
        };
        let whole = weight * area;
        let mut integrand = Integrand::zero();
        for c in 0..8 {
            integrand.value[c] = n[c] * point.pressure;
            integrand.by_gap[c] = -n[c] * point.stiffness;
        }
        for (k, support) in supports() {
            let at = OfSupport::new(support, &n, gap);
            integrand.value[8 + k] = at.phi * at.held;
            integrand.by_gap[8 + k] = at.phi * at.closed;
            self.sums.open[k] += whole * at.phi * (1.0 - at.closed);
            self.sums.touches[k] |= at.closed > 0.0;
            if gap < self.pressing.full_limits[self.first + k] {
                self.sums.closed[k] += whole * at.phi;
            }
            let of_closed = whole * at.phi * at.closed;
            add(&mut self.sums.by_pressure[k], of_closed, &n);
        }
        on.add_value(weight, &integrand);
        if point.pressure > 0.0 {
            self.sums.area += whole;
        }
        if !self.with_slopes {
            return;
        }
        for side in 0..2 {
            for axis in 0..2 {
                let slope = &of[side].gradient[axis];
                let along = |values: &[f64; 8]| -> f64 {
                    (0..4).map(|c| values[4 * side + c] * slope[c]).sum()
                };
                integrand.of_gap[side][axis] = along(&self.pressing.heights);
                let of_pressure = along(&point.by_shares);
                let gradient = &mut integrand.gradient[side][axis];
                for c in 0..8 {
                    gradient[c] = n[c] * of_pressure;
                }
                for c in 0..4 {
                    gradient[4 * side + c] += slope[c] * point.pressure;
                }
                for (k, support) in supports() {
                    // `G_k` at a constant gap is `phi_k` times what is held.
                    let held = OfSupport::new(support, &n, gap).held;
                    gradient[8 + k] = along(&support.0.shares) * held;
                }
            }
        }
        let weights = (shares, whole);
        self.sums.moved.add_point(on, &integrand, &n, weights);
    }
}
