//! Springs that are refused, each with the reason and a remedy.

use striae::{
    model::{
        SpringBuilder, nodes_of, point_of, reference_of, spring, spring_along, spring_to_point,
    },
    prelude::*,
};

use super::scene::{held, weight, with_block};

/// The message about a spring.
fn told(spring: SpringBuilder) -> String {
    let model = with_block("A spring")
        .rigid(weight("weight", [1.0, 0.0, 0.0]))
        .spring(spring)
        .step(held("rest"));
    let faults = model.build().unwrap_err();
    faults.0[0].to_string()
}

#[test]
fn springs_without_force_or_direction_are_refused() {
    let weight = || reference_of("weight");
    assert_eq!(
        told(spring_along("s", weight(), [1.0, 0.0, 0.0])),
        "springs[0].stiffness: spring `s`: it has no force; give it a `stiffness`, a `damping` or \
         a `preload`"
    );
    assert_eq!(
        told(spring_to_point("s", weight(), [1.0, 0.0, 0.0]).stiffness(1.0)),
        "springs[0].b: spring `s`: both of its ends are at (1, 0, 0), so it \
         has no direction; give it a `direction`, or ends that are apart"
    );
    let many = spring("s", weight(), nodes_of("block", "zmin")).stiffness(1.0);
    assert_eq!(
        told(many),
        "springs[0].b: spring `s`: its end `b` has 4 nodes; name a set of a single node, or a \
         point of a rigid body"
    );
    let along = spring_along("s", weight(), [1.0, 0.0, 0.0]).stiffness(1.0);
    assert!(told(along.clone().free_length(0.3)).contains("state a `preload` instead"));
    assert!(told(along.clone().stiffness(-1.0)).contains("`stiffness` of spring `s` must be"));
    assert!(told(along.damping(f64::NAN)).contains("`damping` of spring `s` must be"));
    let nowhere = spring_along("s", weight(), [0.0; 3]).stiffness(1.0);
    assert!(told(nowhere).contains("must not be the zero vector"));
    let unknown = spring("s", point_of("wheel", [0.0; 3]), weight()).stiffness(1.0);
    assert!(told(unknown).contains("no rigid surface is named `wheel`"));
}

#[test]
fn springs_hold_bodies_that_nothing_else_holds() {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap());
    let model = |directions: &[[f64; 3]]| {
        let mesh = Block::default().mesh().unwrap();
        let block = model("A block").body(body("block", mesh, rubber.clone()));
        let sprung = directions
            .iter()
            .enumerate()
            .fold(block, |model, (at, direction)| {
                let name = format!("spring {at}");
                let all = nodes_of("block", "zmin");
                model.spring(spring_along(name, all, *direction).stiffness(1.0))
            });
        sprung.step(step("rest")).build()
    };
    assert!(model(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).is_ok());
    let faults = model(&[[0.0, 0.0, 1.0]]).unwrap_err().to_string();
    assert!(
        faults.contains("3 of its rigid motions are free"),
        "{faults}"
    );
}

#[test]
fn a_spring_whose_ends_meet_stops_the_run() {
    let mut to = [Freedom::AsBefore; 6];
    to[0] = Freedom::To(-1.0);
    let meet = held("meet").increments(2).move_rigid("weight", to);
    let model = with_block("Ends that meet")
        .rigid(weight("weight", [1.0, 0.0, 0.0]))
        .spring(spring_to_point("rod", reference_of("weight"), [0.0; 3]).stiffness(1.0))
        .step(meet);
    let run = Simulation::new(model.build().unwrap())
        .unwrap()
        .run()
        .unwrap();
    let said = run.ending.to_string();
    assert!(said.contains("spring `rod`: its ends have met"), "{said}");
}
