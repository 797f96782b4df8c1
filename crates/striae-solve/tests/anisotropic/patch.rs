//! Uniform slip and homogeneous stress of an oblique parallelepiped, for all laws.

use crate::{
    dissipation::dissipates,
    oblique::{Formula, Oblique, Sliding, irregular_block},
    scene::{Run, largest_distance},
    table::STRONG,
};
use nalgebra::Vector2;
use striae_contact::unknowns::Status;
use striae_mesh::{CellKind, Vec3, generate::Block};

const LENGTHS: [f64; 7] = [0.3, 1.0, 4.0, 8.0, 8.0, 8.0, 8.0];

/// Slides an irregular block until it is homogeneous.
fn slid(oblique: &Oblique, degrees: f64, cells: CellKind) -> (Run, Sliding, Vector2<f64>) {
    let sliding = oblique.sliding(degrees);
    let mut model = oblique.model(&Block {
        cells,
        ..irregular_block()
    });
    let mut place = Vector2::zeros();
    model.steps.push(sliding.step(&model, place, 2));
    for length in LENGTHS {
        place += sliding.direction * length;
        model.steps.push(sliding.step(&model, place, 1));
    }
    (Run::completed(model), sliding, place)
}

fn check(oblique: &Oblique, degrees: f64) {
    check_cells(oblique, degrees, CellKind::Hexahedron);
}

fn check_cells(oblique: &Oblique, degrees: f64, cells: CellKind) {
    let (run, sliding, place) = slid(oblique, degrees, cells);
    let (law, angles) = (&oblique.law, &oblique.angles);
    let what = format!("{law:?} {angles:?} along {degrees}, {cells}");
    let expected: Vec<Vec3> = run
        .problem
        .reference
        .iter()
        .map(|x| sliding.gradient * x + place.push(0.0))
        .collect();
    let error = largest_distance(run.positions(0), &expected);
    assert!(error < 1e-8, "{what}: displacements off by {error:.1e}");
    let body = &run.problem.model.bodies[0];
    for (corners, element) in body.mesh.elements().zip(run.problem.elements[0].iter()) {
        let corners = corners.iter();
        let x: Vec<Vec3> = corners.map(|node| run.positions(0)[node.index()]).collect();
        for stress in element.stress(&x, &body.material, &[]).unwrap() {
            let error = (stress - sliding.stress).amax();
            assert!(error < 1e-8, "{what}: stress off by {error:.1e}");
        }
    }
    for node in &run.last().pairs[0].nodes[0] {
        assert_eq!(node.status, Status::Slip, "{what}");
        let tau = (node.tau - sliding.tau.push(0.0)).norm();
        let p = (node.pressure - sliding.pressure).abs();
        let slip = (node.slip - (sliding.direction * LENGTHS[6]).push(0.0)).norm();
        assert!(tau < 1e-8 && p < 1e-8 && slip < 1e-8, "{what}: {node:?}");
    }
    dissipates(&run);
}

const DIRECTIONS: [f64; 4] = [0.0, 70.0, 205.0, 300.0];

#[test]
fn coulomb() {
    for degrees in DIRECTIONS {
        check(&Oblique::new(Formula::Coulomb(0.3), [None; 2]), degrees);
        let distorted = Oblique::new(Formula::Coulomb(0.3), [None; 2]).distorted();
        check(&distorted, degrees);
    }
}

#[test]
fn two_textures() {
    for constants in [[0.3, 0.1, 0.1, 0.5], [0.2, 0.2, 0.15, 0.6]] {
        for angles in [[Some(45.0), Some(45.0)], [Some(-20.0), Some(70.0)]] {
            let oblique = Oblique::new(Formula::TwoTextures(constants), angles);
            for degrees in [70.0, 205.0] {
                check(&oblique, degrees);
                check(&oblique.clone().distorted(), degrees);
            }
        }
    }
}

#[test]
fn orthotropic() {
    for angles in [[Some(30.0), None], [None, Some(110.0)]] {
        for degrees in [70.0, 205.0] {
            for law in [
                Formula::Opposing([0.1, 0.3]),
                Formula::Associated([0.3, 0.12]),
            ] {
                check(&Oblique::new(law, angles).distorted(), degrees);
            }
        }
    }
}

#[test]
fn nap() {
    for angles in [[Some(30.0), None], [None, Some(110.0)]] {
        for degrees in DIRECTIONS {
            let law = Formula::Nap([0.1, 0.3, 0.2]);
            check(&Oblique::new(law, angles).distorted(), degrees);
        }
    }
}

#[test]
fn tabulated() {
    for angles in [[Some(30.0), None], [None, Some(110.0)]] {
        for degrees in DIRECTIONS {
            check(
                &Oblique::new(Formula::Tabulated(STRONG), angles).distorted(),
                degrees,
            );
        }
    }
}

#[test]
fn all_kinds_of_cells() {
    for cells in CellKind::ALL {
        let grooves = Formula::Opposing([0.1, 0.3]);
        check_cells(&Oblique::new(grooves, [Some(30.0), None]), 70.0, cells);
        let nap = Formula::Nap([0.1, 0.3, 0.2]);
        let nap = Oblique::new(nap, [None, Some(110.0)]).distorted();
        check_cells(&nap, 205.0, cells);
    }
}
