//! Random points within the range of a factor of one's own, and its course with the slip rate.

use nalgebra::Vector3;
use striae_verify::Random;

use super::{Course, Factor, FactorBatch, FactorPoints, LARGEST_STATE, sound_factors};
use crate::friction::{
    RequiredTextures,
    error::{FactorFailure, FrictionError},
};

/// Random points of a batch.
pub(in crate::friction) const POINTS: usize = 32;
/// Slip rates over the largest at which the course of a factor is taken.
const RATES: [f64; 12] = [
    0.0, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0,
];
/// Durations over the largest.
pub(in crate::friction) const DURATIONS: [f64; 3] = [1.0, 1e-2, 1e-4];
/// Relative round-off of functions.
pub(in crate::friction) const ROUND_OFF: f64 = 1e-9;

/// Course of a law with the slip rate.
pub(super) fn course(law: &dyn FactorBatch) -> Result<Course, FrictionError> {
    let count = law.initial_state().len();
    if count > LARGEST_STATE {
        let cause = format!("it has {count} state variables, but may have {LARGEST_STATE}");
        let law = law.name().to_owned();
        return Err(FrictionError::Factor(FactorFailure { law, cause }));
    }
    let mut random = Random::new(11);
    let mut course = Course {
        goes_with_rate: false,
        falls: false,
        largest_over_rest: 1.0,
        steepest: 0.0,
    };
    for duration in DURATIONS {
        let points = samples(law, law.required_textures(), duration, &mut random)?;
        let largest = law.range().slip_rate;
        let asked = RATES.map(|rate| points.at_rates(|_| rate * largest));
        let [first, others @ ..] = &asked;
        let all = others.iter().fold(first.clone(), FactorPoints::and);
        let found = sound_factors(law, &all)?;
        for at in 0..points.len() {
            let of: Vec<&Factor> = found.iter().skip(at).step_by(points.len()).collect();
            for factor in &of {
                let fall = -factor.by_slip_rate / points.elapsed;
                course.steepest = course.steepest.max(fall);
                let share = factor.value / of[0].value.max(f64::MIN_POSITIVE);
                course.largest_over_rest = course.largest_over_rest.max(share);
            }
            for pair in of.windows(2) {
                let change = pair[1].value - pair[0].value;
                let seen = change.abs() > ROUND_OFF * pair[0].value;
                course.goes_with_rate |= seen || pair[1].by_slip_rate != 0.0;
                course.falls |= seen && change < 0.0;
            }
        }
    }
    Ok(course)
}

/// Random points with states that the law comes to.
pub(in crate::friction) fn samples(
    law: &dyn FactorBatch,
    textures: RequiredTextures,
    duration: f64,
    random: &mut Random,
) -> Result<FactorPoints, FactorFailure> {
    let range = law.range();
    let mut points = FactorPoints {
        elapsed: duration * range.elapsed,
        time: range.time * random.uniform(0.1, 1.0),
        ..FactorPoints::default()
    };
    let start = law.initial_state();
    for _ in 0..POINTS {
        let normal = random.unit3();
        let mut tangent = || normal.cross(&random.unit3()).normalize();
        let (own, opposite) = match textures {
            RequiredTextures::Any => (Vector3::zeros(), Vector3::zeros()),
            RequiredTextures::One => (tangent(), Vector3::zeros()),
            RequiredTextures::Both => (tangent(), tangent()),
        };
        points.normal.push(normal);
        points.own.push(own);
        points.opposite.push(opposite);
        // At least a tenth of the largest, so that differences do not leave the range.
        points
            .pressure
            .push(range.pressure * random.uniform(0.1, 1.0));
        points
            .slip_rate
            .push(range.slip_rate * random.uniform(0.1, 1.0));
        points
            .accumulated_slip
            .push(range.slip * random.uniform(0.0, 1.0));
        points.position.push(random.unit3() * range.position);
        points.states.extend(&start);
    }
    for _ in 0..2 {
        let slow = points.at_rates(|rate| rate * random.uniform(0.0, 1.0).powi(4));
        let later = states_after(law, &slow)?;
        // Half of the points begin.
        for at in (0..POINTS).step_by(2) {
            let of_point = start.len() * at..start.len() * (at + 1);
            points.states[of_point.clone()].copy_from_slice(&later[of_point]);
        }
    }
    Ok(points)
}

/// States after an increment, refused where they are not finite.
pub(in crate::friction) fn states_after(
    law: &dyn FactorBatch,
    points: &FactorPoints,
) -> Result<Vec<f64>, FactorFailure> {
    let failed = |cause: String| FactorFailure {
        law: law.name().to_owned(),
        cause,
    };
    let found = law.states_after(points)?;
    if found.len() != points.states.len() {
        let cause = format!(
            "its state has {} numbers at {} points after an increment, but {} before",
            found.len(),
            points.len(),
            points.states.len()
        );
        return Err(failed(cause));
    }
    match found.iter().position(|value| !value.is_finite()) {
        None => Ok(found),
        Some(at) => {
            let at = at * points.len() / found.len();
            let cause = format!("its state is not finite after {}", points.told(at));
            Err(failed(cause))
        }
    }
}
