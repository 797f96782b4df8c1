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
    closed::Closed,
    closed_share,
    divided::divided,
    fan::{Apex, Fan, fan},
    moved::{AT_ONCE, Integrand, M, Moved, OnTriangle},
    plane_facet::{PlaneFacet, Vec2},
    rule,
    sums::add,
    support::{OfSupport, Point, Pressed, PressedSlopes, Pressing, over_bedding, shares},
};

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
            closed: self.closed(pressing, mass),
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
                let supports = pressing.supports().skip(first);
                let open = sums.open[..count].iter().zip(supports);
                let by_pressure = open.map(|(open, (support, _))| over_bedding(*open, support));
                found.rows_by_pressure.extend(by_pressure);
            }
        }
        pressed
    }

    /// `int phi_k` over the closed share of the supports.
    pub(super) fn closed(&self, pressing: &Pressing, mass: &[[f64; 8]; 8]) -> Vec<f64> {
        let facets = &self.pair.facets;
        // About the centre, so that it does not matter where the vertices begin.
        let fan = fan(&self.vertices, Apex::Centre);
        let indices = fan.triangles.iter();
        let triangles = indices.map(|indices| indices.map(|at| fan.places[at]));
        let at = |place: &Vec2| (shares(facets, place), 1.0);
        let (rule, _) = self.pair.rule_of_pressure();
        closed_share::closed(pressing, pressing.weights(mass), triangles, rule, &at)
    }
}

/// Sums over the points of a polygon.
struct Sums {
    value: [f64; M],
    moved: Moved,
    /// `dF_c/dp_k`.
    by_pressure: [[f64; 8]; AT_ONCE],
    open: [f64; AT_ONCE],
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
        add(&mut self.sums.value, area, on.own());
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
            let of_closed = whole * at.phi * at.closed;
            add(&mut self.sums.by_pressure[k], of_closed, &n);
        }
        on.add_value(weight, &integrand);
        if point.is_pressed() {
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
                integrand.of_gap[side][axis] = along(self.pressing.heights());
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
