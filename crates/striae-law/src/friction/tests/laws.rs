//! The battery on every law, and what is particular to each.

use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use striae_verify::Random;

use super::{slipping, tabulated::tabulated};
use crate::friction::{
    Friction, FrictionError, Kernel, Law, Nap, Orthotropic, RequiredTextures, SlipRule, Textures,
    TwoTextures, battery,
};

#[test]
fn coulomb_passes_the_battery() {
    assert_eq!(battery(&Friction::coulomb(0.3).unwrap()), []);
}

#[test]
fn two_textures_pass_the_battery() {
    for c in [
        [0.1, 0.1, 0.5],
        [0.3, 2.0, 0.5],
        [-0.5, 0.2, -1.5],
        [0.2, -0.1, 0.3],
    ] {
        assert_eq!(
            battery(&Friction::two_textures(0.5, c[0], c[1], c[2]).unwrap()),
            []
        );
    }
}

#[test]
fn orthotropic_passes_the_battery() {
    for rule in [SlipRule::Opposing, SlipRule::Associated] {
        assert_eq!(battery(&Friction::orthotropic(0.2, 0.7, rule).unwrap()), []);
        assert_eq!(battery(&Friction::orthotropic(0.7, 0.2, rule).unwrap()), []);
    }
}

#[test]
fn nap_passes_the_battery() {
    assert_eq!(battery(&Friction::nap(0.11, 0.14, 0.2).unwrap()), []);
    assert_eq!(battery(&Friction::nap(0.1, 0.3, 0.12).unwrap()), []);
}

#[test]
fn tabulated_friction_passes_the_battery() {
    for (angles, mu) in [
        (vec![0.0, 90.0, 180.0, 270.0], vec![0.3, 0.15, 0.1, 0.2]),
        (
            vec![-170.0, -100.0, -40.0, 10.0, 70.0, 95.0, 150.0],
            vec![0.6, 0.2, 0.2, 0.9, 0.35, 0.3, 0.8],
        ),
    ] {
        let friction = tabulated(&angles, &mu).unwrap();
        assert_eq!(battery(&friction), []);
        let decaying = friction.with_decay(0.4, 0.7).unwrap();
        assert_eq!(battery(&decaying), []);
        assert_eq!(battery(&decaying.with_shear_cap(0.2).unwrap()), []);
    }
}

#[test]
fn decay_and_shear_cap_pass_the_battery() {
    let decaying = Friction::two_textures(0.5, 0.1, 0.1, 0.5)
        .unwrap()
        .with_decay(0.4, 0.7)
        .unwrap();
    assert_eq!(battery(&decaying), []);
    assert_eq!(battery(&decaying.with_shear_cap(0.2).unwrap()), []);
}

#[test]
fn all_laws_have_coulomb_friction_as_isotropic_limit() {
    let mut random = Random::new(2);
    for _ in 0..100 {
        let place = Sample::new(&mut random);
        let limits = [
            (Friction::two_textures(0.3, 0.0, 0.0, 2.0), place.both()),
            (Friction::nap(0.3, 0.3, 0.3), place.own()),
            (
                Friction::orthotropic(0.3, 0.3, SlipRule::Opposing),
                place.own(),
            ),
            (
                Friction::orthotropic(0.3, 0.3, SlipRule::Associated),
                place.opposite(),
            ),
        ];
        for (friction, textures) in limits {
            let friction = friction.unwrap();
            assert_eq!(
                friction.kernel(&place.normal, &textures),
                Kernel::identity()
            );
            assert_eq!(friction.cap(2.0, 0.0), 0.6);
        }
    }
}

#[test]
fn opposed_textures_leave_isotropic_friction() {
    let a = Vector3::x();
    let textures = Textures {
        own: Some(a),
        opposite: Some(-a),
    };
    let friction = Friction::two_textures(1.0, 0.1, 0.1, 0.5).unwrap();
    let kernel = friction.kernel(&Vector3::z(), &textures);
    let (l, eta) = (Matrix3::identity() * 0.9, Vector3::zeros());
    assert_eq!((kernel.l, kernel.eta), (l, eta));
}

/// `-tau . d / p` for slip along `d`.
fn coefficient(friction: &Friction, textures: &Textures<f64>, d: &Vector3<f64>) -> f64 {
    let kernel = friction.kernel(&Vector3::z(), textures);
    let cap = friction.cap(1.0, 0.0);
    -slipping(&kernel, cap, d).dot(d)
}

#[test]
fn orthotropic_friction_has_its_coefficients_along_and_across_the_grooves() {
    let (s, a) = (Vector3::x(), Vector3::y());
    for rule in [SlipRule::Opposing, SlipRule::Associated] {
        let friction = Friction::orthotropic(0.2, 0.7, rule).unwrap();
        for textures in one_sided(&a) {
            assert!((coefficient(&friction, &textures, &s) - 0.2).abs() < 1e-15);
            assert!((coefficient(&friction, &textures, &a) - 0.7).abs() < 1e-15);
        }
    }
}

#[test]
fn associated_slip_maximises_dissipation() {
    let surface = Orthotropic::new(0.2, 0.7, SlipRule::Associated)
        .unwrap()
        .slip_surface();
    let tractions = super::dense(&surface);
    for sample in surface.sampled(101) {
        let largest = tractions
            .iter()
            .map(|t| t.traction.dot(&sample.slip))
            .fold(0.0, f64::max);
        assert!(largest <= sample.dissipation() * (1.0 + 1e-12));
        assert!(largest >= sample.dissipation() * (1.0 - 1e-5));
    }
}

