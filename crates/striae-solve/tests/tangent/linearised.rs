//! Rows of iterations on the way to the law: of its weakest friction, and with a bound that lags.

use nalgebra::DVector;
use striae_contact::{
    complementarity::{Bound, Iteration, Linearisation},
    pair::Enforcement,
    unknowns::Status,
};
use striae_law::friction::Friction;
use striae_solve::{assembly::StepContext, problem::Problem, state::State};

use crate::{
    pair::{PairFunction, Wanted},
    placed::{of_bodies, two_blocks},
    scene::coulomb,
};

/// Coefficient of friction at rest.
const MU: f64 = 0.5;

/// Calls a function with a pair of two blocks in which nodes open, stick and slip.
fn with_pair(friction: Friction, look: impl Fn(Enforcement, PairFunction, DVector<f64>)) {
    for enforcement in [Enforcement::Weighted, Enforcement::Collocated] {
        let mut model = two_blocks([1.0, 1.0], [3, 3], friction.clone());
        model.pairs[0].enforcement = enforcement;
        let problem = Problem::new(model).unwrap();
        let state = State::undeformed(&problem);
        let context = StepContext::new(&problem, 0, &state);
        let found = (7..40).find_map(|seed| {
            let [start, now] = of_bodies(&problem, seed);
            let pair = PairFunction::new(&context, start, now, 0.5);
            let u = pair.found(Wanted::Mixed)?;
            pair.statuses(&u)
                .contains(&Status::Slip)
                .then_some((pair, u))
        });
        let (pair, u) = found.expect("nodes that slip");
        look(enforcement, pair, u);
    }
}

/// A row of the weakest friction is away from that of the law by as much as it says, and no row is
/// where friction does not fall.
#[test]
fn rows_of_the_weakest_friction_say_how_far_they_are_from_the_law() {
    let falling = coulomb(MU).with_decay(0.4, 0.15).expect("in range");
    for (friction, falls) in [(coulomb(MU), false), (falling, true)] {
        with_pair(friction, |_, mut pair, u| {
            let of_law = pair.evaluation(&u);
            let law = pair.residual(&u);
            pair.before.fill(Status::Stick);
            pair.begun = 1;
            let weakest = pair.evaluation(&u);
            let rows = pair.residual(&u);
            let mut slipping = 0;
            for (kept, [one, other]) in pair.selection.kept().iter().zip(pair.tangential()) {
                let nodes = [&of_law, &weakest].map(|of| of.nodes[kept.side][kept.node]);
                if nodes.map(|node| node.status) != [Status::Slip; 2] {
                    continue;
                }
                slipping += 1;
                let apart = (rows[one] - law[one]).hypot(rows[other] - law[other]);
                let largest = MU * nodes[1].pressure;
                assert_eq!(nodes[0].deviation, 0.0);
                assert!(
                    (nodes[1].deviation - apart).abs() < 1e-12 * largest,
                    "{apart}"
                );
                assert_eq!(nodes[1].deviation > 1e-3 * largest, falls);
                // The weakest friction is 0.4 of that at rest.
                assert!(apart < 0.6 * largest, "{apart} of {largest}");
            }
            assert!(slipping > 0);
        });
    }
}

/// A bound that lags leaves the residual as it is. From the tangent it takes the bound's derivative
/// along the slip, which in Coulomb's law is `mu` by the pressure of a collocated node.
#[test]
fn a_bound_that_lags_leaves_out_its_derivative_by_the_pressure() {
    with_pair(coulomb(MU), |enforcement, mut pair, u| {
        let (residual, whole) = (pair.residual(&u), pair.tangent(&u));
        pair.iteration = Iteration::Later(Linearisation {
            bound: Bound::Lagging,
            ..Linearisation::NEWTON
        });
        assert_eq!(pair.residual(&u), residual);
        let left_out = whole - pair.tangent(&u);
        let statuses = pair.statuses(&u);
        for (status, rows) in statuses.iter().zip(pair.tangential()) {
            let [one, other] = rows.map(|row| left_out.row(row));
            let norm = one.norm().hypot(other.norm());
            if *status != Status::Slip {
                assert_eq!(norm, 0.0);
                continue;
            }
            // Both rows have the same derivatives, by the components of the direction.
            let product = one.norm() * other.norm();
            assert!((one.dot(&other).abs() - product).abs() < 1e-12 * norm.powi(2));
            match enforcement {
                Enforcement::Collocated => assert!((norm - MU).abs() < 1e-12, "{norm}"),
                Enforcement::Weighted => assert!(norm > 0.0),
            }
        }
    });
}
