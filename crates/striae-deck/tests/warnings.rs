//! Warnings about increments, from states made by hand.

use std::path::Path;

use striae_contact::field::FacetForces;
use striae_deck::parse;
use striae_mesh::{FacetId, Vec3};
use striae_solve::{
    assembly::StepContext,
    audit::{Doubt, coarse, doubts, jump},
    newton::{Acceptance, InStep, Increment, LinearWork},
    outcome::Ending,
    problem::Problem,
    state::State,
    warning::{Judgement, Kind, Warning},
};

fn problem() -> Problem {
    let text = r#"
title = "Two blocks"
[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "solid"
mesh = { generator = "block", size = [1, 1, 1], divisions = [4, 4, 4] }
[[body]]
name = "upper"
material = "solid"
mesh = { generator = "block", origin = [0.2, 0.3, 1.1], size = [0.5, 0.5, 0.4], divisions = [3, 3, 2] }
[[pair]]
name = "interface"
a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }
[[step]]
name = "press"
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", z = -0.3 },
]
"#;
    Problem::new(parse(text, "deck.toml", Path::new("")).unwrap().model).unwrap()
}

/// The state with the upper block lowered.
fn lowered(problem: &Problem, time: f64, way: f64) -> State {
    let mut state = State::undeformed(problem);
    state.time = time;
    let upper = &mut state.positions[problem.first_node[1]..];
    upper
        .iter_mut()
        .for_each(|x| *x -= Vec3::new(0.0, 0.0, way));
    state
}

fn judged(problem: &Problem, states: &[State]) -> Vec<Warning> {
    let mut judgement = Judgement::default();
    for pair in states.windows(2) {
        judgement.increment(problem, &pair[0], &pair[1], InStep::up_to(0, 0.5));
    }
    judgement.warnings(problem, &Ending::Completed)
}

fn kinds(warnings: &[Warning]) -> Vec<Kind> {
    warnings.iter().map(|warning| warning.kind).collect()
}

#[test]
fn a_pair_that_never_touched_is_named() {
    let problem = problem();
    let warnings = judged(
        &problem,
        &[0.0, 0.05].map(|way| lowered(&problem, way, way)),
    );
    assert_eq!(kinds(&warnings), [Kind::NeverTouched]);
    assert_eq!(warnings[0].pair.as_deref(), Some("interface"));
    assert!((warnings[0].value - 0.1).abs() < 1e-12);
}

/// A converged increment to a state.
fn increment(state: State, acceptance: Acceptance) -> Increment {
    Increment {
        state,
        in_step: InStep::up_to(0, 0.5),
        iterations: Vec::new(),
        unknowns: 0,
        peak_bytes: 0,
        work: LinearWork::default(),
        interferences: vec![Vec::new()],
        overlaps: Vec::new(),
        doubts: Vec::new(),
        selections: Vec::new(),
        has_reselected: false,
        acceptance,
    }
}

#[test]
fn an_increment_that_is_accepted_above_the_tolerance_is_told() {
    let problem = problem();
    let start = lowered(&problem, 0.0, 0.0);
    let kinds_of = |acceptance: Acceptance| {
        let mut judgement = Judgement::default();
        let increment = increment(lowered(&problem, 1.0, 0.0), acceptance);
        judgement.converged(&problem, &start, &increment);
        judgement.warnings(&problem, &Ending::Completed)
    };
    assert_eq!(
        kinds(&kinds_of(Acceptance::Converged)),
        [Kind::NeverTouched]
    );
    let residual = 100.0 * problem.model.solver.tolerance;
    let warnings = kinds_of(Acceptance::AtJump { residual });
    assert_eq!(kinds(&warnings), [Kind::Residual, Kind::NeverTouched]);
    assert_eq!(warnings[0].value, residual);
    let residual = 0.5 * problem.model.solver.tolerance;
    let below = kinds_of(Acceptance::AtJump { residual });
    assert_eq!(kinds(&below), [Kind::NeverTouched]);
}

#[test]
fn a_step_is_judged_for_stabilisation_by_the_increment_that_ends_it() {
    let problem = problem();
    let start = lowered(&problem, 0.0, 0.0);
    // No time is that of an end: an increment says whether it is one.
    let mut end = lowered(&problem, 0.7, 0.0);
    end.energies.external = 1.0;
    end.energies.stabilisation = 0.1;
    let kinds_at = |s: f64| {
        let mut judgement = Judgement::default();
        judgement.increment(&problem, &start, &end, InStep::up_to(0, s));
        kinds(&judgement.warnings(&problem, &Ending::Completed))
    };
    assert!(!kinds_at(1.0 - 1e-10).contains(&Kind::Stabilisation));
    assert!(kinds_at(1.0).contains(&Kind::Stabilisation));
}

