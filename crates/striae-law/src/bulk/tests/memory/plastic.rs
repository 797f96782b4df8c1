//! Plastic metal against closed forms of tension and shear.

use super::*;

const E: f64 = 200.0;
const NU: f64 = 0.3;

fn hardenings() -> [Hardening; 4] {
    [
        Hardening::linear(0.5, 0.0).unwrap(),
        Hardening::linear(0.5, 2.0).unwrap(),
        Hardening::voce(0.4, 0.9, 8.0, 0.3).unwrap(),
        Hardening::table(&[[0.0, 0.4], [0.02, 0.5], [0.1, 0.7], [0.5, 0.8]]).unwrap(),
    ]
}

fn metal(hardening: Hardening) -> Material {
    let constants = LameConstants::from_youngs_modulus(E, NU).unwrap();
    Material::plastic(Plastic::new(constants, hardening))
}

fn plastic_strain(point: &Point) -> f64 {
    point.variables[point.material.fields()[0].variable]
}

/// Logarithmic strains of tension with the stress `tau` and the plastic strain `p`.
fn tension(tau: f64, p: f64) -> Matrix3<f64> {
    let across = -NU * tau / E - 0.5 * p;
    diagonal([tau / E + p, across, across])
}

#[test]
fn all_hardenings_pass_the_battery() {
    for hardening in hardenings() {
        assert_eq!(battery(&metal(hardening)), []);
    }
}

#[test]
fn tension_and_its_reversal_follow_the_yield_stress() {
    for hardening in hardenings() {
        for increments in [1, 7] {
            let mut point = Point::at_rest(metal(hardening.clone()));
            let mut check = |tau: f64, along: f64, p: f64| {
                let f = tension(tau, along);
                let kirchhoff = point.to(&f, 1.0).first_piola * f.transpose();
                let mut expected = Matrix3::zeros();
                expected[(0, 0)] = tau;
                assert!((kirchhoff - expected).norm() < 1e-12, "{kirchhoff}");
                assert!((plastic_strain(&point) - p).abs() < 1e-13);
            };
            let first = hardening.stress(0.0);
            check(0.9 * first, 0.0, 0.0);
            for at in 1..=increments {
                let p = 0.3 * f64::from(at) / f64::from(increments);
                check(hardening.stress(p), p, p);
            }
            check(-0.9 * hardening.stress(0.3), 0.3, 0.3);
            for at in 1..=increments {
                let back = 0.5 * f64::from(at) / f64::from(increments);
                check(-hardening.stress(0.3 + back), 0.3 - back, 0.3 + back);
            }
        }
    }
}

#[test]
fn plastic_work_is_dissipated_and_elastic_work_stored() {
    for hardening in hardenings() {
        let mut point = Point::at_rest(metal(hardening.clone()));
        for at in 1..=3 {
            let p = 0.1 * f64::from(at);
            let tau = hardening.stress(p);
            let stored = point.to(&tension(tau, p), 1.0).energy;
            assert!((stored - 0.5 * tau * tau / E).abs() < 1e-13);
        }
        let count = 200_000;
        let middle = |at: i32| 0.3 * (f64::from(at) + 0.5) / f64::from(count);
        let sum: f64 = (0..count).map(|at| hardening.stress(middle(at))).sum();
        let expected = sum * 0.3 / f64::from(count);
        assert!((point.dissipated - expected).abs() < 1e-9, "{hardening:?}");
    }
}

#[test]
fn plastic_flow_keeps_the_volume() {
    let mut random = Random::new(7);
    for hardening in hardenings() {
        let mut point = Point::at_rest(metal(hardening));
        for _ in 0..50 {
            point.to(&random.near_identity(0.3), 1.0);
        }
        assert!(plastic_strain(&point) > 1.0);
        let [a, b, c, d, e, f] = point.variables[..6].try_into().unwrap();
        let flow = Matrix3::new(1.0 + a, d, e, d, 1.0 + b, f, e, f, 1.0 + c);
        assert!((flow.determinant() - 1.0).abs() < 1e-11);
    }
}

#[test]
fn torsion_of_a_thin_tube_and_its_reversal_yield_at_the_stress_of_von_mises() {
    // Elastic strains of 1e-4 turn along with the material; all but that is simple shear, and
    // the plastic strain is the way that the shear has gone over the root of 3.
    let (yield_stress, root) = (1e-4 * E, 3f64.sqrt());
    for modulus in [0.0, yield_stress] {
        let hardening = Hardening::linear(yield_stress, modulus).unwrap();
        let mut point = Point::at_rest(metal(hardening.clone()));
        let mut twisted = |from: i32, to: i32| {
            let mut stress = 0.0;
            for at in 1..=400 {
                let f = shear(f64::from(from * (400 - at) + to * at) / 400.0);
                stress = (point.to(&f, 1.0).first_piola * f.transpose())[(0, 1)];
            }
            (stress, plastic_strain(&point))
        };
        for (from, to, way) in [(0, 1, 1.0), (1, -1, 3.0), (-1, 0, 4.0)] {
            let (stress, plastic) = twisted(from, to);
            let expected = hardening.stress(way / root) / root * f64::from(to - from).signum();
            assert!(
                (stress / expected - 1.0).abs() < 2e-3,
                "{stress} {expected}"
            );
            assert!((plastic * root / way - 1.0).abs() < 2e-3, "{plastic}");
        }
    }
}

#[test]
fn wrong_hardening_is_refused() {
    let text = |refused: Result<Hardening, InadmissibleHardening>| refused.unwrap_err().to_string();
    assert_eq!(
        text(Hardening::linear(0.0, 1.0)),
        "`yield_stress` is 0, but it must be positive and finite"
    );
    assert_eq!(
        text(Hardening::linear(1.0, -1.0)),
        "`hardening_modulus` is -1, but it must be at least 0 and finite"
    );
    assert_eq!(
        text(Hardening::voce(2.0, 1.0, 1.0, 0.0)),
        "the saturation stress is 1, but it must be at least `yield_stress`, 2"
    );
    assert_eq!(
        text(Hardening::table(&[[0.1, 1.0]])),
        "the table must begin at the plastic strain 0"
    );
    assert!(Hardening::table(&[[0.0, 1.0], [0.1, 0.9]]).is_err());
    assert!(Hardening::table(&[]).is_err());
}
