//! Sections of bodies that are built by name.

use striae_law::bulk::{LameConstants, Material};
use striae_mesh::generate::Block;
use striae_model::{Formulation, body, model, section, step};

#[test]
fn sections_have_the_formulation_of_their_body_unless_they_have_their_own() {
    let mesh = Block {
        divisions: [3, 1, 1],
        ..Block::default()
    };
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let material = Material::neo_hookean(constants);
    let part = |set: &str| section(set, material.clone());
    let block = body("block", mesh.mesh().unwrap(), material.clone())
        .elements_where("low", |x| x.x < 0.5)
        .elements_where("high", |x| x.x > 0.5)
        .section(part("low"))
        .section(part("high").formulation(Formulation::Standard))
        // After its sections, as the order is of no matter.
        .formulation(Formulation::AssumedStrain);
    let held = step("hold").displace("block", "all", [Some(0.0); 3]);
    let whole = model("a block").body(block).step(held).build();
    let whole = whole.unwrap_or_else(|faults| panic!("{faults}"));
    let sections = whole.bodies[0].sections.iter();
    let formulations: Vec<Formulation> = sections.map(|section| section.formulation).collect();
    assert_eq!(
        formulations,
        [Formulation::AssumedStrain, Formulation::Standard]
    );
}
