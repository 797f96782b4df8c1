//! A stiff block that slides over a softer plank by large parts of a facet in one increment.

use std::path::Path;

use striae_contact::{evaluation::Evaluation, side::Side};
use striae_deck::parse;
use striae_solve::{
    drive::{Continue, Observer, Progress, run},
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    report::pairs,
    state::State,
};

const MU: f64 = 0.4;
/// Steps of a run, one slide after the other.
const INCREMENTS: usize = 10;

/// The block is pressed into the plank, then drawn along it by `way` in all.
fn deck(way: f64) -> String {
    format!(
        r#"
title = "Block on a plank"
[[material]]
name = "stiff"
law = "neo-hookean"
youngs_modulus = 1e9
poissons_ratio = 0.3
[[material]]
name = "soft"
law = "neo-hookean"
youngs_modulus = 1e7
poissons_ratio = 0.3
[[body]]
name = "plank"
material = "soft"
mesh = {{ generator = "block", origin = [-0.3, 0, -2.1538], size = [0.6, 0.5, 2.1538], divisions = [1, 1, 7] }}
[[body]]
name = "block"
material = "stiff"
mesh = {{ generator = "block", origin = [0.3, 0, -1.2309], size = [0.6, 0.5, 0.8], divisions = [1, 1, 2] }}
[[pair]]
name = "contact"
a = {{ body = "block", facets = "xmin" }}
b = {{ body = "plank", facets = "xmax" }}
friction = {{ law = "coulomb", mu = {MU} }}
[[step]]
name = "press"
increments = 4
displacement = [
    {{ body = "plank", nodes = "xmin", x = 0, y = 0, z = 0 }},
    {{ body = "plank", nodes = "ymin", y = 0 }},
    {{ body = "plank", nodes = "ymax", y = 0 }},
    {{ body = "block", nodes = "xmax", x = -0.005, y = 0, z = 0 }},
    {{ body = "block", nodes = "ymin", y = 0 }},
    {{ body = "block", nodes = "ymax", y = 0 }},
]
[[step]]
name = "slide"
increments = {INCREMENTS}
displacement = [{{ body = "block", nodes = "xmax", z = {way} }}]
"#
    )
}

/// Keeps every converged state.
#[derive(Default)]
struct States(Vec<State>);

impl IterationObserver for States {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for States {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, _: Progress, increment: &Increment) -> Continue {
        self.0.push(increment.state.clone());
        Continue::Yes
    }

    fn cut_back(&mut self, _: Progress, _: &CutBack) -> Continue {
        Continue::Yes
    }
}

/// Friction opposes the slip at every node, and its resultant is `mu` times the normal force but
/// for the tilt of the facets.
#[test]
fn friction_opposes_slip_at_every_node() {
    let facet = 2.1538 / 7.0;
    for part in [0.1, 0.17, 0.25, 0.325] {
        let way = -part * facet * INCREMENTS as f64;
        let model = parse(&deck(way), "deck.toml", Path::new("")).unwrap().model;
        let problem = Problem::new(model).unwrap();
        let mut states = States::default();
        let (_, ending) = run(&problem, State::undeformed(&problem), &mut states);
        assert_eq!(ending, Ending::Completed);
        assert!(states.0.len() >= 4 + INCREMENTS);
        for state in states.0.iter().filter(|state| state.time > 1.5) {
            let force = pairs(&problem, state)[0].sides[Side::A].force;
            let ratio = (force.z / force.x).abs();
            assert!((ratio - MU).abs() < 0.004, "{part} {} {ratio}", state.time);
            for node in state.pairs[0].nodes.iter().flatten() {
                let work = -node.tau.dot(&node.slip);
                assert!(work >= -1e-9 * node.tau.norm() * facet, "{part} {work:e}");
            }
        }
    }
}