#[test]
fn nap_friction_has_its_three_coefficients() {
    let (a, s) = (Vector3::x(), Vector3::y());
    let friction = Friction::nap(0.1, 0.3, 0.15).unwrap();
    for textures in one_sided(&a) {
        assert!((coefficient(&friction, &textures, &-a) - 0.1).abs() < 1e-15);
        assert!((coefficient(&friction, &textures, &a) - 0.3).abs() < 1e-15);
        assert!((coefficient(&friction, &textures, &s) - 0.15).abs() < 1e-15);
        assert!((coefficient(&friction, &textures, &-s) - 0.15).abs() < 1e-15);
    }
}

#[test]
fn free_edges_ahead_meet_more_friction_whichever_side_carries_them() {
    // A block whose scales point along +x slides along +x over a smooth plane:
    // seen from the block, and seen from the plane, which slides along -x under it.
    let friction = Friction::nap(0.1, 0.3, 0.15).unwrap();
    let scales = Vector3::x();
    let block = Textures {
        own: Some(scales),
        opposite: None,
    };
    let plane = Textures {
        own: None,
        opposite: Some(-scales),
    };
    assert!((coefficient(&friction, &block, &Vector3::x()) - 0.3).abs() < 1e-15);
    assert!((coefficient(&friction, &plane, &-Vector3::x()) - 0.3).abs() < 1e-15);
}

#[test]
fn frictionless_contact_carries_no_shear() {
    let friction = Friction::frictionless();
    assert_eq!(friction.law(), &Law::Frictionless);
    assert_eq!(friction.cap(3.0, 1.0), 0.0);
    assert_eq!(friction.required_textures(), RequiredTextures::Any);
    let kernel = friction.kernel(&Vector3::z(), &Textures::none());
    assert_eq!(kernel.traction(0.0, &Vector3::zeros()), Vector3::zeros());
}

#[test]
fn constants_outside_their_range_are_named() {
    let name = |result: Result<Friction, FrictionError>| match result {
        Err(FrictionError::Constant { name, .. }) => name,
        other => panic!("{other:?}"),
    };
    assert_eq!(name(Friction::coulomb(-0.1)), "mu");
    assert_eq!(name(Friction::coulomb(f64::NAN)), "mu");
    assert_eq!(name(Friction::two_textures(-1.0, 0.0, 0.0, 0.0)), "mu");
    assert_eq!(
        name(Friction::two_textures(1.0, 0.0, f64::INFINITY, 0.0)),
        "c_ang"
    );
    assert_eq!(
        name(Friction::orthotropic(0.0, 0.1, SlipRule::Opposing)),
        "mu_along"
    );
    assert_eq!(name(Friction::nap(0.1, 0.1, -0.1)), "mu_lateral");
    assert_eq!(
        name(Friction::frictionless().with_shear_cap(0.0)),
        "shear_cap"
    );
    assert_eq!(
        name(Friction::frictionless().with_decay(-1.0, 1.0)),
        "kinetic_over_static"
    );
    assert_eq!(
        name(Friction::frictionless().with_decay(0.5, 0.0)),
        "slip_rate"
    );
}

fn one_sided(a: &Vector3<f64>) -> [Textures<f64>; 2] {
    [
        Textures {
            own: Some(*a),
            opposite: None,
        },
        Textures {
            own: None,
            opposite: Some(*a),
        },
    ]
}

/// A random normal with two unit tangents.
struct Sample {
    normal: Vector3<f64>,
    tangents: [Vector3<f64>; 2],
}

impl Sample {
    fn new(random: &mut Random) -> Self {
        let normal = random.unit3();
        let mut tangent = || normal.cross(&random.unit3()).normalize();
        let tangents = [tangent(), tangent()];
        Self { normal, tangents }
    }

    fn both(&self) -> Textures<f64> {
        Textures {
            own: Some(self.tangents[0]),
            opposite: Some(self.tangents[1]),
        }
    }

    fn own(&self) -> Textures<f64> {
        Textures {
            own: Some(self.tangents[0]),
            opposite: None,
        }
    }

    fn opposite(&self) -> Textures<f64> {
        Textures {
            own: None,
            opposite: Some(self.tangents[1]),
        }
    }
}

proptest! {
    #[test]
    fn admissible_two_textures_pass_the_battery(
        c in (-0.9..0.9f64, -0.3..1.0f64, -3.0..3.0f64),
    ) {
        let clearly = |law: TwoTextures| law.least_dissipation().value > 0.02;
        prop_assume!(TwoTextures::new(c.0, c.1, c.2).is_ok_and(clearly));
        assert_eq!(battery(&Friction::two_textures(0.4, c.0, c.1, c.2).unwrap()), []);
    }

    #[test]
    fn admissible_naps_pass_the_battery(
        mu in (0.05..1.0f64, 0.05..1.0f64, 0.05..1.0f64),
    ) {
        let clearly = |law: Nap| law.slip_surface().least_dissipation().dissipation() > 0.02;
        prop_assume!(Nap::new(mu.0, mu.1, mu.2).is_ok_and(clearly));
        assert_eq!(battery(&Friction::nap(mu.0, mu.1, mu.2).unwrap()), []);
    }

    #[test]
    fn tables_pass_the_battery(points in super::tabulated::points()) {
        let (angles, mu): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        assert_eq!(battery(&tabulated(&angles, &mu).unwrap()), []);
    }
}
