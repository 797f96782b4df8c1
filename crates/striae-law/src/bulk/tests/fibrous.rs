//! Fibres: the battery, closed forms and limits.

use super::*;
use nalgebra::{Rotation3, Vector3};
use std::f64::consts::FRAC_PI_6;

const K1: f64 = 0.9;
const K2: f64 = 1.3;

fn along(direction: [f64; 3]) -> Direction {
    Direction::Uniform(direction.into())
}

fn exponential(dispersion: f64) -> FibreStiffness {
    FibreStiffness::Exponential {
        k1: K1,
        k2: K2,
        dispersion,
    }
}

fn rubber() -> Material {
    let isochoric = Isochoric::NeoHookean { shear: SHEAR };
    Material::hyperelastic(Hyperelastic::new(isochoric, 30.0, Volumetric::Logarithmic).unwrap())
}

fn fibrous(ground: Material, families: &[Fibres]) -> Material {
    Material::fibrous(Fibrous::new(ground, families).unwrap())
}

fn family(stiffness: FibreStiffness, direction: [f64; 3]) -> Fibres {
    Fibres {
        stiffness,
        direction: along(direction),
    }
}

#[test]
fn all_kinds_of_fibres_pass_the_battery() {
    let [ground, ..] = laws();
    let linear = FibreStiffness::Linear { modulus: 2.3 };
    let quadratic = FibreStiffness::Exponential {
        k1: K1,
        k2: 0.0,
        dispersion: 0.1,
    };
    let crossed = [
        family(exponential(0.1), [1.0, 0.4, 0.0]),
        family(exponential(0.1), [1.0, -0.4, 0.2]),
    ];
    for material in [
        fibrous(ground.clone(), &[family(linear, [0.3, 0.5, -1.0])]),
        fibrous(ground, &[family(exponential(0.0), [0.0, 1.0, 0.3])]),
        fibrous(rubber(), &crossed),
        fibrous(rubber(), &[family(quadratic, [1.0, 1.0, 0.0])]),
    ] {
        assert_eq!(battery(&material), []);
    }
}

/// `sigma_11 - sigma_22` and `sigma_22 - sigma_33` at stretches without change of volume.
fn differences(material: &Material, stretches: [f64; 3]) -> [f64; 2] {
    let f = Matrix3::from_diagonal(&stretches.into());
    let sigma = material.cauchy_stress(&f).unwrap();
    [sigma[(0, 0)] - sigma[(1, 1)], sigma[(1, 1)] - sigma[(2, 2)]]
}

#[test]
fn tension_along_and_across_exponential_fibres_has_its_closed_form() {
    // With J = 1 the differences of the principal stresses know no pressure.
    for dispersion in [0.0, 0.1, 0.3] {
        let material = fibrous(
            rubber(),
            &[family(exponential(dispersion), [2.0, 0.0, 0.0])],
        );
        let (k, rest) = (dispersion, 1.0 - 3.0 * dispersion);
        for stretch in [0.7_f64, 0.95, 1.2, 1.5] {
            let (square, side) = (stretch * stretch, 1.0 / stretch);
            // First along the fibres, then across them.
            for (fibre, stretches) in [
                (square, [stretch, side.sqrt(), side.sqrt()]),
                (side, [side.sqrt(), stretch, side.sqrt()]),
            ] {
                let strain = k * (square + 2.0 * side - 3.0) + rest * (fibre - 1.0);
                let strain = strain.max(0.0);
                let slope = K1 * strain * (K2 * strain * strain).exp();
                let stress = |at: usize| {
                    let square = stretches[at] * stretches[at];
                    let own = if at == 0 { rest } else { 0.0 };
                    (SHEAR + 2.0 * slope * (k + own)) * square
                };
                let expected = [stress(0) - stress(1), stress(1) - stress(2)];
                let found = differences(&material, stretches);
                for (found, expected) in found.iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-13, "{found} {expected}");
                }
            }
        }
    }
}

#[test]
fn uniaxial_strain_along_and_across_linear_fibres_has_its_closed_form() {
    let [ground, ..] = laws();
    let modulus = 2.3;
    let linear = FibreStiffness::Linear { modulus };
    let material = fibrous(ground.clone(), &[family(linear, [0.0, 0.0, 1.0])]);
    for stretch in [0.6, 1.0, 1.7] {
        for axis in 0..3 {
            let mut stretches = [1.0; 3];
            stretches[axis] = stretch;
            let f = Matrix3::from_diagonal(&stretches.into());
            let [own, plain] =
                [&material, &ground].map(|law| law.response(&f).unwrap().first_piola);
            let fibres = if axis == 2 {
                0.5 * modulus * stretch * (stretch * stretch - 1.0)
            } else {
                0.0
            };
            let mut expected = plain;
            expected[(2, 2)] += fibres;
            assert!((own - expected).norm() < 1e-14);
        }
    }
    let rest = material.response(&Matrix3::identity()).unwrap().tangent;
    let plain = ground.response(&Matrix3::identity()).unwrap().tangent;
    assert!((rest[(8, 8)] - plain[(8, 8)] - modulus).abs() < 1e-14);
}

