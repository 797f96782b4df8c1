//! A strip of two layers, of which one grows: Timoshenko's curvature.

use striae_mesh::Vec3;
use striae_model::{ActuationKind, BodySection, Formulation};

use crate::{
    Actuation, actuation,
    scene::{Places, Run, block, body, increments, model, rubber, step},
};

/// Layers of one thickness `h/2` and modulus bend by `3/2 e/h` (Timoshenko, J. Opt. Soc. Am. 11
/// (1925) 233, doi:10.1364/JOSA.11.000233, eq. 4 with m = n = 1).
#[test]
fn a_bilayer_strip_bends_with_the_curvature_of_timoshenko() {
    let (length, strain) = (16.0, 2e-3);
    let mesh = block([0.0, 0.0, -0.5], [length, 1.0, 1.0], [16, 1, 4]);
    let mut model = model(vec![body("strip", mesh.mesh().unwrap(), rubber(1.0, 0.0))]);
    let strip = &mut model.bodies[0];
    strip.formulation = Formulation::AssumedStrain;
    let upper = strip.mesh.elements().enumerate().filter(|(_, corners)| {
        let mut corners = corners.iter();
        corners.all(|node| strip.mesh.positions[node.index()].z >= 0.0)
    });
    let section = BodySection {
        set: "upper".into(),
        elements: upper
            .map(|(at, _)| striae_mesh::ElementId::new(at))
            .collect(),
        material: strip.material.clone(),
        formulation: strip.formulation,
        density: 0.0,
    };
    strip.sections.push(section);
    let mut bend = step();
    bend.increments = increments(1.0, 0.1);
    bend.displacements = vec![
        model.hold("strip", "xmin", [Some(0.0), None, None]),
        model.hold("strip", "ymin", [None, Some(0.0), None]),
        model.pin("strip", [0.0, 0.0, 0.0], [None, None, Some(0.0)]),
    ];
    bend.actuations = vec![Actuation {
        section: Some(1),
        ..actuation(ActuationKind::along(strain, &Vec3::x()))
    }];
    model.steps = vec![bend];
    let places = [4.0, 8.0, 12.0].map(|x| model.node_at("strip", [x, 0.0, 0.0]).index());
    let run = Run::completed(model);
    let [a, b, c] = places.map(|node| run.positions(0)[node]);
    // Of the circle through three points.
    let area = (b - a).cross(&(c - a)).norm();
    let curvature = 2.0 * area / ((b - a).norm() * (c - b).norm() * (c - a).norm());
    let expected = 1.5 * strain;
    let error = curvature / expected - 1.0;
    assert!(error.abs() < 0.01, "{curvature} {expected}");
    assert!(
        b.z < a.z && c.z < b.z,
        "it bends away from the layer that grows"
    );
}
