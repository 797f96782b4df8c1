//! Contact of everything: the same from Rust and from a deck, and what advice says of it.

mod around_edges;
mod assembly;
mod beside_pairs;
mod chosen_again;
mod closed;
mod shared_edges;

use std::path::Path;

use striae::{
    Finished,
    advice::{Advice, Topic},
    deck,
    model::Faults,
    prelude::*,
};
use striae_model::{ModelBuilder, rigid_surface};

/// The run of a deck that gets to its end.
fn completed(text: &str) -> Finished {
    let deck = deck::parse(text, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let run = Simulation::of(deck).unwrap().run().unwrap();
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    run
}

/// Components of the force on side `a` of a pair after each increment.
fn forces(run: &Finished, pair: &str) -> [Vec<f64>; 3] {
    ["x", "y", "z"].map(|axis| {
        let column = format!("pair.{pair}.resultant_a.{axis}");
        run.history.column(&column).unwrap()
    })
}

const DECK: &str = r#"
title = "A tread on a road"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[body]]
name = "tread"
material = "rubber"
mesh = { generator = "block", origin = [0, 0, 0.1], size = [3, 3, 0.4], divisions = [1, 1, 1] }
[[body]]
name = "carcass"
material = "rubber"
mesh = { generator = "block", origin = [0, 0, 1], size = [3, 3, 3], divisions = [2, 2, 2] }
[[rigid]]
name = "road"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[[pair]]
name = "slit"
a = { body = "carcass", facets = "xmin" }
b = "itself"
feature_angle = 30
[contact]
all = true
friction = { law = "coulomb", mu = 0.3 }
feature_angle = 60
exclude = [{ a = "carcass", b = "road" }, { a = "tread", b = "tread" }]
[[contact.between]]
a = "tread.zmin"
b = "road"
friction = { law = "nap", mu_forward = 0.3, mu_backward = 0.6, mu_lateral = 0.5 }
[[contact.surface]]
of = "tread.zmin"
texture = { uniform = [0, 1, 0] }
[[step]]
name = "press"
increments = 1
displacement = [
    { body = "tread", nodes = "zmax", x = 0, y = 0, z = -0.3 },
    { body = "carcass", nodes = "zmax", x = 0, y = 0, z = 0 },
]
friction = [{ pair = "tread-carcass", law = "coulomb", mu = 0.1 }]
"#;

fn builder() -> Result<ModelBuilder, Error> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3)?);
    let tread = Block {
        origin: [0.0, 0.0, 0.1].into(),
        size: [3.0, 3.0, 0.4].into(),
        divisions: [1, 1, 1],
        ..Block::default()
    };
    let carcass = Block {
        origin: [0.0, 0.0, 1.0].into(),
        size: [3.0, 3.0, 3.0].into(),
        divisions: [2, 2, 2],
        ..Block::default()
    };
    Ok(model("A tread on a road")
        .body(body("tread", tread.mesh()?, rubber.clone()))
        .body(body("carcass", carcass.mesh()?, rubber))
        .rigid(plane("road", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(pair("slit", surface("carcass", "xmin"), itself()).feature_angle(30.0)))
}

fn built(friction_of: &str) -> Result<Result<Model, Faults>, Error> {
    let all = everything()
        .friction(Friction::coulomb(0.3)?)
        .feature_angle(60.0)
        .exclude_between("carcass", "road")
        .exclude_between("tread", "tread")
        .between("tread.zmin", "road", Friction::nap(0.3, 0.6, 0.5)?)
        .textured("tread.zmin", uniform([0.0, 1.0, 0.0]));
    let press = step("press")
        .increments(1)
        .displace("tread", "zmax", [0.0, 0.0, -0.3])
        .displace("carcass", "zmax", [0.0; 3])
        .friction(friction_of, Friction::coulomb(0.1)?);
    Ok(builder()?.contact(all).step(press).build())
}

#[test]
fn decks_and_rust_say_the_same() -> Result<(), Error> {
    let from_rust = built("tread-carcass")?.unwrap_or_else(|faults| panic!("{faults}"));
    let from_deck = deck::parse(DECK, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let [one, other] = [&from_rust, &from_deck.model]
        .map(|model| format!("{:?} {:?}", model.pairs, model.steps[0].frictions));
    assert_eq!(one, other);
    Ok(())
}

#[test]
fn what_follows_a_rigid_surface_does_not_touch_it() -> Result<(), Error> {
    let corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]];
    let corners = corners.map(|[x, y]| Vec3::new(x, y, 4.0)).to_vec();
    let facet = [0, 3, 2, 1].map(NodeId::new);
    let plate = rigid_surface("plate", corners, vec![facet]).and_tied("carcass", "zmax");
    let hold = step("hold").hold("tread", "zmax");
    let model = builder()?
        .rigid(plate)
        .contact(everything())
        .step(hold)
        .build();
    let model = model.unwrap_or_else(|faults| panic!("{faults}"));
    let names: Vec<&str> = model.pairs.iter().map(|pair| pair.name.as_str()).collect();
    assert!(names.contains(&"carcass.rest-2-plate"), "{names:?}");
    assert!(names.contains(&"tread-plate"), "{names:?}");
    Ok(())
}

