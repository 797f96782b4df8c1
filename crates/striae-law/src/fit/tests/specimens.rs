//! Fits of readings of several specimens.

use std::f64::consts::PI;

use nalgebra::Vector2;
use striae_verify::Random;

use super::{Reading, covered, fit, friction_at, sought};
use crate::friction::{Friction, SlipRule};

/// Five specimens, each with an error of its own in the coefficients, measured alike: the mean
/// of the constants of each, with Student's interval of their scatter.
#[test]
fn specimens_that_were_measured_alike_have_the_interval_of_their_mean() {
    let mut random = Random::new(31);
    let angles = [0.0, 0.5 * PI, 0.3, PI, 1.5 * PI];
    let nap = sought("nap");
    let mut all = Vec::new();
    let mut each = Vec::new();
    for specimen in 0..5 {
        let own = Friction::nap(
            random.uniform(0.1, 0.2),
            random.uniform(0.2, 0.3),
            random.uniform(0.3, 0.4),
        );
        let own = own.unwrap();
        let reading = |slip: &f64| {
            let w = friction_at(&own, 0.0, *slip);
            let friction = w.dot(&Vector2::new(slip.cos(), slip.sin()));
            Reading {
                specimen: 3 * specimen,
                ..Reading::against(*slip, friction + random.uniform(-0.01, 0.01))
            }
        };
        let readings: Vec<Reading> = angles.iter().map(reading).collect();
        each.push(fit(&nap, &readings, 0.9).unwrap());
        all.extend(readings);
    }
    let found = fit(&nap, &all, 0.9).unwrap();
    assert!(each[0].specimens.is_empty());
    let numbers: Vec<usize> = found.specimens.iter().map(|one| one.number).collect();
    assert_eq!(numbers, [0, 3, 6, 9, 12]);
    for (k, constant) in found.constants.iter().enumerate() {
        let own: Vec<f64> = each.iter().map(|fit| fit.constants[k].value).collect();
        let mean = own.iter().sum::<f64>() / 5.0;
        let square = own.iter().map(|one| (one - mean).powi(2)).sum::<f64>();
        // Student's t for four degrees of freedom at 90 %.
        let half = 2.131_846_786_326_649 * (square / 20.0).sqrt();
        assert!((constant.value - mean).abs() < 1e-13);
        let [low, high] = constant.interval.unwrap();
        assert!((low - (mean - half)).abs() < 1e-12 && (high - (mean + half)).abs() < 1e-12);
    }
}

/// Of specimens whose friction scatters as a whole the intervals have the level asked for, where
/// those that take all readings as independent are far too narrow.
#[test]
fn intervals_cover_the_scatter_between_specimens() {
    const TRIALS: usize = 400;
    let mut random = Random::new(77);
    let law = Friction::orthotropic(0.2, 0.35, SlipRule::Opposing).unwrap();
    let orthotropic = sought("orthotropic");
    let mut covered_by = [0, 0];
    for _ in 0..TRIALS {
        let mut readings = Vec::new();
        for specimen in 0..6 {
            let factor = 1.0 + 0.1 * random.normal();
            for i in 0..12 {
                let slip = f64::from(i) * PI / 6.0;
                let w = friction_at(&law, 0.0, slip) * factor;
                let friction = w.dot(&Vector2::new(slip.cos(), slip.sin()));
                readings.push(Reading {
                    specimen,
                    ..Reading::against(slip, friction + 0.003 * random.normal())
                });
            }
        }
        let several = fit(&orthotropic, &readings, 0.95).unwrap();
        for reading in &mut readings {
            reading.specimen = 0;
        }
        let one = fit(&orthotropic, &readings, 0.95).unwrap();
        for (count, found) in covered_by.iter_mut().zip([several, one]) {
            let (each, _) = covered(&found, &[0.2, 0.35]);
            *count += usize::from(each[1]);
        }
    }
    let [several, one] = covered_by.map(|count| count as f64 / TRIALS as f64);
    assert!((several - 0.95).abs() < 0.03, "{several}");
    assert!(one < 0.7, "{one}");
}

/// A specimen with twice the friction of another is told as such.
#[test]
fn specimens_are_told_beside_the_law() {
    let reading = |specimen, friction| Reading {
        specimen,
        ..Reading::against(0.0, friction)
    };
    let readings = [0.2, 0.2, 0.4, 0.4].iter().zip([0, 0, 1, 1]);
    let readings: Vec<Reading> = readings.map(|(mu, one)| reading(one, *mu)).collect();
    let found = fit(&sought("coulomb"), &readings, 0.95).unwrap();
    let factors: Vec<f64> = found.specimens.iter().map(|one| one.factor).collect();
    assert!((factors[0] - 2.0 / 3.0).abs() < 1e-14 && (factors[1] - 4.0 / 3.0).abs() < 1e-14);
}
