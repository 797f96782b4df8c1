//! Bodies that remember: viscoelastic rubber and metal that yields.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, step};
use striae_law::bulk::{
    Branch, Hardening, Hyperelastic, Isochoric, LameConstants, Material, Plastic, Viscoelastic,
    Volumetric,
};
use striae_mesh::Vec3;
use striae_model::{Curve, Formulation, LoadExtent, LoadKind, Model};
use striae_solve::state::Energies;
use striae_verify::fitted_rate;

const SHEAR: f64 = 1.0;
const BRANCH: Branch = Branch {
    ratio: 1.5,
    time: 0.5,
};

fn viscoelastic() -> Material {
    let slow = Isochoric::NeoHookean { shear: SHEAR };
    let slow = Hyperelastic::new(slow, 5.0, Volumetric::Logarithmic).unwrap();
    Material::viscoelastic(Viscoelastic::new(slow, &[BRANCH]).unwrap())
}

fn hardening() -> Hardening {
    Hardening::voce(0.5, 0.8, 6.0, 0.4).unwrap()
}

fn metal() -> Material {
    let constants = LameConstants::from_youngs_modulus(100.0, 0.3).unwrap();
    Material::plastic(Plastic::new(constants, hardening()))
}

/// A block on a plane, pressed and slid to and fro in so many increments a step.
fn to_and_fro(material: Material, count: usize) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [2, 2, 1]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, material)]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.3),
    );
    for target in [[0.0, 0.0, -0.05], [0.1, 0.05, -0.05], [-0.1, 0.0, -0.06]] {
        let mut step = step();
        step.increments = increments(1.0 / count as f64, 0.2 / count as f64);
        step.displacements = vec![model.hold("block", "zmax", target.map(Some))];
        model.steps.push(step);
    }
    model
}

/// A cube that slides on three planes of symmetry and is stretched along `z`, by factors
/// at the end of steps of the given durations.
fn stretched(
    material: Material,
    formulation: Formulation,
    stretches: &[(f64, f64)],
    count: usize,
) -> Model {
    let mesh = block([0.0; 3], [1.0; 3], [2, 1, 2]).mesh().unwrap();
    let mut model = model(vec![body("cube", mesh, material)]);
    model.bodies[0].formulation = formulation;
    for &(stretch, duration) in stretches {
        let mut step = step();
        step.duration = duration;
        step.increments = increments(1.0 / count as f64, 0.2 / count as f64);
        step.displacements = vec![
            model.hold("cube", "xmin", [Some(0.0), None, None]),
            model.hold("cube", "ymin", [None, Some(0.0), None]),
            model.hold("cube", "zmin", [None, None, Some(0.0)]),
            model.hold("cube", "zmax", [None, None, Some(stretch - 1.0)]),
        ];
        model.steps.push(step);
    }
    model
}

fn force(run: &Run, state: usize) -> f64 {
    let top = (run.problem.reference.iter().enumerate()).filter(|(_, x)| x.z == 1.0);
    top.map(|(node, _)| run.states[state].forces.reaction[node].z)
        .sum()
}

#[test]
fn all_external_work_is_accounted_for() {
    for material in [viscoelastic(), metal()] {
        let run = Run::completed(to_and_fro(material, 5));
        let mut before = 0.0;
        for state in &run.states {
            let energies = state.energies;
            let off = energies.imbalance().abs();
            assert!(off <= 1e-9 * energies.external, "{energies:?}");
            assert!(energies.inelastic >= before, "{energies:?}");
            before = energies.inelastic;
        }
        let energies = run.last().energies;
        assert!(before > 0.05 * energies.external, "{energies:?}");
        assert!(energies.friction > 0.0, "{energies:?}");
    }
}

#[test]
fn what_is_lost_to_the_increments_falls_with_them() {
    for material in [viscoelastic(), metal()] {
        let counts = [5, 10, 20];
        let lost = counts.map(|count| {
            let Energies {
                numerical,
                external,
                ..
            } = Run::completed(to_and_fro(material.clone(), count))
                .last()
                .energies;
            numerical.abs() / external
        });
        let rate = fitted_rate(&counts.map(|count| 1.0 / count as f64), &lost);
        assert!(rate > 0.9, "{}: {rate} {lost:?}", material.name());
    }
}

