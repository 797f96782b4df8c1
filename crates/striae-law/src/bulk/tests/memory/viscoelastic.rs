//! Viscoelastic rubber against Prony's series.

use super::*;
use nalgebra::Complex;
use striae_verify::fitted_rate;

const BULK: f64 = 50.0;
const BRANCHES: [Branch; 2] = [
    Branch {
        ratio: 0.8,
        time: 0.1,
    },
    Branch {
        ratio: 1.5,
        time: 2.0,
    },
];

fn isochoric() -> Vec<Isochoric> {
    vec![
        Isochoric::NeoHookean { shear: SHEAR },
        Isochoric::MooneyRivlin {
            c10: 0.25,
            c01: 0.05,
        },
        Isochoric::Yeoh {
            c10: 0.3,
            c20: 0.01,
            c30: 0.002,
        },
        Isochoric::Gent {
            shear: SHEAR,
            limit: 20.0,
        },
        Isochoric::ArrudaBoyce {
            mu: 0.5,
            locking_stretch: 3.0,
        },
        Isochoric::Ogden(
            [
                OgdenTerm {
                    mu: 0.3,
                    alpha: 2.5,
                },
                OgdenTerm {
                    mu: -0.1,
                    alpha: -2.0,
                },
            ]
            .into(),
        ),
    ]
}

fn slow(isochoric: Isochoric) -> Hyperelastic {
    Hyperelastic::new(isochoric, BULK, Volumetric::Logarithmic).unwrap()
}

fn viscoelastic(isochoric: Isochoric) -> Material {
    Material::viscoelastic(Viscoelastic::new(slow(isochoric), &BRANCHES).unwrap())
}

fn neo_hookean() -> Material {
    viscoelastic(Isochoric::NeoHookean { shear: SHEAR })
}

/// `G(t)`.
fn modulus(time: f64) -> f64 {
    let branch = |branch: &Branch| branch.ratio * (-time / branch.time).exp();
    SHEAR * (1.0 + BRANCHES.iter().map(branch).sum::<f64>())
}

#[test]
fn all_laws_pass_the_battery() {
    for isochoric in isochoric() {
        assert_eq!(battery(&viscoelastic(isochoric)), []);
    }
}

#[test]
fn stress_relaxes_by_the_series_in_increments_of_any_size() {
    let strain = 1e-5;
    let mut point = Point::at_rest(neo_hookean());
    let mut time = 0.0;
    for elapsed in [0.0, 0.01, 0.5, 3.0, 0.2, 20.0] {
        time += elapsed;
        let stress = point.to(&shear(strain), elapsed).first_piola[(0, 1)];
        let off = stress / (modulus(time) * strain) - 1.0;
        assert!(off.abs() < 1e-9, "{off:.3e} at {time}");
    }
}

#[test]
fn sudden_strains_meet_all_springs_and_slow_ones_the_law_alone() {
    let f = Random::new(5).near_identity(0.4);
    let all = 1.0 + BRANCHES[0].ratio + BRANCHES[1].ratio;
    for isochoric in isochoric() {
        let law = slow(isochoric.clone());
        let elastic = law.response(&f).unwrap();
        let mut point = Point::at_rest(viscoelastic(isochoric));
        let sudden = point.to(&f, 0.0);
        // The volumetric part is what a law with no branch has more than its isochoric one.
        let (j, b) = invariants::inverse(&f).unwrap();
        let volumetric = b * Volumetric::Logarithmic.pressure(BULK, j).0;
        let expected = (elastic.first_piola - volumetric) * all + volumetric;
        assert!((sudden.first_piola - expected).norm() < 1e-11);
        assert_eq!(point.dissipated, 0.0);
        let late = point.to(&f, 1e4);
        assert!((late.first_piola - elastic.first_piola).norm() < 1e-11);
        assert!((late.tangent - elastic.tangent).norm() < 1e-9);
    }
}

