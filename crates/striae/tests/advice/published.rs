//! The decks of the published cases have neither faults nor warnings.

use std::{fs, path::Path};

use striae::{advice::Advice, deck};

#[test]
fn published_cases_have_no_warnings() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let mut seen = 0;
    for case in fs::read_dir(cases).expect("the folder of the cases") {
        for file in fs::read_dir(case.expect("a case").path()).expect("the folder of a case") {
            let path = file.expect("a file").path();
            let text = match path.extension().is_some_and(|end| end == "toml") {
                true => fs::read_to_string(&path).expect("a text"),
                false => continue,
            };
            // What is expected of a case, and laws on their own, are no decks.
            if !text.contains("[[step]]") {
                continue;
            }
            let deck = deck::read(&path).expect("a published case is valid");
            let advice = Advice::of(&deck.model);
            let found: Vec<_> = advice.faults.iter().chain(&advice.warnings).collect();
            assert!(found.is_empty(), "{}: {found:?}", path.display());
            assert!(!advice.notes.is_empty());
            seen += 1;
        }
    }
    assert!(seen >= 39, "{seen} decks");
}
