//! Judgement of factors of one's own, at random points within the range of the law.
//!
//! Factors are finite and not negative, the same from both surfaces and after a rotation,
//! continuous in pressure and slip rate, with slopes by the slip rate that are finite at rest;
//! `p F` does not fall with the pressure;
//! derivatives are exact by the order of finite differences; states are those of an evolution in
//! time: they do not change in no time, and two halves of an increment lead to the state of the
//! whole with an error of second order in its length.

use nalgebra::{DVector, Rotation3, Vector3};
use striae_verify::derivative::directional;
use striae_verify::{Difference, Random};

use super::Violation;
use crate::friction::{
    RequiredTextures,
    factor::{
        Factor, FactorBatch, FactorPoints,
        samples::{DURATIONS, POINTS, ROUND_OFF, samples, states_after},
        sound_factors,
    },
};

/// Change of a factor next to rest that says anything about its slope.
const SEEN: f64 = 1e-8;
/// Slip rates over the largest between which slopes next to rest are compared.
const NEXT_TO_REST: [f64; 2] = [1e-10, 1e-13];
/// Growth of slopes between them that is one without bound.
const GROWTH: f64 = 20.0;
/// Quarterings of an increment in which the error of its halves must come to fall.
const QUARTERINGS: i32 = 12;
/// Least factor by which it falls with each, twice in a row; 16 for second order.
const FALL: f64 = 6.0;

/// Pressures and slip rates over the largest between which jumps are looked for.
const GRID: [f64; 12] = [
    1e-6, 1e-4, 1e-2, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0,
];
/// Halvings of an interval with a change: they leave 1e-13 of it.
const HALVINGS: usize = 44;
/// Change of a factor in what is left of an interval, over its size, that is a jump.
const JUMP: f64 = 1e-6;

/// Everything a factor gets wrong, for laws that see the textures of some surfaces.
pub(super) fn violations(law: &dyn FactorBatch, textures: RequiredTextures) -> Vec<Violation> {
    let mut random = Random::new(13);
    let mut wrong = Vec::new();
    for duration in DURATIONS {
        let points = match samples(law, textures, duration, &mut random) {
            Ok(points) => points,
            Err(failure) => return vec![Violation::Factor(failure)],
        };
        let judged = [
            rises_with_pressure(law, &points),
            is_smooth_at_rest(law, &points),
            is_the_same_from_both_sides(law, &points, &mut random),
            has_exact_derivatives(law, &points, &mut random),
        ];
        wrong.extend(judged.into_iter().filter_map(Result::err));
    }
    wrong.extend(is_continuous(law, textures, &mut random).err());
    if !law.initial_state().is_empty() {
        wrong.extend(evolves(law, textures, &mut random).err());
    }
    wrong
}

fn rises_with_pressure(law: &dyn FactorBatch, points: &FactorPoints) -> Result<(), Violation> {
    let mut low = points.clone();
    for (at, pressure) in low.pressure.iter_mut().enumerate() {
        *pressure *= 10.0_f64.powi(-(at as i32 % 6));
    }
    let found = sound_factors(law, &low).map_err(Violation::Factor)?;
    let falls = |(factor, pressure): (&Factor, &f64)| {
        factor.value + pressure * factor.by_pressure < -ROUND_OFF * factor.value
    };
    match found.iter().zip(&low.pressure).position(falls) {
        None => Ok(()),
        Some(at) => Err(Violation::FactorFallsWithPressure(low.told(at))),
    }
}

fn is_smooth_at_rest(law: &dyn FactorBatch, points: &FactorPoints) -> Result<(), Violation> {
    let largest = law.range().slip_rate;
    let at = |share: f64| {
        let found = sound_factors(law, &points.at_rates(|_| share * largest));
        found.map_err(Violation::Factor)
    };
    let rest = at(0.0)?;
    let [near, nearest] = NEXT_TO_REST;
    let [first, second] = [at(near)?, at(nearest)?];
    for (k, rest) in rest.iter().enumerate() {
        let [first, second] = [&first, &second].map(|found| (found[k].value - rest.value).abs());
        let grows = second / nearest > GROWTH * (first / near);
        if grows && second > SEEN * rest.value.max(1.0) {
            return Err(Violation::FactorSteepAtRest(points.told(k)));
        }
    }
    Ok(())
}

