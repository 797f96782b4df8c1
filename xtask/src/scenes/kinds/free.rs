//! Bodies that only contact and friction hold: grips and sandwiches.

use super::{
    Dialect,
    parts::{
        Stance, Strains, Units, block, body, coulomb, facet, increments, pair_with, placement,
        ratio, scene,
    },
    plain::Press,
};
use crate::scenes::{
    random::Random,
    scene::{Block, End, Rigid, RigidShape, Scene, Shape, Step},
};

/// Three blocks on one another.
struct Layers {
    scene: Scene,
    depth: f64,
    facet: f64,
    /// Pressure to expect.
    pressure: f64,
    friction: f64,
    /// Area of a clamp and of the end of the middle block.
    areas: [f64; 2],
}

/// The middle block, longer than the others by a share.
fn layers(random: &mut Random, longer: f64) -> Layers {
    let units = Units::random(random);
    let unit = units.length;
    let plan = [unit, random.between(0.7, 1.1) * unit];
    let heights = [0; 3].map(|_| random.between(0.25, 0.6) * unit);
    let middle_plan = [plan[0] * (1.0 + longer), plan[1] * random.between(0.8, 1.0)];
    let limited = |block: Block| Block {
        divisions: block.divisions.map(|count| count.min(6)),
        ..block
    };
    let mut bottom = -heights[0];
    let mut blocks = Vec::new();
    for (index, height) in heights.into_iter().enumerate() {
        let plan = if index == 1 { middle_plan } else { plan };
        let aside = if index == 1 { 0.5 * longer * unit } else { 0.0 };
        let layers = random.whole(1..=3);
        blocks.push(limited(block(
            random,
            [aside, 0.0, bottom],
            plan,
            height,
            layers,
        )));
        bottom += height;
    }
    let ratio = ratio(random).clamp(1e-3, 1e3);
    let press = Press {
        moduli: [units.modulus, units.modulus * ratio],
        heights: [0.5 * (heights[0] + heights[2]), 0.5 * heights[1]],
    };
    let strain = random.between(0.01, 0.04);
    let friction = random.between(0.2, 0.6);
    let law = coulomb(random, friction, friction + 1e-9);
    let pair = |random: &mut Random, name, sides| {
        pair_with(
            random,
            name,
            sides,
            unit,
            press.pressure(strain),
            law.clone(),
        )
    };
    let pairs = vec![
        pair(
            random,
            "below",
            [("lower", Some("zmax")), ("middle", Some("zmin"))],
        ),
        pair(
            random,
            "above",
            [("middle", Some("zmax")), ("upper", Some("zmin"))],
        ),
    ];
    let moduli = [press.moduli[0], press.moduli[1], press.moduli[0]];
    let facet = facet(&blocks[1]);
    let names = ["lower", "middle", "upper"].into_iter();
    let areas = [plan[0] * plan[1], middle_plan[1] * heights[1]];
    let bodies = names
        .zip(blocks)
        .zip(moduli)
        .map(|((name, block), modulus)| {
            body(name, Strains::Moderate.material(random, modulus), block)
        });
    let bodies = bodies.collect();
    let placement = placement(random, units, Stance::Upright);
    Layers {
        scene: scene(placement, Some(ratio), bodies, pairs),
        // Both interfaces approach.
        depth: 2.0 * press.depth(strain),
        facet,
        pressure: press.pressure(strain),
        friction,
        areas,
    }
}

/// A block squeezed between two others and pulled out of them, by its end.
pub fn grip(random: &mut Random, _: Dialect) -> Scene {
    let longer = random.between(0.1, 0.4);
    let mut layers = layers(random, longer);
    let mut squeeze = Step::new("squeeze")
        .moving("lower", "zmin", [0.0; 3])
        .moving("upper", "zmax", [0.0, 0.0, -layers.depth])
        .within(increments(random))
        .ending(End::Touching);
    squeeze
        .displacements
        .push(("middle", "xmax", [Some(0.0), Some(0.0), None]));
    let mut pull = Step::new("pull").within(increments(random));
    if random.chance(0.5) {
        let way = random.between(0.2, 1.5) * layers.facet;
        pull.displacements
            .push(("middle", "xmax", [Some(way), None, None]));
    } else {
        // Well below what friction holds: some tenths of it.
        let limit = 2.0 * layers.friction * layers.pressure * layers.areas[0];
        let traction = random.between(0.1, 0.4) * limit / layers.areas[1];
        pull.releases.push(("middle", "xmax"));
        let [x, z] = [traction, 0.0];
        pull.tractions
            .push(("middle", "xmax", [x, 0.0, z], layers.areas[1]));
    }
    layers.scene.steps = vec![squeeze, pull];
    layers.scene
}

/// Three blocks, the middle one held by friction alone, and the upper one slid; or the
/// upper one a rigid plane.
pub fn sandwich(random: &mut Random, _: Dialect) -> Scene {
    let mut layers = layers(random, 0.0);
    let down = [0.0, 0.0, -layers.depth];
    let slide = [random.between(0.2, 1.0) * layers.facet, 0.0, -layers.depth];
    let mut press = Step::new("press")
        .moving("lower", "zmin", [0.0; 3])
        .within(increments(random))
        .ending(End::Touching);
    let mut shear = Step::new("shear").within(increments(random));
    if random.chance(0.25) {
        // Without the upper body the plane lies on the middle one.
        layers.scene.bodies.pop();
        let top = match layers.scene.bodies.last().map(|body| &body.shape) {
            Some(Shape::Block(block)) => block.size[2],
            _ => 0.0,
        };
        let plane = RigidShape::Plane([0.0, 0.0, top], [0.0, 0.0, -1.0]);
        layers.scene.rigid.push(Rigid {
            name: "plane",
            shape: plane,
        });
        let pair = &mut layers.scene.pairs[1];
        if pair.sides[0].owner == "upper" {
            pair.sides.swap(0, 1);
        }
        pair.sides[1].owner = "plane";
        pair.sides[1].facets = None;
        press.rigid.push(("plane", down, None));
        shear.rigid.push(("plane", slide, None));
    } else {
        press = press.moving("upper", "zmax", down);
        shear = shear.moving("upper", "zmax", slide);
    }
    if random.chance(0.5) {
        press
            .displacements
            .push(("middle", "xmin", [Some(0.0), Some(0.0), None]));
        shear.releases.push(("middle", "xmin"));
    }
    layers.scene.steps = vec![press, shear];
    layers.scene
}