/// Statements that leave the same out agree, whichever is narrower.
#[test]
fn exclusions_may_overlap() -> Result<(), Error> {
    let all = everything().exclude("tread").exclude("carcass");
    let hold = step("hold").hold("tread", "zmax").hold("carcass", "zmax");
    let model = builder()?.contact(all).step(hold).build();
    let model = model.unwrap_or_else(|faults| panic!("{faults}"));
    let names: Vec<&str> = model.pairs.iter().map(|pair| pair.name.as_str()).collect();
    assert_eq!(names, ["slit"]);
    Ok(())
}

#[test]
fn faults_have_paths() -> Result<(), Error> {
    let told = |faults: Faults| faults.0[0].to_string();
    let unknown = told(built("tread-roof")?.unwrap_err());
    assert!(
        unknown.starts_with("steps[0].frictions[0]: no pair is named `tread-roof`"),
        "{unknown}"
    );
    let twice = everything().exclude("road").exclude("road").exclude("rod");
    let faults = builder()?.contact(twice).build().unwrap_err();
    assert!(told(faults).starts_with("contact.exclude[2].a: no body or rigid surface is named"));
    let angle = everything().feature_angle(0.0);
    let faults = builder()?.contact(angle).build().unwrap_err();
    assert!(told(faults).starts_with("contact.feature_angle: the feature angle of contact"));
    Ok(())
}

#[test]
fn advice_says_what_may_touch_and_what_is_thin() {
    let deck = deck::parse(DECK, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let advice = Advice::of(&deck.model);
    let told = |remarks: &[striae::advice::Remark]| -> Vec<String> {
        let remarks = remarks
            .iter()
            .filter(|remark| remark.topic == Topic::Contact);
        remarks.map(|remark| remark.text.clone()).collect()
    };
    assert_eq!(
        told(&advice.notes)[..2],
        [
            "body `tread` may touch `carcass`, `road`; not itself",
            "body `carcass` may touch `tread`, itself; not `road`"
        ]
    );
    let [warning] = &told(&advice.warnings)[..] else {
        panic!("{:?}", advice.warnings)
    };
    assert!(
        warning.starts_with("body `tread` is 0.400 thick where facets are 3.000 wide, at (")
            && warning.ends_with("increments must move its layers by less than 0.200, and those of step `press` prescribe up to 0.300; take more increments"),
        "{warning}"
    );
}

/// A block that is pushed over the edge of another one.
const OVER_AN_EDGE: &str = r#"
title = "A block that is pushed over an edge"
[[material]]
name = "soft"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[material]]
name = "stiff"
law = "neo-hookean"
youngs_modulus = 100
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "soft"
mesh = { generator = "block", size = [1, 1, 0.6], divisions = [3, 3, 2] }
[[body]]
name = "upper"
material = "stiff"
mesh = { generator = "block", origin = [0.45, 0.15, 0.6], size = [0.5, 0.7, 0.4], divisions = [2, 4, 2] }
[contact]
all = true
friction = { law = "coulomb", mu = 0.3 }
[[step]]
name = "press"
increments = 2
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.03 },
]
[[step]]
name = "push"
increments = 8
displacement = [{ body = "upper", nodes = "zmax", x = 0.35 }]
"#;

