//! Tied faces with prescribed displacements.

use std::path::Path;

use striae::{
    deck,
    model::{FaultKind, ModelBuilder, StepBuilder, tie::TieFault},
    prelude::*,
};

use super::scene::{glue, halves, rubber, run, tie};

/// The finer lower block and the upper one, both with the part of their tied face up to and from
/// an `x` as a set `part`.
fn blocks(upper_from: f64) -> ModelBuilder {
    let [lower, upper] = halves([0.0; 2]).map(|block| block.mesh().unwrap());
    let tied = |x: &Vec3| (x.z - 0.5).abs() < 1e-9;
    let lower = body("lower", lower, rubber());
    let upper = body("upper", upper, rubber());
    model("Two tied blocks")
        .body(lower.nodes_where("part", |x| tied(x) && x.x < 0.6))
        .body(upper.nodes_where("part", |x| tied(x) && x.x > upper_from))
        .tie(tie(
            "glue",
            surface("lower", "zmax"),
            surface("upper", "zmin"),
        ))
}

/// A step that holds both blocks away from the tie and moves nodes of the lower one along `x`.
fn shear(nodes: &str) -> StepBuilder {
    step("shear")
        .increments(2)
        .displace("upper", "zmax", [Some(0.0); 3])
        .displace("lower", "zmin", [None, Some(0.0), Some(0.0)])
        .displace("lower", nodes, [Some(0.1), None, None])
}

/// Displacements along `x` of the tied nodes of a body, with their place at rest.
fn moved(run: &Finished, body: &str) -> Vec<(Vec3, f64)> {
    let model = &run.problem.model;
    let of_name = model.bodies.iter().find(|own| own.name == body).unwrap();
    let now = run.results().positions(body).unwrap().to_vec();
    let both = of_name.mesh.positions.iter().zip(now);
    let tied = both.filter(|(x, _)| (x.z - 0.5).abs() < 1e-9);
    tied.map(|(x, now)| (*x, now.x - x.x)).collect()
}

#[test]
fn the_other_side_follows_a_face_that_is_moved() {
    let run = run(blocks(2.0).step(shear("zmax")));
    for body in ["lower", "upper"] {
        let moved = moved(&run, body);
        assert!(!moved.is_empty());
        for (x, along) in moved {
            assert!((along - 0.1).abs() < 1e-12, "{body} at {x}: {along}");
        }
    }
    let glue = glue(&run);
    assert!(glue.sides[1].force.x > 1e3, "{glue:?}");
    assert!(glue.mismatch < 1e-9, "{glue:?}");
    assert!(glue.moment_mismatch < 1e-9, "{glue:?}");
}

#[test]
fn the_other_side_follows_where_a_part_of_a_face_is_moved() {
    let run = run(blocks(2.0).step(shear("part")));
    // The face of the upper block is over nodes that move by .1 where its own are at x < .5.
    for (x, along) in moved(&run, "upper") {
        assert!(x.x > 0.4 || (along - 0.1).abs() < 0.01, "at {x}: {along}");
    }
    assert!(glue(&run).mismatch < 1e-9);
}

#[test]
fn areas_that_neither_side_can_tie_are_refused() {
    let step = shear("part").displace("upper", "part", [Some(0.0), None, None]);
    let faults = blocks(0.6).step(step).build().unwrap_err().0;
    let [fault] = faults.as_slice() else {
        panic!("{faults:?}")
    };
    assert_eq!(fault.path.to_string(), "ties[0]");
    let FaultKind::Tie { fault } = &fault.kind else {
        panic!("{fault:?}")
    };
    let lost = matches!(fault, TieFault::Prescribed { axis: "x", share, .. } if *share > 0.1);
    assert!(lost, "{fault}");
    assert!(fault.to_string().contains("along x"), "{fault}");
}

const STAMP: &str = r#"
title = "A tie beside a stamp"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 100
poissons_ratio = 0.3
[[body]]
name = "left"
material = "rubber"
mesh = { generator = "block", size = [1, 1, 0.5], divisions = [4, 4, 2] }
[[body]]
name = "right"
material = "rubber"
mesh = { generator = "block", origin = [1, 0, 0], size = [1, 1, 0.5], divisions = [2, 2, 2] }
[[rigid]]
name = "stamp"
reference = [1.5, 0.5, 0.5]
tied = [{ body = "right", nodes = "zmax" }]
[[tie]]
name = "side"
a = { body = "left", facets = "xmax" }
b = { body = "right", facets = "xmin" }
[[step]]
name = "push"
increments = 5
displacement = [{ body = "left", nodes = "xmin", x = 0, y = 0, z = 0 }]
rigid = [{ surface = "stamp", displacement = [0.05, 0.02, 0], rotation = [0, 2, 0] }]
"#;

/// Nodes that the other side of a tie follows may be tied to a rigid body: what moves the body is
/// the whole work.
#[test]
fn a_rigid_body_beside_a_tie_does_the_work_that_is_stored() {
    let deck = deck::parse(STAMP, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let run = Simulation::of(deck).unwrap().run().unwrap();
    assert_eq!(run.ending, Ending::Completed);
    let energies = &run.state.energies;
    let work = energies.external;
    assert!(energies.imbalance().abs() < 1e-6 * work, "{energies:?}");
    assert!(energies.numerical.abs() < 0.01 * work, "{energies:?}");
}