#[test]
fn fibres_in_all_directions_are_isotropic() {
    let mut random = Random::new(9);
    let even = exponential(1.0 / 3.0);
    let one = fibrous(rubber(), &[family(even, [1.0, 0.0, 0.0])]);
    let other = fibrous(rubber(), &[family(even, [0.2, -1.0, 3.0])]);
    for _ in 0..20 {
        let f = random.near_identity(0.3);
        let [one, other] = [&one, &other].map(|law| law.response(&f).unwrap());
        assert!((one.first_piola - other.first_piola).norm() < 1e-13);
        assert!((one.tangent - other.tangent).norm() < 1e-12);
    }
}

#[test]
fn turning_fibres_and_body_together_turns_nothing_else() {
    let mut random = Random::new(4);
    let direction = Vector3::new(0.3, -0.7, 0.5);
    for _ in 0..20 {
        let (f, q) = (random.near_identity(0.3), *random.rotation().matrix());
        let here = fibrous(rubber(), &[family(exponential(0.05), direction.into())]);
        let turned = fibrous(
            rubber(),
            &[family(exponential(0.05), (q * direction).into())],
        );
        let [before, after] = [
            here.response(&f).unwrap().first_piola,
            turned.response(&(f * q.transpose())).unwrap().first_piola,
        ];
        assert!((before * q.transpose() - after).norm() < 1e-12);
    }
}

#[test]
fn slack_fibres_leave_the_ground() {
    let material = fibrous(rubber(), &[family(exponential(0.0), [1.0, 0.0, 0.0])]);
    let f = Matrix3::from_diagonal(&[0.8, 1.1, 1.1].into());
    assert_eq!(material.response(&f), rubber().response(&f));
}

#[test]
fn fibres_about_an_axis_have_their_directions() {
    let (point, axis) = (Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 3.0));
    let about = |lines| Direction::About { point, axis, lines };
    let place = Vector3::new(1.0, 2.0, 5.0);
    let (turn, e) = (FRAC_PI_6, Vector3::y());
    let turned = |v: Vector3<f64>| Rotation3::new(e * turn) * v;
    for (lines, expected) in [
        (LinesAbout::Radial, e),
        (LinesAbout::Axial { turn: 0.0 }, Vector3::z()),
        (LinesAbout::Axial { turn }, turned(Vector3::z())),
        (LinesAbout::Circumferential { turn: 0.0 }, -Vector3::x()),
        (LinesAbout::Circumferential { turn }, turned(-Vector3::x())),
    ] {
        let found = about(lines).at(&place);
        assert!((found - expected).norm() < 1e-15, "{lines:?} {found}");
    }
    let on_axis = about(LinesAbout::Radial).at(&point);
    assert!((on_axis.norm() - 1.0).abs() < 1e-15 && on_axis.z == 0.0);
}

#[test]
fn inadmissible_fibres_are_refused() {
    let refused = |ground: Material, families: &[Fibres]| {
        Fibrous::new(ground, families).unwrap_err().to_string()
    };
    let x = [1.0, 0.0, 0.0];
    assert_eq!(
        refused(rubber(), &[]),
        "there is no family of fibres, but at least one is needed"
    );
    assert_eq!(
        refused(rubber(), &[family(exponential(0.4), x)]),
        "`dispersion` of family 0 is 0.4, but it must be from 0 to 1/3"
    );
    assert_eq!(
        refused(
            rubber(),
            &[family(FibreStiffness::Linear { modulus: -1.0 }, x)]
        ),
        "`modulus` of family 0 is -1, but it must be positive"
    );
    assert_eq!(
        refused(rubber(), &[family(exponential(0.1), [0.0; 3])]),
        "the direction of family 0 is the zero vector or not finite"
    );
    let [.., linear] = laws();
    assert_eq!(
        refused(linear, &[family(exponential(0.1), x)]),
        "fibres need a neo-Hookean solid or rubber without relaxation around them, not a solid that is linear elastic"
    );
    let material = fibrous(rubber(), &[family(exponential(0.0), x)]);
    let far = Matrix3::from_diagonal(&[6.0, 0.4, 0.4].into());
    assert!(matches!(
        material.response(&far),
        Err(ResponseError::OverstretchedFibres { .. })
    ));
}
