//! Columns of blocks with a common plan and no Poisson's ratio: forces have a closed form.
//!
//! With layers of heights `h`, moduli `E` and the plan `A`, an approach `d` of the ends makes the
//! force `A d / sum(h/E)` in every layer, on any mesh: the state is uniform in each layer.

use super::{
    Dialect,
    parts::{
        Stance, Units, body, coulomb, elastic, increments, pair_with, placement, plain_block,
        ratio, rubbing, scene,
    },
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    random::Random,
    scene::{Block, Body, End, Ending, Pair, Scene, Step, Tie},
};

/// Relative error of forces that have a closed form.
pub const EXACT: f64 = 1e-4;

/// Names of layers, from below.
const LAYERS: [&str; 5] = ["first", "second", "third", "fourth", "fifth"];
const JOINTS: [&str; 4] = ["joint-1", "joint-2", "joint-3", "joint-4"];

/// Layers on one another, and the force that an approach makes.
struct Column {
    scene: Scene,
    /// Of the ends.
    depth: f64,
    /// At that approach.
    force: f64,
    plan: [f64; 2],
}

/// A column of layers with these elements along the two edges of the plan.
fn column(random: &mut Random, divisions: &[[usize; 3]], moduli: &[f64]) -> Column {
    let units = Units::random(random);
    let unit = units.length;
    let plan = [
        random.between(0.8, 1.2) * unit,
        random.between(0.8, 1.2) * unit,
    ];
    let mut bodies: Vec<Body> = Vec::new();
    let (mut bottom, mut compliance, mut softest) = (0.0, 0.0, f64::INFINITY);
    for ((&name, &divisions), &modulus) in LAYERS.iter().zip(divisions).zip(moduli) {
        let modulus = modulus * units.modulus;
        let height = random.between(0.3, 0.7) * unit;
        let origin = [-0.5 * plan[0], -0.5 * plan[1], bottom];
        let size = [plan[0], plan[1], height];
        let block = plain_block(origin, size, divisions);
        bodies.push(body(name, elastic(modulus, 0.0), block));
        bottom += height;
        compliance += height / modulus;
        softest = modulus.min(softest);
    }
    let pressure = random.between(0.001, 0.008) * softest;
    let pairs: Vec<Pair> = (1..bodies.len())
        .map(|upper| {
            let sides = [
                (LAYERS[upper - 1], Some("zmax")),
                (LAYERS[upper], Some("zmin")),
            ];
            let law = rubbing(random);
            pair_with(random, JOINTS[upper - 1], sides, unit, pressure, law)
        })
        .collect();
    let placement = placement(random, units, Stance::Any);
    let mut scene = scene(placement, Some(moduli[1] / moduli[0]), bodies, pairs);
    scene.ending = Ending::Completes;
    Column {
        scene,
        depth: pressure * compliance,
        force: pressure * plan[0] * plan[1],
        plan,
    }
}

impl Column {
    /// The step that presses, and what it claims.
    fn press(&mut self, random: &mut Random) -> Step {
        let top = LAYERS[self.scene.bodies.len() - 1];
        for (index, pair) in self.scene.pairs.iter().enumerate() {
            let upper = LAYERS[index + 1];
            debug_assert!(pair.sides.iter().any(|side| side.owner == upper));
            let quantity = Quantity::Force(index, upper, [0.0, 0.0, 1.0]);
            let bounds = about(self.force, EXACT);
            self.scene
                .claims
                .push(Claim::at_end("closed form", 0, quantity, bounds));
        }
        Step::new("press")
            .moving(LAYERS[0], "zmin", [0.0; 3])
            .moving(top, "zmax", [0.0, 0.0, -self.depth])
            .within(increments(random))
            .ending(End::Touching)
    }
}

fn mesh(random: &mut Random) -> [usize; 3] {
    [
        random.whole(1..=5),
        random.whole(1..=5),
        random.whole(1..=2),
    ]
}