#[test]
fn strain_energy_without_work_is_told() {
    let problem = problem();
    let start = lowered(&problem, 0.0, 0.0);
    let kinds_at = |share: f64| {
        let mut end = lowered(&problem, 1.0, 0.0);
        end.energies.strain = 1.0;
        end.energies.external = 1.0 - share;
        end.energies.numerical = -share;
        kinds(&judged(&problem, &[start.clone(), end]))
    };
    // A force that does not rise after all does half of the work of its last value.
    assert!(!kinds_at(0.5).contains(&Kind::Snap));
    assert!(kinds_at(0.9).contains(&Kind::Snap));
}

#[test]
fn tractions_of_round_off_are_not_judged_by_each_other() {
    let problem = problem();
    let mut states = [0.0, 1.0].map(|time| lowered(&problem, time, 0.0));
    // Of a modulus of 1000.
    states[1].pairs[0].nodes[0][0].pressure = 1e-13;
    states[1].pairs[0].nodes[0][3].pressure = -9e-13;
    assert_eq!(kinds(&judged(&problem, &states)), [Kind::NeverTouched]);
    states[1].pairs[0].nodes[0][3].pressure = -1e-6;
    let warnings = judged(&problem, &states);
    assert_eq!(kinds(&warnings), [Kind::Tension, Kind::NeverTouched]);
}

/// The upper block on the lower one, pressed at some nodes of its lower face.
fn touching(problem: &Problem, time: f64, pressed: impl Fn(&Vec3) -> bool) -> State {
    let mut state = lowered(problem, time, 0.1);
    let surface = problem.pairs[0].contact.sides[1].surface().unwrap();
    let area = 0.25 * (0.5_f64 / 3.0).powi(2);
    let of_facet = FacetForces {
        force: [Vec3::zeros(); 4],
        area: [area; 4],
        pressed: 4.0 * area,
        pressure: 0.0,
        friction: 0.0,
    };
    let facets = (0..surface.facets().len()).map(|at| (FacetId::new(at), of_facet));
    state.pairs[0].facets[1] = facets.collect();
    state.pairs[0].kept[1].fill(true);
    for (at, node) in surface.nodes().iter().enumerate() {
        let result = &mut state.pairs[0].nodes[1][at];
        let x = state.positions[problem.node(1, *node)];
        result.normal = -Vec3::z();
        result.slip = Vec3::x() * 0.05;
        result.pressure = f64::from(u8::from(pressed(&x)));
    }
    state
}

#[test]
fn a_node_that_friction_pushes_along_its_slip_is_named() {
    let problem = problem();
    let before = touching(&problem, 0.0, |_| true);
    let mut after = touching(&problem, 1.0, |_| true);
    for x in &mut after.positions[problem.first_node[1]..] {
        x.x += 0.05;
    }
    let nodes = &mut after.pairs[0].nodes[1];
    nodes
        .iter_mut()
        .for_each(|node| node.tau = -0.3 * Vec3::x());
    assert_eq!(doubts(&problem, &before, &after), []);
    // A corner, which has a quarter of one of nine facets.
    after.pairs[0].nodes[1][0].tau = 0.15 * Vec3::x();
    let found = doubts(&problem, &before, &after);
    let [Doubt::Gain(gain)] = &found[..] else {
        panic!("{found:?}");
    };
    let expected = 0.15 / (35.0 * 0.3 + 0.15);
    assert!((gain.share - expected).abs() < 1e-12, "{gain:?}");
    let surface = problem.pairs[0].contact.sides[1].surface().unwrap();
    assert_eq!((gain.body, gain.node), (1, surface.nodes()[0]));
    let warnings = judged(&problem, &[before.clone(), after.clone()]);
    let gain = warnings.iter().find(|warning| warning.kind == Kind::Gain);
    assert!(gain.is_some_and(|gain| {
        gain.text
            .contains("of `upper` in the direction of its slip")
    }));
    // Less than a twentieth of a facet is what meshes cannot follow.
    let nodes = after.pairs[0].nodes[1].iter_mut();
    nodes.for_each(|node| node.slip *= 0.1);
    assert_eq!(doubts(&problem, &before, &after), []);
}

