//! Contact of everything is warned of as pairs with names are.

use striae::{
    advice::{Advice, Topic},
    deck::{Deck, Faults},
};

use super::{COULOMB, PRESSED};

/// Contact without names of surfaces.
const EVERYTHING: &str = r#"[contact]
all = true
friction = { law = "coulomb", mu = 0.3 }"#;
const PLANE: &str = "plane = { point = [0, 0, 0], normal = [0, 0, 1] }";

/// The deck with passages replaced.
fn read(passages: &[[&str; 2]]) -> Result<Deck, Faults> {
    super::read(EVERYTHING, passages)
}

fn advice(passages: &[[&str; 2]]) -> Advice {
    Advice::of(&read(passages).expect("a valid deck").model)
}

fn pressure(value: f64) -> String {
    format!("pressure = [{{ body = \"pad\", facets = \"zmax\", value = {value} }}]")
}

#[track_caller]
fn assert_warned(passages: &[[&str; 2]], words: &str) {
    let warnings = advice(passages).warnings;
    let [warning] = &warnings[..] else {
        panic!("{warnings:?}");
    };
    assert_eq!(warning.topic, Topic::Hold);
    assert!(warning.text.contains(words), "{}", warning.text);
}

#[track_caller]
fn assert_refused(passages: &[[&str; 2]], words: &str) {
    let found = read(passages).expect_err("a fault").to_string();
    assert!(found.contains(words), "{found}");
}

#[test]
fn a_body_that_is_pulled_off() {
    let words = "contact can only push body `pad` along +z in step `press`, and its loads pull it in the same direction, away from the contact of `pad-floor`";
    assert_refused(&[[PRESSED, &pressure(-10.0)]], words);
    assert!(read(&[[PRESSED, &pressure(10.0)]]).is_ok());
    // Above it there is something that it may be pulled against.
    let ceiling = format!(
        "{PLANE}\n[[rigid]]\nname = \"ceiling\"\nplane = {{ point = [0, 0, 1.1], normal = [0, 0, -1] }}"
    );
    assert!(read(&[[PRESSED, &pressure(-10.0)], [PLANE, &ceiling]]).is_ok());
}

/// The base has a larger face, and flanks that look the same way as those of the pad.
#[test]
fn a_body_that_is_pulled_off_another() {
    let base = "name = \"base\"\nmaterial = \"rubber\"\nmesh = { generator = \"block\", origin = [-1, -1, -1], size = [3, 3, 1], divisions = [3, 3, 1] }\n[[body]]\nname = \"pad\"";
    let held = |load: &str| {
        format!(
            "displacement = [{{ body = \"base\", nodes = \"zmin\", x = 0, y = 0, z = 0 }}]\n{load}"
        )
    };
    let floor = "plane = { point = [0, 0, -1], normal = [0, 0, 1] }";
    let with = |load: &str| {
        read(&[
            ["name = \"pad\"", base],
            [PLANE, floor],
            [PRESSED, &held(load)],
        ])
    };
    let found = with(&pressure(-10.0)).expect_err("a fault").to_string();
    let words = "contact can only push body `pad` along +z in step `press`";
    assert!(found.contains(words), "{found}");
    assert!(with(&pressure(10.0)).is_ok());
}

#[test]
fn a_body_that_nothing_holds_along_the_floor() {
    let pressed = pressure(10.0);
    assert_warned(
        &[[PRESSED, &pressed], [COULOMB, ""]],
        "the contact of `pad-floor` leaves it free along x, along y and about z, as it is frictionless",
    );
    assert_eq!(advice(&[[PRESSED, &pressed]]).warnings, []);
}

