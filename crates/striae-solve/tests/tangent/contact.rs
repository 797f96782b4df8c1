//! Tangent of contact with Coulomb's law, in nodes of every status.

use striae_contact::{
    complementarity::Iteration,
    pair::Enforcement,
    table_1::{Corrector, Inflation},
    unknowns::Status,
};
use striae_law::friction::Friction;
use striae_solve::{assembly::StepContext, problem::Problem, state::State};

use crate::{
    pair::{PairFunction, Wanted},
    placed::{dependent, dome, of_bodies, of_pieces, of_rigid, on_rigid, two_blocks, two_pieces},
    scene::{coulomb, plane},
};

const BOTH: [Enforcement; 2] = [Enforcement::Weighted, Enforcement::Collocated];

fn laws() -> [Friction; 3] {
    [
        coulomb(0.5),
        coulomb(0.5).with_decay(0.4, 0.15).expect("in range"),
        dependent(coulomb(0.5)),
    ]
}

/// Moduli and divisions of two bodies: alike, one much stiffer, one much finer.
const PAIRINGS: [([f64; 2], [usize; 2]); 6] = [
    ([1.0, 1.0], [3, 3]),
    ([100.0, 1.0], [3, 3]),
    ([1.0, 100.0], [3, 2]),
    ([1.0, 2.0], [2, 4]),
    ([1.0, 2.0], [4, 2]),
    ([3.0, 1.0], [4, 3]),
];

#[test]
fn of_two_curved_surfaces_that_stick_slip_and_open() {
    let (mut weak, mut corrected) = (0, 0);
    let mut kept = [0; 2];
    for enforcement in BOTH {
        for (moduli, divisions) in PAIRINGS {
            for friction in laws() {
                let mut model = two_blocks(moduli, divisions, friction);
                model.pairs[0].enforcement = enforcement;
                let problem = Problem::new(model).unwrap();
                let state = State::undeformed(&problem);
                let context = StepContext::new(&problem, 0, &state);
                // The first motion under which nodes of every status are found.
                let every = [Status::Open, Status::Stick, Status::Slip];
                let found = (7..40).find_map(|seed| {
                    let [start, now] = of_bodies(&problem, seed);
                    let pair = PairFunction::new(&context, start, now, 0.5);
                    let u = pair.found(Wanted::Mixed)?;
                    let statuses = pair.statuses(&u);
                    let has_all = every.iter().all(|status| statuses.contains(status));
                    has_all.then_some((pair, u))
                });
                let (mut pair, u) = found.expect("nodes of every status");
                let law = context.plan.frictions[0].coefficient();
                let name = format!("{enforcement:?} {moduli:?} {divisions:?}, {law:?}");
                weak += pair.selection.ramp().len();
                for of_pair in pair.selection.kept() {
                    kept[of_pair.side] += 1;
                }
                let statuses = pair.statuses(&u);
                pair.assert_order(&u, &name);
                pair.before = statuses.clone();
                pair.iteration = Iteration::Given;
                assert_eq!(pair.statuses(&u), statuses, "{name}");
                pair.assert_order(&u, &name);
                pair.iteration = Iteration::Corrected(Corrector {
                    stick_tolerance: 0.01,
                    inflation: Inflation::default().after(0.0),
                });
                // Without pressure, stick and slip are the same.
                if pair.statuses(&u) == statuses {
                    pair.assert_order(&u, &name);
                    corrected += 1;
                }
            }
        }
    }
    assert!(corrected > 10, "{corrected} with a corrector");
    assert!(weak > 5, "{weak} weak nodes");
    assert!(kept[0] > 20 && kept[1] > 20, "kept: {kept:?}");
}

#[test]
fn of_a_surface_that_touches_itself() {
    let every = [Status::Open, Status::Stick, Status::Slip];
    for (divisions, wanted, statuses) in [
        ([3, 3], Wanted::Mixed, &every[..]),
        ([4, 3], Wanted::Slip, &every[2..]),
        ([2, 4], Wanted::Slip, &every[2..]),
    ] {
        for friction in laws() {
            let problem = Problem::new(two_pieces(divisions, friction)).unwrap();
            let state = State::undeformed(&problem);
            let context = StepContext::new(&problem, 0, &state);
            let first_of_second = 2 * (divisions[0] + 1).pow(2);
            let found = (7..40).find_map(|seed| {
                let [start, now] = of_pieces(&problem, first_of_second, seed);
                let pair = PairFunction::new(&context, start, now, 0.5);
                let u = pair.found(wanted)?;
                let found = pair.statuses(&u);
                let has_all = statuses.iter().all(|status| found.contains(status));
                has_all.then_some((pair, u))
            });
            let (pair, u) = found.expect("nodes of every status");
            pair.assert_order(&u, &format!("{divisions:?}"));
        }
    }
}

#[test]
fn on_rigid_surfaces() {
    let inclined = plane([0.0, 0.0, 0.01], [0.02, -0.03, 1.0]);
    for enforcement in BOTH {
        for (on, shape, bump) in [
            ("plane", inclined.clone(), 0.02),
            ("quadrilaterals", dome(4), 0.1),
            ("triangles", dome(3), 0.1),
        ] {
            for friction in laws() {
                let mut model = on_rigid(shape.clone());
                model.pairs[0].friction = friction;
                model.pairs[0].enforcement = enforcement;
                let problem = Problem::new(model).unwrap();
                let state = State::undeformed(&problem);
                let context = StepContext::new(&problem, 0, &state);
                let [start, now] = of_rigid(&problem, bump, 11);
                let pair = PairFunction::new(&context, start, now, 0.5);
                let law = context.plan.frictions[0].coefficient();
                let name = format!("{enforcement:?} on {on}, {law:?}");
                let u = pair.state(Wanted::Mixed);
                let statuses = pair.statuses(&u);
                for status in [Status::Open, Status::Stick, Status::Slip] {
                    assert!(statuses.contains(&status), "{name}: no node is {status:?}");
                }
                pair.assert_order(&u, &name);
            }
        }
    }
}
