//! Decks whose runs are disturbed, or cannot go on.

use crate::decks::{Grooved, Pad};

/// A run of some seconds on three ranks.
pub const PAD: Pad = Pad {
    divisions: [6, 6, 4],
    grooved: Grooved::Pad,
    increments: [10, 24],
    way: 0.6,
    output: "checkpoint_every = 10",
};

/// Pad in smaller increments: `mpirun` waits a second before it passes SIGTERM on, and steps must
/// remain then, however fast the machine is.
pub const LONG: Pad = Pad {
    increments: [10, 120],
    ..PAD
};

/// A long block on a floor. Of the element in one of its corners one face is held and the other
/// pushed through it: all its nodes are prescribed, so that it turns inside out whatever the rest
/// does. Smaller increments come close to that.
pub const CRUSHED: &str = r#"
title = "A block of which one corner is pushed in"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3

[[body]]
name = "block"
material = "rubber"
mesh = { generator = "block", size = [4, 1, 1], divisions = [12, 3, 3] }
node_sets = [
    { name = "held", from = [3.6, 0.6, 0.6], to = [3.7, 1.1, 1.1] },
    { name = "pushed", from = [3.9, 0.6, 0.6], to = [4.1, 1.1, 1.1] },
]

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

[[pair]]
name = "sole"
a = { body = "block", facets = "zmin" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = 0.3 }

[[step]]
name = "press"
increments = 4
displacement = [{ body = "block", nodes = "xmin", x = 0, y = 0, z = -0.01 }]

[[step]]
name = "push"
increments = 5
displacement = [
    { body = "block", nodes = "held", x = 0, y = 0, z = 0 },
    { body = "block", nodes = "pushed", x = -0.4, y = 0, z = 0 },
]
"#;
