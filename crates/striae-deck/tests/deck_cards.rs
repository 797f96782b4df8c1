//! Materials of Abaqus files become sections of bodies.

use std::path::Path;
use striae_deck::{Deck, parse};
use striae_law::bulk::{
    Branch, Hardening, Hyperelastic, Isochoric, LameConstants, Material, OgdenTerm, Plastic,
    Viscoelastic, Volumetric,
};

/// Two cubes with an element set each.
const CUBES: &str = "*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0., 0.
4, 0., 1., 0.
5, 1., 1., 0.
6, 2., 1., 0.
11, 0., 0., 1.
12, 1., 0., 1.
13, 2., 0., 1.
14, 0., 1., 1.
15, 1., 1., 1.
16, 2., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=Left
7, 1, 2, 5, 4, 11, 12, 15, 14
*ELEMENT, TYPE=C3D8, ELSET=Right
8, 2, 3, 6, 5, 12, 13, 16, 15
*NSET, NSET=held
1, 4, 11, 14
";

const DECK: &str = r#"title = "Two materials"
[[body]]
name = "bar"
mesh = { file = "bar.inp", materials = true }
[[step]]
name = "pull"
displacement = [{ body = "bar", nodes = "held", x = 0, y = 0, z = 0 }]
"#;

/// The deck with a file of these cards; its faults.
fn lowered(cards: &str, deck: &str) -> Result<Deck, Vec<String>> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bar.inp"), CUBES.to_owned() + cards).unwrap();
    let place = format!("{}/", folder.path().display());
    parse(deck, "deck.toml", Path::new(folder.path())).map_err(|faults| {
        let faults = faults.iter();
        faults
            .map(|fault| fault.to_string().replace(&place, ""))
            .collect()
    })
}

/// The material of the left cube, with these options.
fn left(options: &str) -> Material {
    let cards = format!(
        "*SOLID SECTION, ELSET=left, MATERIAL=one\n*SOLID SECTION, ELSET=RIGHT, MATERIAL=TWO\n\
         *MATERIAL, NAME=One\n{options}*MATERIAL, NAME=Two\n*DENSITY\n7.8,\n*ELASTIC\n100., 0.25\n"
    );
    let model = lowered(&cards, DECK).unwrap_or_else(|faults| panic!("{faults:?}"));
    let body = &model.model.bodies[0];
    let sets: Vec<&str> = body
        .sections
        .iter()
        .map(|section| &section.set[..])
        .collect();
    assert_eq!(sets, ["Left", "Right"]);
    let second = LameConstants::from_youngs_modulus(100.0, 0.25).unwrap();
    assert_eq!(body.sections[1].material, Material::neo_hookean(second));
    assert_eq!(
        [body.sections[0].density, body.sections[1].density],
        [0.0, 7.8]
    );
    body.sections[0].material.clone()
}

fn rubber(isochoric: Isochoric, bulk: f64) -> Hyperelastic {
    Hyperelastic::new(isochoric, bulk, Volumetric::Quadratic).unwrap()
}

#[test]
fn cards_become_laws() {
    let plain = |isochoric, bulk| Material::hyperelastic(rubber(isochoric, bulk));
    assert_eq!(
        left("*HYPERELASTIC, NEO HOOKE\n0.5, 0.02\n"),
        plain(Isochoric::NeoHookean { shear: 1.0 }, 100.0)
    );
    let (c10, c01) = (0.5, 0.25);
    assert_eq!(
        left("*HYPERELASTIC, MOONEY-RIVLIN\n0.5, 0.25, 0.02\n"),
        plain(Isochoric::MooneyRivlin { c10, c01 }, 100.0)
    );
    let (c20, c30) = (-0.125, 0.0625);
    assert_eq!(
        left("*HYPERELASTIC, YEOH\n0.5, -0.125, 0.0625, 0.02\n"),
        plain(Isochoric::Yeoh { c10, c20, c30 }, 100.0)
    );
    let terms = [(2.0, 2.0), (-0.25, -2.0)].map(|(mu, alpha)| OgdenTerm { mu, alpha });
    assert_eq!(
        left("*HYPERELASTIC, OGDEN, N=2\n2., 2., 0.25, -2., 0.02, 0.\n"),
        plain(Isochoric::Ogden(terms.into()), 100.0)
    );
    let constants = LameConstants::from_youngs_modulus(70.0, 0.25).unwrap();
    let hardening = Hardening::table(&[[0.0, 2.0], [0.5, 3.0]]).unwrap();
    assert_eq!(
        left("*ELASTIC\n70., 0.25\n*PLASTIC\n2., 0.\n3., 0.5\n"),
        Material::plastic(Plastic::new(constants, hardening))
    );
}

