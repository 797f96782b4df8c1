//! A block pressed onto a grooved floor and dragged obliquely: friction turns it aside.

mod plot;

use striae::prelude::*;
use striae_figure::{Axis, Content, Panel, Series};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3)?);
    let block = Block {
        divisions: [4, 4, 4],
        ..Block::default()
    };
    let grooves = uniform([1.0, 1.0, 0.0]);
    let floor = rigid("floor").textured(grooves);
    let model = model("A block on a grooved floor")
        .body(body("block", block.mesh()?, rubber))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(
            pair("sole", surface("block", "zmin"), floor).friction(Friction::orthotropic(
                0.1,
                0.4,
                SlipRule::Opposing,
            )?),
        )
        .step(
            step("press")
                .increments(2)
                .displace("block", "zmax", [0.0, 0.0, -0.02]),
        )
        .step(step("drag").displace("block", "zmax", [Some(0.5), None, None]))
        .build()?;
    let run = Simulation::new(model)?.run()?;
    println!("{}", run.ending);
    let sole = run.results().pair("sole").expect("there is such a pair");
    println!("force on the sole: {:.1?}", sole.sides[0].force.as_slice());

    let column = |name: &str| run.history.column(name).expect("there is such a column");
    let time = column("time");
    let force = |axis: &str| -> Vec<[f64; 2]> {
        let forces = column(&format!("pair.sole.resultant_a.{axis}"));
        let forces = time.iter().zip(forces);
        forces.map(|(time, force)| [*time, 1e-3 * force]).collect()
    };
    let panel = Panel::new(Axis::linear("time", ""), Axis::linear("friction", "kN"))
        .with(Series::new("against the drag", Content::line(force("x"))))
        .with(Series::new("aside", Content::line(force("y"))));
    plot::plot("textured-floor", panel)
}
