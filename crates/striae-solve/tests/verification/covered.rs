//! A stiff cap that touches a soft block within one of the block's facets.

use striae_mesh::{
    Mesh, Vec3,
    generate::{Block, CappedBlock},
};

use crate::scene::{Places, Run, block, body, coulomb, increments, model, rubber, step};

/// Young's modulus of the cap over that of the block.
const RATIO: f64 = 50.0;
/// Element size of the cap, which is not finer than this.
const FINE: f64 = 0.05;
/// Depth to which the cap is pressed.
const DEPTH: f64 = 0.004;

/// A cap of radius 1 with elements of a size that is pressed on a block with five facets along
/// `x` and `y`.
fn pressed_cap(size: f64, ratio: f64, depth: f64) -> Run {
    let cap = CappedBlock {
        size: [0.6; 2],
        height: 0.4,
        radius: 1.0,
        element_size: size,
        fine_half_width: 2.0 * size,
        growth: 1.6,
        ..CappedBlock::default()
    };
    let base = block([-0.5, -0.5, -0.4], [1.0, 1.0, 0.4], [5, 5, 3]);
    run(cap.mesh().unwrap(), base, "cap", ratio, depth)
}

/// A mesh that is pressed with its side `sole` on a block.
fn run(upper: Mesh, base: Block, sole: &str, ratio: f64, depth: f64) -> Run {
    let mut model = model(vec![
        body("upper", upper, rubber(ratio, 0.3)),
        body("base", base.mesh().unwrap(), rubber(1.0, 0.3)),
    ]);
    model.touch(("base", "zmax"), ("upper", sole), coulomb(0.3));
    let mut press = step();
    press.increments = increments(0.25, 0.05);
    press.displacements = vec![
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-depth)]),
        model.hold("base", "zmin", [Some(0.0); 3]),
    ];
    model.steps = vec![press];
    Run::completed(model)
}

/// Force of the block on what is pressed.
fn force(run: &Run) -> f64 {
    let forces = &run.last().forces.contact[..run.problem.first_node[1]];
    forces.iter().map(|force| force.z).sum()
}

/// Depth of the lowest node of the cap below the nearest nodes of the block, which are the corners
/// of one facet.
fn depth(run: &Run) -> f64 {
    let lowest = run
        .positions(0)
        .iter()
        .map(|x| x.z)
        .fold(f64::INFINITY, f64::min);
    let apart = |x: &&Vec3| x.x.hypot(x.y);
    let top = run.positions(1).iter().filter(|x| x.z > -0.1);
    let nearest = top.min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap();
    nearest.z - lowest
}

#[test]
fn contact_within_a_facet_of_the_softer_side_is_felt() {
    let run = pressed_cap(FINE, RATIO, DEPTH);
    assert!(force(&run) > 0.0);
    // The bedding yields where the facet cannot bend round the cap.
    assert!(depth(&run) < 0.2 * FINE, "{}", depth(&run));
}

#[test]
fn contact_within_a_facet_of_both_sides_is_felt() {
    // The mean gap over the facets of the cap would close at h^2/(3.4 R), .029 of their size here.
    let size = 0.1;
    let run = pressed_cap(size, 1.0 / RATIO, 0.025 * size);
    assert!(force(&run) > 0.0);
    assert!(depth(&run) < 0.025 * size, "{}", depth(&run));
    let pressed = pressed_cap(size, 1.0 / RATIO, 0.08 * size);
    assert!(force(&pressed) > force(&run));
}