#[test]
fn what_is_stored_less_at_rest_is_dissipated() {
    let f = Random::new(6).near_identity(0.4);
    for isochoric in isochoric() {
        let mut point = Point::at_rest(viscoelastic(isochoric));
        let stored = point.to(&f, 0.0).energy;
        for elapsed in [0.01, 0.1, 1.0, 10.0] {
            let now = point.to(&f, elapsed).energy;
            assert!((now + point.dissipated - stored).abs() < 1e-13 * stored);
        }
    }
}

#[test]
fn harmonic_shear_has_storage_and_loss_modulus_with_the_order_of_the_increments() {
    let (amplitude, frequency) = (1e-4, 3.0);
    let branch = |branch: &Branch| {
        let x = frequency * branch.time;
        [x * x, x].map(|part| SHEAR * branch.ratio * part / (1.0 + x * x))
    };
    let [first, second] = BRANCHES.each_ref().map(branch);
    let expected = [SHEAR + first[0] + second[0], first[1] + second[1]];
    let counts = [32, 64, 128, 256];
    let errors = counts.map(|count| {
        let mut point = Point::at_rest(neo_hookean());
        let step = 2.0 * std::f64::consts::PI / count as f64;
        let (periods, mut found) = (24, [0.0; 2]);
        for at in 1..=periods * count {
            let phase = step * at as f64;
            let f = shear(amplitude * phase.sin());
            let stress = point.to(&f, step / frequency).first_piola[(0, 1)];
            if at > (periods - 1) * count {
                let share = 2.0 * stress / (amplitude * count as f64);
                found[0] += share * phase.sin();
                found[1] += share * phase.cos();
            }
        }
        // What `e_1 = exp(-dt/t) (e_0 + change)` gives for harmonic strains.
        let back = Complex::from_polar(1.0, -step);
        let of_scheme = BRANCHES.iter().map(|branch| {
            let left = (-step / (frequency * branch.time)).exp();
            (Complex::from(1.0) - back) * (SHEAR * branch.ratio * left)
                / (Complex::from(1.0) - back * left)
        });
        let of_scheme = of_scheme.sum::<Complex<f64>>() + SHEAR;
        assert!((found[0] - of_scheme.re).hypot(found[1] - of_scheme.im) < 1e-7);
        (found[0] - expected[0]).hypot(found[1] - expected[1])
    });
    let rate = fitted_rate(&counts.map(|count| 1.0 / count as f64), &errors);
    assert!(rate > 0.95, "{rate}: {errors:?}");
}

#[test]
fn a_loop_dissipates_the_area_it_encloses() {
    // Over a period, pi times amplitude squared times the loss modulus.
    let (amplitude, count) = (0.4, 400);
    let mut point = Point::at_rest(neo_hookean());
    let mut work = 0.0;
    let mut dissipated = 0.0;
    let (mut strain, mut stress) = (0.0, 0.0);
    for at in 1..=12 * count {
        if at == 11 * count + 1 {
            (work, dissipated) = (0.0, point.dissipated);
        }
        let now = amplitude * (2.0 * std::f64::consts::PI * at as f64 / count as f64).sin();
        let response = point.to(&shear(now), 1.0 / count as f64);
        let new = response.first_piola[(0, 1)];
        work += 0.5 * (stress + new) * (now - strain);
        (strain, stress) = (now, new);
    }
    let dissipated = point.dissipated - dissipated;
    assert!(
        (dissipated / work - 1.0).abs() < 0.01,
        "{dissipated} {work}"
    );
}

#[test]
fn wrong_branches_are_refused_by_number() {
    let law = slow(Isochoric::NeoHookean { shear: SHEAR });
    assert_eq!(
        Viscoelastic::new(law.clone(), &[]),
        Err(InadmissibleBranch::None)
    );
    let wrong = [
        BRANCHES[0],
        Branch {
            ratio: 0.1,
            time: 0.0,
        },
    ];
    let error = Viscoelastic::new(law, &wrong).unwrap_err().to_string();
    assert_eq!(
        error,
        "`time` of branch 1 is 0, but it must be positive and finite"
    );
}
