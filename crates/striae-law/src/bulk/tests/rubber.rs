//! Rubber against closed forms, sources and the battery.

use super::*;

/// Constants of moderate size for every isochoric law.
fn laws() -> Vec<Isochoric> {
    vec![
        Isochoric::NeoHookean { shear: 0.6 },
        Isochoric::MooneyRivlin {
            c10: 0.2,
            c01: 0.05,
        },
        Isochoric::Yeoh {
            c10: 0.3,
            c20: -0.01,
            c30: 0.002,
        },
        Isochoric::Gent {
            shear: 0.5,
            limit: 30.0,
        },
        Isochoric::ArrudaBoyce {
            mu: 0.4,
            locking_stretch: 3.0,
        },
        ogden(),
    ]
}

/// The constants of Ogden (1972) for Treloar's rubber, in N/mm^2.
fn ogden() -> Isochoric {
    let term = |mu, alpha| OgdenTerm { mu, alpha };
    Isochoric::Ogden(Box::new([
        term(0.63, 1.3),
        term(0.0012, 5.0),
        term(-0.01, -2.0),
    ]))
}

fn rubber(isochoric: Isochoric) -> Hyperelastic {
    Hyperelastic::new(isochoric, 20.0, Volumetric::Quadratic).unwrap()
}

/// `(l dW/dl)/2` pieces: `dW/dI1` and `dW/dI2` at isochoric invariants, by hand.
fn slopes(law: &Isochoric, i1: f64) -> (f64, f64) {
    let strain = i1 - 3.0;
    match *law {
        Isochoric::NeoHookean { shear } => (0.5 * shear, 0.0),
        Isochoric::MooneyRivlin { c10, c01 } => (c10, c01),
        Isochoric::Yeoh { c10, c20, c30 } => {
            (c10 + 2.0 * c20 * strain + 3.0 * c30 * strain * strain, 0.0)
        }
        Isochoric::Gent { shear, limit } => (0.5 * shear * limit / (limit - strain), 0.0),
        Isochoric::ArrudaBoyce {
            mu,
            locking_stretch: l,
        } => {
            let series = 0.5
                + i1 / (10.0 * l.powi(2))
                + 33.0 * i1.powi(2) / (1050.0 * l.powi(4))
                + 76.0 * i1.powi(3) / (7000.0 * l.powi(6))
                + 2595.0 * i1.powi(4) / (673_750.0 * l.powi(8));
            (mu * series, 0.0)
        }
        Isochoric::Ogden(_) | Isochoric::Own(_) => unreachable!("not a law of invariants"),
    }
}

/// Differences `sigma_1 - sigma_3` and `sigma_2 - sigma_3` of an incompressible solid.
fn closed_form(law: &Isochoric, l: [f64; 3]) -> [f64; 2] {
    if let Isochoric::Ogden(terms) = law {
        let difference = |a: usize| {
            let term = |t: &OgdenTerm| t.mu * (l[a].powf(t.alpha) - l[2].powf(t.alpha));
            terms.iter().map(term).sum()
        };
        return [0, 1].map(difference);
    }
    let (w1, w2) = slopes(law, l.iter().map(|l| l * l).sum());
    [0, 1].map(|a| {
        let square = l[a].powi(2) - l[2].powi(2);
        2.0 * w1 * square - 2.0 * w2 * (l[a].powi(-2) - l[2].powi(-2))
    })
}

#[test]
fn uniaxial_equibiaxial_and_planar_stresses_have_their_closed_forms() {
    for law in laws() {
        for l in [0.5, 0.8, 1.0, 1.3, 2.0] {
            let states = [
                [l, l.powf(-0.5), l.powf(-0.5)],
                [l, l, l.powi(-2)],
                [l, 1.0, 1.0 / l],
            ];
            for stretches in states {
                let f = Matrix3::from_diagonal(&stretches.into());
                let material = Material::hyperelastic(rubber(law.clone()));
                let sigma = material.cauchy_stress(&f).unwrap();
                let found = [0, 1].map(|a| sigma[(a, a)] - sigma[(2, 2)]);
                for (found, expected) in found.iter().zip(closed_form(&law, stretches)) {
                    assert!(
                        (found - expected).abs() < 1e-12 * (1.0 + expected.abs()),
                        "{}: {found} for {expected} at {stretches:?}",
                        law.name()
                    );
                }
            }
        }
    }
}

