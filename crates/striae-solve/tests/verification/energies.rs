//! Balance of energy and sign of dissipation.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};
use striae_model::{Curve, Model};
use striae_solve::state::Energies;
use striae_verify::fitted_rate;

/// A block on a plane, pressed, slid to and fro in so many increments a step.
fn to_and_fro(count: usize) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [2, 2, 1]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.3),
    );
    for target in [[0.0, 0.0, -0.03], [0.1, 0.05, -0.03], [-0.1, 0.0, -0.04]] {
        let mut step = step();
        step.increments = increments(1.0 / count as f64, 0.4 / count as f64);
        step.displacements = vec![model.hold("block", "zmax", target.map(Some))];
        step.displacements[0].curve = Curve::Smooth;
        model.steps.push(step);
    }
    model
}

/// Two blocks, one sliding over the other.
fn two_blocks(count: usize) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 1]).mesh().unwrap();
    let upper = block([0.2, 0.2, 0.5], [0.6, 0.6, 0.5], [2, 2, 1])
        .mesh()
        .unwrap();
    let mut model = model(vec![
        body("lower", lower, rubber(3.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.3));
    for target in [[0.0, 0.0, -0.03], [0.05, 0.02, -0.03]] {
        let mut step = step();
        step.increments = increments(1.0 / count as f64, 0.4 / count as f64);
        step.displacements = vec![
            model.hold("lower", "zmin", [Some(0.0); 3]),
            model.hold("upper", "zmax", target.map(Some)),
        ];
        model.steps.push(step);
    }
    model
}

#[test]
fn friction_dissipates_in_every_increment() {
    for model in [to_and_fro(5), two_blocks(4)] {
        let run = Run::completed(model);
        let dissipated: Vec<f64> = run.states.iter().map(|s| s.pairs[0].dissipated).collect();
        assert!(
            dissipated.windows(2).all(|pair| pair[1] >= pair[0]),
            "{dissipated:?}"
        );
        let last = dissipated[dissipated.len() - 1];
        assert!(last > 0.0);
        assert_eq!(run.last().energies.friction, last);
    }
}

#[test]
fn all_external_work_is_accounted_for() {
    for model in [to_and_fro(5), two_blocks(4)] {
        let run = Run::completed(model);
        for state in &run.states {
            let energies = state.energies;
            let off = energies.imbalance().abs();
            assert!(off <= 1e-9 * energies.external, "{energies:?}");
        }
    }
}

/// Energies at the end of sliding to and fro in so many increments a step.
fn spent(count: usize) -> Energies {
    Run::completed(to_and_fro(count)).last().energies
}

#[test]
fn what_is_lost_to_the_increments_falls_with_them() {
    let counts = [5, 10, 20];
    let spent = counts.map(spent);
    let sizes = counts.map(|count| 1.0 / count as f64);
    let rate = |lost: fn(&Energies) -> f64| {
        let lost = spent
            .each_ref()
            .map(|energies| lost(energies).abs() / energies.external);
        (fitted_rate(&sizes, &lost), lost)
    };
    let (numerical, lost) = rate(|energies| energies.numerical);
    assert!(numerical > 1.8, "rate {numerical}: {lost:?}");
    let (contact, lost) = rate(|energies| energies.contact);
    assert!(contact > 0.9, "rate {contact}: {lost:?}");
}

#[test]
fn contact_forces_do_the_work_of_friction() {
    let energies = spent(20);
    assert!(
        energies.contact.abs() < 0.05 * energies.friction,
        "{energies:?}"
    );
}
