//! Tied bodies in contact with friction.

use striae::{mesh::generate::Block, prelude::*};

use super::scene::{Finished, glue, halves, rubber, run, tie, tied};

fn sole(name: &str, body: &str, friction: f64) -> striae::model::PairBuilder {
    pair(name, surface(body, "zmin"), rigid("floor")).friction(Friction::coulomb(friction).unwrap())
}

#[test]
fn a_stack_slides_on_a_floor() {
    let press = step("press")
        .increments(2)
        .displace("upper", "zmax", [0.0, 0.0, -0.05]);
    let drag = step("drag")
        .increments(6)
        .displace("upper", "zmax", [Some(0.4), None, None]);
    let model = tied(&halves([0.2, 0.0]))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(sole("sole", "lower", 0.3))
        .step(press)
        .step(drag);
    let run = run(model);
    let held = run.results().reaction("upper.zmax").unwrap();
    let sole = run.results().pair("sole").unwrap().sides[0].force;
    assert!((held + sole).norm() < 1e-7 * held.norm());
    // All of it slides.
    assert!((sole.x + 0.3 * sole.z).abs() < 1e-6 * sole.z, "{sole}");
    let report = glue(&run);
    assert!(report.mismatch < 1e-10 && report.moment_mismatch < 1e-10);
    assert!((report.sides[0].force + sole).norm() < 1e-7 * sole.norm());
    let energies = &run.state.energies;
    assert!(energies.imbalance().abs() < 1e-6 * energies.external.abs());
    assert!(
        run.summary.warnings.is_empty(),
        "{:?}",
        run.summary.warnings
    );
}

/// Two blocks side by side, tied, pressed onto a floor, with so many divisions across.
fn side_by_side(left: [usize; 3], right: [usize; 3]) -> Finished {
    let block = |origin: f64, divisions| {
        let block = Block {
            origin: Vec3::new(origin, 0.0, 0.0),
            size: Vec3::new(1.0, 1.0, 0.5),
            divisions,
            ..Block::default()
        };
        block.mesh().unwrap()
    };
    let press = |step: striae::model::StepBuilder, z: f64| {
        step.displace("left", "zmax", [None, None, Some(z)])
            .displace("right", "zmax", [None, None, Some(z)])
    };
    let drag = step("drag")
        .increments(3)
        .displace("left", "xmin", [Some(0.2), Some(0.0), None]);
    let model = model("Side by side")
        .body(body("left", block(0.0, left), rubber()))
        .body(body("right", block(1.0, right), rubber()))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(sole("left-sole", "left", 0.2))
        .pair(sole("right-sole", "right", 0.2))
        .tie(tie(
            "seam",
            surface("left", "xmax"),
            surface("right", "xmin"),
        ))
        .step(press(step("press").increments(2), -0.02).displace(
            "left",
            "xmin",
            [Some(0.0), Some(0.0), None],
        ))
        .step(drag);
    run(model)
}

#[test]
fn tied_neighbours_share_a_floor() {
    for (left, right) in [([3, 3, 2], [3, 3, 2]), ([3, 3, 2], [4, 4, 2])] {
        let run = side_by_side(left, right);
        let results = run.results();
        let soles = ["left-sole", "right-sole"].map(|name| results.pair(name).unwrap());
        let down: f64 = soles.iter().map(|sole| sole.sides[0].force.z).sum();
        let held: f64 = ["left.zmax", "right.zmax"]
            .map(|set| results.reaction(set).unwrap().z)
            .iter()
            .sum();
        assert!((down + held).abs() < 1e-7 * down, "{left:?} {right:?}");
        // Pressed evenly but for the drag: no pressure of one side is far from the mean.
        for name in ["left-sole", "right-sole"] {
            let nodes = results.contact(name, PairSide::A).unwrap();
            let largest = nodes.iter().map(|node| node.pressure).fold(0.0, f64::max);
            assert!(
                largest < 4.0 * down / 2.0,
                "{name}: {largest:.3e} of {down:.3e}"
            );
        }
        assert!(run.state.energies.imbalance().abs() < 1e-6 * run.state.energies.external.abs());
    }
}
