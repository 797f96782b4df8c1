//! The deck of the trials, and how files of its run are damaged.

/// A block that is pressed on a floor with a texture and dragged: a second or so.
pub const DECK: &str = r#"
title = "A block, pressed and dragged"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3

[[body]]
name = "block"
material = "rubber"
mesh = { generator = "block", size = [1, 1, 1], divisions = [2, 2, 2] }

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

[[pair]]
name = "sole"
a = { body = "block", facets = "zmin", texture = { uniform = [1, 1, 0] } }
b = { rigid = "floor" }
friction = { law = "orthotropic", mu_along = 0.2, mu_across = 0.4 }

[[step]]
name = "press"
increments = 10
displacement = [{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.05 }]

[[step]]
name = "drag"
increments = 30
displacement = [{ body = "block", nodes = "zmax", x = 1 }]

[output]
fields_every = 5
checkpoint_every = 10
"#;

/// A file with a fault, and what `resume` has to say of it.
pub type Damage = (&'static str, fn(&[u8]) -> Vec<u8>, &'static str);

/// What is damaged, one at a time.
pub const DAMAGES: [Damage; 6] = [
    ("history.csv", first_half, "history.csv"),
    ("history.csv", with_another_digit, "history.csv"),
    ("checkpoint.bin", first_half, "checkpoint.bin"),
    ("checkpoint.bin", with_another_digit, "checkpoint.bin"),
    ("fields/block-00005.vtu", first_half, "block-00005.vtu"),
    (
        "fields/block-00005.vtu",
        with_another_digit,
        "block-00005.vtu",
    ),
];

fn first_half(bytes: &[u8]) -> Vec<u8> {
    bytes[..bytes.len() / 2].to_vec()
}

/// The last digit before the middle becomes another one; without digits, a byte does.
fn with_another_digit(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let middle = bytes.len() / 2;
    let digit = bytes[..middle].iter().rposition(u8::is_ascii_digit);
    let at = digit.unwrap_or(middle);
    bytes[at] ^= 1;
    bytes
}
