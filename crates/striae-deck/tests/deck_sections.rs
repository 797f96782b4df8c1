//! Bodies of several materials.

use std::path::Path;

use striae_deck::{Deck, Faults, parse};
use striae_mesh::ElementId;
use striae_model::{BodySection, Formulation};

/// A bar of three elements along `x` with the lines given in its table.
fn read(body: &str, steps: &str) -> Result<Deck, Faults> {
    let text = format!(
        r#"title = "A bar of several materials"

[[material]]
name = "steel"
law = "linear-elastic"
youngs_modulus = 2.1e5
poissons_ratio = 0.3
density = 7.8e-9

[[material]]
name = "gum"
law = "mooney-rivlin"
c10 = 0.3
c01 = 0.1
poissons_ratio = 0.499

[[body]]
name = "bar"
mesh = {{ generator = "block", size = [3, 1, 1], divisions = [3, 1, 1] }}
element_sets = [
    {{ name = "left", from = [0, 0, 0], to = [1, 1, 1] }},
    {{ name = "rest", numbers = [1, 2] }},
    {{ name = "middle", numbers = [1] }},
    {{ name = "sides", union = ["left"] }},
]
{body}
[[step]]
name = "hold"
displacement = [{{ body = "bar", nodes = "all", x = 0, y = 0, z = 0 }}]
{steps}"#
    );
    parse(&text, "deck.toml", Path::new(""))
}

fn told(body: &str, steps: &str) -> Vec<String> {
    let faults = read(body, steps).expect_err("faults");
    faults.iter().map(ToString::to_string).collect()
}

#[test]
fn sections_have_their_elements_materials_and_formulations() {
    let deck = read(
        r#"material = "steel"
        sections = [{ elements = "left", material = "gum" },
                    { elements = "middle", material = "steel", formulation = "assumed-strain" }]"#,
        "",
    );
    let body = &deck
        .unwrap_or_else(|faults| panic!("{faults}"))
        .model
        .bodies[0];
    let [gum, steel] = &body.sections[..] else {
        panic!("{:?}", body.sections)
    };
    assert_eq!(gum.elements, [ElementId(0)]);
    assert_eq!(gum.material.name(), "Mooney-Rivlin");
    // Its Poisson's ratio asks for it.
    assert_eq!(gum.formulation, Formulation::MeanDilatation);
    assert_eq!(gum.density, 0.0);
    let expected = BodySection {
        set: "middle".into(),
        elements: vec![ElementId(1)],
        material: body.material.clone(),
        formulation: Formulation::AssumedStrain,
        density: 7.8e-9,
    };
    assert_eq!(*steel, expected);
    assert_eq!(body.formulation, Formulation::Standard);
    assert_eq!(body.section_of_elements(), [1, 2, 0]);
    assert_eq!(body.used_sections(), [0, 1, 2]);
}

#[test]
fn sections_have_the_formulation_that_their_body_states() {
    let deck = read(
        r#"material = "steel"
        formulation = "assumed-strain"
        sections = [{ elements = "left", material = "gum" },
                    { elements = "middle", material = "gum", formulation = "standard" }]"#,
        "",
    );
    let deck = deck.unwrap_or_else(|faults| panic!("{faults}"));
    let sections = deck.model.bodies[0].sections.iter();
    let formulations: Vec<Formulation> = sections.map(|section| section.formulation).collect();
    assert_eq!(
        formulations,
        [Formulation::AssumedStrain, Formulation::Standard]
    );
}

#[test]
fn a_body_all_in_sections_needs_no_material_of_its_own() {
    let sections = r#"sections = [{ elements = "left", material = "gum" },
                                  { elements = "rest", material = "steel" }]"#;
    let deck = read(sections, "").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(deck.model.bodies[0].used_sections(), [1, 2]);
    let missing = r#"sections = [{ elements = "left", material = "gum" }]"#;
    assert_eq!(
        told(missing, ""),
        [
            "deck.toml:18:8: body `bar` has no `material` of its own, and 2 of its elements are in no section, the first is element 1; give the body a material, or all elements a section"
        ]
    );
    assert_eq!(
        told("", ""),
        [
            "deck.toml:18:8: body `bar` has no `material` of its own, and 3 of its elements are in no section, the first is element 0; give the body a material, or all elements a section"
        ]
    );
}

#[test]
fn faults_of_sections_are_named_where_they_are() {
    for (what, sections, expected) in [
        (
            "two sections with one element",
            r#"{ elements = "rest", material = "gum" }, { elements = "middle", material = "steel" }"#,
            "deck.toml:27:54: element 1 of body `bar` is in two sections, `rest` and `middle`; each element needs exactly one material",
        ),
        (
            "no such set",
            r#"{ elements = "lift", material = "gum" }"#,
            "deck.toml:27:26: body `bar` has no element set `lift`; it has `all`, `left`, `middle`, `rest`, `sides`; did you mean `left`?",
        ),
        (
            "no such material",
            r#"{ elements = "left", material = "gun" }"#,
            "deck.toml:27:45: no material is named `gun`; there are `gum`, `steel`; did you mean `gum`?",
        ),
    ] {
        let body = format!("material = \"steel\"\nsections = [{sections}]");
        assert_eq!(told(&body, ""), [expected], "{what}");
    }
}

#[test]
fn all_sections_need_a_density_where_there_is_weight() {
    let gravity = "gravity = { vector = [0, 0, -9.81] }";
    let part = r#"sections = [{ elements = "left", material = "gum" }]"#;
    let text = told(&format!("material = \"steel\"\n{part}"), gravity);
    assert_eq!(
        text,
        [
            "deck.toml:28:1: body `bar` has inertia or weight in step `hold`, but the material of its section `left` has no `density`; give it one"
        ]
    );
}
