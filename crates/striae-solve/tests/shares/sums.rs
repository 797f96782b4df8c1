//! Sums over shares, compared with the whole.

use striae_model::Model;
use striae_solve::{
    dynamics::{kinetic_energy, mass_times},
    layout::Layout,
    problem::Problem,
    share::Division,
    team::Together,
};

use crate::{
    evaluated::{Evaluated, evaluated},
    numbering::in_whole,
    scene::{Places, block, body, coulomb, model, rubber, step},
    scenes::all,
};

/// Difference over the largest value that is round-off.
const ROUND_OFF: f64 = 1e-12;

fn whole(problem: &Problem) -> Evaluated {
    evaluated(problem, |layout| (0..layout.unknowns()).collect())
}

/// Good divisions, one where two of three ranks have no element, and one all in pieces.
fn divisions(model: &Model) -> Vec<Division> {
    let counts = model.bodies.iter().map(|body| body.mesh.element_count());
    let by = |rank: fn(u32) -> u32| {
        let of_body = |count: usize| (0..count as u32).map(rank).collect();
        Division::given(model, 3, counts.clone().map(of_body).collect())
    };
    let good = (2..=4).map(|ranks| Division::new(model, ranks).unwrap());
    good.chain([
        by(|_| 1),
        by(|element| (element.wrapping_mul(0x9e37_79b9) >> 7) % 3),
    ])
    .collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

#[test]
fn residuals_tangents_and_energies_are_those_of_the_whole() {
    for (name, model) in all() {
        let problem = Problem::new(model.clone()).unwrap();
        let whole = whole(&problem);
        let residual = &whole.assembled.residual;
        for division in divisions(&model) {
            let ranks = division.ranks();
            let found = Together::run(ranks, |team| {
                let problem = Problem::shared(model.clone(), &division, team).unwrap();
                let number = |own: &Layout| in_whole(&problem, own, &whole.layout);
                let own = evaluated(&problem, number);
                let numbers = number(&own.layout);
                (own.assembled, own.product, numbers)
            });
            let mut product = vec![0.0; whole.product.len()];
            for (own, of_tangent, numbers) in &found {
                for (at, number) in numbers.iter().enumerate() {
                    let difference = (own.residual[at] - residual[*number]).abs();
                    assert!(
                        difference <= ROUND_OFF * largest(residual),
                        "{name} on {ranks} ranks, unknown {number}: {difference:e}"
                    );
                    product[*number] += of_tangent[at];
                }
                let strain = own.bodies.strain - whole.assembled.bodies.strain;
                assert!(strain.abs() <= ROUND_OFF * whole.assembled.bodies.strain);
                let force = own.norms.force - whole.assembled.norms.force;
                assert!(force.abs() <= ROUND_OFF * whole.assembled.norms.force.max(1.0));
            }
            for (at, (sum, of_whole)) in product.iter().zip(&whole.product).enumerate() {
                let difference = (sum - of_whole).abs();
                assert!(
                    difference <= ROUND_OFF * largest(&whole.product),
                    "{name} on {ranks} ranks, tangent of unknown {at}: {difference:e}"
                );
            }
        }
    }
}

/// Each body on a rank of its own, or both on one of two.
#[test]
fn rows_of_contact_are_shared_evenly_wherever_the_volume_is_divided() {
    let lower = block([0.0; 3], [1.0; 3], [6, 6, 2]).mesh().unwrap();
    let upper = block([0.0, 0.0, 1.0], [1.0; 3], [5, 5, 2]).mesh().unwrap();
    let mut model = model(vec![
        body("lower", lower, rubber(1.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.3));
    model.steps = vec![step()];
    let problem = Problem::new(model.clone()).unwrap();
    let whole = whole(&problem);
    for ranks_of_bodies in [[0, 1], [0, 0], [1, 1]] {
        let bodies = model.bodies.iter().zip(ranks_of_bodies);
        let elements = bodies.map(|(body, rank)| vec![rank; body.mesh.element_count()]);
        let division = Division::given(&model, 2, elements.collect());
        let entries = Together::run(2, |team| {
            let problem = Problem::shared(model.clone(), &division, team).unwrap();
            let number = |own: &Layout| in_whole(&problem, own, &whole.layout);
            evaluated(&problem, number).contact_entries
        });
        assert_eq!(entries.iter().sum::<usize>(), whole.contact_entries);
        let share = entries[0] as f64 / whole.contact_entries as f64;
        assert!((0.4..0.6).contains(&share), "{share}");
    }
}

#[test]
fn contact_is_the_same_to_the_last_bit() {
    for (name, model) in all() {
        let problem = Problem::new(model.clone()).unwrap();
        let whole = whole(&problem);
        let division = Division::new(&model, 3).unwrap();
        let found = Together::run(3, |team| {
            let problem = Problem::shared(model.clone(), &division, team).unwrap();
            let number = |own: &Layout| in_whole(&problem, own, &whole.layout);
            evaluated(&problem, number).assembled.contacts
        });
        for contacts in found {
            for (own, of_whole) in contacts.iter().zip(&whole.assembled.contacts) {
                assert!(!own.terms.is_empty(), "{name} touches");
                assert_eq!(own.nodes, of_whole.nodes, "{name}");
                assert_eq!(own.facets, of_whole.facets, "{name}");
                assert_eq!(own.carried, of_whole.carried, "{name}");
                assert_eq!(own.terms.len(), of_whole.terms.len());
                for (own, of_whole) in own.terms.iter().zip(&of_whole.terms) {
                    assert_eq!(own.residual, of_whole.residual, "{name}");
                    assert_eq!(own.tangent, of_whole.tangent, "{name}");
                }
            }
        }
    }
}

#[test]
fn masses_add_up() {
    for (name, model) in all() {
        let problem = Problem::new(model.clone()).unwrap();
        let velocities = |problem: &Problem| {
            let places = problem.reference.iter();
            places.map(|x| x * 0.3 + x.yzx()).collect::<Vec<_>>()
        };
        let momentum = mass_times(&problem, &velocities(&problem));
        let energy = kinetic_energy(&problem, &velocities(&problem));
        let division = Division::new(&model, 3).unwrap();
        let found = Together::run(3, |team| {
            let problem = Problem::shared(model.clone(), &division, team).unwrap();
            let vectors = velocities(&problem);
            let nodes = problem.global_nodes();
            let whole = nodes
                .map(|node| problem.share.whole_node(node))
                .collect::<Vec<_>>();
            let of_rank = mass_times(&problem, &vectors);
            (of_rank, whole, kinetic_energy(&problem, &vectors))
        });
        for (of_rank, nodes, kinetic) in found {
            assert!((kinetic - energy).abs() <= ROUND_OFF * energy, "{name}");
            for (own, node) in of_rank.iter().zip(nodes) {
                let difference = (own - momentum[node]).norm();
                assert!(difference <= ROUND_OFF, "{name}: {difference:e}");
            }
        }
    }
}
