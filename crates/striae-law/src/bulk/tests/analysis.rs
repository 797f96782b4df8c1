//! Tests of specimens against closed forms.

use super::*;

fn nearly_incompressible(isochoric: Isochoric) -> Material {
    let bulk = 1e7 * isochoric.shear();
    Material::hyperelastic(Hyperelastic::new(isochoric, bulk, Volumetric::Quadratic).unwrap())
}

#[test]
fn nominal_stresses_of_rubber_have_their_closed_forms() {
    let (c10, c01) = (0.2, 0.05);
    let material = nearly_incompressible(Isochoric::MooneyRivlin { c10, c01 });
    let closed: [fn(f64) -> [f64; 2]; 3] = [
        |l| [l - l.powi(-2), 1.0 - l.powi(-3)],
        |l| [l - l.powi(-5), l.powi(3) - l.powi(-3)],
        |l| [l - l.powi(-3), l - l.powi(-3)],
    ];
    for (mode, closed) in Mode::ALL.into_iter().zip(closed) {
        for last in [0.5, 3.0] {
            let states = mode.states(&material, last, 40);
            assert_eq!(states.len(), 40);
            for state in states {
                let [first, second] = closed(state.stretch);
                let expected = 2.0 * (c10 * first + c01 * second);
                let error = (state.nominal - expected).abs();
                // Strains by the pressure are some 1e-6, and large stretches enlarge them.
                assert!(error < 1e-5 * (1.0 + expected.abs()), "{mode:?} {state:?}");
            }
        }
    }
}

#[test]
fn linear_elasticity_has_its_moduli() {
    let (e, nu) = (2.0, 0.3);
    let material = Material::linear_elastic(LameConstants::from_youngs_modulus(e, nu).unwrap());
    let moduli = [e, e / (1.0 - nu), e / (1.0 - nu * nu)];
    for (mode, modulus) in Mode::ALL.into_iter().zip(moduli) {
        for state in mode.states(&material, 1.01, 5) {
            let strain = state.stretch - 1.0;
            assert!((state.nominal - modulus * strain).abs() < 1e-11);
        }
    }
}

#[test]
fn rubber_loses_stability_where_it_is_known_to() {
    // Mooney-Rivlin with a negative c01 softens in equibiaxial tension, neo-Hooke never.
    let (c10, c01) = (0.2, -0.02);
    let unstable = nearly_incompressible(Isochoric::MooneyRivlin { c10, c01 });
    let lost = Mode::Equibiaxial
        .states(&unstable, 3.0, 200)
        .into_iter()
        .find(|state| state.stability <= 0.0)
        .expect("it is lost");
    // By hand, with l_3 = l^-2: the change that lengthens both axes is neutral where
    // c10 (l^2 + 2 l^-4) + c01 (l^-2 + 2 l^4) = 0, which is at l = 2.2492.
    let neutral =
        |l: f64| c10 * (l.powi(2) + 2.0 * l.powi(-4)) + c01 * (l.powi(-2) + 2.0 * l.powi(4));
    let (mut low, mut high) = (1.5, 3.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if neutral(middle) > 0.0 {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    let step = (3.0_f64.ln() / 199.0).exp();
    assert!(
        lost.stretch > low && lost.stretch / step < low,
        "{} after {low}",
        lost.stretch
    );
    let stable = nearly_incompressible(Isochoric::NeoHookean { shear: 0.4 });
    for mode in Mode::ALL {
        for last in [0.3, 4.0] {
            let states = mode.states(&stable, last, 60);
            assert!(states.iter().all(|state| state.stability > 0.0));
        }
    }
}
