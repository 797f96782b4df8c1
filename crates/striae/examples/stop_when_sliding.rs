//! An observer that follows a run and stops it when the block begins to slide as a whole.

mod plot;

use striae::prelude::*;
use striae_figure::{Axis, Content, Panel, Series};

/// Stops when every node in contact slips.
struct UntilSliding;

impl Observer for UntilSliding {
    fn increment(&mut self, converged: &Converged<'_>) -> Next {
        let results = converged.results;
        let nodes = results.contact("sole", PairSide::A).unwrap_or_default();
        let count = |status| nodes.iter().filter(|node| node.status == status).count();
        let (stick, slip) = (count(Status::Stick), count(Status::Slip));
        println!("t = {:.2}: {stick} stick, {slip} slip", results.time());
        if stick == 0 && slip > 0 {
            Next::Stop
        } else {
            Next::Continue
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3)?);
    let block = Block {
        divisions: [4, 4, 4],
        ..Block::default()
    };
    let drag = [Some(0.4), None, None];
    let model = model("A block that begins to slide")
        .body(body("block", block.mesh()?, rubber))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(
            pair("sole", surface("block", "zmin"), rigid("floor"))
                .friction(Friction::coulomb(0.3)?),
        )
        .step(
            step("press")
                .increments(2)
                .displace("block", "zmax", [0.0, 0.0, -0.05]),
        )
        .step(step("drag").increments(20).displace("block", "zmax", drag))
        .build()?;
    let run = Simulation::new(model)?.run_with(&mut UntilSliding)?;
    println!("{}", run.ending);
    assert!(matches!(run.ending, Ending::Interrupted { .. }));

    let column = |name: &str| run.history.column(name).expect("there is such a column");
    let time = column("time");
    let nodes = |status: &str| -> Vec<[f64; 2]> {
        let counts = column(&format!("pair.sole.{status}"));
        time.iter()
            .zip(counts)
            .map(|(time, count)| [*time, count])
            .collect()
    };
    let panel = Panel::new(Axis::linear("time", ""), Axis::linear("nodes", ""))
        .with(Series::new("stick", Content::line(nodes("stick"))))
        .with(Series::new("slip", Content::line(nodes("slip"))));
    plot::plot("stop-when-sliding", panel)
}
