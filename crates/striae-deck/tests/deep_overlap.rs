//! Overlaps of the meshes of more than half a facet that are pressed out.

mod driven;

use std::path::Path;

use driven::last;
use striae_contact::side::Side;
use striae_deck::parse;
use striae_solve::report::pairs;

const YOUNGS_MODULUS: f64 = 1e6;

/// A block of unit edge, four elements along each, that is `depth` inside a floor.
fn deck(depth: f64, floor: &str, b: &str, held: &str, keys: &str) -> String {
    format!(
        r#"
title = "Overlap pressed out"
[[material]]
name = "m"
law = "linear-elastic"
youngs_modulus = {YOUNGS_MODULUS}
poissons_ratio = 0
[[body]]
name = "block"
material = "m"
mesh = {{ generator = "block", origin = [0, 0, -{depth}], size = [1, 1, 1], divisions = [4, 4, 4] }}
{floor}
[[pair]]
name = "c"
a = {{ body = "block", facets = "zmin" }}
b = {{ {b} }}
initial = "resolve"
{keys}
[[step]]
name = "press"
increments = 4
displacement = [{{ body = "block", nodes = "zmax", x = 0, y = 0, z = 0 }}{held}]
"#
    )
}

fn on_plane(depth: f64, keys: &str) -> String {
    let plane = "[[rigid]]\nname = \"floor\"\nplane = { point = [0, 0, 0], normal = [0, 0, 1] }";
    deck(depth, plane, "rigid = \"floor\"", "", keys)
}

fn on_body(depth: f64, height: f64, keys: &str) -> String {
    let body = format!(
        "[[body]]\nname = \"floor\"\nmaterial = \"m\"\nmesh = {{ generator = \"block\", origin = [0, 0, -{height}], size = [1, 1, {height}], divisions = [4, 4, 4] }}"
    );
    let held = ", { body = \"floor\", nodes = \"zmin\", x = 0, y = 0, z = 0 }";
    deck(
        depth,
        &body,
        "body = \"floor\", facets = \"zmax\"",
        held,
        keys,
    )
}

/// `F = E A d/L` of bars without lateral strain, however deep they are inside each other and
/// whatever the search distance: the linear law has no large strains.
#[test]
fn force_is_that_of_a_bar_shortened_by_the_overlap() {
    for enforcement in ["weighted", "collocated"] {
        for search in ["", "search_distance = 0.01", "search_distance = 0.4"] {
            for depth in [0.1, 0.15, 0.3, 0.45] {
                let keys = format!("enforcement = \"{enforcement}\"\n{search}");
                for (text, length) in [
                    (on_plane(depth, &keys), 1.0),
                    (on_body(depth, 1.0, &keys), 2.0),
                ] {
                    let (problem, state) = last(&text);
                    let force = pairs(&problem, &state)[0].sides[Side::A].force.z;
                    let exact = YOUNGS_MODULUS * depth / length;
                    let error = force / exact - 1.0;
                    assert!(error.abs() < 1e-6, "{keys} {depth} {length} {error:e}");
                }
            }
        }
    }
}

/// Beyond half the thickness of a body its other side is nearer: that is refused, with how deep
/// it is, how thick the body is, and what to do.
#[test]
fn what_is_deeper_than_half_the_body_is_refused() {
    for (depth, height) in [(0.6, 1.0), (0.3, 0.5)] {
        let faults = parse(&on_body(depth, height, ""), "deck.toml", Path::new(""));
        let said = faults.unwrap_err().to_string();
        let size = "the local facet size 0.25";
        for part in [
            "deck.toml:",
            "inside `",
            "of the thickness",
            size,
            "Separate the bodies",
        ] {
            assert!(said.contains(part), "{part}: {said}");
        }
    }
}
