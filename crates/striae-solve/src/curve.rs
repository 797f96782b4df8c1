//! Values of curves, their derivatives, and loads along them.

use crate::model::{Curve, LoadKind};

impl Curve {
    /// `c(s)` at the fraction `s` of a step, `0..=1`.
    pub fn at(&self, s: f64) -> f64 {
        match self {
            Curve::Ramp => s,
            Curve::Constant => 1.0,
            Curve::Smooth => s * s * (3.0 - 2.0 * s),
            Curve::Table(points) => table(points, s),
        }
    }
}

/// Change over the fraction of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// `dc/ds`.
    pub first: f64,
    /// `d^2c/ds^2`.
    pub second: f64,
}

impl Curve {
    /// Derivatives of `c` at `s`; at a kink those before it, at the start those after it.
    pub fn rate(&self, s: f64) -> Rate {
        let (first, second) = match self {
            Curve::Ramp => (1.0, 0.0),
            Curve::Constant => (0.0, 0.0),
            Curve::Smooth => (6.0 * s * (1.0 - s), 6.0 - 12.0 * s),
            Curve::Table(points) => {
                let at = |point: &[(f64, f64)]| point[0].0 < s && s <= point[1].0;
                let section = points.windows(2).find(|section| at(section));
                let section = section.or_else(|| points.windows(2).next());
                let slope = |p: &[(f64, f64)]| (p[1].1 - p[0].1) / (p[1].0 - p[0].0);
                (section.map_or(0.0, slope), 0.0)
            }
        };
        Rate { first, second }
    }
}

/// Piecewise linear interpolation, constant beyond the ends.
fn table(points: &[(f64, f64)], s: f64) -> f64 {
    let next = points.partition_point(|point| point.0 < s);
    match (
        next.checked_sub(1).and_then(|at| points.get(at)),
        points.get(next),
    ) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (s - a.0) / (b.0 - a.0),
        (Some(only), None) | (None, Some(only)) => only.1,
        (None, None) => 0.0,
    }
}

impl LoadKind {
    /// `from + c (self - from)`, where `from` is of the same kind or nothing.
    pub fn between(&self, from: Option<&LoadKind>, c: f64) -> LoadKind {
        use LoadKind::{DeadTraction, FollowerTraction, Pressure};
        match (self, from) {
            (DeadTraction(to), Some(DeadTraction(from))) => DeadTraction(from + (to - from) * c),
            (FollowerTraction(to), Some(FollowerTraction(from))) => {
                FollowerTraction(from + (to - from) * c)
            }
            (Pressure(to), Some(Pressure(from))) => Pressure(from + (to - from) * c),
            (DeadTraction(to), _) => DeadTraction(to * c),
            (FollowerTraction(to), _) => FollowerTraction(to * c),
            (Pressure(to), _) => Pressure(to * c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_the_derivatives() {
        let table = Curve::Table(vec![(0.0, 0.0), (0.5, 1.0), (1.0, -1.0)]);
        for curve in [&Curve::Ramp, &Curve::Constant, &Curve::Smooth, &table] {
            for s in [0.2, 0.4, 0.7] {
                let h = 1e-4;
                let [a, b, c] = [s - h, s, s + h].map(|s| curve.at(s));
                let rate = curve.rate(s);
                assert!((rate.first - (c - a) / (2.0 * h)).abs() < 1e-7);
                assert!((rate.second - (a - 2.0 * b + c) / (h * h)).abs() < 1e-6);
            }
        }
        assert_eq!(
            [0.0, 0.5, 0.6].map(|s| table.rate(s).first),
            [2.0, 2.0, -4.0]
        );
    }

    #[test]
    fn curves_start_and_end_where_they_should() {
        let table = Curve::Table(vec![(0.0, 0.0), (0.5, 1.0), (1.0, -1.0)]);
        for (curve, expected) in [
            (&Curve::Ramp, [0.0, 0.25, 1.0]),
            (&Curve::Constant, [1.0, 1.0, 1.0]),
            (&Curve::Smooth, [0.0, 0.15625, 1.0]),
            (&table, [0.0, 0.5, -1.0]),
        ] {
            assert_eq!([0.0, 0.25, 1.0].map(|s| curve.at(s)), expected);
        }
    }
}
