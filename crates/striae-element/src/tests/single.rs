//! One element: derivatives, rigid motions, stress, faults.

use super::*;
use crate::{ElementError, von_mises};
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen};
use striae_verify::assert_derivative;

fn unknowns(x: &[Vec3]) -> DVector<f64> {
    DVector::from_iterator(3 * x.len(), x.iter().flat_map(|x| x.iter().copied()))
}

fn corners(unknowns: &DVector<f64>) -> Vec<Vec3> {
    let corners = unknowns.as_slice().chunks_exact(3);
    corners.map(Vec3::from_column_slice).collect()
}

fn stiffness_matrix(response: &ElementResponse) -> DMatrix<f64> {
    let unknowns = 3 * response.force.len();
    DMatrix::from_row_slice(unknowns, unknowns, &response.stiffness.by_rows())
}

pub(super) fn each_kind() -> impl Iterator<Item = (CellKind, Formulation)> {
    let kinds = CellKind::ALL.into_iter();
    kinds.flat_map(|kind| FORMULATIONS.map(|formulation| (kind, formulation)))
}

/// Calls `check` with a distorted element of every kind and formulation.
fn each(seed: u64, mut check: impl FnMut(&mut Random, Single)) {
    for (kind, formulation) in each_kind() {
        let mut random = Random::new(seed);
        let single = Single::distorted(kind, formulation, &mut random, 0.12);
        check(&mut random, single);
    }
}

#[test]
fn the_force_is_the_derivative_of_the_energy() {
    each(11, |random, single| {
        let x = unknowns(&single.disturbed(random, 0.1));
        let at = |x: &DVector<f64>| single.response(&corners(x), &neo_hookean());
        assert_derivative(
            |x| DVector::from_element(1, at(x).energy),
            |x| DMatrix::from_row_slice(1, x.len(), at(x).force.as_flattened()),
            &x,
        );
    });
}

#[test]
fn at_rest_exactly_the_six_rigid_modes_cost_nothing() {
    for material in [neo_hookean(), linear_elastic()] {
        each(14, |_, single| {
            let x = &single.reference;
            let k = stiffness_matrix(&single.response(x, &material));
            let values = SymmetricEigen::new(k.clone()).eigenvalues;
            let mut values: Vec<f64> = values.iter().copied().collect();
            values.sort_by(f64::total_cmp);
            let (rigid, others) = values.split_at(6);
            assert!(rigid.iter().all(|v| v.abs() < 1e-14), "{values:?}");
            assert!(others[0] > 1e-3, "{}: {values:?}", single.kind);
            for axis in 0..3 {
                let mut unit = Vec3::zeros();
                unit[axis] = 1.0;
                let turned: Vec<Vec3> = x.iter().map(|x| unit.cross(x)).collect();
                assert!((&k * unknowns(&vec![unit; x.len()])).norm() < 1e-14);
                assert!((&k * unknowns(&turned)).norm() < 1e-14);
            }
        });
    }
}

#[test]
fn a_rigid_motion_turns_the_force_and_costs_nothing() {
    each(15, |random, single| {
        let x = single.disturbed(random, 0.1);
        let (q, shift) = (random.rotation(), random.vector3());
        let moved: Vec<Vec3> = x.iter().map(|x| q * x + shift).collect();
        let before = single.response(&x, &neo_hookean());
        let after = single.response(&moved, &neo_hookean());
        assert!((before.energy - after.energy).abs() < 1e-14);
        for (before, after) in before.force.into_iter().zip(after.force) {
            assert!((q * Vec3::from(before) - Vec3::from(after)).norm() < 1e-14);
        }
    });
}

#[test]
fn internal_forces_balance() {
    each(16, |random, single| {
        let x = single.disturbed(random, 0.1);
        let force = single.response(&x, &neo_hookean()).force;
        let force: Vec<Vec3> = force.into_iter().map(Vec3::from).collect();
        let moment: Vec3 = x.iter().zip(&force).map(|(x, f)| x.cross(f)).sum();
        assert!(force.iter().sum::<Vec3>().norm() < 1e-15);
        assert!(moment.norm() < 1e-15);
    });
}

#[test]
fn a_homogeneous_deformation_has_the_energy_and_stress_of_the_law() {
    each(17, |random, single| {
        let f = random.near_identity(0.2);
        let x: Vec<Vec3> = single.reference.iter().map(|x| f * x).collect();
        let (element, law) = (single.element(), neo_hookean().response(&f).unwrap());
        let energy = single.response(&x, &neo_hookean()).energy;
        assert!((energy - law.energy * element.volume()).abs() < 1e-15);
        let sigma = neo_hookean().cauchy_stress(&f).unwrap();
        let at_points = element.stress(&x, &neo_hookean(), &[]).unwrap();
        let at_corners = element.corner_stress(&x, &neo_hookean(), &[]).unwrap();
        assert_eq!(at_corners.len(), x.len());
        for stress in at_points.into_iter().chain(at_corners) {
            assert!((stress - sigma).norm() < 1e-14);
        }
    });
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
    for (kind, formulation) in each_kind() {
        let single = Single::distorted(kind, formulation, &mut Random::new(19), 0.0);
        let flipped = single.reference.iter().map(|x| Vec3::new(x.x, x.y, -x.z));
        let flipped: Vec<Vec3> = flipped.collect();
        let block = CellBlock {
            kind,
            nodes: (0..flipped.len()).map(NodeId::new).collect(),
        };
        let mesh = Mesh::new(flipped.clone(), vec![block]).unwrap();
        let fault = Elements::new(&mesh, formulation).unwrap_err();
        assert_eq!(fault.element, striae_mesh::ElementId(0));
        assert!(matches!(
            fault.error,
            ElementError::Degenerate { point: 0, determinant } if (determinant + 0.125).abs() < 1e-14
        ));
        assert!(matches!(
            single.element().response(&flipped, &neo_hookean(), Past::default()),
            Err(ElementError::Inverted { point: 0, determinant }) if (determinant + 1.0).abs() < 1e-14
        ));
    }
}
