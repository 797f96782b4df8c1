//! Interferences measured from faces that touch.

mod driven;

use std::{f64::consts::PI, path::Path};

use driven::last;
use striae_contact::side::Side;
use striae_deck::parse;
use striae_model::{
    PairId,
    initial::{conforms, fits},
};
use striae_solve::report::pairs;

/// A solid shaft of radius 0.5 drawn with a radius of its own in a hub of twice the radius, in
/// plane stress. `around` are the facets of the shaft, over 8, and those of the hub.
fn shaft_in_hub(radius: f64, around: [usize; 2], keys: &str) -> String {
    let [shaft, hub] = around;
    let rings = shaft;
    format!(
        r#"
title = "Shaft in a hub"
[[material]]
name = "steel"
law = "neo-hookean"
youngs_modulus = 2e5
poissons_ratio = 0.3
[[body]]
name = "shaft"
material = "steel"
mesh = {{ generator = "cylinder", radius = {radius}, height = 0.2, divisions = [{shaft}, {rings}, 1] }}
node_sets = [{{ name = "y0", from = [-9, -1e-6, -9], to = [9, 1e-6, 9] }}, {{ name = "x0", from = [-1e-6, -9, -9], to = [1e-6, 9, 9] }}]
[[body]]
name = "hub"
material = "steel"
mesh = {{ generator = "annulus", centre = [0, 0, 0.1], axis = [0, 0, 1], inner_radius = 0.5, outer_radius = 1, width = 0.2, divisions = [5, {hub}, 1] }}
node_sets = [{{ name = "y0", from = [-9, -1e-6, -9], to = [9, 1e-6, 9] }}, {{ name = "x0", from = [-1e-6, -9, -9], to = [1e-6, 9, 9] }}]
[[pair]]
name = "fit"
a = {{ body = "hub", facets = "rim" }}
b = {{ body = "shaft", facets = "side" }}
{keys}
[[curve]]
name = "beyond"
points = [[0, 0], [0.5, 1.2], [1, 1]]
[[step]]
name = "fit"
increments = 2
displacement = [
    {{ body = "shaft", nodes = "y0", y = 0 }},
    {{ body = "shaft", nodes = "x0", x = 0 }},
    {{ body = "shaft", nodes = "zmin", z = 0 }},
    {{ body = "hub", nodes = "y0", y = 0 }},
    {{ body = "hub", nodes = "x0", x = 0 }},
    {{ body = "hub", nodes = "ymin", z = 0 }},
]
[[step]]
name = "rest"
increments = 1
"#
    )
}

const INTERFERENCE: f64 = 0.000_666_67;

/// Lame: with the radii `r` and `2r` and `E`, `nu` of both, the pressure of an interference `i`
/// is `p = E i/r / (1 - nu + 5/3 + nu)`.
fn lame() -> f64 {
    2e5 * INTERFERENCE / 0.5 / (1.0 + 5.0 / 3.0)
}

fn pressure(text: &str) -> f64 {
    let (problem, state) = last(text);
    pairs(&problem, &state)[0].sides[Side::A].pressure / (2.0 * PI * 0.5 * 0.2)
}

/// Within 2 %, whether nodes face nodes or not, and whether the shaft is drawn with a gap, as
/// touching or with its interference; facets turn by a quarter of a facet at the most.
#[test]
fn pressure_is_that_of_lame_whatever_the_meshes() {
    for enforcement in ["weighted", "collocated"] {
        let keys = format!("interference = {INTERFERENCE}\nenforcement = \"{enforcement}\"");
        for around in [[4, 32], [4, 40], [8, 64]] {
            for radius in [0.499, 0.5, 0.5 + INTERFERENCE] {
                let found = pressure(&shaft_in_hub(radius, around, &keys));
                let error = found / lame() - 1.0;
                assert!(
                    error.abs() < 0.02,
                    "{enforcement} {around:?} {radius} {error}"
                );
            }
        }
    }
}

/// An interference that is drawn as an overlap counts as that of the curved surfaces, whatever
/// facets face each other, though it is less than a third of the sagitta.
#[test]
fn overlaps_of_curved_surfaces_give_the_pressure_of_lame() {
    let mismatch = [[5, 32], [4, 56], [8, 48]];
    let either = [[4, 32], [4, 40], [8, 64]];
    for (enforcement, around) in [
        ("weighted", &mismatch),
        ("weighted", &either),
        ("collocated", &either),
    ] {
        for around in around {
            let keys = format!("initial = \"resolve\"\nenforcement = \"{enforcement}\"");
            let found = pressure(&shaft_in_hub(0.5 + INTERFERENCE, *around, &keys));
            let error = found / lame() - 1.0;
            assert!(error.abs() < 0.02, "{enforcement} {around:?} {error}");
        }
    }
}

