//! Springs at rest, and dashpots without inertia.

use striae::{
    model::{nodes_of, reference_of, spring, spring_along, spring_to_point},
    prelude::*,
};

use super::scene::{free, held, run, weight, with_block};

#[test]
fn springs_in_series_share_their_force() {
    let (k_1, k_2, force) = (3.0, 5.0, 0.7);
    let pull = held("pull")
        .increments(2)
        .move_rigid("a", free(&[0]))
        .drive_rigid("b", free(&[0]), Some(Vec3::x() * force), None);
    let model = with_block("Two springs in series")
        .rigid(weight("a", [1.0, 0.0, 0.0]))
        .rigid(weight("b", [2.0, 0.0, 0.0]))
        .spring(spring_along("first", reference_of("a"), [2.0, 0.0, 0.0]).stiffness(k_1))
        .spring(spring("second", reference_of("b"), reference_of("a")).stiffness(k_2))
        .step(pull);
    let run = run(model);
    let results = run.results();
    let way = |name: &str| results.rigid_body(name).unwrap().displacement.x;
    assert!((way("a") - force / k_1).abs() < 1e-13, "{}", way("a"));
    let expected = force / k_1 + force / k_2;
    assert!((way("b") - expected).abs() < 1e-13, "{}", way("b"));
    for name in ["first", "second"] {
        let report = results.spring(name).unwrap();
        assert!((report.tension - force).abs() < 1e-13);
        assert!((report.force + Vec3::x() * force).norm() < 1e-13);
        let column = run.history.column(&format!("spring.{name}.tension"));
        assert_eq!(column.unwrap()[1], report.tension);
    }
    let energies = run.state.energies;
    let stored = 0.5 * force * expected;
    assert!((energies.strain - stored).abs() < 1e-13);
    assert!((energies.external - stored).abs() < 1e-13);
    assert!(energies.imbalance().abs() < 1e-13);
}

#[test]
fn a_rigid_body_that_a_spring_drags_away_is_named() {
    let pull = spring_along("pull", reference_of("weight"), [1.0, 0.0, 0.0]);
    let model = with_block("A weight that is dragged away")
        .rigid(weight("weight", [1.0, 0.0, 0.0]))
        .spring(pull.stiffness(1e-3).preload(-40.0))
        .step(held("drag").move_rigid("weight", free(&[0])));
    let model = model.build().unwrap();
    let run = Simulation::new(model).unwrap().run().unwrap();
    let said = run.ending.to_string();
    assert!(said.contains("rigid body `weight` flies off"), "{said}");
}

#[test]
fn a_body_stands_on_springs_under_its_nodes() {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(10.0, 0.3).unwrap());
    let (pressure, stiffness) = (0.02, 0.5);
    let load = step("load")
        .increments(2)
        .displace("block", "zmin", [Some(0.0), Some(0.0), None])
        .pressure("block", "zmax", pressure);
    let model = model("A block on a soft bed")
        .body(body("block", Block::default().mesh().unwrap(), rubber))
        .spring(
            spring_along("bed", nodes_of("block", "zmin"), [0.0, 0.0, 1.0]).stiffness(stiffness),
        )
        .step(load);
    let run = run(model);
    let report = run.results().spring("bed").unwrap();
    let top = run.results().displacements("block").unwrap();
    assert!(top.iter().all(|u| u.z < -0.005));
    // The area grows a little, as the block is pressed flat.
    let whole = -report.tension / pressure;
    assert!((1.0..1.01).contains(&whole), "{whole}");
    let sunk = report.tension / (4.0 * stiffness);
    assert!((report.elongation - sunk).abs() < 1e-13);
}

#[test]
fn springs_turn_with_their_ends() {
    let (length, slack, stiffness, force) = (1.0, 0.9, 4.0, 0.5);
    let pull = held("pull").increments(5).drive_rigid(
        "bob",
        free(&[0, 2]),
        Some(Vec3::new(0.3, 0.0, -0.4)),
        None,
    );
    let rod = spring_to_point("rod", reference_of("bob"), [0.0; 3])
        .stiffness(stiffness)
        .free_length(slack);
    let model = with_block("A pendulum that is pulled aside")
        .rigid(weight("bob", [0.0, 0.0, -length]))
        .spring(rod)
        .step(pull);
    let run = run(model);
    let at = run.results().rigid_body("bob").unwrap().displacement - Vec3::z() * length;
    let expected = Vec3::new(0.6, 0.0, -0.8) * (slack + force / stiffness);
    assert!((at - expected).norm() < 1e-9, "{at}");
}

/// Backward Euler's method, exactly: `x_1 = x_0/(1 + k dt/c)`.
#[test]
fn a_dashpot_lets_a_spring_relax() {
    let (stiffness, damping, count) = (3.0, 2.0, 8);
    let mut to = free(&[]);
    to[0] = Freedom::To(0.5);
    let pull = held("pull").increments(1).move_rigid("weight", to);
    let relax = held("relax")
        .increments(count)
        .move_rigid("weight", free(&[0]));
    let beside = spring_along("beside", reference_of("weight"), [1.0, 0.0, 0.0]);
    let model = with_block("A spring beside a dashpot")
        .rigid(weight("weight", [0.0; 3]))
        .spring(beside.stiffness(stiffness).damping(damping))
        .step(pull)
        .step(relax);
    let run = run(model);
    let dt = 1.0 / count as f64;
    let factor = 1.0 / (1.0 + stiffness * dt / damping);
    let found = run.history.column("displacement.weight.x").unwrap();
    for (number, x) in found.iter().enumerate() {
        let expected = 0.5 * factor.powi(number as i32);
        assert!((x - expected).abs() < 1e-12, "{number}: {x} {expected}");
    }
    let lost: f64 = found
        .windows(2)
        .map(|pair| damping * (pair[1] - pair[0]).powi(2) / dt)
        .sum();
    let energies = run.state.energies;
    // The first increment pulls at a rate as well.
    let expected = lost + damping * 0.25;
    assert!((energies.inelastic - expected).abs() < 1e-12);
    assert!(energies.imbalance().abs() < 1e-12);
}

#[test]
fn a_preload_pulls_from_the_start() {
    let model = with_block("A spring that is tight")
        .rigid(weight("weight", [0.0; 3]))
        .spring(
            spring_along("tight", reference_of("weight"), [1.0, 0.0, 0.0])
                .stiffness(2.0)
                .preload(0.3),
        )
        .spring(spring_along("other", reference_of("weight"), [1.0, 0.0, 0.0]).stiffness(4.0))
        .step(
            held("release")
                .increments(1)
                .move_rigid("weight", free(&[0])),
        );
    let run = run(model);
    let way = run.results().rigid_body("weight").unwrap().displacement.x;
    assert!((way + 0.3 / 6.0).abs() < 1e-13);
    assert!((run.results().spring("tight").unwrap().tension - 0.2).abs() < 1e-13);
}