#[test]
fn simple_shear_has_its_closed_form() {
    // sigma_12 = 2 (W_1 + W_2) k for any isochoric energy; Ogden by its principal stretches.
    let k = 0.7_f64;
    let mut f = Matrix3::identity();
    f[(0, 1)] = k;
    for law in laws() {
        let material = Material::hyperelastic(rubber(law.clone()));
        let sigma = material.cauchy_stress(&f).unwrap();
        let expected = if let Isochoric::Ogden(terms) = &law {
            let l = 0.5 * (k + (k * k + 4.0).sqrt());
            let term = |t: &OgdenTerm| t.mu * (l.powf(t.alpha) - l.powf(-t.alpha));
            terms.iter().map(term).sum::<f64>() / (l + 1.0 / l)
        } else {
            let (w1, w2) = slopes(&law, 3.0 + k * k);
            2.0 * (w1 + w2) * k
        };
        assert!((sigma[(0, 1)] - expected).abs() < 1e-13, "{}", law.name());
    }
}

#[test]
fn pressure_follows_the_volumetric_energy_alone() {
    let l = 0.9_f64;
    let j = l.powi(3);
    for law in laws() {
        for (volumetric, expected) in [
            (Volumetric::Quadratic, 20.0 * (j - 1.0)),
            (Volumetric::Logarithmic, 20.0 * j.ln() / j),
        ] {
            let law = Hyperelastic::new(law.clone(), 20.0, volumetric).unwrap();
            let sigma = Material::hyperelastic(law)
                .cauchy_stress(&(Matrix3::identity() * l))
                .unwrap();
            assert!((sigma - Matrix3::identity() * expected).norm() < 1e-12);
        }
    }
}

#[test]
fn every_law_passes_the_battery_and_obeys_linear_elasticity_at_rest() {
    for law in laws() {
        let material = Material::hyperelastic(rubber(law));
        assert_eq!(battery(&material), [], "{}", material.name());
        let linear = Material::linear_elastic(material.lame_constants());
        let [found, expected] =
            [&material, &linear].map(|law| law.response(&Matrix3::identity()).unwrap().tangent);
        let share = (found - expected).norm() / expected.norm();
        assert!(share < 1e-12, "{}: {share:e}", material.name());
    }
}

#[test]
fn the_shear_modulus_of_the_eight_chain_model_is_that_of_its_source() {
    let l = 2.5_f64;
    let law = Isochoric::ArrudaBoyce {
        mu: 1.0,
        locking_stretch: l,
    };
    let expected = 1.0
        + 3.0 / (5.0 * l.powi(2))
        + 99.0 / (175.0 * l.powi(4))
        + 513.0 / (875.0 * l.powi(6))
        + 42_039.0 / (67_375.0 * l.powi(8));
    assert!((law.shear() - expected).abs() < 1e-14);
}

#[test]
fn ogdens_tangent_is_exact_where_stretches_nearly_coincide() {
    let material = Material::hyperelastic(rubber(ogden()));
    for apart in [0.0, 1e-14, 1e-10, 1e-6, 1e-3] {
        let mut random = Random::new(4);
        let q = *random.rotation().matrix();
        let f = q * Matrix3::from_diagonal(&[1.2, 1.2 * (1.0 + apart), 0.8].into());
        assert_derivative(
            |x| components(&material.response(&matrix(x)).unwrap().first_piola),
            |x| {
                let tangent = material.response(&matrix(x)).unwrap().tangent;
                DMatrix::from_iterator(9, 9, tangent.iter().copied())
            },
            &components(&f),
        );
    }
}

#[test]
fn gents_law_ends_where_chains_are_straight() {
    let law = rubber(Isochoric::Gent {
        shear: 1.0,
        limit: 5.0,
    });
    let material = Material::hyperelastic(law);
    let stretched = |l: f64| Matrix3::from_diagonal(&[l, l.powf(-0.5), l.powf(-0.5)].into());
    assert!(material.response(&stretched(2.5)).is_ok());
    let error = material.response(&stretched(3.0)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the invariant I1 - 3 is 6.666667e0, but the law ends at 5.000000e0"
    );
}

