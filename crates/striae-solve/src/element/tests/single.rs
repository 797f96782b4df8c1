//! One element: derivatives, rigid motions, mass, stress, faults.

use super::*;
use crate::element::{
    ElementError, ReferenceElement, UNKNOWNS, redistributed, response, von_mises,
};
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen};
use striae_verify::assert_derivative;

fn unknowns(x: &[Vec3; 8]) -> DVector<f64> {
    DVector::from_iterator(UNKNOWNS, x.iter().flat_map(|x| x.iter().copied()))
}

fn corners(unknowns: &DVector<f64>) -> [Vec3; 8] {
    std::array::from_fn(|a| unknowns.fixed_rows::<3>(3 * a).into())
}

fn stiffness_matrix(stiffness: &[f64]) -> DMatrix<f64> {
    DMatrix::from_row_slice(UNKNOWNS, UNKNOWNS, stiffness)
}

#[test]
fn the_force_is_the_derivative_of_the_energy() {
    let mut random = Random::new(11);
    let reference = distorted_cube(&mut random, 0.15);
    let x = unknowns(&disturbed(&mut random, &reference, 0.1));
    let at = |x: &DVector<f64>| response(&reference, &corners(x), &neo_hookean()).unwrap();
    assert_derivative(
        |x| DVector::from_element(1, at(x).energy),
        |x| DMatrix::from_row_slice(1, UNKNOWNS, &at(x).force),
        &x,
    );
}

#[test]
fn the_stiffness_is_the_derivative_of_the_force() {
    let mut random = Random::new(12);
    for material in [neo_hookean(), linear_elastic()] {
        let reference = distorted_cube(&mut random, 0.15);
        let x = unknowns(&disturbed(&mut random, &reference, 0.1));
        let at = |x: &DVector<f64>| response(&reference, &corners(x), &material).unwrap();
        assert_derivative(
            |x| DVector::from_row_slice(&at(x).force),
            |x| stiffness_matrix(&at(x).stiffness.by_rows()),
            &x,
        );
    }
}

#[test]
fn the_stiffness_is_symmetric_to_the_last_bit() {
    let mut random = Random::new(13);
    let reference = distorted_cube(&mut random, 0.15);
    let current = disturbed(&mut random, &reference, 0.1);
    let k = stiffness_matrix(
        &response(&reference, &current, &neo_hookean())
            .unwrap()
            .stiffness
            .by_rows(),
    );
    assert_eq!(k, k.transpose());
}

#[test]
fn at_rest_exactly_the_six_rigid_modes_cost_nothing() {
    let mut random = Random::new(14);
    for material in [neo_hookean(), linear_elastic()] {
        let reference = distorted_cube(&mut random, 0.15);
        let k = stiffness_matrix(
            &response(&reference, &reference, &material)
                .unwrap()
                .stiffness
                .by_rows(),
        );
        let mut values: Vec<f64> = SymmetricEigen::new(k.clone())
            .eigenvalues
            .iter()
            .copied()
            .collect();
        values.sort_by(f64::total_cmp);
        assert!(values[..6].iter().all(|v| v.abs() < 1e-14), "{values:?}");
        assert!(values[6] > 1e-3, "{values:?}");
        for axis in 0..3 {
            let mut unit = Vec3::zeros();
            unit[axis] = 1.0;
            assert!((&k * unknowns(&[unit; 8])).norm() < 1e-14);
            assert!((&k * unknowns(&reference.map(|x| unit.cross(&x)))).norm() < 1e-14);
        }
    }
}

#[test]
fn a_rigid_motion_turns_the_force_and_costs_nothing() {
    let mut random = Random::new(15);
    let reference = distorted_cube(&mut random, 0.15);
    let current = disturbed(&mut random, &reference, 0.1);
    let (q, shift) = (random.rotation(), random.vector3());
    let moved = current.map(|x| q * x + shift);
    let before = response(&reference, &current, &neo_hookean()).unwrap();
    let after = response(&reference, &moved, &neo_hookean()).unwrap();
    assert!((before.energy - after.energy).abs() < 1e-14);
    for a in 0..8 {
        let force = |r: &[f64; UNKNOWNS]| Vec3::from_column_slice(&r[3 * a..3 * a + 3]);
        assert!((q * force(&before.force) - force(&after.force)).norm() < 1e-14);
    }
}

