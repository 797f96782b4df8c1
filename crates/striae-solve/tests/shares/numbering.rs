//! Numbers of unknowns in the system of all ranks.

use striae_solve::{layout::Layout, problem::Problem, share::Division, team::Together};

use crate::{evaluated::evaluated, scenes::all};

/// Number in the layout of the whole problem of every unknown of a share.
pub fn in_whole(problem: &Problem, layout: &Layout, whole: &Layout) -> Vec<usize> {
    let nodes = problem.reference.len();
    let bodies = problem.share.holding().map_or(nodes, |own| own.whole.nodes);
    let mut numbers = Vec::with_capacity(layout.unknowns());
    for (at, group) in layout.offsets().windows(2).enumerate() {
        let there = match at < nodes {
            true => {
                problem
                    .share
                    .whole_node(striae_model::node::GlobalNode(at))
                    .0
            }
            false => at - nodes + bodies,
        };
        let group_of_whole = whole.offsets()[there]..whole.offsets()[there + 1];
        assert_eq!(group[1] - group[0], group_of_whole.len());
        numbers.extend(group_of_whole);
    }
    numbers
}

#[test]
fn every_unknown_has_one_number_on_all_ranks_and_one_owner() {
    for (name, model) in all() {
        let whole = Problem::new(model.clone()).unwrap();
        let layout = evaluated(&whole, |layout| (0..layout.unknowns()).collect()).layout;
        for ranks in 1..=4 {
            let division = Division::new(&model, ranks).unwrap();
            let found = Together::run(ranks, |team| {
                let problem = Problem::shared(model.clone(), &division, team).unwrap();
                let number = |own: &Layout| in_whole(&problem, own, &layout);
                let own = evaluated(&problem, number).layout;
                (own.numbering(&problem), number(&own))
            });
            // Number in the whole system of the unknowns of the whole layout.
            let mut numbers = vec![None; layout.unknowns()];
            let mut next = 0;
            for (numbering, places) in &found {
                assert_eq!(numbering.count, layout.unknowns(), "{name}");
                assert_eq!(numbering.own.start, next, "{name}");
                next = numbering.own.end;
                for (number, place) in numbering.whole.iter().zip(places) {
                    let known = *numbers[*place].get_or_insert(*number);
                    assert_eq!(known, *number, "{name}");
                }
                let own = numbering.own.clone();
                let held = numbering.whole.iter().filter(|at| own.contains(at)).count();
                assert_eq!(held, own.len(), "a rank holds what it owns in {name}");
            }
            assert_eq!(next, layout.unknowns(), "{name}");
            let mut all: Vec<usize> = numbers.into_iter().map(Option::unwrap).collect();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..layout.unknowns()), "{name}");
        }
    }
}
