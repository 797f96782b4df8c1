//! Tied bodies in motion: energy, momentum, and runs that are taken up again.

use striae::{
    mesh::generate::Block,
    model::{ModelBuilder, StepBuilder},
    prelude::*,
    solve::dynamics::momentum,
};

use super::scene::{halves, run, tied};

fn free(step: StepBuilder) -> ModelBuilder {
    let [lower, mut upper] = halves([0.2, 0.1]);
    upper.divisions = [3, 2, 1];
    let lower = Block {
        divisions: [4, 3, 1],
        ..lower
    };
    tied(&[lower, upper]).step(step)
}

fn spin() -> StepBuilder {
    let (spin, about) = ([3.0, 2.0, 5.0], [0.5, 0.5, 0.5]);
    step("fly")
        .dynamic(1.0)
        .duration(0.05)
        .increments(25)
        .velocity("lower", [1.0, 0.0, 2.0])
        .spinning(spin, about)
        .velocity("upper", [1.0, 0.0, 2.0])
        .spinning(spin, about)
}

#[test]
fn a_free_stack_keeps_its_momentum_and_its_energy_is_found() {
    let run = run(free(spin()));
    let (problem, state) = (&run.problem, &run.state);
    let (linear, angular) = momentum(problem, state);
    assert!(
        (linear - Vec3::new(1000.0, 0.0, 2000.0)).norm() < 1e-8 * 2000.0,
        "{linear}"
    );
    let first = run.history.column("angular_momentum.z").unwrap()[0];
    assert!(
        (angular.z - first).abs() < 1e-3 * angular.norm(),
        "{} {first}",
        angular.z
    );
    let energies = &state.energies;
    assert!(
        energies.imbalance().abs() < 1e-8 * energies.kinetic,
        "{energies:?}"
    );
    assert!(
        energies.numerical.abs() < 1e-2 * energies.kinetic,
        "{energies:?}"
    );
}

#[test]
fn a_driven_stack_finds_all_energy() {
    let shake = step("shake")
        .dynamic(0.8)
        .duration(0.02)
        .increments(20)
        .hold("lower", "zmin")
        .displace("upper", "zmax", [0.05, 0.02, -0.02])
        .along(Curve::Smooth);
    let run = run(free(shake));
    let energies = &run.state.energies;
    assert!(energies.strain > 100.0);
    assert!(
        energies.imbalance().abs() < 1e-8 * energies.external.abs(),
        "{energies:?}"
    );
}

#[test]
fn a_run_that_is_taken_up_gives_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let deck = folder.path().join("deck.toml");
    std::fs::write(&deck, DECK).unwrap();
    let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
    Simulation::open(&deck, &whole).unwrap().run().unwrap();
    let interrupt = Interrupt::default();
    interrupt.set();
    let first = Simulation::open(&deck, &parts).unwrap().until(&interrupt);
    assert!(matches!(
        first.run().unwrap().ending,
        Ending::Interrupted { .. }
    ));
    let rest = Simulation::resume(&parts).unwrap().run().unwrap();
    assert_eq!(rest.ending, Ending::Completed);
    for file in [
        "history.csv",
        "ties.pvd",
        "fields/tie-seat-inner-00007.vtu",
        "fields/tie-seat-outer-00003.vtu",
    ] {
        let [one, other] = [&whole, &parts].map(|run| std::fs::read(run.join(file)).unwrap());
        assert!(one == other, "{file}");
    }
}

const DECK: &str = r#"
title = "Two rings of different facets"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3
density = 1000
[[body]]
name = "inner"
material = "rubber"
mesh = { generator = "annulus", inner_radius = 0.5, outer_radius = 0.75, width = 0.4, divisions = [1, 12, 1] }
[[body]]
name = "outer"
material = "rubber"
mesh = { generator = "annulus", inner_radius = 0.75, outer_radius = 1, width = 0.4, divisions = [1, 17, 1] }
[[tie]]
name = "seat"
a = { body = "inner", facets = "tread" }
b = { body = "outer", facets = "rim" }
[[step]]
name = "press"
increments = 3
displacement = [{ body = "inner", nodes = "rim", x = 0, y = 0, z = 0 }]
pressure = [{ body = "outer", facets = "tread", value = 1e4 }]
[[step]]
name = "shake"
dynamics = {}
duration = 0.01
increments = 4
displacement = [{ body = "inner", nodes = "rim", x = 0.02 }]
"#;
