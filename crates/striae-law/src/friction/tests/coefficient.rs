//! Coefficient and cap.

use crate::friction::{Friction, PressureDependence, SlipRule};
use num_dual::Dual64;

#[test]
fn coefficient_decays_from_static_to_kinetic() {
    let friction = Friction::coulomb(0.6)
        .unwrap()
        .with_decay(0.5, 2.0)
        .unwrap();
    let mu = |v: f64| friction.coefficient().at_slip_rate(v);
    assert_eq!(mu(0.0), 0.6);
    assert!((mu(2.0) - (0.3 + 0.3 * (-1f64).exp())).abs() < 1e-15);
    assert!((mu(100.0) - 0.3).abs() < 1e-15);
    assert!((0..50).all(|i| mu(0.1 * f64::from(i)) > mu(0.1 * f64::from(i + 1))));
}

#[test]
fn cap_is_the_smaller_of_friction_and_shear_cap() {
    let friction = Friction::coulomb(0.5).unwrap().with_shear_cap(2.0).unwrap();
    assert_eq!(friction.cap(3.0, 0.0), 1.5);
    assert_eq!(friction.cap(4.0, 0.0), 2.0);
    assert_eq!(friction.cap(9.0, 0.0), 2.0);
}

#[test]
fn cap_has_one_sided_slopes_at_its_kinks() {
    let friction = Friction::coulomb(0.5).unwrap().with_shear_cap(2.0).unwrap();
    let slope = |p: f64| {
        friction
            .cap(Dual64::from(p).derivative(), Dual64::from(0.0))
            .eps
    };
    assert_eq!([slope(-1.0), slope(1.0), slope(5.0)], [0.0, 0.5, 0.0]);
}

#[test]
fn open_contact_has_no_cap() {
    let friction = Friction::coulomb(0.5).unwrap();
    assert_eq!(friction.cap(-1.0, 0.0), 0.0);
    assert_eq!(friction.cap(0.0, 0.0), 0.0);
}

#[test]
fn no_direction_pressure_or_slip_rate_exceeds_the_largest_coefficient() {
    let coulomb = || Friction::coulomb(0.3).unwrap();
    let table = PressureDependence::table(&[1.0, 2.0], &[2.0, 0.5]).unwrap();
    for (friction, exact) in [
        (coulomb(), 0.3),
        (coulomb().with_decay(0.5, 2.0).unwrap(), 0.3),
        (coulomb().with_decay(1.5, 2.0).unwrap(), 0.45),
        (coulomb().with_pressure(table), 0.6),
    ] {
        let largest = friction.largest_coefficient();
        assert!((largest - exact).abs() < 1e-12, "{largest}");
        for p in [1e-3, 0.5, 1.0, 1.5, 3.0] {
            for v in [0.0, 0.1, 10.0] {
                let cap = friction.cap(p, v);
                assert!(cap <= largest * p * (1.0 + 1e-12), "{p} {v}: {cap}");
            }
        }
    }
    let orthotropic = Friction::orthotropic(0.2, 0.7, SlipRule::Associated).unwrap();
    assert!((orthotropic.largest_coefficient() - 0.7).abs() < 1e-4);
}
