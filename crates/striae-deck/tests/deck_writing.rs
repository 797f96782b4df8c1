//! Models written as decks read back to the same models.

use std::path::{Path, PathBuf};

use striae_deck::{Deck, parse, read, write};
use striae_model::{Initial, Model};

/// All decks of the published cases.
fn published() -> Vec<PathBuf> {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let entries = |folder: &Path| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).expect("a folder");
        entries
            .map(|entry| entry.expect("an entry").path())
            .collect()
    };
    let folders = entries(&cases).into_iter().filter(|path| path.is_dir());
    let files = folders.flat_map(|folder| entries(&folder));
    let is_deck = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        path.extension().is_some_and(|end| end == "toml") && text.contains("[[body]]")
    };
    let mut decks: Vec<PathBuf> = files.filter(is_deck).collect();
    decks.sort();
    decks
}

/// The model in every bit but for what no deck states: that gaps of its meshes have been
/// closed.
fn told(model: &Model) -> String {
    let mut model = model.clone();
    for pair in &mut model.pairs {
        if let Initial::Close(_) = pair.initial {
            pair.initial = Initial::AsMeshed;
        }
    }
    format!("{model:?}")
}

/// The deck is written, read and written again.
fn assert_round_trip(deck: &Deck, name: &str) {
    let text = write(&deck.model, &deck.output).expect("a deck can state it");
    let again = parse(&text, name, Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
    let [one, other] = [told(&deck.model), told(&again.model)];
    if one != other {
        let at = one
            .bytes()
            .zip(other.bytes())
            .take_while(|(a, b)| a == b)
            .count();
        let from = at.saturating_sub(200);
        let [one, other] = [&one, &other].map(|text| text.get(from..at + 80).unwrap_or(""));
        panic!("{name}:\n{one}\n{other}");
    }
    assert_eq!(deck.output, again.output);
    assert_eq!(
        write(&again.model, &again.output).expect("it was written before"),
        text
    );
}

/// Nodes of the largest model that is written; the deck of a million unknowns would take a
/// minute.
const NODES: usize = 50_000;

#[test]
fn all_published_decks_read_back_to_the_same_models() {
    let mut written = 0;
    for path in published() {
        let deck = read(&path).unwrap_or_else(|faults| panic!("{faults}"));
        let bodies = deck.model.bodies.iter();
        if bodies.map(|body| body.mesh.positions.len()).sum::<usize>() < NODES {
            assert_round_trip(&deck, &path.display().to_string());
            written += 1;
        }
    }
    assert!(written > 30, "{written}");
}

const EVERYTHING: &str = include_str!("deck/everything.toml");

#[test]
fn all_that_a_deck_can_say_is_written() {
    let deck = parse(EVERYTHING, "everything", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    assert_round_trip(&deck, "everything");
}

#[test]
fn all_dependences_of_friction_are_written() {
    let decay = "decay = { kinetic_over_static = 0.7, slip_rate = 0.3 }";
    for keys in [
        r#"by_pressure = { form = "power-law", exponent = 0.67, pressure = 1e5 }"#,
        r#"by_pressure = { form = "power-law", exponent = 1.2, pressure = 1e5, floor = 7 }"#,
        r#"by_pressure = { form = "adhesion", pressure = 3e3, floor = 11.3 }"#,
        r#"by_pressure = { form = "saturation", shear_stress = 7e4 }, decay = { kinetic_over_static = 0.3, slip_rate = 0.1 }"#,
        r#"by_pressure = { form = "table", pressures = [0, 1e3, 1e5], factors = [1.3, 1.1, 0.7] }"#,
        r#"by_slip_rate = { form = "stribeck", kinetic_over_static = 0.7, slip_rate = 0.3 }"#,
        r#"by_slip_rate = { form = "stribeck", kinetic_over_static = 0.7, slip_rate = 0.3, exponent = 1.3, viscous = 0.1 }"#,
        r#"by_slip_rate = { form = "logarithm", factor = 0.1, slip_rate = 1e-3 }"#,
        r#"by_slip_rate = { form = "logarithm", factor = -0.1, slip_rate = 1e-3, limit = 1 }"#,
        r#"by_accumulated_slip = { form = "exponential", final_over_initial = 1.7, slip = 0.3 }"#,
        r#"by_accumulated_slip = { form = "table", slips = [0, 0.1, 1], factors = [1, 1.4, 0.9] }"#,
        r#"by_state = { form = "ageing-law", direct_effect = 0.01, evolution_effect = 0.015, slip_rate = 1e-6, slip_distance = 1e-5 }"#,
        r#"by_state = { form = "slip-law", direct_effect = 0.01, evolution_effect = 0, slip_rate = 1e-6, slip_distance = 1e-5, state = 3 }"#,
        r#"by_state = { form = "static-kinetic", kinetic_over_static = 0.6, slip_distance = 1e-5, healing_time = 3, state = 0.5 }"#,
        r#"by_state = { form = "logarithmic-healing", factor = 0.05, slip_distance = 1e-5, healing_time = 3 }"#,
        r#"by_slip_rate = { form = "table", slip_rates = [0, 0.1, 1], factors = [1, 0.8, 0.9] }"#,
    ] {
        let text = EVERYTHING.replacen(decay, keys, 1);
        assert_ne!(text, EVERYTHING);
        let deck = parse(&text, keys, Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
        assert_round_trip(&deck, keys);
    }
}

#[test]
fn members_by_number_are_judged() {
    let faulty = |from: &str, to: &str| {
        let text = write(
            &parse(EVERYTHING, "everything", Path::new(""))
                .expect("a deck")
                .model,
            &Default::default(),
        );
        let text = text.expect("a deck").replacen(from, to, 1);
        parse(&text, "deck", Path::new("")).unwrap_err().to_string()
    };
    let told = faulty("sides = [[0, ", "sides = [[9999, ");
    assert!(
        told.contains("of element 9999 is not on its boundary"),
        "{told}"
    );
    let told = faulty("numbers = [0, ", "numbers = [9999, ");
    assert!(
        told.contains("there is no node 9999: it has nodes: "),
        "{told}"
    );
    let told = faulty("cells = [\n    [", "cells = [\n    [0, ");
    assert!(told.contains("no kind of element has corners: 9"), "{told}");
}
