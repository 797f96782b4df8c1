//! Increments, steps and the ways in which a run can end.

use crate::scene::{
    Places, Run, block, body, coulomb, increments, largest_distance, model, plane, rubber, step,
};
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_model::{
    BodyId, Curve, Displacement, Increments, LoadExtent, LoadKind, Model, PairId, Release,
};
use striae_solve::{
    outcome::{CutBack, Ending},
    report::pairs,
};

/// One element, held at the bottom.
fn cube() -> Model {
    let mesh = block([0.0; 3], [1.0; 3], [1, 1, 1]).mesh().unwrap();
    model(vec![body("cube", mesh, rubber(1.0, 0.3))])
}

fn held(model: &Model) -> Displacement {
    model.hold("cube", "zmin", [Some(0.0); 3])
}

/// Two blocks `gap` apart.
fn two_blocks(gap: f64, friction: Friction) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 1]).mesh().unwrap();
    let upper = block([0.2, 0.2, 0.5 + gap], [0.6, 0.6, 0.5], [2, 2, 1])
        .mesh()
        .unwrap();
    let mut model = model(vec![
        body("lower", lower, rubber(3.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), friction);
    let mut step = step();
    step.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.03 - gap)]),
    ];
    model.steps = vec![step];
    model
}

/// Moves the upper end in a further step.
fn then(model: &mut Model, target: [f64; 2], increments: Increments) {
    let mut next = step();
    next.name = "next".to_owned();
    next.increments = increments;
    next.displacements =
        vec![model.hold("upper", "zmax", [Some(target[0]), Some(target[1]), None])];
    model.steps.push(next);
}

fn reason(run: &Run) -> &CutBack {
    match &run.ending {
        Ending::Stopped { reason, .. } => reason,
        other => panic!("{other}"),
    }
}

#[test]
fn easy_increments_grow_to_the_largest() {
    let mut model = cube();
    let mut step = step();
    step.duration = 4.0;
    step.increments = Increments {
        initial: 0.1,
        smallest: 0.01,
        largest: 0.2,
    };
    step.displacements = vec![
        held(&model),
        model.hold("cube", "zmax", [None, None, Some(-0.1)]),
    ];
    model.steps = vec![step];
    let run = Run::completed(model);
    let ends: Vec<f64> = run.progress.iter().map(|p| p.fraction).collect();
    let expected = [0.1, 0.25, 0.45, 0.65, 0.85, 1.0];
    assert_eq!(ends.len(), expected.len(), "{ends:?}");
    for (end, expected) in ends.iter().zip(expected) {
        assert!((end - expected).abs() < 1e-12, "{ends:?}");
    }
    assert!(
        run.progress
            .iter()
            .zip(&run.states[1..])
            .all(|(p, s)| p.time == s.time)
    );
    assert_eq!(run.last().time, 4.0);
}

/// Runs a model whose only step fails as one increment, and another whose steps are the
/// increments that it was divided into; `held` are its conditions at a fraction.
fn assert_halved(model: Model, held: impl Fn(&Model, f64) -> Vec<Displacement>) -> Run {
    let cut = Run::completed(model.clone());
    assert!(!cut.cuts.is_empty());
    let mut size = 1.0;
    for (progress, _) in cut.cuts.iter().take_while(|(p, _)| p.increment == 1) {
        assert!((progress.fraction - size).abs() < 1e-12);
        size *= 0.5;
    }
    assert!((cut.progress[0].fraction - size).abs() < 1e-12);

    let direct = cut.progress.iter().map(|progress| {
        let mut part = step();
        part.displacements = held(&model, progress.fraction);
        part
    });
    let mut same = model.clone();
    same.steps = direct.collect();
    let same = Run::completed(same);
    assert!(same.cuts.is_empty());
    for body in 0..model.bodies.len() {
        let error = largest_distance(cut.positions(body), same.positions(body));
        assert!(error < 1e-12, "body {body} differs by {error:.1e}");
    }
    cut
}

#[test]
fn failed_increments_are_halved_and_leave_no_trace() {
    // Sheared by twice its height at once, the block turns inside out.
    let mesh = block([0.0; 3], [1.0, 1.0, 2.0], [2, 2, 4]).mesh().unwrap();
    let mut model = model(vec![body("cube", mesh, rubber(1.0, 0.3))]);
    let sheared = |model: &Model, fraction: f64| {
        let way = [Some(4.0 * fraction), Some(0.0), Some(0.0)];
        vec![held(model), model.hold("cube", "zmax", way)]
    };
    let mut shear = step();
    shear.displacements = sheared(&model, 1.0);
    shear.increments = increments(1.0, 1e-3);
    model.steps = vec![shear];
    // Increments start elsewhere than steps do: down to round-off they end at the same place.
    model.solver.further_iterations = 1;
    let cut = assert_halved(model, sheared);
    let inverted = |cut: &CutBack| matches!(cut, CutBack::InvertedElement { .. });
    assert!(cut.cuts.iter().all(|(_, cut)| inverted(cut)));
}

