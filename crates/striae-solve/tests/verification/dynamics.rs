//! Time integration: order, conserved quantities, balance of energy.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};
use striae_contact::evaluation::Evaluation;
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::Vec3;
use striae_model::{BodyId, ContactMass, Curve, Gravity, Model, Mover, Procedure, Step, Velocity};
use striae_solve::{
    drive::{Continue, Observer, Point, Progress, run},
    dynamics::{Scheme, mass_times, momentum},
    newton::{InStep, Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    report::{bodies, pairs},
    state::State,
    warning::{Judgement, Kind},
};
use striae_verify::fitted_rate;

/// A dynamic step of `duration` in `count` increments.
pub fn moving(duration: f64, count: usize) -> Step {
    let size = 1.0 / count as f64;
    Step {
        duration,
        procedure: Procedure::Dynamic {
            spectral_radius: 0.8,
        },
        increments: increments(size, 0.4 * size),
        ..step()
    }
}

fn launched(velocity: [f64; 3], spin: [f64; 3], about: [f64; 3]) -> Vec<Velocity> {
    vec![Velocity {
        body: Mover::Deformable(BodyId(0)),
        velocity: velocity.into(),
        spin: spin.into(),
        about: about.into(),
    }]
}

/// A beam of rubber with the density 1 and its left end at `x = 0`.
fn beam(youngs_modulus: f64) -> Model {
    let mesh = block([0.0; 3], [2.0, 0.5, 0.5], [4, 1, 1]).mesh().unwrap();
    let mut beam = body("beam", mesh, rubber(youngs_modulus, 0.3));
    beam.density = 1.0;
    model(vec![beam])
}

/// Position of the last node after a beam clamped on its left has been shaken by it.
fn shaken(count: usize) -> Vec3 {
    let mut model = beam(4.0);
    let mut step = moving(1.0, count);
    step.displacements = vec![model.hold("beam", "xmin", [Some(0.0), Some(0.0), Some(0.2)])];
    step.displacements[0].curve = Curve::Smooth;
    step.gravity = Some(Gravity {
        acceleration: Vec3::new(0.0, -0.3, 0.0),
        curve: Curve::Smooth,
    });
    model.steps.push(step);
    let run = Run::completed(model);
    run.positions(0)[run.positions(0).len() - 1]
}

#[test]
fn smooth_motion_converges_with_the_square_of_the_increment() {
    let exact = shaken(640);
    let counts = [40, 80, 160];
    let errors = counts.map(|count| (shaken(count) - exact).norm());
    let rate = fitted_rate(&counts.map(|count| 1.0 / count as f64), &errors);
    assert!((rate - 2.0).abs() < 0.15, "rate {rate}: {errors:?}");
}

#[test]
fn free_flight_conserves_momentum_and_energy() {
    let mut model = beam(10.0);
    let mut step = moving(3.0, 30);
    step.velocities = launched([1.0, -2.0, 0.5], [0.0; 3], [0.0; 3]);
    model.steps.push(step);
    let run = Run::completed(model);
    let (p_0, l_0) = momentum(&run.problem, &run.states[1]);
    assert!((p_0 - Vec3::new(0.5, -1.0, 0.25)).norm() < 1e-12);
    for state in &run.states[1..] {
        let (p, l) = momentum(&run.problem, state);
        assert!(
            (p - p_0).norm() < 1e-11 && (l - l_0).norm() < 1e-10,
            "{p} {l}"
        );
        assert!((state.energies.kinetic - 0.5 * 5.25 * 0.5).abs() < 1e-11);
        assert!(state.energies.strain < 1e-12);
    }
}

/// Angular momentum and total energy of a spinning beam after two turns, over
/// what they were; linear momentum stays exactly.
fn spun(count: usize) -> [f64; 2] {
    let mut model = beam(200.0);
    let turn = std::f64::consts::TAU;
    let mut step = moving(2.0, count);
    step.velocities = launched([0.3, 0.0, 0.0], [0.0, 0.0, turn], [1.0, 0.25, 0.25]);
    model.steps.push(step);
    let run = Run::completed(model);
    let (p_0, l_0) = momentum(&run.problem, &run.states[1]);
    let (p, l) = momentum(&run.problem, run.last());
    assert!((p - p_0).norm() < 1e-10 * l_0.norm(), "{p} {p_0}");
    let energies = run.last().energies;
    let total = energies.kinetic + energies.strain;
    assert!(total <= energies.external, "{energies:?}");
    [
        (l - l_0).norm() / l_0.norm(),
        1.0 - total / energies.external,
    ]
}

#[test]
fn free_rotation_conserves_linear_momentum_and_the_rest_in_the_limit() {
    let [coarse, fine] = [200, 400].map(spun);
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(fine < 0.3 * coarse && fine < 0.02, "{coarse} {fine}");
    }
}

