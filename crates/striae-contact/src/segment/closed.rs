//! Pressure on a segment where all kept nodes are closed at all points.
//!
//! The integrals of [`super::points`] are then those of few functions, whatever the number of
//! nodes: with `s_d = sum_k share_kd p_k` and `b_d = sum_k share_kd r_k`
//!
//! ```text
//! F_c = int N_c sum_d N_d (s_d - b_d g) dA
//! H_c = int N_c g dA,   G_k = sum_c share_kc H_c,   dF_c/dp_k = sum_d D_cd share_kd
//! ```

use pulp::{Simd, WithSimd};

use super::{
    Polygon, Slopes,
    fan::Fan,
    moved::{Integrand, M, Moved, OnTriangle},
    plane_facet::Vec2,
    rule,
    sums::add,
    support::{Pressed, PressedSlopes, Pressing, dot, shares},
};

/// A segment whose vertices are all closed.
pub(super) struct Closed<'a> {
    polygon: &'a Polygon,
    pressing: &'a Pressing,
    fan: &'a Fan,
    rule: &'a [rule::Point],
    /// `s_d`.
    pressures: [f64; 8],
    /// `b_d`.
    beddings: [f64; 8],
}

impl<'a> Closed<'a> {
    pub(super) fn new(
        polygon: &'a Polygon,
        pressing: &'a Pressing,
        fan: &'a Fan,
        rule: &'a [rule::Point],
    ) -> Self {
        Self {
            polygon,
            pressing,
            fan,
            rule,
            pressures: pressing.at_corners(|support| support.pressure),
            beddings: pressing.at_corners(|support| support.bedding),
        }
    }

    /// Returns whether the points of the rule are closed, too.
    pub(super) fn holds(&self) -> bool {
        let limit = self.pressing.least_limit();
        self.points(self.fan)
            .all(|(n, _)| self.pressing.gap(&n) < limit)
    }

    /// Interpolation functions and weights of the points in the triangles of a fan.
    fn points(&self, fan: &Fan) -> impl Iterator<Item = ([f64; 8], f64)> {
        let facets = &self.polygon.pair.facets;
        fan.triangles.iter().flat_map(move |indices| {
            let v = indices.map(|at| fan.places[at]);
            let area = 0.5 * (v[1] - v[0]).perp(&(v[2] - v[0]));
            let rule = self.rule.iter();
            rule.map(move |(at, weight)| (shares(facets, &place(&v, at)), weight * area))
        })
    }

    pub(super) fn pressed(&self, mass: &[[f64; 8]; 8], slopes: Option<&Slopes>) -> Pressed {
        let mut sums = Sums {
            closed: self,
            value: [0.0; M],
            moved: Moved::zero(self.fan.places.len()),
            area: 0.0,
            with_slopes: slopes.is_some(),
        };
        pulp::Arch::new().dispatch(&mut sums);
        let supports = || self.pressing.supports().map(|(support, _)| support);
        let [mut force, mut gaps] = [[0.0; 8]; 2];
        force.copy_from_slice(&sums.value[..8]);
        gaps.copy_from_slice(&sums.value[8..]);
        let slopes = slopes.map(|known| {
            let rows = self.polygon.in_space(sums.moved, self.fan, known);
            let of_row = |shares: &[f64; 8]| {
                let mut sum = [0.0; 24];
                (0..8).for_each(|c| add(&mut sum, shares[c], &rows[8 + c]));
                sum
            };
            let mut force = [[0.0; 24]; 8];
            force.copy_from_slice(&rows[..8]);
            Box::new(PressedSlopes {
                force,
                rows: supports().map(|support| of_row(&support.shares)).collect(),
                force_by_pressure: supports()
                    .map(|support| mass.each_ref().map(|row| dot(row, &support.shares)))
                    .collect(),
                rows_by_pressure: vec![0.0; self.pressing.count()],
            })
        });
        Pressed {
            force,
            rows: supports()
                .map(|support| dot(&gaps, &support.shares))
                .collect(),
            closed: self.polygon.closed(self.pressing, mass),
            touches: vec![true; self.pressing.count()],
            area: sums.area,
            slopes,
        }
    }
}

fn place(v: &[Vec2; 3], shares: &[f64; 3]) -> Vec2 {
    v[0] * shares[0] + v[1] * shares[1] + v[2] * shares[2]
}

struct Sums<'a> {
    closed: &'a Closed<'a>,
    value: [f64; M],
    moved: Moved,
    area: f64,
    with_slopes: bool,
}

impl WithSimd for &mut Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for indices in &self.closed.fan.triangles {
            self.add_triangle(indices);
        }
    }
}

impl Sums<'_> {
    #[inline(always)]
    fn add_triangle(&mut self, indices: &[usize; 3]) {
        let v = indices.map(|at| self.closed.fan.places[at]);
        let area = 0.5 * (v[1] - v[0]).perp(&(v[2] - v[0]));
        let mut on = OnTriangle::new();
        for (shares, weight) in self.closed.rule {
            self.add_point(&place(&v, shares), (shares, *weight, area), &mut on);
        }
        add(&mut self.value, area, on.own());
        self.area += area;
        if self.with_slopes {
            self.moved.add_triangle(&on, &v, indices);
        }
    }

    #[inline(always)]
    fn add_point(
        &mut self,
        place: &Vec2,
        (shares, weight, area): (&[f64; 3], f64, f64),
        on: &mut OnTriangle,
    ) {
        let Closed {
            polygon,
            pressing,
            pressures,
            beddings,
            ..
        } = self.closed;
        let facets = &polygon.pair.facets;
        let of = [facets[0].at(place), facets[1].at(place)];
        let n: [f64; 8] = std::array::from_fn(|c| of[c / 4].value[c % 4]);
        let gap = pressing.gap(&n);
        let (base, bedding) = (dot(pressures, &n), dot(beddings, &n));
        let pressure = base - bedding * gap;
        let mut integrand = Integrand::zero();
        for c in 0..8 {
            integrand.value[c] = n[c] * pressure;
            integrand.value[8 + c] = n[c] * gap;
            integrand.by_gap[c] = -n[c] * bedding;
            integrand.by_gap[8 + c] = n[c];
        }
        on.add_value(weight, &integrand);
        if !self.with_slopes {
            return;
        }
        for side in 0..2 {
            for axis in 0..2 {
                let slope = &of[side].gradient[axis];
                let along = |values: &[f64; 8]| -> f64 {
                    (0..4).map(|c| values[4 * side + c] * slope[c]).sum()
                };
                integrand.of_gap[side][axis] = along(pressing.heights());
                let of_pressure = along(pressures) - gap * along(beddings);
                let gradient = &mut integrand.gradient[side][axis];
                for c in 0..8 {
                    gradient[c] = n[c] * of_pressure;
                }
                for c in 0..4 {
                    gradient[4 * side + c] += slope[c] * pressure;
                    gradient[8 + 4 * side + c] = slope[c] * gap;
                }
            }
        }
        let weights = (shares, weight * area);
        self.moved.add_point(on, &integrand, &n, weights);
    }
}
