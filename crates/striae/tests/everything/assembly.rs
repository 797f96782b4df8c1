//! Assemblies of many bodies, most of which never meet.

use std::{collections::BTreeSet, fmt::Write, path::Path};

use striae::{
    Simulation,
    advice::{Advice, Topic},
    deck,
    output::{history::Table, vtk::read_series},
};
use striae_solve::outcome::Ending;

/// Piles of two blocks each, in a row with gaps of a tenth of their width.
fn piles(count: usize) -> String {
    let mut text = String::from(
        r#"
title = "Piles"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3
[contact]
all = true
friction = { law = "coulomb", mu = 0.3 }
"#,
    );
    let (mut bodies, mut ends) = (String::new(), String::new());
    for pile in 0..count {
        for (name, z) in [("foot", 0), ("head", 1)] {
            writeln!(
                bodies,
                "[[body]]\nname = \"{name}-{pile}\"\nmaterial = \"rubber\"\nmesh = {{ generator = \
                 \"block\", origin = [{pile}, 0, {z}], size = [0.9, 0.9, 1], divisions = [1, 1, 1] }}"
            )
            .expect("a string");
        }
        writeln!(
            ends,
            "    {{ body = \"foot-{pile}\", nodes = \"zmin\", x = 0, y = 0, z = 0 }},\n    {{ body = \
             \"head-{pile}\", nodes = \"zmax\", x = 0.05, y = 0, z = -0.02 }},"
        )
        .expect("a string");
    }
    text += &bodies;
    text + "[[step]]\nname = \"press\"\nincrements = 2\ndisplacement = [\n" + &ends + "]\n"
}

#[test]
fn pairs_that_never_meet_leave_no_files() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let deck = deck::parse(&piles(4), "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let run = Simulation::of(deck).unwrap().recorded(folder, "piles");
    let run = run.run().unwrap();
    assert_eq!(run.ending, Ending::Completed);
    let snapshots = read_series(&folder.join("contact.pvd")).unwrap();
    let last = snapshots.last().unwrap().parts.iter();
    let names: BTreeSet<&str> = last.map(|(name, _)| name.as_str()).collect();
    for pile in 0..4 {
        let [foot, head] = ["foot", "head"].map(|of| format!("{of}-{pile}"));
        assert!(
            names.contains(format!("{foot}-{head}-{foot}").as_str()),
            "{names:?}"
        );
    }
    let meets = |name: &&&str| name.starts_with("foot-0-");
    let of_first: Vec<_> = names.iter().filter(meets).collect();
    // Heads and feet of neighbours face each other across the gap; those farther away do not.
    assert!(
        of_first
            .iter()
            .all(|name| !name.contains("-2") && !name.contains("-3"))
    );
    let laws = std::fs::read_dir(folder).unwrap();
    let laws = laws.filter(|file| {
        let name = file.as_ref().expect("a file").file_name();
        name.to_string_lossy().starts_with("law-")
    });
    assert_eq!(laws.count(), 1, "all pairs have one law");
}

#[test]
fn piles_beside_each_other_bear_what_one_alone_bears() {
    let force = |count: usize| {
        let deck = deck::parse(&piles(count), "deck", Path::new(""));
        let deck = deck.unwrap_or_else(|f| panic!("{f}"));
        let run = Simulation::of(deck).unwrap().run().unwrap();
        assert_eq!(run.ending, Ending::Completed);
        let results = run.results();
        let forces = (0..count).map(|pile| {
            let pair = results.pair(&format!("foot-{pile}-head-{pile}"));
            pair.expect("a pair").sides[0].force
        });
        forces.collect::<Vec<_>>()
    };
    let alone = force(1)[0];
    for force in force(5) {
        assert!(
            (force - alone).norm() < 1e-10 * alone.norm(),
            "{force} {alone}"
        );
    }
}

#[test]
fn advice_counts_pairs_that_are_far_apart() {
    let count = 5;
    let deck = deck::parse(&piles(count), "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let advice = Advice::of(&deck.model);
    let fits = advice.notes.iter().filter(|note| note.topic == Topic::Fit);
    let near: Vec<_> = fits.collect();
    // Within a pile, between feet, between heads, and both ways across each gap.
    assert_eq!(near.len(), count + 4 * (count - 1));
    let all = 2 * count * (2 * count - 1) / 2;
    let told = format!("{} pairs of surfaces farther apart", all - near.len());
    for told in [
        &told,
        "body `foot-0` may touch all surfaces, itself included",
    ] {
        let mut notes = advice.notes.iter();
        assert!(notes.any(|note| note.text.contains(told)), "{told}");
    }
}

#[test]
fn pairs_have_columns_from_their_first_touch_on() {
    // The heads begin above the feet and reach them in the second increment.
    let text = piles(2)
        .replace(", 0, 1], size", ", 0, 1.015], size")
        .replace("increments = 2", "increments = 4");
    let parsed = || deck::parse(&text, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let recorded = Simulation::of(parsed()).unwrap().recorded(folder, "piles");
    let recorded = recorded.run().unwrap();
    let table = Table::read(&folder.join("history.csv")).unwrap();
    let alone = Simulation::of(parsed()).unwrap().run().unwrap();
    assert_eq!(table, recorded.history);
    assert_eq!(table.columns, alone.history.columns);
    let columns = table.columns.iter();
    let pairs: BTreeSet<&str> = columns
        .filter_map(|column| column.strip_prefix("pair.")?.strip_suffix(".mismatch"))
        .collect();
    assert_eq!(
        pairs.into_iter().collect::<Vec<_>>(),
        ["foot-0-head-0", "foot-1-head-1"]
    );
    let column = |name: &str| table.column(&format!("pair.foot-1-head-1.{name}")).unwrap();
    let [stick, slip, open] = ["stick", "slip", "open"].map(column);
    assert_eq!(stick[0] + slip[0], 0.0);
    assert!(stick[3] + slip[3] > 0.0);
    for row in 0..4 {
        assert_eq!(stick[row] + slip[row] + open[row], open[0]);
    }
    assert_eq!(column("resultant_a.z")[0], 0.0);
    assert!(column("resultant_a.z")[3] < 0.0);
}
