//! A block pressed onto a grooved floor and dragged obliquely: friction turns it aside.

use striae::prelude::*;

fn main() -> Result<(), Error> {
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
    Ok(())
}
