//! Laws of a program's own, named in a deck.

use std::path::Path;

use striae_deck::{Laws, Reader, json_schema, reference, write};
use striae_declared::{Absent, Declared, Kind, POSITIVE, Parameter, Value};
use striae_law::{
    bulk::{DualNum, Inadmissible, Invariant, Isochoric, IsochoricLaw, Material, RUBBER, battery},
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

/// Rubber whose energy grows with a power of the invariant:
/// `G/(2 n) ((1 + I1 - 3)^n - 1)`.
#[derive(Debug)]
struct Power {
    shear: f64,
    exponent: f64,
}

impl IsochoricLaw for Power {
    fn name(&self) -> &str {
        "power"
    }

    fn shear(&self) -> f64 {
        self.shear
    }

    fn energy(&self, i1: Invariant, _: Invariant) -> Invariant {
        ((i1 - 2.0).powf(self.exponent) - 1.0) * (0.5 * self.shear / self.exponent)
    }
}

static POWER: Declared<Material> = Declared {
    name: "power",
    summary: "Rubber that stiffens by a power of the invariant.",
    parameters: &[
        Parameter::number(
            "shear_modulus",
            POSITIVE,
            "force per area",
            "Shear modulus.",
        ),
        Parameter::number("exponent", POSITIVE, "no unit", "The power.").or(Absent::Number(2.0)),
        RUBBER,
    ],
    build: |values| {
        let [shear, exponent] = ["shear_modulus", "exponent"].map(|name| values.number(name));
        if exponent > 9.0 {
            return Err(Inadmissible::Own {
                parameter: Some("exponent"),
                reason: format!("`exponent` is {exponent}, but it must be at most 9"),
            });
        }
        Material::rubber(Isochoric::own(Power { shear, exponent }), values)
    },
    fit: None,
};

fn deck(friction: &str) -> String {
    let rubber = "law = \"neo-hookean\", youngs_modulus = 1, poissons_ratio = 0.3";
    deck_of(rubber, friction)
}

fn deck_of(rubber: &str, friction: &str) -> String {
    format!(
        r#"title = "A lubricated block"
material = [{{ name = "rubber", {rubber} }}]
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
    Laws::default().with_friction(&LUBRICATED).with_bulk(&POWER)
}

fn bulk(rubber: &str) -> Result<striae_deck::Deck, String> {
    let laws = laws();
    let text = deck_of(rubber, "law = \"frictionless\"");
    let deck = Reader::new(&laws, &[]).parse(&text, "deck.toml", Path::new(""));
    deck.map_err(|faults| faults.to_string())
}

#[test]
fn a_bulk_law_is_named_and_written_with_what_all_rubber_has() {
    let relaxing = "relaxation = [{ ratio = 0.5, time = 2.0 }]";
    let keys = "law = \"power\", shear_modulus = 2, exponent = 1.5, poissons_ratio = 0.4";
    let first = bulk(&format!("{keys}, {relaxing}")).unwrap();
    let rubber = &first.model.bodies[0].material;
    assert_eq!(rubber.lame_constants().shear, 2.0);
    assert_eq!(rubber.name(), "viscoelastic");
    assert_eq!(battery(rubber), []);
    let written = write(&first.model, &first.output).unwrap();
    let lines = format!(
        "law = \"power\"\nshear_modulus = 2.0\nexponent = 1.5\npoissons_ratio = 0.4\nvolumetric = \"quadratic\"\n{relaxing}\n"
    );
    assert!(written.contains(&lines), "{written}");
    let laws = laws();
    let again = Reader::new(&laws, &[]).parse(&written, "deck.toml", Path::new(""));
    assert_eq!(&again.unwrap().model.bodies[0].material, rubber);
}

#[test]
fn faults_of_a_bulk_law_are_where_its_keys_are() {
    for (rubber, told) in [
        (
            "law = \"power\", shear_modulus = 2, bulk_modulus = 9, exponent = 10",
            "deck.toml:2:95: the material is not admissible: `exponent` is 10, but it must be at most 9",
        ),
        (
            "law = \"power\", shear_modulus = 2",
            "[[material]] needs either `bulk_modulus` or `poissons_ratio`",
        ),
        (
            "law = \"power\", bulk_modulus = 9, shear_modulus = -2",
            "`shear_modulus` in [[material]] must be a number greater than 0, but is -2",
        ),
        ("law = \"powr\", bulk_modulus = 9", "did you mean `power`?"),
    ] {
        let faults = bulk(rubber).unwrap_err();
        assert!(faults.contains(told), "{faults}");
        assert!(faults.ends_with("1 fault"), "{faults}");
    }
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
    assert!(schema.contains("Rubber that stiffens by a power of the invariant."));
    let row = "| `exponent` (optional) | a number greater than 0 | The power. Default: 2. |";
    assert!(reference.contains(row));
}
