//! Contact of everything: three blocks lie on each other and on a floor. Nothing names a pair; what
//! touches carries the weight of all that is above.

mod plot;

use striae::prelude::*;
use striae_figure::{Axis, Content, Marker, Panel, Series};

const GRAVITY: f64 = 10.0;
const DENSITY: f64 = 1000.0;

fn block(x: f64, z: f64, width: f64) -> Block {
    Block {
        origin: Vec3::new(x, 0.0, z),
        size: Vec3::new(width, 0.5, 0.2),
        divisions: [4, 2, 2],
        ..Block::default()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3)?);
    let blocks = [
        ("left", block(0.0, 0.0, 0.4)),
        ("right", block(0.5, 0.0, 0.4)),
        ("top", block(0.1, 0.2, 0.7)),
    ];
    let mut pile = model("A pile")
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .contact(everything().friction(Friction::coulomb(0.5)?))
        .step(step("weigh").increments(2).gravity([0.0, 0.0, -GRAVITY]));
    for (name, block) in &blocks {
        pile = pile.body(body(*name, block.mesh()?, rubber.clone()).density(DENSITY));
    }
    let run = Simulation::new(pile.build()?)?.run()?;
    let results = run.results();

    let weight = |width: f64| width * 0.5 * 0.2 * DENSITY * GRAVITY;
    let top = 0.5 * weight(0.7);
    let expected = [
        ("left-top", top),
        ("right-top", top),
        ("left-floor", weight(0.4) + top),
        ("right-floor", weight(0.4) + top),
    ];
    let mut forces = Vec::new();
    for (pair, expected) in expected {
        let report = results.pair(pair).expect("what may touch has a pair");
        let force = report.sides[0].force.z.abs();
        println!("{pair:11}: {force:8.3} N, all that is above weighs {expected:.3} N");
        assert!((force - expected).abs() < 1e-6 * expected);
        forces.push([expected, force]);
    }
    let all = vec![[0.0, 0.0], [800.0, 800.0]];
    let panel = Panel::plane(
        Axis::linear("weight of what is above", "N"),
        Axis::linear("contact force", "N"),
    )
    .with(Series::new(
        "contacts",
        Content::markers(forces, Marker::Circle),
    ))
    .with(Series::new("equilibrium", Content::dashed(all)));
    plot::plot("pile", panel)
}
