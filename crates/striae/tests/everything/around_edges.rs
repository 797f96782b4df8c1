//! Nodes that move around edges.

use std::path::Path;

use striae::{deck, prelude::*};

/// Two blocks with a slanting common face end at the same edges, some of them acute. Pressed
/// together, nodes on these edges go into the other block by a millionth of a facet and out again
/// at its flank, which is no way through it.
#[test]
fn flush_blocks_with_acute_edges_are_pressed_together() {
    let text = r#"
title = "Blocks with a slanting common face"
[[material]]
name = "stiff"
law = "neo-hookean"
youngs_modulus = 100
poissons_ratio = 0.49
[[material]]
name = "soft"
law = "neo-hookean"
youngs_modulus = 6
poissons_ratio = 0
[[body]]
name = "lower"
material = "stiff"
mesh = { generator = "block", origin = [0, 0, -0.6], size = [1, 1, 0.6], divisions = [8, 2, 1], top_slopes = [-0.14, -0.25] }
[[body]]
name = "upper"
material = "soft"
mesh = { generator = "block", size = [1, 1, 0.6], divisions = [7, 8, 4], bottom_slopes = [-0.14, -0.25] }
[contact]
all = true
friction = { law = "coulomb", mu = 0.56 }
[[step]]
name = "press"
increments = 1
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = -4e-4 },
]
"#;
    let deck = deck::parse(text, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let run = Simulation::of(deck).unwrap().run().unwrap();
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    assert_eq!(run.summary.cutbacks, 0);
}
