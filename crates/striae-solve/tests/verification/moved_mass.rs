//! Work of what moves a mass.

use crate::{
    dynamics::moving,
    scene::{Places, Run, block, body, model, rubber},
};
use striae_model::Curve;

/// Work done on a body that is moved from rest to rest with all of its nodes, and what the
/// time integration gains by it, over the largest kinetic energy.
fn moved_to_and_fro(count: usize) -> [f64; 2] {
    let mesh = block([0.0; 3], [1.0; 3], [1, 1, 1]).mesh().unwrap();
    let mut cube = body("cube", mesh, rubber(10.0, 0.3));
    cube.density = 1.0;
    let mut model = model(vec![cube]);
    let mut step = moving(1.0, count);
    for set in ["xmin", "xmax"] {
        let mut moved = model.hold("cube", set, [Some(0.1), Some(0.0), Some(0.0)]);
        moved.curve = Curve::Smooth;
        step.displacements.push(moved);
    }
    model.steps.push(step);
    let run = Run::completed(model);
    let kinetic = run.states.iter().map(|state| state.energies.kinetic);
    let most = kinetic.fold(0.0, f64::max);
    let energies = run.last().energies;
    [energies.external, energies.numerical].map(|energy| energy / most)
}

#[test]
fn what_moves_a_mass_gets_its_work_back() {
    let counts = [20, 40, 80];
    let errors = counts.map(moved_to_and_fro);
    for [external, numerical] in errors {
        assert!(external.abs() < 1e-9, "{errors:?}");
        assert!(numerical.abs() < 1e-9, "{errors:?}");
    }
}
