//! Who has which element, and who owns which node.

use striae_mesh::Vec3;
use striae_solve::{
    model::{ContactSurface, Model, Pair, Tie},
    share::Division,
    team::Together,
};

use crate::{
    scene::{Places, block, body, coulomb, model, rubber, step},
    scenes::all,
};

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
    let model = stacked();
    for ranks in 2..=4 {
        let division = Division::new(&model, ranks).unwrap();
        // Of a face in contact as much as of a node.
        let sides = model.pairs.iter().flat_map(|pair| [&pair.a, &pair.b]);
        let faces = sides.flat_map(|side| match side {
            ContactSurface::Deformable { body, faces } => {
                let of_body = &division.elements()[body.0];
                let of_faces = faces.iter().map(|face| of_body[face.element.index()]);
                of_faces.collect()
            }
            ContactSurface::Rigid(_) => Vec::new(),
        });
        let all: Vec<u32> = faces.chain(division.owners().iter().copied()).collect();
        // METIS keeps to 3 % of weights; of nodes at borders, of which there are many here, each
        // is one rank's.
        let fair = all.len() as f64 / ranks as f64;
        for which in 0..ranks as u32 {
            let own = all.iter().filter(|rank| **rank == which).count();
            let share = own as f64 / fair;
            assert!((0.85..1.15).contains(&share), "{share} of rank {which}");
        }
    }
}

/// A cube on another one. A division along the surface between them would cut no element from
/// its neighbours.
fn stacked() -> Model {
    let lower = block([0.0; 3], [1.0; 3], [8, 8, 8]).mesh().unwrap();
    let upper = block([0.0, 0.0, 1.0], [1.0; 3], [7, 7, 7]).mesh().unwrap();
    let mut model = model(vec![
        body("lower", lower, rubber(1.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.3));
    model
}

/// Ranks of the elements below and above 400 places of the surface between two cubes.
fn facing(model: &Model, ranks: usize) -> Vec<[u32; 2]> {
    let division = Division::new(model, ranks).unwrap();
    let places = (0..400).map(|k| [k % 20, k / 20].map(|i| (f64::from(i) + 0.5) / 20.0));
    let of_place = |[x, y]: [f64; 2]| {
        [(0, 0.99), (1, 1.01)].map(|(body, z)| {
            let found = model.bodies[body].mesh.locate(&Vec3::new(x, y, z));
            division.elements()[body][found.unwrap().element.index()]
        })
    };
    places.map(of_place).collect()
}

#[test]
fn contact_is_divided_into_pieces_of_both_sides() {
    let model = stacked();
    for ranks in 2..=4 {
        let facing = facing(&model, ranks);
        let parted = facing.iter().filter(|[a, b]| a != b).count();
        assert!(parted < 80, "{parted} of 400 places on {ranks} ranks");
    }
}

#[test]
fn tied_facets_are_as_good_as_elements_with_a_face_in_common() {
    let mut model = stacked();
    let Pair { a, b, .. } = model.pairs.remove(0);
    model.ties = vec![Tie {
        name: "glue".into(),
        a,
        b,
        within: None,
        moved: 0.0,
    }];
    let facing = facing(&model, 3);
    let parted = facing.iter().filter(|[a, b]| a != b).count();
    assert!(parted < 200, "{parted} of 400 places");
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
    let mesh = block([0.0; 3], [1.0; 3], [2, 1, 1]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.steps = vec![step()];
    let division = Division::new(&model, 5).unwrap();
    assert_eq!(division.elements(), [[0, 1]]);
    let problems = Together::run(5, |team| {
        striae_solve::problem::Problem::shared(model.clone(), &division, team)
            .map(|problem| problem.reference.len())
    });
    let counts: Vec<usize> = problems.into_iter().map(Result::unwrap).collect();
    assert_eq!(counts, [8, 8, 0, 0, 0]);
}
