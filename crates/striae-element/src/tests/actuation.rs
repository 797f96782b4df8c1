//! Actuated elements: free growth, derivatives, work, tensions.

use super::*;
use crate::{Actuation, Driven, ElementError, Tension};
use nalgebra::{DMatrix, DVector, Matrix3};
use striae_verify::assert_derivative;

use super::tangents::{elastic, led, remembering};

/// A stress-free strain in general directions, and two tensions.
fn actuation() -> Actuation {
    let strain = Matrix3::new(0.2, 0.05, -0.03, 0.05, -0.1, 0.07, -0.03, 0.07, 0.15);
    let lines = [Vec3::new(0.48, -0.6, 0.64), Vec3::new(0.0, 0.8, 0.6)];
    let tensions = lines.into_iter().zip([0.3, -0.05]);
    Actuation {
        strain,
        tensions: tensions
            .map(|(along, value)| Tension { along, value })
            .collect(),
    }
}

fn strained(actuation: Actuation) -> Actuation {
    Actuation {
        tensions: Vec::new(),
        ..actuation
    }
}

fn positions(x: &DVector<f64>) -> Vec<Vec3> {
    let x = x.as_slice().chunks_exact(3);
    x.map(Vec3::from_column_slice).collect()
}

#[test]
fn growth_that_nothing_holds_is_free_of_stress() {
    for material in elastic().iter().chain(&remembering()) {
        for (kind, formulation) in single::each_kind() {
            let single = Single::distorted(kind, formulation, &mut Random::new(3), 0.12);
            let rest = material.rest(&Vec3::zeros());
            let variables = rest.repeat(single.elements.points());
            let strain = strained(actuation());
            let growth = Matrix3::identity() + strain.strain;
            let x: Vec<Vec3> = single.reference.iter().map(|x| growth * x).collect();
            let driven = Driven {
                material,
                actuation: Some(strain),
            };
            let past = Past {
                variables: &variables,
                elapsed: 0.4,
            };
            let element = single.element();
            let response = element.response(&x, driven.clone(), past).unwrap();
            let round_off = 2e-14 * element.volume();
            assert!(response.energy.abs() < round_off, "{}", material.name());
            let forces = response.force.as_flattened();
            assert!(forces.iter().all(|f| f.abs() < 2e-14), "{forces:?}");
            for stress in element.stress(&x, driven, &variables).unwrap() {
                assert!(stress.norm() < 2e-14, "{} {stress}", material.name());
            }
        }
    }
}

#[test]
fn homogeneous_deformation_has_energy_and_stress_in_closed_form() {
    let mut random = Random::new(23);
    for (kind, formulation) in single::each_kind() {
        let single = Single::distorted(kind, formulation, &mut random, 0.12);
        let (f, drive) = (random.near_identity(0.1), actuation());
        let x: Vec<Vec3> = single.reference.iter().map(|x| f * x).collect();
        let growth = Matrix3::identity() + drive.strain;
        let (inverse, ratio) = (growth.try_inverse().unwrap(), growth.determinant());
        let law = neo_hookean().response(&(f * inverse)).unwrap();
        let mut energy = ratio * law.energy;
        let mut piola = law.first_piola * inverse.transpose() * ratio;
        for Tension { along, value } in &drive.tensions {
            let pulled = f * along;
            energy += value * pulled.norm();
            piola += pulled.normalize() * along.transpose() * *value;
        }
        let cauchy = piola * f.transpose() / f.determinant();
        let material = &neo_hookean();
        let actuation = Some(drive);
        let driven = Driven {
            material,
            actuation,
        };
        let element = single.element();
        let response = element.response(&x, driven.clone(), Past::default());
        let error = response.unwrap().energy / element.volume() - energy;
        assert!(error.abs() < 1e-13, "{kind} {formulation:?} {error}");
        for stress in element.stress(&x, driven, &[]).unwrap() {
            let error = (stress - cauchy).norm();
            assert!(error < 1e-13, "{kind} {formulation:?} {error}");
        }
    }
}

