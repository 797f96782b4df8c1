//! Contents of cavities: pressures, volumes and gases, at rest and in motion.

use striae::{
    mesh::generate::Annulus,
    model::{Backend, CavityContent, Model, Solver, cavity, solver},
    prelude::*,
    sensitivity::parameter,
};

use super::scene::{cube, hollow_cube, run};

const AMBIENT: f64 = 0.4;

fn gas(exponent: f64) -> CavityContent {
    CavityContent::Gas {
        ambient: AMBIENT,
        exponent,
    }
}

#[test]
fn a_cavity_has_its_volume() {
    let model = cube("A cube at rest").step(step("rest").increments(1).hold("cube", "foot"));
    let run = run(model);
    let report = run.results().cavity("hole").unwrap();
    assert!((report.volume - 1.0).abs() < 1e-13);
    assert_eq!(report.pressure, 0.0);
}

/// A prescribed pressure is a load on the faces, with the same answers.
#[test]
fn a_pressure_is_that_of_a_load() {
    let pressure = 0.2;
    let press = || step("press").increments(2).hold("cube", "foot");
    let filled = cube("A cavity under pressure")
        .step(press().fill("hole", CavityContent::Pressure(pressure)));
    let loaded = model("A load on faces")
        .body(hollow_cube())
        .step(press().pressure("cube", "inside", pressure));
    let [filled, loaded] = [filled, loaded].map(run);
    assert_eq!(filled.results().cavity("hole").unwrap().pressure, pressure);
    let [one, other] = [&filled, &loaded].map(|run| run.results().positions("cube").unwrap());
    let apart = one.iter().zip(other).map(|(a, b)| (a - b).norm());
    assert!(apart.fold(0.0, f64::max) < 1e-10);
    let [one, other] = [&filled, &loaded].map(|run| run.state.energies.external);
    assert!((one - other).abs() < 1e-10 * one);
}

/// Volume and pressure are conjugate: the pressure that a volume takes leads to this volume.
#[test]
fn a_volume_is_that_of_its_pressure() {
    let press = || step("press").increments(2).hold("cube", "foot");
    let by_volume = cube("A volume").step(press().fill("hole", CavityContent::Volume(1.3)));
    let by_volume = run(by_volume);
    let found = by_volume.results().cavity("hole").unwrap();
    assert!((found.volume - 1.3).abs() < 1e-11 && found.pressure > 0.0);
    let by_pressure = cube("A pressure");
    let content = CavityContent::Pressure(found.pressure);
    let again = run(by_pressure.step(press().fill("hole", content)));
    let again = again.results().cavity("hole").unwrap();
    assert!((again.volume - 1.3).abs() < 1e-9, "{}", again.volume);
}

#[test]
fn all_solvers_find_the_same_pressure() {
    let backends = [
        Backend::Condensed,
        Backend::Multifrontal,
        Backend::Faer,
        Backend::Iterative,
    ];
    let found = backends.map(|backend| {
        let press = step("press").increments(2).hold("cube", "foot");
        let model = cube("A volume").step(press.fill("hole", CavityContent::Volume(1.3)));
        let run = run(model.solver(Solver {
            backend,
            ..solver()
        }));
        run.results().cavity("hole").unwrap().pressure
    });
    let apart = found.map(|pressure| (pressure / found[0] - 1.0).abs());
    assert!(apart.iter().all(|apart| *apart < 1e-7), "{found:?}");
}

#[test]
fn a_gas_keeps_its_law_while_the_cube_is_squeezed() {
    for exponent in [1.0, 1.4] {
        let fill = step("fill")
            .increments(2)
            .hold("cube", "foot")
            .fill("hole", CavityContent::Pressure(0.1));
        let seal = step("seal").increments(2).fill("hole", gas(exponent));
        let squeeze =
            step("squeeze")
                .increments(4)
                .displace("cube", "top", [None, None, Some(-0.6)]);
        let model = cube("A sealed cube").step(fill).step(seal).step(squeeze);
        let run = run(model);
        let column = |name: &str| run.history.column(&format!("cavity.hole.{name}")).unwrap();
        let states: Vec<(f64, f64)> = column("pressure")
            .into_iter()
            .zip(column("volume"))
            .collect();
        let amount = |(p, v): (f64, f64)| (AMBIENT + p) * v.powf(exponent);
        let sealed = amount(states[1]);
        for state in &states[1..] {
            assert!((amount(*state) / sealed - 1.0).abs() < 1e-10, "{state:?}");
        }
        let last = states[states.len() - 1];
        assert!(
            last.1 < 0.98 * states[1].1 && last.0 > states[1].0,
            "{states:?}"
        );
        assert!(run.state.energies.imbalance().abs() < 1e-9);
    }
}

