//! Runs that go on from one state: a block is pressed onto a nap once, and dragged from there in
//! many directions at the same time. Their forces are the law of the nap.

mod plot;

use std::f64::consts::TAU;

use rayon::prelude::*;
use striae::prelude::*;
use striae_figure::{Axis, Content, Marker, Panel, Series};

const COUNT: usize = 16;

fn pressed(nap: Friction) -> Result<Finished, Error> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3)?);
    let block = Block {
        size: Vec3::new(0.1, 0.1, 0.03),
        divisions: [3, 3, 1],
        ..Block::default()
    };
    // The nap lies across the lines of its texture, to their left seen from above.
    let floor = rigid("floor").textured(uniform([0.0, -1.0, 0.0]));
    let model = model("A block on a nap")
        .body(body("block", block.mesh()?, rubber))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(pair("sole", surface("block", "zmin"), floor).friction(nap))
        .step(
            step("press")
                .increments(2)
                .displace("block", "zmax", [0.0, 0.0, -0.001]),
        )
        .build()?;
    Simulation::new(model)?.run()
}

/// Friction over pressure against a drag at an angle, and across it.
fn dragged(pressed: &Finished, angle: f64) -> Result<[f64; 2], Error> {
    let (sin, cos) = angle.sin_cos();
    let drag = [Some(0.05 * cos), Some(0.05 * sin), None];
    let drag = step("drag").increments(4).displace("block", "zmax", drag);
    let run = Simulation::after(pressed, vec![drag])?.run()?;
    let sole = run.results().pair("sole").expect("there is such a pair");
    let force = sole.sides[0].force / sole.sides[0].force.z;
    Ok([-force.x, -force.y])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pressed = pressed(Friction::nap(0.2, 0.6, 0.4)?)?;
    let angles = (0..COUNT)
        .into_par_iter()
        .map(|at| TAU * at as f64 / COUNT as f64);
    let forces = angles.map(|angle| dragged(&pressed, angle));
    let forces: Vec<[f64; 2]> = forces.collect::<Result<_, Error>>()?;
    for (at, [x, y]) in forces.iter().enumerate() {
        let degrees = 360 * at / COUNT;
        println!("dragged at {degrees:3} degrees: friction {x:7.4} along, {y:7.4} across the nap");
    }
    // With, across and against the nap the coefficients are those of the law.
    let [with, across, against] = [0, COUNT / 4, COUNT / 2].map(|at| forces[at]);
    for (found, expected) in [(with[0], 0.2), (across[1], 0.4), (against[0], -0.6)] {
        assert!((found - expected).abs() < 2e-3, "{found} {expected}");
    }
    let axis = |label: &str| Axis::linear(label, "");
    let panel = Panel::plane(axis("friction along"), axis("across the nap")).with(Series::new(
        "dragged blocks",
        Content::markers(forces, Marker::Circle),
    ));
    plot::plot("rosette", panel)
}