#[test]
fn stretched_rubber_relaxes_to_its_slow_law() {
    // Stretched all at once, then held. Sides draw in while stress relaxes, so that it is
    // the increments by which the dissipation differs from the energy that is gone.
    let strain = 1e-4;
    let tension = |shear: f64| 9.0 * 5.0 * shear / (3.0 * 5.0 + shear);
    let [sudden, slow] = [1.0 + BRANCH.ratio, 1.0].map(|ratio| tension(SHEAR * ratio));
    let gone = 0.5 * strain * strain * (sudden - slow);
    let counts = [5, 10, 20];
    let errors = counts.map(|count| {
        let steps = [1e-6, 0.5, 2.0, 20.0].map(|duration| (1.0 + strain, duration));
        let run = Run::completed(stretched(
            viscoelastic(),
            Formulation::Standard,
            &steps,
            count,
        ));
        for (state, expected) in [(count, sudden), (4 * count, slow)] {
            let found = force(&run, state) / strain;
            assert!(
                (found / expected - 1.0).abs() < 2.0 * strain,
                "{found} {expected}"
            );
        }
        let energies = run.last().energies;
        let off = energies.inelastic + energies.numerical - gone;
        assert!(off.abs() < 2.0 * strain * gone, "{energies:?} {gone}");
        (energies.inelastic - gone).abs()
    });
    let rate = fitted_rate(&counts.map(|count| 1.0 / count as f64), &errors);
    assert!(rate > 0.9, "{rate}: {errors:?}");
}

#[test]
fn loaded_rubber_creeps_by_its_compliance() {
    // Under a stress s that comes at once and stays, the strain is s D(t) with
    // D = J/3 + 1/(9 K) and J = (1 - g/(1 + g) exp(-t/((1 + g) t_r)))/G.
    let (stress, lengths) = (1e-5, [1e-9, 0.5, 1.5]);
    let compliance = |time: f64| {
        let slow = BRANCH.ratio / (1.0 + BRANCH.ratio);
        let left = (-time / ((1.0 + BRANCH.ratio) * BRANCH.time)).exp();
        (1.0 - slow * left) / (3.0 * SHEAR) + 1.0 / (9.0 * 5.0)
    };
    let counts = [5, 10, 20];
    let errors = counts.map(|count| {
        let steps = lengths.map(|duration| (1.0, duration));
        let mut model = stretched(viscoelastic(), Formulation::Standard, &steps, count);
        let top = LoadKind::DeadTraction(Vec3::z() * stress);
        let mut load = model.load("cube", "zmax", top, LoadExtent::Whole);
        for step in &mut model.steps {
            step.displacements.pop();
            step.loads = vec![load.clone()];
            // Held at its end from the first step on.
            load.curve = Curve::Constant;
        }
        let run = Run::completed(model);
        let node = run
            .problem
            .reference
            .iter()
            .position(|x| x.z == 1.0)
            .unwrap();
        let ends = [(1, 0.0), (2, 0.5), (3, 2.0)];
        let errors = ends.map(|(end, time)| {
            let strain = run.states[end * count].positions[node].z - 1.0;
            (strain / (stress * compliance(time)) - 1.0).abs()
        });
        assert!(errors[0] < 1e-4, "{errors:?}");
        errors[1].max(errors[2])
    });
    let rate = fitted_rate(&counts.map(|count| 1.0 / count as f64), &errors);
    assert!(rate > 0.9 && errors[2] < 0.01, "{rate}: {errors:?}");
}

#[test]
fn a_bar_yields_and_yields_back_by_its_hardening() {
    for formulation in [Formulation::Standard, Formulation::MeanDilatation] {
        // Stretches of a plastic strain of 0.2, then of 0.3 back.
        let hardening = hardening();
        let [first, second] = [hardening.stress(0.2), hardening.stress(0.5)];
        let stretches = [
            (first / 100.0 + 0.2f64).exp(),
            (-second / 100.0 - 0.1).exp(),
        ];
        let run = Run::completed(stretched(
            metal(),
            formulation,
            &stretches.map(|stretch| (stretch, 1.0)),
            8,
        ));
        let ends: Vec<usize> = (0..run.states.len())
            .filter(|&at| [1.0, 2.0].contains(&run.states[at].time))
            .collect();
        for ((end, stretch), kirchhoff) in ends.iter().zip(stretches).zip([first, -second]) {
            let found = force(&run, *end) * stretch;
            assert!((found - kirchhoff).abs() < 1e-8, "{found} {kirchhoff}");
        }
        let history = &run.last().histories[0];
        let plastic = history.iter().skip(6).step_by(7);
        for strain in plastic {
            assert!((strain - 0.5).abs() < 1e-8, "{strain}");
        }
        let work = hardening.work(0.0, 0.5);
        assert!((run.last().energies.inelastic - work).abs() < 1e-8);
        let most = run.iterations.iter().map(Vec::len).max();
        assert!(most <= Some(7), "{most:?}");
    }
}
