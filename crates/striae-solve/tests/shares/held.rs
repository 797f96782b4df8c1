//! Shares of ranks, compared with the whole.

use std::collections::BTreeMap;

use striae_contact::side::Side;
use striae_element::ElementError;
use striae_mesh::{ElementId, Mesh, NodeId};
use striae_model::{Model, node::GlobalNode};
use striae_solve::{
    problem::{Problem, ProblemError},
    share::{Division, Holding},
    team::Together,
};

use crate::scenes::{all, blocks};

/// The problems of all ranks.
pub fn shared(model: &Model, ranks: usize) -> Vec<Problem> {
    let division = Division::new(model, ranks).unwrap();
    Together::run(ranks, |team| {
        Problem::shared(model.clone(), &division, team).unwrap()
    })
}

fn holding(problem: &Problem) -> &Holding {
    problem.share.holding().unwrap()
}

#[test]
fn elements_are_on_one_rank_each_as_they_are_in_the_whole() {
    for (name, model) in all() {
        let whole = Problem::new(model.clone()).unwrap();
        let mut found: BTreeMap<(usize, ElementId), usize> = BTreeMap::new();
        for problem in shared(&model, 3) {
            for (body, own) in problem.model.bodies.iter().enumerate() {
                let all: &Mesh = &whole.model.bodies[body].mesh;
                for (at, corners) in own.mesh.elements().enumerate() {
                    let local = ElementId::new(at);
                    let element = problem.share.whole_element(body, local);
                    assert_eq!(problem.share.local_element(body, element), Some(local));
                    *found.entry((body, element)).or_default() += 1;
                    let corners = corners.iter();
                    let corners = corners.map(|node| problem.share.whole_mesh_node(body, *node));
                    let expected = all.corners(element).iter().copied();
                    assert!(corners.eq(expected), "{name}");
                    assert_eq!(own.mesh.kind(local), all.kind(element));
                    let material = problem.material(body, local).lame_constants();
                    assert_eq!(material, whole.material(body, element).lame_constants());
                    assert_eq!(problem.density(body, local), whole.density(body, element));
                    let masses = [
                        problem.masses[body].of_element(local),
                        whole.masses[body].of_element(element),
                    ];
                    assert_eq!(masses[0], masses[1], "{name}");
                }
            }
        }
        let bodies = whole.model.bodies.iter();
        let count: usize = bodies.map(|body| body.mesh.element_count()).sum();
        assert_eq!(found.len(), count, "{name}");
        assert!(found.values().all(|count| *count == 1), "{name}");
    }
}

#[test]
fn nodes_are_those_of_the_whole_in_its_order() {
    for (name, model) in all() {
        let whole = Problem::new(model.clone()).unwrap();
        let mut owners = vec![0; whole.reference.len()];
        let problems = shared(&model, 4);
        for (rank, problem) in problems.iter().enumerate() {
            let holding = holding(problem);
            assert!(holding.nodes.is_sorted(), "{name}");
            assert_eq!(holding.nodes.len(), problem.reference.len());
            assert_eq!(holding.whole.nodes, whole.reference.len());
            assert_eq!(problem.size(), whole.size(), "{name}");
            for node in problem.global_nodes() {
                let there = problem.share.whole_node(node);
                assert_eq!(problem.reference[node], whole.reference[there], "{name}");
                assert_eq!(problem.tie_of[node], whole.tie_of[there]);
                assert_eq!(problem.massless[node], whole.massless[there]);
                owners[there] += usize::from(problem.share.owns(node));
            }
            let there = |node: &GlobalNode| problem.share.whole_node(*node);
            let tied = problem.tied.iter();
            let tied = tied.map(|nodes| nodes.iter().map(there).collect::<Vec<_>>());
            assert!(tied.eq(whole.tied.iter().cloned()), "{name}");
            for (other, nodes) in holding.common.iter().enumerate() {
                let others: &Holding = self::holding(&problems[other]);
                let own = nodes.iter().map(|node| holding.nodes[*node]);
                let theirs = others.common[rank].iter();
                assert!(own.eq(theirs.map(|node| others.nodes[*node])), "{name}");
            }
            let replicated = |holding: &Holding| {
                let nodes = holding.replicated.iter();
                nodes.map(|node| holding.nodes[*node]).collect::<Vec<_>>()
            };
            let first = self::holding(&problems[0]);
            assert_eq!(replicated(holding), replicated(first), "{name}");
            assert_eq!(holding.owned, first.owned);
        }
        assert!(owners.iter().all(|count| *count == 1), "{name}");
    }
}

