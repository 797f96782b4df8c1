//! Blocks that are tied.

use striae::{
    mesh::{CellKind, generate::Block},
    model::{ModelBuilder, StepBuilder},
    nalgebra::Matrix3,
    prelude::*,
    solve::report::{TieReport, ties},
};
pub use striae::{model::tie, prelude::Finished};

/// A soft neo-Hookean solid.
pub fn rubber() -> Material {
    Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3).unwrap())
}

/// The lower and the upper half of a unit cube, cut by an oblique plane.
pub fn halves(slopes: [f64; 2]) -> [Block; 2] {
    let lower = Block {
        size: Vec3::new(1.0, 1.0, 0.5),
        divisions: [4, 4, 2],
        top_slopes: slopes,
        ..Block::default()
    };
    let upper = Block {
        origin: Vec3::new(0.0, 0.0, 0.5),
        size: Vec3::new(1.0, 1.0, 0.5),
        divisions: [3, 3, 2],
        bottom_slopes: slopes,
        ..Block::default()
    };
    [lower, upper]
}

pub fn of(cells: CellKind, block: Block) -> Block {
    Block { cells, ..block }
}

/// A model of two blocks, `lower` and `upper`, with their tie, without steps.
pub fn tied([lower, upper]: &[Block; 2]) -> ModelBuilder {
    model("Two tied blocks")
        .body(body("lower", lower.mesh().unwrap(), rubber()).density(1000.0))
        .body(body("upper", upper.mesh().unwrap(), rubber()).density(1000.0))
        .tie(tie(
            "glue",
            surface("lower", "zmax"),
            surface("upper", "zmin"),
        ))
}

/// A step that pulls the cube along `z` between rollers on three sides.
pub fn pull(stretch: f64) -> StepBuilder {
    let mut pull = step("pull").increments(2);
    for body in ["lower", "upper"] {
        pull = pull
            .displace(body, "xmin", [Some(0.0), None, None])
            .displace(body, "ymin", [None, Some(0.0), None]);
    }
    pull.displace("lower", "zmin", [None, None, Some(0.0)])
        .displace("upper", "zmax", [None, None, Some(stretch)])
}

pub fn run(model: ModelBuilder) -> Finished {
    let run = Simulation::new(model.build().unwrap())
        .unwrap()
        .run()
        .unwrap();
    assert_eq!(run.ending, Ending::Completed);
    run
}

/// Largest difference of the stress at any node from its mean, over the mean.
pub fn unevenness(run: &Finished) -> f64 {
    let results = run.results();
    let bodies = run.problem.model.bodies.iter();
    let all: Vec<Matrix3<f64>> = bodies
        .flat_map(|body| results.stresses(&body.name).unwrap())
        .collect();
    let mean = all.iter().sum::<Matrix3<f64>>() / all.len() as f64;
    let differences = all.iter().map(|stress| (stress - mean).norm());
    differences.fold(0.0, f64::max) / mean.norm()
}

/// Report of the only tie at the end.
pub fn glue(run: &Finished) -> TieReport {
    ties(&run.problem, &run.state).remove(0)
}

/// Largest distance of the nodes of two runs of the same bodies, whatever their order.
pub fn distance(one: &Finished, other: &Finished) -> f64 {
    let names = one.problem.model.bodies.iter().map(|body| &body.name);
    let distances = names.flat_map(|name| {
        let [a, b] = [one, other].map(|run| run.results().positions(name).unwrap().to_vec());
        a.into_iter().zip(b).map(|(a, b)| (a - b).norm())
    });
    distances.fold(0.0, f64::max)
}
