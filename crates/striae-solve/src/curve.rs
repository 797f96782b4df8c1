//! Values of curves and of loads along them.

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
