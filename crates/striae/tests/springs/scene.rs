//! Rigid bodies on springs, beside a block that only makes the model complete.

use striae::{
    model::{Increments, ModelBuilder, RigidBuilder, RigidInertia, StepBuilder, Validate},
    prelude::*,
};

/// A model with a block that is held.
pub fn with_block(title: &str) -> ModelBuilder {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap());
    let block = Block {
        origin: Vec3::new(0.0, 0.0, -3.0),
        ..Block::default()
    };
    model(title).body(body("block", block.mesh().unwrap(), rubber).density(1.0))
}

/// A step that holds the block.
pub fn held(name: &str) -> StepBuilder {
    step(name).hold("block", "all")
}

/// A rigid body of mass 2 that turns about a place.
pub fn weight(name: &str, at: [f64; 3]) -> RigidBuilder {
    let inertia = RigidInertia::aligned(2.0, at.into(), [0.1; 3]);
    plane(name, at, [0.0, 0.0, -1.0])
        .reference(at)
        .inertia(inertia)
}

/// Coordinates of which some of the displacements are free.
pub fn free(axes: &[usize]) -> [Freedom; 6] {
    std::array::from_fn(|at| match axes.contains(&at) {
        true => Freedom::Free,
        false => Freedom::AsBefore,
    })
}

/// Equal increments that are never larger.
pub fn equal(count: usize) -> Increments {
    striae::model::equal_increments(count)
}

pub fn run(model: ModelBuilder) -> striae::Finished {
    let model = model.build().unwrap_or_else(|faults| panic!("{faults}"));
    assert!(model.faults().is_empty());
    let run = Simulation::new(model).unwrap().run().unwrap();
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    run
}
