//! Rigid motion without stress, of flat and of curved ties, and the tail of Newton's method.

use striae::{
    contact::evaluation::Evaluation,
    mesh::generate::Annulus,
    model::{Freedom, RigidBuilder},
    nalgebra::Rotation3,
    prelude::*,
    solve::norms::Norms,
};

use super::scene::{glue, halves, pull, rubber, run, tie, tied};

/// A handle that nodes of a body are tied to, and its turn about a skew axis by 100 degrees.
fn handle(body: &str, set: &str) -> (RigidBuilder, [Freedom; 6]) {
    let turn = Rotation3::from_axis_angle(
        &striae::nalgebra::Unit::new_normalize(Vec3::new(1.0, 2.0, -1.0)),
        100_f64.to_radians(),
    );
    let angles = turn.scaled_axis();
    let to = [0.3, -0.2, 0.1, angles.x, angles.y, angles.z].map(Freedom::To);
    (striae::model::tied("handle", body, set), to)
}

/// Stress at a strain of one, as a scale for others.
fn stiffness() -> f64 {
    1e6
}

fn largest_stress(run: &super::scene::Finished) -> f64 {
    let results = run.results();
    let bodies = run.problem.model.bodies.iter();
    let stresses = bodies.flat_map(|body| results.stresses(&body.name).unwrap());
    stresses.map(|stress| stress.norm()).fold(0.0, f64::max) / stiffness()
}

#[test]
fn a_turned_stack_has_no_stress() {
    let (handle, to) = handle("lower", "zmin");
    let turn = step("turn").increments(4).move_rigid("handle", to);
    let run = run(tied(&halves([0.3, -0.2])).rigid(handle).step(turn));
    let stress = largest_stress(&run);
    assert!(stress < 1e-10, "{stress:.2e}");
    let moved = run.results().displacements("upper").unwrap();
    assert!(moved.iter().all(|way| way.norm() > 0.3));
}

/// A ring in a ring, with different divisions around.
fn rings() -> [Annulus; 2] {
    let ring = |inner_radius: f64, outer_radius: f64, around: usize| Annulus {
        inner_radius,
        outer_radius,
        divisions: [2, around, 2],
        ..Annulus::default()
    };
    [ring(0.5, 0.75, 24), ring(0.75, 1.0, 31)]
}

#[test]
fn nodes_of_curved_ties_are_moved_and_then_turn_without_stress() {
    let [inner, outer] = rings().map(|ring| ring.mesh().unwrap());
    let (handle, to) = handle("inner", "rim");
    let turn = step("turn").increments(4).move_rigid("handle", to);
    let model = model("A ring in a ring")
        .body(body("inner", inner, rubber()))
        .body(body("outer", outer, rubber()))
        .rigid(handle)
        .tie(tie(
            "seat",
            surface("inner", "tread"),
            surface("outer", "rim"),
        ))
        .step(turn);
    let run = run(model);
    let moved = run.problem.model.ties[0].moved;
    // The sagitta of the coarser facets bounds the gap.
    let sagitta = 0.75 * (1.0 - (std::f64::consts::PI / 24.0).cos());
    assert!(
        moved > 1e-4 && moved < 2.0 * sagitta,
        "{moved:.3e} {sagitta:.3e}"
    );
    let stress = largest_stress(&run);
    assert!(stress < 1e-10, "{stress:.2e}");
}

/// Norms of the last increment.
#[derive(Default)]
struct Tail(Vec<f64>);

impl Observer for Tail {
    fn iteration(&mut self, number: usize, norms: &Norms, _: &[Evaluation]) {
        if number == 1 {
            self.0.clear();
        }
        self.0.push(norms.largest());
    }
}

#[test]
fn newton_converges_quadratically() {
    let mut tail = Tail::default();
    let model = tied(&halves([0.3, -0.2])).step(pull(0.3).increments(1));
    let simulation = Simulation::new(model.build().unwrap()).unwrap();
    simulation.run_with(&mut tail).unwrap();
    let norms = tail.0;
    let squares = norms
        .windows(2)
        .filter(|pair| pair[0] < 1e-1 && pair[1] > 1e-11);
    let ratios: Vec<f64> = squares.map(|pair| pair[1] / pair[0].powi(2)).collect();
    assert!(
        !ratios.is_empty() && ratios.iter().all(|ratio| *ratio < 10.0),
        "{norms:?}"
    );
    assert!(norms[norms.len() - 1] < 1e-10);
}

#[test]
fn forces_and_moments_balance_after_bending() {
    let bend = step("bend").increments(3).hold("lower", "zmin").displace(
        "upper",
        "zmax",
        [0.4, 0.2, -0.05],
    );
    let report = glue(&run(tied(&halves([0.3, -0.2])).step(bend)));
    assert!(report.sides[0].force.norm() > 1e3);
    assert!(report.mismatch < 1e-10, "{report:?}");
    assert!(report.moment_mismatch < 1e-10, "{report:?}");
}
