//! Stiffness of every law in every kind of element and formulation, by finite differences.

use super::*;
use nalgebra::{DMatrix, DVector, Matrix3};
use striae_law::bulk::{
    Branch, BulkLaw, Direction, FibreStiffness, Fibres, Fibrous, Hardening, Hyperelastic,
    Isochoric, Law, OgdenTerm, Plastic, Response, ResponseError, Viscoelastic, Volumetric,
};
use striae_verify::assert_derivative;

fn isochoric() -> [Isochoric; 6] {
    let term = |mu, alpha| OgdenTerm { mu, alpha };
    [
        Isochoric::NeoHookean { shear: 0.4 },
        Isochoric::MooneyRivlin {
            c10: 0.2,
            c01: 0.05,
        },
        Isochoric::Yeoh {
            c10: 0.2,
            c20: -0.01,
            c30: 0.002,
        },
        Isochoric::Gent {
            shear: 0.4,
            limit: 20.0,
        },
        Isochoric::ArrudaBoyce {
            mu: 0.4,
            locking_stretch: 3.0,
        },
        Isochoric::Ogden([term(0.63, 1.3), term(0.0012, 5.0), term(-0.01, -2.0)].into()),
    ]
}

fn rubber(isochoric: Isochoric, volumetric: Volumetric) -> Hyperelastic {
    Hyperelastic::new(isochoric, 2.0, volumetric).unwrap()
}

fn fibrous(ground: Material, stiffness: [FibreStiffness; 2]) -> Material {
    let directions = [Vec3::new(1.0, 0.4, 0.1), Vec3::new(0.2, -0.4, 1.0)];
    let families = [0, 1].map(|at| Fibres {
        stiffness: stiffness[at],
        direction: Direction::Uniform(directions[at]),
    });
    Material::fibrous(Fibrous::new(ground, &families).unwrap())
}

/// Laws whose stress comes from an energy.
pub(super) fn elastic() -> Vec<Material> {
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let linear = FibreStiffness::Linear { modulus: 1.5 };
    let exponential = |k2, dispersion| FibreStiffness::Exponential {
        k1: 0.9,
        k2,
        dispersion,
    };
    let ground = rubber(isochoric()[1].clone(), Volumetric::Logarithmic);
    let mut laws = vec![
        neo_hookean(),
        Material::neo_hookean_with(constants, Volumetric::Logarithmic),
        linear_elastic(),
        fibrous(neo_hookean(), [linear; 2]),
        fibrous(neo_hookean(), [linear, exponential(0.0, 0.2)]),
        fibrous(
            Material::hyperelastic(ground),
            [exponential(1.3, 1.0 / 3.0), exponential(0.8, 0.1)],
        ),
        Material::own(Foreign),
    ];
    for volumetric in [Volumetric::Quadratic, Volumetric::Logarithmic] {
        let of_rubber = isochoric().map(|law| Material::hyperelastic(rubber(law, volumetric)));
        laws.extend(of_rubber);
    }
    laws
}

/// Laws whose stress depends on what a point has been through.
pub(super) fn remembering() -> Vec<Material> {
    let branches = [1.5, 0.3].map(|time| Branch { ratio: 0.7, time });
    let slow = isochoric().map(|law| rubber(law, Volumetric::Logarithmic));
    let relaxing = slow.map(|law| Viscoelastic::new(law, &branches).unwrap());
    let mut laws: Vec<Material> = relaxing.map(Material::viscoelastic).into();
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let hardening = [
        Hardening::linear(0.02, 0.0),
        Hardening::linear(0.02, 0.1),
        Hardening::voce(0.02, 0.05, 6.0, 0.02),
        Hardening::table(&[[0.0, 0.02], [0.02, 0.03], [5.0, 0.6]]),
    ];
    laws.extend(hardening.map(|of| Material::plastic(Plastic::new(constants, of.unwrap()))));
    laws
}

/// A law from outside the crate of laws.
#[derive(Debug)]
struct Foreign;

impl BulkLaw for Foreign {
    fn name(&self) -> &str {
        "foreign"
    }

    fn response(&self, f: &Matrix3<f64>) -> Result<Response, ResponseError> {
        neo_hookean().response(f)
    }

    fn lame_constants(&self) -> LameConstants {
        neo_hookean().lame_constants()
    }
}

/// A distorted element, what its points have been through, and where it is now.
pub(super) fn led(
    kind: CellKind,
    formulation: Formulation,
    material: &Material,
) -> (Single, ElementResponse, DVector<f64>) {
    let mut random = Random::new(31);
    let single = Single::distorted(kind, formulation, &mut random, 0.12);
    let rest = material.rest(&Vec3::zeros());
    let rest = rest.repeat(single.elements.points());
    let past = Past {
        variables: &rest,
        elapsed: 0.4,
    };
    let x = single.disturbed(&mut random, 0.1);
    let before = single.element().response(&x, material, past).unwrap();
    let x = single.disturbed(&mut random, 0.1);
    let x = x.iter().flat_map(|x| x.iter().copied());
    let x = DVector::from_iterator(3 * single.reference.len(), x);
    (single, before, x)
}

/// Holds the stiffness against the force, with the past held.
fn check(material: &Material, kind: CellKind, formulation: Formulation) {
    let (single, before, x) = led(kind, formulation, material);
    let forgets = matches!(material.law(), Law::Viscoelastic(_)) || material.yields();
    assert_eq!(before.dissipated > 0.0, forgets, "{}", material.name());
    let at = |x: &DVector<f64>| {
        let x = x.as_slice().chunks_exact(3).map(Vec3::from_column_slice);
        let x: Vec<Vec3> = x.collect();
        let past = Past {
            variables: &before.variables,
            elapsed: 0.4,
        };
        single.element().response(&x, material, past).unwrap()
    };
    let stiffness =
        |x: &DVector<f64>| DMatrix::from_row_slice(x.len(), x.len(), &at(x).stiffness.by_rows());
    assert_derivative(
        |x| DVector::from_row_slice(at(x).force.as_flattened()),
        stiffness,
        &x,
    );
    let found = stiffness(&x);
    assert_eq!(found, found.transpose(), "{}", material.name());
}

#[test]
fn of_elastic_laws() {
    for material in elastic() {
        for (kind, formulation) in single::each_kind() {
            check(&material, kind, formulation);
        }
    }
}

#[test]
fn of_laws_with_a_memory() {
    for material in remembering() {
        for (kind, formulation) in single::each_kind() {
            check(&material, kind, formulation);
        }
    }
}

#[test]
fn compact_ones_make_what_all_their_components_make() {
    let slow = Material::own(Foreign);
    for (kind, formulation) in single::each_kind() {
        let (single, _, x) = led(kind, formulation, &slow);
        let x = x.as_slice().chunks_exact(3).map(Vec3::from_column_slice);
        let x: Vec<Vec3> = x.collect();
        let [found, expected] = [&neo_hookean(), &slow].map(|law| single.response(&x, law));
        let largest = |values: &[f64]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let far = |a: &[f64], b: &[f64]| {
            let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            largest(&difference) / largest(b)
        };
        let [k, k_slow] = [&found, &expected].map(|of| of.stiffness.by_rows());
        let [f, f_slow] = [&found, &expected].map(|of| of.force.as_flattened());
        assert!(far(&k, &k_slow) < 1e-14, "{kind} {formulation:?}");
        assert!(far(f, f_slow) < 1e-14, "{kind} {formulation:?}");
    }
}
