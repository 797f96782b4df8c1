//! Gaps that contact of everything closes at the start.

use super::completed;

/// A block above another one, over which it does not reach.
const ABOVE: &str = r#"
title = "A block above another one"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "rubber"
mesh = { generator = "block", size = [1, 1, 1], divisions = [2, 2, 2] }
[[body]]
name = "upper"
material = "rubber"
mesh = { generator = "block", origin = [0.2, 0.1, 1.05], size = [0.6, 0.6, 0.5], divisions = [3, 3, 2] }
CONTACT
[[step]]
name = "press"
increments = 2
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.01 },
]
"#;

/// A block in a corner, above its floor and beside its wall.
const CORNER: &str = r#"
title = "A block in a corner"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3
[[body]]
name = "corner"
material = "rubber"
mesh = { generator = "block", size = [2, 1, 1], divisions = [4, 2, 2] }
[[body]]
name = "wall"
material = "rubber"
mesh = { generator = "block", origin = [-1, 0, 0], size = [1, 1, 2], divisions = [2, 2, 4] }
[[body]]
name = "block"
material = "rubber"
mesh = { generator = "block", origin = [0.02, 0, 1.05], size = [0.8, 1, 0.8], divisions = [3, 3, 3] }
CONTACT
[[step]]
name = "press"
increments = 2
displacement = [
    { body = "corner", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "wall", nodes = "xmin", x = 0, y = 0, z = 0 },
    { body = "block", nodes = "zmax", y = 0, z = -0.01 },
    { body = "block", nodes = "xmax", x = -0.01 },
]
"#;

/// Forces of pairs at the end, along `axis`.
fn last_forces(deck: &str, contact: &str, pairs: &[(&str, &str)]) -> Vec<f64> {
    let text = deck.replace("CONTACT", contact);
    let run = completed(&text);
    let last = |(pair, axis): &(&str, &str)| {
        let column = run
            .history
            .column(&format!("pair.{pair}.resultant_a.{axis}"));
        *column.unwrap().last().unwrap()
    };
    pairs.iter().map(last).collect()
}

#[test]
fn all_nodes_of_a_face_close_its_gap_those_on_edges_too() {
    for (initial, gap) in [("{ close = 0.1 }", "1.05"), ("\"close\"", "1.01")] {
        let above = ABOVE.replace("1.05", gap);
        let all = format!("[contact]\nall = true\ninitial = {initial}");
        let named = format!(
            "[[pair]]\nname = \"lower-upper\"\na = {{ body = \"lower\", facets = \"zmax\" }}\n\
             b = {{ body = \"upper\", facets = \"zmin\" }}\ninitial = {initial}"
        );
        let [all, named] =
            [all, named].map(|contact| last_forces(&above, &contact, &[("lower-upper", "z")]));
        assert!(
            (all[0] / named[0] - 1.0).abs() < 1e-3,
            "{all:?} and {named:?}"
        );
    }
}

#[test]
fn a_node_on_an_edge_closes_the_gaps_of_both_of_its_faces() {
    let pairs = [("corner-block", "z"), ("wall-block", "x")];
    let closed = last_forces(
        CORNER,
        "[contact]\nall = true\ninitial = { close = 0.1 }",
        &pairs,
    );
    // The block as it stands once its gaps are closed.
    let flush = CORNER.replace("[0.02, 0, 1.05]", "[0, 0, 1]");
    let flush = flush.replace("[0.8, 1, 0.8]", "[0.82, 1, 0.85]");
    let flush = last_forces(&flush, "[contact]\nall = true", &pairs);
    for (closed, flush) in closed.iter().zip(&flush) {
        assert!((closed / flush - 1.0).abs() < 0.02, "{closed} and {flush}");
    }
}

/// Two blocks that overlap and end at the same edges, where nodes lie on the flanks of the other
/// one, or one that ends nearer to them than it overlaps.
#[test]
fn overlaps_at_edges_are_those_of_the_faces_that_meet() {
    let cases = [
        (0.0, 1.0, "close"),
        (0.0, 1.0, "resolve"),
        (-0.01, 1.02, "resolve"),
        (0.004, 1.1, "resolve"),
    ];
    for (left, width, initial) in cases {
        let deck = ABOVE.replace(
            "origin = [0.2, 0.1, 1.05], size = [0.6, 0.6, 0.5]",
            &format!("origin = [{left}, 0, 0.98], size = [{width}, 1, 0.5]"),
        );
        let named = format!(
            "[[pair]]\nname = \"lower-upper\"\na = {{ body = \"lower\", facets = \"zmax\" }}\n\
             b = {{ body = \"upper\", facets = \"zmin\" }}\ninitial = \"{initial}\""
        );
        let all = format!("[contact]\nall = true\ninitial = \"{initial}\"");
        let [all, named] =
            [all, named].map(|contact| last_forces(&deck, &contact, &[("lower-upper", "z")])[0]);
        assert!(
            (all / named - 1.0).abs() < 1e-6,
            "{left}, {initial}: {all} and {named}"
        );
    }
}