#[test]
fn pairs_and_ties_are_the_same_on_all_ranks() {
    for (name, model) in all() {
        let whole = Problem::new(model.clone()).unwrap();
        for problem in shared(&model, 3) {
            let there = |body: usize, node: NodeId| problem.share.whole_mesh_node(body, node);
            for (own, of_whole) in problem.pairs.iter().zip(&whole.pairs) {
                for side in Side::BOTH {
                    let surfaces = [own, of_whole].map(|pair| &pair.contact.sides[side]);
                    assert_eq!(surfaces[0].stiffness, surfaces[1].stiffness, "{name}");
                    let (Some(body), [Some(a), Some(b)]) =
                        (own.bodies[side], surfaces.map(|side| side.surface()))
                    else {
                        continue;
                    };
                    assert_eq!(a.facets(), b.facets(), "{name}");
                    let nodes = a.nodes().iter().map(|node| there(body, *node));
                    assert!(nodes.eq(b.nodes().iter().copied()), "{name}");
                    for (own, of_whole) in own.fibres[side].iter().zip(&of_whole.fibres[side]) {
                        let own = own.map(|fibre| fibre.nodes.map(|node| there(body, node)));
                        assert_eq!(own, of_whole.map(|fibre| fibre.nodes), "{name}");
                    }
                }
            }
            assert_eq!(problem.shadowed, whole.shadowed);
            for tie in 0..whole.ties.joints.len() {
                let [own, of_whole] = [&problem, &whole].map(|of| &of.ties.joints[tie]);
                assert_eq!(own.area, of_whole.area);
                for side in Side::BOTH {
                    let body = own.bodies[side];
                    let surfaces = [&problem, &whole].map(|of| of.ties.surface(tie, side));
                    let nodes = surfaces[0].nodes().iter().map(|node| there(body, *node));
                    assert!(nodes.eq(surfaces[1].nodes().iter().copied()), "{name}");
                }
            }
        }
    }
}

#[test]
fn sets_and_conditions_add_up_to_those_of_the_whole() {
    for (name, model) in all() {
        let problems = shared(&model, 3);
        for (body, whole) in model.bodies.iter().enumerate() {
            for (set, faces) in whole.mesh.facet_sets.iter() {
                let of_rank = problems.iter().map(|problem| {
                    let sets = &problem.model.bodies[body].mesh.facet_sets;
                    sets.get(set).map_or(0, <[_]>::len)
                });
                assert_eq!(of_rank.sum::<usize>(), faces.len(), "{name}: {set}");
            }
            for (set, nodes) in whole.mesh.node_sets.iter() {
                let owned = problems.iter().map(|problem| {
                    let members = problem.model.bodies[body].mesh.node_sets.get(set);
                    let members = members.unwrap_or_default().iter();
                    let owns = |node: &&NodeId| problem.share.owns(problem.node(body, **node));
                    members.filter(owns).count()
                });
                assert_eq!(owned.sum::<usize>(), nodes.len(), "{name}: {set}");
            }
        }
        let whole = Problem::new(model.clone()).unwrap();
        for key in whole.plans[0].displacements.keys() {
            let (body, node, axis) = *key;
            for problem in &problems {
                let local = problem.share.local_mesh_node(body, NodeId::new(node));
                let known = local.map(|local| (body, local.index(), axis));
                let plan = &problem.plans[0].displacements;
                assert!(known.is_none_or(|key| plan.contains_key(&key)), "{name}");
            }
        }
    }
}

#[test]
fn the_first_degenerate_element_is_told_to_all() {
    let mut model = blocks(striae_contact::pair::Enforcement::Weighted);
    let mesh = &mut model.bodies[1].mesh;
    let [low, high] = [20, 60].map(|at| mesh.corners(ElementId::new(at)).to_vec());
    for corners in [low, high] {
        // Flat elements.
        mesh.positions[corners[3].index()] = mesh.positions[corners[0].index()];
    }
    let whole = Problem::new(model.clone()).map(|_| ()).unwrap_err();
    assert!(matches!(
        &whole,
        ProblemError::Element { fault, .. } if matches!(fault.error, ElementError::Degenerate { .. })
    ));
    let division = Division::new(&model, 3).unwrap();
    let told = Together::run(3, |team| {
        let made = Problem::shared(model.clone(), &division, team);
        made.map(|_| ()).unwrap_err()
    });
    assert!(told.iter().all(|error| *error == whole), "{told:?}");
}
