//! Columns of blocks with a common plan and no Poisson's ratio: forces have a closed form.
//!
//! With layers of heights `h`, moduli `E` and the plan `A`, an approach `d` of the ends makes the
//! force `A d / sum(h/E)` in every layer, on any mesh: the state is uniform in each layer.

use super::{
    Dialect,
    elements::CELLS,
    parts::{
        Stance, Units, body, coulomb, increments, pair_with, placement, ratio, rubbing, scene,
    },
    simple::{elastic, plain_block},
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    random::Random,
    scene::{Body, End, Ending, Pair, Scene, Shape, Step, Tie},
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
        for index in 0..self.scene.pairs.len() {
            let upper = LAYERS[index + 1];
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
        if let Shape::Block(block) = &mut body.shape {
            block.cells = Some(random.one_of(&CELLS));
        }
    }
    column.scene.steps = vec![column.press(random)];
    column.scene
}

/// Two blocks with twenty facets of one beside each of the other, slid by some of the small ones.
pub fn dense(random: &mut Random, _: Dialect) -> Scene {
    let coarse = [random.whole(1..=2), 1, 1];
    let across = random.one_of(&[1, 2, 4]);
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