#[test]
fn constants_that_make_no_solid_are_refused() {
    let refused = |isochoric: Isochoric| {
        Hyperelastic::with_poissons_ratio(isochoric, 0.49, Volumetric::Quadratic).unwrap_err()
    };
    let ogden = |mu, alpha| Isochoric::Ogden(Box::new([OgdenTerm { mu, alpha }]));
    assert_eq!(
        refused(Isochoric::MooneyRivlin {
            c10: 0.1,
            c01: -0.2
        }),
        InadmissibleHyperelastic::Shear(-0.2)
    );
    assert_eq!(
        refused(ogden(1.0, 0.0)),
        InadmissibleHyperelastic::NoExponent(0)
    );
    assert_eq!(
        refused(ogden(-1.0, 2.0)),
        InadmissibleHyperelastic::Shear(-1.0)
    );
    assert_eq!(
        refused(Isochoric::Ogden(Box::new([]))),
        InadmissibleHyperelastic::NoTerm
    );
    assert_eq!(
        refused(Isochoric::ArrudaBoyce {
            mu: 1.0,
            locking_stretch: 1.0
        }),
        InadmissibleHyperelastic::Locked(1.0)
    );
    let shear = Isochoric::NeoHookean { shear: 1.0 };
    assert!(Hyperelastic::with_poissons_ratio(shear.clone(), 0.5, Volumetric::Quadratic).is_err());
    assert!(Hyperelastic::new(shear, f64::NAN, Volumetric::Quadratic).is_err());
}

#[test]
fn the_battery_finds_a_wrong_stress_a_wrong_tangent_and_a_lost_rotation() {
    /// Neo-Hooke with one piece spoilt.
    #[derive(Debug)]
    struct Spoilt(fn(&mut Response));

    impl BulkLaw for Spoilt {
        fn name(&self) -> &str {
            "spoilt"
        }

        fn response(&self, f: &Matrix3<f64>) -> Result<Response, ResponseError> {
            let mut response = super::laws()[0].response(f)?;
            (self.0)(&mut response);
            Ok(response)
        }

        fn lame_constants(&self) -> LameConstants {
            super::laws()[0].lame_constants()
        }
    }

    assert_eq!(battery(&Material::own(Spoilt(|_| {}))), []);
    let found = |spoil: fn(&mut Response)| battery(&Material::own(Spoilt(spoil)));
    let energy = found(|response| response.energy *= 1.01);
    assert!(matches!(&energy[..], [Violation::Stress(_)]), "{energy:?}");
    let tangent = found(|response| response.tangent[(1, 1)] *= 1.01);
    assert!(
        matches!(&tangent[..], [Violation::Tangent(_)]),
        "{tangent:?}"
    );
    let skew = found(|response| response.tangent[(1, 0)] += 0.01);
    assert!(
        matches!(&skew[..], [Violation::Tangent(_), Violation::Asymmetric(_)]),
        "{skew:?}"
    );
    let rest = found(|response| response.energy += 0.01);
    assert!(matches!(&rest[..], [Violation::Rest { .. }]), "{rest:?}");
    let linear = battery(&super::laws()[2]);
    assert!(
        matches!(&linear[..], [Violation::NotObjective { .. }]),
        "{linear:?}"
    );
}

/// The neo-Hookean energy of half a shear modulus, up to a limit.
#[derive(Debug)]
struct Ending(f64);

impl IsochoricLaw for Ending {
    fn name(&self) -> &str {
        "ending"
    }

    fn shear(&self) -> f64 {
        2.0 * self.0
    }

    fn energy(&self, i1: Invariant, _: Invariant) -> Invariant {
        (i1 - 3.0) * self.0
    }

    fn limit(&self) -> Option<f64> {
        Some(0.5)
    }
}

#[test]
fn an_energy_from_outside_is_that_of_the_crate_with_the_same_formula() {
    let mut random = Random::new(7);
    let (own, known) = (
        rubber(Isochoric::own(Ending(0.3))),
        rubber(Isochoric::NeoHookean { shear: 0.6 }),
    );
    assert_eq!(own.lame_constants(), known.lame_constants());
    assert_eq!(own, rubber(Isochoric::own(Ending(0.3))));
    assert_ne!(own, rubber(Isochoric::own(Ending(0.4))));
    let branch = Branch {
        ratio: 0.5,
        time: 1.0,
    };
    let relaxing = |law| Material::viscoelastic(Viscoelastic::new(law, &[branch]).unwrap());
    for [own, known] in [
        [own.clone(), known.clone()].map(Material::hyperelastic),
        [own, known].map(relaxing),
    ] {
        assert_eq!(battery(&own), []);
        for _ in 0..20 {
            let f = random.near_identity(0.1);
            let [own, known] = [&own, &known].map(|law| law.response(&f).unwrap());
            assert!((own.energy - known.energy).abs() < 1e-15);
            assert!((own.first_piola - known.first_piola).norm() < 1e-14);
            assert!((own.tangent - known.tangent).norm() < 1e-13);
        }
        let far = Matrix3::from_diagonal(&[2.0, 0.7, 0.7].into());
        let refused = own.response(&far);
        assert!(matches!(
            refused,
            Err(ResponseError::Overstretched { limit: 0.5, .. })
        ));
    }
}