#[test]
fn increments_that_fail_in_contact_are_halved_too() {
    const GAP: f64 = 0.4;
    fn pressed(model: &Model, fraction: f64) -> Vec<Displacement> {
        let way = [Some(0.0), Some(0.0), Some(-(GAP + 0.3) * fraction)];
        vec![
            model.hold("lower", "zmin", [Some(0.0); 3]),
            model.hold("upper", "zmax", way),
        ]
    }
    let mut model = two_blocks(GAP, coulomb(0.3));
    model.steps[0].displacements = pressed(&model, 1.0);
    model.steps[0].increments = increments(1.0, 1e-3);
    // One iteration fewer than the whole way needs at once.
    let needed = Run::completed(model.clone()).iterations[0].len();
    model.solver.largest_iterations = needed - 1;
    assert_halved(model, pressed);
}

#[test]
fn further_iterations_come_after_the_tolerance() {
    let mut model = two_blocks(0.0, coulomb(0.3));
    model.solver.tolerance = 1e-4;
    let norms = |further| {
        let mut model = model.clone();
        model.solver.further_iterations = further;
        Run::of(model).iterations.remove(0)
    };
    let (enough, more) = (norms(0), norms(2));
    assert_eq!(more.len(), enough.len() + 2);
    assert_eq!(more[..enough.len()], enough);
    assert!(more[more.len() - 1].largest() < 1e-3 * enough[enough.len() - 1].largest());
}

#[test]
fn an_inverted_element_is_named() {
    let mut model = cube();
    let mut step = step();
    step.displacements = vec![
        held(&model),
        model.hold("cube", "zmax", [None, None, Some(-2.3)]),
    ];
    model.steps = vec![step];
    let run = Run::of(model);
    assert!(matches!(reason(&run), CutBack::InvertedElement { body, .. } if body == "cube"));
    assert_eq!(run.states.len(), 1);
    let said = run.ending.to_string();
    assert!(said.contains("step `step` stopped at time 0"), "{said}");
}

#[test]
fn a_body_that_nothing_holds_is_named() {
    let mut model = cube();
    let mut step = step();
    let pull = LoadKind::DeadTraction(Vec3::x());
    step.loads = vec![model.load("cube", "zmax", pull, LoadExtent::Whole)];
    model.steps = vec![step];
    let run = Run::of(model);
    let said = reason(&run).to_string();
    assert!(said.contains("body `cube` is not restrained"), "{said}");
}

#[test]
fn a_block_that_leaves_another_in_one_increment_is_free() {
    let mut model = two_blocks(0.0, coulomb(0.3));
    then(&mut model, [3.0, 0.0], increments(1.0, 0.9));
    let run = Run::completed(model);
    let report = &pairs(&run.problem, run.last())[0];
    assert_eq!(report.stick + report.slip, 0, "{report:?}");
    assert!(report.sides.iter().all(|side| side.force.norm() == 0.0));
    let forces = &run.last().forces;
    let largest = forces.reaction.iter().map(|f| f.norm()).fold(0.0, f64::max);
    assert!(largest < 1e-10, "{largest:e}");
}

#[test]
fn a_press_from_a_gap_does_not_depend_on_where_it_starts() {
    let run = Run::completed(two_blocks(0.4, coulomb(0.3)));
    assert!(run.cuts.is_empty());
    let touching = Run::completed(two_blocks(0.0, coulomb(0.3)));
    let [far, near] = [&run, &touching].map(|r| pairs(&r.problem, r.last())[0].sides[0].force.z);
    assert!((far / near - 1.0).abs() < 1e-2, "{far} {near}");
}

#[test]
fn nodes_that_change_their_status_are_listed() {
    let mut listed = Vec::new();
    for slide in [0.001, 0.006, 0.012, 0.03, 0.06, 0.1, 0.15] {
        let mut model = two_blocks(0.0, coulomb(0.3));
        then(&mut model, [slide, 0.0], increments(1.0, 0.9));
        let needed = Run::completed(model.clone()).iterations[1].len();
        for allowed in 2..needed {
            model.solver.largest_iterations = allowed;
            let run = Run::of(model.clone());
            if run.states.len() < 2 {
                continue;
            }
            match reason(&run) {
                CutBack::NoConvergence {
                    iterations,
                    cycling,
                    ..
                } => {
                    assert_eq!(*iterations, allowed);
                    listed.extend(cycling.clone());
                }
                other => panic!("{other}"),
            }
        }
    }
    assert!(!listed.is_empty());
    for node in &listed {
        assert_eq!(node.pair, "interface");
        assert!(node.history.chars().all(|c| "osS".contains(c)));
        assert!(node.history.chars().any(|c| !node.history.starts_with(c)));
    }
}