/// A cap whose overlap with a block is pressed out and one that is pressed by as much have the same
/// force, also after they have slid by two facets: their surfaces do not conform, so that what
/// facets lack is not that of those that face them at the start.
#[test]
fn overlaps_of_surfaces_that_do_not_conform_are_those_of_the_facets() {
    let deck = |apex: f64, z: f64, keys: &str| {
        format!(
            r#"
title = "Cap on a block"
[[material]]
name = "m"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[body]]
name = "cap"
material = "m"
mesh = {{ generator = "capped-block", apex = [0, 0, {apex}], size = [8, 8], height = 5, radius = 9, element_size = 1, fine_half_width = 3 }}
[[body]]
name = "base"
material = "m"
mesh = {{ generator = "block", origin = [-6, -6, -4], size = [12, 12, 4], divisions = [11, 11, 4] }}
[[pair]]
name = "p"
a = {{ body = "cap", facets = "cap" }}
b = {{ body = "base", facets = "zmax" }}
{keys}
[[step]]
name = "press"
increments = 2
displacement = [
    {{ body = "cap", nodes = "zmax", x = 0, y = 0, z = {z} }},
    {{ body = "base", nodes = "zmin", x = 0, y = 0, z = 0 }},
]
[[step]]
name = "slide"
increments = 4
displacement = [{{ body = "cap", nodes = "zmax", x = 2, y = 0, z = {z} }}]
"#
        )
    };
    let force = |text: &str| {
        let (problem, state) = last(text);
        pairs(&problem, &state)[0].sides[Side::A].force.z
    };
    let drawn = deck(-0.1, 0.0, "initial = \"resolve\"");
    let model = parse(&drawn, "deck.toml", Path::new("")).unwrap().model;
    assert!(fits(&model)[0].as_ref().unwrap().chords > 0.1);
    assert!(!conforms(&model, PairId(0)));
    let [drawn, pressed] = [force(&drawn), force(&deck(0.0, -0.1, ""))];
    // Facets of both are at other places when they close; corrections that do not move with the
    // contact took two thirds of the force.
    assert!((drawn / pressed - 1.0).abs() < 0.04, "{drawn} {pressed}");
}

/// Meshes that overlap by an interference of curved surfaces overlap by more or less where facets
/// do not match: by two thirds of the difference of their sagittas in the mean, which falls with
/// the square of their size.
#[test]
fn error_of_chords_is_that_of_their_sagittas() {
    let keys = "initial = \"resolve\"";
    let share = |around: [usize; 2]| {
        let deck = shaft_in_hub(0.5 + INTERFERENCE, around, keys);
        let model = parse(&deck, "deck.toml", Path::new("")).unwrap().model;
        fits(&model)[0].as_ref().unwrap().chords
    };
    assert!(share([4, 32]) < 0.01);
    let sagitta = |count: f64| 0.5 * (1.0 - (PI / count).cos());
    for factor in [1, 2] {
        let count = f64::from(8 * factor);
        let expected = 2.0 / 3.0 * (sagitta(4.0 * count) - sagitta(5.0 * count)) / INTERFERENCE;
        let found = share([4 * factor as usize, 40 * factor as usize]);
        assert!((found / expected - 1.0).abs() < 0.1, "{found} {expected}");
    }
}

