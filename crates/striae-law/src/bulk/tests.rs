//! Every bulk law meets the same battery; what is peculiar to one follows below.

use super::*;
use nalgebra::{DMatrix, DVector, SVector};
use num_dual::{DualNum, gradient};
use proptest::prelude::*;
use striae_verify::{Random, assert_derivative};

const LAMBDA: f64 = 1.7;
const SHEAR: f64 = 0.6;

mod analysis;
mod fibrous;
mod memory;
mod rubber;

fn laws() -> [Material; 3] {
    let constants = LameConstants {
        lambda: LAMBDA,
        shear: SHEAR,
    };
    [
        Material::neo_hookean(constants),
        Material::neo_hookean_with(constants, Volumetric::Logarithmic),
        Material::linear_elastic(constants),
    ]
}

fn energy<D: DualNum<Primitive = f64> + Copy>(law: &Material, f: &Matrix3<D>) -> D {
    match law.law() {
        Law::NeoHookean {
            lambda,
            shear,
            volumetric,
        } => neo_hookean::energy(*lambda, *shear, *volumetric, f),
        Law::LinearElastic { lambda, shear } => linear_elastic::energy(*lambda, *shear, f),
        _ => unreachable!("laws of invariants state nothing but their energy"),
    }
}

/// Components in the order of the tangent, row by row.
fn components(f: &Matrix3<f64>) -> DVector<f64> {
    DVector::from_iterator(9, f.transpose().iter().copied())
}

fn matrix(components: &DVector<f64>) -> Matrix3<f64> {
    Matrix3::from_row_slice(components.as_slice())
}

#[test]
fn the_rest_state_is_free_of_energy_and_stress() {
    for law in laws() {
        let rest = law.response(&Matrix3::identity()).unwrap();
        assert_eq!(rest.energy, 0.0);
        assert_eq!(rest.first_piola, Matrix3::zeros());
    }
}

#[test]
fn the_stress_is_the_exact_derivative_of_the_energy() {
    let mut random = Random::new(1);
    for law in laws() {
        for _ in 0..50 {
            let f = random.near_identity(0.3);
            let x = SVector::<f64, 9>::from_iterator(f.transpose().iter().copied());
            let (w, slope) = gradient(|x| energy(&law, &Matrix3::from_fn(|i, j| x[3 * i + j])), &x);
            let response = law.response(&f).unwrap();
            assert!((w - response.energy).abs() < 1e-14);
            assert!((components(&response.first_piola) - slope).norm() < 1e-13);
        }
    }
}

#[test]
fn the_tangent_is_the_derivative_of_the_stress() {
    let mut random = Random::new(2);
    for law in laws() {
        assert_derivative(
            |x| components(&law.response(&matrix(x)).unwrap().first_piola),
            |x| {
                let tangent = law.response(&matrix(x)).unwrap().tangent;
                DMatrix::from_iterator(9, 9, tangent.iter().copied())
            },
            &components(&random.near_identity(0.2)),
        );
    }
}

#[test]
fn small_strains_obey_linear_elasticity() {
    let [quadratic, logarithmic, linear] =
        laws().map(|law| law.response(&Matrix3::identity()).unwrap());
    assert!((quadratic.tangent - linear.tangent).norm() < 1e-15);
    assert!((logarithmic.tangent - linear.tangent).norm() < 1e-15);
}

#[test]
fn a_rotation_of_the_neo_hookean_solid_costs_nothing_and_turns_the_stress() {
    let mut random = Random::new(3);
    let [law, ..] = laws();
    for _ in 0..50 {
        let f = random.near_identity(0.3);
        let q = *random.rotation().matrix();
        let (before, after) = (law.response(&f).unwrap(), law.response(&(q * f)).unwrap());
        assert!((before.energy - after.energy).abs() < 1e-13);
        assert!((q * before.first_piola - after.first_piola).norm() < 1e-13);
        let turned = q * law.cauchy_stress(&f).unwrap() * q.transpose();
        assert!((turned - law.cauchy_stress(&(q * f)).unwrap()).norm() < 1e-12);
    }
}

#[test]
fn uniaxial_strain_has_its_closed_form() {
    // F = diag(s, 1, 1): P_11 = G (s - 1/s) + lambda (s - 1), P_22 = lambda (s - 1) s.
    for stretch in [0.3, 0.9, 1.0, 1.4, 3.0] {
        let f = Matrix3::from_diagonal(&[stretch, 1.0, 1.0].into());
        let p = laws()[0].response(&f).unwrap().first_piola;
        let axial = SHEAR * (stretch - 1.0 / stretch) + LAMBDA * (stretch - 1.0);
        let lateral = LAMBDA * (stretch - 1.0) * stretch;
        let expected = Matrix3::from_diagonal(&[axial, lateral, lateral].into());
        assert!((p - expected).norm() < 1e-13);
    }
}

#[test]
fn simple_shear_has_its_closed_form() {
    // F = I + k e1 e2^T: J = 1, sigma = G (F F^T - I).
    let k = 0.8;
    let mut f = Matrix3::identity();
    f[(0, 1)] = k;
    let sigma = laws()[0].cauchy_stress(&f).unwrap();
    let expected = Matrix3::new(k * k, k, 0.0, k, 0.0, 0.0, 0.0, 0.0, 0.0) * SHEAR;
    assert!((sigma - expected).norm() < 1e-14);
}

#[test]
fn an_inverted_gradient_is_refused_with_its_determinant() {
    let f = Matrix3::from_diagonal(&[-0.5, 1.0, 1.0].into());
    assert_eq!(
        laws()[0].response(&f),
        Err(ResponseError::Inverted { determinant: -0.5 })
    );
    assert!(laws()[0].response(&Matrix3::zeros()).is_err());
    assert!(laws()[0].response(&Matrix3::repeat(f64::NAN)).is_err());
}

#[test]
fn inadmissible_moduli_are_refused() {
    for (e, nu) in [
        (0.0, 0.3),
        (-1.0, 0.3),
        (f64::NAN, 0.3),
        (1.0, 0.5),
        (1.0, -1.0),
    ] {
        assert!(LameConstants::from_youngs_modulus(e, nu).is_err());
    }
}

proptest! {
    #[test]
    fn the_tangent_is_symmetric(seed: u64) {
        let f = Random::new(seed).near_identity(0.3);
        for law in laws() {
            let tangent = law.response(&f).unwrap().tangent;
            prop_assert!((tangent - tangent.transpose()).norm() <= 1e-14 * tangent.norm());
        }
    }

    #[test]
    fn the_cauchy_stress_is_symmetric(seed: u64) {
        let f = Random::new(seed).near_identity(0.3);
        for law in laws() {
            let sigma = law.cauchy_stress(&f).unwrap();
            prop_assert!((sigma - sigma.transpose()).norm() <= 1e-13 * (1.0 + sigma.norm()));
        }
    }

    #[test]
    fn energy_is_never_negative(seed: u64) {
        let f = Random::new(seed).near_identity(0.3);
        for law in laws() {
            prop_assert!(law.response(&f).unwrap().energy >= 0.0);
        }
    }

    #[test]
    fn moduli_go_there_and_back(e in 1e-3..1e12, nu in -0.95..0.499) {
        let constants = LameConstants::from_youngs_modulus(e, nu).unwrap();
        prop_assert!((constants.youngs_modulus() / e - 1.0).abs() < 1e-12);
        prop_assert!((constants.poissons_ratio() - nu).abs() < 1e-12);
    }
}