/// With half the modulus relaxing, sudden deformations meet what `INSTANTANEOUS` states.
#[test]
fn what_relaxes_is_stated_for_slow_or_sudden_deformations() {
    let branches = [(0.25, 0.5), (0.25, 8.0)].map(|(g, time)| Branch {
        ratio: g / 0.5,
        time,
    });
    let prony = "*VISCOELASTIC, TIME=PRONY\n0.25, 0., 0.5\n0.25, 0., 8.\n";
    for (moduli, slow) in [
        ("", 1.0),
        (", MODULI=LONG TERM", 1.0),
        (", MODULI=INSTANTANEOUS", 0.5),
    ] {
        let expected = |isochoric, bulk| {
            let slow = rubber(isochoric, bulk);
            Material::viscoelastic(Viscoelastic::new(slow, &branches).unwrap())
        };
        let shear = slow;
        assert_eq!(
            left(&format!(
                "*HYPERELASTIC, NEO HOOKE{moduli}\n0.5, 0.02\n{prony}"
            )),
            expected(Isochoric::NeoHookean { shear }, 100.0),
            "{moduli}"
        );
        // E = 2.5 and nu = 0.25 are G = 1 and K = 5/3.
        let bulk = 2.5 / 1.5;
        assert_eq!(
            left(&format!("*ELASTIC{moduli}\n2.5, 0.25\n{prony}")),
            expected(Isochoric::NeoHookean { shear }, bulk),
            "{moduli}"
        );
    }
}

#[test]
fn what_cannot_be_used_is_named_where_the_deck_asks_for_it() {
    let start = "deck.toml:4:8: the materials of the mesh of body `bar` cannot be used: ";
    for (cards, cause) in [
        (
            "",
            "it assigns no material to an element set, as *SOLID SECTION of Abaqus does",
        ),
        (
            "*SOLID SECTION, ELSET=Left, MATERIAL=foam\n",
            "there is no material `foam`",
        ),
        (
            "*SOLID SECTION, ELSET=Left, MATERIAL=foam\n*MATERIAL, NAME=foam\n*HYPERFOAM\n1., 2., 3.\n",
            "bar.inp: line 22: expected *DENSITY, *ELASTIC, *HYPERELASTIC, *PLASTIC or *VISCOELASTIC, found `*HYPERFOAM`",
        ),
        (
            "*SOLID SECTION, ELSET=Left, MATERIAL=a\n*MATERIAL, NAME=a\n*ELASTIC\n1., .3\n*PLASTIC\n2., .1\n",
            "material `a`: ",
        ),
    ] {
        let faults = lowered(cards, DECK).unwrap_err();
        assert_eq!(faults.len(), 1, "{faults:?}");
        let expected = format!("{start}{cause}");
        assert!(faults[0].starts_with(&expected), "{} {expected}", faults[0]);
    }
    // Elements that the file gives no material need one of the deck.
    let part = "*SOLID SECTION, ELSET=Left, MATERIAL=a\n*MATERIAL, NAME=a\n*ELASTIC\n1., .3\n";
    let faults = lowered(part, DECK).unwrap_err();
    assert!(
        faults[0].contains("1 of its elements are in no section"),
        "{faults:?}"
    );
    let own = DECK.replace(
        "materials = true }",
        "materials = true }\nmaterial = \"own\"",
    ) + "[[material]]\nname = \"own\"\nlaw = \"neo-hookean\"\nyoungs_modulus = 2\npoissons_ratio = 0\n";
    assert_eq!(
        lowered(part, &own).unwrap().model.bodies[0].sections.len(),
        1
    );
    // What a deck does not ask for is no fault of its.
    let unasked = own.replace(", materials = true", "");
    let foam = "*MATERIAL, NAME=foam\n*HYPERFOAM\n1., 2., 3.\n";
    assert_eq!(
        lowered(foam, &unasked).unwrap().model.bodies[0].sections,
        []
    );
}
