//! Models built by name give what decks give, and runs what files give.

use std::path::Path;

use striae::{deck, output::history::Table, prelude::*};

const DECK: &str = r#"
title = "A block on a floor"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3
[[body]]
name = "block"
material = "rubber"
mesh = { generator = "block", divisions = [2, 2, 2], size = [1, 1, 1] }
[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 2] }
[[pair]]
name = "sole"
a = { rigid = "floor", texture = { uniform = [1, 1, 0] } }
b = { body = "block", facets = "zmin" }
friction = { law = "orthotropic", mu_along = 0.1, mu_across = 0.4 }
[[step]]
name = "press"
increments = 2
displacement = [{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.02 }]
[[step]]
name = "drag"
increments = 3
displacement = [{ body = "block", nodes = "zmax", x = 0.3, curve = "smooth" }]
"#;

fn built() -> Model {
    let rubber = LameConstants::from_youngs_modulus(1e6, 0.3).unwrap();
    let block = Block {
        divisions: [2, 2, 2],
        ..Block::default()
    };
    let floor = rigid("floor").textured(uniform([1.0, 1.0, 0.0]));
    let friction = Friction::orthotropic(0.1, 0.4, SlipRule::Opposing).unwrap();
    let press = step("press").increments(2);
    let drag = step("drag").increments(3);
    model("A block on a floor")
        .body(body(
            "block",
            block.mesh().unwrap(),
            Material::neo_hookean(rubber),
        ))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 2.0]))
        .pair(pair("sole", floor, surface("block", "zmin")).friction(friction))
        .step(press.displace("block", "zmax", [0.0, 0.0, -0.02]))
        .step(
            drag.displace("block", "zmax", [Some(0.3), None, None])
                .along(Curve::Smooth),
        )
        .build()
        .unwrap()
}

#[test]
fn a_model_built_by_name_is_that_of_its_deck() {
    let built = built();
    let mut read = deck::parse(DECK, "deck.toml", Path::new("")).unwrap().model;
    let [of_deck, own] = [&read, &built].map(|model| model.bodies[0].material.clone());
    assert_eq!(of_deck, own);
    // The deck states Young's modulus, the builder Lame's constants that follow from it.
    read.bodies[0].material = own;
    assert_eq!(format!("{built:?}"), format!("{read:?}"));
}

#[test]
fn a_run_in_memory_has_the_results_of_one_in_files() {
    let folder = tempfile::tempdir().unwrap();
    let memory = Simulation::new(built()).unwrap().run().unwrap();
    let files = Simulation::new(built())
        .unwrap()
        .recorded(folder.path(), "block");
    let files = files.run().unwrap();
    assert_eq!(memory.ending, Ending::Completed);
    assert_eq!(memory.history, files.history);
    let written = Table::read(&folder.path().join("history.csv")).unwrap();
    assert_eq!(memory.history, written);
    assert_eq!(memory.state.positions, files.state.positions);
    assert_eq!(memory.summary.newton_total, files.summary.newton_total);
    assert_eq!(memory.summary.pairs, files.summary.pairs);
    assert!(!folder.path().join("checkpoint.bin").exists());
}

#[test]
fn results_are_found_by_name() {
    let run = Simulation::new(built()).unwrap().run().unwrap();
    let results = run.results();
    let displacements = results.displacements("block").unwrap();
    let mesh = &run.problem.model.bodies[0].mesh;
    for node in mesh.node_sets.get("zmax").unwrap() {
        let moved = displacements[node.index()] - Vec3::new(0.3, 0.0, -0.02);
        assert!(moved.norm() < 1e-12);
    }
    let sole = results.pair("sole").unwrap();
    let held = results.reaction("block.zmax").unwrap() + sole.sides[0].force;
    assert!(held.norm() < 1e-6 * sole.sides[0].force.norm(), "{held}");
    let forces: Vec3 = results.contact_forces("block").unwrap().iter().sum();
    assert!((forces - sole.sides[0].force).norm() < 1e-9 * forces.norm());
    assert_eq!(results.contact("sole", PairSide::A).unwrap().len(), 9);
    assert_eq!(results.surface_nodes("sole", PairSide::A).unwrap().len(), 9);
    assert!(results.surface_nodes("sole", PairSide::B).is_none());
    assert!(results.positions("floor").is_none() && results.pair("solo").is_none());
    assert_eq!(run.at_end_of(0).unwrap().time(), 1.0);
    assert!(run.at_end_of(2).is_none());
}

#[test]
fn interrupts_stop_a_run_after_its_first_increment() {
    let interrupt = Interrupt::default();
    interrupt.set();
    let run = Simulation::new(built()).unwrap().until(&interrupt).run();
    assert_eq!(run.unwrap().ending, Ending::Interrupted { time: 0.5 });
}

/// The area under pressure of a cap on a block is that of the same model in other units: points at
/// which the support of a closed node ends are not under its pressure, which is round-off there.
#[test]
fn areas_under_pressure_do_not_depend_on_units() {
    let areas = |length: f64, modulus: f64| {
        let of = |figures: &[f64]| {
            let scaled: Vec<f64> = figures.iter().map(|figure| figure * length).collect();
            format!("{scaled:?}")
        };
        let [radius, height, element, depth] = [1.5, 0.5, 0.15, -0.05].map(|of| of * length);
        let text = format!(
            r#"
title = "A cap on a block"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = {modulus:?}
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "rubber"
mesh = {{ generator = "block", origin = {}, size = {}, divisions = [4, 4, 2] }}
[[body]]
name = "upper"
material = "rubber"
mesh = {{ generator = "capped-block", apex = {}, size = {}, height = {height:?}, radius = {radius:?}, element_size = {element:?} }}
[[pair]]
name = "sole"
a = {{ body = "upper", facets = "cap" }}
b = {{ body = "lower", facets = "zmax" }}
[[step]]
name = "press"
increments = 3
displacement = [
    {{ body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 }},
    {{ body = "upper", nodes = "zmax", x = 0, y = 0, z = {depth:?} }},
]
"#,
            of(&[-0.5, -0.5, -0.5]),
            of(&[2.0, 2.0, 0.5]),
            of(&[0.5, 0.5, 0.0]),
            of(&[1.0, 1.0])
        );
        let deck = deck::parse(&text, "deck", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
        let run = Simulation::of(deck).unwrap().run().unwrap();
        assert_eq!(run.ending, Ending::Completed);
        let areas = run.history.column("pair.sole.area").unwrap().into_iter();
        areas
            .map(|area| area / (length * length))
            .collect::<Vec<f64>>()
    };
    for (metres, millimetres) in areas(1.0, 1e7).into_iter().zip(areas(1e3, 10.0)) {
        let ratio = millimetres / metres;
        assert!((ratio - 1.0).abs() < 1e-10, "{metres} {millimetres}");
    }
}