/// A block thrown onto a plane at an angle.
fn thrown(spectral_radius: f64) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [2, 2, 2]).mesh().unwrap();
    let mut falling = body("block", mesh, rubber(100.0, 0.3));
    falling.density = 1.0;
    let mut model = model(vec![falling]);
    let floor = plane([0.0, 0.0, -0.05], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, coulomb(0.3));
    let mut step = moving(0.6, 120);
    step.procedure = Procedure::Dynamic { spectral_radius };
    step.velocities = launched([0.5, 0.2, -1.0], [0.0; 3], [0.0; 3]);
    step.gravity = Some(Gravity {
        acceleration: Vec3::new(0.0, 0.0, -1.0),
        curve: Curve::Constant,
    });
    model.steps.push(step);
    model
}

#[test]
fn impacts_take_energy_out_and_all_work_is_accounted_for() {
    for spectral_radius in [0.8, 0.5] {
        let run = Run::completed(thrown(spectral_radius));
        let scale = run.states[1].energies.external;
        for state in &run.states[1..] {
            assert!(
                state.energies.imbalance().abs() < 1e-8 * scale,
                "{:?}",
                state.energies
            );
        }
        for pair in run.states.windows(2) {
            let [before, after] = [pair[0].energies, pair[1].energies];
            assert!(after.friction >= before.friction);
        }
        let energies = run.last().energies;
        assert!(energies.friction > 0.01 * scale, "{energies:?}");
        let lost = energies.contact + energies.numerical;
        assert!(energies.contact > 0.0 && lost > 0.0, "{energies:?}");
        assert!(energies.contact < 0.3 * scale, "{energies:?}");
        let turned = run.last().velocities.iter().map(|v| v.z).sum::<f64>();
        assert!(turned > 0.0, "the block bounces");
    }
}

/// The momentum that contact and weight bring, as the method weighs them: with
/// `v_1 - v_0 = dt (a_alpha - (1/2 - a_f) (a_1 - a_0))`.
#[test]
fn impulses_of_contact_and_weight_change_the_momentum() {
    let run = Run::completed(thrown(0.8));
    let scheme = Scheme::new(0.8);
    let dt = 0.6 / 120.0;
    let weight = Vec3::new(0.0, 0.0, -0.5);
    let sum = |vectors: &[Vec3]| vectors.iter().sum::<Vec3>();
    let mut largest: f64 = 0.0;
    for pair in run.states[1..].windows(2) {
        let [from, to] = [&pair[0], &pair[1]];
        let jump: Vec<Vec3> = from
            .accelerations
            .iter()
            .zip(&to.accelerations)
            .map(|(a, b)| b - a)
            .collect();
        let jump = sum(&mass_times(&run.problem, &jump)) * (0.5 - scheme.alpha_f);
        let contact = sum(&to.forces.contact);
        let impulse = (contact + weight - jump) * dt;
        let gained = momentum(&run.problem, to).0 - momentum(&run.problem, from).0;
        assert!((gained - impulse).norm() < 1e-10, "{gained} {impulse}");
        largest = largest.max(contact.norm());
    }
    assert!(largest > 1.0, "it touches the plane");
}

