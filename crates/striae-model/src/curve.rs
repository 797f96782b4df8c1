//! Values of curves, their derivatives, and loads along them.

use nalgebra::{Scalar, Vector3};
use num_dual::DualNum;
use striae_mesh::Vec3;

use crate::{
    function::Value,
    model::{Clock, Course, Curve, History, LoadKind, Moment},
};

/// Change over the fraction of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// `dc/ds`.
    pub first: f64,
    /// `d^2c/ds^2`.
    pub second: f64,
}

impl Curve {
    /// `c` at a moment.
    pub fn at(&self, moment: Moment) -> f64 {
        let s = moment.s;
        match self {
            Curve::Ramp => s,
            Curve::Constant => 1.0,
            Curve::Smooth => s * s * (3.0 - 2.0 * s),
            Curve::Table(points) => table(points, s),
            Curve::History(history) => history.at(moment),
        }
    }

    /// Derivatives of `c`; at a kink those before it, at the start those after it.
    pub fn rate(&self, moment: Moment) -> Rate {
        let s = moment.s;
        let (first, second) = match self {
            Curve::Ramp => (1.0, 0.0),
            Curve::Constant => (0.0, 0.0),
            Curve::Smooth => (6.0 * s * (1.0 - s), 6.0 - 12.0 * s),
            Curve::Table(points) => (slope(points, s), 0.0),
            Curve::History(history) => {
                let [first, second] = history.rate(moment);
                (first, second)
            }
        };
        Rate { first, second }
    }

    /// Value at `c = 0`: that which the step finds, or the one at rest.
    pub fn origin<T>(&self, found: T, at_rest: T) -> T {
        match self {
            Curve::History(history) if history.clock == Clock::Run => at_rest,
            _ => found,
        }
    }

    /// Least and largest of zero and all `c` in a step; of a function at a number of moments.
    pub fn range(&self, start: Moment) -> [f64; 2] {
        const MOMENTS: usize = 64;
        let points: Vec<f64> = match self {
            Curve::Ramp | Curve::Smooth => return [0.0, 1.0],
            Curve::Constant => return [1.0, 1.0],
            Curve::Table(points) => points.iter().map(|point| point.1).collect(),
            Curve::History(history) => match &history.course {
                Course::Table(points) | Course::Periodic { points, .. } => {
                    points.iter().map(|point| point.1).collect()
                }
                Course::Function(_) => (0..=MOMENTS)
                    .map(|at| self.at(start.later(at as f64 / MOMENTS as f64)))
                    .collect(),
            },
        };
        points
            .iter()
            .fold([0.0, 0.0], |[least, most], c| [c.min(least), c.max(most)])
    }
}

impl Moment {
    /// The start of the first step, of some duration.
    pub fn start(duration: f64) -> Self {
        Self {
            s: 0.0,
            time: 0.0,
            duration,
        }
    }

    /// The moment of the same step, of which this is the start, at a fraction of it.
    pub fn later(self, s: f64) -> Self {
        Self {
            s,
            time: self.time + s * self.duration,
            ..self
        }
    }
}

impl History {
    fn at(&self, moment: Moment) -> f64 {
        let at = self.abscissa(moment);
        match &self.course {
            Course::Table(points) => table(points, at),
            Course::Periodic { points, period } => table(points, folded(at, *period)),
            Course::Function(function) => function.at(&Vec3::zeros(), at),
        }
    }

    /// Derivatives by the fraction of the step.
    fn rate(&self, moment: Moment) -> [f64; 2] {
        let at = self.abscissa(moment);
        let scale = match self.clock {
            Clock::Step => 1.0,
            Clock::Run => moment.duration,
        };
        let [first, second] = match &self.course {
            Course::Table(points) => [slope(points, at), 0.0],
            Course::Periodic { points, period } => [slope(points, folded(at, *period)), 0.0],
            Course::Function(function) => function.rate(&Vec3::zeros(), at),
        };
        [first * scale, second * scale * scale]
    }

    fn abscissa(&self, moment: Moment) -> f64 {
        match self.clock {
            Clock::Step => moment.s,
            Clock::Run => moment.time,
        }
    }
}

/// An abscissa within the first period, whose end and not whose start belongs to it.
fn folded(at: f64, period: f64) -> f64 {
    match at > period {
        true => at - ((at / period).ceil() - 1.0) * period,
        false => at,
    }
}

