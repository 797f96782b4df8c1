//! Roles from two configurations.

use striae_contact::selection::Selection;
use striae_solve::{assembly::StepContext, problem::Problem, state::State};

use crate::{blocks::model, reference::cases};

/// Without predicted motion, the prediction changes no role, pivot or weight.
#[test]
fn a_prediction_without_motion_changes_nothing() {
    for case in cases() {
        let problem = Problem::new(model(&case, 1e-3)).expect("a model");
        let state = State::undeformed(&problem);
        let context = StepContext::new(&problem, 0, &state);
        let start = context.configuration(0, &state.positions, &state.rigid);
        let of_pair = &state.pairs[0];
        let prescribed = &context.fixed_on_pair[0];
        let chosen = |predicted| Selection::new(&start, predicted, &of_pair.kept, prescribed).basis;
        let (alone, with) = (chosen(None), chosen(Some(&start)));
        assert_eq!(with.kept, alone.kept, "{}", case.name);
        let values = [
            (&with.pivots, &alone.pivots),
            (&with.weights, &alone.weights),
            (&with.flexibility, &alone.flexibility),
        ];
        for (with, alone) in values {
            for (with, alone) in with.iter().zip(alone) {
                assert!((with - alone).abs() < 1e-12 * alone, "{with} {alone}");
            }
        }
    }
}
