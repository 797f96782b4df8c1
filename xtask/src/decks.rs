//! Decks of small runs that tasks try.

/// A pad of rubber that is pressed on a rigid floor and dragged over it.
pub struct Pad {
    /// Elements along its edges.
    pub divisions: [usize; 3],
    /// Surface that has grooves.
    pub grooved: Grooved,
    /// Increments of the press and of the drag.
    pub increments: [usize; 2],
    /// Way of the drag.
    pub way: f64,
    /// Lines of `[output]`.
    pub output: &'static str,
}

/// A surface with grooves.
pub enum Grooved {
    /// The pad; its grooves turn and stretch with it.
    Pad,
    /// The floor.
    Floor,
}

impl Pad {
    /// The text.
    pub fn deck(&self) -> String {
        let Self {
            divisions,
            increments: [press, drag],
            way,
            output,
            ..
        } = self;
        let texture = ", texture = { uniform = [1, 1, 0] }";
        let [of_pad, of_floor] = match self.grooved {
            Grooved::Pad => [texture, ""],
            Grooved::Floor => ["", texture],
        };
        format!(
            r#"
title = "A pad, pressed on a floor and dragged"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.4

[[body]]
name = "pad"
material = "rubber"
mesh = {{ generator = "block", size = [1, 1, 0.4], divisions = {divisions:?} }}

[[rigid]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }}

[[pair]]
name = "sole"
a = {{ body = "pad", facets = "zmin"{of_pad} }}
b = {{ rigid = "floor"{of_floor} }}
friction = {{ law = "orthotropic", mu_along = 0.2, mu_across = 0.5 }}

[[step]]
name = "press"
increments = {press}
displacement = [{{ body = "pad", nodes = "zmax", x = 0, y = 0, z = -0.03 }}]

[[step]]
name = "drag"
increments = {drag}
displacement = [{{ body = "pad", nodes = "zmax", x = {way} }}]

[output]
{output}
"#
        )
    }
}

/// Two textured blocks that slide on each other.
pub const BLOCKS: &str = r#"
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