/// A shaft that turns in its hub without friction has the pressure that it had, however far its
/// facets have gone; both are held by rigid bodies.
#[test]
fn a_shaft_that_turns_keeps_its_pressure() {
    let turned = |keys: &str, radius: f64, angle: f64| {
        let text = shaft_in_hub(radius, [4, 40], keys);
        let text = &text[..text.find("[[curve]]").unwrap()];
        format!(
            r#"{text}
[[rigid]]
name = "core"
tied = [{{ body = "shaft", nodes = "core" }}]
[[rigid]]
name = "ring"
tied = [{{ body = "hub", nodes = "tread" }}]
[[step]]
name = "fit"
increments = 1
[[step]]
name = "turn"
increments = 3
rigid = [{{ surface = "core", rotation = [0, 0, {angle}] }}]
"#
        )
        .replace(
            "name = \"y0\", from = [-9, -1e-6, -9], to = [9, 1e-6, 9] }, { name = \"x0\", from = [-1e-6, -9, -9], to = [1e-6, 9, 9] }]\n[[body]]\nname = \"hub\"",
            "name = \"core\", cylinder = { point = [0, 0, 0], axis = [0, 0, 1], radius = 0.3 } }]\n[[body]]\nname = \"hub\"",
        )
    };
    let interference = format!("interference = {INTERFERENCE}");
    for (keys, radius) in [
        (interference.as_str(), 0.5),
        ("initial = \"resolve\"", 0.5 + INTERFERENCE),
    ] {
        let still = pressure(&turned(keys, radius, 0.0));
        // The order of the sides does not count. Nor does the way round, but that coordinates
        // decide which of equal nodes are kept, which a mirror image has not.
        let ahead = turned(keys, radius, 7.0);
        let hub =
            "a = { body = \"hub\", facets = \"rim\" }\nb = { body = \"shaft\", facets = \"side\" }";
        let shaft =
            "a = { body = \"shaft\", facets = \"side\" }\nb = { body = \"hub\", facets = \"rim\" }";
        assert!(ahead.contains(hub));
        let [ahead, exchanged, back] = [
            ahead.clone(),
            ahead.replace(hub, shaft),
            turned(keys, radius, -7.0),
        ]
        .map(|text| pressure(&text));
        assert!(
            (exchanged / ahead - 1.0).abs() < 1e-5,
            "{exchanged} {ahead}"
        );
        assert!((back / ahead - 1.0).abs() < 1e-3, "{back} {ahead}");
        for angle in [1.0, 7.0, 20.0, 80.0] {
            let found = pressure(&turned(keys, radius, angle));
            assert!(
                (found / still - 1.0).abs() < 0.01,
                "{keys}, {angle} degrees: {found} for {still}"
            );
        }
    }
}

/// The end of the curve decides after the first step, not its course.
#[test]
fn interference_follows_its_curve_and_stays() {
    let straight = format!("interference = {INTERFERENCE}");
    let curved = format!("interference = {{ value = {INTERFERENCE}, curve = \"beyond\" }}");
    let [straight, curved] =
        [straight, curved].map(|keys| pressure(&shaft_in_hub(0.5, [4, 40], &keys)));
    assert!(
        (curved / straight - 1.0).abs() < 1e-6,
        "{straight} {curved}"
    );
}

/// A clearance leaves the sides apart, even where their meshes overlap.
#[test]
fn clearance_is_felt_as_one() {
    let keys = "interference = -1e-4";
    assert!(pressure(&shaft_in_hub(0.5 + INTERFERENCE, [4, 40], keys)).abs() < 1e-9);
}

/// One block on a plane, drawn with a gap that is within the search distance, or beyond it.
#[test]
fn gaps_within_the_search_distance_count_as_closed() {
    let deck = |gap: f64, keys: &str| {
        format!(
            r#"
title = "Block on a plane"
[[material]]
name = "m"
law = "linear-elastic"
youngs_modulus = 1e6
poissons_ratio = 0
[[body]]
name = "block"
material = "m"
mesh = {{ generator = "block", origin = [0, 0, {gap}], size = [1, 1, 1], divisions = [2, 2, 2] }}
[[rigid]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }}
[[pair]]
name = "c"
a = {{ body = "block", facets = "zmin" }}
b = {{ rigid = "floor" }}
{keys}
[[step]]
name = "press"
increments = 2
displacement = [{{ body = "block", nodes = "zmax", x = 0, y = 0, z = 0 }}]
"#
        )
    };
    for (gap, search) in [(0.2, ""), (0.4, "search_distance = 0.5"), (-0.3, "")] {
        let (problem, state) = last(&deck(gap, &format!("interference = 0.01\n{search}")));
        let force = pairs(&problem, &state)[0].sides[Side::A].force.z;
        assert!((force / 1e4 - 1.0).abs() < 1e-6, "{gap} {force}");
    }
    let refused = |gap: f64, keys: &str| {
        let faults = parse(&deck(gap, keys), "deck.toml", Path::new(""));
        faults.unwrap_err().to_string()
    };
    let said = refused(0.4, "interference = 0.01");
    assert!(said.contains("smallest gap is 0.4"), "{said}");
    assert!(said.contains("Set `search_distance`"), "{said}");
    let said = refused(-0.1, "interference = 0.01\ninitial = \"resolve\"");
    assert!(said.contains("Remove one of the settings"), "{said}");
}
