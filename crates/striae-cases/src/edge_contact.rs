//! `edge-contact`: a block whose edges press on a thin plate, ever more finely divided.
//!
//! Counts the runs that get through without a cut.

use striae_deck::Deck;

use super::{
    battery::Battery,
    study::{Extent, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("edge-contact": "deck");
/// Edges within elements of the plate and on lines of its mesh: name, size and origin.
const BLOCKS: [(&str, f64, f64); 2] = [("within", 4.4, 2.8), ("flush", 4.0, 3.0)];
const FRICTION: [(&str, &str); 2] = [
    ("frictionless", r#"{ law = "frictionless" }"#),
    ("mu 0.4", r#"{ law = "coulomb", mu = 0.4 }"#),
];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let divisions = match study.extent {
        Extent::Full => (3..=12).collect(),
        Extent::Quick => vec![3, 5, 8],
    };
    let mut battery = Battery::new(BLOCKS[0].1.powi(2));
    for (edges, size, origin) in BLOCKS {
        for (sliding, friction) in FRICTION {
            for &n in &divisions {
                let deck = pressed(study, [size, origin], n, friction)?;
                let group = format!("{edges}, {sliding}");
                let name = format!("{edges}-{}-{n}", sliding.replace(' ', "-"));
                battery.run(study, &group, &name, deck)?;
            }
        }
    }
    battery.measure(study);
    battery.write(study)
}

/// The deck with another block.
fn pressed(
    study: &Study,
    [size, origin]: [f64; 2],
    n: usize,
    friction: &str,
) -> Result<Deck, Failure> {
    let [(name, text)] = DECKS;
    let block = format!(
        "origin = [{origin}, {origin}, 0], size = [{size}, {size}, 2], divisions = [{n}, {n}, {}]",
        (n / 2).max(2)
    );
    let passages = [
        [
            "origin = [2.8, 2.8, 0], size = [4.4, 4.4, 2], divisions = [6, 6, 3]",
            block.as_str(),
        ],
        [r#"{ law = "frictionless" }"#, friction],
    ];
    study.variant(name, text, &passages)
}
