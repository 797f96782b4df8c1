//! Wear: a sole that is drawn over a floor under a pressure `p` loses the depth `k p s` on the way
//! `s`, as Archard has it.

mod plot;

use striae::prelude::*;
use striae_figure::{Axis, Content, Panel, Series};

const PRESSURE: f64 = 1e4;
const WAY: f64 = 0.2;
const WEAR: f64 = 1e-6;

fn drawn() -> Result<Model, Error> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.0)?);
    let block = Block {
        size: Vec3::new(0.1, 0.1, 0.05),
        divisions: [4, 4, 2],
        ..Block::default()
    };
    let sole = pair("sole", surface("block", "zmin"), rigid("floor"));
    let model = model("A sole that wears")
        .body(body("block", block.mesh()?, rubber))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(sole.friction(Friction::coulomb(0.5)?).wear(WEAR, 0.0))
        .step(
            step("press")
                .increments(1)
                .displace("block", "all", [Some(0.0), Some(0.0), None])
                .pressure("block", "zmax", PRESSURE),
        )
        .step(
            step("draw")
                .increments(20)
                .displace("block", "all", [Some(WAY), Some(0.0), None]),
        );
    Ok(model.build()?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let run = Simulation::new(drawn()?)?.run()?;
    let column = |name: &str| run.history.column(name).expect("there is such a column");
    let (time, height) = (column("time"), column("centre.block.z"));
    let sunk: Vec<f64> = height.iter().map(|z| height[0] - z).collect();
    let last = sunk[sunk.len() - 1];
    let expected = WEAR * PRESSURE * WAY;
    println!(
        "{}: worn by {last:.6} m, in closed form {expected:.6} m",
        run.ending
    );
    assert!((last / expected - 1.0).abs() < 1e-6);

    let depths = time.iter().zip(&sunk);
    let depths = depths.map(|(time, sunk)| [(time - 1.0) * WAY, 1e3 * sunk]);
    let panel = Panel::new(Axis::linear("way", "m"), Axis::linear("depth", "mm"))
        .with(Series::new("sole", Content::line(depths.collect())))
        .with(Series::new(
            "k p s",
            Content::dashed(vec![[0.0, 0.0], [WAY, 1e3 * expected]]),
        ));
    plot::plot("worn-sole", panel)
}
