//! Friction along the only way that walls and planes of symmetry leave to nodes.

use std::path::Path;

use striae::{Finished, deck, prelude::*};

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

/// A block that is pressed on a finer one and slides over it along `x` by `slip`. The nodes of the
/// finer one are held by `hold`; both begin at `from` along `y`, `width` wide, of elements of 0.25
/// and 0.5, where `also` is prescribed, too.
fn sliding_over_held_nodes(
    hold: &str,
    (from, width): (f64, f64),
    slip: f64,
    also: &str,
) -> Finished {
    let [fine, coarse] = [4.0 * width, 2.0 * width];
    let text = format!(
        r#"
title = "Sliding over held nodes"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "rubber"
mesh = {{ generator = "block", origin = [0, {from}, -0.5], size = [2, {width}, 0.5], divisions = [16, {fine}, 1] }}
[[body]]
name = "upper"
material = "rubber"
mesh = {{ generator = "block", origin = [0.5, {from}, 0], size = [1, {width}, 0.5], divisions = [3, {coarse}, 1] }}
[[pair]]
name = "sole"
a = {{ body = "upper", facets = "zmin" }}
b = {{ body = "lower", facets = "zmax" }}
friction = {{ law = "coulomb", mu = 0.2 }}
[[step]]
name = "press"
increments = 1
displacement = [
    {{ body = "lower", nodes = "zmin", y = 0, z = 0 }},
    {{ body = "lower", nodes = "zmax", {hold} }},
    {{ body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.001 }},
    {also}
]
[[step]]
name = "slide"
increments = 2
displacement = [{{ body = "upper", nodes = "zmax", x = {slip} }}]
"#
    );
    let deck = deck::parse(&text, "deck.toml", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let run = Simulation::of(deck).expect("a model").run().expect("a run");
    assert_eq!(run.ending, Ending::Completed);
    run
}

/// Displacements hold the finer side in one tangential direction, where the few free nodes of the
/// coarser side alone respond to friction. Its magnitude and direction follow the law all the same.
#[test]
fn friction_is_not_lost_where_the_finer_side_is_held() {
    for hold in ["x = 0", "axes = { normal = [1, 0.3, 0] }, x = 0"] {
        let run = sliding_over_held_nodes(hold, (0.0, 1.0), 0.2, "");
        let force = |axis: &str| {
            let column = format!("pair.sole.resultant_a.{axis}");
            run.history.column(&column).expect("a column")
        };
        let [x, y, z] = ["x", "y", "z"].map(force);
        for at in 1..x.len() {
            let (along, across) = (x[at] / z[at], y[at] / x[at]);
            assert!((along + 0.2).abs() < 2e-4, "{hold}: {along}");
            assert!(across.abs() < 2e-3, "{hold}: {across}");
        }
    }
}

/// The nodes of a plane of symmetry have no friction across it, whether they are held along it or
/// not: both halves of a block transmit half of its force.
#[test]
fn a_half_of_what_slides_over_held_nodes_has_half_the_force() {
    let symmetry = "{ body = \"lower\", nodes = \"ymin\", y = 0 }, { body = \"upper\", nodes = \"ymin\", y = 0 }";
    for (slip, tolerance) in [(0.2, 2e-4), (2e-4, 5e-3)] {
        let whole = sliding_over_held_nodes("x = 0", (-1.0, 2.0), slip, "");
        let half = sliding_over_held_nodes("x = 0", (0.0, 1.0), slip, symmetry);
        let force = |run: &Finished| {
            *run.history
                .column("pair.sole.resultant_a.x")
                .unwrap()
                .last()
                .unwrap()
        };
        let ratio = 2.0 * force(&half) / force(&whole);
        assert!((ratio - 1.0).abs() < tolerance, "{slip}: {ratio}");
    }
}
