//! Dynamics: a block that is thrown along a floor slides to rest after `v^2/(2 mu g)`.

mod plot;

use striae::prelude::*;
use striae_figure::{Axis, Content, Panel, Series};

const SPEED: f64 = 2.0;
const MU: f64 = 0.4;
const GRAVITY: f64 = 9.81;

fn thrown() -> Result<Model, Error> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3)?);
    let block = Block {
        size: Vec3::new(0.2, 0.2, 0.05),
        divisions: [4, 4, 1],
        ..Block::default()
    };
    let sole = pair("sole", surface("block", "zmin"), rigid("floor"));
    let settle = step("settle")
        .increments(1)
        .gravity([0.0, 0.0, -GRAVITY])
        .displace("block", "zmax", [Some(0.0), Some(0.0), None]);
    // Friction takes the speed at the rate `mu g`; the step is a quarter longer than that.
    let slide = step("slide")
        .dynamic(0.5)
        .duration(1.25 * SPEED / (MU * GRAVITY))
        .increments(80)
        .release_all("block", "zmax")
        .velocity("block", [SPEED, 0.0, 0.0]);
    let model = model("A block that slides to rest")
        .body(body("block", block.mesh()?, rubber).density(1000.0))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(sole.friction(Friction::coulomb(MU)?))
        .step(settle)
        .step(slide);
    Ok(model.build()?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let run = Simulation::new(thrown()?)?.run()?;
    let column = |name: &str| run.history.column(name).expect("there is such a column");
    let (time, centre) = (column("time"), column("centre.block.x"));
    let way: Vec<f64> = centre.iter().map(|x| x - centre[0]).collect();
    let last = way[way.len() - 1];
    let expected = SPEED * SPEED / (2.0 * MU * GRAVITY);
    println!(
        "{}: {last:.4} m, in closed form {expected:.4} m",
        run.ending
    );
    assert!((last / expected - 1.0).abs() < 0.01);

    let ways = time.iter().zip(&way).map(|(time, way)| [time - 1.0, *way]);
    let panel = Panel::new(Axis::linear("time", "s"), Axis::linear("way", "m"))
        .with(Series::new("block", Content::line(ways.collect())))
        .with(Series::new(
            "v^2/(2 mu g)",
            Content::dashed(vec![
                [0.0, expected],
                [time[time.len() - 1] - 1.0, expected],
            ]),
        ));
    plot::plot("sliding-to-rest", panel)
}