/// Three to five blocks on one another.
pub fn pile(random: &mut Random, _: Dialect) -> Scene {
    let count = random.whole(3..=5);
    let divisions: Vec<[usize; 3]> = (0..count).map(|_| mesh(random)).collect();
    let moduli: Vec<f64> = (0..count).map(|_| random.decade(1e-2, 1e2)).collect();
    let mut column = column(random, &divisions, &moduli);
    column.scene.steps = vec![column.press(random)];
    column.scene
}

/// Two blocks of any kinds of elements, in a uniform state.
pub fn patch(random: &mut Random, _: Dialect) -> Scene {
    let divisions = [mesh(random), mesh(random)];
    let moduli = [1.0, ratio(random)];
    let mut column = column(random, &divisions, &moduli);
    for body in &mut column.scene.bodies {
        if let crate::scenes::scene::Shape::Block(block) = &mut body.shape {
            block.cells = Some(random.one_of(&CELLS));
        }
    }
    column.scene.steps = vec![column.press(random)];
    column.scene
}

/// Words of the deck for elements.
pub const CELLS: [&str; 5] = [
    "wedges",
    "pyramids",
    "tetrahedra",
    "composite-tetrahedra",
    "hexahedra",
];

/// Two blocks with twenty facets of one beside each of the other, slid by some of the small ones.
pub fn dense(random: &mut Random, _: Dialect) -> Scene {
    let coarse = [random.whole(1..=2), 1, 1];
    let across = random.one_of(&[2, 4, 10]);
    let fine = [20 * coarse[0], across, 1];
    let (divisions, moduli) = if random.chance(0.5) {
        ([coarse, fine], [1.0, ratio(random)])
    } else {
        ([fine, coarse], [1.0, ratio(random)])
    };
    let mut column = column(random, &divisions, &moduli);
    let law = coulomb(random, 0.05, 0.5);
    let mu = law.coefficient();
    let pair = &mut column.scene.pairs[0];
    (pair.law, pair.cap, pair.decay) = (law, None, None);
    pair.sides.iter_mut().for_each(|side| side.texture = None);
    let press = column.press(random);
    let facet = column.plan[0] / fine[0] as f64;
    let way = [random.between(1.5, 4.0) * facet, 0.0, -column.depth];
    let slide = Step::new("slide").moving("second", "zmax", way);
    column.scene.claims.push(Claim::at_end(
        "sliding",
        1,
        Quantity::Friction(0),
        about(mu, 0.01),
    ));
    column.scene.steps = vec![press, slide.within(Some(4))];
    column.scene
}

/// A column of which one joint is tied, beside one that only touches; pressed, then lifted.
pub fn tied(random: &mut Random, _: Dialect) -> Scene {
    let divisions = [mesh(random), mesh(random), mesh(random)];
    let moduli: Vec<f64> = (0..3).map(|_| random.decade(1e-2, 1e2)).collect();
    let mut column = column(random, &divisions, &moduli);
    let press = column.press(random);
    // The joint below or above is glued; the claim on its pair becomes one on the tie.
    let glued = random.whole(0..=1);
    let upper = LAYERS[glued + 1];
    column.scene.pairs.remove(glued);
    column.scene.ties.push(Tie {
        name: "glue",
        sides: [(LAYERS[glued], "zmax"), (upper, "zmin")],
    });
    let up = [0.0, 0.0, 1.0];
    column.scene.claims.clear();
    let touching = LAYERS[2 - glued];
    let force = about(column.force, EXACT);
    let claim = |quantity| Claim::at_end("closed form", 0, quantity, force);
    column.scene.claims = vec![
        claim(Quantity::Force(0, touching, up)),
        claim(Quantity::Pull(0, upper, up)),
    ];
    let lift = Step::new("lift")
        .moving("third", "zmax", [0.0, 0.0, 0.5 * column.depth])
        .within(increments(random))
        .ending(End::Apart);
    column.scene.steps = vec![press, lift];
    column.scene
}

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