/// Energy that the method dissipates from a linear system in an increment, in closed form:
///
/// ```text
/// (1/2 - a_f) (d . df + dt v . M da) + dt^2 (beta - gamma/2) da . M a_alpha
/// ```
fn algorithmic_loss(run: &Run, scheme: &Scheme, dt: f64) -> f64 {
    let dot = |a: &[Vec3], b: &[Vec3]| a.iter().zip(b).map(|(a, b)| a.dot(b)).sum::<f64>();
    let combined = |a: &[Vec3], b: &[Vec3], [s, t]: [f64; 2]| -> Vec<Vec3> {
        a.iter().zip(b).map(|(a, b)| a * s + b * t).collect()
    };
    let jump = |a: &[Vec3], b: &[Vec3]| combined(a, b, [-1.0, 1.0]);
    let increments = run.states[1..].windows(2);
    increments
        .map(|pair| {
            let [from, to] = [&pair[0], &pair[1]];
            let d = jump(&from.positions, &to.positions);
            let forces = jump(&from.forces.internal, &to.forces.internal);
            let da = jump(&from.accelerations, &to.accelerations);
            let v = combined(&from.velocities, &to.velocities, [0.5, 0.5]);
            let weights = [scheme.alpha_m, 1.0 - scheme.alpha_m];
            let a = combined(&from.accelerations, &to.accelerations, weights);
            let inertia = mass_times(&run.problem, &da);
            (0.5 - scheme.alpha_f) * (dot(&d, &forces) + dt * dot(&v, &inertia))
                + dt * dt * (scheme.beta - 0.5 * scheme.gamma) * dot(&inertia, &a)
        })
        .sum()
}

#[test]
fn the_loss_of_a_linear_oscillation_is_that_of_the_method() {
    for radius in [0.9, 0.5, 0.0] {
        let mut model = beam(10.0);
        let constants = LameConstants::from_youngs_modulus(10.0, 0.3).unwrap();
        model.bodies[0].material = Material::linear_elastic(constants);
        let mut step = moving(4.0, 20);
        step.procedure = Procedure::Dynamic {
            spectral_radius: radius,
        };
        step.displacements = vec![model.hold("beam", "xmin", [Some(0.0); 3])];
        step.velocities = launched([0.1, 0.3, -0.2], [0.0; 3], [0.0; 3]);
        model.steps.push(step);
        let run = Run::completed(model);
        let expected = algorithmic_loss(&run, &Scheme::new(radius), 4.0 / 20.0);
        let [first, last] = [&run.states[1], run.last()].map(|state| state.energies);
        let mechanical = [first, last].map(|energies| energies.kinetic + energies.strain);
        let scale = mechanical[0];
        let lost = last.numerical - first.numerical;
        assert!(
            expected > 5e-4 * scale && (lost - expected).abs() < 1e-10 * scale,
            "radius {radius}: {lost} {expected} of {scale}"
        );
        let missing = mechanical[0] - mechanical[1];
        assert!((missing - expected).abs() < 1e-9 * scale, "{missing}");
    }
}

/// A bar that flies lengthwise against a wall.
fn against_a_wall(contact_mass: ContactMass) -> Model {
    let mesh = block([0.0, 0.0, 0.01], [0.1, 0.1, 1.0], [1, 1, 20])
        .mesh()
        .unwrap();
    let mut bar = body("bar", mesh, rubber(1.0, 0.0));
    (bar.density, bar.contact_mass) = (1.0, contact_mass);
    let mut model = model(vec![bar]);
    model.touch_rigid(
        ("bar", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.2),
    );
    let mut step = moving(3.0, 120);
    step.velocities = launched([0.0, 0.0, -0.01], [0.0; 3], [0.0; 3]);
    model.steps.push(step);
    model
}

#[test]
fn contact_nodes_without_mass_calm_the_contact_force_and_change_no_momentum() {
    let scatter = [ContactMass::Consistent, ContactMass::Redistributed].map(|contact_mass| {
        let run = Run::completed(against_a_wall(contact_mass));
        let (linear, _) = momentum(&run.problem, &run.states[1]);
        assert!(
            (linear - Vec3::new(0.0, 0.0, -1e-4)).norm() < 1e-15,
            "{linear}"
        );
        let held: Vec<f64> = run
            .states
            .iter()
            .filter(|state| (1.25..1.9).contains(&state.time))
            .map(|state| pairs(&run.problem, state)[0].sides[0].pressure)
            .collect();
        let mean = held.iter().sum::<f64>() / held.len() as f64;
        // rho c v A, c = 1.
        assert!((mean / 1e-4 - 1.0).abs() < 0.02, "{mean}");
        held.iter()
            .map(|force| (force / mean - 1.0).abs())
            .fold(0.0, f64::max)
    });
    assert!(scatter[1] < 0.5 * scatter[0], "{scatter:?}");
}

