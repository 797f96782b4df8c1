//! Gaps and overlaps of the meshes of a deck: refused, closed or kept.

use std::path::Path;

use striae_deck::{Deck, FaultKind, Faults, parse};
use striae_model::{
    ClosedGaps, Initial, Model, PairId,
    initial::{InitialFault, fits, may_meet},
};
use striae_solve::{assembly::StepContext, offsets::Offsets, problem::Problem, state::State};

/// A block above another one, pressed down.
fn deck(z: f64, initial: &str) -> Result<Deck, Faults> {
    let text = format!(
        r#"
title = "Two blocks"
[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "solid"
mesh = {{ generator = "block", size = [1, 1, 1], divisions = [4, 4, 4] }}
[[body]]
name = "upper"
material = "solid"
mesh = {{ generator = "block", origin = [0.2, 0.3, {z}], size = [0.5, 0.5, 0.4], divisions = [3, 3, 2] }}
[[pair]]
name = "interface"
a = {{ body = "lower", facets = "zmax" }}
b = {{ body = "upper", facets = "zmin" }}
{initial}
[[step]]
name = "press"
displacement = [
    {{ body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 }},
    {{ body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.3 }},
]
"#
    );
    parse(&text, "deck.toml", Path::new(""))
}

fn fault(deck: Result<Deck, Faults>) -> InitialFault {
    let faults = deck.unwrap_err();
    assert_eq!(faults.iter().len(), 1, "{faults}");
    match &faults.iter().next().unwrap().kind {
        FaultKind::Model(kind) => match &**kind {
            striae_model::FaultKind::Initial { fault } => fault.clone(),
            other => panic!("{other}"),
        },
        other => panic!("{other}"),
    }
}

/// Heights of the nodes of the upper contact surface, which is the smaller one.
fn heights(model: &Model) -> Vec<f64> {
    let upper = &model.bodies[1].mesh;
    let nodes = upper.node_sets.get("zmin").unwrap().iter();
    nodes.map(|node| upper.positions[node.index()].z).collect()
}

#[test]
fn an_overlap_is_a_fault_with_place_depth_and_remedy() {
    let InitialFault::Overlap {
        pair,
        depth,
        share,
        at,
        ..
    } = fault(deck(0.99, ""))
    else {
        panic!("an overlap");
    };
    assert_eq!(pair, "interface");
    assert!((depth - 0.01).abs() < 1e-12 && (share - 0.04).abs() < 1e-12);
    assert!((at.z - 1.0).abs() < 0.011);
    let said = deck(0.99, "").unwrap_err().to_string();
    assert!(said.contains("deck.toml:17:8"), "{said}");
    assert!(
        said.contains("inside `") && said.contains("initial = \"resolve\""),
        "{said}"
    );
    assert!(deck(0.996, "").is_ok());
    assert!(deck(1.2, "").is_ok());
}

#[test]
fn gaps_and_overlaps_are_closed_without_strain() {
    for (z, initial) in [
        (0.97, "initial = \"close\""),
        (1.01, "initial = \"close\""),
        (1.1, "initial = { close = 0.1 }"),
    ] {
        let model = deck(z, initial).unwrap().model;
        let lower = &model.bodies[0].mesh;
        assert!(
            heights(&model)
                .iter()
                .all(|height| (height - 1.0).abs() < 1e-12)
        );
        assert!(lower.positions.iter().all(|x| x.z <= 1.0));
        // Problems are made of the mesh as it is now, so there is no strain.
        assert!(Problem::new(model).is_ok());
    }
    let model = deck(1.1, "initial = \"close\"").unwrap().model;
    assert!(heights(&model).iter().all(|height| *height == 1.1));
    assert_eq!(
        model.pairs[0].initial,
        Initial::Close(ClosedGaps::Share(0.1))
    );
}

#[test]
fn closing_that_turns_elements_inside_out_is_refused() {
    let fault = fault(deck(0.7, "initial = { close = 0 }"));
    assert!(matches!(fault, InitialFault::Inverted { .. }), "{fault}");
    let said = fault.to_string();
    assert!(said.contains("initial = \"resolve\""), "{said}");
}

/// A fine cap whose apex is inside the only facet of a smaller block.
fn cap_in_facet(initial: &str) -> Result<Deck, Faults> {
    let text = format!(
        r#"
title = "A cap in a facet"
[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3
[[body]]
name = "block"
material = "solid"
mesh = {{ generator = "block", size = [1, 1, 1], divisions = [1, 1, 1] }}
[[body]]
name = "cap"
material = "solid"
mesh = {{ generator = "capped-block", apex = [0.5, 0.5, 0.9], size = [1.5, 1.5], height = 1, radius = 3, element_size = 0.2 }}
[[pair]]
name = "interface"
a = {{ body = "block", facets = "zmax" }}
b = {{ body = "cap", facets = "cap" }}
{initial}
[[step]]
name = "press"
displacement = [
    {{ body = "block", nodes = "zmin", x = 0, y = 0, z = 0 }},
    {{ body = "cap", nodes = "zmax", x = 0, y = 0, z = -0.1 }},
]
"#
    );
    parse(&text, "deck.toml", Path::new(""))
}

#[test]
fn an_overlap_that_closing_leaves_has_another_remedy() {
    let said = cap_in_facet("").unwrap_err().to_string();
    assert!(said.contains("set `initial = \"close\"`"), "{said}");
    let left = fault(cap_in_facet("initial = { close = 0 }"));
    assert!(matches!(left, InitialFault::Overlap { .. }), "{left}");
    let said = left.to_string();
    assert!(!said.contains("set `initial = \"close\"`"), "{said}");
    for remedy in [
        "The overlap remains after",
        "`initial = \"resolve\"`",
        "refine",
    ] {
        assert!(said.contains(remedy), "{said}");
    }
    // The remedies help.
    assert!(cap_in_facet("initial = \"resolve\"").is_ok());
}

#[test]
fn resolved_overlaps_are_offsets_that_fade() {
    let model = deck(0.97, "initial = \"resolve\"").unwrap().model;
    let problem = Problem::new(model).unwrap();
    let offsets = Offsets::new(&problem, 0, 0);
    assert!(
        offsets.sides[1]
            .iter()
            .all(|offset| (offset - 0.03).abs() < 1e-12)
    );
    let found = offsets.sides[0]
        .iter()
        .filter(|offset| (**offset - 0.03).abs() < 1e-12);
    assert!(found.count() >= 4);
    let state = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &state);
    let half = context.offsets_left(0, 0.5);
    for (half, whole) in half[1].iter().zip(&offsets.sides[1]) {
        assert_eq!(*half, 0.5 * whole);
    }
    assert_eq!(Offsets::new(&problem, 1, 0), Offsets::default());
    let as_meshed = Problem::new(deck(1.0, "").unwrap().model).unwrap();
    assert_eq!(Offsets::new(&as_meshed, 0, 0), Offsets::default());
}

#[test]
fn pairs_that_can_never_meet_are_known() {
    for (z, meets) in [(1.2, true), (1.7, false)] {
        let model = deck(z, "").unwrap().model;
        let fit = fits(&model)[0].clone().unwrap();
        assert!((fit.distance - (z - 1.0)).abs() < 1e-12);
        assert_eq!(may_meet(&model, PairId(0), &fit), meets);
    }
}

#[test]
fn a_plane_that_faces_away_is_named() {
    let text = |normal: &str| {
        format!(
            r#"
title = "A block on a floor"
[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3
[[body]]
name = "block"
material = "solid"
mesh = {{ generator = "block", origin = [0, 0, 0.1], size = [1, 1, 1], divisions = [2, 2, 2] }}
[[rigid]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = {normal} }}
[[pair]]
name = "sole"
a = {{ body = "block", facets = "zmin" }}
b = {{ rigid = "floor" }}
[[step]]
name = "press"
displacement = [{{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.3 }}]
"#
        )
    };
    assert!(parse(&text("[0, 0, 1]"), "deck.toml", Path::new("")).is_ok());
    let found = fault(parse(&text("[0, 0, -1]"), "deck.toml", Path::new("")));
    assert!(matches!(found, InitialFault::Behind { .. }), "{found}");
    assert!(found.to_string().contains("reverse the normal of `floor`"));
}
