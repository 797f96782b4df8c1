//! Division of elements among ranks, and ownership of nodes.

use striae_solve::{share::Division, team::Together};

use crate::scenes::all;

#[test]
fn every_element_has_a_rank_and_every_node_an_owner_with_an_element_of_it() {
    for (name, model) in all() {
        for ranks in 1..=4 {
            let division = Division::new(&model, ranks).unwrap();
            assert_eq!(division, Division::new(&model, ranks).unwrap(), "{name}");
            let mut holders = vec![Vec::new(); division.owners().len()];
            let mut first = 0;
            for (body, ranks) in model.bodies.iter().zip(division.elements()) {
                for (corners, rank) in body.mesh.elements().zip(ranks) {
                    let nodes = corners.iter().map(|node| first + node.index());
                    nodes.for_each(|node| holders[node].push(*rank));
                }
                first += body.mesh.positions.len();
            }
            for (owner, holders) in division.owners().iter().zip(&holders) {
                assert!(holders.contains(owner), "{name}");
            }
        }
    }
}

#[test]
fn ranks_have_about_the_same() {
    let (_, model) = all().swap_remove(0);
    for ranks in 2..=4 {
        let division = Division::new(&model, ranks).unwrap();
        let owned = |rank: usize| {
            let owners = division.owners().iter();
            owners.filter(|owner| **owner as usize == rank).count()
        };
        // METIS keeps to 3 % of weights; of nodes at borders, of which there are many here, each
        // is one rank's.
        let fair = division.owners().len() as f64 / ranks as f64;
        for rank in 0..ranks {
            let share = owned(rank) as f64 / fair;
            assert!((0.85..1.15).contains(&share), "{share} of rank {rank}");
        }
    }
}

#[test]
fn all_ranks_know_the_division_of_the_first() {
    let (_, model) = all().swap_remove(2);
    let division = Division::new(&model, 3).unwrap();
    let agreed = Together::run(3, |team| Division::agreed(&model, &*team).unwrap());
    assert!(agreed.iter().all(|of_rank| *of_rank == division));
}

#[test]
fn there_may_be_more_ranks_than_elements() {
    let mut model = crate::scene::model(vec![crate::scene::body(
        "block",
        crate::scene::block([0.0; 3], [1.0; 3], [2, 1, 1])
            .mesh()
            .unwrap(),
        crate::scene::rubber(1.0, 0.3),
    )]);
    model.steps = vec![crate::scene::step()];
    let division = Division::new(&model, 5).unwrap();
    assert_eq!(division.elements(), [[0, 1]]);
    let problems = Together::run(5, |team| {
        striae_solve::problem::Problem::shared(model.clone(), &division, team)
            .map(|problem| problem.reference.len())
    });
    let counts: Vec<usize> = problems.into_iter().map(Result::unwrap).collect();
    assert_eq!(counts, [8, 8, 0, 0, 0]);
}
