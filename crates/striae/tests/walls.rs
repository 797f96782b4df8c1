//! Friction along the only way that walls leave to nodes.

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
