//! Displacements in axes of their own, in decks that are run and in faulty ones.

mod driven;

use std::path::Path;

use striae_deck::{parse, write};
use striae_mesh::Vec3;
use striae_model::Axes;
use striae_solve::report::reactions;

const BLOCK: &str = r#"
title = "a block"

[[material]]
name = "elastic"
law = "neo-hookean"
youngs_modulus = 100
poissons_ratio = 0.3

[[body]]
name = "block"
material = "elastic"
mesh = { generator = "block", size = [1, 1, 1], divisions = [2, 2, 2], rotation = { axis = [0, 1, 0], degrees = 30 } }
"#;

/// A step with these displacements.
fn step(name: &str, displacements: &str) -> String {
    format!("\n[[step]]\nname = \"{name}\"\nincrements = 2\ndisplacement = [{displacements}]\n")
}

fn faults(rest: &str) -> String {
    let found = parse(&format!("{BLOCK}{rest}"), "deck", Path::new("")).expect_err(rest);
    found.to_string()
}

/// Along the block, which is turned by 30 degrees about `y`.
const ALONG: &str = "[[0.8660254037844387, 0, -0.5], [0, 1, 0]]";

#[test]
fn a_turned_block_on_a_rest_is_pressed_along_itself() {
    // The rest holds the normal only, one corner the rest of what moves it as a whole.
    let held = format!(
        r#"{{ body = "block", nodes = "zmin", axes = {{ normal = [0.5, 0, 0.8660254037844387] }}, x = 0 }},
           {{ body = "block", nodes = "xmin", axes = {{ normal = [0.8660254037844387, 0, -0.5] }}, x = 0 }},
           {{ body = "block", nodes = "ymin", y = 0 }},
           {{ body = "block", nodes = "zmax", axes = {ALONG}, z = -0.1 }}"#
    );
    let (problem, state) = driven::last(&format!("{BLOCK}{}", step("press", &held)));
    let all = reactions(&problem, &state);
    let found = |set: &str| {
        let mut all = all.iter();
        all.find(|(name, _)| name.ends_with(set))
            .expect("a reaction")
            .1
    };
    let n = Vec3::new(0.5, 0.0, 0.75_f64.sqrt());
    let (low, high) = (found("zmin"), found("zmax"));
    assert!((low + high).norm() < 1e-9, "{low} {high}");
    assert!(
        (low - n * low.dot(&n)).norm() < 1e-9 && low.dot(&n) > 5.0,
        "{low}"
    );
    assert!(found("xmin").norm() < 1e-9);
}

