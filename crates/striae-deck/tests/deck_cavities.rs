//! Cavities and their contents: their meaning, their faults, and decks that are written of them.

use std::path::Path;

use striae_deck::{Deck, Faults, parse, write};
use striae_model::{BodyId, CavityContent, CavityFilling, CavityId, Curve};

/// A slice of a tube with a cavity.
fn read(held: &str, first: &str, second: &str) -> Result<Deck, Faults> {
    let text = format!(
        r#"title = "A tube"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3

[[body]]
name = "tube"
material = "rubber"
mesh = {{ generator = "annulus", inner_radius = 0.2, outer_radius = 0.5, width = 0.4, divisions = [1, 8, 1] }}
node_sets = [{{ name = "half", from = [-1, -1, -1], to = [1, 1, 0.1] }}]

[[cavity]]
name = "inside"
faces = [{{ body = "tube", facets = "rim" }}]

[[step]]
name = "first"
displacement = [
    {held},
    {{ body = "tube", nodes = "half", x = 0, z = 0 }},
]
cavity = [{first}]

[[step]]
name = "second"
cavity = [{second}]
"#
    );
    parse(&text, "deck.toml", Path::new(""))
}

const SIDES: &str = r#"{ body = "tube", nodes = "sides", y = 0 }"#;

fn contents(first: &str, second: &str) -> Deck {
    let deck = read(SIDES, first, second);
    deck.unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn all_contents_are_read_and_written() {
    let gas = CavityContent::Gas {
        ambient: 2.0,
        exponent: 1.0,
    };
    let polytropic = CavityContent::Gas {
        ambient: 2.0,
        exponent: 1.4,
    };
    for (stated, content, curve) in [
        (
            "pressure = 0.1, curve = \"smooth\"",
            CavityContent::Pressure(0.1),
            Curve::Smooth,
        ),
        ("volume = 0.05", CavityContent::Volume(0.05), Curve::Ramp),
        (
            "volume_ratio = 1.1",
            CavityContent::VolumeRatio(1.1),
            Curve::Ramp,
        ),
        ("gas = { ambient = 2 }", gas, Curve::Ramp),
        (
            "gas = { ambient = 2, exponent = 1.4 }",
            polytropic,
            Curve::Ramp,
        ),
    ] {
        let deck = contents("", &format!("{{ cavity = \"inside\", {stated} }}"));
        let cavity = &deck.model.cavities[0];
        assert_eq!((cavity.name.as_str(), cavity.parts.len()), ("inside", 1));
        assert_eq!((cavity.parts[0].0, cavity.parts[0].1.len()), (BodyId(0), 8));
        let expected = CavityFilling {
            cavity: CavityId(0),
            content,
            curve,
        };
        assert_eq!(deck.model.steps[1].fillings, [expected]);
        let text = write(&deck.model, &deck.output).unwrap();
        let again = parse(&text, "again.toml", Path::new(""));
        let again = again.unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(again.model.cavities[0].parts[0].1.len(), 8);
        assert_eq!(again.model.steps[1].fillings, deck.model.steps[1].fillings);
        assert_eq!(write(&again.model, &again.output).unwrap(), text);
    }
}

fn told(held: &str, first: &str) -> String {
    let faults = read(held, first, "").expect_err("faults");
    faults.to_string()
}

#[test]
fn faults_have_their_place_and_a_remedy() {
    let open = told(r#"{ body = "tube", nodes = "ymin", y = 0 }"#, "");
    assert!(open.starts_with("deck.toml:16:8: "), "{open}");
    assert!(open.contains("its surface ends at the edge from"), "{open}");
    let said = told(SIDES, "{ cavity = \"insides\", pressure = 1 }");
    assert!(said.contains("did you mean `inside`?"), "{said}");
    let said = told(SIDES, "{ cavity = \"inside\", volume = -1 }");
    assert!(said.contains("volume"), "{said}");
    let said = told(SIDES, "{ cavity = \"inside\" }");
    assert!(said.contains("pressure"), "{said}");
    let gas = "{ cavity = \"inside\", gas = { ambient = 1 }, curve = \"smooth\" }";
    let said = told(SIDES, gas);
    assert!(said.contains("deck.toml:25:11: "), "{said}");
    assert!(said.contains("remove the curve"), "{said}");
}
