//! Springs and dashpots: their meaning, their faults, and decks that are written of them.

use std::path::Path;

use striae_deck::{Deck, Faults, parse, write};
use striae_mesh::{NodeId, Vec3};
use striae_model::{BodyId, RigidId, Spring, SpringEnd, SpringLine, SpringRest};

/// A block and a rigid wheel with springs.
fn read(springs: &str) -> Result<Deck, Faults> {
    let text = format!(
        r#"title = "A block on springs"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3

[[body]]
name = "block"
material = "rubber"
mesh = {{ generator = "block", size = [1, 1, 1], divisions = [1, 1, 1] }}
node_sets = [{{ name = "corner", numbers = [7] }}]

[[rigid]]
name = "wheel"
plane = {{ point = [0, 0, 3], normal = [0, 0, -1] }}
reference = [0.5, 0.5, 3]
{springs}

[[step]]
name = "rest"
displacement = [{{ body = "block", nodes = "zmin", x = 0, y = 0, z = 0 }}]
"#
    );
    parse(&text, "deck.toml", Path::new(""))
}

const ALL: &str = r#"
[[spring]]
name = "mount"
a = { body = "block", nodes = "zmax" }
direction = [0, 3, 4]
stiffness = 2

[[spring]]
name = "link"
a = { body = "block", nodes = "corner" }
b = { rigid = "wheel" }
stiffness = 3
damping = 0.1
free_length = 1.5

[[spring]]
name = "anchor"
a = { rigid = "wheel", point = [1, 0, 3] }
b = { fixed = [2, 0, 3] }
preload = -0.3

[[spring]]
name = "within"
a = { rigid = "wheel" }
b = { body = "block", nodes = "corner" }
damping = 1
"#;

#[test]
fn all_kinds_are_read() {
    let deck = read(ALL).unwrap_or_else(|faults| panic!("{faults}"));
    let [mount, link, anchor, within] = &deck.model.springs[..] else {
        panic!("{:?}", deck.model.springs)
    };
    assert_eq!(mount.line, SpringLine::Along(Vec3::new(0.0, 0.6, 0.8)));
    assert_eq!((mount.stiffness, mount.damping), (2.0, 0.0));
    assert_eq!(mount.rest, SpringRest::Slack);
    let corner = SpringEnd::Nodes {
        body: BodyId(0),
        nodes: vec![NodeId(7)],
    };
    let reference = SpringEnd::Rigid {
        rigid: RigidId(0),
        point: Vec3::new(0.5, 0.5, 3.0),
    };
    let expected = Spring {
        name: "link".into(),
        a: corner.clone(),
        line: SpringLine::To(reference.clone()),
        stiffness: 3.0,
        damping: 0.1,
        rest: SpringRest::Length(1.5),
    };
    assert_eq!(*link, expected);
    assert_eq!(anchor.line, SpringLine::ToPoint(Vec3::new(2.0, 0.0, 3.0)));
    assert_eq!(anchor.rest, SpringRest::Preload(-0.3));
    assert_eq!(
        (&within.a, &within.line),
        (&reference, &SpringLine::To(corner))
    );
}

#[test]
fn decks_of_springs_mean_the_same() {
    let deck = read(ALL).unwrap_or_else(|faults| panic!("{faults}"));
    let text = write(&deck.model, &deck.output).unwrap();
    let again =
        parse(&text, "again.toml", Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(again.model.springs, deck.model.springs);
    assert_eq!(write(&again.model, &again.output).unwrap(), text);
}

/// Line, column and message of the first fault.
fn told(spring: &str) -> String {
    let faults = read(&format!("[[spring]]\nname = \"s\"\n{spring}")).expect_err("faults");
    let first = faults.iter().next().expect("a fault").to_string();
    first
        .split_once(':')
        .map_or("", |(_, rest)| rest)
        .to_owned()
}

#[test]
fn faults_have_their_place_and_a_remedy() {
    let on = "a = { body = \"block\", nodes = \"zmax\" }\n";
    for (stated, expected) in [
        (
            "stiffness = 1",
            "it has no second end; give it an end `b`, or a `direction`",
        ),
        (
            "b = { rigid = \"wheel\" }\ndirection = [1, 0, 0]\nstiffness = 1",
            "it has both a `direction` and an end `b`; remove one of them",
        ),
        (
            "b = { rigid = \"wheel\" }\nstiffness = 1\nfree_length = 1\npreload = 1",
            "it has both a `free_length` and a `preload`",
        ),
        (
            "direction = [0, 0, 0]\nstiffness = 1",
            "must not be the zero vector",
        ),
        (
            "direction = [0, 0, 1]",
            "it has no force; give it a `stiffness`",
        ),
        (
            "b = { body = \"block\", nodes = \"zmin\" }\nstiffness = 1",
            "its end `b` has 4 nodes",
        ),
        (
            "b = { fixed = [0, 0, 1] }\nstiffness = 1",
            "both of its ends are at (0, 0, 1)",
        ),
        (
            "b = { rigid = \"whell\" }\nstiffness = 1",
            "did you mean `wheel`?",
        ),
        ("direction = [0, 0, 1]\nstiffness = -1", "stiffness"),
    ] {
        let said = told(&format!("{on}{stated}"));
        assert!(said.contains(expected), "{said}\n{expected}");
        assert!(
            said.starts_with(|first: char| first.is_ascii_digit()),
            "{said}"
        );
    }
}