/// Halves the interval in which a factor changes most until nothing but a jump can be left.
fn is_continuous(
    law: &dyn FactorBatch,
    textures: RequiredTextures,
    random: &mut Random,
) -> Result<(), Violation> {
    let points = samples(law, textures, 1.0, random).map_err(Violation::Factor)?;
    let range = law.range();
    let with_pressure = |values: Vec<f64>| FactorPoints {
        pressure: values,
        ..points.clone()
    };
    let with_rate = |values: Vec<f64>| FactorPoints {
        slip_rate: values,
        ..points.clone()
    };
    type Posed<'a> = &'a dyn Fn(Vec<f64>) -> FactorPoints;
    let arguments: [(&'static str, f64, Posed); 2] = [
        ("pressure", range.pressure, &with_pressure),
        ("slip rate", range.slip_rate, &with_rate),
    ];
    for (by, largest, posed) in arguments {
        let values = |at: Vec<f64>| {
            let found = sound_factors(law, &posed(at)).map_err(Violation::Factor)?;
            Ok::<Vec<f64>, Violation>(found.iter().map(|factor| factor.value).collect())
        };
        let mut intervals: Vec<[(f64, f64); 2]> = Vec::new();
        let mut last: Option<Vec<(f64, f64)>> = None;
        for share in GRID {
            let at = share * largest;
            let found = values(vec![at; points.len()])?;
            let ends: Vec<(f64, f64)> = found.into_iter().map(|value| (at, value)).collect();
            if let Some(last) = last.replace(ends.clone()) {
                let next: Vec<[(f64, f64); 2]> =
                    last.into_iter().zip(ends).map(|(a, b)| [a, b]).collect();
                match intervals.is_empty() {
                    true => intervals = next,
                    false => keep_larger(&mut intervals, next),
                }
            }
        }
        for _ in 0..HALVINGS {
            let middles: Vec<f64> = intervals.iter().map(|[a, b]| 0.5 * (a.0 + b.0)).collect();
            let found = values(middles.clone())?;
            let middles = middles.into_iter().zip(found);
            let halves = intervals.iter().zip(middles);
            let (lower, upper) = halves.map(|([a, b], m)| ([*a, m], [m, *b])).unzip();
            intervals = lower;
            keep_larger(&mut intervals, upper);
        }
        let is_jump = |interval: &[(f64, f64); 2]| change(interval) > JUMP * interval[0].1.max(1.0);
        if let Some(at) = intervals.iter().position(is_jump) {
            let [(value, before), (_, after)] = intervals[at];
            return Err(Violation::FactorJumps {
                by,
                value,
                change: after - before,
                at: points.told(at),
            });
        }
    }
    Ok(())
}

fn change([low, high]: &[(f64, f64); 2]) -> f64 {
    (high.1 - low.1).abs()
}

/// Replaces intervals by others in which more changes.
fn keep_larger(intervals: &mut [[(f64, f64); 2]], others: Vec<[(f64, f64); 2]>) {
    for (kept, other) in intervals.iter_mut().zip(others) {
        if change(&other) > change(kept) {
            *kept = other;
        }
    }
}

fn is_the_same_from_both_sides(
    law: &dyn FactorBatch,
    points: &FactorPoints,
    random: &mut Random,
) -> Result<(), Violation> {
    let turn = |v: &[Vector3<f64>], by: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| {
        v.iter().map(by).collect::<Vec<_>>()
    };
    let rotation: Rotation3<f64> = random.rotation();
    let turned = FactorPoints {
        normal: turn(&points.normal, &|v| rotation * v),
        own: turn(&points.own, &|v| rotation * v),
        opposite: turn(&points.opposite, &|v| rotation * v),
        ..points.clone()
    };
    let swapped = FactorPoints {
        normal: turn(&points.normal, &|v| -v),
        own: turn(&points.opposite, &|v| -v),
        opposite: turn(&points.own, &|v| -v),
        ..points.clone()
    };
    let count = points.len();
    let all = points.clone().and(&turned).and(&swapped);
    let found = sound_factors(law, &all).map_err(Violation::Factor)?;
    let changes = |at: usize| found[at].value - found[at % count].value;
    let error = (count..3 * count).map(|at| changes(at).abs());
    let error = error.fold(0.0, f64::max);
    match error <= ROUND_OFF {
        true => Ok(()),
        false => Err(Violation::FactorSides(error)),
    }
}

fn has_exact_derivatives(
    law: &dyn FactorBatch,
    points: &FactorPoints,
    random: &mut Random,
) -> Result<(), Violation> {
    let range = law.range();
    let found = sound_factors(law, points).map_err(Violation::Factor)?;
    for (at, factor) in found.iter().enumerate().step_by(POINTS / 4) {
        let one = |x: &DVector<f64>| {
            let vector = |i: usize| Vector3::new(x[i], x[i + 1], x[i + 2]);
            FactorPoints {
                pressure: vec![x[0] * range.pressure],
                slip_rate: vec![x[1] * range.slip_rate],
                accumulated_slip: vec![points.accumulated_slip[at]],
                position: vec![points.position[at]],
                normal: vec![vector(2)],
                own: vec![vector(5)],
                opposite: vec![vector(8)],
                states: points.state(at).to_vec(),
                ..*points
            }
        };
        let vectors = [&points.normal[at], &points.own[at], &points.opposite[at]];
        let scaled = [
            points.pressure[at] / range.pressure,
            points.slip_rate[at] / range.slip_rate,
        ];
        let coordinates = vectors.iter().flat_map(|v| v.iter().copied());
        let x = DVector::from_iterator(11, scaled.into_iter().chain(coordinates));
        let slopes = [
            factor.by_pressure * range.pressure,
            factor.by_slip_rate * range.slip_rate,
        ];
        let slopes = slopes.into_iter().chain(factor.by_surroundings);
        let slope = DVector::from_iterator(11, slopes);
        let mut direction = random.unit(11);
        for (k, vector) in vectors.iter().enumerate() {
            if **vector == Vector3::zeros() {
                direction.rows_mut(2 + 3 * k, 3).fill(0.0);
            }
        }
        let value = |x: &DVector<f64>| {
            let found = law.factors(&one(x));
            let value = found.ok().and_then(|found| found.first().copied());
            DVector::from_element(1, value.map_or(f64::NAN, |factor| factor.value))
        };
        let claimed = DVector::from_element(1, slope.dot(&direction));
        let difference = Difference::Central;
        if let Err(wrong) = directional(difference, value, &claimed, &x, &direction)
            && !wrong.is_of_kinks()
            && !is_of_differences(&wrong.errors, factor)
        {
            let told = wrong.to_string().trim_end().to_owned();
            return Err(Violation::FactorDerivative(told));
        }
    }
    Ok(())
}

/// Returns whether errors are those of derivatives that are differences themselves.
fn is_of_differences(errors: &[(f64, f64)], factor: &Factor) -> bool {
    let least = errors.iter().map(|(_, error)| *error);
    least.fold(f64::INFINITY, f64::min) <= ROUND_OFF * factor.value.max(f64::MIN_POSITIVE)
}

fn evolves(
    law: &dyn FactorBatch,
    textures: RequiredTextures,
    random: &mut Random,
) -> Result<(), Violation> {
    let points = samples(law, textures, 1.0, random).map_err(Violation::Factor)?;
    let lasting = |elapsed: f64, states: &[f64]| {
        let mut points = points.clone();
        points.elapsed = elapsed;
        points.states = states.to_vec();
        states_after(law, &points).map_err(Violation::Factor)
    };
    let size = points
        .states
        .iter()
        .fold(1.0_f64, |size, x| size.max(x.abs()));
    let far = |one: &[f64], other: &[f64]| {
        let pairs = one.iter().zip(other);
        pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
    };
    let mut last = [f64::INFINITY; 2];
    let mut errors = Vec::new();
    for k in 0..QUARTERINGS {
        let elapsed = points.elapsed * 0.25_f64.powi(k);
        let whole = lasting(elapsed, &points.states)?;
        let halves = lasting(0.5 * elapsed, &lasting(0.5 * elapsed, &points.states)?)?;
        let error = far(&whole, &halves);
        errors.push((elapsed, error));
        let falls = last[0] / error > FALL && last[1] / last[0] > FALL;
        if error <= ROUND_OFF * size || falls && last[1].is_finite() {
            let least = points.elapsed * 0.25_f64.powi(2 * QUARTERINGS);
            let jump = far(&lasting(least, &points.states)?, &points.states);
            return match jump <= SEEN.sqrt() * size {
                true => Ok(()),
                false => Err(Violation::FactorStateJumps(jump)),
            };
        }
        last = [error, last[0]];
    }
    let told = errors
        .iter()
        .map(|(elapsed, error)| format!("  duration {elapsed:9.3e}  difference {error:9.3e}"));
    Err(Violation::FactorState(told.collect::<Vec<_>>().join("\n")))
}
