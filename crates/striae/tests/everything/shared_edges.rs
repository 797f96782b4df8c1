//! Nodes that faces of several pairs share.

use striae::{Finished, mesh::Vec3};

use super::{completed, forces};

const NAP: &str = r#"{ law = "nap", mu_forward = 0.21, mu_backward = 0.49, mu_lateral = 0.34 }"#;
const TEXTURE: &str = "texture = { uniform = [0.31355, -0.372, 0.87367] }";

/// A stiff slider with a nap on its sole that is pressed onto a slab and drawn along it, both turned
/// at will.
fn drawn(contact: &str) -> Finished {
    let turned =
        "rotation = { axis = [0.72587, 0.68763, 0.01651], about = [0, 0, 0], degrees = 119.048 }";
    let text = format!(
        r#"
title = "A slider with a nap"
[[material]]
name = "soft"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.18
[[material]]
name = "stiff"
law = "neo-hookean"
youngs_modulus = 6.5
poissons_ratio = 0.17
[[body]]
name = "slab"
material = "soft"
mesh = {{ generator = "block", origin = [-0.2, -0.5, -0.34], size = [1.3, 1, 0.34], divisions = [6, 5, 2], {turned} }}
[[body]]
name = "slider"
material = "stiff"
mesh = {{ generator = "block", origin = [-0.2, -0.2, 0], size = [0.4, 0.4, 0.32], divisions = [2, 1, 2], {turned} }}
{contact}
[[step]]
name = "press"
increments = 1
displacement = [
    {{ body = "slab", nodes = "zmin", x = 0, y = 0, z = 0 }},
    {{ body = "slider", nodes = "zmax", x = -0.003, y = 0.003, z = 0.00237 }},
]
[[step]]
name = "slide"
increments = 1
displacement = [{{ body = "slider", nodes = "zmax", x = 0.063, y = 0.164, z = -0.125 }}]
"#
    );
    completed(&text)
}

/// The flanks of the slider meet its sole, and their corners touch the slab. Friction of what only
/// touches takes directions of the nodes of the sole, which keeps its friction all the same.
#[test]
fn flanks_that_touch_take_no_friction_from_a_sole() {
    let everything = drawn(&format!(
        "[contact]\nall = true\n[[contact.between]]\na = \"slab.zmax\"\nb = \"slider.zmin\"\nfriction = {NAP}\n[[contact.surface]]\nof = \"slider.zmin\"\n{TEXTURE}"
    ));
    let named = drawn(&format!(
        "[[pair]]\nname = \"sole\"\na = {{ body = \"slab\", facets = \"zmax\" }}\nb = {{ body = \"slider\", facets = \"zmin\", {TEXTURE} }}\nfriction = {NAP}"
    ));
    let everything = forces(&everything, "slab.zmax-slider.zmin");
    let named = forces(&named, "sole");
    let ends = |forces: [Vec<f64>; 3]| Vec3::from(forces.map(|force| *force.last().unwrap()));
    let [all, sole] = [everything, named].map(ends);
    assert!(sole.norm() > 1e-4, "{sole}");
    assert!((all - sole).norm() < 1e-8, "{all} for {sole}");
}
