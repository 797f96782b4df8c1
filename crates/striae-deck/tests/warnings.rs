//! What is judged of increments, from states made by hand.

use std::path::Path;

use striae_deck::parse;
use striae_mesh::Vec3;
use striae_solve::{
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
        judgement.increment(problem, &pair[0], &pair[1]);
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

#[test]
fn depth_is_judged_at_its_worst_and_passages_by_themselves() {
    let problem = problem();
    let ways = [0.0, 0.11, 0.15, 0.12];
    let states = ways.map(|way| lowered(&problem, 10.0 * way, way));
    let warnings = judged(&problem, &states);
    // No node is pressed in these states.
    let expected = [Kind::Penetration, Kind::Unfelt, Kind::NeverTouched];
    assert_eq!(kinds(&warnings), expected);
    assert!((warnings[0].value - 0.05 / 0.25).abs() < 1e-12);
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
