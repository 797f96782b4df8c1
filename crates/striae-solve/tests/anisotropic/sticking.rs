//! Nodes that stick do not know the law.

use crate::{
    oblique::{Formula, uniform},
    scene::{Places, Run, block, body, increments, largest_distance, model, plane, rubber, step},
    table::Table,
};
use striae_contact::unknowns::Status;

/// Ten times as much friction in one direction as in another.
const STEEP: Table = &[
    [0.0, 9.0],
    [60.0, 0.9],
    [120.0, 7.0],
    [200.0, 1.0],
    [280.0, 8.0],
];

/// A block that is pressed and sheared far below the slip surface.
fn sheared(law: Formula, texture: Option<f64>) -> Run {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, law.friction());
    model.pairs[0].textures = [texture.map(uniform), None];
    for (count, motion) in [(10, [0.0, 0.0, -0.02]), (4, [0.004, 0.002, -0.02])] {
        let mut step = step();
        step.increments = increments(1.0 / f64::from(count), 1e-3);
        step.displacements = vec![model.hold("block", "zmax", motion.map(Some))];
        model.steps.push(step);
    }
    Run::completed(model)
}

#[test]
fn sticking_nodes_take_the_same_iterations_to_the_same_state_whatever_the_law() {
    let coulomb = sheared(Formula::Coulomb(0.9), None);
    let nodes = coulomb.last().pairs[0].nodes[0].iter();
    let sticking = nodes.filter(|node| node.status == Status::Stick).count();
    assert_eq!(sticking, 25);
    for texture in [0.0, 17.0, 140.0] {
        let table = sheared(Formula::Tabulated(STEEP), Some(texture));
        assert!(table.cuts.is_empty(), "{:?}", table.cuts);
        let apart = largest_distance(&table.last().positions, &coulomb.last().positions);
        assert!(apart < 1e-12, "{apart:.1e}");
        let counts = |run: &Run| -> Vec<usize> { run.iterations.iter().map(Vec::len).collect() };
        assert_eq!(counts(&table), counts(&coulomb));
    }
}
