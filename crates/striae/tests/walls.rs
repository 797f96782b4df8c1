//! Friction along the only way that walls and planes of symmetry leave to nodes.

use std::path::Path;

use striae::{deck, prelude::*};

/// A slice between two smooth walls is pushed along a floor, first slipping one way, then
/// turning round in places. Slip that jumped from one side of the slip surface to the other
/// made Newton's method cycle here.
#[test]
fn slip_between_walls_is_found_in_few_iterations() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/plate-on-rigid-plane/deck.toml");
    let deck = deck::read(&path).expect("a published deck");
    let run = Simulation::of(deck).expect("a model").run().expect("a run");
    assert_eq!(run.ending, Ending::Completed);
    assert_eq!(run.summary.cutbacks, 0);
    assert!(run.summary.newton_max <= 5, "{}", run.summary.newton_max);
}

/// A block of one element is pressed onto a nap along its free direction, so that friction holds one
/// edge better than the other: one slips outwards, one sticks. Both slip once neither can stick, the
/// first one inwards then, and Newton's method cycled at any size of the increment. The forces are
/// those of linear elasticity, by the stiffness of the element and all nine cases of stick and slip,
/// of which one satisfies the law.
#[test]
fn edges_that_friction_holds_unequally_find_who_slips() {
    let deck = |increments: usize| {
        let text = format!(
            r#"
title = "Pressed onto a nap"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.4
[[body]]
name = "block"
material = "rubber"
formulation = "standard"
mesh = {{ generator = "block", divisions = [1, 1, 1], size = [0.6, 1, 1] }}
[[rigid]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }}
[[pair]]
name = "sole"
a = {{ rigid = "floor", texture = {{ uniform = [0, 1, 0] }} }}
b = {{ body = "block", facets = "zmin" }}
friction = {{ law = "nap", mu_forward = 0.5, mu_backward = 0.75, mu_lateral = 0.6 }}
[[step]]
name = "press"
increments = {increments}
displacement = [
    {{ body = "block", nodes = "ymin", y = 0 }},
    {{ body = "block", nodes = "ymax", y = 0 }},
    {{ body = "block", nodes = "zmax", x = 0, y = 0, z = -1e-5 }},
]
"#
        );
        deck::parse(&text, "deck.toml", Path::new("")).expect("a deck")
    };
    for increments in [1, 4] {
        let simulation = Simulation::of(deck(increments)).expect("a model");
        let run = simulation.run().expect("a run");
        assert_eq!(run.ending, Ending::Completed);
        assert_eq!(run.summary.cutbacks, 0);
        let results = run.results();
        let force = results.pair("sole").expect("a pair").sides[0].force;
        let [along, normal] = [force.x.abs(), force.z].map(|force| force / 1e-5);
        assert!((normal - 0.905_259).abs() < 1e-4, "{normal}");
        assert!((along - 0.019_023).abs() < 1e-4, "{along}");
    }
}