#[test]
fn stiffness_is_the_derivative_of_the_force() {
    for material in elastic().iter().chain(&remembering()) {
        for (kind, formulation) in single::each_kind() {
            let (single, before, x) = led(kind, formulation, material);
            // Enhanced elements that flow plastically all over do not bear much more.
            let scale = match material.yields() {
                true => 0.05,
                false => 1.0,
            };
            let mut actuation = actuation();
            actuation.strain *= scale;
            for tension in &mut actuation.tensions {
                tension.value *= scale;
            }
            let driven = Driven {
                material,
                actuation: Some(actuation),
            };
            let at = |x: &DVector<f64>| {
                let past = Past {
                    variables: &before.variables,
                    elapsed: 0.4,
                };
                let element = single.element();
                element
                    .response(&positions(x), driven.clone(), past)
                    .unwrap()
            };
            let stiffness = |x: &DVector<f64>| {
                DMatrix::from_row_slice(x.len(), x.len(), &at(x).stiffness.by_rows())
            };
            let force = |x: &DVector<f64>| DVector::from_row_slice(at(x).force.as_flattened());
            assert_derivative(force, stiffness, &x);
            let found = stiffness(&x);
            assert_eq!(found, found.transpose(), "{}", material.name());
        }
    }
}

#[test]
fn work_is_the_derivative_of_the_energy_by_the_actuation() {
    for material in &elastic() {
        for (kind, formulation) in single::each_kind() {
            let (single, _, x) = led(kind, formulation, material);
            let rest = material.rest(&Vec3::zeros());
            let variables = rest.repeat(single.elements.points());
            let (x, element) = (positions(&x), single.element());
            // Of strains by six numbers, and of both tensions.
            let change = |by: &[f64]| Actuation {
                strain: Matrix3::new(
                    by[0], by[3], by[4], by[3], by[1], by[5], by[4], by[5], by[2],
                ),
                tensions: (actuation().tensions.iter().zip(&by[6..]))
                    .map(|(old, by)| Tension { value: *by, ..*old })
                    .collect(),
            };
            let driven = |by: &DVector<f64>| {
                let (start, change) = (actuation(), change(by.as_slice()));
                let tensions = start.tensions.iter().zip(&change.tensions);
                let actuation = Some(Actuation {
                    strain: start.strain + change.strain,
                    tensions: tensions
                        .map(|(old, by)| Tension {
                            value: old.value + by.value,
                            ..*old
                        })
                        .collect(),
                });
                Driven {
                    material,
                    actuation,
                }
            };
            let energy = |by: &DVector<f64>| {
                let energy = element.stored_energy(&x, driven(by), &variables);
                DVector::from_element(1, energy.unwrap())
            };
            let work = |by: &DVector<f64>| {
                DMatrix::from_fn(1, by.len(), |_, at| {
                    let mut unit = vec![0.0; by.len()];
                    unit[at] = 1.0;
                    let work = element.work(&x, driven(by), &variables, &change(&unit));
                    work.unwrap()
                })
            };
            assert_derivative(energy, work, &DVector::zeros(8));
        }
    }
}

#[test]
fn actuation_that_is_nothing_changes_no_bit() {
    for (kind, formulation) in single::each_kind() {
        let (single, _, x) = led(kind, formulation, &neo_hookean());
        let (material, x) = (&neo_hookean(), positions(&x));
        let actuation = Some(Actuation::default());
        let driven = Driven {
            material,
            actuation,
        };
        let found = single.element().response(&x, driven, Past::default());
        assert_eq!(found.unwrap(), single.response(&x, material));
    }
}

#[test]
fn nothing_left_of_the_volume_is_an_error() {
    for (kind, formulation) in single::each_kind() {
        let single = Single::distorted(kind, formulation, &mut Random::new(4), 0.0);
        for strain in [-1.0, -1.5, f64::NAN] {
            let material = &neo_hookean();
            let actuation = Some(Actuation {
                strain: Matrix3::identity() * strain,
                tensions: Vec::new(),
            });
            let driven = Driven {
                material,
                actuation,
            };
            let x = &single.reference;
            let found = single.element().response(x, driven, Past::default());
            assert!(matches!(found, Err(ElementError::Shrunk { .. })));
        }
    }
}