#[test]
fn facets_that_are_too_coarse_for_their_contact_are_named() {
    let problem = problem();
    let inner = |x: &Vec3| (x.xy() - striae_mesh::Vec3::new(0.45, 0.55, 0.0).xy()).amax() < 0.1;
    let found = coarse(&problem, 0, &touching(&problem, 1.0, inner)).unwrap();
    // Four nodes with a facet each, of which the lower ones are larger.
    let width = 2.0 * 0.5 / 3.0;
    assert!((found.enough - width / 5.0).abs() < 1e-12, "{found:?}");
    assert_eq!((found.body, found.size), (0, 0.25));
    // Contact that reaches to the edges is as wide as these are.
    assert_eq!(
        coarse(&problem, 0, &touching(&problem, 1.0, |_| true)),
        None
    );
    assert_eq!(
        coarse(&problem, 0, &touching(&problem, 1.0, |_| false)),
        None
    );
}

#[test]
fn a_body_that_moves_against_its_loads_at_the_cost_of_contact_jumps() {
    let problem = problem();
    let before = lowered(&problem, 0.0, 0.1);
    let context = StepContext::new(&problem, 0, &before);
    let jumps = |way: f64, load: f64, contact: f64| {
        let (mut before, mut after) = (before.clone(), before.clone());
        for node in problem.nodes_of(1) {
            after.positions[node].x += way;
            after.forces.applied[node].x = load;
            before.forces.applied[node].x = load;
        }
        after.energies.contact = contact;
        jump(&context, &before, &after)
    };
    let count = problem.nodes_of(1).count() as f64;
    let paid = -0.2 * count;
    let found = jumps(0.2, -1.0, paid).unwrap();
    assert_eq!((found.body, found.driven), (1, 0.0));
    assert!((found.way - 0.2).abs() < 1e-12);
    assert_eq!(jumps(0.2, 1.0, paid), None, "with the load");
    assert_eq!(jumps(0.2, -1.0, 0.4 * paid), None, "something else pays");
    assert_eq!(jumps(0.05, -1.0, paid), None, "less than half a facet");
}

#[test]
fn depth_is_judged_at_its_worst_and_passages_by_themselves() {
    let problem = problem();
    let ways = [0.0, 0.11, 0.15, 0.12];
    let states = ways.map(|way| lowered(&problem, 10.0 * way, way));
    let warnings = judged(&problem, &states);
    // No node is pressed in these states.
    let expected = [Kind::Penetration, Kind::Unfelt, Kind::NeverTouched];
    assert_eq!(kinds(&warnings), expected);
    // The upper facets are the smaller ones.
    assert!((warnings[0].value - 0.05 / (0.5 / 3.0)).abs() < 1e-12);
    assert_eq!(warnings[0].time, 1.5);
    let through = [lowered(&problem, 0.0, 0.0), lowered(&problem, 1.0, 5.0)];
    let warnings = judged(&problem, &through);
    assert_eq!(kinds(&warnings), [Kind::Passage, Kind::NeverTouched]);
}

#[test]
fn tension_lost_energy_and_made_energy_are_judged_by_the_largest_so_far() {
    let problem = problem();
    let mut states = [0.0, 1.0, 2.0, 3.0].map(|time| lowered(&problem, time, 0.0));
    let node = |state: &mut State, node: usize, pressure: f64| {
        state.pairs[0].nodes[0][node].pressure = pressure;
    };
    node(&mut states[1], 0, 10.0);
    node(&mut states[2], 0, 1.0);
    node(&mut states[2], 3, -0.1);
    states[1].energies.strain = 4.0;
    states[1].energies.external = 4.0;
    states[2].energies.strain = 0.0;
    states[2].energies.external = 0.01;
    states[1].pairs[0].dissipated = 0.5;
    states[2].pairs[0].dissipated = 0.3;
    states[3].pairs[0].dissipated = 0.3;
    let warnings = judged(&problem, &states);
    let expected = [
        Kind::Tension,
        Kind::Creation,
        Kind::Imbalance,
        Kind::NeverTouched,
    ];
    assert_eq!(kinds(&warnings), expected);
    let values: Vec<f64> = warnings.iter().map(|warning| warning.value).collect();
    for (value, expected) in values.iter().zip([0.01, 0.05, 0.0025]) {
        assert!((value - expected).abs() < 1e-12, "{values:?}");
    }
    assert!(warnings[..3].iter().all(|warning| warning.time == 2.0));
}
