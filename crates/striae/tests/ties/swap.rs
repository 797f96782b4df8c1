//! Sides, bodies and threads change nothing.

use striae::prelude::*;

use super::scene::{distance, glue, halves, rubber, run, tie};

/// A twisted and bent stack, told in one of several orders.
fn stack(swapped: bool, reversed: bool, divisions: [usize; 3]) -> super::scene::Finished {
    let [lower, mut upper] = halves([0.1, 0.2]);
    upper.divisions = divisions;
    upper.mesh_rotation = 10.0;
    let [lower, upper] = [("lower", lower), ("upper", upper)]
        .map(|(name, block)| body(name, block.mesh().unwrap(), rubber()));
    let (a, b) = (surface("lower", "zmax"), surface("upper", "zmin"));
    let glue = if swapped {
        tie("glue", b, a)
    } else {
        tie("glue", a, b)
    };
    let bodies = if reversed {
        [upper, lower]
    } else {
        [lower, upper]
    };
    let bend = step("bend").increments(2).hold("lower", "zmin").displace(
        "upper",
        "zmax",
        [0.2, 0.1, 0.05],
    );
    let model = bodies
        .into_iter()
        .fold(model("stack"), |model, body| model.body(body));
    run(model.tie(glue).step(bend))
}

#[test]
fn neither_the_order_of_sides_nor_that_of_bodies_matters() {
    for divisions in [[3, 3, 2], [4, 4, 2], [6, 5, 2]] {
        let plain = stack(false, false, divisions);
        for (swapped, reversed) in [(true, false), (false, true), (true, true)] {
            let other = stack(swapped, reversed, divisions);
            let far = distance(&plain, &other);
            assert!(far < 1e-10, "{divisions:?}: {far:.2e}");
            let (one, two) = (glue(&plain), glue(&other));
            let on_lower = two.sides[usize::from(swapped)].force;
            let change = (one.sides[0].force - on_lower).norm();
            assert!(change < 1e-10 * on_lower.norm(), "{change:.2e}");
        }
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| stack(false, false, [5, 6, 2]))
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(one.state.positions, three.state.positions);
    assert_eq!(one.history, three.history);
}
