//! Decks whose reports are tried.

/// A pad that is dragged over a rigid, grooved floor.
const PAD: &str = r#"
title = "A pad on a grooved floor"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.4

[[body]]
name = "pad"
material = "rubber"
mesh = { generator = "block", origin = [0, 0, 0], size = [1, 1, 0.4], divisions = [8, 8, 3] }

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

[[pair]]
name = "sole"
a = { body = "pad", facets = "zmin" }
b = { rigid = "floor", texture = { uniform = [1, 1, 0] } }
friction = { law = "orthotropic", mu_along = 0.2, mu_across = 0.5 }

[[step]]
name = "press"
increments = 2
displacement = [{ body = "pad", nodes = "zmax", x = 0, y = 0, z = -0.03 }]

[[step]]
name = "drag"
increments = 4
displacement = [{ body = "pad", nodes = "zmax", x = 0.4 }]
"#;

/// Two textured blocks that slide on each other.
const BLOCKS: &str = r#"
title = "Two blocks <with> \"textures\" & more"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3

[[body]]
name = "lower"
material = "rubber"
mesh = { generator = "block", size = [1, 1, 0.5], divisions = [5, 5, 2] }

[[body]]
name = "upper"
material = "rubber"
mesh = { generator = "block", origin = [0.2, 0.2, 0.5], size = [0.6, 0.6, 0.5], divisions = [4, 4, 2] }

[[pair]]
name = "interface"
a = { body = "lower", facets = "zmax", texture = { uniform = [1, 1, 0] } }
b = { body = "upper", facets = "zmin", texture = { uniform = [1, 0, 0] } }
friction = { law = "two-textures", mu = 0.3, c_mag = 0.1, c_ang = 0.1, c_cen = 0.5 }

[[step]]
name = "press"
increments = 2
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.03 },
]

[[step]]
name = "slide"
increments = 4
displacement = [{ body = "upper", nodes = "zmax", x = 0.08 }]
"#;

/// Names and texts.
pub const DECKS: [(&str, &str); 2] = [("pad", PAD), ("blocks", BLOCKS)];
