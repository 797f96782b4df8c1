//! The first deck of a newcomer with contact of everything: from a mesh of Gmsh to a picture.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Folder of the deck, and of the page that shows it.
fn how_to() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/book/how-to")
}

/// Standard output of the program, which has to succeed.
fn said(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(arguments)
        .output()
        .expect("the program");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{errors}");
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn the_deck_of_the_page_has_fewer_than_25_lines() {
    let deck = fs::read_to_string(how_to().join("tread/deck.toml")).expect("the deck");
    let page = fs::read_to_string(how_to().join("everything.md")).expect("the page");
    assert!(deck.lines().count() < 25);
    assert!(page.contains(&format!("```toml\n{deck}```")));
}

#[test]
fn a_tread_block_from_gmsh_leans_on_itself() {
    let folder = tempfile::tempdir().expect("a folder");
    let (deck, results) = (
        how_to().join("tread/deck.toml"),
        folder.path().join("results"),
    );
    let [deck, results] = [&deck, &results].map(|path| path.to_str().expect("text"));
    let checked = said(&["check", deck]);
    assert!(checked.contains("no faults, no warnings"), "{checked}");
    said(&["run", deck, "--out", results, "--quiet"]);
    let picture = folder.path().join("picture.png");
    let out = picture.to_str().expect("text");
    said(&["picture", results, "--out", out, "--view", "0.3,1,-0.2"]);
    assert!(fs::metadata(&picture).expect("the picture").len() > 10_000);

    let summary = fs::read_to_string(folder.path().join("results/summary.json"));
    let summary: serde_json::Value =
        serde_json::from_str(&summary.expect("a summary")).expect("JSON");
    assert_eq!(summary["status"], "completed");
    assert_eq!(summary["warnings"].as_array().map(Vec::len), Some(0));
    let pressed = |name: &str| {
        let pairs = summary["pairs"].as_array().expect("pairs");
        let pair = pairs.iter().find(|pair| pair["name"] == name);
        pair.expect("the pair")["pressure_integral"]
            .as_f64()
            .expect("a number")
    };
    // The block is pressed by 5 % of its height, with a modulus of 3 on 28 square millimetres.
    assert!((3.0..12.0).contains(&pressed("tread-road")));
    assert!(pressed("tread-tread") > 0.0);
}