#[test]
fn a_face_that_is_prescribed() {
    let sole = |way: &str| {
        let sole = format!("displacement = [{{ body = \"pad\", nodes = \"zmin\", z = {way} }}, ");
        PRESSED.replace("displacement = [", &sole)
    };
    assert_warned(
        &[[PRESSED, &sole("0")]],
        "displacements prescribe all nodes of the contact surface of `pad` along its normal",
    );
    // On a floor at rest, what is held at rest needs no contact.
    let clamped = sole("0").replace(r#""zmin", z"#, r#""zmin", x = 0, y = 0, z"#);
    assert_eq!(advice(&[[PRESSED, &clamped]]).warnings, []);
    // A floor that is not touched does not matter.
    let below = "plane = { point = [0, 0, -1], normal = [0, 0, 1] }";
    assert_eq!(
        advice(&[[PRESSED, &sole("0")], [PLANE, below]]).warnings,
        []
    );
    let words =
        "displacements move all nodes of its contact surface, up to 0.01 deep into the rigid plane";
    assert_refused(&[[PRESSED, &sole("-0.01")]], words);
}

#[test]
fn flat_faces_are_not_curved() {
    let notes = advice(&[]).notes;
    assert!(
        !notes.iter().any(|note| note.text.contains("curved")),
        "{notes:?}"
    );
    let cap = "mesh = { generator = \"capped-block\", size = [10, 10], height = 5, radius = 10, element_size = 2.5 }";
    let block = "mesh = { generator = \"block\", origin = [0, 0, 0], size = [1, 1, 1], divisions = [3, 3, 3] }";
    let pressed = PRESSED.replace("0.02", "0.1");
    let notes = advice(&[[block, cap], [PRESSED, &pressed]]).notes;
    let words = "nodes touch the plane; pressures of a curved contact";
    assert!(
        notes.iter().any(|note| note.text.contains(words)),
        "{notes:?}"
    );
}

/// A tool above the pad, and a step that moves it down.
fn tool(facets: &str, height: f64) -> [String; 2] {
    let top = height + 0.3;
    let tool = format!(
        "{PLANE}\n[[rigid]]\nname = \"tool\"\nreference = [0.5, 0.5, {height}]\nmesh = {{ positions = [[0.3, 0.3, {height}], [0.7, 0.3, {height}], [0.7, 0.7, {height}], [0.3, 0.7, {height}], [0.3, 0.3, {top}], [0.7, 0.3, {top}], [0.7, 0.7, {top}], [0.3, 0.7, {top}]], facets = [{facets}] }}"
    );
    let lowered = PRESSED.replace("zmax", "zmin").replace("-0.02", "0");
    let lowered =
        format!("{lowered}\nrigid = [{{ surface = \"tool\", displacement = [0, 0, -0.07] }}]");
    [tool, lowered]
}

const CUBE: [&str; 2] = [
    "[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]",
    "[1, 2, 3, 0], [7, 6, 5, 4], [4, 5, 1, 0], [5, 6, 2, 1], [6, 7, 3, 2], [7, 4, 0, 3]",
];

#[test]
fn a_tool_that_is_inside_out() {
    let exclude = "all = true\nexclude = [{ a = \"pad\", b = \"floor\" }]";
    let with = |facets: &str, height: f64, more: &str| {
        let [tool, lowered] = tool(facets, height);
        let more = format!("{exclude}\n{more}");
        read(&[[PLANE, &tool], [PRESSED, &lowered], ["all = true", &more]])
    };
    for initial in ["", "initial = \"resolve\"", "initial = \"close\""] {
        for facets in [CUBE[1], "[0, 1, 2, 3]"] {
            for height in [1.0, 1.01] {
                let found = with(facets, height, initial)
                    .expect_err("a fault")
                    .to_string();
                let words = "body `pad` is entirely behind `tool`, which faces away from it; reverse the facets of `tool` (list their corners counter-clockwise as seen from the body), or exclude this contact if `tool` is meant for another body";
                assert!(found.contains(words), "{initial} {height}: {found}");
            }
        }
        assert!(with(CUBE[0], 1.01, initial).is_ok());
    }
    // What reaches into a tool that faces it overlaps.
    for facets in [CUBE[0], "[0, 3, 2, 1]"] {
        let found = with(facets, 0.9, "").expect_err("a fault").to_string();
        assert!(found.contains("inside `"), "{found}");
    }
}