/// Slope of the section of a table before `s`, of the first one at its start; none beyond its ends.
fn slope(points: &[(f64, f64)], s: f64) -> f64 {
    let at = |point: &[(f64, f64)]| point[0].0 < s && s <= point[1].0;
    let section = points.windows(2).find(|section| at(section));
    let first = points.first().is_some_and(|first| s == first.0);
    let section = section.or_else(|| points.windows(2).next().filter(|_| first));
    let slope = |p: &[(f64, f64)]| (p[1].1 - p[0].1) / (p[1].0 - p[0].0);
    section.map_or(0.0, slope)
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

impl<S: Scalar> LoadKind<S> {
    /// The load with other values.
    pub fn map<T: Scalar>(&self, mut of: impl FnMut(&S) -> T) -> LoadKind<T> {
        match self {
            Self::DeadTraction(traction) => LoadKind::DeadTraction(traction.map(|v| of(&v))),
            Self::FollowerTraction(traction) => {
                LoadKind::FollowerTraction(traction.map(|v| of(&v)))
            }
            Self::Pressure(pressure) => LoadKind::Pressure(of(pressure)),
        }
    }

    /// Returns whether a later statement of the other one goes on from where this one is.
    pub fn is_like<T: Scalar>(&self, other: &LoadKind<T>) -> bool {
        use LoadKind::{DeadTraction, FollowerTraction, Pressure};
        matches!(
            (self, other),
            (DeadTraction(_), DeadTraction(_))
                | (FollowerTraction(_), FollowerTraction(_))
                | (Pressure(_), Pressure(_))
        )
    }
}

impl LoadKind<Value> {
    /// `from + c (self - from)`, where `from` is of the same kind or nothing.
    pub fn between(&self, from: Option<&Self>, c: f64) -> Self {
        use LoadKind::{DeadTraction, FollowerTraction, Pressure};
        let none = Value::Number(0.0);
        let vectors = |to: &Vector3<Value>, from: &Vector3<Value>| {
            to.zip_map(from, |to, from| to.between(&from, c))
        };
        match (self, from) {
            (DeadTraction(to), Some(DeadTraction(from))) => DeadTraction(vectors(to, from)),
            (FollowerTraction(to), Some(FollowerTraction(from))) => {
                FollowerTraction(vectors(to, from))
            }
            (Pressure(to), Some(Pressure(from))) => Pressure(to.between(from, c)),
            (to, _) => to.map(|to| to.between(&none, c)),
        }
    }

    /// The load at a point of the reference configuration, which no longer changes with time.
    pub fn at<D: DualNum<Primitive = f64> + Copy>(&self, x: &Vector3<D>) -> LoadKind<D> {
        self.map(|value| value.at(x, D::from(0.0)))
    }

    /// Returns whether a value changes with time.
    pub fn moves(&self) -> bool {
        let mut moves = false;
        let _ = self.map(|value| moves |= value.moves());
        moves
    }

    /// The numbers of a load that is the same everywhere and at all times.
    pub fn numbers(&self) -> Option<LoadKind> {
        let mut known = true;
        let numbers = self.map(|value| {
            known &= value.number().is_some();
            value.number().unwrap_or(0.0)
        });
        known.then_some(numbers)
    }
}

impl LoadKind {
    /// Returns whether its values are finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::DeadTraction(traction) | Self::FollowerTraction(traction) => {
                traction.iter().all(|v| v.is_finite())
            }
            Self::Pressure(pressure) => pressure.is_finite(),
        }
    }
}

impl From<LoadKind> for LoadKind<Value> {
    fn from(numbers: LoadKind) -> Self {
        numbers.map(|number| Value::Number(*number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::Function;

    /// A moment of a step of duration 4 that starts at the time 3.
    fn at(s: f64) -> Moment {
        let start = Moment {
            time: 3.0,
            ..Moment::start(4.0)
        };
        start.later(s)
    }

    fn over(clock: Clock, course: Course) -> Curve {
        Curve::History(History { clock, course })
    }

    fn saw() -> Course {
        Course::Periodic {
            points: vec![(0.0, 0.0), (0.5, 1.0), (1.5, -1.0)],
            period: 1.5,
        }
    }

    #[test]
    fn histories_are_over_the_time_of_the_run_or_the_step() {
        let run = over(Clock::Run, saw());
        // Times 3, 3.4, 3.5, 4, 4.5 and 7 are 2, 2 1/4, 2 1/3, 2 2/3, 3 and 4 2/3 periods.
        for (time, expected) in [(3.4, 0.8), (3.5, 1.0), (4.0, 0.0), (4.5, -1.0), (7.0, 0.0)] {
            let found = run.at(at((time - 3.0) / 4.0));
            assert!((found - expected).abs() < 1e-12, "{time}: {found}");
        }
        let step = over(Clock::Step, Course::Function(Function::new("t^2").unwrap()));
        assert_eq!(step.at(at(0.5)), 0.25);
        assert_eq!([run.origin(5, 0), step.origin(5, 0)], [0, 5]);
        let table = over(Clock::Run, Course::Table(vec![(3.0, 2.0), (5.0, 4.0)]));
        assert_eq!([0.0, 0.25, 0.75].map(|s| table.at(at(s))), [2.0, 3.0, 4.0]);
        assert_eq!(
            [0.0, 0.25, 0.75].map(|s| table.rate(at(s)).first),
            [4.0, 4.0, 0.0]
        );
    }

    #[test]
    fn rates_are_the_derivatives() {
        let table = Curve::Table(vec![(0.0, 0.0), (0.5, 1.0), (1.0, -1.0)]);
        let wave = Course::Function(Function::new("sin(t)").unwrap());
        let run = [saw(), wave.clone()].map(|course| over(Clock::Run, course));
        let step = over(Clock::Step, wave);
        let histories = [&run[0], &run[1], &step];
        for curve in [&Curve::Ramp, &Curve::Constant, &Curve::Smooth, &table]
            .into_iter()
            .chain(histories)
        {
            for s in [0.2, 0.4, 0.7] {
                let h = 1e-4;
                let [a, b, c] = [s - h, s, s + h].map(|s| curve.at(at(s)));
                let rate = curve.rate(at(s));
                assert!((rate.first - (c - a) / (2.0 * h)).abs() < 2e-7);
                assert!((rate.second - (a - 2.0 * b + c) / (h * h)).abs() < 2e-6);
            }
        }
        assert_eq!(
            [0.0, 0.5, 0.6].map(|s| table.rate(at(s)).first),
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
            assert_eq!([0.0, 0.25, 1.0].map(|s| curve.at(at(s))), expected);
        }
    }
}
