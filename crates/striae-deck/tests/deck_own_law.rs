//! A law of a program's own, named in a deck.

use std::path::Path;

use striae_deck::{Reader, json_schema, reference, write};
use striae_law::{
    Laws,
    declared::{Absent, Declared, Kind, POSITIVE, Parameter, Value},
    friction::Friction,
};

/// Coulomb friction between lubricated surfaces.
static LUBRICATED: Declared<Friction> = Declared {
    name: "lubricated",
    summary: "Coulomb friction that a lubricant lowers.",
    parameters: &[
        Parameter::number("dry", POSITIVE, "no unit", "Coefficient without lubricant."),
        Parameter::number("share", POSITIVE, "no unit", "Part of it that is left.")
            .or(Absent::Number(0.25)),
    ],
    build: |values| Friction::coulomb(values.number("dry") * values.number("share")),
    fit: None,
};

fn deck(friction: &str) -> String {
    format!(
        r#"title = "A lubricated block"
material = [{{ name = "rubber", law = "neo-hookean", youngs_modulus = 1, poissons_ratio = 0.3 }}]
rigid = [{{ name = "road", plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }} }}]
[[body]]
name = "block"
material = "rubber"
mesh = {{ generator = "block", size = [1, 1, 1], divisions = [1, 1, 1] }}
[[pair]]
name = "contact"
a = {{ body = "block", facets = "zmin" }}
b = {{ rigid = "road" }}
friction = {{ {friction} }}
[[step]]
name = "press"
displacement = [{{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.1 }}]
"#
    )
}

fn laws() -> Laws {
    Laws::default().with_friction(&LUBRICATED)
}

fn found(friction: &str) -> Result<Friction, String> {
    let laws = laws();
    let deck = Reader::new(&laws, &[]).parse(&deck(friction), "deck.toml", Path::new(""));
    let friction = deck.map(|deck| deck.model.pairs[0].friction.clone());
    friction.map_err(|faults| faults.to_string())
}

#[test]
fn a_deck_names_it_and_is_written_with_it() {
    let friction = found("law = \"lubricated\", dry = 0.8").unwrap();
    assert_eq!(friction.coefficient().at_rest(), 0.2);
    let statement = friction.statement().expect("it was made by a declaration");
    assert_eq!(statement.law, "lubricated");
    assert_eq!(statement.values.get("share"), Some(&Value::Number(0.25)));
    let laws = laws();
    let text = deck("law = \"lubricated\", dry = 0.4, share = 0.5, shear_cap = 7");
    let read = Reader::new(&laws, &[]);
    let read = |text: &str| read.parse(text, "deck.toml", Path::new("")).unwrap();
    let first = read(&text);
    let written = write(&first.model, &first.output).unwrap();
    assert!(
        written.contains("{ law = \"lubricated\", dry = 0.4, share = 0.5, shear_cap = 7.0 }"),
        "{written}"
    );
    let pair = |deck: &striae_deck::Deck| deck.model.pairs[0].friction.clone();
    assert_eq!(pair(&read(&written)), pair(&first));
}

#[test]
fn faults_name_its_keys_and_the_laws_that_are_known() {
    for (friction, told) in [
        (
            "law = \"lubricated\", dry = 1, shar = 0.8",
            "unknown key `shar` in [[pair]] friction; did you mean `share`?",
        ),
        ("law = \"lubricated\"", "`dry`"),
        (
            "law = \"lubricated\", dry = -1",
            "must be a number greater than 0",
        ),
        ("law = \"lubricate\", dry = 1", "did you mean `lubricated`?"),
    ] {
        let faults = found(friction).unwrap_err();
        assert!(faults.contains(told), "{faults}");
        assert!(faults.ends_with("1 fault"), "{faults}");
    }
    let elsewhere = striae_deck::parse(
        &deck("law = \"lubricated\", dry = 1"),
        "deck.toml",
        Path::new(""),
    );
    let faults = elsewhere.unwrap_err().to_string();
    assert!(faults.contains("`coulomb`"), "{faults}");
}

#[test]
fn schema_and_reference_list_it() {
    let schema = json_schema(&laws()).to_string();
    assert!(schema.contains("Coulomb friction that a lubricant lowers."));
    let reference = reference(&laws());
    let row = "| `share` (optional) | a number greater than 0 | Part of it that is left. Default: 0.25. |";
    assert!(reference.contains(row));
    assert!(!striae_deck::reference(&Laws::default()).contains("lubricant"));
}
