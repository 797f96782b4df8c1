//! Borders of ties: facets beside what is glued are a pair of the same two bodies.

use striae::{mesh::generate::Block, model::ModelBuilder, prelude::*};

use super::scene::{glue, rubber, run, tie, unevenness};

const LIMIT: f64 = 0.5;

/// Two blocks on each other, glued where `x < 1/2`, in contact where `x > 1/2`.
fn half_glued(lower: [usize; 3], upper: [usize; 3], mu: f64) -> ModelBuilder {
    let block = |origin: f64, divisions| {
        let block = Block {
            origin: Vec3::new(0.0, 0.0, origin),
            size: Vec3::new(1.0, 1.0, 0.5),
            divisions,
            ..Block::default()
        };
        block.mesh().unwrap()
    };
    let on_face = |x: &Vec3| (x.z - 0.5).abs() < 1e-9;
    let left = |x: &Vec3| on_face(x) && x.x < LIMIT + 1e-9;
    let right = |x: &Vec3| on_face(x) && x.x > LIMIT - 1e-9;
    let with_sets = |name: &str, origin: f64, divisions: [usize; 3]| {
        body(name, block(origin, divisions), rubber())
            .facets_where("left", left)
            .facets_where("right", right)
    };
    model("Half glued")
        .body(with_sets("lower", 0.0, lower))
        .body(with_sets("upper", 0.5, upper))
        .tie(tie(
            "glue",
            surface("lower", "left"),
            surface("upper", "left"),
        ))
        .pair(
            pair(
                "touch",
                surface("lower", "right"),
                surface("upper", "right"),
            )
            .friction(Friction::coulomb(mu).unwrap()),
        )
}

fn pressed() -> striae::model::StepBuilder {
    let mut press = step("press")
        .increments(2)
        .displace("lower", "zmin", [None, None, Some(0.0)])
        .displace("upper", "zmax", [None, None, Some(-0.02)]);
    for body in ["lower", "upper"] {
        press = press
            .displace(body, "xmin", [Some(0.0), None, None])
            .displace(body, "ymin", [None, Some(0.0), None]);
    }
    press
}

#[test]
fn a_uniform_pressure_passes_what_is_glued_and_what_touches() {
    for (lower, upper) in [
        ([4, 3, 2], [4, 3, 2]),
        ([4, 3, 2], [6, 4, 2]),
        ([8, 4, 2], [4, 3, 2]),
        ([2, 2, 2], [6, 5, 2]),
    ] {
        let run = run(half_glued(lower, upper, 0.3).step(pressed()));
        assert!(unevenness(&run) < 1e-8, "{lower:?} {upper:?}");
        let held = run.results().reaction("upper.zmax").unwrap().z;
        let touching = run.results().pair("touch").unwrap().sides[1].force.z;
        // Half of the load, as half of the face.
        assert!(
            (held + 2.0 * touching).abs() < 1e-7 * held.abs(),
            "{held} {touching}"
        );
        assert!(glue(&run).mismatch < 1e-9);
        let warnings = &run.summary.warnings;
        assert!(warnings.is_empty(), "{warnings:?}");
    }
}

#[test]
fn what_touches_beside_the_glue_slips_under_shear() {
    let drag = step("drag")
        .increments(8)
        .displace("upper", "zmax", [Some(0.08), None, None]);
    let mut press = step("press")
        .increments(2)
        .displace("lower", "zmin", [Some(0.0); 3])
        .displace("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.02)]);
    press = press.displace("lower", "ymin", [None, Some(0.0), None]);
    for divisions in [[4, 3, 2], [6, 4, 2]] {
        let model = half_glued([4, 3, 2], divisions, 0.1);
        let run = run(model.step(press.clone()).step(drag.clone()));
        let touch = run.results().pair("touch").unwrap().clone();
        let [a, _] = &touch.sides;
        let ratio = a.friction / a.pressure;
        assert!((ratio - 0.1).abs() < 1e-6, "{ratio}");
        assert!(touch.slip > 0, "{touch:?}");
        assert!(
            run.summary.warnings.is_empty(),
            "{:?}",
            run.summary.warnings
        );
    }
}
