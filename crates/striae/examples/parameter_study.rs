//! A parameter study: the same drag over floors whose grooves turn, run in parallel.

mod plot;

use rayon::prelude::*;
use striae::prelude::*;
use striae_figure::{Axis, Content, Panel, Series};

/// Sideways over forward force on a block that is dragged over grooves at an angle to
/// the direction of the drag.
fn deflection(degrees: f64) -> Result<f64, Error> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3)?);
    let block = Block {
        divisions: [3, 3, 2],
        ..Block::default()
    };
    let (sin, cos) = degrees.to_radians().sin_cos();
    let floor = rigid("floor").textured(uniform([cos, sin, 0.0]));
    let model = model(format!("Grooves at {degrees} degrees"))
        .body(body("block", block.mesh()?, rubber))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(
            pair("sole", surface("block", "zmin"), floor).friction(Friction::orthotropic(
                0.1,
                0.3,
                SlipRule::Associated,
            )?),
        )
        .step(
            step("press")
                .increments(2)
                .displace("block", "zmax", [0.0, 0.0, -0.02]),
        )
        .step(step("drag").displace("block", "zmax", [Some(0.3), None, None]))
        .build()?;
    let run = Simulation::new(model)?.run()?;
    let sole = run.results().pair("sole").expect("there is such a pair");
    let force = sole.sides[0].force;
    Ok(force.y / force.x)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let angles: Vec<f64> = (0..=18).map(|step| 5.0 * f64::from(step)).collect();
    let deflections: Result<Vec<f64>, Error> =
        angles.par_iter().map(|angle| deflection(*angle)).collect();
    let points = angles.iter().zip(deflections?);
    let points: Vec<[f64; 2]> = points.map(|(angle, found)| [*angle, found]).collect();
    println!("grooves [degrees]  sideways / forward");
    for [angle, deflection] in &points {
        println!("{angle:17.0}  {deflection:18.4}");
    }
    let angle = Axis::linear("angle of the grooves", "degrees");
    let panel = Panel::new(angle, Axis::linear("sideways / forward", ""))
        .with(Series::new("force", Content::line(points)));
    plot::plot("parameter-study", panel)
}
