//! Advice on decks with physical mistakes, and none on published cases.

mod general;
mod mistakes;
mod published;

use std::path::Path;

use striae::deck::{self, Deck, Faults};

/// A pad on a floor without a mistake.
const DECK: &str = r#"
title = "A pad on a floor"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3

[[body]]
name = "pad"
material = "rubber"
mesh = { generator = "block", origin = [0, 0, 0], size = [1, 1, 1], divisions = [3, 3, 3] }

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

CONTACT

[[step]]
name = "press"
displacement = [{ body = "pad", nodes = "zmax", x = 0, y = 0, z = -0.02 }]
"#;

const PRESSED: &str =
    r#"displacement = [{ body = "pad", nodes = "zmax", x = 0, y = 0, z = -0.02 }]"#;
const COULOMB: &str = r#"friction = { law = "coulomb", mu = 0.3 }"#;

/// The deck with its contact and with passages replaced.
fn read(contact: &str, passages: &[[&str; 2]]) -> Result<Deck, Faults> {
    let deck = DECK.replace("CONTACT", contact);
    let text = passages.iter().fold(deck, |text, [old, new]| {
        assert_eq!(text.matches(old).count(), 1, "`{old}`");
        text.replace(old, new)
    });
    deck::parse(&text, "deck.toml", Path::new(""))
}