#[test]
fn time_integration_takes_energy_and_gives_none_in_an_impact() {
    for contact_mass in [ContactMass::Consistent, ContactMass::Redistributed] {
        for spectral_radius in [0.3, 0.8, 1.0] {
            let mut model = against_a_wall(contact_mass);
            model.steps[0].procedure = Procedure::Dynamic { spectral_radius };
            let run = Run::completed(model);
            let energy = run.states[1].energies.kinetic;
            let mut largest = 0.0_f64;
            for state in &run.states[1..] {
                let numerical = state.energies.numerical;
                assert!(
                    numerical > -2e-3 * energy,
                    "{spectral_radius} {numerical:e} of {energy:e} at {}",
                    state.time
                );
                largest = largest.max(numerical);
                // Of a mass of 0.01, also where nodes without mass are not damped.
                let velocity = bodies(&run.problem, state)[0].velocity;
                let (linear, _) = momentum(&run.problem, state);
                assert!((velocity - linear / 0.01).norm() < 1e-12, "{velocity}");
            }
            assert!(run.last().energies.imbalance().abs() < 1e-9 * energy);
            println!("{spectral_radius} {:?}", run.last().energies);
        }
    }
}

#[test]
fn a_linear_elastic_body_that_turns_is_warned_of() {
    for (angle, warned) in [(0.05, false), (0.3, true)] {
        let mut model = beam(10.0);
        let constants = LameConstants::from_youngs_modulus(10.0, 0.3).unwrap();
        model.bodies[0].material = Material::linear_elastic(constants);
        let run = Run::of(model);
        let problem = &run.problem;
        let before = State::undeformed(problem);
        let mut after = before.clone();
        (after.time, after.energies.external) = (1.0, 0.0);
        let turn = nalgebra::Rotation3::new(Vec3::z() * angle);
        after.positions.iter_mut().for_each(|x| *x = turn * *x);
        let mut judgement = Judgement::default();
        judgement.increment(problem, &before, &after, InStep::up_to(0, 1.0));
        let warnings = judgement.warnings(problem, &run.ending);
        let found = warnings
            .iter()
            .find(|warning| warning.kind == Kind::Rotation);
        assert_eq!(found.is_some(), warned, "{warnings:?}");
        assert!(found.is_none_or(|found| (found.value - angle).abs() < 1e-9));
    }
}

/// For each increment but the first, whether the next one starts from a parabola.
#[derive(Default)]
struct Starts(Vec<bool>);

impl IterationObserver for Starts {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Starts {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, _: Progress, _: &Increment) -> Continue {
        Continue::Keep
    }

    fn cut_back(&mut self, _: Progress, reason: &CutBack) -> Continue {
        panic!("{reason}")
    }

    fn point(&mut self, point: Point) {
        let course = point.memory.course.expect("an increment has been made");
        self.0.push(course.before.is_some());
    }
}

#[test]
fn increments_start_from_a_parabola_in_statics_and_from_a_line_with_inertia() {
    for (procedure, expected) in [
        (Procedure::QuasiStatic, [false, true, true, true]),
        (
            Procedure::Dynamic {
                spectral_radius: 0.8,
            },
            [false; 4],
        ),
    ] {
        let mut model = beam(4.0);
        let mut step = moving(1.0, 4);
        step.procedure = procedure;
        step.displacements = vec![model.hold("beam", "xmin", [Some(0.0), Some(0.0), Some(0.1)])];
        step.displacements[0].curve = Curve::Smooth;
        model.steps.push(step);
        let problem = Problem::new(model).unwrap();
        let mut starts = Starts::default();
        let (_, ending) = run(&problem, State::undeformed(&problem), &mut starts);
        assert_eq!(ending, Ending::Completed);
        assert_eq!(starts.0, expected, "{procedure:?}");
    }
}
