//! Materials with fibres.

use std::path::Path;

use striae_deck::{Deck, Faults, parse};
use striae_law::bulk::{Direction, FibreStiffness, Fibres, Law, LinesAbout};
use striae_mesh::Vec3;

fn read(law: &str, fibres: &str) -> Result<Deck, Faults> {
    let text = format!(
        r#"title = "A strap"
[[material]]
name = "strap"
{law}
fibres = [{fibres}]
[[body]]
name = "bar"
material = "strap"
mesh = {{ generator = "block", size = [1, 1, 1], divisions = [1, 1, 1] }}
[[step]]
name = "hold"
displacement = [{{ body = "bar", nodes = "all", x = 0, y = 0, z = 0 }}]
"#
    );
    parse(&text, "deck.toml", Path::new(""))
}

const RUBBER: &str = "law = \"isochoric-neo-hookean\"\nshear_modulus = 1\npoissons_ratio = 0.49";

fn told(law: &str, fibres: &str) -> Vec<String> {
    let faults = read(law, fibres).expect_err("faults");
    faults.iter().map(ToString::to_string).collect()
}

#[test]
fn families_have_their_constants_and_directions() {
    let deck = read(
        RUBBER,
        "{ k1 = 2, k2 = 3, dispersion = 0.1, direction = { uniform = [0, 2, 0] } }, \
         { k1 = 2, k2 = 0, direction = { circumferential = { direction = [0, 0, 1] }, turn = 30 } }, \
         { modulus = 5, direction = { radial = { point = [1, 0, 0], direction = [0, 0, 1] } } }",
    );
    let body = &deck
        .unwrap_or_else(|faults| panic!("{faults}"))
        .model
        .bodies[0];
    let exponential = |k1, k2, dispersion| FibreStiffness::Exponential { k1, k2, dispersion };
    let about = |point, lines| Direction::About {
        point,
        axis: Vec3::z(),
        lines,
    };
    let turn = 30f64.to_radians();
    let expected = [
        Fibres {
            stiffness: exponential(2.0, 3.0, 0.1),
            direction: Direction::Uniform(Vec3::new(0.0, 2.0, 0.0)),
        },
        Fibres {
            stiffness: exponential(2.0, 0.0, 0.0),
            direction: about(Vec3::zeros(), LinesAbout::Circumferential { turn }),
        },
        Fibres {
            stiffness: FibreStiffness::Linear { modulus: 5.0 },
            direction: about(Vec3::x(), LinesAbout::Radial),
        },
    ];
    assert_eq!(body.material.fibres(), expected);
    assert!(matches!(
        body.material.without_fibres().law(),
        Law::Hyperelastic(_)
    ));
}

#[test]
fn faults_of_fibres_are_named_where_they_are() {
    let along = "direction = { uniform = [1, 0, 0] }";
    for (law, fibres, expected) in [
        (
            RUBBER,
            format!("{{ k1 = 2, k2 = 3, dispersion = 0.4, {along} }}"),
            "deck.toml:7:10: the material is not admissible: `dispersion` of family 0 is 0.4, but it must be from 0 to 1/3",
        ),
        (
            RUBBER,
            "{ modulus = 2, direction = { uniform = [0, 0, 0] } }".to_owned(),
            "deck.toml:7:50: `uniform` in [[material]] fibres direction must not be the zero vector",
        ),
        (
            RUBBER,
            format!("{{ {along} }}"),
            "deck.toml:7:11: [[material]] fibres needs either `k1` and `k2` or `modulus`",
        ),
        (
            "law = \"linear-elastic\"\nyoungs_modulus = 1\npoissons_ratio = 0.3",
            format!("{{ modulus = 2, {along} }}"),
            "deck.toml:7:10: the material is not admissible: fibres need a neo-Hookean solid or rubber without relaxation around them, not a solid that is linear elastic",
        ),
        (
            RUBBER,
            String::new(),
            "deck.toml:7:10: the material is not admissible: there is no family of fibres, but at least one is needed",
        ),
    ] {
        assert_eq!(told(law, &fibres), [expected]);
    }
}