#[test]
fn all_axes_are_read_and_written() {
    let cylindrical = r#"{ body = "block", nodes = "zmax", axes = { point = [5, 0, 0], axis = [0, 0, 2] }, x = 0, y = "0.1*t", z = 0 }"#;
    let two =
        format!(r#"{{ body = "block", nodes = "zmin", axes = {ALONG}, x = 0, y = 0, z = 0 }}"#);
    let normal = r#"{ body = "block", nodes = "xmax", axes = { normal = [0, 0, 3] }, x = 0 }"#;
    let held = r#"{ body = "block", nodes = "xmin", x = 0, y = 0, z = 0 }"#;
    let text = format!("{BLOCK}{}", step("turn", &format!("{cylindrical}, {two}")))
        + "release = []\n"
        + &step("hold", &format!("{normal}, {held}")).replace(
            "increments",
            "release = [{ body = \"block\", nodes = \"zmin\" }, { body = \"block\", nodes = \"zmax\" }]\nincrements",
        );
    let deck = parse(&text, "deck", Path::new("")).unwrap();
    let stated = &deck.model.steps[0].displacements;
    assert_eq!(
        stated[0].axes,
        Axes::Cylindrical {
            point: Vec3::new(5.0, 0.0, 0.0),
            axis: Vec3::new(0.0, 0.0, 2.0),
        }
    );
    assert!(matches!(stated[1].axes, Axes::Skew { .. }));
    let normal = &deck.model.steps[1].displacements[0].axes;
    assert_eq!(*normal, Axes::Normal(Vec3::new(0.0, 0.0, 3.0)));
    let again = write(&deck.model, &deck.output).unwrap();
    let again = parse(&again, "again", Path::new("")).unwrap();
    assert_eq!(format!("{:?}", deck.model), format!("{:?}", again.model));
}

#[test]
fn wrong_axes_are_told_with_their_place_and_a_remedy() {
    let hold = r#"{ body = "block", nodes = "zmin", x = 0, y = 0, z = 0 }"#;
    let with = |other: &str| faults(&step("press", &format!("{hold},\n{other}")));
    for (stated, expected) in [
        (
            r#"{ body = "block", nodes = "zmax", axes = { normal = [1, 0, 0] }, y = 0 }"#,
            "states `y`: a normal determines the first axis only; give two vectors",
        ),
        (
            r#"{ body = "block", nodes = "zmax", axes = { normal = [0, 0, 0] }, x = 0 }"#,
            "the normal is zero; give a vector of any other length",
        ),
        (
            r#"{ body = "block", nodes = "zmax", axes = [[1, 0, 0], [-2, 0, 0]], x = 0 }"#,
            "are zero or parallel; give two that span a plane",
        ),
        (
            r#"{ body = "block", nodes = "ymax", axes = { point = [0.5, 1, 0.5], axis = [0, 1, 0] }, x = 0 }"#,
            "is on the axis, where no direction is radial or tangential; prescribe it in other axes",
        ),
        (
            r#"{ body = "block", nodes = "zmax", axes = { point = [0, 0, 0] }, x = 0 }"#,
            "`axis`",
        ),
        (
            r#"{ body = "block", nodes = "zmax", axes = "radial", x = 0 }"#,
            "axes",
        ),
    ] {
        let told = with(stated);
        assert!(told.contains(expected), "{stated}:\n{told}");
        assert!(told.contains(":20:") || told.contains("deck:"), "{told}");
    }
}

#[test]
fn directions_that_contradict_each_other_are_told() {
    let one = r#"{ body = "block", nodes = "zmin", x = 0, y = 0, z = 0 }"#;
    let two = r#"{ body = "block", nodes = "zmax", axes = { normal = [1, 0, 1] }, x = 0.1 }"#;
    let other = r#"{ body = "block", nodes = "zmax", axes = { normal = [2, 0, 2] }, x = 0.2 }"#;
    let told = faults(&step("press", &format!("{one}, {two}, {other}")));
    assert!(
        told.contains("twice: 0.1 by `zmax`, 0.2 by `zmax`"),
        "{told}"
    );
    // Opposite directions with the same displacement are a contradiction, at rest they are none.
    let back = r#"{ body = "block", nodes = "zmax", axes = { normal = [-1, 0, -1] }, x = 0.1 }"#;
    let told = faults(&step("press", &format!("{one}, {two}, {back}")));
    assert!(told.contains("twice"), "{told}");
    let oblique = r#"{ body = "block", nodes = "zmin", axes = { normal = [1, 0, 1] }, x = 0 }"#;
    let told = faults(&step("press", &format!("{one}, {oblique}")));
    assert!(
        told.contains("prescribed along 4 directions, and the last one, `x` of `zmin`, follows from the others"),
        "{told}"
    );
    assert!(told.contains("release others first"), "{told}");
    // Steps later, too.
    let told = faults(&(step("press", one) + &step("tilt", oblique)));
    assert!(told.contains("in step `tilt`"), "{told}");
    // A free body is found in any axes.
    let rest = r#"{ body = "block", nodes = "zmin", axes = { normal = [1, 0, 1] }, x = 0 }"#;
    let told = faults(&step("press", rest));
    assert!(
        told.contains("3 rigid motions") || told.contains("free"),
        "{told}"
    );
}
