//! Two blocks of wedges, pyramids and tetrahedra.

use super::{Dialect, parts::increments, plain::moderate};
use crate::scenes::{
    claim::{Claim, Quantity},
    random::Random,
    scene::{Scene, Shape, Step},
    vector::plus,
};

/// Words of the deck for elements.
pub const CELLS: [&str; 5] = [
    "wedges",
    "pyramids",
    "tetrahedra",
    "composite-tetrahedra",
    "hexahedra",
];

/// Pressed, of any kinds of elements, held against hexahedra; slid.
pub fn cells(random: &mut Random, _: Dialect) -> Scene {
    let mut stack = moderate(random);
    for body in &mut stack.scene.bodies {
        body.material.poisson = body.material.poisson.min(0.35);
        let Shape::Block(block) = &mut body.shape else {
            continue;
        };
        block.divisions = block.divisions.map(|count| count.min(4));
    }
    let press = stack.press(random, [0.0, 0.0, -stack.depth]);
    stack.scene.steps = vec![press];
    stack.scene.reference = Some(Box::new(stack.scene.clone()));
    for body in &mut stack.scene.bodies {
        if let Shape::Block(block) = &mut body.shape {
            block.cells = Some(random.one_of(&CELLS));
        }
    }
    let quantity = Quantity::Beside(0, "upper", [0.0, 0.0, 1.0]);
    let claim = Claim::at_end("refined", 0, quantity, [0.7, 1.5]);
    stack.scene.claims.push(claim);
    let way = plus([0.0, 0.0, -stack.depth], stack.way(random));
    let slide = Step::new("slide").moving("upper", "zmax", way);
    stack.scene.steps.push(slide.within(increments(random)));
    stack.scene
}
