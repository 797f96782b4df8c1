//! Derivatives of a run: how the drag of a block follows from its friction and its load.
//!
//! In full slip the drag is `F = mu p A` under a pressure `p` on the area `A`: then
//! `dF/dmu = p A` and `dF/dp = mu A`.

mod plot;

use striae::{prelude::*, sensitivity::parameter};
use striae_figure::{Axis, Content, Panel, Series};

const MU: f64 = 0.3;
const PRESSURE: f64 = 5e4;

fn dragged(mu: f64, pressure: f64) -> Result<Model, Error> {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3)?);
    let block = Block {
        size: Vec3::new(1.0, 1.0, 0.2),
        divisions: [4, 2, 1],
        ..Block::default()
    };
    let sole = pair("sole", surface("block", "zmin"), rigid("floor"));
    let model = model("A block that is dragged")
        .body(body("block", block.mesh()?, rubber))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(sole.friction(Friction::coulomb(mu)?))
        .step(
            step("press")
                .increments(2)
                .displace("block", "zmax", [Some(0.0), Some(0.0), None])
                .pressure("block", "zmax", pressure),
        )
        .step(
            step("drag")
                .increments(16)
                .displace("block", "zmax", [Some(0.2), None, None]),
        );
    Ok(model.build()?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let by_mu = parameter("mu", MU, |mu| dragged(mu, PRESSURE))?;
    let by_pressure = parameter("p", PRESSURE, |pressure| dragged(MU, pressure))?;
    let run = Simulation::new(dragged(MU, PRESSURE)?)?
        .differentiated(by_mu)
        .differentiated(by_pressure)
        .run()?;
    let drag = |results: &Results<'_>| {
        let sole = results.pair("sole").expect("there is such a pair");
        -sole.sides[0].force.x
    };
    let [by_mu, by_pressure] = &run.sensitivities[..] else {
        return Err("there are two parameters".into());
    };
    println!("drag {:.1} N under {PRESSURE:.1} N", drag(&run.results()));
    // The area is 1.
    for (of, expected) in [(by_mu, PRESSURE), (by_pressure, MU)] {
        let found = of.derivative(drag);
        let name = of.parameter();
        println!("by {name}: {found:.6e}, in closed form {expected:.6e}");
        assert!((found / expected - 1.0).abs() < 1e-6);
    }

    // The derivative jumps where the last nodes begin to slip.
    let column = "pair.sole.resultant_a.x";
    let along = by_mu
        .history
        .column(column)
        .expect("there is such a column");
    let time = run.history.column("time").expect("there is such a column");
    let along = time.iter().zip(&along).map(|(time, slope)| [*time, -slope]);
    let panel = Panel::new(Axis::linear("time", ""), Axis::linear("dF/dmu", "N")).with(
        Series::new("derivative of the drag", Content::line(along.collect())),
    );
    plot::plot("derivatives", panel)
}
