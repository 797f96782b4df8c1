//! A balloon that is filled beyond its greatest pressure.
//!
//! An incompressible neo-Hookean sphere with the stretches `a` and `b` of its inner and outer
//! radius has the pressure `p = G (2/b + 1/(2 b^4) - 2/a - 1/(2 a^4))`, from `dp = W'(l)/(l^3 - 1) dl`
//! with `W = G/2 (2 l^2 + l^-4 - 3)`, see Green & Zerna, *Theoretical Elasticity*, 1968, section 3.10.

use striae::{
    model::{CavityContent, cavity},
    prelude::*,
};

use super::scene::{rubber, run, sphere};

const OUTER: f64 = 1.3;
const SHEAR: f64 = 1.0;

/// Pressure at the volume over that at rest.
fn pressure(ratio: f64) -> f64 {
    let inner = ratio.cbrt();
    let outer = (1.0 + (ratio - 1.0) / OUTER.powi(3)).cbrt();
    let part = |l: f64| 2.0 / l + 0.5 / l.powi(4);
    SHEAR * (part(outer) - part(inner))
}

/// Pressures and volume ratios of a run.
fn filled(along: usize, through: usize) -> Vec<[f64; 2]> {
    let poisson = 0.499;
    let balloon = body(
        "balloon",
        sphere(OUTER, along, through),
        rubber(2.0 * (1.0 + poisson) * SHEAR, poisson),
    );
    let balloon = balloon
        .nodes_where("x", |x| x.x.abs() < 1e-9)
        .nodes_where("y", |x| x.y.abs() < 1e-9)
        .nodes_where("z", |x| x.z.abs() < 1e-9)
        .facets_where("inside", |x| x.norm() < 1.0 + 1e-9);
    let inflate = step("inflate")
        .increments(20)
        .displace("balloon", "x", [Some(0.0), None, None])
        .displace("balloon", "y", [None, Some(0.0), None])
        .displace("balloon", "z", [None, None, Some(0.0)])
        .fill("inside", CavityContent::VolumeRatio(9.0));
    let model = model("A balloon")
        .body(balloon)
        .cavity(cavity("inside", "balloon", "inside"))
        .step(inflate);
    let run = run(model);
    let column = |name: &str| {
        run.history
            .column(&format!("cavity.inside.{name}"))
            .unwrap()
    };
    let rest = run.problem.cavities[0].volume;
    let pairs = column("pressure").into_iter().zip(column("volume"));
    assert!(run.state.energies.imbalance().abs() < 1e-8 * run.state.energies.external);
    pairs.map(|(p, v)| [p, v / rest]).collect()
}

#[test]
fn a_balloon_passes_its_greatest_pressure() {
    let error = |along: usize, through: usize| {
        let states = filled(along, through);
        let last = states[states.len() - 1];
        assert!((last[1] - 9.0).abs() < 1e-9);
        let greatest = states.iter().map(|state| state[0]).fold(0.0, f64::max);
        assert!(greatest > 1.1 * last[0], "{greatest} {last:?}");
        let errors = states
            .iter()
            .map(|[p, ratio]| (p / pressure(*ratio) - 1.0).abs());
        errors.fold(0.0, f64::max)
    };
    let errors = [error(3, 2), error(6, 4)];
    // What is left at last is the compressibility.
    assert!(
        errors[1] < 0.02 && errors[0] > 2.5 * errors[1],
        "{errors:?}"
    );
}
