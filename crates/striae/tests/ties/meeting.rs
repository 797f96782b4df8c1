//! Ties that meet: three bodies around an edge, layers, parts of one surface.

use striae::{mesh::generate::Block, prelude::*, solve::report::ties};

use super::scene::{Finished, rubber, run, tie, unevenness};

fn block(origin: [f64; 3], size: [f64; 3], divisions: [usize; 3]) -> Mesh {
    let block = Block {
        origin: origin.into(),
        size: size.into(),
        divisions,
        ..Block::default()
    };
    block.mesh().unwrap()
}

fn balanced(run: &Finished) {
    for report in ties(&run.problem, &run.state) {
        assert!(report.mismatch < 1e-10, "{report:?}");
        assert!(report.moment_mismatch < 1e-10, "{report:?}");
    }
}

/// Two blocks side by side on a third, of `left`, `right` and `base` divisions.
fn three(left: [usize; 3], right: [usize; 3], base: [usize; 3]) -> Finished {
    let on = |step: StepBuilder, body: &str| step.displace(body, "ymin", [None, Some(0.0), None]);
    let pull = ["left", "right", "base"].into_iter().fold(step("pull"), on);
    let pull = pull
        .increments(2)
        .displace("base", "xmin", [Some(0.0), None, None])
        .displace("left", "xmin", [Some(0.0), None, None])
        .displace("base", "zmin", [None, None, Some(0.0)])
        .displace("left", "zmax", [None, None, Some(0.1)])
        .displace("right", "zmax", [None, None, Some(0.1)]);
    let model = model("Three blocks")
        .body(body(
            "left",
            block([0.0, 0.0, 0.5], [0.5, 1.0, 0.5], left),
            rubber(),
        ))
        .body(body(
            "right",
            block([0.5, 0.0, 0.5], [0.5, 1.0, 0.5], right),
            rubber(),
        ))
        .body(body(
            "base",
            block([0.0; 3], [1.0, 1.0, 0.5], base),
            rubber(),
        ))
        .tie(tie(
            "left-right",
            surface("left", "xmax"),
            surface("right", "xmin"),
        ))
        .tie(tie(
            "left-base",
            surface("left", "zmin"),
            surface("base", "zmax"),
        ))
        .tie(tie(
            "right-base",
            surface("base", "zmax"),
            surface("right", "zmin"),
        ))
        .step(pull);
    run(model)
}

type StepBuilder = striae::model::StepBuilder;

#[test]
fn three_bodies_meet_at_an_edge_under_constant_stress() {
    for [left, right, base] in [
        [[2, 4, 2], [2, 4, 2], [4, 4, 2]],
        [[2, 4, 2], [3, 3, 3], [3, 5, 2]],
        [[1, 2, 1], [2, 3, 1], [5, 5, 2]],
    ] {
        let run = three(left, right, base);
        balanced(&run);
        let uneven = unevenness(&run);
        assert!(uneven < 1e-8, "{left:?} {right:?} {base:?}: {uneven:.2e}");
    }
}

#[test]
fn thin_layers_hand_forces_on() {
    let layer = |at: f64, divisions| block([0.0, 0.0, at], [1.0, 1.0, 0.25], divisions);
    let names = ["first", "second", "third", "fourth"];
    let divisions = [[4, 4, 1], [3, 3, 1], [2, 5, 1], [4, 3, 1]];
    let mut stack = model("Four layers");
    for (at, (name, divisions)) in names.iter().zip(divisions).enumerate() {
        let mesh = layer(0.25 * at as f64, divisions);
        stack = stack.body(body(*name, mesh, rubber()));
    }
    for pair in names.windows(2) {
        let (below, above) = (surface(pair[0], "zmax"), surface(pair[1], "zmin"));
        stack = stack.tie(tie(pair.join("-"), below, above));
    }
    let shear = step("shear").increments(2).hold("first", "zmin").displace(
        "fourth",
        "zmax",
        [0.2, 0.1, 0.0],
    );
    let run = run(stack.step(shear));
    balanced(&run);
    let force = run.results().reaction("fourth.zmax").unwrap();
    for report in ties(&run.problem, &run.state) {
        let above = report.sides[1].force + force;
        assert!(above.norm() < 1e-8 * force.norm(), "{report:?}");
    }
}

#[test]
fn prescribed_sides_stay_where_they_are_prescribed() {
    // The whole of the finer surface is held, so the coarser one follows.
    let pull = step("pull")
        .increments(2)
        .hold("lower", "zmax")
        .hold("lower", "zmin")
        .displace("upper", "zmax", [0.1, 0.0, 0.05]);
    let model = model("On a held surface")
        .body(body(
            "lower",
            block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 1]),
            rubber(),
        ))
        .body(body(
            "upper",
            block([0.0, 0.0, 0.5], [1.0, 1.0, 0.5], [3, 3, 2]),
            rubber(),
        ))
        .tie(tie(
            "glue",
            surface("lower", "zmax"),
            surface("upper", "zmin"),
        ))
        .step(pull);
    let run = run(model);
    balanced(&run);
    let results = run.results();
    for (x, rest) in results
        .positions("upper")
        .unwrap()
        .iter()
        .zip(results.reference("upper").unwrap())
    {
        if rest.z < 0.5 + 1e-9 {
            assert!((x - rest).norm() < 1e-12);
        }
    }
    let [lower, upper] = ["lower.zmax", "upper.zmax"].map(|set| results.reaction(set).unwrap());
    assert!((lower + upper).norm() < 1e-8 * upper.norm());
}