#[test]
fn conditions_persist_and_are_released_and_restated() {
    let mut model = cube();
    let top = |components| model.hold("cube", "zmax", components);
    let mut press = step();
    press.displacements = vec![held(&model), top([Some(0.0), Some(0.0), Some(-0.1)])];
    let mut shear = step();
    shear.displacements = vec![top([Some(0.2), None, None])];
    let mut let_go = step();
    let_go.releases = vec![Release {
        body: BodyId(0),
        nodes: model.nodes("cube", "zmax"),
        components: [true, false, true],
    }];
    let mut pull = step();
    pull.displacements = vec![top([None, None, Some(0.05)])];
    model.steps = vec![press, shear, let_go, pull];
    let run = Run::completed(model);
    let tops: Vec<Vec3> = run.states.iter().map(|s| s.positions[7]).collect();
    let moved: Vec<Vec3> = tops.iter().map(|x| x - tops[0]).collect();
    assert!((moved[1] - Vec3::new(0.0, 0.0, -0.1)).norm() < 1e-14);
    assert!((moved[2] - Vec3::new(0.2, 0.0, -0.1)).norm() < 1e-14);
    assert!(moved[3].norm() < 1e-9, "{}", moved[3]);
    assert!((moved[4].z - 0.05).abs() < 1e-14 && moved[4].y.abs() < 1e-14);
}

#[test]
fn loads_persist_and_are_restated() {
    let mut model = cube();
    let pressure = |p| model.load("cube", "zmax", LoadKind::Pressure(p), LoadExtent::Whole);
    let mut load = step();
    load.displacements = vec![held(&model)];
    load.loads = vec![pressure(0.1)];
    let mut change = step();
    change.increments = increments(0.5, 0.1);
    change.loads = vec![pressure(0.0)];
    model.steps = vec![load, step(), change];
    let run = Run::completed(model);
    let applied = |state: usize| {
        run.states[state]
            .forces
            .applied
            .iter()
            .map(|f| f.z)
            .sum::<f64>()
    };
    let area = |state: usize| {
        let x = &run.states[state].positions;
        0.5 * (x[7] - x[4])
            .cross(&(x[6] - x[5]))
            .norm()
            .max((x[6] - x[4]).cross(&(x[7] - x[5])).norm())
    };
    for (state, p) in [(1, 0.1), (2, 0.1), (3, 0.05), (4, 0.0)] {
        assert!(
            (applied(state) + p * area(state)).abs() < 1e-9,
            "state {state}: {}",
            applied(state)
        );
    }
    let [loaded, held] = [1, 2].map(|state: usize| &run.states[state].positions);
    assert!(largest_distance(loaded, held) < 1e-10);
    assert!(largest_distance(&run.last().positions, &run.states[0].positions) < 1e-9);
}

#[test]
fn quantities_follow_their_curves() {
    let table = Curve::Table(vec![(0.0, 0.0), (0.5, 1.0), (1.0, -1.0)]);
    for (curve, expected) in [
        (Curve::Ramp, [0.25, 0.5, 0.75, 1.0]),
        (Curve::Smooth, [0.15625, 0.5, 0.84375, 1.0]),
        (Curve::Constant, [1.0; 4]),
        (table, [0.5, 1.0, 0.0, -1.0]),
    ] {
        let mut model = cube();
        let mut step = step();
        step.increments = increments(0.25, 0.1);
        let mut top = model.hold("cube", "zmax", [Some(0.0), Some(0.0), Some(0.1)]);
        top.curve = curve.clone();
        step.displacements = vec![held(&model), top];
        model.steps = vec![step];
        let run = Run::completed(model);
        for (state, c) in run.states[1..].iter().zip(expected) {
            let u = state.positions[7].z - 1.0;
            assert!((u - 0.1 * c).abs() < 1e-14, "{curve:?}: {u}");
        }
    }
}

#[test]
fn friction_is_switched_between_steps() {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [2, 2, 1]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        Friction::frictionless(),
    );
    let mut travel = 0.0;
    for (friction, depth) in [
        (Friction::frictionless(), -0.02),
        (coulomb(0.3), -0.02),
        (coulomb(0.1), -0.02),
        (Friction::frictionless(), -0.02),
    ] {
        let mut slide = step();
        travel += 2.0;
        slide.increments = increments(0.25, 0.2);
        slide.displacements =
            vec![model.hold("block", "zmax", [Some(travel), Some(0.0), Some(depth)])];
        slide.frictions = vec![(PairId(0), friction)];
        model.steps.push(slide);
    }
    let run = Run::completed(model);
    for (state, mu) in [(4, 0.0), (8, 0.3), (12, 0.1), (16, 0.0)] {
        let force = pairs(&run.problem, &run.states[state])[0].sides[0].force;
        assert!(
            (force.xy().norm() / force.z - mu).abs() < 1e-6,
            "state {state}: {force}"
        );
    }
}
