//! A block in a corner of a floor and a wall, rigid or deformable: two pairs share an edge.

use super::{
    Dialect,
    columns::EXACT,
    parts::{Stance, Units, increments, pair_with, placement, scene},
    simple::{elastic, gridded, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    grid::{Cells, Course, Grid},
    law::Law,
    random::Random,
    scene::{Body, End, Ending, Pair, Rigid, RigidShape, Scene, Step},
    vector::Vector,
};

pub const UP: Vector = [0.0, 0.0, 1.0];
pub const ASIDE: Vector = [1.0, 0.0, 0.0];

/// A block whose sides `zmin` and `xmin` meet in the axis `y`.
pub struct Wedged {
    pub units: Units,
    pub size: Vector,
    pub block: Body,
    pub pairs: Vec<Pair>,
}

pub fn wedged(random: &mut Random, law: &Law, poisson: f64) -> Wedged {
    let units = Units::random(random);
    let size = [0; 3].map(|_| random.between(0.5, 1.0) * units.length);
    let divisions = [
        random.whole(2..=5),
        random.whole(2..=4),
        random.whole(2..=4),
    ];
    let mut block = Grid::mapped(divisions, Course::Open, Cells::Hexahedra, |[x, y, z]| {
        [size[0] * x, size[1] * (y - 0.5), size[2] * z]
    });
    // What of the wall's side does not move with the top.
    let below_top = |x: &Vector| x[0] == 0.0 && x[2] < 0.99 * size[2];
    let back = (0..block.positions.len()).filter(|&i| below_top(&block.positions[i]));
    let back = back.collect();
    block.sides.push(("back", back));
    let material = if poisson == 0.0 {
        elastic(units.modulus, poisson)
    } else {
        rubbery(units.modulus, poisson)
    };
    let mut pair = |name, facets, other| {
        let sides = [("block", Some(facets)), other];
        let mut pair = pair_with(random, name, sides, units.length, 1.0, law.clone());
        (pair.cap, pair.decay) = (None, None);
        pair
    };
    let pairs = vec![
        pair("below", "zmin", ("floor", None)),
        pair("beside", "xmin", ("wall", None)),
    ];
    Wedged {
        units,
        size,
        block: gridded("block", material, block),
        pairs,
    }
}

impl Wedged {
    /// The scene with rigid planes.
    fn on_planes(self, random: &mut Random, stance: Stance) -> Scene {
        let placement = placement(random, self.units, stance);
        let mut scene = scene(placement, None, vec![self.block], self.pairs);
        for (name, normal) in [("floor", UP), ("wall", ASIDE)] {
            scene.rigid.push(Rigid {
                name,
                shape: RigidShape::Plane([0.0; 3], normal),
            });
        }
        scene.ending = Ending::Completes;
        scene
    }
}

/// A step that presses two sides of the block, each along its normal alone.
pub fn pressed(random: &mut Random, depths: [f64; 2]) -> Step {
    Step::new("press")
        .holding("block", "zmax", [None, None, Some(-depths[0])])
        .holding("block", "xmax", [Some(-depths[1]), None, None])
        .holding("block", "ymin", [None, Some(0.0), None])
        .within(increments(random))
        .ending(End::Touching)
}

pub fn claimed(scene: &mut Scene, pair: usize, along: Vector, force: f64, share: f64) {
    let quantity = Quantity::Force(pair, "block", along);
    let claim = Claim::at_end("closed form", 0, quantity, about(force, share));
    scene.claims.push(claim);
}

/// A block in a corner of two rigid planes.
pub fn corner(random: &mut Random, _: Dialect) -> Scene {
    match random.whole(0..=2) {
        0 => uniform(random),
        1 => loaded(random),
        _ => dragged(random),
    }
}

/// Without friction and Poisson's ratio: `E e A` at each plane.
fn uniform(random: &mut Random) -> Scene {
    let wedged = wedged(random, &Law::Frictionless, 0.0);
    let (size, modulus) = (wedged.size, wedged.units.modulus);
    let strains = [0; 2].map(|_| random.between(0.001, 0.01));
    let mut scene = wedged.on_planes(random, Stance::Upright);
    scene.steps = vec![pressed(
        random,
        [strains[0] * size[2], strains[1] * size[0]],
    )];
    let [below, beside] = [size[0] * size[1], size[1] * size[2]];
    claimed(&mut scene, 0, UP, modulus * strains[0] * below, EXACT);
    claimed(&mut scene, 1, ASIDE, modulus * strains[1] * beside, EXACT);
    scene
}

/// Under dead loads, held by friction alone: what friction on one plane carries, the other misses.
fn loaded(random: &mut Random) -> Scene {
    let mu = random.between(0.1, 0.4);
    let poisson = random_poisson(random);
    let wedged = wedged(random, &Law::Coulomb(mu), poisson);
    let (size, modulus) = (wedged.size, wedged.units.modulus);
    let pressures = [0; 2].map(|_| random.between(0.001, 0.01) * modulus);
    let mut scene = wedged.on_planes(random, Stance::Any);
    let areas = [size[0] * size[1], size[1] * size[2]];
    let mut load = Step::new("load").within(increments(random));
    load.end = End::Touching;
    load.tractions = vec![
        ("block", "zmax", [0.0, 0.0, -pressures[0]], areas[0]),
        ("block", "xmax", [-pressures[1], 0.0, 0.0], areas[1]),
    ];
    scene.steps = vec![load];
    let forces = [0, 1].map(|i| pressures[i] * areas[i]);
    for (pair, along) in [(0, UP), (1, ASIDE)] {
        let (own, other) = (forces[pair], forces[1 - pair]);
        let low = (own - mu * other) / (1.0 + mu * mu);
        let high = (own + mu * other) / (1.0 - mu * mu);
        let quantity = Quantity::Force(pair, "block", along);
        let claim = Claim::at_end("closed form", 0, quantity, [low, high]);
        scene.claims.push(claim);
    }
    scene
}

pub fn random_poisson(random: &mut Random) -> f64 {
    random.between(0.1, 0.4)
}

/// Pressed into the corner and dragged along it: all slips on both planes.
fn dragged(random: &mut Random) -> Scene {
    let mu = random.between(0.05, 0.5);
    let poisson = random_poisson(random);
    let mut wedged = wedged(random, &Law::Coulomb(mu), poisson);
    for side in &mut wedged.pairs[1].sides {
        side.facets = side.facets.map(|_| "back");
    }
    let size = wedged.size;
    let mut scene = wedged.on_planes(random, Stance::Any);
    let strains = [0; 2].map(|_| random.between(0.005, 0.03));
    let into = [-strains[1] * size[0], 0.0, -strains[0] * size[2]];
    let way = random.sign() * random.between(0.2, 0.6) * size[1];
    scene.steps = vec![
        Step::new("press")
            .moving("block", "zmax", into)
            .within(increments(random))
            .ending(End::Touching),
        Step::new("drag")
            .moving("block", "zmax", [into[0], way, into[2]])
            .within(Some(random.whole(4..=12)))
            .ending(End::Touching),
    ];
    for pair in 0..2 {
        let quantity = Quantity::Friction(pair);
        scene
            .claims
            .push(Claim::at_end("sliding", 1, quantity, about(mu, 0.01)));
    }
    scene
}
