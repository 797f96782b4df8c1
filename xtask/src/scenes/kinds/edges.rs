//! A block between a deformable floor and a deformable wall: two pairs share an edge.

use super::{
    Dialect,
    corner::{ASIDE, UP, claimed, pressed, random_poisson, wedged},
    parts::{Stance, body, placement, scene},
    simple::plain_block,
};
use crate::scenes::{
    law::Law,
    random::Random,
    scene::{Ending, Material, Scene},
};

/// A block between a deformable floor and a deformable wall.
///
/// Without friction and Poisson's ratio each direction is a column of two; the faces move past
/// each other by the approach of the other direction, some thousandths of them.
pub fn shared_edge(random: &mut Random, _: Dialect) -> Scene {
    let plain = random.chance(0.5);
    let law = if plain {
        Law::Frictionless
    } else {
        Law::Coulomb(random.between(0.05, 0.5))
    };
    let poisson = if plain { 0.0 } else { random_poisson(random) };
    let mut wedged = wedged(random, &law, poisson);
    for pair in &mut wedged.pairs {
        let facets = if pair.name == "below" { "zmax" } else { "xmax" };
        pair.sides[1].facets = Some(facets);
    }
    let (size, modulus) = (wedged.size, wedged.units.modulus);
    let moduli = [0; 2].map(|_| modulus * random.decade(1e-1, 1e2));
    let thick = [0; 2].map(|_| random.between(0.3, 0.6) * wedged.units.length);
    let strain = random.between(0.001, 0.004);
    let mut mesh = || {
        [
            random.whole(1..=4),
            random.whole(1..=4),
            random.whole(1..=3),
        ]
    };
    let floor = plain_block(
        [0.0, -0.5 * size[1], -thick[0]],
        [size[0], size[1], thick[0]],
        mesh(),
    );
    let wall = plain_block(
        [-thick[1], -0.5 * size[1], 0.0],
        [thick[1], size[1], size[2]],
        mesh(),
    );
    let material = wedged.block.material;
    let of = |modulus| Material {
        modulus,
        ..material
    };
    let bodies = vec![
        wedged.block,
        body("floor", of(moduli[0]), floor),
        body("wall", of(moduli[1]), wall),
    ];
    let placement = placement(random, wedged.units, Stance::Upright);
    let mut scene = scene(placement, Some(modulus / moduli[0]), bodies, wedged.pairs);
    scene.ending = Ending::Completes;
    let heights = [size[2], size[0]];
    let pressures = [0, 1].map(|i| strain * modulus.min(moduli[i]));
    let depths = [0, 1].map(|i| pressures[i] * (heights[i] / modulus + thick[i] / moduli[i]));
    let press = pressed(random, depths)
        .moving("floor", "zmin", [0.0; 3])
        .moving("wall", "xmin", [0.0; 3]);
    scene.steps = vec![press];
    if plain {
        let areas = [size[0] * size[1], size[1] * size[2]];
        claimed(&mut scene, 0, UP, pressures[0] * areas[0], 0.03);
        claimed(&mut scene, 1, ASIDE, pressures[1] * areas[1], 0.03);
    }
    scene
}