#[test]
fn internal_forces_balance() {
    let mut random = Random::new(16);
    let reference = distorted_cube(&mut random, 0.15);
    let current = disturbed(&mut random, &reference, 0.1);
    let force = corners(&DVector::from_row_slice(
        &response(&reference, &current, &neo_hookean())
            .unwrap()
            .force,
    ));
    let moment: Vec3 = (0..8).map(|a| current[a].cross(&force[a])).sum();
    assert!(force.iter().sum::<Vec3>().norm() < 1e-15);
    assert!(moment.norm() < 1e-15);
}

#[test]
fn a_homogeneous_deformation_has_the_energy_and_stress_of_the_law() {
    let mut random = Random::new(17);
    let reference = distorted_cube(&mut random, 0.15);
    let f = random.near_identity(0.2);
    let current = reference.map(|x| f * x);
    let element = ReferenceElement::new(&reference).unwrap();
    let law = neo_hookean().response(&f).unwrap();
    let energy = element.response(&current, &neo_hookean()).unwrap().energy;
    assert!((energy - law.energy * element.volume()).abs() < 1e-15);
    let sigma = neo_hookean().cauchy_stress(&f).unwrap();
    for stress in element.gauss_stress(&current, &neo_hookean()).unwrap() {
        assert!((stress - sigma).norm() < 1e-14);
    }
}

#[test]
fn the_mass_is_that_of_the_closed_form_on_a_parallelepiped() {
    // m_ab = rho V prod_j (1 + xi_aj xi_bj / 3) / 4.
    let mut random = Random::new(18);
    let map = random.near_identity(0.3);
    let element =
        ReferenceElement::new(&distorted_cube(&mut random, 0.0).map(|x| map * x)).unwrap();
    let volume = map.determinant();
    assert!((element.volume() - volume).abs() < 1e-15);
    let mass = element.mass(2.5);
    for (a, corner_a) in crate::element::shape::CORNERS.iter().enumerate() {
        for (b, corner_b) in crate::element::shape::CORNERS.iter().enumerate() {
            let share: f64 = (0..3)
                .map(|j| (1.0 + corner_a[j] * corner_b[j] / 3.0) / 4.0)
                .product();
            assert!((mass[a][b] - 2.5 * volume * share).abs() < 1e-15);
        }
    }
}

#[test]
fn von_mises_stress_is_that_of_uniaxial_tension_and_of_shear() {
    let tension = Matrix3::from_diagonal(&[-3.0, 0.0, 0.0].into());
    assert!((von_mises(&(tension + Matrix3::identity() * 7.0)) - 3.0).abs() < 1e-14);
    let shear = Matrix3::new(0.0, 2.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert!((von_mises(&shear) - 2.0 * 3f64.sqrt()).abs() < 1e-14);
}

#[test]
fn faults_name_the_configuration() {
    let mut random = Random::new(19);
    let cube = distorted_cube(&mut random, 0.0);
    let flipped = cube.map(|x| Vec3::new(x.x, x.y, -x.z));
    assert!(matches!(
        ReferenceElement::new(&flipped),
        Err(ElementError::Degenerate { gauss_point: 0, determinant }) if (determinant + 0.125).abs() < 1e-15
    ));
    assert!(matches!(
        response(&cube, &flipped, &neo_hookean()),
        Err(ElementError::Inverted { gauss_point: 0, determinant }) if (determinant + 1.0).abs() < 1e-15
    ));
}

#[test]
fn corners_without_mass_leave_the_whole_mass_to_the_others() {
    let mut random = Random::new(23);
    let element = ReferenceElement::new(&distorted_cube(&mut random, 0.1)).unwrap();
    let mass = element.mass(2.5);
    let face = [true, true, true, true, false, false, false, false];
    let (corner, mut one) = (
        [false, true, true, true, true, true, true, true],
        [false; 8],
    );
    one[5] = true;
    for massless in [face, corner, one] {
        let moved = redistributed(&mass, &massless);
        let total: f64 = moved.iter().flatten().sum();
        assert!((total - 2.5 * element.volume()).abs() < 1e-14);
        for a in 0..8 {
            for b in 0..8 {
                assert!((moved[a][b] - moved[b][a]).abs() < 1e-15);
                assert!(!(massless[a] || massless[b]) || moved[a][b] == 0.0);
            }
        }
    }
    // Along edges: the corner above gets all of the one below.
    let moved = redistributed(&mass, &face);
    let sum = mass[0][0] + mass[0][4] + mass[4][0] + mass[4][4];
    assert!((moved[4][4] - sum).abs() < 1e-15);
}
