//! A beam over two blocks on a base: four bodies, held by friction alone.

use super::{
    Dialect,
    parts::{Stance, Units, body, coulomb, increments, pair_with, placement, scene},
    simple::{elastic, plain_block},
};
use crate::scenes::{
    claim::{Claim, Quantity},
    random::Random,
    scene::{Block, Body, End, Ending, Pair, Scene, Step},
};

/// A beam over two blocks on a base, under a dead load.
pub fn trilith(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let widths = [random.between(0.25, 0.4), random.between(0.25, 0.4)];
    let high = random.between(0.2, 0.3);
    let deep = random.between(0.3, 0.6);
    let blocks: [([f64; 3], [f64; 3], [usize; 3]); 4] = [
        ([-0.7, -0.4, -0.3], [1.4, 0.8, 0.3], [7, 4, 2]),
        ([-0.5, -0.5 * deep, 0.0], [widths[0], deep, high], [3, 3, 2]),
        (
            [0.5 - widths[1], -0.5 * deep, 0.0],
            [widths[1], deep, high],
            [2, 3, 2],
        ),
        (
            [random.between(-0.6, -0.5), -0.5 * deep, high],
            [1.1, deep, random.between(0.25, 0.4)],
            [6, 2, 2],
        ),
    ];
    let names = ["base", "left", "right", "beam"];
    let modulus = random.decade(1e-1, 1e2);
    let moduli = [1.0, modulus, modulus, random.decade(1.0, 1e2)];
    let poisson = random.between(0.0, 0.3);
    let scaled = |x: [f64; 3]| x.map(|x| x * unit);
    let bodies: Vec<Body> = (0..4)
        .map(|i| {
            let (origin, size, divisions) = blocks[i];
            let block: Block = plain_block(scaled(origin), scaled(size), divisions);
            body(names[i], elastic(units.modulus * moduli[i], poisson), block)
        })
        .collect();
    let joints = [
        ("foot-left", 0, 1),
        ("foot-right", 0, 2),
        ("head-left", 1, 3),
        ("head-right", 2, 3),
    ];
    let softest = units.modulus * moduli.into_iter().fold(f64::INFINITY, f64::min);
    let pressure = random.between(0.0005, 0.003) * softest;
    let pairs: Vec<Pair> = joints
        .iter()
        .map(|&(name, low, high)| {
            let sides = [(names[low], Some("zmax")), (names[high], Some("zmin"))];
            let law = coulomb(random, 0.3, 0.8);
            let mut pair = pair_with(random, name, sides, unit, pressure, law);
            (pair.cap, pair.decay) = (None, None);
            pair
        })
        .collect();
    let (origin, size) = (blocks[3].0, blocks[3].1);
    let middle = (origin[0] + 0.5 * size[0]) * unit;
    let placement = placement(random, units, Stance::Any);
    let mut scene = scene(placement, Some(modulus), bodies, pairs);
    let mut load = Step::new("load")
        .moving("base", "zmin", [0.0; 3])
        .within(increments(random))
        .ending(End::Touching);
    let area = size[0] * size[1] * unit * unit;
    load.tractions
        .push(("beam", "zmax", [0.0, 0.0, -pressure], area));
    let band = 0.01 * unit;
    for (pairs, owner) in [(vec![2, 3], "beam"), (vec![0, 1], "base")] {
        scene.claims.push(Claim::at_end(
            "stands",
            0,
            Quantity::Lever(pairs, owner, [1.0, 0.0, 0.0]),
            [middle - band, middle + band],
        ));
    }
    scene.steps = vec![load];
    scene.ending = Ending::Completes;
    scene
}