#[test]
fn a_gas_swings_with_its_walls() {
    let swing = step("swing")
        .dynamic(0.9)
        .duration(2.0)
        .increments(20)
        .hold("cube", "foot")
        .velocity("cube", [0.0, 0.0, 0.1])
        .fill("hole", gas(1.4));
    let run = run(cube("A cube that swings").step(swing));
    let column = |name: &str| run.history.column(&format!("cavity.hole.{name}")).unwrap();
    let amounts = column("pressure").into_iter().zip(column("volume"));
    for (p, v) in amounts {
        assert!(((AMBIENT + p) * v.powf(1.4) / AMBIENT - 1.0).abs() < 1e-9);
    }
    let energies = run.state.energies;
    assert!(energies.imbalance().abs() < 1e-9, "{energies:?}");
}

/// A slice of a tube between two planes, and a quarter of it, have parts of one volume at the same
/// pressure.
#[test]
fn parts_of_a_tube_have_parts_of_its_volume() {
    let ring = Annulus {
        inner_radius: 0.5,
        outer_radius: 0.8,
        width: 0.4,
        divisions: [2, 16, 1],
        ..Annulus::default()
    };
    let tube = body("tube", ring.mesh().unwrap(), super::scene::rubber(1.0, 0.3))
        .nodes_where("ends", |x| x.y.abs() > 0.19)
        .nodes_where("x", |x| x.x.abs() < 1e-9)
        .nodes_where("z", |x| x.z.abs() < 1e-9);
    let inflate = step("inflate")
        .increments(2)
        .displace("tube", "ends", [None, Some(0.0), None])
        .displace("tube", "x", [Some(0.0), None, None])
        .displace("tube", "z", [None, None, Some(0.0)])
        .fill("inside", CavityContent::VolumeRatio(1.4));
    let model = model("A tube")
        .body(tube)
        .cavity(cavity("inside", "tube", "rim"))
        .step(inflate);
    let run = run(model);
    let polygon = 8.0 * (std::f64::consts::TAU / 16.0).sin() * 0.25;
    let rest = run.problem.cavities[0].volume;
    assert!((rest - 0.4 * polygon).abs() < 1e-12, "{rest}");
    let report = run.results().cavity("inside").unwrap();
    assert!((report.volume - 1.4 * rest).abs() < 1e-11);
    // By the motion of the nodes, which stay on circles.
    let positions = run.results().positions("tube").unwrap();
    let radii = positions.iter().map(|x| x.xz().norm());
    let inner = radii.fold(f64::INFINITY, f64::min);
    assert!(((inner / 0.5).powi(2) - 1.4).abs() < 1e-8, "{inner}");
}

/// Pressure in a cavity moves the body, so that no warning says that it never meets a lid.
#[test]
fn a_cavity_presses_its_body_onto_a_lid() {
    let press = step("press")
        .increments(4)
        .hold("cube", "foot")
        .fill("hole", CavityContent::Pressure(0.2));
    let top = hollow_cube().facets_where("top", |x| x.z > 2.99);
    let model = model("Below a lid")
        .body(top)
        .cavity(cavity("hole", "cube", "inside"))
        .rigid(plane("lid", [0.0, 0.0, 3.001], [0.0, 0.0, -1.0]))
        .pair(pair("stop", surface("cube", "top"), rigid("lid")))
        .step(press);
    let run = run(model);
    assert!(run.results().pair("stop").unwrap().sides[0].force.z < 0.0);
    let warnings = &run.summary.warnings;
    assert!(warnings.is_empty(), "{warnings:?}");
}

/// A shift of a body as a whole changes the pressure in it by round-off, of which there is nothing
/// to warn.
#[test]
fn pressures_that_change_by_round_off_are_not_uncertain() {
    let shifted = |x: f64| -> Result<Model, Error> {
        let fill = step("fill")
            .increments(1)
            .displace("cube", "foot", [x, 0.0, 0.0])
            .fill("hole", CavityContent::Pressure(1e-3));
        let seal = step("seal").increments(2).fill("hole", gas(1.0));
        Ok(cube("A shifted cube").step(fill).step(seal).build()?)
    };
    let simulation = Simulation::new(shifted(0.0).unwrap()).unwrap();
    let by = parameter("shift", 0.0, shifted).unwrap();
    let run = simulation.differentiated(by).run().unwrap();
    let warnings = run.summary.warnings.iter().map(|of| &of.text);
    assert_eq!(warnings.collect::<Vec<_>>(), [""; 0]);
}