/// A law of two faces, which makes pairs of parts of the bodies.
const OF_FACES: &str = r#"
[[contact.between]]
a = "lower.zmax"
b = "upper.zmin"
friction = { law = "coulomb", mu = 0.3 }
"#;

#[test]
fn laws_of_parts_change_nothing_where_they_are_the_same() {
    let parts = format!("{OVER_AN_EDGE}{OF_FACES}");
    let [whole, parts] = [OVER_AN_EDGE, &parts].map(|text| {
        let deck = deck::parse(text, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
        let run = Simulation::of(deck).unwrap().run().unwrap();
        assert_eq!(run.ending, Ending::Completed);
        run.results().positions("upper").unwrap().to_vec()
    });
    for (one, other) in whole.iter().zip(&parts) {
        assert!((one - other).norm() < 1e-12, "{one} {other}");
    }
}

/// Bodies with a common edge, where deformed facets share next to no area.
const COMMON_EDGE: &str = r#"
title = "A wall beside a floor, with a common edge"
[[material]]
name = "soft"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[material]]
name = "stiff"
law = "neo-hookean"
youngs_modulus = 12
poissons_ratio = 0.3
[[body]]
name = "floor"
material = "stiff"
mesh = { generator = "block", origin = [0, 0, -0.6], size = [1, 1, 0.6], divisions = [3, 2, 4] }
[[body]]
name = "wall"
material = "stiff"
mesh = { generator = "block", origin = [-0.6, 0, 0], size = [0.6, 1, 0.8], divisions = [2, 4, 2] }
[[body]]
name = "block"
material = "soft"
mesh = { generator = "block", size = [1, 1, 0.8], divisions = [2, 2, 2] }
[contact]
all = true
friction = { law = "coulomb", mu = 0.2 }
[[step]]
name = "press"
increments = 1
displacement = [
    { body = "block", nodes = "zmax", z = -0.004 },
    { body = "block", nodes = "xmax", x = -0.004 },
    { body = "block", nodes = "ymin", y = 0 },
    { body = "floor", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "wall", nodes = "xmin", x = 0, y = 0, z = 0 },
]
"#;

#[test]
fn slivers_along_a_common_edge_are_no_contact_that_was_missed() {
    let deck = deck::parse(COMMON_EDGE, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let run = Simulation::of(deck).unwrap().run().unwrap();
    assert_eq!(run.ending, Ending::Completed);
    let edge = run.results().pair("floor-wall").unwrap();
    assert_eq!(edge.sides[0].force.norm(), 0.0);
}

#[test]
fn motions_that_lead_through_each_other_are_named() {
    let text = r#"
title = "A lid that comes down onto a corner that is held"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[body]]
name = "block"
material = "rubber"
mesh = { generator = "block", size = [1, 1, 1], divisions = [2, 2, 2] }
node_sets = [{ name = "corner", from = [0.9, 0.9, 0.9], to = [1.1, 1.1, 1.1] }]
[[rigid]]
name = "lid"
plane = { point = [0, 0, 1.01], normal = [0, 0, -1] }
[contact]
all = true
[[step]]
name = "press"
increments = 2
displacement = [
    { body = "block", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "block", nodes = "corner", x = 0, y = 0, z = 0 },
]
rigid = [{ surface = "lid", displacement = [0, 0, -0.5] }]
"#;
    let deck = deck::parse(text, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    let run = Simulation::of(deck).unwrap().run().unwrap();
    let told = run.ending.to_string();
    assert!(
        told.contains("node 26 of `block` and `lid` are both prescribed, and so that they go"),
        "{told}"
    );
}
